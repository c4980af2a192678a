// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/thread_team.hpp>
#include <voussoir/linear/cholesky_pattern.hpp>

namespace voussoir::detail {

/// Which fronts a thread treats alone, by whole subtrees, and which all treat together: those
/// above.
class FrontSchedule {
 public:
  FrontSchedule(const CholeskyPattern& pattern, unsigned threads);

  /// The last front of every subtree: the most expensive first, for one thread in their order.
  [[nodiscard]] const std::vector<int>& subtrees() const { return subtrees_; }
  /// The fronts above, each after its children.
  [[nodiscard]] const std::vector<int>& top() const { return top_; }

  /// Numbers in use while the factor is made, at the worst time: with several threads an upper
  /// bound, since all subtrees wait for the fronts above them.
  [[nodiscard]] double most_numbers(const CholeskyPattern& pattern) const;

 private:
  unsigned threads_;
  std::vector<int> subtrees_, top_;
};

/// Deals out the subtrees to whoever has time.
class SubtreeQueue {
 public:
  explicit SubtreeQueue(std::size_t count) : count_(count) {}

  /// Calls treat(k) for one subtree after the other. The first member calls wait() until all are
  /// done, whoever does them; then all meet.
  template <class Treat, class Wait>
  void work(ThreadTeam& team, unsigned member, Treat&& treat, Wait&& wait) {
    for (std::size_t k = next_++; k < count_; k = next_++) {
      treat(k);
      ++done_;
    }
    while (member == 0 && done_ < count_) {
      wait();
      std::this_thread::yield();
    }
    team.meet();
  }

 private:
  std::size_t count_;
  std::atomic<std::size_t> next_{0}, done_{0};
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE FrontSchedule::FrontSchedule(const CholeskyPattern& pattern, unsigned threads)
    : threads_(std::max(threads, 1U)) {
  const auto& fronts = pattern.fronts();
  double all = 0;
  for (std::size_t f = 0; f < fronts.size(); ++f)
    if (fronts[f].parent < 0) all += pattern.subtree_cost(static_cast<int>(f));
  // Small enough to come out even; the more is left to all together, the more often they meet.
  const double most = threads < 2 ? all : all / (8 * threads);
  std::vector<int> roots;
  std::vector<double> saved;
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const int front = static_cast<int>(f), parent = fronts[f].parent;
    if (pattern.subtree_cost(front) > most) {
      top_.push_back(front);
    } else if (parent < 0 || pattern.subtree_cost(parent) > most) {
      roots.push_back(front);
      saved.push_back(-pattern.subtree_cost(front));
    }
  }
  for (const std::size_t k : order_of_values(saved)) subtrees_.push_back(roots[k]);
  if (threads < 2) std::sort(subtrees_.begin(), subtrees_.end());
}

VOUSSOIR_INLINE double FrontSchedule::most_numbers(const CholeskyPattern& pattern) const {
  if (threads_ < 2) return pattern.most_numbers();
  const auto& fronts = pattern.fronts();
  // A front leaves the square of its rows below to its parent, which takes it with its own.
  const auto left_by = [&](int f) {
    const double rows =
        fronts[static_cast<std::size_t>(f)].rows() - fronts[static_cast<std::size_t>(f)].columns();
    return rows * rows;
  };
  double waiting = 0, peak = 0;
  const auto make = [&](int f) {
    waiting += left_by(f);
    peak = std::max(peak, waiting);
    for (int c = fronts[static_cast<std::size_t>(f)].child; c >= 0;
         c = fronts[static_cast<std::size_t>(c)].sibling)
      waiting -= left_by(c);
  };
  double within = 0;  // of one subtree while it is made
  for (const int last : subtrees_) {
    waiting = peak = 0;
    for (int f = fronts[static_cast<std::size_t>(last)].youngest; f <= last; ++f) make(f);
    within = std::max(within, peak);
  }
  waiting = 0;
  for (const int last : subtrees_) waiting += left_by(last);
  peak = waiting + threads_ * within;
  for (const int f : top_) make(f);
  return pattern.stored_numbers() + peak * pattern.dof() * pattern.dof();
}

#endif

}  // namespace voussoir::detail
