// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace voussoir {

/// A transposed copy. Set before it is assigned to, because g++ 12 takes Eigen's check for aliasing
/// in a construction from a transpose for a use of uninitialised memory, and warns.
template <int Dof>
[[nodiscard]] Eigen::Matrix<double, Dof, Dof> transposed(
    const Eigen::Matrix<double, Dof, Dof>& block) {
  Eigen::Matrix<double, Dof, Dof> copy = Eigen::Matrix<double, Dof, Dof>::Zero();
  copy = block.transpose();
  return copy;
}

/// Symmetric sparse matrix of Dof x Dof blocks, one block row per body: the lower triangle.
template <int Dof>
class BlockMatrix {
 public:
  using Block = Eigen::Matrix<double, Dof, Dof>;

  explicit BlockMatrix(int bodies) : diagonal_(static_cast<std::size_t>(bodies), Block::Zero()) {}

  [[nodiscard]] int size() const { return static_cast<int>(diagonal_.size()); }
  [[nodiscard]] const Block& diagonal(int i) const {
    return diagonal_[static_cast<std::size_t>(i)];
  }

  void add(int i, const Block& block) { diagonal_[static_cast<std::size_t>(i)] += block; }
  /// Adds the block of row i and column j, i != j (and its transpose above).
  void add(int i, int j, const Block& block) {
    if (i > j) {
      entries_.push_back({i, j, block});
    } else {
      entries_.push_back({j, i, transposed(block)});
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

  /// Coupled bodies (row, column), row > column, each once; valid after `compress`.
  [[nodiscard]] std::vector<std::pair<int, int>> pairs() const {
    std::vector<std::pair<int, int>> all;
    all.reserve(entries_.size());
    for (const Entry& e : entries_) all.emplace_back(e.row, e.column);
    return all;
  }
  /// The block of pair k.
  [[nodiscard]] const Block& below(int k) const {
    return entries_[static_cast<std::size_t>(k)].block;
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

 private:
  struct Entry {
    int row, column;
    Block block;
  };
  std::vector<Block> diagonal_;
  std::vector<Entry> entries_;
};

}  // namespace voussoir
