// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/linear_program.hpp>

namespace voussoir {

template <int Dim>
struct Ball {
  Vec<Dim> centre;  ///< [m]
  double radius;    ///< [m]
};

/// The largest circle (sphere) inside a convex shape, by a linear program in Dim + 1 unknowns:
/// maximise r with n . x + r <= c on every face.
///
/// Where it is not unique (a rectangle) one of them is returned; the radius is unique.
template <class Shape>
[[nodiscard]] Ball<Shape::dim> inscribed_ball(const Shape& shape) {
  constexpr int dim = Shape::dim;
  const Vec<dim> origin =
      shape.vertex(0);  // relative coordinates: far from the origin costs nothing
  std::vector<LinearConstraint<dim + 1>> faces;
  faces.reserve(shape.size());
  for (std::size_t k = 0; k < shape.size(); ++k) {
    faces.push_back(
        {stacked(shape.half_space(k).normal, Fixed<1, 1>(1.0)), -shape.distance(k, origin)});
  }
  const auto best = maximise<dim + 1>(axis_vector<dim + 1>(dim), faces, 2 * shape.diameter());
  VOUSSOIR_ASSERT(best.has_value(), "a convex shape holds a ball");
  return {origin + part<dim>(*best, 0), (*best)[dim]};
}

}  // namespace voussoir
