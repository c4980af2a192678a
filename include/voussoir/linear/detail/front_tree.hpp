// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/linear/detail/elimination_tree.hpp>

namespace voussoir::detail {

/// Columns of the factor that are eliminated together, a front: those that have the same rows below
/// them, and others where it costs less to treat them as if they had.
///
/// Sources: Ashcraft and Grimes (1989), The influence of relaxed supernode partitions on the
/// multifrontal method, ACM Trans. Math. Softw. 15(4), 291-309; order of the children: Liu (1986),
/// On the storage requirement in the out-of-core multifrontal method for sparse factorization, ACM
/// Trans. Math. Softw. 12(3), 249-264.
struct FrontTree {
  std::vector<int> order;   ///< the body that is eliminated k-th
  ByIndex<int> first;       ///< column of front k, which ends before that of front k + 1
  ByIndex<int> below;       ///< bodies below the columns of a front
  ByIndex<int> parent;      ///< of a front; -1: none; parents come after their children
  double most_waiting = 0;  ///< blocks that wait to be added to a parent, at the worst time

  /// @param dof  unknowns of a body
  FrontTree(const EliminationTree& tree, int dof);

  [[nodiscard]] int size() const { return parent.size(); }
};

/// What a front costs, in additions and multiplications.
[[nodiscard]] inline double front_cost(int columns, int below, int dof) {
  const double w = dof * columns, r = dof * below;
  // Tiles round the sizes up; an update is written, read and added; the factor is read in every
  // solve; a front takes some time in any case (fitted to times of 2-D and 3-D tunnels).
  return w * (w * w / 3 + (r + 4) * (r + 4 + w)) + 8 * r * r + 30 * w * (w + r) + 3000;
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE FrontTree::FrontTree(const EliminationTree& tree, int dof) {
  const int size = tree.parent.size();
  // Groups of columns with equal rows, found by the last column of each.
  ByIndex<int> group_of(size), last, columns, rows;
  for (int j = 0; j < size; ++j) {
    if (j == 0 || tree.parent[j - 1] != j || tree.count[j - 1] != tree.count[j] + 1) {
      last.push_back(j);
      columns.push_back(0);
      rows.push_back(0);
    }
    const int g = group_of[j] = last.size() - 1;
    last[g] = j;
    ++columns[g];
    rows[g] = tree.count[j] - 1;
  }
  // Each becomes part of its parent if that costs less.
  const int groups = last.size();
  ByIndex<int> up(groups, -1);
  ByIndex<char> is_merged(groups, 0);
  for (int g = 0; g < groups; ++g) {
    if (tree.parent[last[g]] < 0) continue;
    const int p = up[g] = group_of[tree.parent[last[g]]];
    const double apart =
        front_cost(columns[g], rows[g], dof) + front_cost(columns[p], rows[p], dof);
    if (front_cost(columns[g] + columns[p], rows[p], dof) > apart) continue;
    VOUSSOIR_ASSERT(p > g, "a front is merged into a later one");
    is_merged[g] = 1;
    columns[p] += columns[g];
  }
  ByIndex<int> merged(groups);
  for (int g = groups; g-- > 0;) {
    merged[g] = is_merged[g] ? merged[up[g]] : g;
    if (up[g] >= 0) up[g] = merged[up[g]];
  }
  // Children first whose own work needs the most beyond what they leave waiting.
  ByIndex<int> fronts(groups, 1), last_child(groups, -1), before(groups, -1);
  ByIndex<double> most(groups);
  ByIndex<std::vector<int>> children(groups + 1);
  ByIndex<int> position(groups + 1);
  const auto square = [](double x) { return x * x; };
  for (int g = 0; g <= groups; ++g) {
    if (g < groups && is_merged[g]) continue;
    std::vector<int>& mine = children[g];
    std::vector<double> excess;
    excess.reserve(mine.size());
    for (const int c : mine) excess.push_back(square(rows[c]) - most[c]);
    std::vector<int> sorted;
    double waiting = 0, peak = 0;
    for (const std::size_t k : order_of_values(excess)) {
      const int c = mine[k];
      sorted.push_back(c);
      peak = std::max(peak, waiting + most[c]);
      waiting += square(rows[c]);
    }
    mine.swap(sorted);
    if (g == groups) {
      most_waiting = peak;
      break;
    }
    most[g] = std::max(peak, waiting + square(rows[g]));
    const int p = up[g] < 0 ? groups : up[g];
    children[p].push_back(g);
    if (p < groups) fronts[p] += fronts[g];
    ++position[groups];
  }
  const int kept = position[groups];
  first = ByIndex<int>(kept + 1);
  below = parent = ByIndex<int>(kept, -1);
  for (int g = groups; g >= 0; --g) {
    if (g < groups && is_merged[g]) continue;
    int at = position[g];  // of the children: those before it
    for (std::size_t k = children[g].size(); k-- > 0;) {
      const int c = children[g][k];
      position[c] = --at;
      parent[at] = g < groups ? position[g] : -1;
      below[at] = rows[c];
      first[at + 1] = columns[c];
      at -= fronts[c] - 1;
    }
  }
  for (int f = 0; f < kept; ++f) first[f + 1] += first[f];
  ByIndex<int> next = first;
  order.resize(static_cast<std::size_t>(size));
  for (int j = 0; j < size; ++j)
    order[static_cast<std::size_t>(next[position[merged[group_of[j]]]]++)] =
        tree.order[static_cast<std::size_t>(j)];
  VOUSSOIR_ASSERT(first[kept] == size, "fronts have all columns among them");
  VOUSSOIR_ASSERT(is_permutation(order), "every body is eliminated once");
}

#endif

}  // namespace voussoir::detail
