// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <voussoir/core/lane_pair.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Displacement of body b relative to body a at one contact point, since the in-situ state.
template <int Dim>
struct PointMotion {
  double opening;     ///< along the normal from a to b, positive when the joint opens [m]
  Vec<Dim - 1> slip;  ///< along the tangents [m]
};

/// Force at one contact point, on body b (a gets the opposite).
template <int Dim>
struct PointForce {
  double normal = 0;                                ///< compression positive [N]
  Vec<Dim - 1> tangential = zeros<Vec<Dim - 1>>();  ///< along the tangents [N]
};

/// How far the bond of a joint reaches on the side of one of its points: what has cracked from that
/// side is beyond a straight front.
///
/// Places are told along the joint as in `PressedPart`: in radii of gyration from its middle. In
/// 2-D the front is at `reach` towards the point; in 3-D it is the line n . x = reach whose normal
/// is turned by the angle `slant` from the axis towards the point.
template <int Dim>
struct BondFront {
  double reach = std::numeric_limits<double>::infinity();  ///< infinity: nothing has cracked [-]
  double slant = 0;                                        ///< 3-D, -pi/4 to pi/4 [rad]
};
template <>
struct BondFront<2> {
  double reach = std::numeric_limits<double>::infinity();
};

/// What holds a joint together against tension, as one of its points has it.
template <int Dim>
struct PointBond {
  double area = 1;  ///< what is left of it over the whole length or area of the joint [-]
  /// How far it stretches before it breaks, the joint's own over all its points [m].
  double stretch = std::numeric_limits<double>::infinity();
  BondFront<Dim> front;
};

/// What a law with a bond says of the opening of a point, since the in-situ state.
template <int Dim>
struct BondRelease {
  double opening;      ///< at which the normal spring carries nothing [m]
  double stretch = 0;  ///< by which it may open farther before the bond breaks [m]; 0: no bond
  double area = 1;     ///< see `PointBond`, at the last commit [-]
  BondFront<Dim> front;
};

/// A contact point as a law sees it: the length (2-D) or area (3-D) it stands for [m], [m^2], the
/// force in the in-situ state, and the motion since.
///
/// Of a joint that is open from an edge on, all this is told of the part that is pressed or bonded
/// (`PressedPart`): its points stand for that part alone.
template <int Dim>
struct PointLoad {
  double weight;
  PointForce<Dim> initial;
  PointMotion<Dim> motion;
  double whole_over_part = 1;  ///< weight of the whole joint over that of its pressed part [-]
  /// Of a law that says how far its bond holds: see `release_opening`.
  PointBond<Dim> bond = {};
  /// Of a law that says how it dilates: by how much slip has lifted the whole joint since the last
  /// commit [m]. `motion.opening` is less by that. < 0: nothing is said, the point lifts by itself.
  double lift = -1;

  [[nodiscard]] bool is_lifted() const { return lift > 0; }
  /// How far it has parted, lifted or not [m].
  [[nodiscard]] double parted() const { return motion.opening + (lift > 0 ? lift : 0.0); }
  /// What it is, nothing having moved, once the history has been brought up to date: that knows of
  /// the lift.
  [[nodiscard]] PointLoad committed() const {
    PointLoad now = *this;
    now.motion.opening = parted();
    if (lift > 0) now.lift = 0;
    return now;
  }
};

/// How far a point would lift a joint by the slip since the last commit.
struct PointLift {
  double weight = 0;  ///< of the point in the mean over the joint, >= 0 [N]
  double lift = 0;    ///< >= 0 [m]
};

/// Two contact points in 2-D side by side, as `PointLoad` and `PointForce` have one.
struct PairLoad {
  LanePair weight;
  LanePair initial_normal, initial_shear;
  LanePair opening, slip;
};
struct PairForce {
  LanePair normal, shear;
};

/// What a contact point does, and what has become of it, in words that all laws share: all that
/// measurements, tables and pictures read of a law.
struct ContactReport {
  double normal = 0;         ///< force, compression positive [N]
  double shear = 0;          ///< magnitude of the force along the tangents [N]
  double opening = 0;        ///< since the in-situ state, positive when the joint opens [m]
  double plastic_slip = 0;   ///< slip that would stay if the shear were let go, magnitude [m]
  double damage = 0;         ///< part of its bond or roughness that is used up, 0 to 1 [-]
  bool is_open = false;      ///< it carries nothing across
  bool is_slipping = false;  ///< its shear is at its strength: it slips on without more
};

