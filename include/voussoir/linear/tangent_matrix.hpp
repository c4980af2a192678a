// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>
#include <voussoir/core/small_algebra.hpp>

namespace voussoir {

/// Sparse block matrix of symmetric pattern and unsymmetric values: a tangent with sliding joints.
template <int Dof>
struct TangentMatrix {
  using Block = Fixed<Dof, Dof>;
  std::vector<Block> diagonal;
  std::vector<std::pair<int, int>> pairs;  ///< coupled bodies (i, j), each pair once
  std::vector<Block> forward, backward;    ///< blocks (i, j) and (j, i)
};

}  // namespace voussoir
