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
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/support_forces.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>
#include <voussoir/tunnel/wall_motion.hpp>

namespace voussoir {

/// Convergence of the wall around one direction over +- 12 degrees, each part with the weight of
/// its length: the mean of the middle fifth, between the quantiles 0.4 and 0.6, so that neither a
/// loose corner nor the cut of the blocks decides, and two halves that differ give what lies
/// between them rather than the one or the other by rounding [m]. Parts count whole if their middle
/// lies within; at multiples of 6 degrees that is exact. Not a number if no wall is left there.
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
/// Of the tunnel as it stands: of the last opening and those that it is joined to.
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
/// The same of the last opening and those that it is joined to.
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
  double below = 0, sum = 0, weight = 0;
  for (const std::size_t k : order_of_values(convergences)) {
    const double counted = std::min(below + lengths[k], 0.6 * total) - std::max(below, 0.4 * total);
    below += lengths[k];
    if (!(counted > 0)) continue;
    sum += counted * convergences[k];
    weight += counted;
  }
  return weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

#endif

}  // namespace voussoir
