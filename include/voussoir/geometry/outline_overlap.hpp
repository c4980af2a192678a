// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

namespace voussoir {

/// A point that lies in both outlines, or nothing: outlines that share edges or corners touch.
///
/// Every edge is parted where it meets the other outline; if they overlap, the ground just inside
/// one of the parts lies in both.
///
/// @param tolerance  outlines that overlap by no more than this count as touching [m], > 0
/// @cost  O(edges of a x edges of b), for every part again the edges of one
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec2> overlap_of(const SimplePolygon& a,
                                                             const SimplePolygon& b,
                                                             double tolerance);

/// True if all of `b` lies in `a`, but for what reaches out of it by no more than the tolerance.
/// @pre  they overlap
[[nodiscard]] VOUSSOIR_INLINE bool encloses(const SimplePolygon& a, const SimplePolygon& b,
                                            double tolerance);

#if VOUSSOIR_BODIES

namespace detail {

/// Where an edge meets the line of others within their length, as parts of it: 0, ..., 1.
[[nodiscard]] VOUSSOIR_INLINE std::vector<double> meetings(const Segment& edge,
                                                           const SimplePolygon& other) {
  std::vector<double> at{0, 1};
  const Vec2 d = edge.end - edge.start;
  const double squared = dot_product(d, d);
  for (std::size_t k = 0; k < other.size(); ++k) {
    const auto [p, q] = other.edge(k);
    // The corner of the other, for edges along each other; then the crossing.
    at.push_back(dot_product(d, p - edge.start) / squared);
    const double det = cross(d, q - p);
    if (det != 0) at.push_back(cross(p - edge.start, q - p) / det);
  }
  for (double& t : at) t = std::clamp(t, 0.0, 1.0);
  std::sort(at.begin(), at.end());
  return at;
}

/// Visits points of `a` just inside its edges, one for every part between meetings with `b`.
/// @param seen  seen(point), returns false to stop
template <class Seen>
void visit_inside(const SimplePolygon& a, const SimplePolygon& b, double tolerance, Seen&& seen) {
  for (std::size_t e = 0; e < a.size(); ++e) {
    const Segment edge = a.edge(e);
    const Vec2 inwards = normalized(perpendicular(edge.end - edge.start));
    const std::vector<double> at = meetings(edge, b);
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      if ((at[k + 1] - at[k]) * edge.length() <= 4 * tolerance) continue;
      const Vec2 p = edge.at(0.5 * (at[k] + at[k + 1])) + tolerance * inwards;
      if (a.contains(p) && !seen(p)) return;
    }
  }
}

[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec2> inside_of_both(const SimplePolygon& a,
                                                                 const SimplePolygon& b,
                                                                 double tolerance) {
  std::optional<Vec2> found;
  visit_inside(a, b, tolerance, [&](const Vec2& p) {
    if (b.contains(p)) found = p;
    return !found;
  });
  return found;
}

}  // namespace detail

VOUSSOIR_INLINE std::optional<Vec2> overlap_of(const SimplePolygon& a, const SimplePolygon& b,
                                               double tolerance) {
  const auto place = detail::inside_of_both(a, b, tolerance);
  return place ? place : detail::inside_of_both(b, a, tolerance);
}

VOUSSOIR_INLINE bool encloses(const SimplePolygon& a, const SimplePolygon& b, double tolerance) {
  bool is_inside = true;
  detail::visit_inside(b, a, tolerance, [&](const Vec2& p) { return is_inside = a.contains(p); });
  return is_inside;
}

#endif

}  // namespace voussoir
