// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/detail/surface.hpp>

namespace voussoir::detail {

/// Removes from a loop what encloses nothing: a vertex that follows itself, and the way along an
/// edge and back again.
VOUSSOIR_INLINE void remove_spikes(std::vector<int>& loop);

/// Makes one vertex of those that are equal, and drops the faces that are left with fewer than
/// three. Leaves the surface as it is where too little of it would be left.
/// @return  number of faces dropped
VOUSSOIR_INLINE std::size_t merge_equal_vertices(Surface& surface);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void remove_spikes(std::vector<int>& loop) {
  const auto erase = [&](std::size_t k) {
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k % loop.size()));
  };
  for (std::size_t k = 0; loop.size() >= 2 && k < loop.size();) {
    const std::size_t n = loop.size();
    if (loop[k] == loop[(k + 1) % n]) {
      erase(k);
      k = 0;
    } else if (loop[k] == loop[(k + 2) % n]) {
      const std::size_t tip = (k + 1) % n;
      erase(tip);
      erase(tip);  // its foot, which is there twice
      k = 0;
    } else {
      ++k;
    }
  }
}

VOUSSOIR_INLINE std::size_t merge_equal_vertices(Surface& surface) {
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  const std::size_t count = surface.vertices.size();
  std::vector<int> same(count);
  bool any = false;
  for (std::size_t v = 0; v < count; ++v) {
    same[v] = static_cast<int>(v);
    for (std::size_t w = 0; w < v && at(same[v]) == v; ++w)
      if (surface.vertices[w] == surface.vertices[v]) same[v] = same[w];
    any = any || at(same[v]) != v;
  }
  if (!any) return 0;
  Surface merged;
  std::vector<int> number(count, -1), loop;
  for (const Surface::Face& face : surface.faces) {
    loop.clear();
    for (const int v : surface.loop(face)) loop.push_back(same[at(v)]);
    remove_spikes(loop);
    if (loop.size() < 3) continue;
    const auto begin = static_cast<int>(merged.loops.size());
    for (const int v : loop) {
      int& name = number[at(v)];
      if (name < 0) {
        name = static_cast<int>(merged.vertices.size());
        merged.vertices.push_back(surface.vertices[at(v)]);
      }
      merged.loops.push_back(name);
    }
    merged.faces.push_back({face.plane, face.cut, begin, static_cast<int>(merged.loops.size())});
  }
  // One closed surface still, by Euler: not two that a vertex has pinched off.
  if (merged.faces.size() < 4 || find_twins(merged) ||
      merged.vertices.size() + merged.faces.size() != merged.loops.size() / 2 + 2)
    return 0;
  const std::size_t dropped = surface.faces.size() - merged.faces.size();
  surface = std::move(merged);
  return dropped;
}

#endif

}  // namespace voussoir::detail
