// SPDX-License-Identifier: MIT
#pragma once

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
  /// Of the most that comes off [-]: less is slivers, more another fall (docs/decisions.md).
  static constexpr double slivers = 0.1;

  double low = 0, high = 0;        ///< detached, over the five [m^2], [m^3]
  bool has_other_verdict = false;  ///< one of them stands and another does not, or is undecided
  bool is_collapse = false;        ///< the stage; it is ended wherever its limit is passed, so how
                                   ///< much comes off says nothing
  /// The verdict hangs on what counts as a collapse (`Acceptance::collapse_measure`): more than 0.9
  /// of it has come off and the rest stands, or less than 1.1 of it had come off when the rest
  /// would have come to rest. Asked for with `RangeSought::all` alone.
  bool is_near_collapse = false;

  [[nodiscard]] bool is_marginal() const {
    return has_other_verdict || (!is_collapse && high - low > slivers * high);
  }
  /// Of two stages, one after the other.
  void add(const RockfallRange& next) {
    low += next.low;
    high += next.high;
    has_other_verdict = has_other_verdict || next.has_other_verdict;
    is_collapse = is_collapse || next.is_collapse;
    is_near_collapse = is_near_collapse || next.is_near_collapse;
  }
};

}  // namespace voussoir
