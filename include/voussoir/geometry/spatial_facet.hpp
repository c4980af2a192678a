// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/detail/inertia_axes.hpp>
#include <voussoir/geometry/detail/surface.hpp>
#include <voussoir/geometry/segment.hpp>

namespace voussoir {

/// A flat convex polygon in 3-D: a contact, a piece of a face, a piece of tunnel wall.
struct SpatialFacet {
  std::vector<Vec3> vertices;  ///< anticlockwise seen from where the area vector points [m]

  /// Unit normal times area [m^2]. The sum over a closed surface is zero to rounding, which is what
  /// puts blocks in equilibrium.
  [[nodiscard]] Vec3 area_vector() const {
    return 0.5 * detail::doubled_area(vertices.size(),
                                      [&](std::size_t k) -> const Vec3& { return vertices[k]; });
  }
  /// Area [m^2].
  [[nodiscard]] double measure() const { return length_of(area_vector()); }
  [[nodiscard]] Vec3 centre() const { return vertices.front() + centre_from(vertices.front()); }
  /// Centroid as seen from `origin`; exact where `origin` is near, wherever both are.
  [[nodiscard]] Vec3 centre_from(const Vec3& origin) const {
    return (vertices.front() - origin) + centroid_arm();
  }

  /// Four points that integrate polynomials of degree 2 over the facet exactly: the centroid
  /// +- sqrt(2) r_k e_k, with r_k the radii of gyration about the centroid along the principal
  /// axes e_k. Where all axes are principal (a square) the outline tells which: see
  /// `detail::arms_of_round`.
  ///
  /// They lie in the facet: a convex body of n dimensions contains its ellipsoid of inertia
  /// enlarged by sqrt((n + 2) / n), which is sqrt(2) in a plane. Source: Kannan, Lovasz &
  /// Simonovits (1995), Isoperimetric problems for convex bodies and a localization lemma.
  ///
  /// A facet without area gives points at its centre that weigh nothing.
  [[nodiscard]] std::array<FacetPoint<3>, 4> gauss_points() const {
    const Vec3 doubled = 2 * area_vector();
    const double area = 0.5 * length_of(doubled);
    if (!(area > 0)) return {};
    const Vec3 normal = doubled / (2 * area);
    const auto [along, across] = gyration(normal, area);
    const double weight = 0.25 * area;
    return {FacetPoint<3>{along, weight}, FacetPoint<3>{-along, weight},
            FacetPoint<3>{across, weight}, FacetPoint<3>{-across, weight}};
  }

 private:
  /// Principal axes, as long as sqrt(2) times the radius of gyration along them.
  [[nodiscard]] std::array<Vec3, 2> gyration(const Vec3& normal, double area) const;

  /// From the first vertex to the centroid.
  [[nodiscard]] Vec3 centroid_arm() const;
};

namespace detail {

[[nodiscard]] inline std::span<const Vec2> corners_of(const Segment& facet) {
  return {&facet.start, 2};
}
[[nodiscard]] inline std::span<const Vec3> corners_of(const SpatialFacet& facet) {
  return facet.vertices;
}

}  // namespace detail

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::array<Vec3, 2> SpatialFacet::gyration(const Vec3& normal, double area) const {
  // Along the longest edge the second moments of a thin facet are nearly uncoupled, and its small
  // one keeps its digits.
  Vec3 first = zeros<Vec3>();
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Vec3 edge = vertices[k + 1 == vertices.size() ? 0 : k + 1] - vertices[k];
    if (squared_length_of(edge) > (1 + 1e-9) * squared_length_of(first)) first = edge;
  }
  first = normalized(first);
  detail::PlaneMoments moments{first, cross(normal, first)};
  const Vec3 about = -centroid_arm();
  detail::add_moments(vertices, normal, about, area, moments);
  if (!detail::is_round(moments)) return detail::arms_of(moments);
  return detail::arms_of_round(moments,
                               detail::fourth_moment(vertices, normal, about, moments) / area);
}

VOUSSOIR_INLINE Vec3 SpatialFacet::centroid_arm() const {
  const Vec3 normal = normalized(area_vector());
  Vec3 sum = zeros<Vec3>();
  double weight = 0;
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
    const Vec3 a = vertices[k] - vertices[0], b = vertices[k + 1] - vertices[0];
    const double doubled = dot_product(normal, cross(a, b - a));
    weight += doubled;
    sum += doubled / 3.0 * (a + b);
  }
  return weight > 0 ? Vec3(sum / weight) : sum;
}

#endif

}  // namespace voussoir
