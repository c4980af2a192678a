// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Raw data, ready for statistics: finite values, ascending. Fits and tests take this, never a
/// histogram.
class Sample {
 public:
  /// @throws InvalidInput  empty, or a value is not finite (named by its place, from 0)
  explicit Sample(std::vector<double> values) : values_(std::move(values)) {
    if (values_.empty()) throw InvalidInput("sample: empty; needs at least one value");
    for (std::size_t k = 0; k < values_.size(); ++k)
      if (!std::isfinite(values_[k]))
        throw InvalidInput("sample: value " + std::to_string(k) + " is " +
                           message_number(values_[k]) + "; accepted: finite values");
    // Two passes about the mean: sums of squares lose the digits of a large mean.
    for (const double x : values_) mean_ += x / static_cast<double>(values_.size());
    for (const double x : values_) squares_ += (x - mean_) * (x - mean_);
    std::sort(values_.begin(), values_.end());
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] double mean() const { return mean_; }
  /// S, sum of squared deviations from the mean.
  [[nodiscard]] double squares() const { return squares_; }
  /// sqrt(S / (n - 1)): unbiased variance.
  /// @throws InvalidInput  fewer than two values
  [[nodiscard]] double deviation() const {
    require(values_.size() >= 2, "sample size n", static_cast<double>(values_.size()),
            ">= 2 for a standard deviation");
    return std::sqrt(squares_ / static_cast<double>(values_.size() - 1));
  }
  /// sqrt(S / n): maximum likelihood; smaller by sqrt((n - 1) / n).
  [[nodiscard]] double population_deviation() const {
    return std::sqrt(squares_ / static_cast<double>(values_.size()));
  }
  /// Third moment about the mean over the cube of the population deviation [-]; 0 if all values are
  /// equal.
  [[nodiscard]] double skewness() const {
    if (!(squares_ > 0)) return 0;
    double cubes = 0;
    for (const double x : values_) cubes += std::pow((x - mean_) / population_deviation(), 3);
    return cubes / static_cast<double>(values_.size());
  }
  [[nodiscard]] double smallest() const { return values_.front(); }
  [[nodiscard]] double largest() const { return values_.back(); }
  /// Mean of the two middle values if their number is even.
  [[nodiscard]] double median() const {
    const std::size_t n = values_.size();
    return 0.5 * (values_[(n - 1) / 2] + values_[n / 2]);
  }

 private:
  std::vector<double> values_;
  double mean_ = 0, squares_ = 0;
};

/// Size, mean and deviation of a sample, where that is all that is known of it.
struct SampleSummary {
  double size;  ///< n, >= 1
  double mean;
  double deviation;  ///< population form, sqrt(S / n)
};
/// All samples as one: the mean of the means, and the law of total variance.
/// @throws InvalidInput  no sample, or a value out of range
[[nodiscard]] inline SampleSummary merged(const std::vector<SampleSummary>& samples) {
  if (samples.empty()) throw InvalidInput("merged samples: needs at least one");
  SampleSummary all{0, 0, 0};
  for (const SampleSummary& s : samples) {
    require(s.size >= 1 && std::isfinite(s.size), "sample size n", s.size, ">= 1");
    require(std::isfinite(s.mean), "sample mean", s.mean, "finite");
    require(s.deviation >= 0 && std::isfinite(s.deviation), "sample deviation", s.deviation,
            ">= 0");
    all.size += s.size;
  }
  for (const SampleSummary& s : samples) all.mean += s.mean * (s.size / all.size);
  double variance = 0;
  for (const SampleSummary& s : samples)
    variance += (s.size / all.size) *
                (s.deviation * s.deviation + (s.mean - all.mean) * (s.mean - all.mean));
  all.deviation = std::sqrt(variance);
  return all;
}

}  // namespace voussoir
