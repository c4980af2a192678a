// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/tangent_basis.hpp>

namespace voussoir {

namespace detail {

/// Whether a line along a face with this normal runs outside it when moved a hair to the first of
/// `sideways` and, if that is along the face too, to the next.
template <int Dim>
[[nodiscard]] bool leaves(const Vec<Dim>& normal, const TangentBasis<Dim>& sideways) {
  for (int k = 0; k < Dim - 1; ++k) {
    const double slope = dot_product(normal, column(sideways, k));
    if (k == Dim - 2 || std::abs(slope) > 1e-9) return slope > 0;
  }
  return false;
}

}  // namespace detail

/// The stretch of a straight line that runs inside a convex shape.
///
/// A line along a face, or along the edge of several, is taken to run a hair to the side: to its
/// left in 2-D; in 3-D to the first tangent of its direction (`tangent_basis`), and far less to the
/// second. As that depends on the line alone, every piece of a bolt along a joint, or along the
/// line in which joints meet, belongs to exactly one of the blocks around it.
///
/// @param tolerance  a line whose ends are both within it of a face runs along it; a stretch not
///                   longer than it is none [m]
/// @param from, to   distances from the start of the line to where it enters and leaves [m]
/// @return  whether there is such a stretch
/// @pre   the line has a length
/// @cost  O(faces)
template <class Line, class Shape>
[[nodiscard]] bool clip(const Line& line, const Shape& shape, double tolerance, double& from,
                        double& to) {
  constexpr int dim = Shape::dim;
  const double length = line.length();
  VOUSSOIR_ASSERT(length > 0 && tolerance >= 0, "a line that is clipped has a length");
  const Vec<dim> direction = (line.end - line.start) / length;
  const TangentBasis<dim> sideways = tangent_basis(direction);
  from = 0;
  to = length;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const double here = shape.distance(k, line.start), there = shape.distance(k, line.end);
    if (std::abs(here) <= tolerance && std::abs(there) <= tolerance) {
      if (detail::leaves<dim>(shape.half_space(k).normal, sideways)) return false;
      continue;
    }
    if (here >= -tolerance && there >= -tolerance) return false;
    if (here * there >= 0) continue;
    const double t = length * here / (here - there);
    if (here < 0) {
      to = std::min(to, t);
    } else {
      from = std::max(from, t);
    }
  }
  return to - from > tolerance;
}

}  // namespace voussoir
