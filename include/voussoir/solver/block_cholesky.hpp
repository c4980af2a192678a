// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <voussoir/core/errors.hpp>
#include <voussoir/solver/block_matrix.hpp>

namespace voussoir {

/// Sparse Cholesky factor A = L L^T by blocks of one body each, and solves with it.
///
/// Up-looking factorisation along the elimination tree. Working on Dof x Dof blocks keeps one index
/// per Dof^2 numbers: a third of the time and two thirds of the memory of a factor by single
/// unknowns (bench/equilibrium_bench.cpp has both).
///
/// Source: Davis (2006), Direct Methods for Sparse Linear Systems, chapter 4.
template <int Dof>
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, Dof, Dof>;

  /// @throws NumericalFault  not positive definite: some body can move without resistance; the
  ///                         message names its index
  /// @cost   about 0.02 s for 5 000 bodies in 2-D; grows as n^1.5
  explicit BlockCholesky(const BlockMatrix<Dof>& matrix) {
    const auto n = static_cast<std::size_t>(matrix.size());
    from_new_ = matrix.elimination_order();
    to_new_.resize(n);
    for (std::size_t k = 0; k < n; ++k) to_new_[static_cast<std::size_t>(from_new_[k])] = static_cast<int>(k);
    gather_rows(matrix);
    find_structure();
    factorise(matrix);
    std::vector<Block>().swap(row_blocks_);
  }

  /// Blocks in the factor, the diagonal included.
  [[nodiscard]] std::size_t block_count() const { return blocks_.size() + inverse_.size(); }

  /// Solves A x = b in place.
  void solve_in_place(Eigen::VectorXd& x) const {
    const std::size_t n = inverse_.size();
    Eigen::VectorXd y(x.size());
    for (std::size_t k = 0; k < n; ++k)
      y.template segment<Dof>(at(k)) = x.template segment<Dof>(Dof * from_new_[k]);
    for (std::size_t j = 0; j < n; ++j) {
      const Eigen::Matrix<double, Dof, 1> v = inverse_[j] * y.template segment<Dof>(at(j));
      y.template segment<Dof>(at(j)) = v;
      for (std::size_t p = begin_[j]; p < begin_[j + 1]; ++p)
        y.template segment<Dof>(Dof * rows_[p]).noalias() -= blocks_[p] * v;
    }
    for (std::size_t j = n; j-- > 0;) {
      Eigen::Matrix<double, Dof, 1> v = y.template segment<Dof>(at(j));
      for (std::size_t p = begin_[j]; p < begin_[j + 1]; ++p)
        v.noalias() -= blocks_[p].transpose() * y.template segment<Dof>(Dof * rows_[p]);
      y.template segment<Dof>(at(j)) = inverse_[j].transpose() * v;
    }
    for (std::size_t k = 0; k < n; ++k)
      x.template segment<Dof>(Dof * from_new_[k]) = y.template segment<Dof>(at(k));
  }

 private:
  [[nodiscard]] static Eigen::Index at(std::size_t k) { return Dof * static_cast<Eigen::Index>(k); }

  /// Rows of the permuted lower triangle: columns left of the diagonal and their blocks.
  void gather_rows(const BlockMatrix<Dof>& matrix) {
    const std::size_t n = to_new_.size();
    row_begin_.assign(n + 1, 0);
    const auto place = [this](int row, int column) {
      const int i = to_new_[static_cast<std::size_t>(row)], j = to_new_[static_cast<std::size_t>(column)];
      return std::pair(std::max(i, j), std::min(i, j));
    };
    matrix.for_each_below([&](int row, int column, const Block&) {
      ++row_begin_[static_cast<std::size_t>(place(row, column).first) + 1];
    });
    for (std::size_t k = 0; k < n; ++k) row_begin_[k + 1] += row_begin_[k];
    row_columns_.resize(row_begin_[n]);
    row_blocks_.resize(row_begin_[n]);
    std::vector<std::size_t> next(row_begin_.begin(), row_begin_.end() - 1);
    matrix.for_each_below([&](int row, int column, const Block& block) {
      const auto [i, j] = place(row, column);
      const std::size_t to = next[static_cast<std::size_t>(i)]++;
      row_columns_[to] = j;
      // The block is A(row, column); below the new diagonal it may stand the other way round.
      if (to_new_[static_cast<std::size_t>(row)] == i) {
        row_blocks_[to] = block;
      } else {
        row_blocks_[to] = block.transpose();
      }
    });
  }

