// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>

namespace voussoir {

/// Integrals over a shape of unit density.
template <int Dim>
struct MassProperties {
  using Inertia = Eigen::Matrix<double, spin_count<Dim>, spin_count<Dim>>;
  double measure = 0;                       ///< area [m^2] or volume [m^3]
  Vec<Dim> centroid = Vec<Dim>::Zero();     ///< [m]
  Inertia second_moment = Inertia::Zero();  ///< about the centroid; 2-D: polar moment [m^4]
};

/// Area, centroid and polar second moment of a simple polygon (Green's theorem).
///
/// @param vertices  anticlockwise [m]; convexity is not needed
/// @cost  O(n), no allocation
///
/// Works relative to the first vertex: at mine-grid coordinates (1e6 m) the textbook sum loses all
/// digits of the polar moment of a 1 m block.
[[nodiscard]] inline MassProperties<2> mass_properties(std::span<const Vec2> vertices) {
  double area = 0, polar = 0;
  Vec2 first_moment = Vec2::Zero();
  const Vec2 origin = vertices.front();
  for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
    const Vec2 a = vertices[k] - origin, b = vertices[k + 1] - origin;
    const double triangle = 0.5 * cross(a, b);
    area += triangle;
    first_moment += triangle / 3.0 * (a + b);
    polar += triangle / 6.0 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
  }
  MassProperties<2> result;
  result.measure = area;
  const Vec2 offset = first_moment / area;
  result.centroid = origin + offset;
  result.second_moment(0, 0) = polar - area * offset.squaredNorm();
  return result;
}

[[nodiscard]] inline MassProperties<2> mass_properties(const ConvexPolygon& polygon) {
  return mass_properties(std::span<const Vec2>(polygon.vertices()));
}

/// Properties of several shapes that move as one rigid body (parallel-axis theorem).
template <class Shape>
[[nodiscard]] MassProperties<Shape::dim> mass_properties(const std::vector<Shape>& parts) {
  constexpr int dim = Shape::dim;
  if (parts.size() == 1) return mass_properties(parts.front());
  std::vector<MassProperties<dim>> each;
  MassProperties<dim> whole;
  for (const Shape& part : parts) {
    each.push_back(mass_properties(part));
    whole.measure += each.back().measure;
    whole.centroid += each.back().measure * each.back().centroid;
  }
  whole.centroid /= whole.measure;
  for (const MassProperties<dim>& part : each) {
    const Vec<dim> r = part.centroid - whole.centroid;
    whole.second_moment += part.second_moment;
    if constexpr (dim == 2) {
      whole.second_moment(0, 0) += part.measure * r.squaredNorm();
    } else {
      whole.second_moment +=
          part.measure * (r.squaredNorm() * Stress<dim>::Identity() - r * r.transpose());
    }
  }
  return whole;
}

}  // namespace voussoir
