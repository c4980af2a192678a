// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/detail/graph_levels.hpp>

namespace voussoir::detail {

/// Two parts of a graph that no coupling joins, and the nodes between them.
///
/// Sources: Hendrickson and Rothberg (1998), Improving the run time and quality of nested
/// dissection ordering, SIAM J. Sci. Comput. 20(2), 468-489 (separators refined on every level);
/// Fiduccia and Mattheyses (1982), A linear-time heuristic for improving network partitions, 19th
/// Design Automation Conference, 175-181.
class GraphSeparator {
 public:
  static constexpr int between = 2;

  explicit GraphSeparator(const WeightedGraph& graph)
      : graph_(&graph), side_(graph.size(), 1), beside_(2 * graph.size()) {}

  /// Grows one part from a node, step by step, to half of the bodies; then `refine`.
  void grow(int from);
  /// That of a coarser graph; then `refine`.
  void take(const GraphSeparator& coarse, const ByIndex<int>& node_of);

  [[nodiscard]] const ByIndex<char>& side() const { return side_; }
  /// The less, the better: bodies between, and what the parts differ in counts a little.
  [[nodiscard]] double cost() const {
    const int difference = std::abs(bodies_[0] - bodies_[1]);
    return bodies_[between] * (1 + 0.5 * difference / (1 + graph_->total));
  }

 private:
  struct Move {
    int node;
    std::size_t pulled;  ///< begin of those that it has drawn from the other side
  };
  struct Candidate {
    int gain, node;
    bool operator<(const Candidate& other) const {
      return gain != other.gain ? gain < other.gain : node > other.node;
    }
  };

  void refine();
  bool improve();
  void count();
  void gather_beside(int node);
  void offer(int node);
  [[nodiscard]] int gain(int node, int side) const {
    return graph_->weight[node] - beside_[2 * node + 1 - side];
  }
  /// The best node to move to a side, of those that still may; -1: none.
  int best(int side);
  void move(int node, int side);
  void undo(std::size_t moves);

