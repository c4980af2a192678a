// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/block_cholesky.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/columns_of_bodies.hpp>
#include <voussoir/linear/linear_programme.hpp>
#include <voussoir/linear/pattern_store.hpp>
#include <voussoir/linear/second_order_cone.hpp>

namespace voussoir {

/// When an interior point is close enough.
struct InteriorPointSettings {
  double gap = 1e-8;    ///< between cost and bound, over the cost or 1 [-]
  double fault = 1e-9;  ///< of rows and prices, over the largest right-hand side or cost, or 1 [-]
  /// Whether the least cost is above or below this is all that is asked; not a number: it is
  /// itself.
  double asked = std::numeric_limits<double>::quiet_NaN();
  int steps = 200;
  unsigned threads = 1;  ///< that factor; the answer does not depend on it
};

/// Solves linear programmes whose rows come Dof a body and whose columns join two bodies at most:
/// forces between blocks. Every step factors one matrix with the pattern of the stiffness of the
/// blocks.
///
/// Predictor and corrector from a start inside the bounds. Every column needs a bound below or a
/// cone, and the rows must not depend on one another.
///
/// Source: Mehrotra (1992), On the implementation of a primal-dual interior point method, SIAM J.
/// Optim. 2; bounds from above as in Wright (1997), Primal-dual interior-point methods, ch. 11;
/// cones, see second_order_cone.hpp.
/// @tparam Dof  3 in 2-D, 6 in 3-D
template <int Dof>
class InteriorPoint {
 public:
  explicit InteriorPoint(const InteriorPointSettings& settings = {}) : settings_(settings) {}

  /// @param progress  asked at every step whether to go on
  /// @return  not solved: the steps were used up, or rounding has stopped it
  /// @throws InvalidInput  rows that are no bodies, a column of three, one without a bound below, a
  ///                       cone that is no more than a line
  /// @throws Stopped
  /// @cost  20 to 50 factors: 1 s for 5 600 blocks
  [[nodiscard]] LinearSolution operator()(const LinearProgramme& programme,
                                          const Progress& progress = {}) const;

 private:
  InteriorPointSettings settings_;
  std::shared_ptr<PatternStore> patterns_ = std::make_shared<PatternStore>();
};

namespace detail {

/// One programme on its way. Unknowns x are counted from their lower bounds, where they have one; s
/// is what is left to the upper ones, z and w are the multipliers of both, y those of the rows.
template <int Dof>
class InteriorPointRun {
 public:
  InteriorPointRun(const LinearProgramme& programme, const InteriorPointSettings& settings,
                   PatternStore& patterns)
      : programme_(programme),
        settings_(settings),
        patterns_(patterns),
        a_(programme),
        count_(a_.columns.size()),
        right_(zeros(programme.rows())),
        low_(programme.lower),
        room_(count_),
        is_bounded_(count_, 1),
        is_in_cone_(count_, 0) {
    for (const FrictionCone& cone : programme.cones) add_cone(cone);
    std::sort(cones_.begin(), cones_.end(),
              [](const Cone& a, const Cone& b) { return a.first < b.first; });
    for (std::size_t j = 0; j < count_; ++j) {
      room_[j] = programme.upper[j] - low_[j];
      if (!std::isfinite(low_[j]) || !(room_[j] > 0))
        throw InvalidInput(
            "interior point: a column must have a bound below or a cone, and room above it");
      if (is_bounded_[j]) bounds_ += has_end(j) ? 2 : 1;
      largest_cost_ = std::max(largest_cost_, std::abs(programme.cost[j]));
      cost_at_low_ += programme.cost[j] * low_[j];
    }
    bounds_ += static_cast<double>(cones_.size());
    a_.add_product(low_, right_);
    for (Eigen::Index i = 0; i < right_.size(); ++i) {
      right_[i] = programme.right[static_cast<std::size_t>(i)] - right_[i];
      largest_right_ = std::max(largest_right_, std::abs(right_[i]));
    }
    for (Numbers* numbers :
         {&s_, &w_, &reduced_, &weight_, &to_low_, &to_high_, &pull_, &step_, &dx_, &dz_, &dw_})
      numbers->assign(count_, 0.0);
  }

