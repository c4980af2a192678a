// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <voussoir/core/bodies.hpp>
#include <voussoir/linear/detail/front_crew.hpp>
#include <voussoir/linear/detail/tile_kernels.hpp>

namespace voussoir::detail {

/// The dense lower triangle in which one group of columns is eliminated: those columns, and what
/// their elimination takes from the rows below them.
struct DenseFront {
  std::size_t first_column;  ///< of the whole factor
  int index;                 ///< in the order of elimination
  double* panel;             ///< height x width, by columns
  double* update;            ///< (height - width)^2, by columns; written, need not be zero before
  std::size_t height, width;
  const double* least;  ///< `width` numbers: a squared pivot that is not above them is no pivot
};

/// How many columns are eliminated before the rest of the front is brought up to date: the strips
/// of that many columns stay in the second level of cache.
inline constexpr std::size_t columns_at_once = 64;

/// Numbers of the workspace for a front.
[[nodiscard]] inline std::size_t packed_size(std::size_t height, std::size_t width) {
  return (height + tile - 1) / tile * tile *
         std::min((width + tile - 1) / tile * tile, columns_at_once);
}

/// Replaces the panel by the columns of L, with the reciprocals of its diagonal on the diagonal,
/// and sets the lower triangle of update = -L L^T of the rows below. Above the diagonal both hold
/// anything.
///
/// Blocked, right-looking by `columns_at_once`, within them left-looking by strips of 8 rows.
/// Reports a pivot to the state of the member.
/// @param packed  packed_size(height, width) numbers, the same for all members
VOUSSOIR_INLINE void eliminate(const DenseFront& front, double* packed, const TileKernels& kernels,
                               const FrontMember& member);

#if VOUSSOIR_BODIES

/// One step of `eliminate`: columns [first, last) of the front.
class FrontStep {
 public:
  FrontStep(const DenseFront& front, std::size_t first, double* packed, const TileKernels& kernels)
      : front_(front),
        kernels_(kernels),
        packed_(packed),
        first_(first),
        last_(std::min(first + columns_at_once, front.width)),
        depth_((last_ - first + tile - 1) / tile * tile) {}

  /// The strip that holds the rows after the last pivot, whole.
  [[nodiscard]] std::size_t strips_with_pivots() const { return (last_ + tile - 1) / tile; }
  [[nodiscard]] std::size_t strips() const { return (front_.height + tile - 1) / tile; }
  /// The first strip with a row after the last pivot.
  [[nodiscard]] std::size_t first_strip_after() const { return last_ / tile; }

  /// The column whose pivot is not positive.
  [[nodiscard]] std::size_t failed() const { return failed_; }

  /// For who has not eliminated the pivots: their reciprocals.
  void read_pivots() {
    for (std::size_t c = first_; c < last_; ++c)
      reciprocal_[c - first_] = front_.panel[c * front_.height + c];
  }

  /// Rows 8 strip, ... of the columns of L. @return  false: a pivot is not positive
  [[nodiscard]] bool eliminate_strip(std::size_t strip) {
    const std::size_t row = tile * strip, rows = std::min(tile, front_.height - row);
    double* const mine = at(strip);
    for (std::size_t c = first_; c < last_ && c <= row; c += tile) {
      const std::size_t columns = std::min(tile, last_ - c), before = c - first_;
      double* const x = mine + tile * before;
      for (std::size_t k = 0; k < tile * tile; ++k) x[k] = 0;
      for (std::size_t k = 0; k < columns; ++k)
        std::memcpy(x + tile * k, front_.panel + (c + k) * front_.height + row,
                    rows * sizeof(double));
      const double* const pivots = at(c / tile);
      if (before > 0) kernels_.subtract(x, tile, mine, pivots, before);
      if (c < row) {
        kernels_.solve(x, pivots + tile * before, reciprocal_ + before, columns);
      } else if (!find_pivots(x, c, columns)) {
        return false;
      }
      for (std::size_t k = 0; k < columns; ++k) {
        double* const to = front_.panel + (c + k) * front_.height + row;
        std::memcpy(to, x + tile * k, rows * sizeof(double));
        if (c == row) to[k] = reciprocal_[before + k];
      }
    }
    return true;
  }

