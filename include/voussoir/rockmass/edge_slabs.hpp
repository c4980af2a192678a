// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir {

/// Blocks that stand for the edge of the domain, outside it, on every side but the top.
/// @param is_there  is_there(axis, upper): false for sides that have none
template <int Dim, class IsThere>
[[nodiscard]] auto edge_slabs(const Domain<Dim>& domain, IsThere&& is_there) {
  using Shape = decltype(as_block(domain));
  const double thickness = 0.1 * largest_entry(domain.size());
  std::vector<Shape> slabs;
  for (int axis = 0; axis < Dim; ++axis)
    for (const bool upper : {false, true}) {
      if ((upper && axis == Dim - 1) || !is_there(axis, upper)) continue;
      Domain<Dim> slab = domain;
      slab.low = shifted_by(slab.low, -thickness);
      slab.high = shifted_by(slab.high, thickness);
      if (upper)
        slab.low[axis] = domain.high[axis];
      else
        slab.high[axis] = domain.low[axis];
      slabs.push_back(as_block(slab));
    }
  return slabs;
}
template <int Dim>
[[nodiscard]] auto edge_slabs(const Domain<Dim>& domain) {
  return edge_slabs(domain, [](int, bool) { return true; });
}

}  // namespace voussoir
