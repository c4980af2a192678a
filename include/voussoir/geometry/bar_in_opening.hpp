// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/outline_overlap.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/geometry/spatial_line.hpp>

namespace voussoir {

/// A place on a bar that lies in an opening, or nothing: a bar that ends on its wall touches it.
/// @param tolerance  what lies inside over no more than this does not count [m], > 0
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec2> place_inside(const Segment& bar,
                                                               const SimplePolygon& opening,
                                                               double tolerance);
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec3> place_inside(const SpatialLine& bar,
                                                               const PrismaticOpening& opening,
                                                               double tolerance);

/// True if a point lies in an opening, and not only on its surface.
/// @param tolerance  what is no farther inside than this along a coordinate is on the surface [m]
template <class Point, class Opening>
[[nodiscard]] bool lies_within(const Point& point, const Opening& opening, double tolerance) {
  for (int k = 0; k < static_cast<int>(Point::RowsAtCompileTime); ++k)
    for (const double way : {-tolerance, tolerance}) {
      Point beside = point;
      beside[k] += way;
      if (!opening.contains(beside)) return false;
    }
  return true;
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<Vec2> place_inside(const Segment& bar, const SimplePolygon& opening,
                                                 double tolerance) {
  const std::vector<double> at = detail::meetings(bar, opening);
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    if ((at[k + 1] - at[k]) * bar.length() <= 2 * tolerance) continue;
    const Vec2 middle = bar.at(0.5 * (at[k] + at[k + 1]));
    // Not along the wall: on both sides of the bar the opening goes on.
    const Vec2 beside = tolerance * normalized(perpendicular(bar.end - bar.start));
    if (opening.contains(middle + beside) && opening.contains(middle - beside)) return middle;
  }
  return {};
}

VOUSSOIR_INLINE std::optional<Vec3> place_inside(const SpatialLine& bar,
                                                 const PrismaticOpening& opening,
                                                 double tolerance) {
  const Vec3 a = opening.axis().local(bar.start), b = opening.axis().local(bar.end);
  // The part of the bar between the ends of the opening.
  double from = 0, to = 1;
  const double rise = b.z() - a.z();
  const auto keep = [&](double end, double sign) {  // sign * place <= sign * end
    const double above = sign * (a.z() - end) + tolerance, climb = sign * rise;
    if (climb == 0) {
      if (above > 0) to = -1;
    } else {
      (climb > 0 ? to : from) =
          climb > 0 ? std::min(to, -above / climb) : std::max(from, -above / climb);
    }
  };
  if (std::isfinite(opening.to())) keep(opening.to(), 1);
  if (std::isfinite(opening.from())) keep(opening.from(), -1);
  if (!((to - from) * bar.length() > 2 * tolerance)) return {};
  const Vec3 p = a + from * Vec3(b - a), q = a + to * Vec3(b - a);
  const Segment seen{{p.x(), p.y()}, {q.x(), q.y()}};
  if (seen.length() <= 4 * tolerance) {  // along the axis
    const Vec2 middle = seen.centre();
    if (!opening.section().contains(middle)) return {};
    return opening.in_space(middle, 0.5 * (p.z() + q.z()));
  }
  const auto place = place_inside(seen, opening.section(), tolerance);
  if (!place) return {};
  const double part = length_of(Vec2(*place - seen.start)) / seen.length();
  return opening.in_space(*place, p.z() + part * (q.z() - p.z()));
}

#endif

}  // namespace voussoir
