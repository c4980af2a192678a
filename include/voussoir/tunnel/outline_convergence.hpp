// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/rockmass/opening_box.hpp>

namespace voussoir {

/// Where the movement of a tunnel's outline is sampled: stretches along the axis, each by a grid of
/// points.
struct OutlineSampling {
  double from;      ///< along the axis [m]
  double to;        ///< [m], > from
  int stretches;    ///< of equal length, > 0
  int around = 72;  ///< points on the outline, >= 3
  int along = 4;    ///< rows of points in a stretch, > 0

  [[nodiscard]] double length() const { return (to - from) / stretches; }
  /// The middle of a stretch [m].
  [[nodiscard]] double middle(int stretch) const { return from + (stretch + 0.5) * length(); }

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(from < to && std::isfinite(to - from), "end of the sampled outline", to,
            "beyond its beginning");
    require(stretches > 0, "stretches of the sampled outline", stretches, "> 0");
    require(around >= 3, "points around the outline", around, ">= 3");
    require(along > 0, "points along a stretch", along, "> 0");
  }
};

namespace detail {

/// A point in the rock next to an outline, and the way into the opening.
struct OutlinePoint {
  Vec3 place, inward;
  int stretch;
};
/// Stretch by stretch, row by row.
/// @param behind  from the outline to the points [m]
[[nodiscard]] VOUSSOIR_INLINE std::vector<OutlinePoint> outline_points(
    const PrismaticOpening& tunnel, const OutlineSampling& sampling, double behind);

struct BoxOfPoints {
  Vec3 low, high;  ///< [m]

  [[nodiscard]] bool is_apart(const Vec3& other_low, const Vec3& other_high) const {
    return any_less(other_high, low) || any_less(high, other_low);
  }
};
/// Of every row of points; the last is that of all.
[[nodiscard]] VOUSSOIR_INLINE std::vector<BoxOfPoints> boxes_of_rows(
    const std::vector<OutlinePoint>& points, std::size_t row);

[[nodiscard]] inline bool holds(const ConvexPolyhedron& shape, const Vec3& place,
                                double tolerance) {
  for (std::size_t k = 0; k < shape.size(); ++k)
    if (shape.half_space(k).distance(place) > tolerance) return false;
  return true;
}

}  // namespace detail

/// Convergence of the outline of a tunnel along its axis, behind the face and ahead of it, where
/// the tunnel is yet to come: the longitudinal displacement profile of 3-D runs.
///
/// It is the mean of -u . n over the rock just outside the outline, n outward: of a stretch the
/// volume that the tunnel loses there over the area of its outline. In a circle that is the mean
/// radial displacement. A rigid movement of the whole adds nothing, whereas to a single point it
/// adds all.
///
/// @param tunnel  its section is the outline; where it begins and ends does not matter
/// @return  of every stretch [m], positive inwards; not a number where there is no rock, or all has
///          detached
/// @throws InvalidInput  see `OutlineSampling::check`
/// @cost   one bounding test per body; points x blocks near the outline
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<double> outline_convergence(const Solver& solver,
                                                          const PrismaticOpening& tunnel,
                                                          const OutlineSampling& sampling) {
  sampling.check();
  const auto& mass = solver.mass();
  const double tolerance = mass.domain.tolerance();
  const auto points = detail::outline_points(tunnel, sampling, 10 * tolerance);
  const auto row = static_cast<std::size_t>(sampling.around);
  std::vector<char> is_seen(points.size(), 0);
  std::vector<double> sum(static_cast<std::size_t>(sampling.stretches), 0.0), count = sum;
  const std::vector<detail::BoxOfPoints> boxes = detail::boxes_of_rows(points, row);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    if (!solver.system().body(body).movable) continue;
    for (const ConvexPolyhedron& part : mass.bodies[b].parts) {
      const auto [low, high] = detail::bounding_box<3>(part.vertices());
      if (boxes.back().is_apart(low, high)) continue;
      for (std::size_t begin = 0; begin < points.size(); begin += row) {
        if (boxes[begin / row].is_apart(low, high)) continue;
        for (std::size_t k = begin; k < begin + row; ++k) {
          const detail::OutlinePoint& p = points[k];
          if (is_seen[k] != 0 || !detail::holds(part, p.place, tolerance)) continue;
          is_seen[k] = 1;
          const auto stretch = static_cast<std::size_t>(p.stretch);
          sum[stretch] += p.inward.dot(solver.displacement_of(body, p.place));
          count[stretch] += 1;
        }
      }
    }
  }
  for (std::size_t s = 0; s < sum.size(); ++s)
    sum[s] = count[s] > 0 ? sum[s] / count[s] : std::numeric_limits<double>::quiet_NaN();
  return sum;
}

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::vector<OutlinePoint> outline_points(const PrismaticOpening& tunnel,
                                                         const OutlineSampling& sampling,
                                                         double behind) {
  const SimplePolygon& section = tunnel.section();
  const double spacing = section.perimeter() / sampling.around;
  std::vector<std::pair<Vec2, Vec2>> around;  // place and inward normal
  double start = 0;
  for (std::size_t e = 0; e < section.size(); ++e) {
    const Segment edge = section.edge(e);
    const double length = edge.length();
    const Vec2 inward = perpendicular(Vec2((edge.end - edge.start) / length));
    // Points lie in the middle of their share of the perimeter.
    while (static_cast<int>(around.size()) < sampling.around) {
      const double s = (static_cast<double>(around.size()) + 0.5) * spacing - start;
      if (s >= length && e + 1 < section.size()) break;
      around.emplace_back(edge.at(std::min(s / length, 1.0)) - behind * inward, inward);
    }
    start += length;
  }
  VOUSSOIR_ASSERT(static_cast<int>(around.size()) == sampling.around, "all points are placed");
  std::vector<OutlinePoint> points;
  points.reserve(around.size() * static_cast<std::size_t>(sampling.stretches * sampling.along));
  for (int stretch = 0; stretch < sampling.stretches; ++stretch)
    for (int k = 0; k < sampling.along; ++k) {
      const double y =
          sampling.middle(stretch) + ((k + 0.5) / sampling.along - 0.5) * sampling.length();
      for (const auto& [place, inward] : around)
        points.push_back({tunnel.in_space(place, y),
                          tunnel.in_space(inward, 0) - tunnel.in_space({0, 0}, 0), stretch});
    }
  return points;
}

VOUSSOIR_INLINE std::vector<BoxOfPoints> boxes_of_rows(const std::vector<OutlinePoint>& points,
                                                       std::size_t row) {
  VOUSSOIR_ASSERT(row > 0 && points.size() % row == 0, "rows are whole");
  std::vector<BoxOfPoints> boxes;
  BoxOfPoints all{points.front().place, points.front().place};
  for (std::size_t begin = 0; begin < points.size(); begin += row) {
    BoxOfPoints box{points[begin].place, points[begin].place};
    for (std::size_t k = begin; k < begin + row; ++k) {
      box.low = smaller_of(box.low, points[k].place);
      box.high = larger_of(box.high, points[k].place);
    }
    all = {smaller_of(all.low, box.low), larger_of(all.high, box.high)};
    boxes.push_back(box);
  }
  boxes.push_back(all);
  return boxes;
}

}  // namespace detail

#endif

}  // namespace voussoir
