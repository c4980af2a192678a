// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/detail/by_index.hpp>

namespace voussoir::detail {

/// The graph that remains after some rows have been eliminated, in no more memory than at first.
///
/// A node is a number. It is a variable until it is eliminated; then it is an element, which stands
/// for all couplings among its variables (the column of L below it). Two variables are neighbours
/// if an element has both, or if the list of one has the other. Variables that have become
/// indistinguishable are merged: one stands for all, with their number as its weight.
class QuotientGraph {
 public:
  /// @param first  where to begin: of rows with equally many neighbours, the one that comes first
  ///               from here on, round to row first - 1, goes first
  QuotientGraph(int size, const std::vector<std::pair<int, int>>& pairs, int first)
      : QuotientGraph(size, pairs, first, size) {}
  /// For a part of a graph: rows from `count` on, which stand around it and are eliminated later,
  /// are neighbours but are not put in order.
  QuotientGraph(int size, const std::vector<std::pair<int, int>>& pairs, int first, int count)
      : size_(size), count_(count) {
    read(pairs);
    set_dense_aside();
    for (int k = count; k-- > 0;) {
      const int i = k < count - first ? k + first : k + first - count;
      if (weight_[i] > 0) link(i, degree_[i]);
    }
  }

  /// The row that is eliminated k-th. Call once.
  /// @throws Stopped
  std::vector<int> order(StopCheck& stop) {
    for (int degree = 0; remaining_ > outside(); degree = std::min(degree, lowest_linked_)) {
      while (first_[degree] == none) ++degree;
      stop();
      eliminate(first_[degree]);
    }
    return postorder();
  }

  /// Sum of the squares of column counts of the factor, the diagonal included and dense rows left
  /// out; of a few columns an upper bound. Valid after `order`.
  [[nodiscard]] double operations() const { return operations_; }

 private:
  static constexpr int none = -1;

  void read(const std::vector<std::pair<int, int>>& pairs) {
    for (const auto& [i, j] : pairs) {
      ++variables_[i];
      ++variables_[j];
    }
    for (int i = 0; i < size_; used_ += variables_[i++]) begin_[i] = used_;
    // Twice the room, so that lists move seldom.
    lists_.all().resize(2 * static_cast<std::size_t>(used_) + static_cast<std::size_t>(size_));
    for (const auto& [i, j] : pairs) {
      lists_[begin_[i] + degree_[i]++] = j;
      lists_[begin_[j] + degree_[j]++] = i;
    }
    for (int i = 0; i < size_; ++i) {
      ++stamp_;
      int end = begin_[i];
      for (int k = begin_[i]; k < begin_[i] + variables_[i]; ++k) {
        const int j = lists_[k];
        if (mark_[j] < stamp_) lists_[end++] = j;
        mark_[j] = stamp_;
      }
      degree_[i] = variables_[i] = end - begin_[i];
    }
  }

  void set_dense_aside() {
    const int limit = std::max(16, static_cast<int>(10 * std::sqrt(size_)));
    for (int i = 0; i < size_; ++i) {
      if (variables_[i] <= limit) continue;
      weight_[i] = 0;
      --remaining_;
      if (is_outside(i)) {
        ++dense_outside_;
      } else {
        dense_.push_back(i);
      }
      for (int k = begin_[i]; k < begin_[i] + variables_[i]; ++k) --degree_[lists_[k]];
    }
  }

  // Variables by degree, in doubly linked lists.

  [[nodiscard]] bool is_outside(int i) const { return i >= count_; }
  [[nodiscard]] int outside() const { return size_ - count_ - dense_outside_; }

  void link(int i, int degree) {
    if (is_outside(i)) return;
    degree_[i] = degree;
    previous_[i] = none;
    next_[i] = first_[degree];
    if (next_[i] != none) previous_[next_[i]] = i;
    first_[degree] = i;
    lowest_linked_ = std::min(lowest_linked_, degree);
  }

  void unlink(int i) {
    if (is_outside(i)) return;
    if (next_[i] != none) previous_[next_[i]] = previous_[i];
    (previous_[i] != none ? next_[previous_[i]] : first_[degree_[i]]) = next_[i];
  }

