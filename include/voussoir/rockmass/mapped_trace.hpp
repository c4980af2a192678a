// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/joint.hpp>

namespace voussoir {

/// A joint as it was drawn on a map: a polyline, however many its points.
struct MappedTrace {
  std::vector<Vec2> points;  ///< two or more [m]
  int set = -1;              ///< index of its joint set; -1: none
};

/// Every straight piece of some traces as a joint of its own, for `slice` and for estimates.
[[nodiscard]] inline std::vector<Joint> straight_pieces(const std::vector<MappedTrace>& traces) {
  std::vector<Joint> pieces;
  for (const MappedTrace& trace : traces)
    for (std::size_t k = 1; k < trace.points.size(); ++k)
      pieces.push_back({{trace.points[k - 1], trace.points[k]}, trace.set});
  return pieces;
}

}  // namespace voussoir
