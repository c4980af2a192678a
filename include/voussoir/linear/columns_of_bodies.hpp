// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/linear_programme.hpp>

namespace voussoir {
namespace detail {

/// The columns of a programme by the bodies that they act on.
template <int Dof>
struct ColumnsOfBodies {
  struct Column {
    int a, b = -1;                        ///< bodies
    int pair = -1;                        ///< of two, a > b
    std::array<double, 2 * Dof> entry{};  ///< on a, on b
  };
  std::vector<Column> columns;
  std::vector<std::pair<int, int>> pairs;  ///< each once
  int bodies;

  explicit ColumnsOfBodies(const LinearProgramme& programme) : bodies(programme.rows() / Dof) {
    if (programme.rows() % Dof != 0)
      throw InvalidInput(
          "interior point: rows must be of bodies, each with its forces and moments");
    const auto at = [](int k) { return static_cast<std::size_t>(k); };
    std::vector<std::array<int, 3>> joined;  // a, b, column
    for (int j = 0; j < programme.columns(); ++j) {
      Column column{};
      column.a = -1;
      for (int k = programme.start[at(j)]; k < programme.start[at(j) + 1]; ++k) {
        const int row = programme.row[at(k)], body = row / Dof;
        if (column.a < 0) column.a = body;
        if (body != column.a && column.b < 0) column.b = body;
        if (body != column.a && body != column.b)
          throw InvalidInput("interior point: a column must be of two bodies at most");
        column.entry[at((body == column.a ? 0 : Dof) + row % Dof)] += programme.entry[at(k)];
      }
      if (column.b > column.a) {
        std::swap(column.a, column.b);
        std::swap_ranges(column.entry.begin(), column.entry.begin() + Dof,
                         column.entry.begin() + Dof);
      }
      if (column.b >= 0) joined.push_back({column.a, column.b, j});
      columns.push_back(column);
    }
    std::sort(joined.begin(), joined.end());
    for (const auto& [a, b, j] : joined) {
      if (pairs.empty() || pairs.back() != std::pair(a, b)) pairs.emplace_back(a, b);
      columns[at(j)].pair = static_cast<int>(pairs.size()) - 1;
    }
  }

  /// y += A x
  void add_product(const std::vector<double>& x, Eigen::VectorXd& y) const {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const Column& c = columns[j];
      for (int d = 0; d < Dof; ++d) y[Dof * c.a + d] += c.entry[static_cast<std::size_t>(d)] * x[j];
      if (c.b >= 0)
        for (int d = 0; d < Dof; ++d)
          y[Dof * c.b + d] += c.entry[static_cast<std::size_t>(Dof + d)] * x[j];
    }
  }
  /// Entry j of A' y.
  [[nodiscard]] double price(std::size_t j, const Eigen::VectorXd& y) const {
    const Column& c = columns[j];
    double sum = 0;
    for (int d = 0; d < Dof; ++d) sum += c.entry[static_cast<std::size_t>(d)] * y[Dof * c.a + d];
    if (c.b >= 0)
      for (int d = 0; d < Dof; ++d)
        sum += c.entry[static_cast<std::size_t>(Dof + d)] * y[Dof * c.b + d];
    return sum;
  }
  /// A W A', W the weights of columns, alone or by three.
  /// @param triples  columns from triple.first on, whose weight is R' R, R = triple.root; all three
  ///                 act on the same bodies
  template <class Triples>
  [[nodiscard]] BlockMatrix<Dof> normal_matrix(const std::vector<double>& weights,
                                               const Triples& triples) const {
    BlockMatrix<Dof> matrix(bodies);
    std::vector<Fixed<Dof, Dof>> across(pairs.size(), zeros<Fixed<Dof, Dof>>());
    const auto outer_at = [](const Column& c, int first, int second, double weight) {
      Fixed<Dof, Dof> block;
      for (int k = 0; k < Dof; ++k)
        for (int i = 0; i < Dof; ++i)
          block(i, k) = weight * c.entry[static_cast<std::size_t>(first + i)] *
                        c.entry[static_cast<std::size_t>(second + k)];
      return block;
    };
    const auto add = [&](const Column& c, double weight) {
      matrix.add(c.a, outer_at(c, 0, 0, weight));
      if (c.b < 0) return;
      matrix.add(c.b, outer_at(c, Dof, Dof, weight));
      across[static_cast<std::size_t>(c.pair)] += outer_at(c, 0, Dof, weight);
    };
    auto triple = triples.begin();
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if (triple == triples.end() || j != triple->first) {
        add(columns[j], weights[j]);
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        Column mixed = columns[j];
        for (std::size_t e = 0; e < mixed.entry.size(); ++e) {
          mixed.entry[e] = 0;
          for (int i = 0; i < 3; ++i)
            mixed.entry[e] +=
                triple->root(k, i) * columns[j + static_cast<std::size_t>(i)].entry[e];
        }
        add(mixed, 1);
      }
      j += 2;
      ++triple;
    }
    for (std::size_t k = 0; k < pairs.size(); ++k)
      matrix.add(pairs[k].first, pairs[k].second, across[k]);
    matrix.compress();
    return matrix;
  }
};

}  // namespace detail
}  // namespace voussoir