  /// The shortest x that satisfies the rows, moved inside its bounds; multipliers that are the
  /// cost's, and a little.
  void start() {
    y_ = right_;
    factor_of(Numbers(count_, 1.0)).solve_in_place(y_);
    x_.resize(count_);
    double least = 0;
    for (std::size_t j = 0; j < count_; ++j) {
      x_[j] = a_.price(j, y_);
      least = std::min(least, x_[j]);
    }
    const double shift = std::max(1.0, -1.5 * least);
    y_ = zeros(right_.size());
    z_.resize(count_);
    for (std::size_t j = 0; j < count_; ++j)
      if (is_bounded_[j]) x_[j] = std::min(x_[j] + shift, 0.5 * room_[j]);
    for (Cone& cone : cones_) {
      const Vec3 s = cone.value(x_);
      const double across = std::hypot(s[1], s[2]), inside = std::min(1.0, 0.5 * s[0] / across);
      for (const std::size_t j : {cone.first + 1, cone.first + 2})
        x_[j] = across > 0 ? inside * x_[j] : 0.0;
      cone.s = cone.value(x_);
      cone.z = 0.1 * largest_cost_ * second_order_cone::unit();
    }
    let_single_entries_satisfy_rows();
    for (std::size_t j = 0; j < count_; ++j) {
      if (!is_bounded_[j]) continue;
      z_[j] = std::max(programme_.cost[j], 0.0) + 0.1 * largest_cost_;
      if (!has_end(j)) continue;
      s_[j] = room_[j] - x_[j];
      w_[j] = z_[j] * x_[j] / s_[j];
    }
  }

  /// Measures what is missing. @return  whether that is little enough
  [[nodiscard]] bool has_arrived() {
    rows_ = zeros(right_.size());
    a_.add_product(x_, rows_);
    set_to_sum(rows_, right_, -1, Eigen::VectorXd(rows_));
    cost_ = 0;
    mean_ = 0;
    // What the multipliers of the rows prove alone, and those of the bounds with them.
    double proved = dot_product(right_, y_), bound = proved, worst_price = 0;
    for (std::size_t j = 0; j < count_; ++j) pull_[j] = programme_.cost[j] - a_.price(j, y_);
    reduced_ = pull_;
    for (Cone& cone : cones_) {
      const std::size_t j = cone.first;
      const double across = std::hypot(pull_[j + 1], pull_[j + 2]);
      proved -= across * cone.offset;
      pull_[j] -= across * cone.slope;  // the cheapest that the three come to, by the first
      pull_[j + 1] = pull_[j + 2] = 0;
      cone.s = cone.value(x_);
      cone.subtract_transposed(cone.z, reduced_);
      mean_ += dot_product(cone.s, cone.z);
      bound -= cone.offset * cone.z[0];
    }
    for (std::size_t j = 0; j < count_; ++j) {
      reduced_[j] = reduced_[j] - z_[j] + w_[j];
      worst_price = std::max(worst_price, std::abs(reduced_[j]));
      cost_ += programme_.cost[j] * x_[j];
      mean_ += x_[j] * z_[j];
      if (pull_[j] < 0) proved += pull_[j] * room_[j];
      if (!has_end(j)) continue;
      mean_ += s_[j] * w_[j];
      bound -= room_[j] * w_[j];
    }
    mean_ /= bounds_;
    double worst_row = 0;
    for (Eigen::Index i = 0; i < rows_.size(); ++i)
      worst_row = std::max(worst_row, std::abs(rows_[i]));
    const bool has_rows = worst_row <= settings_.fault * largest_right_;
    return (has_rows && worst_price <= settings_.fault * largest_cost_ &&
            std::abs(cost_ - bound) <= settings_.gap * std::max(1.0, std::abs(cost_))) ||
           (has_rows && cost_ + cost_at_low_ <= settings_.asked) ||
           proved + cost_at_low_ > settings_.asked;
  }

