// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

/// Linear programmes as plain arrays, for any solver of them, and a check of what one answers.
namespace voussoir {

/// Of the unknowns first, first + 1 and first + 2: the length of the last two is at most
/// slope x[first] + offset. Forces N, T1 and T2 with friction, in 3-D.
struct FrictionCone {
  int first;
  double slope;       ///< >= 0
  double offset = 0;  ///< with the slope > 0 where x[first] is, so that some are inside
};

/// Least cost . x over A x = right, lower <= x <= upper, and in the cones, if there are any: it is
/// linear but for them.
struct LinearProgramme {
  /// A by columns: those of column j are entries start[j], ..., start[j + 1] - 1.
  std::vector<int> start{0}, row;
  std::vector<double> entry;
  std::vector<double> cost, lower, upper;  ///< one a column; bounds may be infinite
  std::vector<double> right;               ///< one a row
  std::vector<FrictionCone> cones;         ///< no unknown is in two

  [[nodiscard]] int rows() const { return static_cast<int>(right.size()); }
  [[nodiscard]] int columns() const { return static_cast<int>(cost.size()); }

  /// Adds one entry of the column that `close_column` will end. Zeros are kept: the pattern of a
  /// programme does not hang on its numbers.
  void add(int in_row, double value) {
    row.push_back(in_row);
    entry.push_back(value);
  }
  void close_column(double price, double least, double most) {
    start.push_back(static_cast<int>(row.size()));
    cost.push_back(price);
    lower.push_back(least);
    upper.push_back(most);
  }
};

/// What a solver says of a programme.
struct LinearSolution {
  bool is_solved = false;  ///< it claims the least cost
  int steps = 0;
  std::vector<double> unknowns;     ///< x
  std::vector<double> multipliers;  ///< of the rows: least cost gained per unit of `right`
};

/// Any solver; it may keep what it knows from call to call.
using LinearSolver = std::function<LinearSolution(const LinearProgramme& programme)>;

/// How far an answer is from proving itself, found without the solver that gave it.
struct LinearProof {
  double cost = 0;         ///< of x
  double bound = 0;        ///< from below, by the multipliers alone, but for `price_fault`
  double row_fault = 0;    ///< largest |A x - right|
  double bound_fault = 0;  ///< by which x leaves its bounds and cones
  double price_fault = 0;  ///< largest reduced cost that points to an infinite bound

  [[nodiscard]] double gap() const { return cost - bound; }
  [[nodiscard]] double worst() const {
    return std::max(
        {row_fault, bound_fault, price_fault, std::abs(gap()) / std::max(1.0, std::abs(cost))});
  }
};

/// Weak duality: cost . x >= right . y + sum of the least that each reduced cost r = cost - A' y
/// can come to within the bounds of its unknown, three of them together in a cone.
/// @cost  one pass over the entries
[[nodiscard]] inline LinearProof proof_of(const LinearProgramme& programme,
                                          const LinearSolution& solution) {
  LinearProof proof;
  std::vector<double> left(programme.right.size(), 0.0), of_price(programme.cost);
  for (std::size_t i = 0; i < programme.right.size(); ++i)
    proof.bound += programme.right[i] * solution.multipliers[i];
  for (std::size_t j = 0; j < programme.cost.size(); ++j) {
    const double x = solution.unknowns[j], low = programme.lower[j], high = programme.upper[j];
    for (auto k = static_cast<std::size_t>(programme.start[j]);
         k < static_cast<std::size_t>(programme.start[j + 1]); ++k) {
      const auto i = static_cast<std::size_t>(programme.row[k]);
      of_price[j] -= programme.entry[k] * solution.multipliers[i];
      left[i] += programme.entry[k] * x;
    }
    proof.cost += programme.cost[j] * x;
    proof.bound_fault = std::max({proof.bound_fault, low - x, x - high});
  }
  // The cheapest last two unknowns of a cone point against their prices, as far as the first lets
  // them: its own price is lower by so much.
  for (const FrictionCone& cone : programme.cones) {
    const auto j = static_cast<std::size_t>(cone.first);
    const std::vector<double>& x = solution.unknowns;
    proof.bound_fault = std::max(proof.bound_fault,
                                 std::hypot(x[j + 1], x[j + 2]) - cone.slope * x[j] - cone.offset);
    const double across = std::hypot(of_price[j + 1], of_price[j + 2]);
    proof.bound -= across * cone.offset;
    of_price[j] -= across * cone.slope;
    of_price[j + 1] = of_price[j + 2] = 0;
  }
  for (std::size_t j = 0; j < of_price.size(); ++j) {
    const double reduced = of_price[j], at = reduced > 0 ? programme.lower[j] : programme.upper[j];
    if (std::isfinite(at))
      proof.bound += reduced * at;
    else
      proof.price_fault = std::max(proof.price_fault, std::abs(reduced));
  }
  for (std::size_t i = 0; i < left.size(); ++i)
    proof.row_fault = std::max(proof.row_fault, std::abs(left[i] - programme.right[i]));
  return proof;
}

}  // namespace voussoir
