// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/solver/solver.hpp>

namespace voussoir {

/// Movement of a piece of the wall.
struct WallMotion {
  double angle;   ///< of its middle, anticlockwise from the right-hand springing [rad], 0 to 2 pi
  double length;  ///< [m]
  double convergence;  ///< towards the tunnel centre, positive inwards [m]
};

/// All pieces of the wall that are not detached.
template <class Solver>
[[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver) {
  std::vector<WallMotion> motion;
  for (const auto& piece : wall_pieces(solver.mass())) {
    if (!solver.system().body(piece.body).movable) continue;
    const Vec2 p = piece.facet.centre();
    double angle = std::atan2(p.y(), p.x());
    if (angle < 0) angle += 2 * std::numbers::pi;
    motion.push_back(
        {angle, piece.facet.length(), -solver.displacement_of(piece.body, p).dot(normalized(p))});
  }
  return motion;
}

/// Convergence of the wall around one direction: the median over +- 12 degrees, each piece with
/// the weight of its length, so that neither a loose corner nor the cut of the blocks decides [m].
/// Not a number if no wall is left there.
[[nodiscard]] VOUSSOIR_INLINE double convergence_at(const std::vector<WallMotion>& wall,
                                                    double angle,
                                                    double half_window = std::numbers::pi / 15);

/// Convergence of the four named places of the wall [m].
struct Convergence {
  double crown, right_springing, left_springing, invert;
};
template <class Solver>
[[nodiscard]] Convergence convergence(const Solver& solver) {
  const std::vector<WallMotion> wall = wall_motion(solver);
  constexpr double right = 0.5 * std::numbers::pi;
  return {convergence_at(wall, right), convergence_at(wall, 0.0), convergence_at(wall, 2 * right),
          convergence_at(wall, 3 * right)};
}

/// A bolt where it crosses a joint.
struct CrossingForce {
  int bolt;
  double position;   ///< from the head [m]
  double force;      ///< tension positive, of one bolt [N]
  double extension;  ///< of the distance between the anchors since installation [m]
  bool yielded;      ///< false where the law's `State` has no `plastic_extension`
  bool ruptured;
};

/// In the order of bolts and, along each, from head to tip.
template <class Solver>
[[nodiscard]] std::vector<CrossingForce> bolt_forces(const Solver& solver) {
  std::vector<CrossingForce> forces;
  const auto& system = solver.system();
  const auto* bolts = solver.bolts();
  if (bolts == nullptr) return forces;
  for (const auto& spring : bolts->springs()) {
    const auto span = spring.span_at(system.displacement.data());
    const auto& law = bolts->law_of(spring);
    // Anchors on the joint have no distance that could change: what opens the joint stretches them.
    const double initial = span.initial.norm();
    const double extension =
        initial > 0 ? (span.initial + span.motion).norm() - initial : span.axis.dot(span.motion);
    bool yielded = false;  // of a law that says so
    if constexpr (requires { spring.state.plastic_extension > 0; })
      yielded = spring.state.plastic_extension > 0;
    forces.push_back({spring.bolt, spring.position, law.force(span, spring.state).axial, extension,
                      yielded, spring.broken});
  }
  return forces;
}

/// Largest force of every bolt [N]; 0 for a bolt that crosses no joint.
template <class Solver>
[[nodiscard]] std::vector<double> largest_bolt_forces(const Solver& solver) {
  std::vector<double> largest(static_cast<std::size_t>(solver.bolt_count()), 0.0);
  for (const CrossingForce& c : bolt_forces(solver))
    largest[static_cast<std::size_t>(c.bolt)] =
        std::max(largest[static_cast<std::size_t>(c.bolt)], c.force);
  return largest;
}

/// The lining at one node, per metre of tunnel.
struct LiningForce {
  Vec2 position;       ///< [m]
  double thrust;       ///< N, compression positive [N/m]
  double shear;        ///< V [N/m]
  double moment;       ///< M, positive when the outer fibre is in tension [N m/m]
  double convergence;  ///< towards the tunnel centre since installation [m]
};

namespace detail {

/// The mean of the two members that meet at each of `count` nodes, where the first is body `first`;
/// position and convergence are left at zero.
/// @param end_forces  of an element, in its axes
template <class Elements, class EndForces>
[[nodiscard]] std::vector<LiningForce> mean_of_members(const Elements& elements, int first,
                                                       int count, EndForces&& end_forces) {
  std::vector<LiningForce> forces(static_cast<std::size_t>(count), {zeros<Vec2>(), 0, 0, 0, 0});
  std::vector<int> ends(forces.size(), 0);
  for (const auto& element : elements) {
    // Members run anticlockwise: their second axis points into the opening, so what a beam calls
    // sagging (tension below) is tension at the outer fibre here.
    const auto f = end_forces(element);
    const auto add = [&](int node, double thrust, double shear, double moment) {
      LiningForce& at = forces[static_cast<std::size_t>(node - first)];
      at.thrust += thrust;
      at.shear += shear;
      at.moment += moment;
      ++ends[static_cast<std::size_t>(node - first)];
    };
    add(element.i, f[0], f[1], -f[2]);
    add(element.j, -f[3], -f[4], f[5]);
  }
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const double share = ends[k] > 0 ? 1.0 / ends[k] : 0.0;
    forces[k].thrust *= share;
    forces[k].shear *= share;
    forces[k].moment *= share;
  }
  return forces;
}

}  // namespace detail

/// Of one lining of a solver (see `linings()`); one entry per node: the mean of the two members
/// that meet there.
template <class Solver>
[[nodiscard]] std::vector<LiningForce> lining_forces(const Solver& solver,
                                                     const typename Solver::LiningType& lining) {
  const auto& system = solver.system();
  const int first = lining.first_node();
  auto forces = detail::mean_of_members(
      lining.members(), first, lining.node_count(),
      [&](const auto& element) { return element.end_forces(system.displacement.data()); });
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const int body = first + static_cast<int>(k);
    forces[k].position = system.body(body).centre;
    forces[k].convergence =
        -solver.displacement_of(body, forces[k].position).dot(forces[k].position.normalized());
  }
  return forces;
}

