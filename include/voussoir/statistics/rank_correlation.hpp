// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/statistics/confidence.hpp>

namespace voussoir {

/// Places of values in their order, from 1; equal values share the mean of theirs.
/// @pre no value is not a number; infinite values are the first and the last
/// @cost O(n log n)
[[nodiscard]] inline std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from + 1;
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    const double shared = 0.5 * static_cast<double>(from + 1 + to);
    for (; from < to; ++from) ranks[order[from]] = shared;
  }
  return ranks;
}

/// Spearman's rank correlation: the correlation of the ranks, -1 to 1. How far one quantity rises
/// or falls with another, along whatever curve [-].
/// @return  not a number where all values of one are equal: nothing can be told
/// @throws InvalidInput  other numbers of values, or fewer than two
/// Source: Spearman (1904), Am. J. Psychol. 15.
[[nodiscard]] inline double rank_correlation(std::span<const double> x, std::span<const double> y) {
  require(x.size() == y.size(), "number of values", static_cast<double>(y.size()),
          "that of the other quantity");
  require(x.size() >= 2, "number of values", static_cast<double>(x.size()), ">= 2");
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double mean = 0.5 * (static_cast<double>(x.size()) + 1);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ab += (a[k] - mean) * (b[k] - mean);
    aa += (a[k] - mean) * (a[k] - mean);
    bb += (b[k] - mean) * (b[k] - mean);
  }
  if (!(aa > 0 && bb > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0);
}

/// The rank correlation, up or down, that quantities without a connection exceed in 1 - confidence
/// of the cases:
///
///   t / sqrt(n - 2 + t^2),   t: quantile of Student's distribution of n - 2 degrees
///
/// By this approximation 3 % too small for n = 10 (0.632, exact 0.648), 1 % for n = 20.
/// @throws InvalidInput  n < 3, or a confidence that is not between 0 and 1
/// Source: Kendall & Stuart, The Advanced Theory of Statistics 2, 31.19.
[[nodiscard]] inline double rank_correlation_limit(std::size_t n, double confidence = 0.95) {
  require(n >= 3, "number of values", static_cast<double>(n), ">= 3");
  const double degrees = static_cast<double>(n) - 2;
  const double t = quantile(complement(boost::math::students_t(degrees), detail::tail(confidence)));
  return t / std::sqrt(degrees + t * t);
}

/// The part of the variance of a quantity's ranks that a sum of multiples of the ranks of others
/// leaves none of [-]: how much of it they explain together, the rest being other causes and what
/// they do jointly. Corrected for what any p quantities explain by chance, hence below 0 where it
/// is less than that: 1 - (1 - R^2) (n - 1) / (n - p - 1).
/// @param x  p quantities of n values each
/// @return  not a number where all values of y are equal, or n < p + 2
/// @throws InvalidInput  other numbers of values
/// @cost O(n p^2)
[[nodiscard]] inline double rank_variance_explained(std::span<const std::vector<double>> x,
                                                    std::span<const double> y) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<Eigen::Index>(y.size()), p = static_cast<Eigen::Index>(x.size());
  if (n < p + 2) return none;
  const auto centred = [&](std::span<const double> values) {
    require(values.size() == y.size(), "number of values", static_cast<double>(values.size()),
            "that of the quantity to be explained");
    const std::vector<double> ranks = ranks_of(values);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(ranks.data(), n).array() -
                           0.5 * (static_cast<double>(n) + 1));
  };
  Eigen::MatrixXd causes(n, p);
  for (Eigen::Index k = 0; k < p; ++k) causes.col(k) = centred(x[static_cast<std::size_t>(k)]);
  const Eigen::VectorXd effect = centred(y);
  if (!(effect.squaredNorm() > 0)) return none;
  if (p == 0) return 0;
  const Eigen::VectorXd left = effect - causes * causes.colPivHouseholderQr().solve(effect);
  return 1 - left.squaredNorm() / effect.squaredNorm() * static_cast<double>(n - 1) /
                 static_cast<double>(n - p - 1);
}

}  // namespace voussoir
