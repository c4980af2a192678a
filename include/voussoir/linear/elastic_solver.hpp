// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/memory.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/block_cholesky.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/cholesky_pattern.hpp>
#include <voussoir/linear/conjugate_gradients.hpp>
#include <voussoir/linear/detail/front_schedule.hpp>
#include <voussoir/linear/linear_method.hpp>
#include <voussoir/linear/multigrid.hpp>
#include <voussoir/linear/pattern_store.hpp>

namespace voussoir {

/// Solves K u = f for one stiffness matrix and many forces, by a factor or by iteration.
///
/// Which of them is chosen from the size, the dimension and what the factor would hold and cost.
/// Iteration that does not converge is followed by a factor, where that fits into memory; no answer
/// is returned whose estimated error is larger than was asked.
template <int Dof>
class ElasticSolver {
 public:
  using Matrix = BlockMatrix<Dof>;

  /// @param centres  of the bodies, one each
  /// @param progress  asked now and then whether to go on
  /// @param patterns  where patterns of a factor are kept and looked for; none: made anew
  /// @throws FreeBody         a body, or bodies that hold nothing but each other, are free to move
  /// @throws NotEnoughMemory  before anything large is allocated
  /// @throws Stopped
  ElasticSolver(Matrix matrix, const BodyCentres<Dof>& centres, const LinearSettings& settings = {},
                const Progress& progress = {}, std::shared_ptr<PatternStore> patterns = nullptr)
      : settings_(settings),
        matrix_(std::make_unique<const Matrix>(std::move(matrix))),
        patterns_(std::move(patterns)) {
    VOUSSOIR_ASSERT(centres.size() == static_cast<std::size_t>(matrix_->size()),
                    "every body has a centre");
    report_.bodies = matrix_->size();
    choose(progress);
    if (report_.method == LinearMethod::direct) {
      factorise(progress);
    } else {
      multigrid_.emplace(*matrix_, centres, typename Multigrid<Dof>::Params{}, progress);
      report_.memory = iterative_memory(multigrid_->complexity());
    }
  }

  /// u = K^-1 f, in place. Where a force is not finite, no displacement is a number.
  /// @return  estimate of the largest error of a translation [m]; 0: exact to rounding
  /// @throws NumericalFault  iteration did not converge, and a factor does not fit into memory (the
  ///                         message names the body that is farthest from rest) or finds the matrix
  ///                         singular (FreeBody)
  /// @throws Stopped
  double solve_in_place(Eigen::VectorXd& f, const SolveTolerance& tolerance,
                        const Progress& progress = {});

  /// f - K u of the last solve; zero if that was exact.
  [[nodiscard]] const Eigen::VectorXd& residual() const { return residual_; }

  [[nodiscard]] const LinearReport& report() const { return report_; }

 private:
  /// Nanoseconds, one thread with vectors of four numbers: for an operation of a factorisation, for
  /// a number of the factor in all solves of a search, and for a number of the matrix in all
  /// iterations of a search (bench/elastic_bench).
  static constexpr double per_operation = 0.12, per_factor_number = 17, per_matrix_number = 480;
  /// Of more bodies than these it is not asked what a factor would cost: iteration is faster, and
  /// the order alone would be a tenth of it.
  static constexpr int large = Dof == 3 ? 150000 : 4000;

  [[nodiscard]] double block_count() const {
    return static_cast<double>(matrix_->row_begin(matrix_->size())) + matrix_->size();
  }
  [[nodiscard]] double memory_limit() const {
    return settings_.memory_limit > 0 ? settings_.memory_limit : available_memory();
  }
  [[nodiscard]] double iterative_memory(double complexity) const {
    const double vectors = 24.0 * Dof * matrix_->size();
    return 8 * ((complexity - 1) * block_count() + complexity * matrix_->size()) * Dof * Dof +
           8 * vectors;
  }
  [[nodiscard]] double direct_memory() const {
    return 8 * detail::FrontSchedule(*pattern_, settings_.threads).most_numbers(*pattern_);
  }
  [[nodiscard]] static double two_digits(double value) {
    if (!(value > 0 && std::isfinite(value))) return value;
    const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
    return unit * std::round(value / unit);
  }
  [[nodiscard]] static double gigabytes(double bytes) { return two_digits(1e-9 * bytes); }

  void choose(const Progress& progress);
  void order(const Progress& progress) {
    if (!patterns_) patterns_ = std::make_shared<PatternStore>();
    pattern_ = patterns_->pattern(Dof, matrix_->size(), matrix_->pairs(), progress);
  }
  void factorise(const Progress& progress) {
    factor_.emplace(*matrix_, pattern_, progress, settings_.threads);
    report_.method = LinearMethod::direct;
    report_.memory = 8 * pattern_->stored_numbers();
    multigrid_.reset();
    matrix_.reset();
  }
  void factorise_instead(const IterationReport& failed, const Eigen::VectorXd& u,
                         const Progress& progress);
  struct Guess {
    Eigen::VectorXd u;
    double error;  ///< that it brings along [m]
  };
  [[nodiscard]] Guess guess(const Eigen::VectorXd& f, const SolveTolerance& tolerance) const;