  void advance() {
    for (std::size_t j = 0; j < count_; ++j)
      weight_[j] = is_bounded_[j] ? 1 / (z_[j] / x_[j] + (has_end(j) ? w_[j] / s_[j] : 0.0)) : 0.0;
    for (Cone& cone : cones_) cone.scale(weight_[cone.first]);
    const BlockCholesky<Dof> factor = factor_of(weight_);
    for (std::size_t j = 0; j < count_; ++j) {
      to_low_[j] = -x_[j] * z_[j];
      to_high_[j] = -s_[j] * w_[j];
    }
    for (Cone& cone : cones_) cone.aim = -cone.both;
    aim(factor);
    auto [primal, dual] = lengths();
    primal = std::min(1.0, primal);
    dual = std::min(1.0, dual);
    double ahead = 0;
    for (std::size_t j = 0; j < count_; ++j) {
      ahead += (x_[j] + primal * dx_[j]) * (z_[j] + dual * dz_[j]);
      if (has_end(j)) ahead += (s_[j] - primal * dx_[j]) * (w_[j] + dual * dw_[j]);
    }
    for (const Cone& cone : cones_)
      ahead += dot_product(cone.s + primal * cone.ds, cone.z + dual * cone.dz);
    const double part = ahead / bounds_ / mean_;
    // No closer to the bounds than the gap asks for: beyond, rounding eats the rows.
    const double centre = std::max(part * part * part * mean_,
                                   0.1 * settings_.gap * std::max(1.0, std::abs(cost_)) / bounds_);
    for (std::size_t j = 0; j < count_; ++j) {
      to_low_[j] = centre - x_[j] * z_[j] - dx_[j] * dz_[j];
      if (has_end(j)) to_high_[j] = centre - s_[j] * w_[j] + dx_[j] * dw_[j];
    }
    for (Cone& cone : cones_) cone.aim_at(centre);
    aim(factor);
    std::tie(primal, dual) = lengths();
    // Of the way to the nearest bound. Cones want to be kept away from their edges, where digits
    // are lost.
    const double keep = cones_.empty() ? 0.9995 : 0.95;
    primal = std::min(1.0, keep * primal);
    dual = std::min(1.0, keep * dual);
    for (std::size_t j = 0; j < count_; ++j) {
      x_[j] += primal * dx_[j];
      z_[j] += dual * dz_[j];
      if (!has_end(j)) continue;
      s_[j] -= primal * dx_[j];
      w_[j] += dual * dw_[j];
    }
    for (Cone& cone : cones_) cone.z += dual * cone.dz;
    set_to_sum(y_, Eigen::VectorXd(y_), dual, dy_);
  }

  [[nodiscard]] bool is_sound() const { return std::isfinite(mean_) && std::isfinite(cost_); }
  void write(LinearSolution& solution) const {
    solution.unknowns.resize(count_);
    for (std::size_t j = 0; j < count_; ++j) solution.unknowns[j] = low_[j] + x_[j];
    solution.multipliers.assign(y_.data(), y_.data() + y_.size());
  }

 private:
  using Numbers = std::vector<double>;

  using Cone = second_order_cone::Unknowns;