  const WeightedGraph* graph_;
  ByIndex<char> side_;
  int bodies_[3] = {0, 0, 0};
  // Of one round of improvement.
  ByIndex<int> beside_;  ///< bodies in part 0 and 1 that are neighbours of a node between
  ByIndex<char> is_fixed_;
  std::array<std::vector<Candidate>, 2> heap_;
  std::vector<Move> moves_;
  std::vector<int> pulled_;
};

/// The parts (0, 1) and what is between them (2), for each node.
[[nodiscard]] VOUSSOIR_INLINE ByIndex<char> separate(const WeightedGraph& graph, StopCheck& stop);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void GraphSeparator::grow(int from) {
  const int size = graph_->size();
  side_ = ByIndex<char>(size, 1);
  // In the order of distance; another start where the graph falls apart.
  std::vector<int> queue;
  ByIndex<char> is_queued(size, 0);
  std::size_t done = 0;
  int weight = 0;
  for (int start = from, tried = 0; tried < size && 2 * weight < graph_->total;) {
    if (done == queue.size()) {
      if (!is_queued[start]) {
        is_queued[start] = 1;
        queue.push_back(start);
      }
      start = start + 1 < size ? start + 1 : 0;
      ++tried;
      continue;
    }
    const int i = queue[done++];
    side_[i] = 0;
    weight += graph_->weight[i];
    graph_->each_neighbour(i, [&](int j) {
      if (!is_queued[j]) queue.push_back(j);
      is_queued[j] = 1;
    });
  }
  for (int i = 0; i < size; ++i)
    if (side_[i] == 1)
      graph_->each_neighbour(i, [&](int j) {
        if (side_[j] == 0) side_[i] = static_cast<char>(between);
      });
  refine();
}

VOUSSOIR_INLINE void GraphSeparator::take(const GraphSeparator& coarse,
                                          const ByIndex<int>& node_of) {
  for (int i = 0; i < graph_->size(); ++i) side_[i] = coarse.side_[node_of[i]];
  refine();
}

VOUSSOIR_INLINE void GraphSeparator::refine() {
  count();
  for (int round = 0; round < 6 && improve(); ++round) {
  }
}

VOUSSOIR_INLINE void GraphSeparator::count() {
  bodies_[0] = bodies_[1] = bodies_[between] = 0;
  for (int i = 0; i < graph_->size(); ++i)
    bodies_[static_cast<unsigned char>(side_[i])] += graph_->weight[i];
}

VOUSSOIR_INLINE void GraphSeparator::gather_beside(int node) {
  int sum[3] = {0, 0, 0};
  graph_->each_neighbour(
      node, [&](int j) { sum[static_cast<unsigned char>(side_[j])] += graph_->weight[j]; });
  beside_[2 * node] = sum[0];
  beside_[2 * node + 1] = sum[1];
}

VOUSSOIR_INLINE void GraphSeparator::offer(int node) {
  if (is_fixed_[node]) return;
  for (const int side : {0, 1}) {
    heap_[static_cast<std::size_t>(side)].push_back({gain(node, side), node});
    std::push_heap(heap_[static_cast<std::size_t>(side)].begin(),
                   heap_[static_cast<std::size_t>(side)].end());
  }
}

VOUSSOIR_INLINE int GraphSeparator::best(int side) {
  auto& heap = heap_[static_cast<std::size_t>(side)];
  while (!heap.empty()) {
    const Candidate top = heap.front();
    if (side_[top.node] == between && !is_fixed_[top.node] && gain(top.node, side) == top.gain)
      return top.node;
    std::pop_heap(heap.begin(), heap.end());
    heap.pop_back();
  }
  return -1;
}

/// One round: nodes between the parts go to one of them, and draw those of the other part that they
/// are coupled to in between; the best of all states on the way is kept.
/// @return  whether that is better than the first
VOUSSOIR_INLINE bool GraphSeparator::improve() {
  const int most = static_cast<int>(0.7 * graph_->total) + 1;
  if (is_fixed_.size() == 0) is_fixed_ = ByIndex<char>(graph_->size(), 0);
  heap_[0].clear();
  heap_[1].clear();
  moves_.clear();
  pulled_.clear();
  int nodes = 0;
  for (int i = 0; i < graph_->size(); ++i)
    if (side_[i] == between) {
      gather_beside(i);
      offer(i);
      ++nodes;
    }
  double least = cost();
  std::size_t kept = 0;
  const std::size_t patience = 20 + static_cast<std::size_t>(nodes);
  while (moves_.size() < kept + patience) {
    int node = -1, to = 0, highest = 0;
    for (const int side : {0, 1}) {
      const int candidate = best(side);
      if (candidate < 0 || bodies_[side] + graph_->weight[candidate] > most) continue;
      const int its = gain(candidate, side);
      if (node < 0 || its > highest || (its == highest && bodies_[side] < bodies_[1 - side])) {
        node = candidate;
        to = side;
        highest = its;
      }
    }
    if (node < 0) break;
    move(node, to);
    if (cost() < least) {
      least = cost();
      kept = moves_.size();
    }
  }
  for (const Move& each : moves_) is_fixed_[each.node] = 0;
  undo(kept);
  return kept > 0;
}

VOUSSOIR_INLINE void GraphSeparator::move(int node, int side) {
  const int other = 1 - side;
  moves_.push_back({node, pulled_.size()});
  is_fixed_[node] = 1;
  side_[node] = static_cast<char>(side);
  bodies_[side] += graph_->weight[node];
  bodies_[between] -= graph_->weight[node];
  graph_->each_neighbour(node, [&](int j) {
    if (side_[j] == between) {
      beside_[2 * j + side] += graph_->weight[node];
      offer(j);
    } else if (side_[j] == other) {
      side_[j] = static_cast<char>(between);
      bodies_[other] -= graph_->weight[j];
      bodies_[between] += graph_->weight[j];
      pulled_.push_back(j);
    }
  });
  for (std::size_t k = moves_.back().pulled; k < pulled_.size(); ++k) {
    const int j = pulled_[k];
    gather_beside(j);
    offer(j);
    graph_->each_neighbour(j, [&](int i) {
      if (side_[i] != between) return;
      beside_[2 * i + other] -= graph_->weight[j];
      offer(i);
    });
  }
}

VOUSSOIR_INLINE void GraphSeparator::undo(std::size_t kept) {
  while (moves_.size() > kept) {
    const Move last = moves_.back();
    moves_.pop_back();
    const char other = static_cast<char>(1 - side_[last.node]);
    side_[last.node] = static_cast<char>(between);
    for (; pulled_.size() > last.pulled; pulled_.pop_back()) side_[pulled_.back()] = other;
  }
  count();
}

VOUSSOIR_INLINE ByIndex<char> separate(const WeightedGraph& graph, StopCheck& stop) {
  constexpr int coarse_enough = 100, starts = 5;
  std::vector<CoarserGraph> levels;
  const auto finest = [&](std::size_t level) -> const WeightedGraph& {
    return level == 0 ? graph : levels[level - 1].graph;
  };
  levels.reserve(64);
  while (levels.size() < 64 && finest(levels.size()).size() > coarse_enough) {
    const WeightedGraph& fine = finest(levels.size());
    stop();
    levels.emplace_back(fine, std::max(2, 2 * graph.total / coarse_enough));
    if (levels.back().graph.size() < 0.9 * fine.size()) continue;
    break;
  }
  const WeightedGraph& coarsest = finest(levels.size());
  GraphSeparator best(coarsest);
  for (int k = 0; k < starts; ++k) {
    GraphSeparator separator(coarsest);
    separator.grow(static_cast<int>(static_cast<long long>(coarsest.size()) * k / starts));
    if (k == 0 || separator.cost() < best.cost()) best = std::move(separator);
  }
  for (std::size_t level = levels.size(); level-- > 0;) {
    stop();
    GraphSeparator finer(finest(level));
    finer.take(best, levels[level].node_of);
    best = std::move(finer);
  }
  return best.side();
}

#endif

}  // namespace voussoir::detail
