// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/detail/inertia_axes.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_facet.hpp>

namespace voussoir {

/// All that two bodies share of one plane: several facets that make one contact.
///
/// A body that an opening has cut consists of convex parts, and where the cuts ran that made them
/// says nothing about the rock. Parts meet the neighbour in several facets, which may have gaps
/// between them; force and moment of the closed joint between the two rigid bodies depend on the
/// area, its centroid and its second moments alone, and these add. So do the integration points
/// that follow from them: they are the same, to rounding, however the area is divided into facets
/// and in whatever order these are added. Those of a single facet are the facet's own.
///
/// Asked as a facet is: `area_vector`, `measure`, `centre`, `centre_from`, `gauss_points`.
template <int Dim>
class ContactArea;

template <>
class ContactArea<2> {
 public:
  /// @pre  all on one line, in one direction; the first has a length
  void add(const Segment& facet) { facets_.push_back(facet); }
  [[nodiscard]] const std::vector<Segment>& facets() const { return facets_; }

  [[nodiscard]] Vec2 area_vector() const {
    Vec2 sum = zeros<Vec2>();
    for (const Segment& f : facets_) sum += f.area_vector();
    return sum;
  }
  [[nodiscard]] double measure() const { return length_of(area_vector()); }
  [[nodiscard]] Vec2 centre() const {
    return facets_.front().start + centre_from(facets_.front().start);
  }
  /// Centroid as seen from `origin`; exact where `origin` is near, wherever both are.
  [[nodiscard]] Vec2 centre_from(const Vec2& origin) const {
    Vec2 sum = zeros<Vec2>();
    double whole = 0;
    for (const Segment& f : facets_) {
      sum += f.length() * f.centre_from(origin);
      whole += f.length();
    }
    return sum / whole;
  }

  /// Two points at the radius of gyration from the centroid, each with half of the length: exact
  /// for a linear traction, in force and moment. Of one segment: its two Gauss points.
  [[nodiscard]] VOUSSOIR_INLINE std::array<FacetPoint<2>, 2> gauss_points() const;

  /// The outermost two ends and a point between, as Lobatto's rule has them for this area: exact
  /// for polynomials of degree 3, and no weight is negative. Of one segment: Simpson's rule. Where
  /// there are gaps the middle point may lie in one.
  [[nodiscard]] VOUSSOIR_INLINE std::array<FacetPoint<2>, 3> corner_points() const;

 private:
  std::vector<Segment> facets_;
};

template <>
class ContactArea<3> {
 public:
  /// @pre  all in one plane, seen anticlockwise from the same side; the first has an area
  void add(SpatialFacet facet) { facets_.push_back(std::move(facet)); }
  [[nodiscard]] const std::vector<SpatialFacet>& facets() const { return facets_; }

  [[nodiscard]] Vec3 area_vector() const {
    Vec3 sum = zeros<Vec3>();
    for (const SpatialFacet& f : facets_) sum += f.area_vector();
    return sum;
  }
  [[nodiscard]] double measure() const { return length_of(area_vector()); }
  [[nodiscard]] Vec3 centre() const {
    const Vec3& near = facets_.front().vertices.front();
    return near + centre_from(near);
  }
  /// Centroid as seen from `origin`; exact where `origin` is near, wherever both are.
  [[nodiscard]] Vec3 centre_from(const Vec3& origin) const {
    Vec3 sum = zeros<Vec3>();
    double whole = 0;
    for (const SpatialFacet& f : facets_) {
      const double area = f.measure();
      sum += area * f.centre_from(origin);
      whole += area;
    }
    return sum / whole;
  }

  /// Four points as those of one facet, from the second moments of all.
  [[nodiscard]] VOUSSOIR_INLINE std::array<FacetPoint<3>, 4> gauss_points() const;

