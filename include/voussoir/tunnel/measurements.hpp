// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/opening_centre.hpp>
#include <voussoir/tunnel/support_forces.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>

namespace voussoir {

/// Movement of a piece of the wall.
struct WallMotion {
  double angle;  ///< of its middle about `centre_of` the opening, anticlockwise from the right-hand
                 ///< springing [rad], 0 to 2 pi
  double length;               ///< [m]; in 3-D its area [m^2]
  double convergence;          ///< towards the axis of the tunnel, positive inwards [m]
  Vec2 moved = zeros<Vec2>();  ///< in the section: to the right, up [m]
};

/// Mean displacement of the wall, pieces by their length: that of the opening as a whole [m]. Not a
/// number without a wall.
[[nodiscard]] inline Vec2 mean_displacement(const std::vector<WallMotion>& wall) {
  Vec2 sum = zeros<Vec2>();
  double length = 0;
  for (const WallMotion& piece : wall) {
    sum += piece.length * piece.moved;
    length += piece.length;
  }
  return sum / length;
}

namespace detail {

/// Of pieces that are there, moved by a displacement.
/// @param is_counted  is_counted(body, place)
/// @param displacement  displacement(body, place) [m]
template <class Geometry, class IsCounted, class Displacement>
[[nodiscard]] std::vector<WallMotion> wall_motion_of(const RockMass<Geometry>& mass,
                                                     const typename Geometry::Opening& opening,
                                                     IsCounted&& is_counted,
                                                     Displacement&& displacement) {
  const Vec2 centre = centre_of(opening);
  std::vector<WallMotion> motion;
  for (const auto& piece : wall_pieces(mass, opening)) {
    const auto place = piece.facet.centre();
    if (!is_counted(piece.body, place)) continue;
    const auto moved = displacement(piece.body, place);
    Vec2 p, u;
    if constexpr (Geometry::dim == 2) {
      p = place - centre;
      u = moved;
    } else {
      p = opening.across(place) - centre;
      u = opening.across_direction(moved);
    }
    double angle = std::atan2(p.y(), p.x());
    if (angle < 0) angle += 2 * std::numbers::pi;
    VOUSSOIR_ASSERT(angle >= 0 && angle <= 2 * std::numbers::pi, "a full circle has all angles");
    motion.push_back({angle, piece.facet.measure(), -u.dot(normalized(p)), u});
  }
  return motion;
}

}  // namespace detail

/// All pieces of the wall of an opening that are not detached. The opening may be the outline of a
/// section that was taken out in rounds.
template <class Solver>
[[nodiscard]] std::vector<WallMotion> wall_motion(
    const Solver& solver, const typename Solver::Geometry::Opening& opening) {
  return detail::wall_motion_of(
      solver.mass(), opening, [&](int b, const auto&) { return solver.system().body(b).movable; },
      [&](int b, const auto& p) { return solver.displacement_of(b, p); });
}
/// Of the last opening; none before one was carved.
template <class Solver>
[[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver) {
  if (solver.mass().openings.empty()) return {};
  return wall_motion(solver, solver.mass().openings.back());
}
/// In 3-D those whose middle lies within a stretch of the opening.
/// @param section  the middle of the stretch along the axis [m]
/// @param half_length  of the stretch [m], > 0
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver,
                                                      const PrismaticOpening& opening,
                                                      double section, double half_length) {
  require(half_length > 0, "half of the stretch of wall", half_length, "> 0 m");
  return detail::wall_motion_of(
      solver.mass(), opening,
      [&](int b, const Vec3& p) {
        return solver.system().body(b).movable &&
               std::abs(opening.along(p) - section) <= half_length;
      },
      [&](int b, const Vec3& p) { return solver.displacement_of(b, p); });
}
/// The same of the last opening.
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver, double section,
                                                      double half_length) {
  if (solver.mass().openings.empty()) return {};
  return wall_motion(solver, solver.mass().openings.back(), section, half_length);
}
/// Of rock that moves.
/// @param mass  from which the run was made
template <class Geometry, class... Parts>
[[nodiscard]] std::vector<WallMotion> wall_motion(const Dynamics<Geometry::dim, Parts...>& run,
                                                  const RockMass<Geometry>& mass) {
  if (mass.openings.empty()) return {};
  return detail::wall_motion_of(
      mass, mass.openings.back(), [&](int b, const auto&) { return !run.body(b).is_gone; },
      [&](int b, const auto& p) { return Vec<Geometry::dim>(run.motion(b)(p) - p); });
}

