// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/small_algebra.hpp>

namespace voussoir {

/// Symmetric sparse matrix of Dof x Dof blocks, one block row per body: the lower triangle.
template <int Dof>
class BlockMatrix {
 public:
  using Block = Fixed<Dof, Dof>;

  explicit BlockMatrix(int bodies) : diagonal_(static_cast<std::size_t>(bodies), zeros<Block>()) {}

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
  void compress();

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
  [[nodiscard]] Eigen::VectorXd absolute_row_sums() const;

 private:
  struct Entry {
    int row, column;
    Block block;
  };
  std::vector<Block> diagonal_;
  std::vector<Entry> entries_;
};

template <int Dof>
void BlockMatrix<Dof>::compress() {
  std::vector<std::pair<int, int>> places;
  places.reserve(entries_.size());
  for (const Entry& e : entries_) places.emplace_back(e.column, e.row);
  std::vector<Entry> kept;
  kept.reserve(entries_.size());
  for (const int k : order_of_pairs(places, size())) {
    const Entry& e = entries_[static_cast<std::size_t>(k)];
    if (!kept.empty() && kept.back().row == e.row && kept.back().column == e.column) {
      kept.back().block += e.block;
    } else {
      kept.push_back(e);
    }
  }
  entries_ = std::move(kept);
}

template <int Dof>
Eigen::VectorXd BlockMatrix<Dof>::absolute_row_sums() const {
  Eigen::VectorXd sums = zeros(Dof * size());
  const auto add_rows = [&sums](int row, const Block& block) {
    for (int c = 0; c < Dof; ++c)
      for (int r = 0; r < Dof; ++r) sums[Dof * row + r] += std::abs(block(r, c));
  };
  for (int i = 0; i < size(); ++i) add_rows(i, diagonal(i));
  for (const Entry& e : entries_) {
    add_rows(e.row, e.block);
    add_rows(e.column, transposed(e.block));
  }
  return sums;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class BlockMatrix<3>;
VOUSSOIR_SPATIAL_TEMPLATE class BlockMatrix<6>;
#endif

}  // namespace voussoir