  void eliminate(int p) {
    lowest_linked_ = size_;
    unlink(p);
    gather(p);
    measure_outside(p);
    for (int k = begin_[p], end = k + variables_[p]; k < end; ++k) update(lists_[k], p);
    stamp_ += size_ + 1;
    for (int k = begin_[p], end = k + variables_[p]; k < end; ++k)
      if (weight_[lists_[k]] < 0 && !is_outside(lists_[k])) merge_bucket(previous_[lists_[k]]);
    close(p);
  }

  /// Makes variable p an element: its neighbours, whose weights are negative until `close`. The
  /// elements of p are part of it from now on.
  void gather(int p) {
    if (used_ + degree_[p] > static_cast<int>(lists_.all().size())) compact();
    const int start = used_;
    int sum = 0;
    weight_[p] = -weight_[p];
    const auto take = [&](int from, int count) {
      for (int k = from; k < from + count; ++k) {
        const int i = lists_[k];
        if (weight_[i] <= 0) continue;
        unlink(i);
        sum += weight_[i];
        weight_[i] = -weight_[i];
        lists_[used_++] = i;
      }
    };
    const int from = begin_[p] + variables_[p];
    for (int k = from; k < from + elements_[p]; ++k) {
      const int e = lists_[k];
      take(begin_[e], variables_[e]);
      parent_[e] = p;
    }
    take(begin_[p], variables_[p]);
    begin_[p] = start;
    variables_[p] = used_ - start;
    elements_[p] = 0;
    degree_[p] = sum;
  }

  /// For every other element that shares variables with p: mark - stamp is the weight of those it
  /// does not share.
  void measure_outside(int p) {
    for (int k = begin_[p]; k < begin_[p] + variables_[p]; ++k) {
      const int i = lists_[k], from = begin_[i] + variables_[i];
      for (int l = from; l < from + elements_[i]; ++l) {
        const int e = lists_[l];
        if (mark_[e] < stamp_) mark_[e] = stamp_ + degree_[e];
        mark_[e] += weight_[i];
      }
    }
  }

  /// Shortens the lists of a variable of p to what p does not say, and bounds its degree outside p
  /// by the sum over its elements, as if they had no variable in common but those of p.
  void update(int i, int p) {
    int end = begin_[i], degree = 0;
    unsigned hash = 0;
    int k = end;
    for (const int stop = k + variables_[i]; k < stop; ++k) {
      const int j = lists_[k];
      if (weight_[j] <= 0) continue;
      degree += weight_[j];
      hash += static_cast<unsigned>(j);
      lists_[end++] = j;
    }
    variables_[i] = end - begin_[i];
    for (const int stop = k + elements_[i]; k < stop; ++k) {
      const int e = lists_[k];
      if (parent_[e] != none) continue;
      const int outside = static_cast<int>(mark_[e] - stamp_);
      if (outside == 0) {  // within p, so that p says what e did (aggressive absorption)
        parent_[e] = p;
        continue;
      }
      degree += outside;
      hash += static_cast<unsigned>(e);
      lists_[end++] = e;
    }
    if (degree == 0 &&
        !is_outside(i)) {  // no neighbours but those of p: may be eliminated at once with it
      degree_[p] += weight_[i];
      absorb(i, p);
      return;
    }
    lists_[end++] = p;  // in place of p itself or of an element that is now part of p
    elements_[i] = end - begin_[i] - variables_[i];
    degree_[i] = std::min(degree_[i], degree);
    if (is_outside(i)) return;
    const int h = static_cast<int>(hash % static_cast<unsigned>(size_));
    next_[i] = bucket_[h];
    previous_[i] = h;
    bucket_[h] = i;
  }

  void absorb(int i, int into) {
    weight_[into] += weight_[i];
    weight_[i] = 0;
    parent_[i] = into;
    merged_.push_back(i);
  }

  /// Merges the variables of this hash whose lists are the same.
  void merge_bucket(int hash) {
    int i = bucket_[hash];
    bucket_[hash] = none;
    for (; i != none && next_[i] != none; i = next_[i]) {
      ++stamp_;
      const int count = variables_[i] + elements_[i];
      for (int k = begin_[i]; k < begin_[i] + count; ++k) mark_[lists_[k]] = stamp_;
      for (int before = i, j = next_[i]; j != none; j = next_[j]) {
        bool is_same = variables_[j] == variables_[i] && elements_[j] == elements_[i];
        for (int k = begin_[j]; is_same && k < begin_[j] + count; ++k)
          is_same = mark_[lists_[k]] == stamp_;
        if (is_same) {
          absorb(j, i);
          next_[before] = next_[j];
        } else {
          before = j;
        }
      }
    }
  }

