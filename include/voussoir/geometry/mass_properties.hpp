// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>

namespace voussoir {

/// Integrals over a shape of unit density.
template <int Dim>
struct MassProperties {
  using Inertia = Fixed<spin_count<Dim>, spin_count<Dim>>;
  double measure = 0;                     ///< area [m^2] or volume [m^3]
  Vec<Dim> centroid = zeros<Vec<Dim>>();  ///< [m]
  /// About the centroid; 2-D: polar moment [m^4]; 3-D: inertia tensor, the integral of
  /// r.r I - r r^T [m^5].
  Inertia second_moment = zeros<Inertia>();
};

/// Square of a distance from the centroid beyond which a convex shape has no point [m^2]: d (d + 2)
/// times the mean square distance of its points.
///
/// Of all convex shapes with the same spread along an axis, a triangle or a cone reaches farthest
/// along it: to sqrt(d (d + 2)) standard deviations.
///
/// Source: Kannan, Lovasz and Simonovits (1995), Isoperimetric problems for convex bodies and a
/// localization lemma, Discrete Comput. Geom. 13, 541-559, theorem 4.1.
template <int Dim>
[[nodiscard]] double squared_reach(const MassProperties<Dim>& of) {
  const double squares = of.second_moment.trace() / (Dim - 1);  // the integral of r.r
  return Dim * (Dim + 2) * squares / of.measure;
}

/// Area, centroid and polar second moment of a simple polygon (Green's theorem).
///
/// @param vertices  anticlockwise [m]; convexity is not needed
/// @cost  O(n), no allocation
///
/// Works relative to the first vertex: at mine-grid coordinates (1e6 m) the textbook sum loses all
/// digits of the polar moment of a 1 m block.
[[nodiscard]] VOUSSOIR_INLINE MassProperties<2> mass_properties(std::span<const Vec2> vertices);

[[nodiscard]] inline MassProperties<2> mass_properties(const ConvexPolygon& polygon) {
  return mass_properties({polygon.vertices().data(), polygon.size()});
}

/// Volume, centroid and inertia tensor, from tetrahedra between one vertex and the faces that do
/// not meet it.
///
/// @cost  O(vertices), no allocation
///
/// Works relative to that vertex, for the reason given above.
[[nodiscard]] VOUSSOIR_INLINE MassProperties<3> mass_properties(const ConvexPolyhedron& polyhedron);

/// Properties of several shapes that move as one rigid body (parallel-axis theorem).
template <class Shape>
[[nodiscard]] MassProperties<Shape::dim> mass_properties(const std::vector<Shape>& parts) {
  constexpr int dim = Shape::dim;
  VOUSSOIR_ASSERT(!parts.empty(), "a body has a part");
  if (parts.size() == 1) return mass_properties(parts.front());
  std::vector<MassProperties<dim>> each;
  MassProperties<dim> whole;
  for (const Shape& part : parts) {
    each.push_back(mass_properties(part));
    whole.measure += each.back().measure;
    // Relative to the first part: far from the origin a centroid has few digits to lose.
    whole.centroid += each.back().measure * (each.back().centroid - each.front().centroid);
  }
  whole.centroid = each.front().centroid + whole.centroid / whole.measure;
  for (const MassProperties<dim>& part : each) {
    const Vec<dim> r = part.centroid - whole.centroid;
    whole.second_moment += part.second_moment;
    if constexpr (dim == 2) {
      whole.second_moment(0, 0) += part.measure * r.squaredNorm();
    } else {
      whole.second_moment += part.measure * (diagonal_of<dim>(r.squaredNorm()) - outer(r, r));
    }
  }
  return whole;
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE MassProperties<2> mass_properties(std::span<const Vec2> vertices) {
  VOUSSOIR_ASSERT(vertices.size() >= 3, "an area has three corners at least");
  double area = 0, polar = 0;
  Vec2 first_moment = zeros<Vec2>();
  const Vec2& origin = vertices.front();
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
    const Vec2 a = vertices[k] - origin, b = vertices[k + 1] - origin;
    const double triangle = 0.5 * cross(a, b);
    area += triangle;
    first_moment += triangle / 3.0 * (a + b);
    polar += triangle / 6.0 * (squared_length_of(a) + dot_product(a, b) + squared_length_of(b));
  }
  MassProperties<2> result;
  result.measure = area;
  const Vec2 offset = first_moment / area;
  result.centroid = origin + offset;
  result.second_moment(0, 0) = polar - area * squared_length_of(offset);
  return result;
}

VOUSSOIR_INLINE MassProperties<3> mass_properties(const ConvexPolyhedron& polyhedron) {
  const Vec3 origin = polyhedron.vertex(0);
  double volume = 0;
  Vec3 first_moment = zeros<Vec3>();
  Fixed<3, 3> second = zeros<Fixed<3, 3>>();  // integral of r r^T
  for (std::size_t k = 0; k < polyhedron.size(); ++k) {
    const std::span<const int> loop = polyhedron.loop(k);
    const auto arm = [&](std::size_t i) -> Vec3 {
      return polyhedron.vertex(static_cast<std::size_t>(loop[i])) - origin;
    };
    const Vec3 a = arm(0);
    Vec3 b = arm(1);
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Vec3 c = arm(i), sum = a + b + c;
      // Edges, not arms: of a needle one is short, and the product is exact to its own size.
      const double tetrahedron = dot_product(a, cross(b - a, c - b)) / 6.0;
      volume += tetrahedron;
      first_moment += tetrahedron / 4.0 * sum;
      second += tetrahedron / 20.0 * (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum));
      b = c;
    }
  }
  MassProperties<3> result;
  result.measure = volume;
  const Vec3 offset = first_moment / volume;
  result.centroid = origin + offset;
  second -= outer(Vec3(volume * offset), offset);
  // Sums of two diagonal entries, not trace minus the third: the small moment of a needle about
  // its own axis keeps its digits.
  result.second_moment = -second;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    result.second_moment(i, i) = second(j, j) + second(k, k);
  }
  return result;
}

#endif

}  // namespace voussoir