  /// Calls visit(j) for the columns of row i of L, in an order that respects the tree.
  template <class Visit>
  void for_each_in_row(int i, std::vector<int>& mark, std::vector<int>& stack, Visit&& visit) const {
    const auto row = static_cast<std::size_t>(i);
    std::size_t top = stack.size();
    mark[row] = i;
    std::vector<int>& path = path_;
    for (std::size_t p = row_begin_[row]; p < row_begin_[row + 1]; ++p) {
      path.clear();
      for (int j = row_columns_[p]; j >= 0 && mark[static_cast<std::size_t>(j)] != i;
           j = parent_[static_cast<std::size_t>(j)]) {
        path.push_back(j);
        mark[static_cast<std::size_t>(j)] = i;
      }
      for (std::size_t k = path.size(); k-- > 0;) stack[--top] = path[k];
    }
    for (std::size_t k = top; k < stack.size(); ++k) visit(stack[k]);
  }

  /// Elimination tree and the number of blocks in every column of L.
  void find_structure() {
    const std::size_t n = to_new_.size();
    parent_.assign(n, -1);
    std::vector<int> ancestor(n, -1);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t p = row_begin_[i]; p < row_begin_[i + 1]; ++p)
        for (int j = row_columns_[p]; j >= 0 && j < static_cast<int>(i);) {
          const auto at_j = static_cast<std::size_t>(j);
          const int up = ancestor[at_j];
          ancestor[at_j] = static_cast<int>(i);
          if (up < 0) parent_[at_j] = static_cast<int>(i);
          j = up;
        }
    begin_.assign(n + 1, 0);
    std::vector<int> mark(n, -1), stack(n);
    for (std::size_t i = 0; i < n; ++i)
      for_each_in_row(static_cast<int>(i), mark, stack,
                      [this](int j) { ++begin_[static_cast<std::size_t>(j) + 1]; });
    for (std::size_t k = 0; k < n; ++k) begin_[k + 1] += begin_[k];
    rows_.resize(begin_[n]);
    blocks_.resize(begin_[n]);
  }

  void factorise(const BlockMatrix<Dof>& matrix) {
    const std::size_t n = to_new_.size();
    inverse_.resize(n);
    std::vector<std::size_t> end(begin_.begin(), begin_.end() - 1);
    std::vector<Block> work(n, Block::Zero());
    std::vector<int> mark(n, -1), stack(n);
    for (std::size_t i = 0; i < n; ++i) {
      Block pivot = matrix.diagonal(from_new_[i]);
      for (std::size_t p = row_begin_[i]; p < row_begin_[i + 1]; ++p)
        work[static_cast<std::size_t>(row_columns_[p])] = row_blocks_[p];
      for_each_in_row(static_cast<int>(i), mark, stack, [&](int column) {
        const auto j = static_cast<std::size_t>(column);
        // L(i, j) = work(j) L(j, j)^-T; then row i of what remains loses L(i, j) L(k, j)^T.
        const Block lij = work[j] * inverse_[j].transpose();
        work[j].setZero();
        for (std::size_t p = begin_[j]; p < end[j]; ++p)
          work[static_cast<std::size_t>(rows_[p])].noalias() -= lij * blocks_[p].transpose();
        pivot.noalias() -= lij * lij.transpose();
        rows_[end[j]] = static_cast<int>(i);
        blocks_[end[j]++] = lij;
      });
      const Eigen::LLT<Block> small(pivot);
      const double smallest = matrix.diagonal(from_new_[i]).diagonal().minCoeff();
      if (small.info() != Eigen::Success ||
          !(small.matrixL().toDenseMatrix().diagonal().array().square().minCoeff() >
            1e-13 * smallest))
        throw NumericalFault("elastic stiffness: unknown " + std::to_string(from_new_[i]) +
                             " can move without resistance (a body held by nothing)");
      inverse_[i] = small.matrixL().solve(Block::Identity());
    }
  }

  std::vector<int> to_new_, from_new_;
  std::vector<std::size_t> row_begin_;
  std::vector<int> row_columns_;
  std::vector<Block> row_blocks_;
  std::vector<int> parent_;
  mutable std::vector<int> path_;
  std::vector<std::size_t> begin_;  ///< of the columns of L below the diagonal
  std::vector<int> rows_;
  std::vector<Block> blocks_;
  std::vector<Block> inverse_;  ///< of the diagonal blocks of L
};

}  // namespace voussoir