/// Of the first lining; none without one.
template <class Solver>
[[nodiscard]] std::vector<LiningForce> lining_forces(const Solver& solver) {
  const auto* lining = solver.lining();
  if (lining == nullptr) return {};
  return lining_forces(solver, *lining);
}

/// The same of a lining that moves; position is where the node is now.
template <class Run, class Geometry>
requires(Geometry::dim == 2 && requires(const Run& run) { run.home(0); })
    [[nodiscard]] std::vector<LiningForce> lining_forces(const Run& run,
                                                         const LiningMembers<Geometry>& lining) {
  const int first = lining.first_node();
  auto forces = detail::mean_of_members(
      lining.members(), first, lining.node_count(), [&](const auto& element) {
        return element.end_forces(run.pose(element.i), run.pose(element.j));
      });
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const int body = first + static_cast<int>(k);
    const Vec2 home = run.home(body).position;
    forces[k].position = run.position(body);
    forces[k].convergence = (home - forces[k].position).dot(normalized(home));
  }
  return forces;
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE double convergence_at(const std::vector<WallMotion>& wall, double angle,
                                      double half_window) {
  std::vector<double> lengths, convergences;
  double total = 0;
  for (const WallMotion& piece : wall) {
    const double away = std::remainder(piece.angle - angle, 2 * std::numbers::pi);
    if (std::abs(away) > half_window) continue;
    lengths.push_back(piece.length);
    convergences.push_back(piece.convergence);
    total += piece.length;
  }
  double below = 0;
  for (const std::size_t k : order_of_values(convergences)) {
    below += lengths[k];
    if (below >= 0.5 * total) return convergences[k];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

#endif

}  // namespace voussoir
