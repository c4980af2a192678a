// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/statistics/confidence.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

// The statistics of joints are known, not the joints: a design is judged by what it does in several
// realisations of the rock. Needs Boost.Math, as statistics/ do.

/// Which realisations, and by how many threads.
struct RealisationSettings {
  int count = 5;                 ///< 1 to 1000
  std::uint64_t first_seed = 1;  ///< the seeds count on from here
  unsigned threads = 1;          ///< at most
};

/// Runs the same design in every realisation of the rock, side by side.
///
/// @param run       run(seed): what came of it, of any type with a default constructor; called once
///                  for each seed, from several threads: must not share mutable state
/// @param progress  after each, with the part that is done; returns false to stop
/// @return  one for every seed, in their order; whatever the number of threads
/// @throws InvalidInput  count out of range
/// @throws Stopped, and what `run` throws
template <class Run>
[[nodiscard]] auto realise(const RealisationSettings& settings, const Run& run,
                           const Progress& progress = {}) {
  using Outcome = std::decay_t<std::invoke_result_t<const Run&, std::uint64_t>>;
  require(settings.count >= 1 && settings.count <= 1000, "number of realisations", settings.count,
          "1 to 1000");
  std::vector<Outcome> outcomes(static_cast<std::size_t>(settings.count));
  std::mutex guard;
  std::size_t finished = 0;
  parallel_for(outcomes.size(), settings.threads, [&](std::size_t k) {
    outcomes[k] = run(settings.first_seed + k);
    if (!progress) return;
    const std::scoped_lock lock(guard);
    const double done = static_cast<double>(++finished) / static_cast<double>(outcomes.size());
    if (!progress(done)) throw Stopped();
  });
  return outcomes;
}

/// A quantity over the realisations of the rock. Realisations whose tunnel did not stand have none:
/// they are counted, never left out silently.
struct RealisedQuantity {
  std::vector<double> values =
      {};             ///< of the realisations that have one, in the order of their seeds
  int samples = 0;    ///< all
  int collapsed = 0;  ///< did not stand, or it is not known whether they do
  int gone = 0;       ///< stand, but the rock that the quantity is of is detached
  int shedding = 0;   ///< have a value, but pieces of rock came off first

  /// Counts a tunnel, and its value if it has one.
  /// @param fallen_measure  over all stages [m^2], [m^3]
  /// @param value           not finite: there is none
  void add(Verdict verdict, double fallen_measure, double value) {
    ++samples;
    if (verdict != Verdict::stable) {
      ++collapsed;
    } else if (!std::isfinite(value)) {
      ++gone;
    } else {
      shedding += fallen_measure > 0;
      values.push_back(value);
    }
  }
  /// The same of a report that counts all stages.
  void add(const EquilibriumReport& report, double value) {
    add(report.verdict, report.fallen_measure, value);
  }
  [[nodiscard]] bool complete() const { return static_cast<int>(values.size()) == samples; }
  /// Of those that have a value; NaN if none has.
  [[nodiscard]] double mean() const {
    return values.empty() ? std::numeric_limits<double>::quiet_NaN() : Sample(values).mean();
  }
  /// From n - 1; 0 for one value.
  [[nodiscard]] double deviation() const {
    return values.size() < 2 ? 0.0 : Sample(values).deviation();
  }
  /// In which the mean of all realisations lies, if the values are about normal. It speaks of
  /// tunnels that stand: see `collapse_interval` for how many do.
  /// @throws InvalidInput  fewer than two values, confidence not between 0 and 1
  [[nodiscard]] Interval confidence(double confidence = 0.95) const {
    require(values.size() >= 2, "realisations with a value", static_cast<double>(values.size()),
            ">= 2 for a confidence interval: compute more");
    return mean_interval(Sample(values), confidence);
  }
  /// Part that did not stand [-]. @pre a tunnel was added
  [[nodiscard]] double collapse_share() const {
    return static_cast<double>(collapsed) / static_cast<double>(samples);
  }
  /// In which the probability of that lies: none of five seen may still be one in two.
  /// @throws InvalidInput  nothing added, confidence not between 0 and 1
  [[nodiscard]] Interval collapse_interval(double confidence = 0.95) const {
    return probability_interval(collapsed, samples, confidence);
  }
  /// "3.17 ± 0.25 mm (5 realisations; 1 collapsed, 2 shed rock)"
  [[nodiscard]] std::string text(double scale, const std::string& unit, int digits = 3) const {
    std::string notes = std::to_string(samples) + (samples == 1 ? " realisation" : " realisations");
    if (collapsed > 0) notes += "; " + std::to_string(collapsed) + " collapsed";
    if (gone > 0) notes += "; " + std::to_string(gone) + " have lost that rock";
    if (shedding > 0) notes += "; " + std::to_string(shedding) + " shed rock";
    if (values.empty()) return "no value (" + notes + ")";
    std::string text = printed_text(scale * mean(), digits);
    if (values.size() > 1)
      text += " ± " + printed_text(scale * deviation(), std::clamp(digits - 1, 1, 2));
    return text + (unit.empty() ? "" : " " + unit) + " (" + notes + ")";
  }
};

}  // namespace voussoir
