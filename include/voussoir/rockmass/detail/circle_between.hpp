// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/rockmass/detail/segment_grid.hpp>

namespace voussoir::detail {

/// Whether a circle fits between some sides, its centre in one of the cells: to a twentieth of its
/// radius, beyond which it does not.
///
/// Squares are halved, the one that may hold the most first. Nothing within a square whose half
/// diagonal is h lies farther from the sides than its middle does, plus h; nor, where the middle is
/// outside, than h.
/// @param cells  convex, together the block
/// @param sides  all that bound the block
template <class Cells>
[[nodiscard]] bool holds_circle(const Cells& cells, const std::vector<Segment>& sides,
                                double radius) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec2 low(inf, inf), high(-inf, -inf);
  for (const ConvexPolygon* cell : cells)
    for (const Vec2& v : cell->vertices()) {
      low = smaller_of(low, v);
      high = larger_of(high, v);
    }
  struct Square {
    double bound;
    Vec2 middle;
    double half;
    bool operator<(const Square& other) const {
      return std::tuple(bound, -middle.x(), -middle.y()) <
             std::tuple(other.bound, -other.middle.x(), -other.middle.y());
    }
  };
  std::priority_queue<Square> open;
  bool found = false;
  const auto look = [&](const Vec2& middle, double half) {
    double distance = inf;
    for (const Segment& side : sides)
      distance = std::min(distance, squared_length_of(middle - nearest_on(side, middle)));
    distance = std::sqrt(distance);
    const bool is_inside = std::any_of(cells.begin(), cells.end(), [&](const ConvexPolygon* cell) {
      return cell->contains(middle, 1e-9 * radius);
    });
    found = found || (is_inside && distance >= radius);
    const double reach = half * std::numbers::sqrt2, bound = is_inside ? distance + reach : reach;
    if (bound >= radius && half > 0.05 * radius) open.push({bound, middle, half});
  };
  const Vec2 size = high - low;
  look(0.5 * (low + high), 0.5 * std::max(size.x(), size.y()));
  while (!found && !open.empty()) {
    const Square square = open.top();
    open.pop();
    const double half = 0.5 * square.half;
    for (int k = 0; k < 4; ++k)
      look(square.middle + Vec2(k & 1 ? half : -half, k & 2 ? half : -half), half);
  }
  return found;
}

}  // namespace voussoir::detail