/// Convergence of the wall around one direction: the median over +- 12 degrees, each piece with
/// the weight of its length, so that neither a loose corner nor the cut of the blocks decides [m].
/// Not a number if no wall is left there.
[[nodiscard]] VOUSSOIR_INLINE double convergence_at(const std::vector<WallMotion>& wall,
                                                    double angle,
                                                    double half_window = std::numbers::pi / 15);

/// Convergence of the four named places of the wall [m].
///
/// Where the base of the domain is elastic ground, against the mean displacement of the wall: in
/// 2-D the rise of an opening as a whole, whose rock weighs no more, has no end (`GroundAround`).
struct Convergence {
  double crown, right_springing, left_springing, invert;
  double rise = 0;  ///< mean upward displacement of the wall

  [[nodiscard]] double upright() const { return crown + invert; }
  [[nodiscard]] double across() const { return right_springing + left_springing; }
};
/// @param of_whole  displacement that does not count [m]
[[nodiscard]] inline Convergence convergence_of(const std::vector<WallMotion>& wall,
                                                const Vec2& of_whole = zeros<Vec2>()) {
  constexpr double right = 0.5 * std::numbers::pi;
  return {convergence_at(wall, right) + of_whole.y(), convergence_at(wall, 0.0) + of_whole.x(),
          convergence_at(wall, 2 * right) - of_whole.x(),
          convergence_at(wall, 3 * right) - of_whole.y(), mean_displacement(wall).y()};
}
namespace detail {
template <class Solver>
[[nodiscard]] Convergence convergence_in(const Solver& solver,
                                         const std::vector<WallMotion>& wall) {
  const bool is_fixed = solver.far_field().at(SideOf<Solver::dim>::bottom) == Boundary::rollers;
  return convergence_of(wall, is_fixed ? zeros<Vec2>() : mean_displacement(wall));
}
}  // namespace detail
template <class Solver>
[[nodiscard]] Convergence convergence(const Solver& solver) {
  return detail::convergence_in(solver, wall_motion(solver));
}
/// Of any opening, the outline of several rounds among them.
template <class Solver>
[[nodiscard]] Convergence convergence(const Solver& solver,
                                      const typename Solver::Geometry::Opening& opening) {
  return detail::convergence_in(solver, wall_motion(solver, opening));
}
/// In 3-D at a section of an opening: of the wall within `half_length` of it.
template <class Solver>
requires(Solver::dim == 3) [[nodiscard]] Convergence
    convergence(const Solver& solver, const PrismaticOpening& opening, double section,
                double half_length = 1) {
  return detail::convergence_in(solver, wall_motion(solver, opening, section, half_length));
}
/// The same of the last opening.
template <class Solver>
requires(Solver::dim == 3) [[nodiscard]] Convergence
    convergence(const Solver& solver, double section, double half_length = 1) {
  return detail::convergence_in(solver, wall_motion(solver, section, half_length));
}
/// Of rock that moves.
template <class Geometry, class... Parts>
[[nodiscard]] Convergence convergence(const Dynamics<Geometry::dim, Parts...>& run,
                                      const RockMass<Geometry>& mass) {
  return convergence_of(wall_motion(run, mass));
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
  VOUSSOIR_ASSERT(total >= 0 && lengths.size() == convergences.size(), "wall has a length");
  double below = 0;
  for (const std::size_t k : order_of_values(convergences)) {
    below += lengths[k];
    if (below >= 0.5 * total) return convergences[k];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

#endif

}  // namespace voussoir
