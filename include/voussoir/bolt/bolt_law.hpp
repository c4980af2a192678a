// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <optional>
#include <voussoir/core/errors.hpp>
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

/// Where a bolt crosses a joint: its length on either side [m], towards head and tip.
struct BoltJoint {
  double before, after;
};

/// What the bolt does at one joint.
template <int Dim>
struct BoltForce {
  Vec<Dim> pull = zeros<Vec<Dim>>();   ///< on the first anchor; the second gets the opposite [N]
  double axial = 0;                    ///< along the line of the anchors, tension positive [N]
  Vec<Dim> dowel = zeros<Vec<Dim>>();  ///< on the first body where the bar crosses the joint [N]
};

/// Bounds of the springs that a bolt is at one joint, each symmetric and not negative [N/m].
template <int Dim>
struct BoltStiffness {
  Stress<Dim> pull;                         ///< of `BoltForce::pull` to `BoltSpan::motion`
  Stress<Dim> dowel = diagonal_of<Dim>(0);  ///< of `BoltForce::dowel` to `BoltSpan::jump`
};

/// What a bolt does at one joint, and what has become of it there, in words that all laws share:
/// all that measurements, tables and pictures read of a law. Values of one bolt, not per metre.
struct BoltReport {
  double axial = 0;               ///< force along the line of the anchors, tension positive [N]
  double shear = 0;               ///< force across the bar at the joint (dowel), magnitude [N]
  double plastic_extension = 0;   ///< that would stay if it were let go [m]
  double plastic_shear_slip = 0;  ///< the same across the bar [m]
  bool is_yielding = false;       ///< its tension is at its limit: it gives on without more
  bool is_broken = false;         ///< it holds nothing any more at this joint

  [[nodiscard]] bool has_yielded() const {
    return is_yielding || plastic_extension > 0 || plastic_shear_slip > 0;
  }
};

template <class Law, int Dim>
concept HasBoltState = DefaultConstructible<typename Law::State> && Copyable<typename Law::State>;
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
  { law.stiffness(span) } -> std::same_as<BoltStiffness<Dim>>;
};
template <class Law, int Dim>
concept HasBoltEnergy = requires(const Law law, const BoltSpan<Dim>& span,
                                 const typename Law::State& state) {
  { law.energy(span, state) } -> std::same_as<double>;
};
/// Optional: the law says itself what tables and pictures show of a bolt. Else `report_of` says
/// what follows from its force.
template <class Law, int Dim>
concept HasBoltReport = requires(const Law law, const BoltSpan<Dim>& span,
                                 const typename Law::State& state) {
  { law.describe(span, state) } -> std::same_as<BoltReport>;
};

/// Optional: the law is another one at every joint, by how much of the bolt is on either side; none
/// returned: it is the same.
template <class Law>
concept HasLawAtJoint = requires(const Law law, const BoltJoint& joint) {
  { law.at_joint(joint) } -> std::same_as<std::optional<Law>>;
};

/// The spring that a bolt is, at every joint it crosses. Values are per bolt, not per metre.
///
/// What the compiler cannot check:
///  - `force` reads and `commit` remembers, as for a contact law; `pull` follows `motion` and
///    `dowel` follows `jump`; a span that is turned as a whole has the force turned with it;
///  - `commit` returns true when the bolt broke, so that equilibrium must be sought anew;
///  - `stiffness` bounds the tangents of all its springs near the initial span, the dowel included:
///    the elastic matrix and the stable time step have nothing else;
///  - `energy` [J] is the work done on the bolt, what it holds and what it has lost to yield and
///    rupture alike, counted from anywhere: its change is that of pull . motion + dowel . jump,
///    and a commit does not change it. The energy balance of a run books it.
/// `check_law` (bolt/check_bolt_law.hpp) tries all of this.
///
/// Optional: `BoltReport describe(const BoltSpan<Dim>&, const State&) const`, for a law that
/// remembers what it has yielded (see `report_from_force`); `std::optional<Law> at_joint(const
/// BoltJoint&) const`, for a law that depends on how much of the bolt is on either side.
///
/// Models: AxialBolt, AxialShearBolt, CurveBolt; AnyBolt (one of them, known at run time).
template <class Law, int Dim>
concept BoltLaw = Fills<Law, roles::BoltLaw> && HasName<Law> && Copyable<Law> &&
    HasBoltState<Law, Dim> && HasBoltForce<Law, Dim> && HasBoltCommit<Law, Dim> &&
    HasBoltStiffness<Law, Dim> && HasBoltEnergy<Law, Dim> &&
    (HasBoltReport<Law, Dim> || !NamesDescribe<Law>);

