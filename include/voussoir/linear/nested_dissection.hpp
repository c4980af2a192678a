// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/progress.hpp>
#if VOUSSOIR_BODIES
#include <voussoir/linear/detail/dissection.hpp>
#include <voussoir/linear/detail/elimination_tree.hpp>
#include <voussoir/linear/detail/quotient_graph.hpp>
#endif

namespace voussoir {

/// In which order to eliminate the bodies of a large model so that the factor stays sparse: nested
/// dissection. A set of bodies that separates the others into two halves goes last; before it the
/// halves, each ordered in the same way; parts too small for that by approximate minimum degree.
///
/// Minimum degree for the whole, which is made first, is kept where it is as good, and where the
/// factor is too cheap for another order to pay: in 2-D up to some 300 000 bodies, and in long
/// strips of rock beyond.
///
/// Deterministic, and no coordinates are needed.
///
/// Source: George (1973), Nested dissection of a regular finite element mesh, SIAM J. Numer. Anal.
/// 10(2), 345-363; Ashcraft and Liu (1998), Robust ordering of sparse matrices using multisection,
/// SIAM J. Matrix Anal. Appl. 19(3), 816-832 (minimum degree in the parts, which knows of what is
/// around them).
///
/// @param dof    unknowns of a body: an operation on blocks is dof^3 on numbers
/// @param size   bodies, numbered from 0
/// @param pairs  coupled bodies i != j, in either order, each pair once
/// @param progress  asked now and then whether to go on
/// @return       the body that is eliminated k-th
/// @throws Stopped
[[nodiscard]] VOUSSOIR_INLINE std::vector<int> nested_dissection_order(
    int dof, int size, const std::vector<std::pair<int, int>>& pairs,
    const Progress& progress = {});

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<int> nested_dissection_order(
    int dof, int size, const std::vector<std::pair<int, int>>& pairs, const Progress& progress) {
  StopCheck stop(progress);
  detail::QuotientGraph whole(size, pairs, 0);
  std::vector<int> degree_order = whole.order(stop);
  // Dissection takes the time of some 10 000 operations per body and pair, and saves from none to a
  // half of them.
  const double much = 5e4 * (static_cast<double>(size) + static_cast<double>(pairs.size()));
  if (whole.operations() * dof * dof * dof < much) return degree_order;
  const detail::BodyGraph graph(size, pairs);
  std::vector<int> dissected = detail::Dissection(graph).order(stop);
  VOUSSOIR_ASSERT(detail::is_permutation(dissected), "every body is eliminated once");
  double operations = 0;
  const detail::EliminationTree tree(graph, dissected);
  for (const double count : tree.count.all()) operations += count * count;
  return operations < whole.operations() ? dissected : degree_order;
}

#endif

}  // namespace voussoir
