// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/vec.hpp>

namespace voussoir {

/// The points x with normal . x <= offset; in 2-D the part below (left of) a line.
template <int Dim>
struct HalfSpace {
  Vec<Dim> normal = zeros<Vec<Dim>>();  ///< unit vector out of the half space
  double offset = 0;                    ///< [m]

  /// Signed distance to the boundary, negative inside [m].
  [[nodiscard]] double distance(const Vec<Dim>& point) const {
    return dot_product(normal, point) - offset;
  }

  /// The half space through `point` with the outward unit vector `normal`.
  [[nodiscard]] static HalfSpace through(const Vec<Dim>& point, const Vec<Dim>& normal) {
    return {normal, dot_product(normal, point)};
  }
};

/// The label of a face that no cut made: of shapes that do not come from slicing.
inline constexpr int no_cut = -1;

/// The half space left of the directed line from `a` to `b`.
[[nodiscard]] inline HalfSpace<2> left_of(const Vec2& a, const Vec2& b) {
  return HalfSpace<2>::through(a, -normalized(perpendicular(b - a)));
}

}  // namespace voussoir
