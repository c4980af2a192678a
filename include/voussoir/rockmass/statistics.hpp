// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <voussoir/geometry/inscribed_ball.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/pierce.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// Mean joint spacing along a scanline: length inside the rock / number of joints crossed [m].
/// Infinite when no joint is crossed.
template <class Geometry>
[[nodiscard]] double scanline_spacing(const RockMass<Geometry>& mass, const Segment& line) {
  const std::vector<Passage> passages = pierce(mass, line);
  double length = 0;
  for (const Passage& p : passages) length += p.to - p.from;
  if (passages.size() < 2) return std::numeric_limits<double>::infinity();
  return length / static_cast<double>(passages.size() - 1);
}

/// Mean spacing over scanlines that radiate from `centre`, starting at `inner`, `length` long:
/// total length / total number of joints, over `directions` equally spaced directions [m].
[[nodiscard]] inline double radial_spacing(const RockMass<Planar>& mass, const Vec2& centre,
                                           double inner, double length, int directions = 72) {
  double total = 0;
  std::size_t crossings = 0;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / directions;
    const Vec2 out(std::cos(angle), std::sin(angle));
    const auto passages = pierce(mass, {centre + inner * out, centre + (inner + length) * out});
    for (const Passage& p : passages) total += p.to - p.from;
    if (!passages.empty()) crossings += passages.size() - 1;
  }
  return crossings > 0 ? total / static_cast<double>(crossings)
                       : std::numeric_limits<double>::infinity();
}

/// Distribution of block sizes.
struct BlockSizes {
  std::size_t count = 0;
  double smallest = 0, median = 0, mean = 0, largest = 0;  ///< area [m^2] or volume [m^3]
  double smallest_inscribed_radius = 0;                    ///< over all convex parts [m]
};

/// @pre at least one body
template <class Geometry>
[[nodiscard]] BlockSizes block_sizes(const RockMass<Geometry>& mass) {
  std::vector<double> sizes;
  BlockSizes result;
  result.smallest_inscribed_radius = std::numeric_limits<double>::infinity();
  for (const auto& body : mass.bodies) {
    sizes.push_back(body.properties.measure);
    result.mean += sizes.back();
    for (const auto& part : body.parts)
      result.smallest_inscribed_radius =
          std::min(result.smallest_inscribed_radius, inscribed_ball(part).radius);
  }
  std::sort(sizes.begin(), sizes.end());
  result.count = sizes.size();
  result.smallest = sizes.front();
  result.median = sizes[sizes.size() / 2];
  result.largest = sizes.back();
  result.mean /= static_cast<double>(sizes.size());
  return result;
}

}  // namespace voussoir