  void add_cone(const FrictionCone& cone) {
    const auto j = static_cast<std::size_t>(cone.first);
    if (cone.first < 0 || j + 3 > count_ || !(cone.slope >= 0))
      throw InvalidInput("interior point: a cone must be of three columns, with a slope >= 0");
    for (const std::size_t across : {j + 1, j + 2}) {
      if (std::isfinite(programme_.lower[across]) || std::isfinite(programme_.upper[across]))
        throw InvalidInput("interior point: the last two columns of a cone must have no bounds");
      low_[across] = 0;
      is_bounded_[across] = 0;
    }
    for (const std::size_t in : {j, j + 1, j + 2}) {
      if (is_in_cone_[in] || a_.columns[in].a != a_.columns[j].a ||
          a_.columns[in].b != a_.columns[j].b)
        throw InvalidInput(
            "interior point: columns of a cone must be of the same two bodies, each in one cone");
      is_in_cone_[in] = 1;
    }
    double offset = cone.offset + cone.slope * low_[j];
    if (std::abs(offset) <= 1e-14 * std::abs(cone.offset)) offset = 0;  // but for rounding
    cones_.push_back({j, cone.slope, offset});
    if (!(cones_.back().offset >= 0) || !(cones_.back().offset > 0 || cone.slope > 0))
      throw InvalidInput("interior point: a cone must be more than a line, and its axis in it");
  }

  [[nodiscard]] bool has_end(std::size_t j) const { return std::isfinite(room_[j]); }

  [[nodiscard]] BlockCholesky<Dof> factor_of(const Numbers& weights) {
    BlockMatrix<Dof> matrix = a_.normal_matrix(weights, cones_);
    if (!pattern_) pattern_ = patterns_.pattern(Dof, a_.bodies, matrix.pairs());
    try {
      return BlockCholesky<Dof>(matrix, pattern_, {}, settings_.threads);
    } catch (const FreeBody&) {
      // Where the unknowns that are free of bounds do not bear in all directions, rounding has left
      // nothing of the others: a trace makes up for it, most of which the second solve takes off.
      for (int body = 0; body < matrix.size(); ++body) {
        Fixed<Dof, Dof> trace = zeros<Fixed<Dof, Dof>>();
        for (int d = 0; d < Dof; ++d) trace(d, d) = 1e-12 * matrix.diagonal(body)(d, d);
        matrix.add(body, trace);
      }
      return BlockCholesky<Dof>(matrix, pattern_, {}, settings_.threads);
    }
  }

  /// Columns of one entry take what the start leaves of their rows, as far as they can: rows that
  /// are satisfied stay so.
  void let_single_entries_satisfy_rows() {
    rows_ = zeros(right_.size());
    a_.add_product(x_, rows_);
    for (std::size_t j = 0; j < count_; ++j) {
      const auto first = static_cast<std::size_t>(programme_.start[j]);
      if (is_in_cone_[j] || programme_.start[j + 1] != programme_.start[j] + 1) continue;
      const double entry = programme_.entry[first];
      double& sum = rows_[programme_.row[first]];
      const double left = (right_[programme_.row[first]] - sum) / entry;
      if (!(left > 0)) continue;
      const double more = std::min(left, has_end(j) ? 0.9 * (room_[j] - x_[j]) : left);
      x_[j] += more;
      sum += entry * more;
    }
  }

  /// The step that brings products of unknowns and multipliers to where they shall be.
  void aim(const BlockCholesky<Dof>& factor) {
    for (std::size_t j = 0; j < count_; ++j)
      pull_[j] = (is_bounded_[j] ? to_low_[j] / x_[j] : 0.0) - reduced_[j] -
                 (has_end(j) ? to_high_[j] / s_[j] : 0.0);
    for (const Cone& cone : cones_) cone.subtract_transposed(-cone.w.over(cone.aim), pull_);
    dx_ = pull_;
    multiply_by_weights(dx_);
    dy_ = zeros(right_.size());
    // Weights far apart cost digits of the rows, which a second solve and a third bring back.
    for (int solve = 0; solve < 3; ++solve) {
      for (std::size_t j = 0; j < count_; ++j) step_[j] = -dx_[j];
      Eigen::VectorXd left = rows_;
      a_.add_product(step_, left);
      factor.solve_in_place(left);
      add_to(dy_, left);
      for (std::size_t j = 0; j < count_; ++j) step_[j] = a_.price(j, left);
      multiply_by_weights(step_);
      for (std::size_t j = 0; j < count_; ++j) dx_[j] += step_[j];
    }
    // From here on what multipliers of bounds and cones must take.
    for (std::size_t j = 0; j < count_; ++j) pull_[j] = reduced_[j] - a_.price(j, dy_);
    for (std::size_t j = 0; j < count_; ++j) {
      dz_[j] = is_bounded_[j] ? (to_low_[j] - z_[j] * dx_[j]) / x_[j] : 0.0;
      dw_[j] = has_end(j) ? (to_high_[j] + w_[j] * dx_[j]) / s_[j] : 0.0;
    }
    for (Cone& cone : cones_) {
      const std::size_t j = cone.first;
      cone.ds = cone.change(dx_);
      cone.dz = cone.w.over(cone.aim - cone.w.over(cone.ds));
      // At its edge W has lost the digits by which prices are kept.
      cone.dz[1] = pull_[j + 1];
      cone.dz[2] = pull_[j + 2];
      if (cone.slope > 0) cone.dz[0] = (pull_[j] - dz_[j] + dw_[j]) / cone.slope;
    }
  }

