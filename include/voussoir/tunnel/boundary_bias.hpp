// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/linear/linear_method.hpp>
#include <voussoir/model/small_displacement.hpp>
#include <voussoir/tunnel/wall_motion.hpp>

namespace voussoir {

/// Motion of the wall, were it unloaded now, no joint opening or slipping: one elastic solve. What
/// it has moved before does not count.
/// @throws FreeBody, NotEnoughMemory, Stopped
template <class Solver>
[[nodiscard]] std::vector<WallMotion> elastic_wall_motion(const Solver& solver,
                                                          const LinearSettings& linear = {},
                                                          const Progress& progress = {}) {
  constexpr int dim = Solver::dim, dof = Solver::dof;
  if (solver.mass().openings.empty()) return {};
  auto system = solver.system();
  system.wall_fraction = 0;
  Eigen::VectorXd u;
  system.forces(system.displacement, u);
  (void)system.elastic_solver(linear, progress).solve_in_place(u, {.relative = 1e-6}, progress);
  return detail::wall_motion_of<typename Solver::Geometry>(
      solver.mass(), solver.mass().openings.back(),
      {[&](int b) { return system.body(b).movable; },
       [&](int b, const auto& p) {
         return displacement_at<dim>(u.data() + dof * b, Vec<dim>(p - system.body(b).centre));
       }});
}

/// How a tunnel's section closes, by the first parts of its wall's inward motion round the section:
/// u = mean + oval cos(2 theta), theta from the springing. Sums over the whole wall: neither the
/// motion of the opening as a whole nor what a single block does decides.
struct SectionClosure {
  double upright;  ///< of the height: 2 (mean - oval) [m]
  double across;   ///< of the width: 2 (mean + oval) [m]
};
[[nodiscard]] inline SectionClosure section_closure(const std::vector<WallMotion>& wall) {
  const Vec2 whole = mean_displacement(wall);
  double length = 0, mean = 0, oval = 0;
  for (const WallMotion& piece : wall) {
    const Vec2 outward(elementary::cosine(piece.angle), elementary::sine(piece.angle));
    const double inward = piece.convergence + whole.dot(outward);
    length += piece.length;
    mean += piece.length * inward;
    oval += 2 * piece.length * inward * elementary::cosine(2 * piece.angle);
  }
  return {2 * (mean - oval) / length, 2 * (mean + oval) / length};
}

/// What the edge of the domain does to a tunnel's closure, over the larger closure [-].
struct BoundaryBias {
  double upright, across;

  [[nodiscard]] double largest() const { return std::max(std::abs(upright), std::abs(across)); }
};
/// @param found      elastic motion of the wall in a domain as it is
/// @param reference  the same where the ground goes on
[[nodiscard]] inline BoundaryBias boundary_bias(const std::vector<WallMotion>& found,
                                                const std::vector<WallMotion>& reference) {
  const SectionClosure is = section_closure(found), should = section_closure(reference);
  const double scale = std::max(std::abs(should.upright), std::abs(should.across));
  return {(is.upright - should.upright) / scale, (is.across - should.across) / scale};
}

}  // namespace voussoir
