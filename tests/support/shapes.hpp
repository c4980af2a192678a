// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>

/// Shapes to test with.
namespace voussoir_test {

using voussoir::ConvexPolygon;
using voussoir::Random;
using voussoir::Vec2;

/// A polygon whose face k has the label k.
[[nodiscard]] inline ConvexPolygon polygon(const std::vector<Vec2>& vertices) {
  std::vector<int> labels;
  for (std::size_t k = 0; k < vertices.size(); ++k) labels.push_back(static_cast<int>(k));
  return {vertices, labels};
}

/// Corners of a regular polygon, anticlockwise, the first at angle 0.
[[nodiscard]] inline std::vector<Vec2> regular(int corners, double radius,
                                               const Vec2& centre = {0, 0}) {
  std::vector<Vec2> vertices;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    vertices.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return vertices;
}

/// Convex hull, anticlockwise, without straight corners (Andrew's monotone chain).
[[nodiscard]] inline std::vector<Vec2> hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vec2> chain;
  for (int half = 0; half < 2; ++half) {
    const std::size_t base = chain.size();
    for (const Vec2& p : points) {
      while (chain.size() >= base + 2 &&
             voussoir::cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0)
        chain.pop_back();
      chain.push_back(p);
    }
    chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return chain;
}

/// Hull of `points` random points in a turned rectangle: 3 to about 10 corners.
[[nodiscard]] inline ConvexPolygon random_convex(Random& random, int points, double length,
                                                 double height, const Vec2& centre = {0, 0}) {
  const double angle = 2 * std::numbers::pi * random.uniform();
  const Vec2 along(std::cos(angle), std::sin(angle));
  std::vector<Vec2> cloud;
  for (int k = 0; k < points; ++k) {
    const double x = random.uniform() - 0.5, y = random.uniform() - 0.5;
    cloud.emplace_back(centre + length * x * along + height * y * voussoir::perpendicular(along));
  }
  return polygon(hull(cloud));
}

}  // namespace voussoir_test