template <class Law, int Dim>
concept HasContactState = DefaultConstructible<typename Law::template State<Dim>>;
/// A `State` that is no template: that of a point in 2-D cannot be that of one in 3-D.
template <class Law>
concept HasPlainState = requires {
  typename Law::State;
};
template <class Law, int Dim>
concept HasContactForce = requires(const Law law, const PointLoad<Dim>& load,
                                   const typename Law::template State<Dim>& state) {
  { law.force(load, state) } -> std::same_as<PointForce<Dim>>;
};
template <class Law, int Dim>
concept HasContactCommit = requires(const Law law, const PointLoad<Dim>& load,
                                    typename Law::template State<Dim>& state) {
  { law.commit(load, state) } -> std::same_as<double>;
};
template <class Law, int Dim>
concept HasStoredEnergy = requires(const Law law, const PointLoad<Dim>& load,
                                   const typename Law::template State<Dim>& state) {
  { law.stored_energy(load, state) } -> std::same_as<double>;
};
/// Optional: the law says itself what tables and pictures show of a point. Else `report_of` says
/// what follows from its force.
template <class Law, int Dim>
concept HasContactReport = requires(const Law law, const PointLoad<Dim>& load,
                                    const typename Law::template State<Dim>& state) {
  { law.describe(load, state) } -> std::same_as<ContactReport>;
};
/// Optional, in 2-D: the forces of two points at once, bit for bit those of `force`. For a law that
/// has no cases to tell apart but by larger and smaller; a fifth less time for all forces.
template <class Law>
concept HasPairForce = requires(const Law law, const PairLoad& load,
                                const typename Law::template State<2>* two) {
  { law.pair_force(load, two) } -> std::same_as<PairForce>;
};
template <class Law>
concept HasJointStiffness = requires(const Law law) {
  { law.joint_normal_stiffness() } -> std::same_as<double>;
  { law.joint_shear_stiffness() } -> std::same_as<double>;
};

/// Optional: the law says itself at which opening a point lets go, since the in-situ state; with a
/// `BondRelease` also how far a bond holds beyond it.
template <class Law, int Dim>
concept HasBond = requires(const Law law, const PointLoad<Dim>& load,
                           const typename Law::template State<Dim>& state) {
  { law.release_opening(load, state) } -> std::same_as<BondRelease<Dim>>;
};
template <class Law, int Dim>
concept HasRelease = HasBond<Law, Dim> || requires(const Law law, const PointLoad<Dim>& load,
                                                   const typename Law::template State<Dim>& state) {
  { law.release_opening(load, state) } -> std::same_as<double>;
};

/// Optional, for a law whose slip lifts the joint (dilation): a contact then has one lift for all
/// of its points (`detail::press`). `dilates()`: whether it ever does; `lift`: see `PointLift`,
/// with `PointLoad::lift` as given and no more.
template <class Law, int Dim>
concept HasLift = requires(const Law law, const PointLoad<Dim>& load,
                           const typename Law::template State<Dim>& state) {
  { law.dilates() } -> std::same_as<bool>;
  { law.lift(load, state) } -> std::same_as<PointLift>;
};

[[nodiscard]] constexpr double opening_of(double release) { return release; }
template <int Dim>
[[nodiscard]] constexpr double opening_of(const BondRelease<Dim>& release) {
  return release.opening;
}

/// The opening at which a point carries nothing any more [m]. Of a law that does not say: that of a
/// linear normal spring.
/// @return  a number, or a `BondRelease`
template <int Dim, class Law>
[[nodiscard]] auto release_opening(const Law& law, const PointLoad<Dim>& load,
                                   const typename Law::template State<Dim>& state) {
  if constexpr (HasRelease<Law, Dim>)
    return law.release_opening(load, state);
  else
    return load.initial.normal / (law.joint_normal_stiffness() * load.weight);
}

namespace detail {

/// What a law says of the points of one contact.
/// @tparam StateOf  state_of(k) is what it remembers of point k
template <int Dim, class Law, class StateOf>
class PointsOf {
 public:
  PointsOf(const Law& law, const StateOf& state_of) : law_(law), state_of_(state_of) {}

