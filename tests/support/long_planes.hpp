// SPDX-License-Identifier: MIT
#pragma once
// What the method of half spaces must find, from the definitions, in long double.

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>

#include "support/separating_axes.hpp"

namespace voussoir_test {

/// The half spaces normal . x <= offset of two shapes.
template <int Dim>
struct LongPlanes {
  std::vector<LongVec<Dim>> normals;
  std::vector<long double> offsets;

  LongPlanes() = default;
  LongPlanes(const LongShape<Dim>& a, const LongShape<Dim>& b) {
    for (const auto* shape : {&a, &b})
      for (std::size_t f = 0; f < shape->faces.size(); ++f) {
        normals.push_back(shape->normals[f]);
        offsets.push_back(shape->normals[f].dot(shape->at(shape->faces[f][0])));
      }
  }
  [[nodiscard]] long double room(std::size_t plane, const voussoir::Vec<Dim>& point) const {
    return offsets[plane] - normals[plane].dot(point.template cast<long double>());
  }
};

/// How far from a point the least of -sum log(room) is, as a fraction of the rooms: the greatest
/// slope of the barrier in any direction over the root of its curvature there. That is the length
/// of the part of (1, 1, ...) that the columns normal_k[axis] / room_k span.
template <int Dim>
[[nodiscard]] long double decrement(const LongPlanes<Dim>& planes,
                                    const voussoir::Vec<Dim>& point) {
  using Column = std::vector<long double>;
  const std::size_t count = planes.normals.size();
  std::vector<Column> columns(Dim, Column(count));
  for (std::size_t k = 0; k < count; ++k)
    for (int axis = 0; axis < Dim; ++axis)
      columns[static_cast<std::size_t>(axis)][k] = planes.normals[k][axis] / planes.room(k, point);
  const auto product = [count](const Column& u, const Column& v) {
    long double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += u[k] * v[k];
    return sum;
  };
  const Column ones(count, 1);
  long double squared = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (int round = 0; round < 2; ++round)  // the second for what cancellation lost
      for (std::size_t e = 0; e < c; ++e) {
        const long double share = product(columns[c], columns[e]);
        for (std::size_t k = 0; k < count; ++k) columns[c][k] -= share * columns[e][k];
      }
    const long double length = std::sqrt(product(columns[c], columns[c]));
    for (long double& entry : columns[c]) entry /= length;
    squared += std::pow(product(columns[c], ones), 2.0L);
  }
  return std::sqrt(squared);
}

/// The x of N linear equations, each row with its right side last; zeros if a pivot is below 1e-13.
template <std::size_t N>
[[nodiscard]] std::array<long double, N> solved(
    std::array<std::array<long double, N + 1>, N> rows) {
  std::array<std::size_t, N> unknown{};
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t row = k, column = 0;
    for (std::size_t i = k; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j)
        if (std::abs(rows[i][j]) > std::abs(rows[row][column])) {
          row = i;
          column = j;
        }
    if (std::abs(rows[row][column]) < 1e-13L) return {};
    std::swap(rows[k], rows[row]);
    unknown[k] = column;
    for (std::size_t i = 0; i < N; ++i) {
      if (i == k) continue;
      const long double factor = rows[i][column] / rows[k][column];
      for (std::size_t j = 0; j <= N; ++j) rows[i][j] -= factor * rows[k][j];
      rows[i][column] = 0;
    }
  }
  std::array<long double, N> x{};
  for (std::size_t k = 0; k < N; ++k) x[unknown[k]] = rows[k][N] / rows[k][unknown[k]];
  return x;
}

/// The least s with normal . x - s <= offset for all planes and some x. By duality it is the
/// largest over all sets of Dim + 1 planes that have a convex combination of normals that is 0.
template <int Dim>
[[nodiscard]] long double least_excess_by_sets(const LongPlanes<Dim>& planes) {
  constexpr std::size_t N = Dim + 1;
  long double best = -std::numeric_limits<long double>::infinity();
  std::array<std::size_t, N> pick{};
  const auto search = [&](const auto& self, std::size_t depth, std::size_t from) -> void {
    if (depth < N) {
      for (std::size_t k = from; k < planes.normals.size(); ++k) {
        pick[depth] = k;
        self(self, depth + 1, k + 1);
      }
      return;
    }
    std::array<std::array<long double, N + 1>, N> rows{};  // sum w normal = 0, sum w = 1
    for (std::size_t k = 0; k < N; ++k) {
      for (std::size_t axis = 0; axis < Dim; ++axis)
        rows[axis][k] = planes.normals[pick[k]][static_cast<int>(axis)];
      rows[Dim][k] = 1;
    }
    rows[Dim][N] = 1;
    long double sum = 0, excess = 0;
    const auto weights = solved<N>(rows);
    for (std::size_t k = 0; k < N; ++k) {
      if (weights[k] < -1e-16L) return;  // of parallel faces it is 0 but for rounding
      sum += weights[k];
      excess -= weights[k] * planes.offsets[pick[k]];
    }
    if (sum > 0.5L) best = std::max(best, excess);
  };
  search(search, 0, 0);
  return best;
}

}  // namespace voussoir_test
