// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace voussoir {

/// How much rock comes off in a stage that is followed in motion, and how much more or less it is
/// with half and with twice the displacement limit, and with the walls unloaded at half the rate
/// from where blocks begin to move. Where these differ the rock is marginal by nature, and no
/// single figure is its answer.
struct RockfallRange {
  double low = 0, high = 0;        ///< detached, over the four [m^2], [m^3]
  bool has_other_verdict = false;  ///< one of them stands and another does not, or is undecided
  /// A difference below it says nothing [m^2], [m^3]: a mean block. Of a collapse none does, which
  /// ends at whatever moment its limit is passed.
  double scale = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_marginal() const {
    return has_other_verdict || high - low > std::max(0.1 * high, scale);
  }
  /// Of two stages, one after the other.
  void add(const RockfallRange& next) {
    low += next.low;
    high += next.high;
    has_other_verdict = has_other_verdict || next.has_other_verdict;
    scale = std::max(scale, next.scale);
  }
};

}  // namespace voussoir
