// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/detail/by_index.hpp>
#if VOUSSOIR_BODIES
#include <voussoir/linear/detail/front_tree.hpp>
#include <voussoir/linear/nested_dissection.hpp>
#endif

namespace voussoir {

/// What can be known of a Cholesky factor before any number: the order of elimination, where the
/// factor has blocks, and what it will cost. Serves every matrix with the same coupled pairs.
///
/// The columns of the factor are taken together in fronts, dense triangles that form a tree: the
/// front of some columns gathers what the fronts of its children have left to the rows below them.
///
/// Source: Duff and Reid (1983), The multifrontal solution of indefinite sparse symmetric linear
/// equations, ACM Trans. Math. Softw. 9(3), 302-325.
class CholeskyPattern {
 public:
  /// Columns [first, last) and, below them, rows(begin), ..., rows(end - 1), ascending.
  struct Front {
    int first, last;
    int parent;              ///< -1: none
    int child, sibling;      ///< its first child, and the next child of its parent; -1: none
    int youngest;            ///< the first front of its subtree, which ends with itself
    std::size_t begin, end;  ///< of its rows below the columns
    std::size_t places, places_end;  ///< of the blocks of the matrix in it
    std::size_t blocks;              ///< begin of its panel, in blocks
    [[nodiscard]] int columns() const { return last - first; }
    [[nodiscard]] int rows() const { return columns() + static_cast<int>(end - begin); }
  };
  /// Where a block of the matrix goes: row and column of the front, in blocks.
  struct Place {
    int row, column;
    int pair;  ///< of those given; ~pair if its row has become the column
  };

  /// @param dof    unknowns of a body
  /// @param size   bodies
  /// @param pairs  every coupled pair (row, column) once, row != column
  /// @param progress  asked now and then whether to go on
  /// @throws Stopped
  CholeskyPattern(int dof, int size, const std::vector<std::pair<int, int>>& pairs,
                  const Progress& progress = {});
  /// The same with a given order of elimination, each body once.
  CholeskyPattern(int dof, std::vector<int> order, const std::vector<std::pair<int, int>>& pairs,
                  const Progress& progress = {});

  [[nodiscard]] int dof() const { return dof_; }
  [[nodiscard]] int size() const { return static_cast<int>(order_.size()); }
  /// The body that is eliminated k-th.
  [[nodiscard]] int original(int k) const { return order_[static_cast<std::size_t>(k)]; }
  /// Whether these are the pairs that it was made from, in their order.
  [[nodiscard]] bool is_for(int size, const std::vector<std::pair<int, int>>& pairs) const;

  /// Additions and multiplications of a factorisation that stores no zeros.
  [[nodiscard]] double operations() const { return operations_; }
  /// Blocks of the factor that are not zero, the diagonal included.
  [[nodiscard]] double block_count() const { return block_count_; }
  /// Numbers that the factor keeps, 8 bytes each: with zeros where fronts are merged and above the
  /// diagonal.
  [[nodiscard]] double stored_numbers() const { return stored_blocks_ * dof_ * dof_; }
  /// Numbers in use while it is made by one thread, at the worst time. By several:
  /// `FrontSchedule::most_numbers`.
  [[nodiscard]] double most_numbers() const {
    return stored_numbers() + most_waiting_ * dof_ * dof_;
  }

  [[nodiscard]] const std::vector<Front>& fronts() const { return fronts_; }
  [[nodiscard]] int row(std::size_t k) const { return rows_[k]; }
  /// The row of the parent's front that is row k of this one.
  [[nodiscard]] const int* in_parent() const { return in_parent_.data(); }
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }
  [[nodiscard]] std::size_t row_count() const { return rows_.size(); }
  /// Of the front with the most, in bodies.
  [[nodiscard]] std::size_t most_rows() const { return most_rows_; }
  /// Additions and multiplications for a front and all below it, with those for zeros.
  [[nodiscard]] double subtree_cost(int front) const {
    return cost_[static_cast<std::size_t>(front)];
  }