 private:
  std::vector<SpatialFacet> facets_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::array<FacetPoint<2>, 2> ContactArea<2>::gauss_points() const {
  VOUSSOIR_ASSERT(!facets_.empty(), "a contact area has a facet");
  const Vec2 vector = area_vector(), middle = centre();
  const double whole = length_of(vector);
  VOUSSOIR_ASSERT(whole > 0, "a contact area has a length");
  const Vec2 along = perpendicular(vector) / whole;
  double squared = 0;
  for (const Segment& f : facets_) {
    const double length = f.length(), arm = dot_product(along, f.centre_from(middle));
    squared += length / whole * (length * length / 12 + arm * arm);
  }
  const Vec2 offset = std::sqrt(squared) * along;
  return {FacetPoint<2>{-offset, 0.5 * whole}, FacetPoint<2>{offset, 0.5 * whole}};
}

VOUSSOIR_INLINE std::array<FacetPoint<2>, 3> ContactArea<2>::corner_points() const {
  const Vec2 vector = area_vector(), centroid = centre();
  const double whole = length_of(vector);
  const Vec2 along = perpendicular(vector) / whole;
  double low = 0, high = 0;
  for (const Segment& f : facets_) {
    low = std::fmin(low, dot_product(along, f.start - centroid));
    high = std::fmax(high, dot_product(along, f.end - centroid));
  }
  // Moments on [-1, 1], over the length: of every segment by its own two Gauss points.
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  std::array<double, 4> moment{};
  for (const Segment& f : facets_)
    for (const FacetPoint<2>& p : f.gauss_points()) {
      const Vec2 place = f.centre_from(centroid) + p.offset;
      const double x = (dot_product(along, place) - middle) / half;
      double power = p.weight / whole;
      for (double& m : moment) {
        m += power;
        power *= x;
      }
    }
  // The inner point is where the polynomial of degree 1 is zero that is orthogonal to 1 under the
  // weight 1 - x^2.
  const double inner_weight = moment[0] - moment[2];
  VOUSSOIR_ASSERT(inner_weight > 0, "a contact area is not all at its ends");
  const double x = (moment[1] - moment[3]) / inner_weight;
  const double inner = inner_weight / (1 - x * x);
  const double sum = moment[0] - inner, difference = moment[1] - inner * x;
  return {FacetPoint<2>{low * along, 0.5 * (sum - difference) * whole},
          FacetPoint<2>{(middle + x * half) * along, inner * whole},
          FacetPoint<2>{high * along, 0.5 * (sum + difference) * whole}};
}

VOUSSOIR_INLINE std::array<FacetPoint<3>, 4> ContactArea<3>::gauss_points() const {
  VOUSSOIR_ASSERT(!facets_.empty(), "a contact area has a facet");
  const Vec3 vector = area_vector(), middle = centre();
  const double area = length_of(vector);
  VOUSSOIR_ASSERT(area > 0, "a contact area has an area");
  const Vec3 normal = vector / area;
  // Along the spread of a thin area, known from a first look, the small moment keeps its digits.
  Vec3 first = zeros<Vec3>();
  for (const SpatialFacet& f : facets_)
    for (const Vec3& v : f.vertices)
      first = squared_length_of(v - middle) > squared_length_of(first) ? Vec3(v - middle) : first;
  first = normalized(first - dot_product(normal, first) * normal);
  detail::PlaneMoments moments{first, cross(normal, first)};
  const auto add_all = [&] {
    for (const SpatialFacet& f : facets_)
      detail::add_moments(f.vertices, normal, f.vertices.front() - middle, area, moments);
  };
  add_all();
  if (!detail::is_round(moments)) {
    first = normalized(detail::arms_of(moments)[0]);
    moments = {first, cross(normal, first)};
    add_all();
  }
  std::array<Vec3, 2> arms;
  if (detail::is_round(moments)) {
    std::complex<double> fourth = 0;
    for (const SpatialFacet& f : facets_)
      fourth += detail::fourth_moment(f.vertices, normal, f.vertices.front() - middle, moments);
    arms = detail::arms_of_round(moments, fourth / area);
  } else {
    arms = detail::arms_of(moments);
  }
  const double weight = 0.25 * area;
  return {FacetPoint<3>{arms[0], weight}, FacetPoint<3>{-arms[0], weight},
          FacetPoint<3>{arms[1], weight}, FacetPoint<3>{-arms[1], weight}};
}

#endif

}  // namespace voussoir
