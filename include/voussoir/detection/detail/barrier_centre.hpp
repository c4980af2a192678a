// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/plane_pair.hpp>

namespace voussoir::detail {

/// One step of Newton's method towards the analytic centre: the least of -sum log(room_i).
///
/// With rows J_i = normal_i / room_i the step p solves the least squares problem J p = -1. It is
/// solved by orthogonal columns (modified Gram-Schmidt), not through the Hessian J^T J: in an
/// overlap 1e-9 m thick and 1 m long the Hessian has condition 1e18 and loses the long direction.
/// The fit v = J p says by which fraction each room shrinks; its length is the Newton decrement.
template <int Dim>
class BarrierStep {
 public:
  using Lanes = typename PlanePair<Dim>::Lanes;

  /// A group of rows of J.
  struct Rows {
    std::array<Lanes, Dim> column;  ///< made orthogonal
    Lanes fit;                      ///< v
  };

  /// @param rows  working memory: one for each group of planes
  BarrierStep(const PlanePair<Dim>& planes, std::span<Rows> rows) : rows_(rows) {
    for (std::size_t g = 0; g < rows_.size(); ++g) {
      const Lanes inverse = Lanes::all(1) / planes.room(g * lane_count);
      for (int axis = 0; axis < Dim; ++axis)
        rows_[g].column[static_cast<std::size_t>(axis)] =
            planes.normal(axis, g * lane_count) * inverse;
      rows_[g].fit = Lanes::all(0);
    }
    for (std::size_t d = 0; d < size; ++d) {
      std::array<Lanes, size> products;
      products.fill(Lanes::all(0));
      Lanes left = Lanes::all(0);
      for (std::size_t g = 0; g < rows_.size(); ++g) {
        const Rows& row = rows_[g];
        for (std::size_t e = d; e < size; ++e)
          products[e] = products[e] + row.column[d] * row.column[e];
        left = left + row.column[d] * (Lanes::all(1) + row.fit);
      }
      const double squared = products[d].sum();
      inverse_squared_[d] = 1 / squared;
      share_[d] = -left.sum() * inverse_squared_[d];
      decrement_squared_ += share_[d] * share_[d] * squared;
      for (std::size_t e = d + 1; e < size; ++e)
        upper_[d][e] = products[e].sum() * inverse_squared_[d];
      for (std::size_t g = 0; g < rows_.size(); ++g) {
        Rows& row = rows_[g];
        for (std::size_t e = d + 1; e < size; ++e)
          row.column[e] = row.column[e] - Lanes::all(upper_[d][e]) * row.column[d];
        row.fit = row.fit + Lanes::all(share_[d]) * row.column[d];
      }
    }
  }

  [[nodiscard]] double decrement_squared() const { return decrement_squared_; }

  /// The correction of third order (Chebyshev): adds what solves J^T J q = -J^T v^2.
  void correct() {
    std::array<Lanes, size> products;
    products.fill(Lanes::all(0));
    for (std::size_t g = 0; g < rows_.size(); ++g)
      for (std::size_t d = 0; d < size; ++d)
        products[d] = products[d] + rows_[g].column[d] * (rows_[g].fit * rows_[g].fit);
    for (std::size_t d = 0; d < size; ++d) {
      const double share = -products[d].sum() * inverse_squared_[d];
      share_[d] += share;
      for (std::size_t g = 0; g < rows_.size(); ++g)
        rows_[g].fit = rows_[g].fit + Lanes::all(share) * rows_[g].column[d];
    }
  }

  /// Shortens or lengthens the step to where the barrier is about least along it.
  ///
  /// 1 / (1 + max v) is short enough to go down (self-concordance) and 1 / max v leaves the half
  /// spaces; the slope sum v_i / (1 - t v_i) says in which half the least lies. From one end of a
  /// long overlap, where the linear program leaves its point, full steps only double the distance.
  void search_along() {
    Lanes fastest = rows_[0].fit;
    for (std::size_t g = 1; g < rows_.size(); ++g) fastest = max(fastest, rows_[g].fit);
    const double limit = fastest.largest();
    double low = 1 / (1 + limit), high = 1 / limit;
    for (int halving = 0; halving < 6 && high > 4 * low; ++halving) {
      const double middle = 0.5 * (low + high);
      Lanes slope = Lanes::all(0);
      for (std::size_t g = 0; g < rows_.size(); ++g)
        slope = slope + rows_[g].fit / (Lanes::all(1) - Lanes::all(middle) * rows_[g].fit);
      (slope.sum() < 0 ? low : high) = middle;
    }
    for (std::size_t g = 0; g < rows_.size(); ++g) rows_[g].fit = rows_[g].fit * Lanes::all(low);
    for (double& share : share_) share *= low;
  }

  /// Moves the point from which the planes are seen.
  void take(PlanePair<Dim>& planes) const {
    for (std::size_t g = 0; g < rows_.size(); ++g) planes.shrink_room(g * lane_count, rows_[g].fit);
    Vec<Dim> step;
    for (std::size_t d = size; d-- > 0;) {
      double value = share_[d];
      for (std::size_t e = d + 1; e < size; ++e)
        value -= upper_[d][e] * step[static_cast<Eigen::Index>(e)];
      step[static_cast<Eigen::Index>(d)] = value;
    }
    planes.move_point(step);
  }

 private:
  static constexpr auto size = static_cast<std::size_t>(Dim);

  std::span<Rows> rows_;
  std::array<std::array<double, size>, size> upper_;  ///< J = columns upper, diagonal 1
  std::array<double, size> inverse_squared_;          ///< of the lengths of the columns
  std::array<double, size> share_;                    ///< p = upper^-1 share
  double decrement_squared_ = 0;
};

/// Newton's method for the analytic centre of the half spaces of a pair.
template <int Dim>
class BarrierCentre {
 public:
  /// Moves the point from which `planes` are seen, inside all of them, to their analytic centre.
  void move_to_centre(PlanePair<Dim>& planes) {
    rows_.resize(std::max(rows_.size(), planes.padded_count() / lane_count));
    const std::span rows(rows_.data(), planes.padded_count() / lane_count);
    // 3 steps are usual, 20 the most seen of overlaps down to 1e-12 m; one that is no more than a
    // rounding need not settle at all.
    for (int count = 0; count < 40; ++count) {
      BarrierStep<Dim> step(planes, rows);
      // Where squares of rooms leave the range of numbers it is as good as it gets.
      if (!(step.decrement_squared() < std::numeric_limits<double>::infinity())) return;
      if (step.decrement_squared() < near)
        step.correct();
      else
        step.search_along();
      step.take(planes);
      if (step.decrement_squared() < last) return;
    }
  }

 private:
  /// Decrement squared below which full steps with correction converge at once.
  static constexpr double near = 0.1;
  /// ... and below which one more such step leaves 1e-13 of the rooms, its cube.
  static constexpr double last = 1e-9;

  std::vector<typename BarrierStep<Dim>::Rows> rows_;
};

}  // namespace voussoir::detail
