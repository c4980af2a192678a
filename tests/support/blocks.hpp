// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <utility>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>

#include "support/degree.hpp"

/// Rectangular blocks, upright or turned, for tests of moving blocks.
namespace voussoir_test {

/// Width x height with its middle at `centre`, turned anticlockwise.
[[nodiscard]] inline voussoir::ConvexPolygon rectangle(const voussoir::Vec2& centre, double width,
                                                       double height, double angle = 0) {
  using voussoir::Vec2;
  const auto turn = voussoir::rotation_by(voussoir::Spin<2>(angle));
  std::vector<Vec2> corners;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    corners.emplace_back(centre + turn * Vec2(0.5 * width * x, 0.5 * height * y));
  return voussoir::ConvexPolygon(std::move(corners), {0, 1, 2, 3});
}

/// A brick with sides along the columns of `turn`.
[[nodiscard]] inline voussoir::ConvexPolyhedron brick(
    const voussoir::Vec3& centre, const voussoir::Vec3& size,
    const voussoir::Rotation<3>& turn = voussoir::Rotation<3>::Identity()) {
  using voussoir::Vec3;
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back(
        centre +
        turn * (0.5 * size.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1))));
  return voussoir::ConvexPolyhedron(
      std::move(corners),
      {{0, 4, 6, 2}, {0, 2, 3, 1}, {1, 3, 7, 5}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}},
      {0, 1, 2, 3, 4, 5});
}

}  // namespace voussoir_test
