// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// A bolt at one joint, between its anchors on either side.
template <int Dim>
struct BoltSpan {
  Vec<Dim> initial;  ///< from the first anchor to the second at installation [m]
  Vec<Dim> axis;     ///< unit vector of the bar
  Vec<Dim> motion;   ///< of the second anchor relative to the first since installation [m]
  /// Of the second body relative to the first since then, where the bar crosses the joint [m].
  /// Other than `motion` it is free of the rotation of the rock as a whole.
  Vec<Dim> jump = zeros<Vec<Dim>>();
};

/// What the bolt does at one joint.
template <int Dim>
struct BoltForce {
  Vec<Dim> pull = zeros<Vec<Dim>>();   ///< on the first anchor; the second gets the opposite [N]
  double axial = 0;                    ///< along the line of the anchors, tension positive [N]
  Vec<Dim> dowel = zeros<Vec<Dim>>();  ///< on the first body where the bar crosses the joint [N]
};

template <class Law, int Dim>
concept HasBoltState = DefaultConstructible<typename Law::State>;
/// A `State` that is a template, as that of a contact law is.
template <class Law, int Dim>
concept HasTemplateState = requires {
  typename Law::template State<Dim>;
};
template <class Law, int Dim>
concept HasBoltForce = requires(const Law law, const BoltSpan<Dim>& span,
                                const typename Law::State& state) {
  { law.force(span, state) } -> std::same_as<BoltForce<Dim>>;
};
template <class Law, int Dim>
concept HasBoltCommit = requires(const Law law, const BoltSpan<Dim>& span,
                                 typename Law::State& state) {
  { law.commit(span, state) } -> std::same_as<bool>;
};
template <class Law, int Dim>
concept HasBoltStiffness = requires(const Law law, const BoltSpan<Dim>& span) {
  { law.stiffness(span) } -> std::same_as<Stress<Dim>>;
};

/// The spring that a bolt is, at every joint it crosses. Values are per bolt, not per metre.
///
/// What the compiler cannot check: `force` reads and `commit` remembers, as for a contact law;
/// `pull` follows `motion` and `dowel` follows `jump`, in proportion; `commit` returns true when
/// the bolt broke, so that equilibrium must be sought anew; `stiffness` [N/m] is that of `pull`,
/// symmetric, not negative, and bounds the tangent stiffness near the initial span.
///
/// A `State` with a `plastic_extension` [m] tells `bolt_forces` which bolts have yielded.
///
/// Models: AxialBolt, AxialShearBolt.
template <class Law, int Dim>
concept BoltLaw =
    Fills<Law, roles::BoltLaw> && HasName<Law> && Copyable<Law> && HasBoltState<Law, Dim> &&
    HasBoltForce<Law, Dim> && HasBoltCommit<Law, Dim> && HasBoltStiffness<Law, Dim>;

template <class Law, int Dim>
consteval bool explain_bolt_law() {
  static_assert(Fills<Law, roles::BoltLaw>,
                "bolt law: add `using role = voussoir::roles::BoltLaw`");
  static_assert(HasName<Law>, "bolt law: add `static constexpr const char* name` for the log");
  static_assert(Copyable<Law>, "bolt law: must be copyable");
  static_assert(!HasTemplateState<Law, Dim>,
                "bolt law: `State` must be no template: `struct State`");
  static_assert(HasBoltState<Law, Dim>,
                "bolt law: add `struct State` for what a bolt remembers at a joint");
  static_assert(HasBoltForce<Law, Dim>,
                "bolt law: add `BoltForce<Dim> force(const BoltSpan<Dim>&, const State&) const`");
  static_assert(HasBoltCommit<Law, Dim>,
                "bolt law: add `bool commit(const BoltSpan<Dim>&, State&) const` (true: it broke)");
  static_assert(HasBoltStiffness<Law, Dim>,
                "bolt law: add `Stress<Dim> stiffness(const BoltSpan<Dim>&) const` [N/m]");
  return true;
}

}  // namespace voussoir
