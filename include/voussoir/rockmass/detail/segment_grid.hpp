// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/segment.hpp>

namespace voussoir::detail {

/// Where two segments cross: how far along each, 0 at its start and 1 at its end.
struct Crossing {
  double first, second;
};

/// Nothing for segments that are parallel, or do not meet. Ends count.
[[nodiscard]] inline std::optional<Crossing> crossing_of(const Segment& a, const Segment& b) {
  const Vec2 along = a.end - a.start, other = b.end - b.start, between = b.start - a.start;
  const double turn = cross(along, other);
  if (!(std::abs(turn) > 1e-12 * length_of(along) * length_of(other))) return std::nullopt;
  const Crossing found{cross(between, other) / turn, cross(between, along) / turn};
  if (!(found.first >= 0 && found.first <= 1 && found.second >= 0 && found.second <= 1))
    return std::nullopt;
  return found;
}

/// The point of a segment that is nearest to another point.
[[nodiscard]] inline Vec2 nearest_on(const Segment& segment, const Vec2& point) {
  const Vec2 along = segment.end - segment.start;
  const double squared = squared_length_of(along);
  if (!(squared > 0)) return segment.start;
  return segment.at(std::clamp(dot_product(point - segment.start, along) / squared, 0.0, 1.0));
}

/// Segments by place: which of them come near a box, without looking at all of them.
class SegmentGrid {
 public:
  /// @param low, high  what lies outside is kept in the cells at the edge [m]
  /// @param expected   number of segments
  SegmentGrid(const Vec2& low, const Vec2& high, std::size_t expected) : low_(low) {
    const Vec2 size = high - low;
    const double wanted =
        std::sqrt(size.x() * size.y() / static_cast<double>(std::max<std::size_t>(expected, 1)));
    cell_ = std::max({wanted, size.x() / largest, size.y() / largest});
    columns_ = count_of(size.x());
    rows_ = count_of(size.y());
    cells_.resize(columns_ * rows_);
  }

  /// Enters a segment; its number is that of the segments entered before.
  void add(const Segment& segment) {
    // Column by column, so that a long oblique one does not fill its whole box.
    const auto number = segments_.size();
    segments_.push_back(segment);
    Vec2 from = segment.start, to = segment.end;
    if (to.x() < from.x()) std::swap(from, to);
    const std::size_t first = column(from.x()), last = column(to.x());
    for (std::size_t c = first; c <= last; ++c) {
      const auto y_at = [&](double x) {
        const double run = to.x() - from.x();
        return run > 0 ? from.y() + std::clamp((x - from.x()) / run, 0.0, 1.0) * (to.y() - from.y())
                       : from.y();
      };
      double low = c == first ? from.y() : y_at(left_of(c)),
             high = c == last ? to.y() : y_at(left_of(c + 1));
      if (high < low) std::swap(low, high);
      // A rounding at the border of a cell must not hide it.
      const std::size_t bottom = row(low - 1e-6 * cell_), top = row(high + 1e-6 * cell_);
      for (std::size_t r = bottom; r <= top; ++r) cells_[r * columns_ + c].push_back(number);
    }
    seen_.push_back(0);
  }

  /// Calls `visit(number)` once for each segment that may come within the box.
  template <class Visit>
  void near(const Vec2& low, const Vec2& high, Visit&& visit) const {
    ++turn_;
    const std::size_t first = column(low.x() - 1e-6 * cell_),
                      last = column(high.x() + 1e-6 * cell_), bottom = row(low.y()),
                      top = row(high.y());
    for (std::size_t r = bottom; r <= top; ++r)
      for (std::size_t c = first; c <= last; ++c)
        for (const std::size_t number : cells_[r * columns_ + c])
          if (seen_[number] != turn_) {
            seen_[number] = turn_;
            visit(number);
          }
  }

  [[nodiscard]] const Segment& operator[](std::size_t number) const { return segments_[number]; }
  [[nodiscard]] std::size_t size() const { return segments_.size(); }
  [[nodiscard]] double cell() const { return cell_; }

 private:
  static constexpr double largest = 512;  ///< cells along a side

  [[nodiscard]] std::size_t count_of(double size) const {
    return static_cast<std::size_t>(std::clamp(std::ceil(size / cell_), 1.0, largest));
  }
  [[nodiscard]] static std::size_t index(double at, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  }
  [[nodiscard]] std::size_t column(double x) const {
    return index(std::floor((x - low_.x()) / cell_), columns_);
  }
  [[nodiscard]] std::size_t row(double y) const {
    return index(std::floor((y - low_.y()) / cell_), rows_);
  }
  [[nodiscard]] double left_of(std::size_t c) const {
    return low_.x() + cell_ * static_cast<double>(c);
  }

  Vec2 low_;
  double cell_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
  std::vector<Segment> segments_;
  mutable std::vector<unsigned> seen_;  ///< in which turn a segment was visited last
  mutable unsigned turn_ = 0;
};

}  // namespace voussoir::detail
