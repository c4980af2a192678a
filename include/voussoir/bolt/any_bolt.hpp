// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/bolt/curve_bolt.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/core/visit_numbered.hpp>

namespace voussoir {

/// A bolt law that is of one of several types, which is known at run time: every bolt of a model
/// may have a type of its own.
///
/// At every joint its state is that of its type; a fresh state becomes one at the first commit.
///
/// @tparam Laws  bolt laws
template <class... Laws>
class AnyBoltOf {
 public:
  using role = roles::BoltLaw;
  static constexpr const char* name = "AnyBolt";
  /// What a bolt remembers at one joint whose law is of one of several types.
  struct State {
    /// By the number of the law among `Laws`: two may remember the same type.
    std::variant<typename Laws::State...> of{};
  };

  template <class Law>
  requires(std::same_as<Law, Laws> || ...)
      AnyBoltOf(const Law& law)  // NOLINT(google-explicit-constructor): any of them is one
      : law_(law) {}

  /// The law as its type; null if it is of another.
  template <class Law>
  [[nodiscard]] const Law* as() const {
    return std::get_if<Law>(&law_);
  }
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
  [[nodiscard]] BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    return with_state(state,
                      [&](const auto& law, const auto& own) { return law.force(span, own); });
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      if (state.of.index() != Number) state.of.template emplace<Number>();
      return law.commit(span, *std::get_if<Number>(&state.of));
    });
  }
  template <int Dim>
  [[nodiscard]] BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    return visit([&](const auto& law) { return law.stiffness(span); });
  }
  template <int Dim>
  [[nodiscard]] double energy(const BoltSpan<Dim>& span, const State& state) const {
    return with_state(state,
                      [&](const auto& law, const auto& own) { return law.energy(span, own); });
  }
  /// What its type says, or what its force tells where that says nothing.
  template <int Dim>
  [[nodiscard]] BoltReport describe(const BoltSpan<Dim>& span, const State& state) const {
    return with_state(state, [&](const auto& law, const auto& own) {
      return report_of(law, span, own, false);  // whoever has committed knows whether it broke
    });
  }
  /// What its type says; if it says nothing, none.
  [[nodiscard]] std::optional<AnyBoltOf> at_joint(const BoltJoint& joint) const {
    return visit([&]<class Law>(const Law& law) -> std::optional<AnyBoltOf> {
      if constexpr (HasLawAtJoint<Law>)
        if (const auto made = law.at_joint(joint)) return AnyBoltOf(*made);
      return std::nullopt;
    });
  }

 private:
  /// Calls call(law, state) with the state of its type, a fresh one where nothing was committed.
  template <class Call>
  decltype(auto) with_state(const State& state, Call&& call) const {
    return detail::visit_numbered(law_, [&]<std::size_t Number>(const auto& law) {
      if (const auto* own = std::get_if<Number>(&state.of)) return call(law, *own);
      return call(law, std::variant_alternative_t<Number, decltype(state.of)>{});
    });
  }

  std::variant<Laws...> law_;
};

/// Any of the bolt laws.
using AnyBolt = AnyBoltOf<AxialBolt, AxialShearBolt, CurveBolt>;

static_assert(BoltLaw<AnyBolt, 2> && BoltLaw<AnyBolt, 3>);

}  // namespace voussoir
