// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/small_algebra.hpp>

namespace voussoir {

namespace detail {

/// s -= B x. By columns, which the compiler keeps in registers for it knows that s is its own.
template <int Dof>
inline void subtract_block(const Fixed<Dof, Dof>& block, const double* x, double (&s)[Dof]) {
  for (int c = 0; c < Dof; ++c) {
    const double factor = x[c];
    for (int r = 0; r < Dof; ++r) s[r] -= block.data()[Dof * c + r] * factor;
  }
}
/// y -= B^T x
template <int Dof>
inline void subtract_block_transposed(const Fixed<Dof, Dof>& block, const double (&x)[Dof],
                                      double* y) {
  for (int c = 0; c < Dof; ++c) {
    double sum = block.data()[Dof * c] * x[0];
    for (int r = 1; r < Dof; ++r) sum += block.data()[Dof * c + r] * x[r];
    y[c] -= sum;
  }
}

}  // namespace detail

/// Symmetric sparse matrix of Dof x Dof blocks, one block row per body: the lower triangle by rows.
template <int Dof>
class BlockMatrix {
 public:
  using Block = Fixed<Dof, Dof>;

  explicit BlockMatrix(int bodies) : diagonal_(static_cast<std::size_t>(bodies), zeros<Block>()) {}

  [[nodiscard]] int size() const { return static_cast<int>(diagonal_.size()); }
  [[nodiscard]] const Block& diagonal(int i) const {
    VOUSSOIR_ASSERT(detail::is_index(i, size()), "a block on the diagonal is of a body");
    return diagonal_[static_cast<std::size_t>(i)];
  }

  void add(int i, const Block& block) {
    VOUSSOIR_ASSERT(detail::is_index(i, size()), "a stiffness is added to a body");
    diagonal_[static_cast<std::size_t>(i)] += block;
  }
  /// Adds the block of row i and column j, i != j (and its transpose above).
  void add(int i, int j, const Block& block) {
    VOUSSOIR_ASSERT(detail::is_index(i, size()) && detail::is_index(j, size()) && i != j,
                    "a coupling is of two bodies");
    if (i > j) {
      added_.push_back({i, j, block});
    } else {
      added_.push_back({j, i, transposed(block)});
    }
  }

  /// Sums blocks of the same place and puts them in order. Call once, after the last `add`; what
  /// follows is valid from then on.
  void compress();

  /// Blocks below the diagonal in row i: numbers row_begin(i), ..., row_begin(i + 1) - 1, their
  /// columns growing.
  [[nodiscard]] int row_begin(int i) const { return row_begin_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] int column(int k) const { return columns_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] const Block& below(int k) const { return blocks_[static_cast<std::size_t>(k)]; }
  /// Coupled bodies (row, column), row > column, each once: pair k is that of block k.
  [[nodiscard]] std::vector<std::pair<int, int>> pairs() const {
    std::vector<std::pair<int, int>> all;
    all.reserve(columns_.size());
    for (int i = 0; i < size(); ++i)
      for (int k = row_begin(i); k < row_begin(i + 1); ++k) all.emplace_back(i, column(k));
    return all;
  }

  /// y = A x
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  /// Sum of the absolute values in every row: Gershgorin's bound on the eigenvalues.
  [[nodiscard]] Eigen::VectorXd absolute_row_sums() const;

 private:
  struct Entry {
    int row, column;
    Block block;
  };
  std::vector<Block> diagonal_;
  std::vector<Entry> added_;  ///< until `compress`
  std::vector<int> row_begin_, columns_;
  std::vector<Block> blocks_;
};

template <int Dof>
void BlockMatrix<Dof>::compress() {
  std::vector<std::pair<int, int>> places;
  places.reserve(added_.size());
  for (const Entry& e : added_) places.emplace_back(e.row, e.column);
  const std::vector<int> order = order_of_pairs(places, size());
  // As many as there are places: bodies often touch in several contacts.
  std::size_t distinct = 0;
  for (std::size_t k = 0; k < order.size(); ++k)
    distinct += k == 0 || places[static_cast<std::size_t>(order[k])] !=
                              places[static_cast<std::size_t>(order[k - 1])];
  columns_.reserve(distinct);
  blocks_.reserve(distinct);
  row_begin_.assign(diagonal_.size() + 1, 0);
  int row = -1;
  for (const int k : order) {
    const Entry& e = added_[static_cast<std::size_t>(k)];
    if (row == e.row && columns_.back() == e.column) {
      blocks_.back() += e.block;
    } else {
      columns_.push_back(e.column);
      blocks_.push_back(e.block);
      row = e.row;
      ++row_begin_[static_cast<std::size_t>(row) + 1];
    }
  }
  for (std::size_t i = 1; i < row_begin_.size(); ++i) row_begin_[i] += row_begin_[i - 1];
  VOUSSOIR_ASSERT(columns_.size() == distinct && blocks_.size() == distinct,
                  "couplings of the same two bodies are one block");
  VOUSSOIR_ASSERT(static_cast<std::size_t>(row_begin_.back()) == distinct,
                  "rows have all blocks among them");
  std::vector<Entry>().swap(added_);  // what is assigned to it would keep its memory
}

template <int Dof>
void BlockMatrix<Dof>::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  VOUSSOIR_ASSERT(x.size() == Dof * static_cast<Eigen::Index>(size()),
                  "a vector has the unknowns of the matrix");
  VOUSSOIR_ASSERT(row_begin_.size() == diagonal_.size() + 1, "a matrix is compressed before use");
  y.resize(x.size());
  for (int i = 0; i < size(); ++i) {
    // One pass over the lower triangle: block (i, j) acts on x_j, its transpose on x_i.
    const Fixed<Dof, 1> own = part<Dof>(x, Dof * i);
    Fixed<Dof, 1> sum = diagonal(i) * own;
    for (int k = row_begin(i); k < row_begin(i + 1); ++k) {
      sum += below(k) * part<Dof>(x, Dof * column(k));
      add_at<Dof>(y.data() + Dof * column(k), transposed_product(below(k), own));
    }
    set_part<Dof>(y, Dof * i, sum);
  }
}

template <int Dof>
Eigen::VectorXd BlockMatrix<Dof>::absolute_row_sums() const {
  VOUSSOIR_ASSERT(row_begin_.size() == diagonal_.size() + 1, "a matrix is compressed before use");
  Eigen::VectorXd sums = zeros(Dof * size());
  const auto add_rows = [&sums](int row, const Block& block) {
    for (int c = 0; c < Dof; ++c)
      for (int r = 0; r < Dof; ++r) sums[Dof * row + r] += std::abs(block(r, c));
  };
  for (int i = 0; i < size(); ++i) {
    VOUSSOIR_ASSERT(detail::is_symmetric(diagonal(i)), "a stiffness is symmetric");
    add_rows(i, diagonal(i));
    for (int k = row_begin(i); k < row_begin(i + 1); ++k) {
      add_rows(i, below(k));
      add_rows(column(k), transposed(below(k)));
    }
  }
  return sums;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class BlockMatrix<3>;
VOUSSOIR_SPATIAL_TEMPLATE class BlockMatrix<6>;
#endif

}  // namespace voussoir
