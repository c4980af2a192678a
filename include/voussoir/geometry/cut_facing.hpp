// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// The label of the face of a polygon or polyhedron that looks most in a direction.
template <class Shape, int Dim>
[[nodiscard]] int cut_facing(const Shape& shape, const Vec<Dim>& direction) {
  double most = -std::numeric_limits<double>::infinity();
  int cut = -1;
  for (std::size_t k = 0; k < shape.size(); ++k)
    if (const double along = shape.half_space(k).normal.dot(direction); along > most) {
      most = along;
      cut = shape.cut(k);
    }
  return cut;
}

}  // namespace voussoir