  /// See `release_opening`.
  [[nodiscard]] auto release(std::size_t k, const PointLoad<Dim>& load) const {
    return release_opening<Dim>(law_, load, state_of_(k));
  }
  [[nodiscard]] bool dilates() const {
    if constexpr (HasLift<Law, Dim>)
      return law_.dilates();
    else
      return false;
  }
  [[nodiscard]] PointLift lift(std::size_t k, const PointLoad<Dim>& load) const {
    if constexpr (HasLift<Law, Dim>)
      return law_.lift(load, state_of_(k));
    else
      return {};
  }

 private:
  const Law& law_;
  const StateOf& state_of_;
};

}  // namespace detail

/// Whether a point that nothing presses in situ carries tension.
template <int Dim, class Law>
[[nodiscard]] bool holds_tension(const Law& law) {
  const auto release =
      release_opening<Dim>(law, PointLoad<Dim>{1.0, {}, {}}, typename Law::template State<Dim>{});
  if constexpr (std::same_as<decltype(release), const double>)
    return release > 0;
  else
    return release.opening > 0 || release.stretch > 0;
}

/// Whether a point that nothing presses, in situ or since, holds shear: it is bonded.
template <int Dim, class Law>
[[nodiscard]] bool holds_shear(const Law& law) {
  PointLoad<Dim> load{1.0, {}, {0, zeros<Vec<Dim - 1>>()}};
  load.motion.slip[0] = 1e-9;  // shorter than any bond bears
  return law.force(load, typename Law::template State<Dim>{}).tangential.norm() > 0;
}

/// Turns the motion at one contact point into a force. Reading and remembering are separate.
///
/// What the compiler cannot check, and a law must still honour (`check_law` tries it,
/// contact/check_law.hpp):
///  - `force` depends on its arguments alone and is continuous in the motion;
///  - `commit` sets the state so that `force` at the same motion gives the same force as before,
///    and returns the energy that slip, damage and the like have used up since the last commit [J];
///  - `stored_energy` is what the point gives back if its force is let go elastically [J];
///  - with zero motion and a fresh state, `force` returns the initial force where that is
///  admissible;
///  - no tangent stiffness exceeds weight * joint stiffness: time steps are derived from it.
///
/// A joint that opens from an edge on hands the law points of its pressed part, whose weights
/// change with it. A law whose shear spring shall make no energy as it closes again remembers how
/// much was pressed when its history was last brought up to date (`ShearSpring`).
///
/// Optional: `ContactReport describe(const PointLoad<Dim>&, const State<Dim>&) const`, for a law
/// that has damage to tell of, or whose shear stiffness is not one number (see
/// `report_from_force`); `double release_opening(const PointLoad<Dim>&, const State<Dim>&) const`,
/// for one whose normal force is not linear; the same with a `BondRelease<Dim>` for one that holds
/// tension: it then finds in `PointLoad::bond` what of the bond is left, and remembers it;
/// `bool dilates() const` and `PointLift lift(const PointLoad<Dim>&, const State<Dim>&) const` for
/// one that dilates: it then finds in `PointLoad::lift` by how much the joint has lifted.
///
/// Models: CoulombJoint (rock joints, lining interface), MohrCoulombJoint, BartonBandisJoint,
/// BurgersJoint, SmoothWall (edge of the domain).
template <class Law, int Dim>
concept ContactLaw = Fills<Law, roles::ContactLaw> && HasName<Law> && Copyable<Law> &&
    HasContactState<Law, Dim> && HasContactForce<Law, Dim> && HasContactCommit<Law, Dim> &&
    HasStoredEnergy<Law, Dim> && HasJointStiffness<Law> &&
    (HasContactReport<Law, Dim> || !NamesDescribe<Law>);

/// A contact law whose joints creep: optional, for `Solver::creep`.
///
/// What the compiler cannot check: `creep` changes the state as time passes under the force of the
/// moment; steps well below `creep_time` are harmless.
///
/// Models: BurgersJoint.
template <class Law, int Dim>
concept CreepingLaw = ContactLaw<Law, Dim> &&
    requires(const Law law, const PointLoad<Dim>& load, typename Law::template State<Dim>& state,
             double time) {
  { law.creep(load, state, time) } -> std::same_as<void>;
  { law.creep_time() } -> std::same_as<double>;
};

