// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/rockmass/detail/segment_grid.hpp>

namespace voussoir::detail {

/// Whether a circle fits between some sides, its centre in one of the cells: to a twentieth of its
/// radius, beyond which it does not.
///
/// Squares are quartered, the one that may hold the most first. Nothing within a square whose half
/// diagonal is h lies farther from the sides than its middle does, plus h; nor, where the middle is
/// outside, than h. Of sides and cells each square keeps those that it may meet.
/// @param cells  convex, together the block
/// @param sides  all that bound the block
[[nodiscard]] VOUSSOIR_INLINE bool holds_circle(const std::vector<const ConvexPolygon*>& cells,
                                                const std::vector<Segment>& sides, double radius);

#if VOUSSOIR_BODIES

/// Halves squares in which the middle of a circle may lie: see `holds_circle`.
class CircleSearch {
 public:
  CircleSearch(const std::vector<const ConvexPolygon*>& cells, const std::vector<Segment>& sides,
               double radius)
      : radius_(radius) {
    for (const ConvexPolygon* cell : cells) {
      Box box{cell, cell->vertex(0), cell->vertex(0)};
      for (const Vec2& v : cell->vertices()) {
        box.low = smaller_of(box.low, v);
        box.high = larger_of(box.high, v);
      }
      boxes_.push_back(box);
    }
    Square all;
    Vec2 low = boxes_.front().low, high = boxes_.front().high;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      low = smaller_of(low, boxes_[k].low);
      high = larger_of(high, boxes_[k].high);
      all.cells.push_back(k);
    }
    all.sides = sides;
    all.middle = 0.5 * (low + high);
    all.half = 0.5 * largest_entry(Vec2(high - low));
    look(std::move(all));
  }

  [[nodiscard]] bool run() {
    while (!found_ && !open_.empty()) {
      std::pop_heap(open_.begin(), open_.end(), is_lower);
      const Square square = std::move(open_.back());
      open_.pop_back();
      const double half = 0.5 * square.half;
      for (int k = 0; k < 4 && !found_; ++k) {
        Square quarter;
        quarter.middle = square.middle + Vec2(k & 1 ? half : -half, k & 2 ? half : -half);
        quarter.half = half;
        for (const std::size_t c : square.cells)
          if (meets(boxes_[c], quarter)) quarter.cells.push_back(c);
        if (quarter.cells.empty()) continue;
        quarter.sides = square.sides;
        look(std::move(quarter));
      }
    }
    return found_;
  }

 private:
  struct Box {
    const ConvexPolygon* cell;
    Vec2 low, high;
  };
  struct Square {
    double bound = 0;
    Vec2 middle = zeros<Vec2>();
    double half = 0;
    std::vector<std::size_t> cells;
    std::vector<Segment> sides;
  };
  static bool is_lower(const Square& a, const Square& b) {
    return std::tuple(a.bound, -a.middle.x(), -a.middle.y()) <
           std::tuple(b.bound, -b.middle.x(), -b.middle.y());
  }
  [[nodiscard]] static bool meets(const Box& box, const Square& square) {
    const Vec2 half(square.half, square.half), low = square.middle - half,
                                               high = square.middle + half;
    return box.low.x() <= high.x() && box.high.x() >= low.x() && box.low.y() <= high.y() &&
           box.high.y() >= low.y();
  }

  void look(Square square) {
    double distance = std::numeric_limits<double>::infinity();
    distances_.clear();
    for (const Segment& side : square.sides) {
      distances_.push_back(length_of(square.middle - nearest_on(side, square.middle)));
      distance = std::min(distance, distances_.back());
    }
    const bool is_inside = std::any_of(
        square.cells.begin(), square.cells.end(),
        [&](std::size_t c) { return boxes_[c].cell->contains(square.middle, 1e-9 * radius_); });
    found_ = found_ || (is_inside && distance >= radius_);
    const double reach = square.half * std::numbers::sqrt2;
    square.bound = is_inside ? distance + reach : reach;
    if (found_ || square.bound < radius_ || square.half <= 0.05 * radius_) return;
    // The side nearest to a point of the square is no farther from its middle than this.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < square.sides.size(); ++k)
      if (distances_[k] <= distance + 2 * reach) square.sides[kept++] = square.sides[k];
    square.sides.resize(kept);
    open_.push_back(std::move(square));
    std::push_heap(open_.begin(), open_.end(), is_lower);
  }

  double radius_;
  std::vector<Box> boxes_;
  std::vector<Square> open_;
  std::vector<double> distances_;
  bool found_ = false;
};

VOUSSOIR_INLINE bool holds_circle(const std::vector<const ConvexPolygon*>& cells,
                                  const std::vector<Segment>& sides, double radius) {
  return CircleSearch(cells, sides, radius).run();
}

#endif

}  // namespace voussoir::detail
