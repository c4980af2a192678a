// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/rigid_aggregates.hpp>

namespace voussoir {

/// How exact displacements must be: their largest error [m] at most the larger of the two.
struct SolveTolerance {
  double relative = 1e-8;  ///< of the largest displacement sought [-]
  double absolute = 0;     ///< [m]
};

/// What an iteration did.
struct IterationReport {
  int iterations = 0;
  /// Estimate of the largest error of a translation [m].
  double error = std::numeric_limits<double>::infinity();
  bool converged = false;
};

/// Largest translation of a body; not a number where one is not [m].
template <int Dof>
[[nodiscard]] double largest_translation(const Eigen::VectorXd& u) {
  double squared = 0;
  for (Eigen::Index first = 0; first < u.size(); first += Dof) {
    const double one = squared_length_of(part<dimension_of<Dof>>(u, first));
    if (std::isnan(one)) return one;
    squared = std::max(squared, one);
  }
  return std::sqrt(squared);
}

namespace detail {

/// Largest translation of the difference of two displacements; not a number where one is not [m].
template <int Dof>
[[nodiscard]] double largest_change(const Eigen::VectorXd& u, const Eigen::VectorXd& before) {
  constexpr int dim = dimension_of<Dof>;
  double squared = 0;
  for (Eigen::Index first = 0; first < u.size(); first += Dof) {
    const double one = squared_length_of(part<dim>(u, first) - part<dim>(before, first));
    if (std::isnan(one)) return one;
    squared = std::max(squared, one);
  }
  return std::sqrt(squared);
}

/// How far a conjugate gradient iterate is from its limit, from how it got where it is.
///
/// Every step takes a known part of the error's energy, so that the energies of the last steps and
/// the rate at which they fall tell how much is left; the rate is the worst over the last 2, 4 and
/// 8 steps, for it is not even. The largest error of a translation is taken to have the ratio to
/// that energy which the change of the iterate in the last three steps has. What the preconditioner
/// makes of the residual is a second measure. Factors were fitted to 120 random networks in 2-D and
/// 3-D whose joints are up to 10^6 times softer than others, and grow with the number of steps,
/// because slow convergence hides more: of 548 stops one had an error beyond the estimate, by a
/// quarter, and half had one of less than a seventh of it.
class ErrorEstimate {
 public:
  static constexpr int delay = 3;

  /// @param step            its number, from 1
  /// @param energy          that this step has taken from the error
  /// @param change          largest change of a translation in the last three steps [m]
  /// @param preconditioned  largest translation in the preconditioned residual before it [m]
  /// @return  estimate of the largest error of a translation [m]; infinite for the first steps and
  ///          where the energies do not fall
  double operator()(int step, double energy, double change, double preconditioned) {
    for (int k = kept - 1; k > 0; --k) energies_[k] = energies_[k - 1];
    energies_[0] = energy;
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (step < 4) return unknown;
    double left = 0;
    for (int window = 2; window <= 8 && 2 * window <= step; window *= 2) {
      const double now = sum(0, window), before = sum(window, 2 * window);
      if (!(now < before)) return unknown;
      left = std::max(left, now * now / (before - now));
    }
    const double share = std::max(std::sqrt(left / sum(0, delay)), 0.1);
    return std::max(1.0, step / 8.0) * std::max(3 * share * change, 10 * preconditioned);
  }

 private:
  static constexpr int kept = 16;
  [[nodiscard]] double sum(int first, int last) const {
    double all = 0;
    for (int k = first; k < last; ++k) all += energies_[k];
    return all;
  }

  double energies_[kept] = {};  ///< of the last steps, the latest first
};

}  // namespace detail

/// Solves K x = f by preconditioned conjugate gradients, and says how exact the answer is.
///
/// The preconditioner may change a little from step to step, as cycles with inner iterations do:
/// directions are made conjugate by the change of the residual (Polak and Ribiere).
///
/// @param k          symmetric, positive definite
/// @param apply      apply(r, z): z = about K^-1 r
/// @param f          right-hand side; not a vector that `x` shares
/// @param x          where to begin; the answer
/// @param residual   of the answer: f - K x
/// @param most       iterations
/// @return  not converged: `most` iterations were not enough, or K or the preconditioner is not
///          positive definite as far as numbers tell; x is then the last iterate
/// @throws Stopped   x is of no use
///
/// Source: Hestenes and Stiefel (1952), Methods of conjugate gradients for solving linear systems,
/// J. Res. Natl. Bur. Stand. 49(6), 409-436, where it is shown that the error falls in every step;
/// estimating it with a delay: Golub and Meurant (2010), Matrices, Moments and Quadrature, ch. 12.
template <int Dof, class Precondition>
[[nodiscard]] IterationReport conjugate_gradients(const BlockMatrix<Dof>& k, Precondition&& apply,
                                                  const Eigen::VectorXd& f, Eigen::VectorXd& x,
                                                  Eigen::VectorXd& residual,
                                                  const SolveTolerance& tolerance, int most,
                                                  const Progress& progress = {}) {
  constexpr int delay = detail::ErrorEstimate::delay;
  VOUSSOIR_ASSERT(f.size() == Dof * static_cast<Eigen::Index>(k.size()) && x.size() == f.size(),
                  "vectors have the unknowns of the matrix");
  VOUSSOIR_ASSERT(tolerance.relative >= 0 && tolerance.absolute >= 0,
                  "tolerances are no less than 0");
  StopCheck stop(progress, 1);
  IterationReport report;
  Eigen::VectorXd former, z, direction = zeros(x.size()), force;
  k.multiply(x, residual);
  set_to_sum(residual, f, -1, residual);
  Eigen::VectorXd past[delay] = {x, x, x};  // the last iterates
  detail::ErrorEstimate error_of;
  double last = 0;
  const auto allowed = [&] {
    return std::max(tolerance.relative * largest_translation<Dof>(x), tolerance.absolute);
  };
  // Below what rounding leaves of the residual no step means anything. x is then as exact as a
  // factor would make it, which 1e-8 is a cautious word for.
  const double noise = 1e-30 * dot_product(f, f);
  for (int step = 1; step <= most; ++step) {
    stop();
    if (dot_product(residual, residual) <= noise) {
      report.error = std::min(report.error, 1e-8 * largest_translation<Dof>(x));
      report.converged = report.error <= allowed();
      break;
    }
    apply(residual, z);
    const double now = dot_product(residual, z);
    if (!(now > 0)) break;
    set_to_sum(direction, z, step == 1 ? 0 : (now - dot_product(former, z)) / last, direction);
    last = now;
    k.multiply(direction, force);
    const double work = dot_product(direction, force);
    if (!(work > 0)) break;
    const double length = dot_product(residual, direction) / work;
    VOUSSOIR_ASSERT(z.size() == x.size(), "a preconditioner keeps the unknowns");
    former = residual;
    set_to_sum(residual, residual, -length, force);
    set_to_sum(x, x, length, direction);
    report.iterations = step;
    Eigen::VectorXd& before = past[step % delay];
    report.error = error_of(step, length * length * work, detail::largest_change<Dof>(x, before),
                            largest_translation<Dof>(z));
    report.converged = report.error <= allowed();
    if (report.converged) break;
    before = x;
  }
  return report;
}

}  // namespace voussoir
