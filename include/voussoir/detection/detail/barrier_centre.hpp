// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/plane_pair.hpp>

namespace voussoir::detail {

/// Newton's method for the analytic centre of half spaces: the least of -sum log(room_i).
///
/// With rows J_i = normal_i / room_i a step p solves the least squares problem J p = -1. It is
/// solved by orthogonal columns (modified Gram-Schmidt), not through the Hessian J^T J: in an
/// overlap 1e-9 m thick and 1 m long the Hessian has condition 1e18 and loses the long direction.
/// The fit v = J p says by which fraction each room shrinks; its length is the Newton decrement.
///
/// Near the centre v^2 as a second right side gives the correction of third order (Chebyshev).
/// Away from it the step is as long as the barrier falls along it: the linear program leaves its
/// point at one end of a long overlap, from where full steps would only double the distance.
template <int Dim>
class BarrierCentre {
 public:
  /// Moves the point from which `planes` are seen, inside all of them, to their analytic centre.
  void move_to_centre(PlanePair<Dim>& planes) {
    const std::size_t groups = planes.padded_count() / lane_count;
    if (rows_.size() < groups) rows_.resize(groups);
    // 3 steps are usual, 15 the most seen in fifty million pairs; a bound, so that it always ends.
    for (int step = 0; step < 100; ++step) {
      const double decrement_squared = factor(planes, groups);
      // Rooms next to 0 or so large that their squares are not: as good as it gets.
      if (!(decrement_squared < std::numeric_limits<double>::infinity())) break;
      double length = 1;
      if (decrement_squared < near)
        correct(groups);
      else
        length = line_search(groups);
      for (std::size_t g = 0; g < groups; ++g)
        planes.shrink_room(g * lane_count, length * rows_[g].fit);
      planes.move_point(length * step_);
      if (decrement_squared < last) break;
    }
  }

 private:
  using Lanes = typename PlanePair<Dim>::Lanes;
  static constexpr auto size = static_cast<std::size_t>(Dim);
  /// Decrement squared below which full steps with correction converge at once.
  static constexpr double near = 0.1;
  /// ... and below which one more such step leaves 1e-13 of the rooms, its cube.
  static constexpr double last = 1e-9;

  struct Row {
    std::array<Lanes, size> column;  ///< J, made orthogonal
    Lanes fit;                       ///< v
  };

  [[nodiscard]] static double sum_of(const Lanes& lanes) {
    return (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]);
  }

  /// Orthogonal columns, the Newton step and its fit. Returns the decrement squared.
  double factor(const PlanePair<Dim>& planes, std::size_t groups) {
    for (std::size_t g = 0; g < groups; ++g) {
      const Lanes inverse = 1 / planes.room(g * lane_count);
      for (int axis = 0; axis < Dim; ++axis)
        rows_[g].column[static_cast<std::size_t>(axis)] =
            planes.normal(axis, g * lane_count) * inverse;
      rows_[g].fit.setZero();
    }
    std::array<double, size> share;
    double decrement_squared = 0;
    for (std::size_t d = 0; d < size; ++d) {
      std::array<Lanes, size> products;
      products.fill(Lanes::Zero());
      Lanes left = Lanes::Zero();
      for (std::size_t g = 0; g < groups; ++g) {
        const Row& row = rows_[g];
        for (std::size_t e = d; e < size; ++e) products[e] += row.column[d] * row.column[e];
        left += row.column[d] * (1 + row.fit);
      }
      const double squared = sum_of(products[d]);
      inverse_squared_[d] = 1 / squared;
      share[d] = -sum_of(left) * inverse_squared_[d];
      decrement_squared += share[d] * share[d] * squared;
      for (std::size_t e = d + 1; e < size; ++e)
        upper_[d][e] = sum_of(products[e]) * inverse_squared_[d];
      for (std::size_t g = 0; g < groups; ++g) {
        Row& row = rows_[g];
        for (std::size_t e = d + 1; e < size; ++e) row.column[e] -= upper_[d][e] * row.column[d];
        row.fit += share[d] * row.column[d];
      }
    }
    step_ = back_substituted(share);
    return decrement_squared;
  }

  /// Adds to step and fit what solves J^T J q = -J^T v^2.
  void correct(std::size_t groups) {
    std::array<Lanes, size> products;
    products.fill(Lanes::Zero());
    for (std::size_t g = 0; g < groups; ++g)
      for (std::size_t d = 0; d < size; ++d)
        products[d] += rows_[g].column[d] * rows_[g].fit.square();
    std::array<double, size> share;
    for (std::size_t d = 0; d < size; ++d) share[d] = -sum_of(products[d]) * inverse_squared_[d];
    step_ += back_substituted(share);
    for (std::size_t g = 0; g < groups; ++g)
      for (std::size_t d = 0; d < size; ++d) rows_[g].fit += share[d] * rows_[g].column[d];
  }

  /// How far to go along the step: not beyond the least of the barrier on it.
  ///
  /// 1 / (1 + max v) is short enough to go down (self-concordance) and 1 / max v leaves the half
  /// spaces; the slope sum v_i / (1 - t v_i) says in which half the least lies.
  [[nodiscard]] double line_search(std::size_t groups) const {
    Lanes fastest = rows_[0].fit;
    for (std::size_t g = 1; g < groups; ++g) fastest = fastest.max(rows_[g].fit);
    const double limit = fastest.maxCoeff();
    double low = 1 / (1 + limit), high = 1 / limit;
    if (high < 4 * low) return low;
    for (int halving = 0; halving < 6; ++halving) {
      const double middle = 0.5 * (low + high);
      Lanes slope = Lanes::Zero();
      for (std::size_t g = 0; g < groups; ++g) slope += rows_[g].fit / (1 - middle * rows_[g].fit);
      (sum_of(slope) < 0 ? low : high) = middle;
    }
    return low;
  }

  [[nodiscard]] Vec<Dim> back_substituted(const std::array<double, size>& share) const {
    Vec<Dim> x;
    for (std::size_t d = size; d-- > 0;) {
      double value = share[d];
      for (std::size_t e = d + 1; e < size; ++e)
        value -= upper_[d][e] * x[static_cast<Eigen::Index>(e)];
      x[static_cast<Eigen::Index>(d)] = value;
    }
    return x;
  }

  std::vector<Row> rows_;
  std::array<std::array<double, size>, size> upper_;
  std::array<double, size> inverse_squared_;
  Vec<Dim> step_;
};

}  // namespace voussoir::detail
