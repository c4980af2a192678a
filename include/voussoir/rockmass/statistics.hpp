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

/// What a straight line meets in the rock.
struct Scanline {
  double length = 0;       ///< inside the rock [m]
  std::size_t joints = 0;  ///< crossed from one body to the next; openings do not count

  /// length / joints [m]; infinite when no joint is crossed
  [[nodiscard]] double spacing() const {
    return joints > 0 ? length / static_cast<double>(joints)
                      : std::numeric_limits<double>::infinity();
  }
};

/// Adds what the line meets to `found`.
template <class Geometry>
void scan(const RockMass<Geometry>& mass, const Segment& line, Scanline& found) {
  const std::vector<Passage> passages = pierce(mass, line);
  for (std::size_t k = 0; k < passages.size(); ++k) {
    found.length += passages[k].to - passages[k].from;
    const bool next_touches = k + 1 < passages.size() && passages[k + 1].from - passages[k].to <
                                                             same_point * mass.domain.tolerance();
    if (next_touches) ++found.joints;
  }
}

/// Mean joint spacing along a scanline: length inside the rock / number of joints crossed [m].
/// Infinite when no joint is crossed.
template <class Geometry>
[[nodiscard]] double scanline_spacing(const RockMass<Geometry>& mass, const Segment& line) {
  Scanline found;
  scan(mass, line, found);
  return found.spacing();
}

/// Mean spacing over scanlines that radiate from `centre`, starting at `inner`, `length` long:
/// total length / total number of joints, over `directions` equally spaced directions [m].
[[nodiscard]] inline double radial_spacing(const RockMass<Planar>& mass, const Vec2& centre,
                                           double inner, double length, int directions = 72) {
  Scanline found;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / directions;
    const Vec2 out(std::cos(angle), std::sin(angle));
    scan(mass, {centre + inner * out, centre + (inner + length) * out}, found);
  }
  return found.spacing();
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
