// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/linear/detail/by_index.hpp>

namespace voussoir::detail {

/// On which column each column of the factor of a symmetric matrix depends, and how long they are.
///
/// Sources: Liu (1986), A compact row storage scheme for Cholesky factors using elimination trees,
/// ACM Trans. Math. Softw. 12(2), 127-148; Gilbert, Ng and Peyton (1994), An efficient algorithm to
/// compute row and column counts for sparse Cholesky factorization, SIAM J. Matrix Anal. Appl.
/// 15(4), 1075-1091; both as in Davis (2006), Direct Methods for Sparse Linear Systems, chapter 4.
struct EliminationTree {
  std::vector<int> order;  ///< the body that is eliminated k-th; a postorder of the tree
  ByIndex<int> parent;     ///< of column k; -1: none
  ByIndex<int> count;      ///< blocks of column k of the factor, the diagonal included

  /// @param order  of elimination; changed to a postorder, which fills in as much
  EliminationTree(const BodyGraph& graph, std::vector<int> order);
};

/// The inverse of an order: the place of every body in it.
[[nodiscard]] inline ByIndex<int> places_in(const std::vector<int>& order) {
  ByIndex<int> place(static_cast<int>(order.size()));
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<int>(k);
  return place;
}

/// The nodes of a forest, each after its children, which keep their order.
/// @param parent  of node k, above k; -1: none
[[nodiscard]] VOUSSOIR_INLINE std::vector<int> postorder(const ByIndex<int>& parent);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<int> postorder(const ByIndex<int>& parent) {
  // From the sizes of the subtrees every node knows its place: the nodes below a parent fill the
  // places before it, the last child those next to it.
  const int size = parent.size();
  ByIndex<int> below(size, 1), end(size);
  int roots_end = size;
  for (int k = 0; k < size; ++k)
    if (parent[k] >= 0) below[parent[k]] += below[k];
  std::vector<int> order(static_cast<std::size_t>(size));
  for (int k = size; k-- > 0;) {
    int& at = parent[k] < 0 ? roots_end : end[parent[k]];
    order[static_cast<std::size_t>(at - 1)] = k;
    end[k] = at - 1;
    at -= below[k];
  }
  VOUSSOIR_ASSERT(is_permutation(order), "a postorder has every node once");
  return order;
}

/// parent of every column under an order
VOUSSOIR_INLINE ByIndex<int> parents(const BodyGraph& graph, const std::vector<int>& order) {
  const ByIndex<int> place = places_in(order);
  const int size = graph.size();
  ByIndex<int> parent(size, -1), ancestor(size, -1);
  for (int i = 0; i < size; ++i) {
    const int body = order[static_cast<std::size_t>(i)];
    for (int k = graph.begin[body]; k < graph.begin[body + 1]; ++k)
      for (int j = place[graph.next[k]]; j >= 0 && j < i;) {
        const int up = ancestor[j];
        ancestor[j] = i;
        if (up < 0) parent[j] = i;
        j = up;
      }
  }
  return parent;
}

VOUSSOIR_INLINE EliminationTree::EliminationTree(const BodyGraph& graph, std::vector<int> given)
    : order(std::move(given)), parent(parents(graph, order)), count(graph.size()) {
  const int size = graph.size();
  VOUSSOIR_ASSERT(order.size() == static_cast<std::size_t>(size) && is_permutation(order),
                  "every body is eliminated once");
  {
    const std::vector<int> post = postorder(parent);
    const ByIndex<int> place = places_in(post);
    std::vector<int> reordered(order.size());
    ByIndex<int> moved(size, -1);
    for (int k = 0; k < size; ++k) {
      const int old = post[static_cast<std::size_t>(k)];
      reordered[static_cast<std::size_t>(k)] = order[static_cast<std::size_t>(old)];
      if (parent[old] >= 0) moved[k] = place[parent[old]];
    }
    order.swap(reordered);
    parent = std::move(moved);
  }
  // Row i of the factor is a subtree; a column counts where such a subtree has a leaf, less where
  // two of its branches meet.
  const ByIndex<int> place = places_in(order);
  ByIndex<int> first(size, -1), last_first(size, -1), last_leaf(size, -1), ancestor(size);
  for (int k = 0; k < size; ++k) {
    ancestor[k] = k;
    if (first[k] < 0) count[k] = 1;  // a leaf of the whole tree
    for (int j = k; j >= 0 && first[j] < 0; j = parent[j]) first[j] = k;
  }
  for (int j = 0; j < size; ++j) {
    if (parent[j] >= 0) --count[parent[j]];
    const int body = order[static_cast<std::size_t>(j)];
    for (int k = graph.begin[body]; k < graph.begin[body + 1]; ++k) {
      const int i = place[graph.next[k]];
      if (i <= j || first[j] <= last_first[i]) continue;
      last_first[i] = first[j];
      ++count[j];
      if (last_leaf[i] >= 0) {
        int meeting = last_leaf[i];
        while (ancestor[meeting] != meeting) meeting = ancestor[meeting];
        for (int at = last_leaf[i]; at != meeting;) at = std::exchange(ancestor[at], meeting);
        --count[meeting];
      }
      last_leaf[i] = j;
    }
    if (parent[j] >= 0) ancestor[j] = parent[j];
  }
  for (int j = 0; j < size; ++j) {
    VOUSSOIR_ASSERT(parent[j] < 0 || parent[j] > j, "a parent is eliminated after its children");
    if (parent[j] >= 0) count[parent[j]] += count[j];
    VOUSSOIR_ASSERT(count[j] >= 1 && count[j] <= size - j,
                    "a column of the factor is from its diagonal to the end at most");
  }
}

#endif

}  // namespace voussoir::detail
