// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/contact_area.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_facet.hpp>

namespace voussoir {

/// The edges of a contact in 3-D, as its four points see them.
///
/// Coordinates are counted from the centroid in radii of gyration along the principal axes, so that
/// all second moments are 1 and the points lie at +-sqrt(2) on the axes, in the order in which
/// `gauss_points` gives them. They stay what they are however the contact is turned, told from the
/// other side or weighed.
struct ContactOutline {
  struct Edge {
    double from[2], to[2];
  };
  std::vector<Edge> edges;  ///< anticlockwise round every facet; inner ones cancel
  double radius = 0;        ///< of the farthest corner
  double area = 0;          ///< in these coordinates
};

namespace detail {

/// What a contact keeps of its outline: nothing in 2-D, where the two points tell the ends.
template <int Dim>
struct KeptOutline {};
template <>
struct KeptOutline<3> {
  std::shared_ptr<const ContactOutline> edges;  ///< null: all of it is pressed, or nothing
  double radius = 0;                            ///< of the outline, read before it is looked at

  KeptOutline() = default;
  explicit KeptOutline(std::shared_ptr<const ContactOutline> of)
      : edges(std::move(of)), radius(edges != nullptr ? edges->radius : 0) {}
};

/// The outline of an area, from its points; none where there are not four or it is no wider than a
/// line.
/// @param facets  of the area;  @param centre  of it;  @param points  from the centre
[[nodiscard]] VOUSSOIR_INLINE std::shared_ptr<const ContactOutline> outline_of(
    const SpatialFacet* facets, std::size_t count, const Vec3& centre, const FacetPoint<3>* points,
    std::size_t point_count);

[[nodiscard]] inline KeptOutline<3> kept_outline(const SpatialFacet& facet, const Vec3& centre,
                                                 const FacetPoint<3>* points, std::size_t count) {
  return KeptOutline<3>(outline_of(&facet, 1, centre, points, count));
}
[[nodiscard]] inline KeptOutline<3> kept_outline(const ContactArea<3>& area, const Vec3& centre,
                                                 const FacetPoint<3>* points, std::size_t count) {
  return KeptOutline<3>(
      outline_of(area.facets().data(), area.facets().size(), centre, points, count));
}
template <class Area>
[[nodiscard]] KeptOutline<2> kept_outline(const Area&, const Vec2&, const FacetPoint<2>*,
                                          std::size_t) {
  return {};
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::shared_ptr<const ContactOutline> outline_of(const SpatialFacet* facets,
                                                                 std::size_t count,
                                                                 const Vec3& centre,
                                                                 const FacetPoint<3>* points,
                                                                 std::size_t point_count) {
  if (point_count != 4) return nullptr;
  const double first = squared_length_of(points[0].offset),
               second = squared_length_of(points[2].offset);
  if (!(std::min(first, second) > 1e-20 * std::max(first, second))) return nullptr;
  const Vec3 along = (std::sqrt(2.0) / first) * points[0].offset,
             across = (std::sqrt(2.0) / second) * points[2].offset;
  auto outline = std::make_shared<ContactOutline>();
  for (std::size_t f = 0; f < count; ++f) {
    const std::vector<Vec3>& v = facets[f].vertices;
    double doubled = 0;
    const std::size_t begin = outline->edges.size();
    const auto corner = [&](std::size_t k) {
      const Vec3 arm = v[k] - centre;
      return std::array{dot_product(along, arm), dot_product(across, arm)};
    };
    for (std::size_t k = 0; k < v.size(); ++k) {
      const auto from = corner(k), to = corner(k + 1 == v.size() ? 0 : k + 1);
      doubled += from[0] * to[1] - from[1] * to[0];
      outline->edges.push_back({{from[0], from[1]}, {to[0], to[1]}});
      outline->radius = std::max(outline->radius, std::hypot(from[0], from[1]));
    }
    // The second axis may lie on either side of the first.
    if (doubled < 0)
      for (std::size_t k = begin; k < outline->edges.size(); ++k)
        std::swap(outline->edges[k].from, outline->edges[k].to);
    outline->area += 0.5 * std::abs(doubled);
  }
  return outline->area > 0 ? outline : nullptr;
}

#endif

}  // namespace detail
}  // namespace voussoir
