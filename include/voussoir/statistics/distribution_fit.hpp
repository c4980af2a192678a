// SPDX-License-Identifier: MIT
#pragma once

#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

/// A distribution fitted to raw data; Boost.Math's, with its probabilities and quantiles.
template <class Distribution>
class FittedDistribution {
 public:
  explicit FittedDistribution(Distribution distribution) : distribution_(std::move(distribution)) {}

  [[nodiscard]] const Distribution& distribution() const { return distribution_; }
  [[nodiscard]] double density(double x) const { return in_support(x) ? pdf(distribution_, x) : 0; }
  /// P(X <= x)
  [[nodiscard]] double probability_below(double x) const {
    return in_support(x) ? cdf(distribution_, x) : 0;
  }
  /// P(X > x), exact in the far tail.
  [[nodiscard]] double probability_above(double x) const {
    return in_support(x) ? cdf(complement(distribution_, x)) : 1;
  }
  /// The value below which lies `probability`.
  /// @throws InvalidInput  a probability that is not between 0 and 1
  [[nodiscard]] double quantile_at(double probability) const {
    require(probability > 0 && probability < 1, "probability", probability, "> 0 and < 1");
    return quantile(distribution_, probability);
  }

 private:
  [[nodiscard]] bool in_support(double x) const { return x > support(distribution_).first; }
  Distribution distribution_;
};

using NormalFit = FittedDistribution<boost::math::normal>;
using LognormalFit = FittedDistribution<boost::math::lognormal>;

/// Normal distribution with the mean of the sample and its deviation from n - 1.
/// @throws InvalidInput  fewer than two values, or all equal
[[nodiscard]] inline NormalFit fit_normal(const Sample& sample) {
  const double deviation = sample.deviation();
  require(deviation > 0, "sample deviation", deviation, "> 0 for a fit");
  return NormalFit(boost::math::normal(sample.mean(), deviation));
}

/// Lognormal distribution: the normal one of the logarithms.
/// @throws InvalidInput  a value is not positive, fewer than two values, or all equal
[[nodiscard]] inline LognormalFit fit_lognormal(const Sample& sample) {
  require(sample.smallest() > 0, "smallest value", sample.smallest(),
          "> 0 for a lognormal distribution");
  std::vector<double> logarithms;
  for (const double x : sample.values()) logarithms.push_back(std::log(x));
  const Sample logs(std::move(logarithms));
  const double deviation = logs.deviation();
  require(deviation > 0, "deviation of the logarithms", deviation, "> 0 for a fit");
  return LognormalFit(boost::math::lognormal(logs.mean(), deviation));
}

}  // namespace voussoir
