// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
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
#include <voussoir/linear/linear_programme.hpp>
#include <voussoir/linear/pattern_store.hpp>

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
/// Predictor and corrector from a start inside the bounds. Every column needs a bound below, and
/// the rows must not depend on one another.
///
/// Source: Mehrotra (1992), On the implementation of a primal-dual interior point method, SIAM J.
/// Optim. 2; bounds from above as in Wright (1997), Primal-dual interior-point methods, ch. 11.
/// @tparam Dof  3 in 2-D
template <int Dof>
class InteriorPoint {
 public:
  explicit InteriorPoint(const InteriorPointSettings& settings = {}) : settings_(settings) {}

  /// @param progress  asked at every step whether to go on
  /// @return  not solved: the steps were used up, or rounding has stopped it
  /// @throws InvalidInput  rows that are no bodies, a column of three, or one without a bound below
  /// @throws Stopped
  /// @cost  20 to 50 factors: 1 s for 5 600 blocks
  [[nodiscard]] LinearSolution operator()(const LinearProgramme& programme,
                                          const Progress& progress = {}) const;

 private:
  InteriorPointSettings settings_;
  std::shared_ptr<PatternStore> patterns_ = std::make_shared<PatternStore>();
};

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
  /// A diag(weights) A'
  [[nodiscard]] BlockMatrix<Dof> normal_matrix(const std::vector<double>& weights) const {
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
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const Column& c = columns[j];
      matrix.add(c.a, outer_at(c, 0, 0, weights[j]));
      if (c.b < 0) continue;
      matrix.add(c.b, outer_at(c, Dof, Dof, weights[j]));
      across[static_cast<std::size_t>(c.pair)] += outer_at(c, 0, Dof, weights[j]);
    }
    for (std::size_t k = 0; k < pairs.size(); ++k)
      matrix.add(pairs[k].first, pairs[k].second, across[k]);
    matrix.compress();
    return matrix;
  }
};