  void multiply_by_weights(Numbers& v) const {
    // Of columns in a cone they are left as they are, for the weight of all three.
    for (std::size_t j = 0; j < count_; ++j)
      if (!is_in_cone_[j]) v[j] *= weight_[j];
    for (const Cone& cone : cones_) cone.multiply_by_weight(v);
  }

  /// How far unknowns and multipliers can go until the first is at its bound, in steps.
  [[nodiscard]] std::pair<double, double> lengths() const {
    double primal = std::numeric_limits<double>::max(), dual = primal;
    for (std::size_t j = 0; j < count_; ++j) {
      if (!is_bounded_[j]) continue;
      if (dx_[j] < 0) primal = std::min(primal, -x_[j] / dx_[j]);
      if (dz_[j] < 0) dual = std::min(dual, -z_[j] / dz_[j]);
      if (!has_end(j)) continue;
      if (dx_[j] > 0) primal = std::min(primal, s_[j] / dx_[j]);
      if (dw_[j] < 0) dual = std::min(dual, -w_[j] / dw_[j]);
    }
    for (const Cone& cone : cones_) {
      primal = std::min(primal, second_order_cone::steps_to_edge(cone.s, cone.ds));
      dual = std::min(dual, second_order_cone::steps_to_edge(cone.z, cone.dz));
    }
    return {primal, dual};
  }

  const LinearProgramme& programme_;
  const InteriorPointSettings& settings_;
  PatternStore& patterns_;
  ColumnsOfBodies<Dof> a_;
  std::size_t count_;
  Eigen::VectorXd right_, y_, rows_, dy_;
  Numbers low_, room_;
  std::vector<char> is_bounded_, is_in_cone_;
  std::vector<Cone> cones_;
  Numbers x_, s_, z_, w_;
  Numbers reduced_, weight_, to_low_, to_high_, pull_, step_, dx_, dz_, dw_;
  std::shared_ptr<const CholeskyPattern> pattern_;
  double bounds_ = 0, cost_at_low_ = 0, largest_cost_ = 1, largest_right_ = 1, cost_ = 0, mean_ = 0;
};

}  // namespace detail

template <int Dof>
LinearSolution InteriorPoint<Dof>::operator()(const LinearProgramme& programme,
                                              const Progress& progress) const {
  detail::InteriorPointRun<Dof> run(programme, settings_, *patterns_);
  LinearSolution solution;
  try {
    run.start();
    for (;; ++solution.steps) {
      if (progress && !progress(static_cast<double>(solution.steps) / settings_.steps))
        throw Stopped();
      solution.is_solved = run.has_arrived();
      if (solution.is_solved || solution.steps >= settings_.steps || !run.is_sound()) break;
      run.advance();
    }
  } catch (const FreeBody&) {  // rounding has left a matrix that is not positive definite
    solution.is_solved = false;
  }
  run.write(solution);
  return solution;
}

}  // namespace voussoir