 private:
  void find_rows(const detail::BodyGraph& graph, StopCheck& stop);
  static std::uint64_t digest(int size, const std::vector<std::pair<int, int>>& pairs);

  int dof_;
  std::vector<int> order_;
  double operations_ = 0, block_count_ = 0, stored_blocks_ = 0, most_waiting_ = 0;
  std::vector<Front> fronts_;
  std::vector<int> rows_, in_parent_;
  std::vector<Place> places_;
  std::vector<double> cost_;
  std::size_t most_rows_ = 0;
  std::uint64_t digest_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE CholeskyPattern::CholeskyPattern(int dof, int size,
                                                 const std::vector<std::pair<int, int>>& pairs,
                                                 const Progress& progress)
    : CholeskyPattern(dof, nested_dissection_order(dof, size, pairs, progress), pairs, progress) {}

VOUSSOIR_INLINE CholeskyPattern::CholeskyPattern(int dof, std::vector<int> order,
                                                 const std::vector<std::pair<int, int>>& pairs,
                                                 const Progress& progress)
    : dof_(dof), digest_(digest(static_cast<int>(order.size()), pairs)) {
  StopCheck stop(progress, 1);
  const detail::BodyGraph graph(static_cast<int>(order.size()), pairs);
  stop();
  const detail::EliminationTree tree(graph, std::move(order));
  stop();
  for (const int count : tree.count.all()) {
    block_count_ += count;
    // Each body is dof columns, each with one row less than the one before.
    const double rows = dof * count;
    for (int k = 0; k < dof; ++k) operations_ += (rows - k) * (rows - k);
  }
  const detail::FrontTree groups(tree, dof);
  stop();
  order_ = groups.order;
  most_waiting_ = groups.most_waiting;
  fronts_.resize(static_cast<std::size_t>(groups.size()));
  cost_.resize(fronts_.size());
  std::size_t rows = 0, blocks = 0;
  for (int f = 0; f < groups.size(); ++f) {
    Front& front = fronts_[static_cast<std::size_t>(f)];
    const auto below = static_cast<std::size_t>(groups.below[f]);
    front = {
        groups.first[f], groups.first[f + 1], groups.parent[f], -1, -1, f, rows, rows + below, 0, 0,
        blocks};
    VOUSSOIR_ASSERT(front.first < front.last && front.last <= size(), "a front has columns");
    VOUSSOIR_ASSERT(front.parent < 0 || front.parent > f, "a front comes before its parent");
    rows += below;
    most_rows_ = std::max(most_rows_, static_cast<std::size_t>(front.rows()));
    blocks += static_cast<std::size_t>(front.columns()) * static_cast<std::size_t>(front.rows());
    cost_[static_cast<std::size_t>(f)] = detail::front_cost(front.columns(), groups.below[f], dof);
  }
  for (std::size_t f = fronts_.size(); f-- > 0;)
    if (fronts_[f].parent >= 0)
      fronts_[f].sibling = std::exchange(fronts_[static_cast<std::size_t>(fronts_[f].parent)].child,
                                         static_cast<int>(f));
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    if (fronts_[f].parent < 0) continue;
    const auto p = static_cast<std::size_t>(fronts_[f].parent);
    cost_[p] += cost_[f];
    fronts_[p].youngest = std::min(fronts_[p].youngest, fronts_[f].youngest);
  }
  stored_blocks_ = static_cast<double>(blocks);
  rows_.resize(rows);
  find_rows(graph, stop);
}

