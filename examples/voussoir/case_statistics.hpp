// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include <voussoir/statistics/confidence.hpp>

#include "analysis.hpp"

/// The same design in several realisations of the rock: shares of what became of it, and its
/// numbers.
namespace voussoir::program {

inline constexpr double reported_quantile = 0.9;

/// Part of the realisations in which something happened.
struct Share {
  int events = 0, trials = 0;
  [[nodiscard]] double value() const { return static_cast<double>(events) / trials; }
  /// Of the probability, 95 %. See `probability_interval`.
  [[nodiscard]] Interval interval() const { return probability_interval(events, trials); }
  /// "6 % (3 of 50; 95 % confidence: 1.3 to 16.5 %)"
  [[nodiscard]] std::string text() const;
};

/// A number over those realisations that have one.
struct Quantity {
  std::vector<double> values = {};  ///< in the order of the seeds, finite
  int realisations = 0;             ///< all, those without a value too
  /// Of the mean, 95 %, where the points of a Latin hypercube make it surer than n independent
  /// values would: see `latin_mean_interval`.
  std::optional<Interval> by_points = {};

  [[nodiscard]] double mean() const;       ///< not a number if none has a value
  [[nodiscard]] double deviation() const;  ///< from n - 1; not a number of fewer than two
  /// Of the mean, 95 %: `by_points`, or Student's; nothing of fewer than two values.
  [[nodiscard]] std::optional<Interval> mean_between() const;
  /// Of all realisations, where one without a value counts as worse than any: not a number where
  /// it lies among those. Linear between the sorted values.
  /// @param part  0 to 1
  [[nodiscard]] double quantile(double part = reported_quantile) const;
};

/// What became of a design.
struct Realised {
  int count = 0;
  int whole = 0, shedding = 0, without_lining = 0, collapsed = 0, undecided = 0, failed = 0;
  int marginal = 0;  ///< of any of these (`TunnelResult::marginal`)
  int yielded = 0;   ///< of those that stand: with supports at their strength
  Quantity crown, largest_bolt_force, mean_bolt_force, largest_thrust, largest_moment,
      of_lining_strength;  ///< SI

  explicit Realised(std::span<const TunnelResult> results);
  /// @param points  of a Latin hypercube at which they were computed: a list of values for each key
  Realised(std::span<const TunnelResult> results, std::span<const std::vector<double>> points);
  /// Stable after rockfall, and collapses: of those decided.
  [[nodiscard]] Share rockfall() const { return {shedding + collapsed, decided()}; }
  [[nodiscard]] Share collapse() const { return {collapsed, decided()}; }
  [[nodiscard]] int decided() const { return count - undecided - failed; }
  /// "47 stable, 2 stable after rockfall, 1 collapse; 2 of these marginal; 3 of those that stand
  /// with supports at their strength"
  [[nodiscard]] std::string verdicts() const;
};

}  // namespace voussoir::program
