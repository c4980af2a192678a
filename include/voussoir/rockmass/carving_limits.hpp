// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
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

/// Below which thickness rock between the wall and a joint along it is dropped, a tenth of the side
/// of the smallest piece [m].
/// @param smallest  area or volume [m^2], [m^3]
[[nodiscard]] inline double skin_thickness(int dim, double smallest) {
  return 0.1 * (dim == 2 ? std::sqrt(smallest) : std::cbrt(smallest));
}

/// From where to where along its axis an opening lies inside the domain [m]: of an inclined one as
/// far as any part of the domain reaches.
[[nodiscard]] inline std::pair<double, double> stretch_inside(const PrismaticOpening& opening,
                                                              const Domain<3>& domain) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1 ? domain.high : domain.low).x(),
                 (corner & 2 ? domain.high : domain.low).y(),
                 (corner & 4 ? domain.high : domain.low).z());
    low = std::min(low, opening.along(p));
    high = std::max(high, opening.along(p));
  }
  return {std::max(opening.from(), low), std::min(opening.to(), high)};
}

/// Length of tunnel over which lost rock is counted (see `SearchContext::open_length`) [m].
[[nodiscard]] inline double open_length(const RockMass<Planar>&) { return 1; }
[[nodiscard]] inline double open_length(const RockMass<Spatial>& mass) {
  if (mass.openings.empty()) return 1;
  const PrismaticOpening& opening = mass.openings.back();
  const auto [low, high] = opening.local_box();
  const auto [from, to] = stretch_inside(opening, mass.domain);
  return std::min(to - from, high.x() - low.x());
}

}  // namespace voussoir
