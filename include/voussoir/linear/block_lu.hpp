// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/block_elimination.hpp>
#include <voussoir/linear/small_inverse.hpp>
#include <voussoir/linear/tangent_matrix.hpp>

namespace voussoir {

/// Factor A = L U by blocks, and solves with it. Pivots are the diagonal blocks in the order of
/// elimination: no pivoting between bodies, so the caller must check what comes out.
template <int Dof>
class BlockLU {
 public:
  using Block = Fixed<Dof, Dof>;

  /// @param progress  asked now and then whether to go on
  /// @throws Stopped
  explicit BlockLU(const TangentMatrix<Dof>& matrix, const Progress& progress = {});

  /// Solves A x = b in place.
  void solve_in_place(Eigen::VectorXd& x) const;

 private:
  [[nodiscard]] static Eigen::Index at(std::size_t k) { return Dof * static_cast<Eigen::Index>(k); }

  BlockElimination pattern_;
  std::vector<int> rows_;
  std::vector<Block> lower_, upper_;  ///< column by column of L, row by row of U
  std::vector<Block> inverse_;        ///< of the pivots
};

template <int Dof>
BlockLU<Dof>::BlockLU(const TangentMatrix<Dof>& matrix, const Progress& progress)
    : pattern_(static_cast<int>(matrix.diagonal.size()), matrix.pairs, progress) {
  VOUSSOIR_ASSERT(
      matrix.forward.size() == matrix.pairs.size() && matrix.backward.size() == matrix.pairs.size(),
      "a coupling has two blocks");
  StopCheck stop(progress);
  const std::size_t n = pattern_.size();
  rows_.resize(pattern_.block_count());
  lower_.resize(pattern_.block_count());
  upper_.resize(pattern_.block_count());
  inverse_.resize(n);
  std::vector<std::size_t> end(n);
  for (std::size_t k = 0; k < n; ++k) end[k] = pattern_.begin(k);
  std::vector<Block> left(n, zeros<Block>()), top(n, zeros<Block>());
  BlockElimination::RowWalk walk(pattern_);
  for (std::size_t i = 0; i < n; ++i) {
    stop();
    Block pivot = matrix.diagonal[static_cast<std::size_t>(pattern_.original(i))];
    walk(
        i,
        [&](const BlockElimination::Place& place) {
          const auto pair = static_cast<std::size_t>(place.pair);
          const auto column = static_cast<std::size_t>(place.column);
          left[column] = place.flipped ? matrix.backward[pair] : matrix.forward[pair];
          top[column] = place.flipped ? matrix.forward[pair] : matrix.backward[pair];
        },
        [&](std::size_t j) {
          const Block lij = left[j] * inverse_[j], uji = top[j];
          left[j] = zeros<Block>();
          top[j] = zeros<Block>();
          for (std::size_t p = pattern_.begin(j); p < end[j]; ++p) {
            const auto k = static_cast<std::size_t>(rows_[p]);
            subtract_product(left[k], lij, upper_[p]);
            subtract_product(top[k], lower_[p], uji);
          }
          VOUSSOIR_ASSERT(end[j] < pattern_.begin(j + 1), "the factor has room for its blocks");
          subtract_product(pivot, lij, uji);
          rows_[end[j]] = static_cast<int>(i);
          lower_[end[j]] = lij;
          upper_[end[j]++] = uji;
        });
    inverse_[i] = inverse_of<Dof>(pivot);
  }
}

template <int Dof>
void BlockLU<Dof>::solve_in_place(Eigen::VectorXd& x) const {
  const std::size_t n = inverse_.size();
  VOUSSOIR_ASSERT(x.size() == at(n), "a vector has the unknowns of the factor");
  Eigen::VectorXd y(x.size());
  for (std::size_t k = 0; k < n; ++k)
    set_part<Dof>(y, at(k), part<Dof>(x, Dof * pattern_.original(k)));
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t p = pattern_.begin(j); p < pattern_.begin(j + 1); ++p)
      add_at<Dof>(y.data() + Dof * rows_[p], -(lower_[p] * part<Dof>(y, at(j))));
  for (std::size_t j = n; j-- > 0;) {
    Fixed<Dof, 1> v = part<Dof>(y, at(j));
    for (std::size_t p = pattern_.begin(j); p < pattern_.begin(j + 1); ++p)
      v -= upper_[p] * part<Dof>(y, Dof * rows_[p]);
    set_part<Dof>(y, at(j), inverse_[j] * v);
  }
  for (std::size_t k = 0; k < n; ++k)
    set_part<Dof>(x, Dof * pattern_.original(k), part<Dof>(y, at(k)));
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class BlockLU<3>;
VOUSSOIR_SPATIAL_TEMPLATE class BlockLU<6>;
#endif

}  // namespace voussoir
