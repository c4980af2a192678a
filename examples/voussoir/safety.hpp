// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>
#include <voussoir/design/factor_of_safety.hpp>

#include "analysis.hpp"
#include "limit_answer.hpp"

/// By how much the strength of joints may be divided until an input falls: `voussoir safety`.
namespace voussoir::program {

/// What one factor came to.
struct SafetyTrial {
  double factor = 0;
  TrialOutcome outcome = TrialOutcome::undecided;
  std::string word;    ///< the verdict
  std::string reason;  ///< of it, a sentence
  double fallen = 0;   ///< rock that came off, per metre of tunnel [m^2]
  double crown = std::numeric_limits<double>::quiet_NaN();  ///< convergence [m]; laid blocks: none
  /// It stands, and counts as one that falls because a support is at its strength.
  bool is_of_support = false;
};

/// A tunnel in 2-D or 3-D, or laid blocks.
struct SafetyAnswer {
  FactorBracket bracket;
  std::vector<SafetyTrial> trials;  ///< in the order in which they were made
  double fallen = 0;                ///< of the mechanism: detached [m^2], 3-D [m^3]
  std::string unit = "m2";
  std::string mechanism;  ///< a picture of what falls; empty: nothing does
  LimitAnswer limit;      ///< a bound by another method
  std::vector<std::string> warnings;
  double seconds = 0;

  /// "1.24: stands over 1.241, falls over 1.253" (or what else ends there), or which end there is
  /// none of.
  [[nodiscard]] std::string text() const;
  /// The factor under which it does not stand was not decided, and counts as one that falls.
  [[nodiscard]] bool is_undecided() const;
};

/// @param wants_limit  whether the bound by limit analysis is sought, too
/// @throws InvalidInput  the strength of a joint law cannot be divided; as `run_of`
/// @throws Stopped
[[nodiscard]] SafetyAnswer safety_of(const Input& input, const SafetySettings& settings,
                                     bool wants_limit, const Report& report);

/// Lines for a terminal.
[[nodiscard]] std::string safety_text(const SafetySettings& settings, const SafetyAnswer& answer);
[[nodiscard]] std::string safety_json(const Input& input, const SafetySettings& settings,
                                      const SafetyAnswer& answer);
/// One row per trial.
[[nodiscard]] std::string safety_csv(const SafetyAnswer& answer);

}  // namespace voussoir::program
