// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// Makes the bodies that allow only short steps more inert, so that all allow the step of the rest;
/// their weight stays, by a load.
/// @param stiffness  over mass, of every body with all others fixed [1/s^2]
/// @param share      of all bodies, that are the first to be made so [-], >= 0 and < 1
/// @param loads      on the bodies;  @param gravity  [m/s^2]
template <int Dim>
void add_inertia(const std::vector<double>& stiffness, double share, double gravity,
                 std::vector<MovingBody<Dim>>& bodies, std::vector<Load<Dim>>& loads) {
  std::vector<double> sorted = stiffness;
  std::sort(sorted.begin(), sorted.end());
  std::reverse(sorted.begin(), sorted.end());
  const double most = sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size()))];
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    MovingBody<Dim>& body = bodies[b];
    if (!body.movable() || !(stiffness[b] > most) || !(most > 0)) continue;
    const double factor = stiffness[b] / most;
    loads[b].force[Dim - 1] += (factor - 1) * body.mass * gravity;
    body.mass *= factor;
    body.inertia *= factor;
  }
}

}  // namespace voussoir::detail
