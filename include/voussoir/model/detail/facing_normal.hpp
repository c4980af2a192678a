// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// The normal of the face that looks most nearly in a direction.
///
/// Between faces that are hardly tilted two edges may decide the depth. Their normal is off that of
/// the face by about the tilt, and heights over the face along it are off by as much times a metre.
template <int Dim>
[[nodiscard]] Vec<Dim> facing_normal(const PlacedShape<Dim>& shape, const Vec<Dim>& direction) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < shape.face_count; ++k)
    if (direction.dot(shape.normal(k)) > direction.dot(shape.normal(best))) best = k;
  return shape.normal(best);
}

}  // namespace voussoir::detail
