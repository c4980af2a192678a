// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir {

/// The smallest of ..., 0.5, 1, 2, 5, 10, ... that is not below `value` (> 0; else 1).
[[nodiscard]] VOUSSOIR_INLINE double round_up_125(double value);

/// The largest of ..., 0.5, 1, 2, 5, 10, ... that is not above `value` (> 0; else 1).
[[nodiscard]] inline double round_down_125(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double up = round_up_125(value);
  if (up <= value * (1 + 1e-9)) return up;
  const double leading = up / std::pow(10.0, std::floor(std::log10(up * (1 + 1e-9))));
  return leading > 4 ? up / 2.5 : up / 2;  // 5 -> 2, 2 -> 1, 10 -> 5
}

/// Round numbers on an axis: multiples of 1, 2 or 5 times a power of ten.
struct RoundTicks {
  double step = 1;
  std::vector<double> values;  ///< ascending, inside the range

  /// The tick with as many decimals as the step needs.
  [[nodiscard]] std::string label(double value) const {
    const int decimals = static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
    return fixed_text(value, std::max(0, decimals));
  }
};

/// @param count  about how many intervals; never more
/// @return       ticks in [low, high]; none if the range is empty or not finite
[[nodiscard]] VOUSSOIR_INLINE RoundTicks round_ticks(double low, double high, int count);

/// Round levels for contours, the first at or below `low`, the last at or above `high`.
///
/// Even steps where they serve; for values over more than a factor of 15 (an unlined tunnel
/// beside lined ones) the series 1, 2, 5, 10, since even steps would leave most of the picture one
/// colour.
/// @param count  about how many intervals
/// @return       at least two levels, ascending
[[nodiscard]] VOUSSOIR_INLINE std::vector<double> contour_levels(double low, double high,
                                                                 int count);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE double round_up_125(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double slack = 1 - 1e-9;  // 2.0000000000000004 is 2
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= value * slack) return factor * power;
  }
  return 10 * power;
}

VOUSSOIR_INLINE RoundTicks round_ticks(double low, double high, int count) {
  RoundTicks ticks;
  if (!(high > low) || !std::isfinite(high - low)) return ticks;
  ticks.step = round_up_125((high - low) / std::max(1, count));
  const double first = std::ceil(low / ticks.step - 1e-9), last = high / ticks.step + 1e-9;
  for (double k = first; k <= last; ++k) ticks.values.push_back(k * ticks.step);
  return ticks;
}

VOUSSOIR_INLINE std::vector<double> contour_levels(double low, double high, int count) {
  if (!std::isfinite(low) || !std::isfinite(high)) return {0, 1};
  if (low > 0 && high > 15 * low) {
    std::vector<double> levels = {round_down_125(low)};
    while (levels.back() < high * (1 - 1e-9)) {
      levels.push_back(round_up_125(levels.back() * 1.5));
    }
    return levels;
  }
  // Values that are all alike to a millionth are one colour, not a picture of rounding errors.
  const double spread = std::max(high - low, 1e-6 * std::max(std::abs(low), std::abs(high)));
  const double step = round_up_125(spread > 0 ? spread / std::max(1, count) : 1);
  const double first = std::floor(low / step + 1e-9);
  const double last = std::max(first + 1, std::ceil(high / step - 1e-9));
  std::vector<double> levels;
  for (double k = first; k <= last; ++k) levels.push_back(k * step);
  return levels;
}

#endif

}  // namespace voussoir
