// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <voussoir/linear/block_matrix.hpp>

namespace voussoir_test {

/// All entries of a symmetric block matrix, above the diagonal too.
template <int Dof>
[[nodiscard]] Eigen::MatrixXd dense(const voussoir::BlockMatrix<Dof>& matrix) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(Dof * matrix.size(), Dof * matrix.size());
  for (int i = 0; i < matrix.size(); ++i)
    full.block<Dof, Dof>(Dof * i, Dof * i) = matrix.diagonal(i);
  int k = 0;
  for (const auto& [i, j] : matrix.pairs()) {
    full.block<Dof, Dof>(Dof * i, Dof * j) = matrix.below(k);
    full.block<Dof, Dof>(Dof * j, Dof * i) = matrix.below(k).transpose();
    ++k;
  }
  return full;
}

}  // namespace voussoir_test
