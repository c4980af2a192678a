// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/shear_spring.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/visit_numbered.hpp>

namespace voussoir {

namespace detail {

/// What a point remembers whose law is one of several types.
template <int Dim, class... Laws>
struct StateOfAny {
  std::variant<typename Laws::template State<Dim>...> of{};

  /// As the law with this number among `Laws` remembers it. What another law remembered, before the
  /// contact was found anew on another joint, is known by its shear spring alone.
  template <std::size_t Number>
  [[nodiscard]] auto as() const {
    if (const auto* own = std::get_if<Number>(&of)) return *own;
    std::variant_alternative_t<Number, decltype(of)> state{};
    std::visit([&](const auto& other) { spring_in(state) = spring_in(other); }, of);
    return state;
  }

 private:
  template <class State>
  [[nodiscard]] static auto& spring_in(State& state) {
    if constexpr (requires { state.joint; })
      return spring_in(state.joint);
    else if constexpr (std::is_const_v<State>)
      return static_cast<const ShearSpring<Dim>&>(state);
    else
      return static_cast<ShearSpring<Dim>&>(state);
  }
};

}  // namespace detail

/// A contact law that is of one of several types, which is known at run time: every joint set of a
/// model may have a type of its own (`LawsBySet<AnyJoint>`).
///
/// Where all laws of a model are of one type its contacts work with that, at no cost
/// (`detail::any_laws`). Where types are mixed every point asks which its law is.
///
/// @tparam Laws  contact laws whose states are or hold, as `joint`, a `ShearSpring`
template <class... Laws>
class AnyJointOf {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "AnyJoint";
  template <int Dim>
  using State = detail::StateOfAny<Dim, Laws...>;

  template <class Law>
  requires(std::same_as<Law, Laws> || ...)
      AnyJointOf(const Law& law)  // NOLINT(google-explicit-constructor): any of them is one
      : law_(law) {}

  /// The law as its type; null if it is of another.
  template <class Law>
  [[nodiscard]] const Law* as() const {
    return std::get_if<Law>(&law_);
  }
  /// Number of its type among `Laws`.
  [[nodiscard]] std::size_t type() const { return law_.index(); }
  /// Calls visit(law) with the law as its type.
  template <class Visit>
  decltype(auto) visit(Visit&& visit) const {
    return std::visit(std::forward<Visit>(visit), law_);
  }
  /// The name of its type.
  [[nodiscard]] const char* type_name() const {
    return visit([](const auto& law) -> const char* { return law.name; });
  }

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      if (const auto* own = std::get_if<Number>(&state.of)) return law.force(load, *own);
      return law.force(load, state.template as<Number>());
    });
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    return in_own_state(state, [&](const auto& law, auto& own) { return law.commit(load, own); });
  }
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      return law.stored_energy(load, state.template as<Number>());
    });
  }
  template <int Dim>
  [[nodiscard]] ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      return report_of(law, load, state.template as<Number>());
    });
  }
  template <int Dim>
  [[nodiscard]] BondRelease<Dim> release_opening(const PointLoad<Dim>& load,
                                                 const State<Dim>& state) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      const auto own = state.template as<Number>();
      if constexpr (HasBond<std::decay_t<decltype(law)>, Dim>)
        return law.release_opening(load, own);
      else
        return BondRelease<Dim>{voussoir::release_opening<Dim>(law, load, own), 0, 0, {}};
    });
  }
  [[nodiscard]] bool dilates() const {
    return visit([](const auto& law) {
      if constexpr (requires { law.dilates(); })
        return law.dilates();
      else
        return false;
    });
  }
  /// Nothing where its type does not dilate.
  template <int Dim>
  [[nodiscard]] PointLift lift(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      if constexpr (HasLift<std::decay_t<decltype(law)>, Dim>)
        return law.lift(load, state.template as<Number>());
      else
        return PointLift{};
    });
  }
  /// Nothing where its type does not creep.
  template <int Dim>
  void creep(const PointLoad<Dim>& load, State<Dim>& state, double time) const {
    in_own_state(state, [&](const auto& law, auto& own) {
      if constexpr (CreepingLaw<std::decay_t<decltype(law)>, Dim>) law.creep(load, own, time);
    });
  }
  /// Infinity where its type does not creep [s].
  [[nodiscard]] double creep_time() const {
    return visit([](const auto& law) {
      if constexpr (requires { law.creep_time(); })
        return law.creep_time();
      else
        return std::numeric_limits<double>::infinity();
    });
  }
  [[nodiscard]] double joint_normal_stiffness() const {
    return visit([](const auto& law) { return law.joint_normal_stiffness(); });
  }
  [[nodiscard]] double joint_shear_stiffness() const {
    return visit([](const auto& law) { return law.joint_shear_stiffness(); });
  }

 private:
  template <int Dim, class Call>
  decltype(auto) in_own_state(State<Dim>& state, Call&& call) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      if (state.of.index() != Number)
        state.of.template emplace<Number>(state.template as<Number>());
      return call(law, *std::get_if<Number>(&state.of));
    });
  }

  std::variant<Laws...> law_;
};

/// Any of the contact laws that a rock joint may have.
using AnyJoint = AnyJointOf<CoulombJoint, MohrCoulombJoint, BartonBandisJoint, BurgersJoint>;

static_assert(ContactLaw<AnyJoint, 2> && ContactLaw<AnyJoint, 3>);
static_assert(CreepingLaw<AnyJoint, 2> && CreepingLaw<AnyJoint, 3>);

}  // namespace voussoir
