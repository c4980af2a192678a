// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Symmetric sparse matrix of Dof x Dof blocks, one block row per body: the lower triangle.
template <int Dof>
class BlockMatrix {
 public:
  using Block = Eigen::Matrix<double, Dof, Dof>;

  explicit BlockMatrix(int bodies) : diagonal_(static_cast<std::size_t>(bodies), Block::Zero()) {}

  [[nodiscard]] int size() const { return static_cast<int>(diagonal_.size()); }
  [[nodiscard]] const Block& diagonal(int i) const { return diagonal_[static_cast<std::size_t>(i)]; }

  void add(int i, const Block& block) { diagonal_[static_cast<std::size_t>(i)] += block; }
  /// Adds the block of row i and column j, i != j (and its transpose above).
  void add(int i, int j, const Block& block) {
    if (i > j) {
      entries_.push_back({i, j, block});
    } else {
      entries_.push_back({j, i, block.transpose()});
    }
  }

  /// Sums entries of the same place. Call once, after the last `add`.
  void compress() {
    std::sort(entries_.begin(), entries_.end(), [](const Entry& x, const Entry& y) {
      return x.column != y.column ? x.column < y.column : x.row < y.row;
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (kept > 0 && entries_[kept - 1].row == entries_[k].row &&
          entries_[kept - 1].column == entries_[k].column) {
        entries_[kept - 1].block += entries_[k].block;
      } else {
        entries_[kept++] = entries_[k];
      }
    }
    entries_.resize(kept);
  }

  /// Calls visit(row, column, block) for every block below the diagonal.
  template <class Visit>
  void for_each_below(Visit&& visit) const {
    for (const Entry& e : entries_) visit(e.row, e.column, e.block);
  }

  /// Sum of the absolute values in every row: Gershgorin's bound on the eigenvalues.
  [[nodiscard]] Eigen::VectorXd absolute_row_sums() const {
    Eigen::VectorXd sums(Dof * size());
    for (int i = 0; i < size(); ++i)
      sums.segment<Dof>(Dof * i) = diagonal(i).cwiseAbs().rowwise().sum();
    for (const Entry& e : entries_) {
      sums.segment<Dof>(Dof * e.row) += e.block.cwiseAbs().rowwise().sum();
      sums.segment<Dof>(Dof * e.column) += e.block.cwiseAbs().colwise().sum().transpose();
    }
    return sums;
  }

  /// Order of elimination that keeps the factor sparse (approximate minimum degree on bodies, not
  /// on single unknowns: a graph with Dof^2 fewer edges, and the same answer).
  [[nodiscard]] std::vector<int> elimination_order() const {
    Eigen::SparseMatrix<double> graph(size(), size());
    std::vector<Eigen::Triplet<double>> pattern;
    pattern.reserve(2 * entries_.size() + diagonal_.size());
    for (int i = 0; i < size(); ++i) pattern.emplace_back(i, i, 1.0);
    for (const Entry& e : entries_) {
      pattern.emplace_back(e.row, e.column, 1.0);
      pattern.emplace_back(e.column, e.row, 1.0);
    }
    graph.setFromTriplets(pattern.begin(), pattern.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(graph, order);
    return {order.indices().data(), order.indices().data() + size()};
  }

 private:
  struct Entry {
    int row, column;
    Block block;
  };
  std::vector<Block> diagonal_;
  std::vector<Entry> entries_;
};

}  // namespace voussoir
