// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
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
  /// axes e_k. Where all axes are principal (a square) the longest edge is one of them.
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
  const Vec3 second = cross(normal, first), centre = centroid_arm();
  // Second moments of the triangles of a fan about its tip, over the area.
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
    const Vec3 a = vertices[k] - vertices[0], b = vertices[k + 1] - vertices[0];
    const double share = dot_product(normal, cross(a, b - a)) / (2 * area) / 12;
    const double ax = dot_product(a, first), ay = dot_product(a, second),
                 bx = dot_product(b, first), by = dot_product(b, second);
    const double sx = ax + bx, sy = ay + by;
    xx += share * (ax * ax + bx * bx + sx * sx);
    yy += share * (ay * ay + by * by + sy * sy);
    xy += share * (ax * ay + bx * by + sx * sy);
  }
  const double cx = dot_product(centre, first), cy = dot_product(centre, second);
  xx -= cx * cx;
  yy -= cy * cy;
  xy -= cx * cy;
  const double half_difference = 0.5 * (xx - yy), mean = 0.5 * (xx + yy);
  const double radius = std::hypot(half_difference, xy);
  const double angle = radius > 1e-12 * mean ? 0.5 * std::atan2(xy, half_difference) : 0.0;
  const Vec3 major = std::cos(angle) * first + std::sin(angle) * second;
  const double large = mean + radius;
  const double small = std::fmax(0.0, (xx * yy - xy * xy) / large);  // the determinant over large
  return {std::sqrt(2 * large) * major, std::sqrt(2 * small) * cross(normal, major)};
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
