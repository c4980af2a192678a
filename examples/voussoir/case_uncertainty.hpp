// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "case_plan.hpp"
#include "case_statistics.hpp"

/// What realisations say of the questions that an engineer signs for: how likely each unwanted
/// event is, how sure that is, and which of the keys that are not known decides it.
namespace voussoir::program {

/// How often something unwanted happens.
struct UnwantedEvent {
  std::string what;  ///< "crown convergence above 20 mm"
  Share share;       ///< of the realisations that are decided
};

/// That rock falls, that the tunnel collapses, that supports whose strength is given carry more
/// than [criteria] allow, or than their strength, that the convergence is above its limit; last,
/// where [criteria] say something, any of these. A tunnel that collapses, or whose value is lost
/// with the rock it is of, counts as beyond every limit.
[[nodiscard]] std::vector<UnwantedEvent> unwanted_events(const Input& input,
                                                         std::span<const TunnelResult> results);

/// The widest interval of them [-]; 1 where nothing is decided.
[[nodiscard]] double widest_interval(std::span<const UnwantedEvent> events);

/// Whether the last of them keeps criteria.probability with 95 % confidence, a sentence; empty: it
/// is not given.
[[nodiscard]] std::string probability_text(const CriteriaInput& criteria,
                                           std::span<const UnwantedEvent> events);

/// How many realisations would make the widest interval narrower, a line.
[[nodiscard]] std::string more_realisations_text(std::span<const UnwantedEvent> events);

/// An uncertain key and what hangs on it.
struct KeyInfluence {
  std::string key;
  /// Rank correlations with the outcomes, in their order [-]; not a number: they are all equal.
  std::vector<double> correlations;
};

/// What to measure next.
struct Influences {
  std::vector<std::string> outcomes;  ///< "crown convergence", ...
  std::vector<KeyInfluence> keys;     ///< the one with the largest correlation first
  std::vector<double> explained;      ///< of every outcome, see `rank_variance_explained`
  std::size_t realisations = 0;       ///< that are decided
  double limit = 1;                   ///< see `rank_correlation_limit`

  /// Lines of a table for a terminal.
  [[nodiscard]] std::string text() const;
};

/// @pre  results are of all cases of the plan, which has keys with a distribution
[[nodiscard]] Influences influences(const CasePlan& plan, std::span<const TunnelResult> results);

}  // namespace voussoir::program
