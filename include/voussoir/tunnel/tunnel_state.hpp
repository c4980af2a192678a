// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/tunnel/support_forces.hpp>

namespace voussoir {

// All that tables and pictures show of a tunnel, in plain values, whatever its models and whether
// it is at rest or moves. Nothing of it is a member of a particular law.

/// A block of the rock.
template <int Dim>
struct BlockState {
  Vec<Dim> displacement;  ///< of its centre since the in-situ state [m]
  bool is_gone;           ///< detached at rest, or taken out of a run
  /// From where it was sliced to where it is to be drawn: at rest it stays, for what moves there is
  /// too small to be seen.
  Pose<Dim> motion;
};

/// A contact of two blocks.
template <int Dim>
struct JointState {
  int a, b;
  Vec<Dim> centre, normal;  ///< normal from a to b [m], [-]
  double measure;           ///< length (2-D) or area (3-D) [m], [m^2]
  /// Of all its points: forces are sums; opening, slip and damage are the largest; it is open where
  /// all points are, and slips where one does.
  ContactReport report;
};

/// A tunnel: its rock and what is installed in it.
template <class Geometry>
struct TunnelState {
  static constexpr int dim = Geometry::dim;
  std::vector<BlockState<dim>> blocks;     ///< as in the rock mass
  std::vector<JointState<dim>> joints;     ///< contacts of rock with rock
  std::vector<CrossingForce> bolts;        ///< where they cross joints
  std::vector<MemberForces<dim>> members;  ///< of the lining
  std::vector<LiningForce> lining;         ///< of all of them node by node, in 2-D
  std::vector<LiningLink> links{};         ///< the members between these
  std::vector<double> thicknesses{};       ///< of the linings, at rest [m]
  std::vector<FootForce<dim>> feet;        ///< of linings, at rest
  /// Holes in the wall that linings fill, at rest; of one that is lost none.
  std::vector<typename Geometry::Shape> fills{};
};

namespace detail {

/// The report of a contact, point by point.
class WholeContact {
 public:
  void add(const ContactReport& point) {
    is_open_ = is_open_ && point.is_open;
    sum_.normal += point.normal;
    sum_.shear += point.shear;
    sum_.opening = is_first_ ? point.opening : std::max(sum_.opening, point.opening);
    sum_.plastic_slip = std::max(sum_.plastic_slip, point.plastic_slip);
    sum_.damage = std::max(sum_.damage, point.damage);
    sum_.is_slipping = sum_.is_slipping || point.is_slipping;
    is_first_ = false;
  }
  [[nodiscard]] ContactReport report() const {
    ContactReport whole = sum_;
    whole.is_open = is_open_;
    return whole;
  }