  /// Gives the variables of p their new degrees.
  void close(int p) {
    weight_[p] = -weight_[p];
    remaining_ -= weight_[p];
    for (int k = 1; k <= weight_[p]; ++k) {
      const double degree = degree_[p] + k;
      operations_ += degree * degree;
    }
    pivots_.push_back(p);
    int end = begin_[p];
    for (int k = end; k < used_; ++k) {
      const int i = lists_[k];
      if (weight_[i] == 0) continue;
      weight_[i] = -weight_[i];
      link(i, std::min(degree_[i] + degree_[p], remaining_) - weight_[i]);
      lists_[end++] = i;
    }
    variables_[p] = end - begin_[p];
    used_ = end;
    stamp_ += size_ + 1;
  }

  /// Moves the lists that are still needed together.
  void compact() {
    std::vector<int> old(lists_.all().size());
    old.swap(lists_.all());
    used_ = 0;
    for (int i = 0; i < size_; ++i) {
      // Gone: merged or dense variables, elements within others.
      const int count = parent_[i] == none && weight_[i] != 0 ? variables_[i] + elements_[i] : 0;
      const auto from = old.begin() + begin_[i];
      std::copy(from, from + count, lists_.all().begin() + used_);
      begin_[i] = used_;
      used_ += count;
    }
  }

  /// Elements as a tree: each after those that became part of it. Its variables go in turn, the
  /// last merged first: those that `update` found without neighbours outside p need not see all of
  /// p's.
  std::vector<int> postorder() {
    ByIndex<int>&total = variables_, &next_end = begin_, &own = degree_;  // of no more use as such
    int end = 0;
    for (const int p : pivots_) total[p] = 0;
    for (const int p : pivots_) {
      total[p] += weight_[p];
      (parent_[p] == none ? end : total[parent_[p]]) += total[p];
    }
    std::vector<int> order(static_cast<std::size_t>(end));
    for (std::size_t k = pivots_.size(); k-- > 0;) {
      const int p = pivots_[k];
      int& at = parent_[p] == none ? end : next_end[parent_[p]];
      order[static_cast<std::size_t>(at - 1)] = p;
      next_end[p] = own[p] = at - weight_[p];
      at -= total[p];
    }
    for (std::size_t k = merged_.size(); k-- > 0;) {
      int& p = parent_[merged_[k]];
      if (weight_[p] == 0) p = parent_[p];  // itself merged later, so placed already
      order[static_cast<std::size_t>(own[p]++)] = merged_[k];
    }
    order.insert(order.end(), dense_.begin(), dense_.end());
    return order;
  }

  int size_, count_, remaining_ = size_;  ///< variables at first, and those not yet eliminated
  int dense_outside_ = 0;
  int used_ = 0;           ///< of lists_
  int lowest_linked_ = 0;  ///< degree, since the last elimination began
  double operations_ = 0;
  ByIndex<int> lists_{0};  ///< of a variable: variables, then elements; of an element: variables
  ByIndex<int> begin_{size_}, variables_{size_},
      elements_{size_};  ///< where in lists_, and how many
  ByIndex<int> weight_{size_,
                       1};  ///< of a variable; < 0: in the element being made; 0: merged or dense
  ByIndex<int> degree_{
      size_};  ///< variables beside it, by weight: of an element exact, else a bound
  ByIndex<int> parent_{size_, none};  ///< which element or variable it is part of
  ByIndex<int> first_{size_, none};   ///< by degree
  ByIndex<int> next_{size_},
      previous_{size_};               ///< of equal degree; in `eliminate` of equal hash; hash
  ByIndex<int> bucket_{size_, none};  ///< by hash, the first
  ByIndex<std::int64_t> mark_{size_};
  std::int64_t stamp_ = 0;                    ///< above every mark of the past
  std::vector<int> pivots_, merged_, dense_;  ///< each in order of time
};

}  // namespace voussoir::detail
