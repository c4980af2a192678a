// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>

#include "support/laid_problem.hpp"

/// Limit analysis of blocks that are laid: the second method beside every procedure, which shares
/// no code with them but the shapes.
namespace voussoir_test {

/// Maximises c . x over A x = b, x >= 0, by the two-phase simplex method on a dense tableau.
///
/// Source: Dantzig (1951); entering column by the largest coefficient, after many pivots by the
/// first (Bland 1977), which cannot go round in circles. Of rows that bind alike the one with the
/// largest pivot leaves (Harris 1973): joints share out forces in many ways, and small pivots lose
/// the digits.
/// @param rows   each of A followed by its b
/// @param first  unknowns from there on stay zero until the equations are satisfied
/// @return  the maximum; nothing if no x of the first unknowns satisfies the equations; infinity if
///          there is none
[[nodiscard]] inline std::optional<double> simplex(std::vector<std::vector<double>> rows,
                                                   const std::vector<double>& c,
                                                   std::size_t first) {
  const std::size_t m = rows.size(), n = c.size(), end = n + m;
  constexpr double zero = 1e-9, least_pivot = 1e-8, tie = 1e-10;
  std::vector<std::size_t> basis(m);
  for (std::size_t i = 0; i < m; ++i) {  // one artificial unknown a row
    const double b = rows[i][n];
    rows[i].resize(n);
    if (b < 0)
      for (double& a : rows[i]) a = -a;
    rows[i].resize(end, 0.0);
    rows[i][n + i] = 1;
    rows[i].push_back(std::abs(b));
    basis[i] = n + i;
  }
  const auto pivot = [&](std::vector<double>& cost, std::size_t row, std::size_t column) {
    const double p = rows[row][column];
    for (double& a : rows[row]) a /= p;
    const auto clear = [&](std::vector<double>& other) {
      const double f = other[column];
      if (f == 0) return;
      for (std::size_t k = 0; k <= end; ++k) other[k] -= f * rows[row][k];
      other[column] = 0;
    };
    for (std::size_t i = 0; i < m; ++i)
      if (i != row) clear(rows[i]);
    clear(cost);
    basis[row] = column;
  };
  // Drives cost down to where no entry of it is negative; false: without end.
  const auto optimise = [&](std::vector<double>& cost, std::size_t columns) {
    for (int made = 0;; ++made) {
      std::size_t in = columns;
      for (std::size_t k = 0; k < columns; ++k)
        if (cost[k] < -zero && (in == columns || (made < 2000 && cost[k] < cost[in]))) in = k;
      if (in == columns) return true;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < m; ++i)
        if (rows[i][in] > least_pivot)
          least = std::min(least, (std::max(rows[i][end], 0.0) + tie) / rows[i][in]);
      std::size_t out = m;
      for (std::size_t i = 0; i < m; ++i) {
        const double a = rows[i][in];
        if (!(a > least_pivot) || std::max(rows[i][end], 0.0) / a > least) continue;
        const bool is_better =
            out == m || (made < 2000 ? a > rows[out][in] : basis[i] < basis[out]);
        if (is_better) out = i;
      }
      if (out == m) return false;
      pivot(cost, out, in);
    }
  };
  std::vector<double> artificial(end + 1, 0.0), cost(end + 1, 0.0);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < n; ++k) artificial[k] -= rows[i][k];
    artificial[end] -= rows[i][end];
  }
  (void)optimise(artificial, first);
  if (artificial[end] < -1e-7) return std::nullopt;
  for (std::size_t i = 0; i < m; ++i) {  // rows that say nothing keep their artificial unknown
    if (basis[i] < n) continue;
    std::size_t largest = 0;
    for (std::size_t k = 0; k < n; ++k)
      if (std::abs(rows[i][k]) > std::abs(rows[i][largest])) largest = k;
    if (std::abs(rows[i][largest]) > 1e-7) pivot(artificial, i, largest);
  }
  for (std::size_t k = 0; k < n; ++k) cost[k] = -c[k];
  for (std::size_t i = 0; i < m; ++i)
    if (basis[i] < n) {
      const double f = cost[basis[i]];
      for (std::size_t k = 0; k <= end; ++k) cost[k] -= f * rows[i][k];
    }
  if (!optimise(cost, n)) return std::numeric_limits<double>::infinity();
  return cost[end];
}

/// How large a proportional load may become before no forces without tension and within Coulomb's
/// limit balance every block.
///
/// The lower bound of limit analysis, which is the exact answer where nothing slides, and an upper
/// bound of what stands where friction lets go (it dilates as it slips, here and not in rock).
/// Every joint has a force within the cone of friction at each of its two ends: N >= 0, |M| <=
/// N L / 2 and |T| <= mu N are the same. Source: Livesley (1978), Limit analysis of structures
/// formed from rigid blocks.
/// @param push  proportional load of every block, beside weight and dead loads [N], [N m]
/// @return  factor on `push`, >= 0; nothing if the blocks do not stand without it
[[nodiscard]] inline std::optional<double> limit_factor(const LaidProblem& problem, double mu,
                                                        const std::vector<Load2>& push) {
  using voussoir::Vec2;
  const std::vector<FlatJoint> joints = joints_of(problem);
  const std::size_t unknowns = 4 * joints.size() + 1;
  std::vector<int> first_row(problem.blocks.size(), -1);
  std::vector<std::vector<double>> rows;
  double scale = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) scale += problem.weight(b);
  scale /= static_cast<double>(problem.blocks.size());
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    if (problem.is_fixed(b)) continue;
    first_row[b] = static_cast<int>(rows.size());
    const Load2 dead = problem.dead_load(b);
    const double given[] = {dead.force.x(), dead.force.y(), dead.moment[0]};
    const double more[] = {push[b].force.x(), push[b].force.y(), push[b].moment[0]};
    for (int k = 0; k < 3; ++k) {
      rows.emplace_back(unknowns + 1, 0.0);
      rows.back()[unknowns - 1] = more[k] / scale;
      rows.back()[unknowns] = -given[k] / scale;
    }
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const FlatJoint& joint = joints[j];
    const Vec2 along = (joint.q - joint.p).normalized();
    for (int end = 0; end < 2; ++end)
      for (int edge = 0; edge < 2; ++edge) {
        const Vec2 on_b = joint.normal + (edge == 0 ? mu : -mu) * along;
        const Vec2 place = end == 0 ? joint.p : joint.q;
        const std::size_t column = 4 * j + static_cast<std::size_t>(2 * end + edge);
        for (const bool is_b : {false, true}) {
          const auto body = static_cast<std::size_t>(is_b ? joint.b : joint.a);
          if (first_row[body] < 0) continue;
          const Vec2 f = is_b ? on_b : Vec2(-on_b), arm = place - problem.centre(body);
          const auto row = static_cast<std::size_t>(first_row[body]);
          rows[row][column] += f.x();
          rows[row + 1][column] += f.y();
          rows[row + 2][column] += arm.x() * f.y() - arm.y() * f.x();
        }
      }
  }
  std::vector<double> objective(unknowns, 0.0);
  objective.back() = 1;
  return simplex(std::move(rows), objective, unknowns - 1);
}

}  // namespace voussoir_test
