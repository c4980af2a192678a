// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <voussoir/core/bodies.hpp>
#include <voussoir/linear/detail/by_index.hpp>

namespace voussoir::detail {

/// A graph whose nodes may stand for several bodies each.
struct WeightedGraph {
  ByIndex<int> begin, next;  ///< neighbours of node i: next[k], begin[i] <= k < begin[i + 1]
  ByIndex<int> ties;         ///< couplings that next[k] stands for
  ByIndex<int> weight;       ///< bodies of node i
  int total = 0;             ///< bodies

  [[nodiscard]] int size() const { return weight.size(); }
  template <class Visit>
  void each_neighbour(int i, Visit&& visit) const {
    for (int k = begin[i]; k < begin[i + 1]; ++k) visit(next[k]);
  }
};

/// The same graph with neighbours merged in pairs, those with the most couplings first.
///
/// Source: Karypis and Kumar (1998), A fast and high quality multilevel scheme for partitioning
/// irregular graphs, SIAM J. Sci. Comput. 20(1), 359-392 (heavy edge matching).
struct CoarserGraph {
  WeightedGraph graph;
  ByIndex<int> node_of;  ///< of the coarser graph, for every node of the finer

  /// @param heaviest  nodes are not merged into one of more bodies
  CoarserGraph(const WeightedGraph& fine, int heaviest);
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE CoarserGraph::CoarserGraph(const WeightedGraph& fine, int heaviest)
    : node_of(fine.size(), -1) {
  const int size = fine.size();
  // Nodes with few neighbours first: they have the least choice.
  constexpr int most = 16;
  ByIndex<int> start(most + 2), visit(size), partner(size, -1);
  const auto degree = [&](int i) { return std::min(fine.begin[i + 1] - fine.begin[i], most); };
  for (int i = 0; i < size; ++i) ++start[degree(i) + 1];
  for (int d = 0; d <= most; ++d) start[d + 1] += start[d];
  for (int i = 0; i < size; ++i) visit[start[degree(i)]++] = i;
  for (const int i : visit.all()) {
    if (partner[i] >= 0) continue;
    int best = i, ties = 0;
    for (int k = fine.begin[i]; k < fine.begin[i + 1]; ++k) {
      const int j = fine.next[k];
      if (partner[j] >= 0 || fine.weight[i] + fine.weight[j] > heaviest) continue;
      if (fine.ties[k] > ties || (fine.ties[k] == ties && fine.weight[j] < fine.weight[best])) {
        best = j;
        ties = fine.ties[k];
      }
    }
    partner[i] = best;
    partner[best] = i;
  }
  int count = 0;
  for (int i = 0; i < size; ++i)
    if (i <= partner[i]) node_of[i] = node_of[partner[i]] = count++;
  graph.begin = ByIndex<int>(count + 1);
  graph.weight = ByIndex<int>(count);
  graph.next = graph.ties = ByIndex<int>(fine.next.size());
  graph.total = fine.total;
  ByIndex<int> slot(count, -1);
  int used = 0;
  for (int i = 0; i < size; ++i) {
    if (i > partner[i]) continue;
    const int c = node_of[i];
    graph.begin[c] = used;
    for (const int member : {i, partner[i]}) {
      graph.weight[c] += fine.weight[member];
      for (int k = fine.begin[member]; k < fine.begin[member + 1]; ++k) {
        const int to = node_of[fine.next[k]];
        if (to == c) continue;
        if (slot[to] < graph.begin[c]) {
          slot[to] = used;
          graph.next[used] = to;
          graph.ties[used++] = 0;
        }
        graph.ties[slot[to]] += fine.ties[k];
      }
      if (partner[i] == i) break;
    }
  }
  graph.begin[count] = used;
  graph.next.all().resize(static_cast<std::size_t>(used));
  graph.ties.all().resize(static_cast<std::size_t>(used));
}

#endif

}  // namespace voussoir::detail
