// SPDX-License-Identifier: MIT
#pragma once

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <voussoir/core/errors.hpp>
#include <voussoir/statistics/confidence.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

/// What is believed about the mean mu and the variance sigma^2 of normal data, and how data change
/// it (conjugate update):
///
///   sigma^2 ~ inverse gamma(alpha, beta),   mu | sigma^2 ~ N(m, sigma^2 / kappa)
///   kappa' = kappa + n,  m' = (kappa m + n x) / kappa',  alpha' = alpha + n / 2
///   beta'  = beta + S / 2 + kappa n (x - m)^2 / (2 kappa')
///
/// for n values of mean x and sum of squares S about it. Sample after sample or all at once: the
/// same. Source: e.g. Gelman et al., Bayesian Data Analysis, 3.3.
struct NormalBelief {
  double m;      ///< centre of the mean
  double kappa;  ///< how many values it is worth, > 0
  double alpha;  ///< half the number of values that the variance is worth, > 0
  double beta;   ///< half their sum of squares, > 0

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(std::isfinite(m), "belief m", m, "finite");
    require(kappa > 0 && std::isfinite(kappa), "belief kappa", kappa, "> 0");
    require(alpha > 0 && std::isfinite(alpha), "belief alpha", alpha, "> 0");
    require(beta > 0 && std::isfinite(beta), "belief beta", beta, "> 0");
  }

  /// After n values of this mean and sum of squares about it.
  /// @throws InvalidInput  a value out of range
  [[nodiscard]] NormalBelief after(double n, double mean, double squares) const {
    check();
    require(n >= 1 && std::isfinite(n), "sample size n", n, ">= 1");
    require(std::isfinite(mean), "sample mean", mean, "finite");
    require(squares >= 0 && std::isfinite(squares), "sum of squares", squares, ">= 0");
    const double total = kappa + n;
    return {m + n * (mean - m) / total, total, alpha + 0.5 * n,
            beta + 0.5 * squares + 0.5 * (kappa / total) * n * (mean - m) * (mean - m)};
  }
  [[nodiscard]] NormalBelief after(const Sample& sample) const {
    return after(static_cast<double>(sample.size()), sample.mean(), sample.squares());
  }

  /// E[sigma^2]; infinite for alpha <= 1.
  [[nodiscard]] double expected_variance() const {
    return alpha > 1 ? beta / (alpha - 1) : std::numeric_limits<double>::infinity();
  }
  /// Var[mu]; infinite for alpha <= 1.
  [[nodiscard]] double variance_of_mean() const { return expected_variance() / kappa; }

  /// In which mu lies with this probability: Student's t of 2 alpha degrees, scale
  /// sqrt(beta / (alpha kappa)).
  /// @throws InvalidInput  a value out of range
  [[nodiscard]] Interval mean_interval(double probability = 0.95) const {
    check();
    const double half =
        quantile(complement(boost::math::students_t(2 * alpha), detail::tail(probability))) *
        std::sqrt(beta / (alpha * kappa));
    return {m - half, m + half};
  }
  /// The value that the next observation stays below with this probability: the same t with scale
  /// sqrt(beta (kappa + 1) / (alpha kappa)).
  /// @throws InvalidInput  a value out of range
  [[nodiscard]] double predicted_quantile(double probability) const {
    check();
    require(probability > 0 && probability < 1, "probability", probability, "> 0 and < 1");
    return m + quantile(boost::math::students_t(2 * alpha), probability) *
                   std::sqrt(beta * (kappa + 1) / (alpha * kappa));
  }
};

}  // namespace voussoir