  /// Takes what these columns contribute from 8 columns after them.
  void update_columns(std::size_t strip) {
    const std::size_t begin = std::max(tile * strip, last_),
                      end = std::min(tile * (strip + 1), front_.height);
    const bool is_whole = begin == tile * strip && end == begin + tile;
    for (std::size_t below = strip; below < strips(); ++below) {
      const std::size_t row = tile * below, row_end = std::min(row + tile, front_.height);
      if (is_whole && below > strip && row_end == row + tile &&
          (end <= front_.width || begin >= front_.width)) {
        double* const to = entry(row, begin);
        const std::size_t stride = begin < front_.width ? front_.height : rest();
        if (is_first_of(begin))
          for (std::size_t c = 0; c < tile; ++c)
            for (std::size_t r = 0; r < tile; ++r) to[c * stride + r] = 0;
        kernels_.subtract(to, stride, at(below), at(strip), depth());
        continue;
      }
      double sum[tile * tile] = {};
      kernels_.subtract(sum, tile, at(below), at(strip), depth());
      for (std::size_t c = begin; c < end; ++c)
        for (std::size_t r = std::max(row, c); r < row_end; ++r) {
          double& to = *entry(r, c);
          const double change = sum[tile * (c - tile * strip) + r - row];
          to = is_first_of(c) ? change : to + change;
        }
    }
  }

 private:
  [[nodiscard]] std::size_t rest() const { return front_.height - front_.width; }
  /// Columns that are packed; less than the whole tiles that there is room for.
  [[nodiscard]] std::size_t depth() const { return last_ - first_; }
  [[nodiscard]] double* at(std::size_t strip) const { return packed_ + strip * tile * depth_; }
  [[nodiscard]] bool is_first_of(std::size_t column) const {
    return first_ == 0 && column >= front_.width;
  }
  [[nodiscard]] double* entry(std::size_t row, std::size_t column) const {
    return column < front_.width
               ? front_.panel + column * front_.height + row
               : front_.update + (column - front_.width) * rest() + row - front_.width;
  }

  bool find_pivots(double* x, std::size_t column, std::size_t columns) {
    for (std::size_t c = 0; c < columns; ++c) {
      double* const pivot = x + tile * c;
      if (!(pivot[c] > front_.least[column + c])) {  // so that NaN is refused too
        failed_ = column + c;
        return false;
      }
      const double reciprocal = 1 / std::sqrt(pivot[c]);
      reciprocal_[column - first_ + c] = reciprocal;
      for (std::size_t r = 0; r < tile; ++r) pivot[r] *= reciprocal;
      for (std::size_t k = c + 1; k < columns; ++k) {
        const double factor = pivot[k];
        for (std::size_t r = 0; r < tile; ++r) x[tile * k + r] -= pivot[r] * factor;
      }
    }
    return true;
  }

  const DenseFront& front_;
  const TileKernels& kernels_;
  double* packed_;
  std::size_t first_, last_, depth_, failed_ = 0;
  double reciprocal_[columns_at_once];
};

VOUSSOIR_INLINE void eliminate(const DenseFront& front, double* packed, const TileKernels& kernels,
                               const FrontMember& member) {
  FactorState& state = member.state;
  for (std::size_t first = 0; first < front.width; first += columns_at_once) {
    FrontStep step(front, first, packed, kernels);
    if (member.leads())
      for (std::size_t strip = first / tile; strip < step.strips_with_pivots(); ++strip)
        if (!state.is_over(front.index) && !step.eliminate_strip(strip))
          state.fail(front.index, front.first_column + step.failed());
    member.meet();
    member.ask();
    if (!state.is_over(front.index)) {
      step.read_pivots();
      for (std::size_t strip = step.strips_with_pivots(); strip < step.strips(); ++strip)
        if (member.takes(strip)) (void)step.eliminate_strip(strip);
    }
    member.meet();
    for (std::size_t strip = step.first_strip_after(); strip < step.strips(); ++strip) {
      if (!member.takes(strip) || state.is_over(front.index)) continue;
      member.ask();
      step.update_columns(strip);
    }
    member.meet();
  }
}

#endif

}  // namespace voussoir::detail
