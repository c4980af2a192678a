// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/detail/law_model.hpp>
#include <voussoir/model/system.hpp>

namespace voussoir {

/// A mechanical system whose contact laws are known at run time: what searches for equilibrium and
/// sets in motion is compiled for this one, whatever the laws are.
template <class Geometry, class Detector = FaceContacts>
using AnySystem = System<Geometry, AnyLaw<Geometry::dim>, AnyLaw<Geometry::dim>, Detector>;

namespace detail {

/// Whether the laws of a system are types that can stand behind `AnyLaw`.
template <class System>
inline constexpr bool has_laws_to_hide = false;
template <class Geometry, class JointLaw, class InterfaceLaw, class Detector>
inline constexpr bool has_laws_to_hide<System<Geometry, JointLaw, InterfaceLaw, Detector>> =
    hides_laws<JointLaw, InterfaceLaw, Geometry::dim>;

/// While this lives, a system with laws known at run time in the place of one whose laws are types:
/// it has all that the other had, and gives it back in the end, however that comes.
/// @cost  a copy of what the laws remember, there and back: no part of a force evaluation
template <class System>
class WithoutLaws {
 public:
  static constexpr int dim = System::dim;
  using Any = AnySystem<typename System::GeometryType, typename System::Detector>;

  explicit WithoutLaws(System& system)
      : system_(system),
        any_(any_laws<dim>(system.joints.laws()), any_laws<dim>(system.boundary.laws()),
             any_laws<dim>(system.interface.laws())) {
    exchange_contacts(system_, any_);
    any_.exchange_state(system_);
  }
  WithoutLaws(const WithoutLaws&) = delete;
  WithoutLaws& operator=(const WithoutLaws&) = delete;
  ~WithoutLaws() {
    using Law = typename System::InterfaceLawType;
    const auto& laws = any_.interface.laws();
    for (std::size_t k = system_.interface.laws().size(); k < laws.size(); ++k)
      system_.interface.add_law(LawModelOf<dim, Law>::of_type(laws[k]));
    exchange_contacts(any_, system_);
    any_.exchange_state(system_);
  }

  [[nodiscard]] Any& operator*() { return any_; }
  [[nodiscard]] Any* operator->() { return &any_; }

 private:
  template <class From, class To>
  static void exchange_contacts(From& from, To& to) {
    to.joints.take_contacts(from.joints);
    to.boundary.take_contacts(from.boundary);
    to.interface.take_contacts(from.interface);
  }

  System& system_;
  Any any_;
};

/// A system as it is, in the place of `WithoutLaws`.
template <class System>
class AsItIs {
 public:
  explicit AsItIs(System& system) : system_(system) {}
  [[nodiscard]] System& operator*() { return system_; }
  [[nodiscard]] System* operator->() { return &system_; }

 private:
  System& system_;
};

/// What to work with where laws do not matter: `LawsAside<System> aside(system);`
template <class System>
using LawsAside = std::conditional_t<has_laws_to_hide<System>, WithoutLaws<System>, AsItIs<System>>;

/// A law of the interface as such a system wants it.
template <class Aside, class Law>
[[nodiscard]] typename Aside::InterfaceLawType law_for(const Law& law) {
  if constexpr (is_any_law<typename Aside::InterfaceLawType>)
    return any_law<Aside::dim>(law);
  else
    return law;
}

}  // namespace detail
}  // namespace voussoir
