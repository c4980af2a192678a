// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// A smallest piece that is chosen for the rock: `smallest_piece_of`.
inline constexpr double of_the_rock = -1;

/// What is dropped at the wall unless told otherwise: pieces smaller than a square or a cube of
/// 0.272 m, which is 0.074 m^2 and 0.0201 m^3. Where blocks in 3-D are small themselves a tenth of
/// the mean block, or fine rock would lose its wall; in 2-D it is 0.074 m^2 whatever the rock, an
/// eighth of the mean block of reference mass A.
/// @param mass  not yet carved
template <class Geometry>
[[nodiscard]] double smallest_piece_of(const RockMass<Geometry>& mass) {
  constexpr double area = 0.074;
  if constexpr (Geometry::dim == 2) return area;
  const double mean = mass.domain.measure() / static_cast<double>(mass.bodies.size());
  return std::min(area * std::sqrt(area), 0.1 * mean);
}

/// Length of tunnel over which lost rock is counted (see `SearchContext::open_length`) [m].
[[nodiscard]] inline double open_length(const RockMass<Planar>&) { return 1; }
[[nodiscard]] inline double open_length(const RockMass<Spatial>& mass) {
  if (mass.openings.empty()) return 1;
  const PrismaticOpening& opening = mass.openings.back();
  double low = opening.section().vertices().front().x(), high = low;
  for (const Vec2& v : opening.section().vertices()) {
    low = std::min(low, v.x());
    high = std::max(high, v.x());
  }
  const double length =
      std::min(opening.to(), mass.domain.high.y()) - std::max(opening.from(), mass.domain.low.y());
  return std::min(length, high - low);
}

}  // namespace voussoir