/// One programme on its way. Unknowns x are counted from their lower bounds; s is what is left to
/// the upper ones, z and w are the multipliers of both, y those of the rows.
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
        room_(count_) {
    for (std::size_t j = 0; j < count_; ++j) {
      room_[j] = programme.upper[j] - programme.lower[j];
      if (!std::isfinite(programme.lower[j]) || !(room_[j] > 0))
        throw InvalidInput("interior point: a column must have a bound below, and room above it");
      bounds_ += has_end(j) ? 2 : 1;
      largest_cost_ = std::max(largest_cost_, std::abs(programme.cost[j]));
      cost_at_low_ += programme.cost[j] * programme.lower[j];
    }
    a_.add_product(programme.lower, right_);
    for (Eigen::Index i = 0; i < right_.size(); ++i) {
      right_[i] = programme.right[static_cast<std::size_t>(i)] - right_[i];
      largest_right_ = std::max(largest_right_, std::abs(right_[i]));
    }
    for (Numbers* numbers :
         {&s_, &w_, &reduced_, &weight_, &to_low_, &to_high_, &pull_, &dx_, &dz_, &dw_})
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
    for (std::size_t j = 0; j < count_; ++j) x_[j] = std::min(x_[j] + shift, 0.5 * room_[j]);
    let_single_entries_satisfy_rows();
    for (std::size_t j = 0; j < count_; ++j) {
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
    for (std::size_t j = 0; j < count_; ++j) {
      const double reduced = programme_.cost[j] - a_.price(j, y_);
      reduced_[j] = reduced - z_[j] + w_[j];
      worst_price = std::max(worst_price, std::abs(reduced_[j]));
      cost_ += programme_.cost[j] * x_[j];
      mean_ += x_[j] * z_[j];
      if (reduced < 0) proved += reduced * room_[j];
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
      weight_[j] = 1 / (z_[j] / x_[j] + (has_end(j) ? w_[j] / s_[j] : 0.0));
    const BlockCholesky<Dof> factor = factor_of(weight_);
    for (std::size_t j = 0; j < count_; ++j) {
      to_low_[j] = -x_[j] * z_[j];
      to_high_[j] = -s_[j] * w_[j];
    }
    aim(factor);
    auto [primal, dual] = lengths();
    primal = std::min(1.0, primal);
    dual = std::min(1.0, dual);
    double ahead = 0;
    for (std::size_t j = 0; j < count_; ++j) {
      ahead += (x_[j] + primal * dx_[j]) * (z_[j] + dual * dz_[j]);
      if (has_end(j)) ahead += (s_[j] - primal * dx_[j]) * (w_[j] + dual * dw_[j]);
    }
    const double part = ahead / bounds_ / mean_;
    // No closer to the bounds than the gap asks for: beyond, rounding eats the rows.
    const double centre = std::max(part * part * part * mean_,
                                   0.1 * settings_.gap * std::max(1.0, std::abs(cost_)) / bounds_);
    for (std::size_t j = 0; j < count_; ++j) {
      to_low_[j] = centre - x_[j] * z_[j] - dx_[j] * dz_[j];
      if (has_end(j)) to_high_[j] = centre - s_[j] * w_[j] + dx_[j] * dw_[j];
    }
    aim(factor);
    std::tie(primal, dual) = lengths();
    constexpr double keep = 0.9995;  // of the way to the nearest bound
    primal = std::min(1.0, keep * primal);
    dual = std::min(1.0, keep * dual);
    for (std::size_t j = 0; j < count_; ++j) {
      x_[j] += primal * dx_[j];
      z_[j] += dual * dz_[j];
      if (!has_end(j)) continue;
      s_[j] -= primal * dx_[j];
      w_[j] += dual * dw_[j];
    }
    set_to_sum(y_, Eigen::VectorXd(y_), dual, dy_);
  }

  [[nodiscard]] bool is_sound() const { return std::isfinite(mean_) && std::isfinite(cost_); }
  void write(LinearSolution& solution) const {
    solution.unknowns.resize(count_);
    for (std::size_t j = 0; j < count_; ++j) solution.unknowns[j] = programme_.lower[j] + x_[j];
    solution.multipliers.assign(y_.data(), y_.data() + y_.size());
  }

 private:
  using Numbers = std::vector<double>;

  [[nodiscard]] bool has_end(std::size_t j) const { return std::isfinite(room_[j]); }

  [[nodiscard]] BlockCholesky<Dof> factor_of(const Numbers& weights) {
    BlockMatrix<Dof> matrix = a_.normal_matrix(weights);
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
      if (programme_.start[j + 1] != programme_.start[j] + 1) continue;
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
    for (std::size_t j = 0; j < count_; ++j) {
      pull_[j] = to_low_[j] / x_[j] - reduced_[j] - (has_end(j) ? to_high_[j] / s_[j] : 0.0);
      dx_[j] = -weight_[j] * pull_[j];
    }
    dy_ = rows_;
    a_.add_product(dx_, dy_);
    Eigen::VectorXd left = dy_;
    factor.solve_in_place(dy_);
    // Weights far apart cost digits, which a second solve brings back.
    for (std::size_t j = 0; j < count_; ++j) dx_[j] = -weight_[j] * a_.price(j, dy_);
    a_.add_product(dx_, left);
    factor.solve_in_place(left);
    add_to(dy_, left);
    for (std::size_t j = 0; j < count_; ++j) {
      dx_[j] = weight_[j] * (a_.price(j, dy_) + pull_[j]);
      dz_[j] = (to_low_[j] - z_[j] * dx_[j]) / x_[j];
      dw_[j] = has_end(j) ? (to_high_[j] + w_[j] * dx_[j]) / s_[j] : 0.0;
    }
  }

  /// How far unknowns and multipliers can go until the first is at its bound, in steps.
  [[nodiscard]] std::pair<double, double> lengths() const {
    double primal = std::numeric_limits<double>::max(), dual = primal;
    for (std::size_t j = 0; j < count_; ++j) {
      if (dx_[j] < 0) primal = std::min(primal, -x_[j] / dx_[j]);
      if (dz_[j] < 0) dual = std::min(dual, -z_[j] / dz_[j]);
      if (!has_end(j)) continue;
      if (dx_[j] > 0) primal = std::min(primal, s_[j] / dx_[j]);
      if (dw_[j] < 0) dual = std::min(dual, -w_[j] / dw_[j]);
    }
    return {primal, dual};
  }

  const LinearProgramme& programme_;
  const InteriorPointSettings& settings_;
  PatternStore& patterns_;
  ColumnsOfBodies<Dof> a_;
  std::size_t count_;
  Eigen::VectorXd right_, y_, rows_, dy_;
  Numbers room_;
  Numbers x_, s_, z_, w_;
  Numbers reduced_, weight_, to_low_, to_high_, pull_, dx_, dz_, dw_;
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
