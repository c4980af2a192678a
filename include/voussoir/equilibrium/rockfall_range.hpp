// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace voussoir {

/// How much rock comes off in a stage that is followed in motion, and how much more or less it is
/// with half and with three times the displacement limit, and, from where blocks begin to move,
/// with local damping of 0.7 besides dashpots and with the walls unloaded at half the rate. Where
/// these differ the rock is marginal by nature, and no single figure is its answer.
///
/// What they are was chosen by holding them against all blocks in motion, varied from the beginning
/// on: docs/failure-patterns.md has how many marginal tunnels they find.
struct RockfallRange {
  static constexpr double near_collapse = 0.1;  ///< of what counts as a collapse [-]

  double low = 0, high = 0;        ///< detached, over the five [m^2], [m^3]
  bool has_other_verdict = false;  ///< one of them stands and another does not, or is undecided
  /// A difference below it says nothing [m^2], [m^3]: a mean block. Of a collapse none does, which
  /// ends at whatever moment its limit is passed.
  double scale = std::numeric_limits<double>::infinity();
  /// The verdict hangs on what counts as a collapse (`Acceptance::collapse_measure`): more than 0.9
  /// of it has come off and the rest stands, or less than 1.1 of it had come off when the rest
  /// would have come to rest. Asked for with `RangeSought::all` alone.
  bool is_near_collapse = false;

  [[nodiscard]] bool is_marginal() const {
    return has_other_verdict || high - low > std::max(0.1 * high, scale);
  }
  /// Of two stages, one after the other.
  void add(const RockfallRange& next) {
    low += next.low;
    high += next.high;
    has_other_verdict = has_other_verdict || next.has_other_verdict;
    scale = std::max(scale, next.scale);
    is_near_collapse = is_near_collapse || next.is_near_collapse;
  }
};

}  // namespace voussoir
