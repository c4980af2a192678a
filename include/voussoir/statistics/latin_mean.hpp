// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <optional>
#include <span>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/statistics/confidence.hpp>

namespace voussoir {

/// Interval for the mean of values that were computed at the points of a Latin hypercube.
///
/// What the values are a sum of functions of one variable each, such points have the mean of all
/// but exactly; unsure is the rest, be it interaction or what the points do not decide. A linear
/// fit leaves that and a little more, so that the interval is on the safe side:
///
///   mean +- t s / sqrt(n),   s^2 = sum of squares left by the fit / (n - p - 1),
///   t of n - p - 1 degrees
///
/// @param x  p variables of n values each
/// @param y  n values
/// @return  nothing where n < p + 3
/// @pre     every variable has as many points in each tenth (n = 10, 20, 30, ...)
/// @throws InvalidInput  other numbers of values, or a confidence that is not between 0 and 1
/// Source: Owen (1992), A central limit theorem for Latin hypercube sampling, J. R. Stat. Soc.
/// B 54.
/// @cost O(n p^2)
[[nodiscard]] inline std::optional<Interval> latin_mean_interval(
    std::span<const std::vector<double>> x, std::span<const double> y, double confidence = 0.95) {
  const auto n = static_cast<Eigen::Index>(y.size()), p = static_cast<Eigen::Index>(x.size());
  const double tail = detail::tail(confidence);
  if (n < p + 3) return std::nullopt;
  const auto centred = [&](std::span<const double> values) {
    require(values.size() == y.size(), "number of values", static_cast<double>(values.size()),
            "that of the quantity whose mean is sought");
    const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
    return Eigen::VectorXd(v.array() - v.mean());
  };
  Eigen::MatrixXd causes(n, p);
  for (Eigen::Index k = 0; k < p; ++k) causes.col(k) = centred(x[static_cast<std::size_t>(k)]);
  Eigen::VectorXd left = centred(y);
  const double mean = Eigen::Map<const Eigen::VectorXd>(y.data(), n).mean();
  if (p > 0) {
    // Of variables in their own units: GPa beside radians.
    for (Eigen::Index k = 0; k < p; ++k)
      if (const double size = causes.col(k).norm(); size > 0) causes.col(k) /= size;
    left -= causes * causes.colPivHouseholderQr().solve(left);
  }
  const auto degrees = static_cast<double>(n - p - 1);
  const double half = quantile(complement(boost::math::students_t(degrees), tail)) *
                      std::sqrt(left.squaredNorm() / (degrees * static_cast<double>(n)));
  return Interval{mean - half, mean + half};
}

}  // namespace voussoir
