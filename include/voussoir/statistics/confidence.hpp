// SPDX-License-Identifier: MIT
#pragma once

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <voussoir/core/errors.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

struct Interval {
  double low, high;
  [[nodiscard]] double width() const { return high - low; }
  [[nodiscard]] bool holds(double x) const { return low <= x && x <= high; }
};

namespace detail {
/// The part beyond each end.
[[nodiscard]] inline double tail(double confidence) {
  require(confidence > 0 && confidence < 1, "confidence", confidence, "> 0 and < 1");
  return 0.5 * (1 - confidence);
}
}  // namespace detail

/// Interval for the mean of normal data: mean +- t s / sqrt(n).
/// @param size, mean, deviation  n, mean and sqrt(S / (n - 1)) of the sample
/// @throws InvalidInput  a value out of range
[[nodiscard]] inline Interval mean_interval(double size, double mean, double deviation,
                                            double confidence = 0.95) {
  require(size >= 2 && std::isfinite(size), "sample size n", size, ">= 2");
  require(deviation >= 0 && std::isfinite(deviation), "sample deviation", deviation, ">= 0");
  const boost::math::students_t t(size - 1);
  const double half =
      quantile(complement(t, detail::tail(confidence))) * deviation / std::sqrt(size);
  return {mean - half, mean + half};
}
[[nodiscard]] inline Interval mean_interval(const Sample& sample, double confidence = 0.95) {
  return mean_interval(static_cast<double>(sample.size()), sample.mean(), sample.deviation(),
                       confidence);
}

/// Interval for the standard deviation of normal data, from chi squared of n - 1 degrees.
/// @throws InvalidInput  a value out of range
[[nodiscard]] inline Interval deviation_interval(const Sample& sample, double confidence = 0.95) {
  const double s = sample.deviation(), degrees = static_cast<double>(sample.size()) - 1;
  const boost::math::chi_squared chi(degrees);
  const double tail = detail::tail(confidence);
  return {s * std::sqrt(degrees / quantile(complement(chi, tail))),
          s * std::sqrt(degrees / quantile(chi, tail))};
}

/// Interval for a probability of which `events` of `trials` were seen, for example tunnels that
/// collapsed: exact, never too short.
/// @throws InvalidInput  a value out of range
/// Source: Clopper & Pearson (1934).
[[nodiscard]] inline Interval probability_interval(int events, int trials,
                                                   double confidence = 0.95) {
  require(trials >= 1, "trials", trials, ">= 1");
  require(events >= 0 && events <= trials, "events", events, "0 to the number of trials");
  using boost::math::binomial;
  const double tail = detail::tail(confidence);
  return {binomial::find_lower_bound_on_p(trials, events, tail),
          binomial::find_upper_bound_on_p(trials, events, tail)};
}

/// Interval for such a probability that holds it in about `confidence` of the cases on average, and
/// less often for small ones (84 % where 0.18 events are expected): shorter than
/// `probability_interval`, and no bound to sign.
/// @throws InvalidInput  a value out of range
/// Source: Wilson (1927), J. Am. Stat. Assoc. 22; Brown, Cai & DasGupta (2001), Stat. Sci. 16.
[[nodiscard]] inline Interval wilson_interval(int events, int trials, double confidence = 0.95) {
  require(trials >= 1, "trials", trials, ">= 1");
  require(events >= 0 && events <= trials, "events", events, "0 to the number of trials");
  const double z = quantile(complement(boost::math::normal(), detail::tail(confidence))),
               n = trials, share = events / n, over = 1 + z * z / n,
               middle = (share + z * z / (2 * n)) / over,
               half = z / over * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  // At the ends of the range the formula gives 0 and 1 but for rounding.
  return {events == 0 ? 0.0 : middle - half, events == trials ? 1.0 : middle + half};
}

/// How many trials in all make `probability_interval` no wider than `width`, if the share of events
/// stays what it is.
/// @param width  > 0 [-]
/// @throws InvalidInput  a value out of range, or it would take more than 10^9
[[nodiscard]] inline int trials_for_width(int events, int trials, double width,
                                          double confidence = 0.95) {
  require(trials >= 1, "trials", trials, ">= 1");
  require(events >= 0 && events <= trials, "events", events, "0 to the number of trials");
  require(width > 0, "width of the interval", width, "> 0");
  const double tail = detail::tail(confidence), share = static_cast<double>(events) / trials;
  // Of events that need not be a whole number: the width then falls steadily with n.
  const auto is_narrow = [&](int n) {
    const double k = share * n, none = n - k;
    const double low = k > 0 ? boost::math::ibeta_inv(k, none + 1, tail) : 0,
                 high = none > 0 ? boost::math::ibetac_inv(k + 1, none, tail) : 1;
    return high - low <= width;
  };
  int few = 0, many = 1;
  while (!is_narrow(many)) {
    require(many < 500000000, "width of the interval", width, "what 10^9 trials can give");
    few = many;
    many *= 2;
  }
  while (many - few > 1) {
    const int middle = few + (many - few) / 2;
    (is_narrow(middle) ? many : few) = middle;
  }
  return many;
}

}  // namespace voussoir
