// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_facet.hpp>
#include <voussoir/geometry/tangent_basis.hpp>

namespace voussoir {

/// Makes one of facets that lie side by side in one plane and are a segment, in 3-D a convex
/// polygon, together; others stay as they are. Into which convex parts carving has divided a body,
/// which differs in the mirror, then does not show in what it shares with another.
///
/// @param facets     none overlaps another; those that look to opposite sides are not joined
/// @param tolerance  half of the distance at which corners are one, and on one line or plane [m]
/// @cost  the square of their number, which is small
[[nodiscard]] VOUSSOIR_INLINE std::vector<Segment> joined_facets(std::vector<Segment> facets,
                                                                 double tolerance);
[[nodiscard]] VOUSSOIR_INLINE std::vector<SpatialFacet> joined_facets(
    std::vector<SpatialFacet> facets, double tolerance);

#if VOUSSOIR_BODIES

namespace detail {

/// The segment that two make, one after the other in either order.
[[nodiscard]] inline std::optional<Segment> convex_union(const Segment& a, const Segment& b,
                                                         double tolerance) {
  const auto meet = [&](const Vec2& p, const Vec2& q) { return length_of(p - q) <= 2 * tolerance; };
  const bool is_before = meet(a.end, b.start), is_after = meet(b.end, a.start);
  if (is_before == is_after) return {};
  const Segment both = is_before ? Segment{a.start, b.end} : Segment{b.start, a.end};
  const Vec2 way = both.end - both.start, to_middle = (is_before ? a.end : b.end) - both.start;
  if (!(dot_product(way, to_middle) > 0) ||
      std::abs(cross(way, to_middle)) > 2 * tolerance * length_of(way))
    return {};
  return both;
}

/// The corners of the convex polygon round points, anticlockwise, without those that are on its
/// sides, to twice the tolerance. Source: Andrew (1979), Another efficient algorithm for convex
/// hulls in two dimensions.
/// @return  numbers of points
[[nodiscard]] inline std::vector<std::size_t> convex_outline(const std::vector<Vec2>& points,
                                                             double tolerance) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (std::none_of(order.begin(), order.end(), [&](std::size_t other) {
          return length_of(points[k] - points[other]) <= 2 * tolerance;
        }))
      order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].x() != points[b].x() ? points[a].x() < points[b].x()
                                          : points[a].y() < points[b].y();
  });
  std::vector<std::size_t> outline;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t first = outline.size();
    for (auto k = begin; k != end; ++k) {
      while (outline.size() >= first + 2) {
        const Vec2 &a = points[outline[outline.size() - 2]], &b = points[outline.back()];
        const Vec2 way = points[*k] - a;
        if (cross(Vec2(b - a), way) > 2 * tolerance * length_of(way)) break;
        outline.pop_back();
      }
      outline.push_back(*k);
    }
    outline.pop_back();  // the next chain begins with it
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  return outline;
}

/// The convex polygon round all, if they fill it.
[[nodiscard]] inline std::optional<SpatialFacet> convex_union(
    const std::vector<SpatialFacet>& facets, double tolerance) {
  const Vec3& origin = facets.front().vertices.front();
  const TangentBasis<3> along = tangent_basis(normalized(facets.front().area_vector()));
  std::vector<Vec2> places;
  std::vector<Vec3> corners;
  double filled = 0;
  for (const SpatialFacet& facet : facets) {
    filled += facet.measure();
    for (const Vec3& v : facet.vertices) {
      places.push_back(transposed_product(along, Vec3(v - origin)));
      corners.push_back(v);
    }
  }
  SpatialFacet whole;
  double perimeter = 0;
  const std::vector<std::size_t> outline = convex_outline(places, tolerance);
  if (outline.size() < 3) return {};  // slivers, no wider than the tolerance
  for (std::size_t last = outline.back(); const std::size_t k : outline) {
    perimeter += length_of(corners[k] - corners[last]);
    whole.vertices.push_back(corners[k]);
    last = k;
  }
  if (std::abs(whole.measure() - filled) > 2 * tolerance * perimeter) return {};
  return whole;
}
[[nodiscard]] inline std::optional<SpatialFacet> convex_union(const SpatialFacet& a,
                                                              const SpatialFacet& b,
                                                              double tolerance) {
  return convex_union({a, b}, tolerance);
}

/// Two by two, again and again: one that comes late may lie between two that did not meet.
template <class Facet>
[[nodiscard]] std::vector<Facet> joined_by_twos(std::vector<Facet> facets, double tolerance) {
  std::vector<Facet> made;
  for (Facet& facet : facets) {
    for (std::size_t k = 0; k < made.size();) {
      auto both = convex_union(made[k], facet, tolerance);
      if (!both) {
        ++k;
        continue;
      }
      facet = std::move(*both);
      made.erase(made.begin() + static_cast<std::ptrdiff_t>(k));
      k = 0;
    }
    made.push_back(std::move(facet));
  }
  return made;
}

}  // namespace detail

VOUSSOIR_INLINE std::vector<Segment> joined_facets(std::vector<Segment> facets, double tolerance) {
  return detail::joined_by_twos(std::move(facets), tolerance);
}

VOUSSOIR_INLINE std::vector<SpatialFacet> joined_facets(std::vector<SpatialFacet> facets,
                                                        double tolerance) {
  std::vector<SpatialFacet> made;
  while (!facets.empty()) {
    // The largest tells the plane best, whichever comes first.
    std::iter_swap(facets.begin(),
                   std::max_element(facets.begin(), facets.end(), [](const auto& a, const auto& b) {
                     return a.measure() < b.measure();
                   }));
    const Vec3 normal = normalized(facets.front().area_vector()),
               at = facets.front().vertices.front();
    const auto others =
        std::stable_partition(facets.begin() + 1, facets.end(), [&](const SpatialFacet& facet) {
          return dot_product(normal, facet.area_vector()) > 0 &&
                 std::all_of(facet.vertices.begin(), facet.vertices.end(), [&](const Vec3& v) {
                   return std::abs(dot_product(normal, v - at)) <= 2 * tolerance;
                 });
        });
    std::vector<SpatialFacet> in_plane(facets.begin(), others);
    facets.erase(facets.begin(), others);
    // All at once first: by twos, what is left may depend on which come first.
    if (auto whole = detail::convex_union(in_plane, tolerance))
      in_plane = {std::move(*whole)};
    else
      in_plane = detail::joined_by_twos(std::move(in_plane), tolerance);
    made.insert(made.end(), in_plane.begin(), in_plane.end());
  }
  return made;
}

#endif

}  // namespace voussoir