template <class Law, int Dim>
consteval bool explain_contact_law() {
  static_assert(Fills<Law, roles::ContactLaw>,
                "contact law: add `using role = voussoir::roles::ContactLaw`");
  static_assert(HasName<Law>, "contact law: add `static constexpr const char* name` for the log");
  static_assert(Copyable<Law>, "contact law: must be copyable");
  static_assert(!HasPlainState<Law>,
                "contact law: `State` must be a template: `template <int Dim> struct State`");
  static_assert(HasContactState<Law, Dim>,
                "contact law: add `template <int Dim> struct State` for what a point remembers");
  static_assert(HasContactForce<Law, Dim>,
                "contact law: add `PointForce<Dim> force(const PointLoad<Dim>&, const State<Dim>&) "
                "const`");
  static_assert(HasContactCommit<Law, Dim>,
                "contact law: add `double commit(const PointLoad<Dim>&, State<Dim>&) const` (the "
                "energy used up [J])");
  static_assert(HasStoredEnergy<Law, Dim>,
                "contact law: add `double stored_energy(const PointLoad<Dim>&, const State<Dim>&) "
                "const` [J]");
  static_assert(HasJointStiffness<Law>,
                "contact law: add `double joint_normal_stiffness() const` and `double "
                "joint_shear_stiffness() const` [Pa/m]");
  static_assert(
      HasContactReport<Law, Dim> || !NamesDescribe<Law>,
      "contact law: `describe` must be `ContactReport describe(const PointLoad<Dim>&, const "
      "State<Dim>&) const`, or be left out");
  return true;
}

/// Whether a little more slip along its shear raises that by less than half of what a stiffness
/// says.
/// @param shear_stiffness  of the point as it is loaded, per area [Pa/m]
template <int Dim, class Law>
[[nodiscard]] bool slips_on(const Law& law, PointLoad<Dim> load,
                            const typename Law::template State<Dim>& state,
                            double shear_stiffness) {
  const PointForce<Dim> now = law.force(load, state);
  if (now.normal == 0 && now.tangential.squaredNorm() == 0) return false;  // it is open
  const double shear = now.tangential.norm();
  Vec<Dim - 1> along = zeros<Vec<Dim - 1>>();
  along[0] = 1;
  if (shear > 0) along = now.tangential / shear;
  // Long enough for forces of 1e12 times what the step makes, short beside any slip that matters.
  constexpr double step = 1e-9;
  load.motion.slip -= step * along;  // the force on b holds b back
  const double more = law.force(load, state).tangential.dot(along) - shear;
  return more <= 0.5 * shear_stiffness * load.weight * step;
}

/// What the force of a point alone tells, for a law whose shear spring has the one stiffness that
/// it gives:
///
///   plastic slip  q = s + (T - T0) / (k_s w),  the slip that this spring does not account for
///
/// No damage; a frictionless law (k_s = 0) keeps all its slip.
template <int Dim, class Law>
[[nodiscard]] ContactReport report_from_force(const Law& law, const PointLoad<Dim>& load,
                                              const typename Law::template State<Dim>& state) {
  const PointForce<Dim> force = law.force(load, state);
  const double stiffness = law.joint_shear_stiffness() * load.weight;
  Vec<Dim - 1> plastic = load.motion.slip;
  if (stiffness > 0) plastic += (force.tangential - load.initial.tangential) / stiffness;
  return {.normal = force.normal,
          .shear = force.tangential.norm(),
          .opening = load.parted(),
          .plastic_slip = plastic.norm(),
          .is_open = force.normal == 0,
          .is_slipping = slips_on(law, load, state, law.joint_shear_stiffness())};
}

/// What the law says of a point, or what its force tells where it says nothing.
template <int Dim, class Law>
[[nodiscard]] ContactReport report_of(const Law& law, const PointLoad<Dim>& load,
                                      const typename Law::template State<Dim>& state) {
  if constexpr (HasContactReport<Law, Dim>)
    return law.describe(load, state);
  else
    return report_from_force(law, load, state);
}

}  // namespace voussoir
