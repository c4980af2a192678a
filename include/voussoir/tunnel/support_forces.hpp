// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/lining_feet.hpp>
#include <voussoir/model/lining_members.hpp>

namespace voussoir {

// What bolts and lining carry, read in the same words at rest (from a solver) and in motion (from a
// run and the support that `add_bolts` or `add_lining` gave).

/// A bolt where it crosses a joint.
struct CrossingForce {
  int bolt;
  double position;    ///< from the head [m]
  double extension;   ///< of the distance between the anchors since installation [m]
  BoltReport report;  ///< what its law says of it there
};

/// All bolts of a solver, as they were installed.
template <class Solver>
[[nodiscard]] std::vector<typename Solver::Geometry::Line> bars_of(const Solver& solver) {
  std::vector<typename Solver::Geometry::Line> bars;
  for (const auto& bolt : solver.installed_bolts()) bars.push_back(bolt.bar);
  return bars;
}

/// In the order of bolts and, along each, from head to tip.
template <class Solver>
[[nodiscard]] std::vector<CrossingForce> bolt_forces(const Solver& solver) {
  std::vector<CrossingForce> forces;
  const auto& system = solver.system();
  const double* u = system.displacement.data();
  if (const auto* bolts = solver.bolts())
    for (const auto& spring : bolts->springs()) {
      const auto span = spring.span_at(u);
      forces.push_back({spring.bolt, spring.position, extension_of(span),
                        spring.report(bolts->law_of(spring), span)});
    }
  return forces;
}

/// The same of bolts in rock that moves.
template <class Run, int Dim, class Law>
[[nodiscard]] std::vector<CrossingForce> bolt_forces(const Run& run,
                                                     const BoltSet<Dim, Law>& bolts) {
  std::vector<CrossingForce> forces;
  for (const auto& spring : bolts.springs()) {
    const auto span = spring.span_at(run.pose(spring.a), run.pose(spring.b));
    forces.push_back({spring.bolt, spring.position, extension_of(span),
                      spring.report(bolts.law_of(spring), span)});
  }
  return forces;
}

/// Largest tension of every bolt [N]; 0 for a bolt that crosses no joint.
[[nodiscard]] inline std::vector<double> largest_bolt_forces(
    const std::vector<CrossingForce>& crossings, int bolt_count) {
  std::vector<double> largest(static_cast<std::size_t>(bolt_count), 0.0);
  for (const CrossingForce& c : crossings) {
    VOUSSOIR_ASSERT(detail::is_index(c.bolt, bolt_count), "a crossing is of a bolt");
    double& most = largest[static_cast<std::size_t>(c.bolt)];
    most = std::max(most, c.report.axial);
  }
  return largest;
}
template <class Solver>
[[nodiscard]] std::vector<double> largest_bolt_forces(const Solver& solver) {
  return largest_bolt_forces(bolt_forces(solver), solver.bolt_count());
}

/// What a foot of a lining bears, in 2-D per metre of tunnel.
template <int Dim>
struct FootForce {
  Vec<Dim> place;      ///< where it was installed, in the in-situ state [m]
  Vec<Dim> direction;  ///< from the lining into the rock, a unit vector
  double width;        ///< across the lining [m]
  double bearing;      ///< on the rock, compression [N]
  double shear;        ///< along its base, magnitude [N]
  double utilisation;  ///< bearing pressure over bearing strength, 0 to 1 [-]; NaN: it has none
  double settlement;   ///< all of it, elastic and not [m]
  double plastic_settlement;  ///< the part that would stay if it were let go [m]