VOUSSOIR_INLINE void CholeskyPattern::find_rows(const detail::BodyGraph& graph, StopCheck& stop) {
  // The rows of each front are those of its children and of the matrix that are not its columns.
  // Sorted all at once, by row: rows are taken in turn, and each is added to the fronts that have
  // it, which form a subtree below the front that eliminates it.
  const detail::ByIndex<int> place = detail::places_in(order_);
  detail::ByIndex<int> front_of(size()), mark(static_cast<int>(fronts_.size()), -1);
  for (std::size_t f = 0; f < fronts_.size(); ++f)
    for (int k = fronts_[f].first; k < fronts_[f].last; ++k) front_of[k] = static_cast<int>(f);
  std::vector<std::size_t> end(fronts_.size());
  for (std::size_t f = 0; f < fronts_.size(); ++f) end[f] = fronts_[f].begin;
  in_parent_.resize(rows_.size());
  // Where the row stands in a front is known as it is added; in its parent soon after.
  places_.resize(graph.next.all().size() / 2);
  for (int i = 0; i < size(); ++i) {
    const int body = order_[static_cast<std::size_t>(i)];
    mark[front_of[i]] = i;
    for (int k = graph.begin[body]; k < graph.begin[body + 1]; ++k) {
      const int j = place[graph.next[k]];
      if (j > i) continue;
      ++fronts_[static_cast<std::size_t>(front_of[j])].places;
      for (int f = front_of[j]; mark[f] != i; f = fronts_[static_cast<std::size_t>(f)].parent) {
        mark[f] = i;
        rows_[end[static_cast<std::size_t>(f)]++] = i;
      }
    }
  }
  stop();
  std::size_t sum = 0;
  for (Front& front : fronts_) {
    front.places_end = sum + front.places;
    front.places = std::exchange(sum, front.places_end);
  }
  VOUSSOIR_ASSERT(sum == places_.size(), "every block of the matrix has its place in a front");
  std::vector<std::size_t> next(fronts_.size());
  for (std::size_t f = 0; f < fronts_.size(); ++f) next[f] = fronts_[f].places;
  detail::ByIndex<int> at(size());
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    const Front& front = fronts_[f];
    VOUSSOIR_ASSERT(end[f] == front.end, "a front has as many rows as its columns count");
    for (std::size_t k = front.begin; k < front.end; ++k)
      at[rows_[k]] = front.columns() + static_cast<int>(k - front.begin);
    for (int j = front.first; j < front.last; ++j) at[j] = j - front.first;
    for (int j = front.first; j < front.last; ++j) {
      const int body = order_[static_cast<std::size_t>(j)];
      for (int k = graph.begin[body]; k < graph.begin[body + 1]; ++k) {
        const int i = place[graph.next[k]];
        // The pair is stored as (row, column): ~pair where this body is its column, as is wanted.
        if (i > j) places_[next[f]++] = {at[i], j - front.first, ~graph.pair[k]};
      }
    }
  }
  stop();
  for (std::size_t f = fronts_.size(); f-- > 0;) {
    if (fronts_[f].parent < 0) continue;
    // Both ascend, and the parent has all.
    const Front& parent = fronts_[static_cast<std::size_t>(fronts_[f].parent)];
    std::size_t q = parent.begin;
    for (std::size_t k = fronts_[f].begin; k < fronts_[f].end; ++k) {
      if (rows_[k] < parent.last) {
        in_parent_[k] = rows_[k] - parent.first;
        continue;
      }
      while (rows_[q] < rows_[k]) ++q;
      VOUSSOIR_ASSERT(q < parent.end && rows_[q] == rows_[k], "a parent has the rows of its child");
      in_parent_[k] = parent.columns() + static_cast<int>(q - parent.begin);
    }
  }
}

VOUSSOIR_INLINE std::uint64_t CholeskyPattern::digest(
    int size, const std::vector<std::pair<int, int>>& pairs) {
  std::uint64_t sum = static_cast<std::uint64_t>(size) + 0x9e3779b97f4a7c15U;
  for (const auto& [i, j] : pairs) {
    const std::uint64_t both = static_cast<std::uint64_t>(i) << 32U | static_cast<std::uint32_t>(j);
    sum = (sum ^ both) * 0xff51afd7ed558ccdU;
    sum ^= sum >> 32U;
  }
  return sum;
}

VOUSSOIR_INLINE bool CholeskyPattern::is_for(int size,
                                             const std::vector<std::pair<int, int>>& pairs) const {
  return size == this->size() && digest(size, pairs) == digest_;
}

#endif

}  // namespace voussoir