 private:
  ContactReport sum_;
  bool is_open_ = true, is_first_ = true;
};

}  // namespace detail

/// All contacts of rock with rock, in their places on body a as it lay in the in-situ state.
template <class Solver, int Dim = Solver::SystemType::dim>
[[nodiscard]] std::vector<JointState<Dim>> joint_states(const Solver& solver) {
  const auto& system = solver.system();
  const auto& joints = system.joints;
  std::vector<JointState<Dim>> states;
  states.reserve(joints.contacts().size());
  std::vector<detail::WholeContact> wholes(joints.contacts().size());
  for (const auto& c : joints.contacts())
    states.push_back({c.a, c.b, system.body(c.a).centre + c.arm_a, c.normal, 0, {}});
  const auto* first = joints.contacts().data();
  joints.visit(system.displacement.data(),
               [&](const auto& c, const auto& point, const auto& load, const auto&) {
                 const auto k = static_cast<std::size_t>(&c - first);
                 VOUSSOIR_ASSERT(k < states.size() && point.weight >= 0,
                                 "a contact point stands for a part of its contact");
                 states[k].measure += load.weight * load.whole_over_part;
                 wholes[k].add(report_of(joints.law_of(c), load, point.state));
               });
  for (std::size_t k = 0; k < states.size(); ++k) {
    states[k].report = wholes[k].report();
    const auto& c = joints.contacts()[k];
    for (int i = c.first; i < c.last(); ++i) {  // of the pressed part alone the report tells above
      const auto p = joints.points().place(static_cast<std::size_t>(i));
      const double opening = c.motion(p, c.offset_of(p), system.displacement.data()).opening;
      states[k].report.opening = std::max(states[k].report.opening, opening);
    }
  }
  return states;
}

/// The same of rock that moves, where the contacts are now.
template <int Dim, class... Parts>
[[nodiscard]] std::vector<JointState<Dim>> joint_states(const Dynamics<Dim, Parts...>& run) {
  std::vector<JointState<Dim>> states;
  const auto& joints = run.joints();
  states.reserve(joints.contacts().size());
  for (const auto& c : joints.contacts()) {
    const auto at = c.place(run.body(c.a).pose, run.body(c.b).pose);
    const Pose<Dim> a = run.pose(c.a), b = run.pose(c.b);
    JointState<Dim> state{c.a, c.b, zeros<Vec<Dim>>(), column(a.rotation * c.frame, 0), 0, {}};
    detail::WholeContact whole;
    joints.visit_loads(c, at, [&](std::size_t, const auto& p, const PointLoad<Dim>& load) {
      whole.add(report_of(joints.law_of(c), load, p.state));
    });
    state.report = whole.report();
    for (int k = c.first; k < c.last; ++k) {
      const auto& p = joints.points()[static_cast<std::size_t>(k)];
      VOUSSOIR_ASSERT(p.weight >= 0, "a contact point stands for a part of its contact");
      state.centre += p.weight * b(p.place);
      state.measure += p.weight;
      state.report.opening = std::max(state.report.opening, p.motion(at).opening);
    }
    if (state.measure > 0) state.centre /= state.measure;
    states.push_back(state);
  }
  return states;
}

/// A tunnel at rest.
template <class Solver, class Geometry = typename Solver::SystemType::GeometryType>
[[nodiscard]] TunnelState<Geometry> state_of(const Solver& solver) {
  TunnelState<Geometry> state;
  const auto& system = solver.system();
  for (std::size_t b = 0; b < solver.mass().bodies.size(); ++b) {
    const auto& body = system.body(static_cast<int>(b));
    state.blocks.push_back(
        {solver.displacement_of(static_cast<int>(b), body.centre), !body.movable, {}});
  }
  state.joints = joint_states(solver);
  state.bolts = bolt_forces(solver);
  state.members = lining_members(solver);
  state.feet = foot_forces(solver);
  if constexpr (Geometry::dim == 2) {
    const detail::LiningNodes nodes = detail::lining_nodes(solver);
    state.lining = detail::lining_forces(solver, nodes);
    state.links = nodes.links();
  }
  for (const auto& lining : system.linings) {
    state.thicknesses.push_back(lining.thickness);
    for (const auto& fill : lining.fills)
      if (system.body(lining.first + fill.node).movable) state.fills.push_back(fill.shape);
  }
  return state;
}

namespace detail {

/// The supports of a run, as they are given.
template <class Geometry, class Run>
class SupportsInMotion {
 public:
  static constexpr int dim = Geometry::dim;

  SupportsInMotion(const Run& run, TunnelState<Geometry>& state) : run_(run), state_(state) {}

  template <class Law>
  void add(const BoltSet<dim, Law>& bolts) {
    for (const CrossingForce& c : bolt_forces(run_, bolts)) state_.bolts.push_back(c);
  }
  void add(const LiningMembers<Geometry>& lining) { linings_.push_back(&lining); }
  void add(const LiningJoints<Geometry>& joints) { joints_.push_back(&joints); }
  /// All have been given.
  void finish() {
    for (const auto* lining : linings_) add_members(*lining);
    for (const auto* joints : joints_) add_members(*joints);
    if constexpr (dim == 2) {
      const LiningNodes nodes(linings_, joints_);
      state_.lining = lining_forces_in_motion(run_, nodes);
      state_.links = nodes.links();
    }
  }

 private:
  template <class Members>
  void add_members(const Members& members) {
    for (auto member : lining_members(run_, members)) state_.members.push_back(member);
    const std::size_t first = state_.members.size() - members.members().size();
    for (std::size_t k = 0; k < members.members().size(); ++k) {
      const auto& e = members.members()[k];
      int number = -1;
      for (const auto* lining : linings_) number += std::max(e.i, e.j) >= lining->first_node();
      state_.members[first + k].lining = number;
    }
  }

  const Run& run_;
  TunnelState<Geometry>& state_;
  std::vector<const LiningMembers<Geometry>*> linings_;
  std::vector<const LiningJoints<Geometry>*> joints_;
};

}  // namespace detail

/// A tunnel whose blocks move.
/// @param mass      from which the run was made: its body b is body b of the run
/// @param supports  what `add_bolts` and `add_lining` gave, if anything; linings in the order of
///                  their installation, and in a tunnel that was set in motion the `LiningJoints`
///                  between them
template <class Geometry, class... Parts, class... Supports>
[[nodiscard]] TunnelState<Geometry> state_of(const Dynamics<Geometry::dim, Parts...>& run,
                                             const RockMass<Geometry>& mass,
                                             const Supports&... supports) {
  TunnelState<Geometry> state;
  for (std::size_t k = 0; k < mass.bodies.size(); ++k) {
    const int b = static_cast<int>(k);
    state.blocks.push_back(
        {run.position(b) - run.home(b).position, run.body(b).is_gone, run.motion(b)});
  }
  state.joints = joint_states(run);
  detail::SupportsInMotion<Geometry, Dynamics<Geometry::dim, Parts...>> given(run, state);
  (given.add(supports), ...);
  given.finish();
  return state;
}

}  // namespace voussoir
