// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/geometry/line_clip.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#ifdef VOUSSOIR_COMPILED
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#endif

namespace voussoir {

/// The stretch of a line that runs inside one body.
struct BlockIntersection {
  int body;
  double from, to;  ///< distance from the start of the line [m]
};

/// Two intersections nearer to each other than so many tolerances touch: each end is off by at most
/// the tolerance over the sine of the angle at which the line meets the face.
inline constexpr double same_point = 10;

/// The bodies that a straight line runs through, in the order of their distance from its start.
///
/// Intersections through several parts of one body are joined. Gaps (outside the domain, inside an
/// opening) simply do not appear. A line along a joint belongs to one side of it, see `clip`.
///
/// @cost  a look at every body, 4 ns each where few are near
template <class Geometry>
[[nodiscard]] std::vector<BlockIntersection> block_intersections(
    const RockMass<Geometry>& mass, const typename Geometry::Line& line) {
  const double tolerance = mass.domain.tolerance();
  const auto low = smaller_of(line.start, line.end), high = larger_of(line.start, line.end);
  // Welding moves vertices by a tolerance, and lines are clipped to it:
  // (r + 3 t)^2 <= 1.01 r^2 + 101 (3 t)^2.
  const double slack = 909 * tolerance * tolerance;
  std::vector<BlockIntersection> intersections;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const auto& body = mass.bodies[b];
    // Without a look at its vertices, which are elsewhere in memory.
    const auto& centre = body.properties.centroid;
    const auto nearest = smaller_of(larger_of(centre, low), high);
    if (body.parts.size() == 1 &&
        squared_length_of(centre - nearest) > 1.01 * squared_reach(body.properties) + slack)
      continue;
    for (const auto& part : body.parts) {
      auto part_low = part.vertex(0), part_high = part.vertex(0);
      for (const auto& v : part.vertices()) {
        part_low = smaller_of(part_low, v);
        part_high = larger_of(part_high, v);
      }
      if (any_less(shifted_by(high, tolerance), part_low) ||
          any_less(part_high, shifted_by(low, -tolerance)))
        continue;
      double from = 0, to = 0;
      const bool meets = clip(line, part, tolerance, from, to);
      VOUSSOIR_ASSERT(!meets || from < to, "a line runs forwards through a block");
      if (meets) intersections.push_back({static_cast<int>(b), from, to});
    }
  }
  std::vector<double> starts;
  starts.reserve(intersections.size());
  for (const BlockIntersection& intersection : intersections) starts.push_back(intersection.from);
  std::vector<BlockIntersection> joined;
  for (const std::size_t k : order_of_values(starts)) {
    const BlockIntersection& next = intersections[k];
    if (!joined.empty() && joined.back().body == next.body &&
        next.from - joined.back().to < same_point * tolerance) {
      joined.back().to = next.to;
    } else {
      VOUSSOIR_ASSERT(joined.empty() || joined.back().from <= next.from,
                      "intersections are in the order of the line");
      joined.push_back(next);
    }
  }
  return joined;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE std::vector<BlockIntersection> block_intersections<Planar>(
    const RockMass<Planar>&, const Planar::Line&);
VOUSSOIR_SPATIAL_TEMPLATE std::vector<BlockIntersection> block_intersections<Spatial>(
    const RockMass<Spatial>&, const Spatial::Line&);
#endif

}  // namespace voussoir
