// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/detail/faces_by_cut.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// Blocks of sliced rock from back to front: none hides a later one. Exact, also after the blocks
/// were moved apart in proportion to their distance from one point.
///
/// Each cut parted one block; undone from the last to the first, the cuts give back the binary tree
/// by which the rock was sliced. Of the two sides of a cut, the one away from the viewer comes
/// first. Moving apart takes two blocks further to their sides of the cut between them, so the
/// order remains right.
///
/// @param towards  the viewer, from far away
/// @cost  about linear in the faces
[[nodiscard]] VOUSSOIR_INLINE std::vector<int> painting_order(const RockMass<Spatial>& mass,
                                                              const Vec3& towards);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<int> painting_order(const RockMass<Spatial>& mass,
                                                const Vec3& towards) {
  struct Node {
    int behind, before;  ///< towards the viewer; nodes, or blocks if below their number
  };
  const std::size_t blocks = mass.bodies.size();
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<Node> nodes(blocks, {-1, -1});
  std::vector<int> parent(blocks);  // of the groups of blocks put together so far
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&](int node) {
    while (parent[at(node)] != node) node = parent[at(node)] = parent[at(parent[at(node)])];
    return node;
  };
  const std::vector<FaceRef> faces = faces_by_cut(mass);
  for (std::size_t end = faces.size(); end > 0;) {
    std::size_t begin = end - 1;
    while (begin > 0 && faces[begin - 1].cut == faces[end - 1].cut) --begin;
    // One block on either side of the cut stands for all that is there.
    const auto normal_of = [&](const FaceRef& f) -> const Vec3& {
      return mass.bodies[at(f.body)].parts[at(f.part)].half_space(at(f.face)).normal;
    };
    const Vec3& out = normal_of(faces[begin]);
    int behind = faces[begin].body, before = -1;
    for (std::size_t k = begin + 1; k < end && before < 0; ++k)
      if (normal_of(faces[k]).dot(out) < 0) before = faces[k].body;
    end = begin;
    if (before < 0) continue;  // a side of the domain
    if (out.dot(towards) < 0) std::swap(behind, before);
    behind = root_of(behind);
    before = root_of(before);
    if (behind == before) continue;
    const int node = static_cast<int>(nodes.size());
    nodes.push_back({behind, before});
    parent.push_back(node);
    parent[at(behind)] = parent[at(before)] = node;
  }
  // One tree, unless blocks have been taken out of the rock.
  std::vector<std::pair<double, int>> roots;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (parent[n] != static_cast<int>(n)) continue;
    int any = static_cast<int>(n);
    while (at(any) >= blocks) any = nodes[at(any)].behind;
    roots.emplace_back(mass.bodies[at(any)].properties.centroid.dot(towards), static_cast<int>(n));
  }
  std::sort(roots.begin(), roots.end());
  std::vector<int> order, stack;
  order.reserve(blocks);
  for (const auto& [depth, root] : roots) {
    stack.push_back(root);
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      if (at(node) < blocks) {
        order.push_back(node);
      } else {
        stack.push_back(nodes[at(node)].before);
        stack.push_back(nodes[at(node)].behind);
      }
    }
  }
  VOUSSOIR_ASSERT(is_permutation(order), "every block is painted once");
  return order;
}

#endif

}  // namespace voussoir::detail
