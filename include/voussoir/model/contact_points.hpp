// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/contact_area.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_facet.hpp>

namespace voussoir {

/// Where on a contact the joint's springs stand.
///
/// All but `centre` give the force and the moment of a closed joint exactly. What tells them apart
/// is a joint that opens: a block that tips turns about its outermost point.
enum class ContactPoints {
  /// One, in the middle: resists no turning, as in the paper's code. Good for joints that stay
  /// closed: loose blocks pass through one another's corners.
  centre,
  gauss,   ///< two (2-D), four (3-D) inside: the fewest; a block tips about a point 21 % inside
  corners  ///< also on the corners: a block tips about its edge
};

/// A place on a contact and the length or area that it stands for.
template <int Dim>
struct WeightedPoint {
  Vec<Dim> place;  ///< [m]
  double weight;   ///< [m], [m^2]
};

/// The points of a contact in 2-D, from one end to the other.
///
///   corners: Simpson's rule, 1/6, 4/6, 1/6: exact for polynomials of degree 3, as two Gauss points
VOUSSOIR_INLINE void place_points(ContactPoints rule, std::span<const Vec2> ends, double length,
                                  std::vector<WeightedPoint<2>>& points);

/// The points of a contact in 3-D.
///
///   corners: the triangles of a fan about the centroid, each with 1/12 of its area on every corner
///   and 3/4 on its centroid: exact for polynomials of degree 2
VOUSSOIR_INLINE void place_points(ContactPoints rule, std::span<const Vec3> polygon, double area,
                                  std::vector<WeightedPoint<3>>& points);

/// The points of a contact in a facet, from its centre, in place of what is in `points`.
template <class Facet, int Dim>
void place_points_on(const Facet& facet, ContactPoints rule, std::vector<FacetPoint<Dim>>& points) {
  if (rule == ContactPoints::gauss) {
    const auto gauss = facet.gauss_points();
    points.assign(gauss.begin(), gauss.end());
    return;
  }
  std::vector<WeightedPoint<Dim>> places;
  if constexpr (Dim == 2)
    place_points(rule, std::array{facet.start, facet.end}, facet.measure(), places);
  else
    place_points(rule, facet.vertices, facet.measure(), places);
  points.clear();
  for (const WeightedPoint<Dim>& p : places) points.push_back({p.place - facet.centre(), p.weight});
}

/// The same in several facets that make one contact.
///
///   corners: in 2-D the outermost ends of all of them and a point between, exact for polynomials
///   of degree 3 (`ContactArea::corner_points`); in 3-D the points of every facet as if it stood
///   alone, exact for degree 2: there they do depend on how the area is divided
template <int Dim>
void place_points_on(const ContactArea<Dim>& area, ContactPoints rule,
                     std::vector<FacetPoint<Dim>>& points) {
  if (rule == ContactPoints::centre) {
    points.assign(1, {zeros<Vec<Dim>>(), area.measure()});
  } else if (rule == ContactPoints::gauss) {
    const auto gauss = area.gauss_points();
    points.assign(gauss.begin(), gauss.end());
  } else if constexpr (Dim == 2) {
    const auto corners = area.corner_points();
    points.assign(corners.begin(), corners.end());
  } else {
    points.clear();
    std::vector<FacetPoint<Dim>> of_facet;
    for (const auto& facet : area.facets()) {
      place_points_on(facet, rule, of_facet);
      const Vec<Dim> arm = -area.centre_from(facet.centre());
      for (const FacetPoint<Dim>& p : of_facet) points.push_back({arm + p.offset, p.weight});
    }
  }
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void place_points(ContactPoints rule, std::span<const Vec2> ends, double length,
                                  std::vector<WeightedPoint<2>>& points) {
  points.clear();
  const Vec2 middle = 0.5 * (ends[0] + ends[1]), half = 0.5 * (ends[1] - ends[0]);
  switch (rule) {
    case ContactPoints::centre:
      points = {{middle, length}};
      return;
    case ContactPoints::gauss: {
      const Vec2 off = half / std::sqrt(3.0);
      points = {{middle - off, 0.5 * length}, {middle + off, 0.5 * length}};
      return;
    }
    case ContactPoints::corners:
      points = {{ends[0], length / 6}, {middle, length / 1.5}, {ends[1], length / 6}};
      return;
  }
}

VOUSSOIR_INLINE void place_points(ContactPoints rule, std::span<const Vec3> polygon, double area,
                                  std::vector<WeightedPoint<3>>& points) {
  points.clear();
  const SpatialFacet facet{{polygon.begin(), polygon.end()}};
  const Vec3 centre = facet.centre();
  // What is seen along the normal of the contact, over the area: at most 1, unless rounding is all
  // there is of it.
  const double scale = area / facet.measure();
  if (rule == ContactPoints::centre || !(scale < 1.001)) {
    points.push_back({centre, area});
    return;
  }
  if (rule == ContactPoints::gauss) {
    for (const FacetPoint<3>& p : facet.gauss_points())
      points.push_back({centre + p.offset, scale * p.weight});
    return;
  }
  const std::size_t count = polygon.size();
  for (const Vec3& corner : polygon) points.push_back({corner, 0});
  points.push_back({centre, area / 12});
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = k + 1 == count ? 0 : k + 1;
    const double triangle =
        0.5 * scale * length_of(cross(Vec3(polygon[k] - centre), Vec3(polygon[next] - centre)));
    points[k].weight += triangle / 12;
    points[next].weight += triangle / 12;
    points.push_back({(centre + polygon[k] + polygon[next]) / 3, 0.75 * triangle});
  }
  // Of two corners in one place: a point that stands for nothing has no stress.
  std::erase_if(points, [](const WeightedPoint<3>& p) { return !(p.weight > 0); });
}

#endif

}  // namespace voussoir
