// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/minimum_degree.hpp>

namespace voussoir {

/// Where the blocks of a sparse factor will be: order of elimination, elimination tree and the
/// columns of L, for a matrix whose pattern is symmetric.
///
/// The order is approximate minimum degree on bodies, not on single unknowns: a graph with Dof^2
/// fewer edges and the same answer.
///
/// Source: Davis (2006), Direct Methods for Sparse Linear Systems, chapter 4.
class BlockElimination {
 public:
  /// A place below the diagonal of the permuted matrix: its column, and which of the given pairs
  /// stands there; `flipped` if that pair's own row has become the column.
  struct Place {
    int column, pair;
    bool flipped;
  };

  /// @param size   block rows
  /// @param pairs  every coupled pair (row, column) once, row != column
  /// @param progress  asked now and then whether to go on
  /// @throws Stopped
  BlockElimination(int size, const std::vector<std::pair<int, int>>& pairs,
                   const Progress& progress = {})
      : from_new_(minimum_degree_order(size, pairs, progress)) {
    StopCheck stop(progress);
    VOUSSOIR_ASSERT(detail::is_permutation(from_new_), "every body is eliminated once");
    gather_rows(pairs);
    find_columns(stop);
  }

  [[nodiscard]] std::size_t size() const { return from_new_.size(); }
  [[nodiscard]] int original(std::size_t k) const { return from_new_[k]; }
  /// Blocks of L below the diagonal; those of column j are begin(j), ..., begin(j + 1) - 1.
  [[nodiscard]] std::size_t block_count() const { return begin_.back(); }
  [[nodiscard]] std::size_t begin(std::size_t column) const { return begin_[column]; }

  /// Calls place(p) for every block of the matrix in row i, then visit(j) for the columns of row i
  /// of L, each after those it depends on.
  class RowWalk {
   public:
    explicit RowWalk(const BlockElimination& pattern)
        : pattern_(&pattern), mark_(pattern.size(), -1), stack_(pattern.size()) {}

    template <class AtPlace, class Visit>
    void operator()(std::size_t row, AtPlace&& at_place, Visit&& visit) {
      const int i = static_cast<int>(row);
      std::size_t top = stack_.size();
      mark_[row] = i;
      for (std::size_t p = pattern_->row_begin_[row]; p < pattern_->row_begin_[row + 1]; ++p) {
        const Place& place = pattern_->places_[p];
        at_place(place);
        path_.clear();
        for (int j = place.column; j >= 0 && mark_[static_cast<std::size_t>(j)] != i;
             j = pattern_->parent_[static_cast<std::size_t>(j)]) {
          path_.push_back(j);
          mark_[static_cast<std::size_t>(j)] = i;
        }
        VOUSSOIR_ASSERT(path_.size() <= top, "a row has a column once");
        for (std::size_t k = path_.size(); k-- > 0;) stack_[--top] = path_[k];
      }
      for (std::size_t k = top; k < stack_.size(); ++k) visit(static_cast<std::size_t>(stack_[k]));
    }

   private:
    const BlockElimination* pattern_;
    std::vector<int> mark_, stack_, path_;
  };

 private:
  void gather_rows(const std::vector<std::pair<int, int>>& pairs) {
    const std::size_t n = size();
    std::vector<int> to_new(n);
    for (std::size_t k = 0; k < n; ++k)
      to_new[static_cast<std::size_t>(from_new_[k])] = static_cast<int>(k);
    row_begin_.assign(n + 1, 0);
    for (const auto& [i, j] : pairs)
      ++row_begin_[static_cast<std::size_t>(std::max(to_new[static_cast<std::size_t>(i)],
                                                     to_new[static_cast<std::size_t>(j)])) +
                   1];
    for (std::size_t k = 0; k < n; ++k) row_begin_[k + 1] += row_begin_[k];
    places_.resize(row_begin_[n]);
    std::vector<std::size_t> next(row_begin_.begin(), row_begin_.end() - 1);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const int i = to_new[static_cast<std::size_t>(pairs[p].first)],
                j = to_new[static_cast<std::size_t>(pairs[p].second)];
      VOUSSOIR_ASSERT(i != j, "a body is not coupled to itself");
      places_[next[static_cast<std::size_t>(std::max(i, j))]++] = {std::min(i, j),
                                                                   static_cast<int>(p), i < j};
    }
  }

  void find_columns(StopCheck& stop) {
    const std::size_t n = size();
    parent_.assign(n, -1);
    std::vector<int> ancestor(n, -1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t p = row_begin_[i]; p < row_begin_[i + 1]; ++p)
        for (int j = places_[p].column; j >= 0 && j < static_cast<int>(i);) {
          const auto at = static_cast<std::size_t>(j);
          const int up = ancestor[at];
          ancestor[at] = static_cast<int>(i);
          if (up < 0) parent_[at] = static_cast<int>(i);
          j = up;
        }
    begin_.assign(n + 1, 0);
    RowWalk walk(*this);
    for (std::size_t i = 0; i < n; ++i) {
      stop();
      walk(
          i, [](const Place&) {}, [this](std::size_t j) { ++begin_[j + 1]; });
    }
    for (std::size_t k = 0; k < n; ++k) begin_[k + 1] += begin_[k];
  }

  std::vector<int> from_new_;
  std::vector<std::size_t> row_begin_;
  std::vector<Place> places_;
  std::vector<int> parent_;
  std::vector<std::size_t> begin_;
};

}  // namespace voussoir