  [[nodiscard]] bool has_yielded() const {
    return plastic_settlement > 0 || utilisation >= 1 - 1e-9;
  }
};
/// All feet of all linings, in the order in which they were installed.
template <class Solver, int Dim = Solver::SystemType::dim>
[[nodiscard]] std::vector<FootForce<Dim>> foot_forces(const Solver& solver) {
  std::vector<FootForce<Dim>> forces;
  const auto& system = solver.system();
  for (const auto* feet : system.supports.template all<LiningFeet<Dim>>())
    for (const auto& foot : feet->springs()) {
      const Vec<Dim> force = foot.force(feet->law(), foot.motion_at(system.displacement.data()));
      const Pose<Dim> then = system.pose_at_update(foot.rock);
      const FootBearing::Params& bearing = feet->law().params();
      forces.push_back({Vec<Dim>(system.body(foot.rock).centre +
                                 transposed_product(then.rotation, foot.arm_rock)),
                        column(foot.frame, 0), bearing.width, force[0],
                        part<Dim - 1>(force, 1).norm(),
                        std::isfinite(bearing.strength) ? force[0] / (bearing.strength * foot.area)
                                                        : std::numeric_limits<double>::quiet_NaN(),
                        foot.state.settlement + force[0] / (bearing.stiffness * foot.area),
                        foot.state.settlement});
    }
  return forces;
}

/// A member of the lining between two nodes, in 2-D per metre of tunnel.
template <int Dim>
struct MemberForces {
  Vec<Dim> from, to;  ///< its nodes [m]
  double thrust;      ///< N, compression positive [N]
  double shear;       ///< the larger of its ends, magnitude [N]
  double moment;      ///< the larger of its ends, magnitude, torsion apart [N m]
  int lining = 0;     ///< which it is of, in the order of installation; between two the later
};

namespace detail {

/// @param f  forces on the ends of a member, in its axes
template <int Dim, class EndForces>
[[nodiscard]] MemberForces<Dim> lining_member(const Vec<Dim>& from, const Vec<Dim>& to,
                                              const EndForces& f) {
  constexpr int dof = Dim == 2 ? 3 : 6;
  MemberForces<Dim> member{from, to, f[0], 0, 0};
  for (const int end : {0, dof}) {
    // In 3-D axial force, two shears; torsion, two moments.
    const double shear =
        Dim == 2 ? std::abs(f[end + 1]) : elementary::length(f[end + 1], f[end + 2]);
    const double moment =
        Dim == 2 ? std::abs(f[end + 2]) : elementary::length(f[end + dof - 2], f[end + dof - 1]);
    member.shear = std::max(member.shear, shear);
    member.moment = std::max(member.moment, moment);
  }
  return member;
}

}  // namespace detail

/// All members of all linings, then those that join one to another, where their nodes were
/// installed.
template <class Solver, int Dim = Solver::SystemType::dim>
[[nodiscard]] std::vector<MemberForces<Dim>> lining_members(const Solver& solver) {
  std::vector<MemberForces<Dim>> members;
  const auto& system = solver.system();
  const auto linings = solver.linings();
  const auto number_of = [&](int body) {
    int number = -1;
    for (const auto* lining : linings) number += body >= lining->first_node();
    return number;
  };
  const auto add = [&](const auto& it) {
    for (const auto& e : it.members()) {
      members.push_back(detail::lining_member<Dim>(system.body(e.i).centre, system.body(e.j).centre,
                                                   e.section_forces(system.displacement.data())));
      members.back().lining = number_of(std::max(e.i, e.j));
    }
  };
  for (const auto* lining : linings) add(*lining);
  for (const auto* joints : system.supports.template all<LiningJoints<typename Solver::Geometry>>())
    add(*joints);
  return members;
}
/// Of a lining that moves, or of what joins it to another, where nodes are now.
template <class Run, class Derived, class Geometry>
[[nodiscard]] std::vector<MemberForces<Geometry::dim>> lining_members(
    const Run& run, const FrameMembers<Derived, Geometry>& lining) {
  std::vector<MemberForces<Geometry::dim>> members;
  for (const auto& e : lining.members())
    members.push_back(detail::lining_member<Geometry::dim>(
        run.position(e.i), run.position(e.j), e.end_forces(run.pose(e.i), run.pose(e.j))));
  return members;
}

/// A lining at one node, per metre of tunnel.
struct LiningForce {
  Vec2 position;                ///< [m]
  double thrust;                ///< N, compression positive [N/m]
  double shear;                 ///< V [N/m]
  double moment;                ///< M, positive when the outer fibre is in tension [N m/m]
  double convergence;           ///< towards the tunnel centre since installation [m]
  bool is_lost = false;         ///< it came off the wall and was taken out: no forces
  int lining = 0;               ///< which it is of, in the order of installation
  Vec2 centre = zeros<Vec2>();  ///< of the lining, see `LiningFrame::centre` [m]
  /// Of the members that meet there, magnitude [N/m]: what presses on the node makes the shear
  /// force jump, and `shear` is the mean.
  double largest_shear = 0;
};

/// A member from one node of a list to another, anticlockwise.
struct LiningLink {
  int from, to;  ///< indices
};

namespace detail {

/// Linings and what joins one to another, as one list of nodes.
class LiningNodes {
 public:
  using Linings = std::vector<const LiningMembers<Planar>*>;
  using Joints = std::vector<const LiningJoints<Planar>*>;

  LiningNodes(Linings linings, Joints joints)
      : linings_(std::move(linings)), joints_(std::move(joints)) {
    for (std::size_t k = 0; k < linings_.size(); ++k)
      for (int n = 0; n < linings_[k]->node_count(); ++n) {
        const int body = linings_[k]->first_node() + n;
        if (static_cast<std::size_t>(body) >= index_.size())
          index_.resize(static_cast<std::size_t>(body) + 1, -1);
        index_[static_cast<std::size_t>(body)] = static_cast<int>(bodies_.size());
        bodies_.push_back(body);
        numbers_.push_back(static_cast<int>(k));
      }
  }
  [[nodiscard]] std::size_t size() const { return bodies_.size(); }
  [[nodiscard]] int body(std::size_t k) const { return bodies_[k]; }

