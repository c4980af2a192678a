// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

/// How many values of a sample lie in each of equal classes: to look at, not to fit to.
class Histogram {
 public:
  /// Classes [low + k width, low + (k + 1) width); the last one is closed.
  /// @param low, high  of all classes; values outside are refused, for a picture must not lose any
  /// @throws InvalidInput  low >= high, no class, or a value outside
  Histogram(const Sample& sample, double low, double high, std::size_t classes)
      : low_(low), counts_(classes), size_(sample.size()) {
    require(low < high && std::isfinite(high - low), "lower end of the histogram", low,
            "below its upper end, both finite");
    require(classes >= 1, "number of classes", static_cast<double>(classes), ">= 1");
    require(sample.smallest() >= low, "smallest value", sample.smallest(), ">= the lower end");
    require(sample.largest() <= high, "largest value", sample.largest(), "<= the upper end");
    width_ = (high - low) / static_cast<double>(classes);
    for (const double x : sample.values())
      ++counts_[std::min(classes - 1, static_cast<std::size_t>((x - low) / width_))];
  }
  /// With classes of the width 3.49 s / n^(1/3), from the smallest to the largest value.
  /// Source: Scott (1979), Biometrika 66.
  /// @throws InvalidInput  fewer than two values, or all equal
  [[nodiscard]] static Histogram of(const Sample& sample) {
    const double range = sample.largest() - sample.smallest();
    require(range > 0, "range of the sample", range, "> 0");
    const double width = 3.49 * sample.deviation() / std::cbrt(static_cast<double>(sample.size()));
    return {sample, sample.smallest(), sample.largest(),
            std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(range / width)))};
  }

  [[nodiscard]] const std::vector<std::size_t>& counts() const { return counts_; }
  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double middle(std::size_t k) const {
    return low_ + (static_cast<double>(k) + 0.5) * width_;
  }
  /// Relative frequency over the width: comparable with a probability density.
  [[nodiscard]] double density(std::size_t k) const {
    return static_cast<double>(counts_[k]) / (static_cast<double>(size_) * width_);
  }

 private:
  double low_, width_ = 0;
  std::vector<std::size_t> counts_;
  std::size_t size_;
};

}  // namespace voussoir
