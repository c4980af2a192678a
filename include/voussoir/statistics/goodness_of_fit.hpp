// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <voussoir/core/errors.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

/// Kolmogorov-Smirnov distance: the largest difference between the steps of the sample and a
/// cumulative distribution [-].
/// @param cumulative  x -> P(X <= x)
template <class Cumulative>
[[nodiscard]] double kolmogorov_smirnov(const Sample& sample, const Cumulative& cumulative) {
  const double n = static_cast<double>(sample.size());
  double distance = 0;
  for (std::size_t k = 0; k < sample.size(); ++k) {
    const double p = cumulative(sample.values()[k]);
    distance =
        std::max({distance, (static_cast<double>(k) + 1) / n - p, p - static_cast<double>(k) / n});
  }
  return distance;
}

/// The distance to a normal distribution fitted to the same n values that 5 % of normal samples
/// exceed: a larger one speaks against the normal distribution. (Tables for a distribution given
/// beforehand are too kind.)
///
///   0.895 / (sqrt(n) - 0.01 + 0.85 / sqrt(n))
///
/// Source: Stephens (1974), J. Am. Stat. Assoc. 69, Table 1A, after Lilliefors (1967); for large n
/// 0.895 / sqrt(n). Simulated for n = 10, 21, 63 and 105: 4.5 to 5.6 %.
/// @throws InvalidInput  n < 5
[[nodiscard]] inline double lilliefors_limit(std::size_t n) {
  require(n >= 5, "sample size n", static_cast<double>(n), ">= 5");
  const double root = std::sqrt(static_cast<double>(n));
  return 0.895 / (root - 0.01 + 0.85 / root);
}

/// How far the steps of n values may lie from the distribution they come from, whichever it is,
/// over all of it at once: sqrt(ln(2 / (1 - confidence)) / (2 n)) [-].
/// @throws InvalidInput  n < 1, or a confidence that is not between 0 and 1
/// Source: Dvoretzky, Kiefer & Wolfowitz (1956); the constant is that of Massart (1990), Ann.
/// Probab. 18.
[[nodiscard]] inline double distribution_band(std::size_t n, double confidence = 0.95) {
  require(n >= 1, "sample size n", static_cast<double>(n), ">= 1");
  require(confidence > 0 && confidence < 1, "confidence", confidence, "> 0 and < 1");
  return std::sqrt(std::log(2 / (1 - confidence)) / (2 * static_cast<double>(n)));
}

}  // namespace voussoir