  /// The members, those of every lining first.
  [[nodiscard]] std::vector<LiningLink> links() const {
    std::vector<LiningLink> links;
    each_member([&](const auto& m) {
      if (index_of(m.i) >= 0 && index_of(m.j) >= 0) links.push_back({index_of(m.i), index_of(m.j)});
    });
    return links;
  }

  /// The mean of the two members that meet at each node; position and
  /// convergence are left at zero.
  /// @param end_forces  of a member, in its axes
  template <class EndForces>
  [[nodiscard]] std::vector<LiningForce> forces(EndForces&& end_forces) const {
    std::vector<LiningForce> forces(size(), {zeros<Vec2>(), 0, 0, 0, 0});
    std::vector<int> ends(size(), 0);
    for (std::size_t k = 0; k < size(); ++k) {
      forces[k].lining = numbers_[k];
      forces[k].centre = linings_[static_cast<std::size_t>(numbers_[k])]->centre();
    }
    each_member([&](const auto& member) {
      // Members run anticlockwise: their second axis points into the opening, so what a beam calls
      // sagging (tension below) is tension at the outer fibre here.
      const auto f = end_forces(member);
      const auto add = [&](int body, double thrust, double shear, double moment) {
        const int k = index_of(body);
        if (k < 0) return;  // of a lining that is not asked for
        LiningForce& at = forces[static_cast<std::size_t>(k)];
        at.thrust += thrust;
        at.shear += shear;
        at.largest_shear = std::max(at.largest_shear, std::abs(shear));
        at.moment += moment;
        ++ends[static_cast<std::size_t>(k)];
      };
      add(member.i, f[0], f[1], -f[2]);
      add(member.j, -f[3], -f[4], f[5]);
    });
    for (std::size_t k = 0; k < size(); ++k) {
      const double share = ends[k] > 0 ? 1.0 / ends[k] : 0.0;
      forces[k].thrust *= share;
      forces[k].shear *= share;
      forces[k].moment *= share;
    }
    return forces;
  }

 private:
  [[nodiscard]] int index_of(int body) const {
    const auto b = static_cast<std::size_t>(body);
    return b < index_.size() ? index_[b] : -1;
  }
  template <class Visit>
  void each_member(Visit&& visit) const {
    for (const auto* lining : linings_)
      for (const auto& member : lining->members()) visit(member);
    for (const auto* joints : joints_)
      for (const auto& member : joints->members()) visit(member);
  }

  Linings linings_;
  Joints joints_;
  std::vector<int> bodies_, numbers_;
  std::vector<int> index_;  ///< of every body; -1: it is no node
};

/// Those of a solver.
template <class Solver>
[[nodiscard]] LiningNodes lining_nodes(const Solver& solver) {
  return {solver.linings(), solver.system().supports.template all<LiningJoints<Planar>>()};
}

template <class Solver>
[[nodiscard]] std::vector<LiningForce> lining_forces(const Solver& solver,
                                                     const LiningNodes& nodes) {
  const auto& system = solver.system();
  auto forces = nodes.forces(
      [&](const auto& member) { return member.section_forces(system.displacement.data()); });
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const int body = nodes.body(k);
    forces[k].position = system.body(body).centre;
    forces[k].is_lost = system.body(body).is_gone;
    forces[k].convergence = -solver.displacement_of(body, forces[k].position)
                                 .dot(normalized(Vec2(forces[k].position - forces[k].centre)));
  }
  return forces;
}

/// Of linings that move.
template <class Run>
[[nodiscard]] std::vector<LiningForce> lining_forces_in_motion(const Run& run,
                                                               const LiningNodes& nodes) {
  auto forces = nodes.forces([&](const auto& member) {
    return member.end_forces(run.pose(member.i), run.pose(member.j));
  });
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const int body = nodes.body(k);
    const Vec2 home = run.home(body).position;
    forces[k].position = run.position(body);
    forces[k].is_lost = run.body(body).is_gone;
    forces[k].convergence =
        (home - forces[k].position).dot(normalized(Vec2(home - forces[k].centre)));
  }
  return forces;
}

}  // namespace detail

/// All linings of a solver in the order of their installation, one entry per node: the mean of the
/// two members that meet there, where one lining goes on in another the member between them among
/// these. None without lining.
template <class Solver>
[[nodiscard]] std::vector<LiningForce> lining_forces(const Solver& solver) {
  return detail::lining_forces(solver, detail::lining_nodes(solver));
}

/// Of a lining that moves; position is where the node is now.
template <class Run, class Geometry>
requires(Geometry::dim == 2 && requires(const Run& run) { run.home(0); })
    [[nodiscard]] std::vector<LiningForce> lining_forces(const Run& run,
                                                         const LiningMembers<Geometry>& lining) {
  return detail::lining_forces_in_motion(run, {{&lining}, {}});
}

}  // namespace voussoir