template <class Law, int Dim>
consteval bool explain_bolt_law() {
  static_assert(Fills<Law, roles::BoltLaw>,
                "bolt law: add `using role = voussoir::roles::BoltLaw`");
  static_assert(HasName<Law>, "bolt law: add `static constexpr const char* name` for the log");
  static_assert(Copyable<Law>, "bolt law: must be copyable");
  static_assert(!HasTemplateState<Law, Dim>,
                "bolt law: `State` must be no template: `struct State`");
  static_assert(HasBoltState<Law, Dim>,
                "bolt law: add `struct State` for what a bolt remembers at a joint; it is copied "
                "and begins as `State{}`");
  static_assert(HasBoltForce<Law, Dim>,
                "bolt law: add `BoltForce<Dim> force(const BoltSpan<Dim>&, const State&) const`");
  static_assert(HasBoltCommit<Law, Dim>,
                "bolt law: add `bool commit(const BoltSpan<Dim>&, State&) const` (true: it broke)");
  static_assert(HasBoltStiffness<Law, Dim>,
                "bolt law: add `BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const` [N/m], "
                "of the pull and of the dowel");
  static_assert(HasBoltEnergy<Law, Dim>,
                "bolt law: add `double energy(const BoltSpan<Dim>&, const State&) const` [J], what "
                "it holds and has lost");
  static_assert(
      HasBoltReport<Law, Dim> || !NamesDescribe<Law>,
      "bolt law: `describe` must be `BoltReport describe(const BoltSpan<Dim>&, const State&) "
      "const`, or be left out");
  return true;
}

/// Change of the distance between the anchors since installation [m]. Anchors on the joint have no
/// distance that could change: what opens the joint stretches them.
template <int Dim>
[[nodiscard]] double extension_of(const BoltSpan<Dim>& span) {
  const double initial = span.initial.norm();
  return initial > 0 ? (span.initial + span.motion).norm() - initial : span.axis.dot(span.motion);
}

/// What the force of a bolt alone tells: that it yields, where pulling its anchors apart a little
/// further raises the force by less than half of what its stiffness says. What it has yielded
/// before is its secret.
template <int Dim, class Law>
[[nodiscard]] BoltReport report_from_force(const Law& law, const BoltSpan<Dim>& span,
                                           const typename Law::State& state) {
  const BoltForce<Dim> force = law.force(span, state);
  BoltReport report{.axial = force.axial, .shear = force.dowel.norm()};
  if (!(force.axial > 0)) return report;  // slack, pressed or broken
  const double pull = force.pull.norm();
  const Vec<Dim> along = pull > 0 ? Vec<Dim>(force.pull / pull) : span.axis;
  constexpr double step = 1e-8;
  BoltSpan<Dim> further = span;
  further.motion += step * along;
  const double stiffness = span.axis.dot(law.stiffness(span).pull * span.axis);
  VOUSSOIR_ASSERT(stiffness >= 0, "a bolt that is pulled pulls back");
  report.is_yielding = law.force(further, state).axial - force.axial < 0.5 * stiffness * step;
  return report;
}

/// What the law says of a bolt, or what its force tells where it says nothing.
/// @param is_broken  a commit has said so
template <int Dim, class Law>
[[nodiscard]] BoltReport report_of(const Law& law, const BoltSpan<Dim>& span,
                                   const typename Law::State& state, bool is_broken) {
  BoltReport report;
  if constexpr (HasBoltReport<Law, Dim>)
    report = law.describe(span, state);
  else
    report = report_from_force(law, span, state);
  report.is_broken = report.is_broken || is_broken;
  return report;
}

}  // namespace voussoir