  LinearSettings settings_;
  std::unique_ptr<const Matrix> matrix_;  ///< none once there is a factor
  std::shared_ptr<PatternStore> patterns_;
  std::shared_ptr<const CholeskyPattern> pattern_;
  std::optional<BlockCholesky<Dof>> factor_;
  std::optional<Multigrid<Dof>> multigrid_;
  Eigen::VectorXd last_, residual_;
  double last_error_ = 0;
  LinearReport report_;
};

template <int Dof>
void ElasticSolver<Dof>::choose(const Progress& progress) {
  const double limit = memory_limit();
  const bool asked = settings_.method != LinearMethod::automatic;
  report_.method = settings_.method;
  report_.reason = "as asked for";
  if (!asked && matrix_->size() > large) {
    report_.method = LinearMethod::iterative;
    report_.reason = message({"more than ", large, " bodies"});
  }
  if (report_.method != LinearMethod::iterative) {
    order(progress);
    const double need = direct_memory();
    if (asked && need > limit)
      throw NotEnoughMemory(message({"elastic solver: a factor for ", matrix_->size(),
                                     " bodies needs ", gigabytes(need), " GB of memory, of ",
                                     gigabytes(limit), " GB that it may take"}));
    const double direct = 1e-9 * (per_operation * pattern_->operations() +
                                  per_factor_number * pattern_->stored_numbers());
    const double iterative = 1e-9 * per_matrix_number * Dof * Dof * block_count();
    if (!asked) {
      const bool fits = need <= limit;
      report_.method = fits && direct <= iterative ? LinearMethod::direct : LinearMethod::iterative;
      report_.reason = !fits ? message({"a factor needs ", gigabytes(need), " GB of memory, of ",
                                        gigabytes(limit), " GB that it may take"})
                             : message({"expected to take ", two_digits(direct), " s by a factor, ",
                                        two_digits(iterative), " s by iteration"});
    }
  }
  if (report_.method == LinearMethod::iterative && iterative_memory(1.5) > limit)
    throw NotEnoughMemory(message({"elastic solver: ", matrix_->size(), " bodies need ",
                                   gigabytes(iterative_memory(1.5)), " GB of memory, of ",
                                   gigabytes(limit), " GB that it may take"}));
}

template <int Dof>
double ElasticSolver<Dof>::solve_in_place(Eigen::VectorXd& f, const SolveTolerance& tolerance,
                                          const Progress& progress) {
  VOUSSOIR_ASSERT(f.size() == Dof * static_cast<Eigen::Index>(report_.bodies),
                  "forces are those of the bodies");
  VOUSSOIR_ASSERT(factor_.has_value() != multigrid_.has_value(), "there is one method at a time");
  if (!is_finite(f)) {
    residual_ = zeros(f.size());
    f = Eigen::VectorXd::Constant(f.size(), std::numeric_limits<double>::quiet_NaN());
    return 0;
  }
  if (!factor_) {
    auto [u, error] = guess(f, tolerance);
    const SolveTolerance rest{0.5 * tolerance.relative, 0.5 * tolerance.absolute};
    const IterationReport done = conjugate_gradients<Dof>(
        *matrix_, [this](const Eigen::VectorXd& r, Eigen::VectorXd& z) { multigrid_->apply(r, z); },
        f, u, residual_, error > 0 ? rest : tolerance, settings_.max_iterations, progress);
    report_.iterations += done.iterations;
    if (done.converged) {
      VOUSSOIR_ASSERT(done.error >= 0 && error >= 0, "errors are no less than 0");
      f = u;
      last_ = std::move(u);
      return last_error_ = done.error + error;
    }
    factorise_instead(done, u, progress);
  }
  residual_ = zeros(f.size());
  factor_->solve_in_place(f);
  return 0;
}

template <int Dof>
void ElasticSolver<Dof>::factorise_instead(const IterationReport& failed, const Eigen::VectorXd& u,
                                           const Progress& progress) {
  // Where the answer still moves most: what the preconditioner would add to it.
  Eigen::VectorXd still;
  multigrid_->apply(residual_, still);
  int farthest = 0;
  double squared = -1;
  for (int b = 0; b < matrix_->size(); ++b) {
    const double one = squared_length_of(part<dimension_of<Dof>>(still, Dof * b));
    if (!(one > squared)) continue;
    squared = one;
    farthest = b;
  }
  const std::string what =
      message({"conjugate gradients did not converge in ", failed.iterations,
               " iterations: an error of ", failed.error, " m in displacements of ",
               largest_translation<Dof>(u), " m, most at body ", farthest});
  order(progress);
  const double need = direct_memory(), limit = memory_limit();
  if (need > limit)
    throw NumericalFault(message({"elastic solver: ", what, "; a factor needs ", gigabytes(need),
                                  " GB of memory, of ", gigabytes(limit), " GB that it may take"}));
  factorise(progress);
  report_.reason = what;
}

/// Where iteration begins: the last answer, as long as brings it nearest in energy, if that
/// explains the forces and its error is well within what is asked for; else no motion. What was not
/// seen of the error then is not seen later either, so it stays part of the estimate, and where
/// forces are new it would hide what becomes of them.
template <int Dof>
auto ElasticSolver<Dof>::guess(const Eigen::VectorXd& f, const SolveTolerance& tolerance) const
    -> Guess {
  Guess zero{zeros(f.size()), 0};
  if (last_.size() != f.size()) return zero;
  Eigen::VectorXd force;
  matrix_->multiply(last_, force);
  const double work = dot_product(last_, force);
  if (!(work > 0)) return zero;
  const double share = dot_product(last_, f) / work;
  const double error = std::abs(share) * last_error_,
               allowed =
                   std::max(std::abs(share) * tolerance.relative * largest_translation<Dof>(last_),
                            tolerance.absolute);
  if (!(error <= 0.5 * allowed)) return zero;
  set_to_sum(force, f, -share, force);
  if (!(dot_product(force, force) <= 2.5e-3 * dot_product(f, f))) return zero;
  Guess near{zero.u, error};
  set_to_sum(near.u, zero.u, share, last_);
  return near;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class ElasticSolver<3>;
VOUSSOIR_SPATIAL_TEMPLATE class ElasticSolver<6>;
#endif

}  // namespace voussoir
