// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// How a value that is not known is spread between two ends.
///
/// A normal or lognormal distribution without an end is cut off `reach` standard deviations from
/// its centre (63 of a million values lie beyond), so that every distribution says what its extreme
/// values are. Where one is cut off, what is left is scaled to a probability of 1; its mean and
/// standard deviation are those before.
class BoundedDistribution {
 public:
  enum class Kind { normal, lognormal, uniform, triangular };
  static constexpr double reach = 4;  ///< of a distribution without ends [standard deviations]

  /// @param low, high  where it is cut off; none: at mean -+ `reach` sd
  /// @throws InvalidInput  sd <= 0, low >= high, or the mean is not between them
  [[nodiscard]] static BoundedDistribution normal(double mean, double sd,
                                                  std::optional<double> low = {},
                                                  std::optional<double> high = {}) {
    check(sd);
    return {
        Kind::normal, mean, sd, low.value_or(mean - reach * sd), high.value_or(mean + reach * sd),
        mean};
  }
  /// The logarithm is normal: sd_log^2 = ln(1 + (sd / mean)^2), mean_log = ln mean - sd_log^2 / 2.
  /// @param mean, sd   of the value itself, not of its logarithm
  /// @param low, high  where it is cut off; none: at exp(mean_log -+ `reach` sd_log)
  /// @throws InvalidInput  mean or sd <= 0, low < 0, low >= high, or the mean is not between them
  [[nodiscard]] static BoundedDistribution lognormal(double mean, double sd,
                                                     std::optional<double> low = {},
                                                     std::optional<double> high = {}) {
    check(sd);
    require(mean > 0, "mean of a lognormal distribution", mean, "> 0");
    if (low) require(*low >= 0, "lower end of a lognormal distribution", *low, ">= 0");
    const double spread = std::sqrt(std::log1p((sd / mean) * (sd / mean))),
                 centre = std::log(mean) - 0.5 * spread * spread;
    return {Kind::lognormal,
            centre,
            spread,
            low.value_or(std::exp(centre - reach * spread)),
            high.value_or(std::exp(centre + reach * spread)),
            mean};
  }
  /// @throws InvalidInput  low >= high
  [[nodiscard]] static BoundedDistribution uniform(double low, double high) {
    return {Kind::uniform, 0, 0, low, high, 0.5 * (low + high)};
  }
  /// @param mode  the likeliest value, from low to high
  /// @throws InvalidInput  low >= high, or the mode is not between them
  [[nodiscard]] static BoundedDistribution triangular(double low, double mode, double high) {
    return {Kind::triangular, mode, 0, low, high, mode};
  }

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] double low() const { return low_; }    ///< no value is smaller
  [[nodiscard]] double high() const { return high_; }  ///< no value is larger

  /// P(X <= x)
  [[nodiscard]] double probability_below(double x) const {
    if (x <= low_) return 0;
    if (x >= high_) return 1;
    switch (kind_) {
      case Kind::uniform:
        return (x - low_) / (high_ - low_);
      case Kind::triangular:
        return x <= centre_ ? (x - low_) * (x - low_) / ((high_ - low_) * (centre_ - low_))
                            : 1 - (high_ - x) * (high_ - x) / ((high_ - low_) * (high_ - centre_));
      default:
        return mass(below_low_z_, z_of(x)) / mass_;
    }
  }
  /// The value below which lies `probability`.
  /// @throws InvalidInput  a probability that is not from 0 to 1
  [[nodiscard]] double quantile(double probability) const {
    require(probability >= 0 && probability <= 1, "probability", probability, "0 to 1");
    if (probability == 0) return low_;
    if (probability == 1) return high_;
    double value = 0;
    switch (kind_) {
      case Kind::uniform:
        value = low_ + probability * (high_ - low_);
        break;
      case Kind::triangular: {
        const double range = high_ - low_, before = (centre_ - low_) / range;
        value = probability <= before
                    ? low_ + std::sqrt(probability * range * (centre_ - low_))
                    : high_ - std::sqrt((1 - probability) * range * (high_ - centre_));
        break;
      }
      default: {
        // From the nearer side of the untruncated distribution: 1 - 1e-20 is 1.
        const boost::math::normal standard;
        const double below = cdf(standard, below_low_z_) + probability * mass_,
                     above = cdf(complement(standard, above_high_z_)) + (1 - probability) * mass_;
        const double z = below < above
                             ? boost::math::quantile(standard, below)
                             : boost::math::quantile(boost::math::complement(standard, above));
        value = centre_ + spread_ * z;
        if (kind_ == Kind::lognormal) value = std::exp(value);
      }
    }
    return std::clamp(value, low_, high_);
  }
  [[nodiscard]] double median() const { return quantile(0.5); }

 private:
  BoundedDistribution(Kind kind, double centre, double spread, double low, double high, double mean)
      : kind_(kind), centre_(centre), spread_(spread), low_(low), high_(high) {
    require(std::isfinite(low) && std::isfinite(high), "end of a distribution",
            std::isfinite(low) ? high : low, "finite");
    require(low < high, "lower end of a distribution", low, "below its upper end");
    require(low <= mean && mean <= high, "mean or mode of a distribution", mean,
            "between its lower and its upper end");
    if (kind != Kind::normal && kind != Kind::lognormal) return;
    below_low_z_ = z_of(low);
    above_high_z_ = z_of(high);
    mass_ = mass(below_low_z_, above_high_z_);
    require(mass_ > 0, "probability between the ends of a distribution", mass_, "> 0");
  }
  static void check(double sd) {
    require(sd > 0 && std::isfinite(sd), "standard deviation", sd, "> 0");
  }
  [[nodiscard]] double z_of(double x) const {
    if (kind_ == Kind::lognormal && x <= 0) return -std::numeric_limits<double>::infinity();
    return ((kind_ == Kind::lognormal ? std::log(x) : x) - centre_) / spread_;
  }
  /// Of a standard normal value between two.
  [[nodiscard]] static double mass(double low, double high) {
    const boost::math::normal standard;
    return low > 0 ? cdf(complement(standard, low)) - cdf(complement(standard, high))
                   : cdf(standard, high) - cdf(standard, low);
  }

  Kind kind_;
  double centre_;  ///< mean of the normal distribution, of the logarithms; mode
  double spread_;  ///< standard deviation of it
  double low_, high_;
  double below_low_z_ = 0, above_high_z_ = 0, mass_ = 1;
};

}  // namespace voussoir
