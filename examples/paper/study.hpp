// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "design_case.hpp"

namespace voussoir::paper {

/// A quantity over the realisations of the rock. Realisations whose tunnel did not stand have none:
/// they are counted, never left out silently.
struct Measured {
  std::vector<double> values =
      {};             ///< of the realisations that have one, in the order of their seeds
  int samples = 0;    ///< all
  int collapsed = 0;  ///< did not stand
  int gone = 0;       ///< stand, but the rock that the quantity is of is detached
  int shedding = 0;   ///< have a value, but pieces of rock came off first

  /// Counts an outcome, and its value if it has one.
  void add(const Outcome& outcome, double value);
  [[nodiscard]] bool complete() const { return static_cast<int>(values.size()) == samples; }
  [[nodiscard]] double mean() const;       ///< NaN if none stands
  [[nodiscard]] double deviation() const;  ///< from n - 1; 0 for one value
  /// "3.17 ± 0.25 mm (5 realisations; 1 collapsed, 2 shed rock)"
  [[nodiscard]] std::string text(double scale, const std::string& unit, int digits = 3) const;
};

/// The same tunnels in the same realisations of the rock, whoever asks: every variant is computed
/// once, all its realisations side by side on all threads.
class Study {
 public:
  /// Called with what is done and how far it is; returns false to stop.
  using Progress = std::function<bool(const std::string& what, double fraction)>;
  /// @param realisations  of the rock mass, seeds 1, 2, ..., >= 1
  Study(int samples, unsigned threads, Progress progress = {});

  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] unsigned threads() const { return threads_; }
  [[nodiscard]] bool progress(const std::string& what, double fraction) const {
    return !progress_ || progress_(what, fraction);
  }

  /// Computes those that are missing.
  /// @throws Stopped  if the progress says so
  void prepare(const std::vector<Variant>& variants);
  /// One outcome a realisation, by seed.
  [[nodiscard]] const std::vector<Outcome>& of(const Variant& variant);
  /// A number of each outcome that stands.
  [[nodiscard]] Measured measure(const Variant& variant,
                                 const std::function<double(const Outcome&)>& quantity);
  [[nodiscard]] std::size_t tunnels_solved() const { return solved_; }

  struct Stopped {};

 private:
  /// What the rock before support depends on.
  using RockKey = std::tuple<std::uint64_t, double, double, Way, Extent>;
  [[nodiscard]] static RockKey rock_of(std::uint64_t seed, const Variant& variant) {
    return {seed, variant.k0, variant.friction, variant.way, variant.extent};
  }

  int samples_;
  unsigned threads_;
  Progress progress_;
  std::map<Variant, std::vector<Outcome>> done_;
  std::map<RockKey, ExcavatedRock> rocks_;
  std::size_t solved_ = 0;
};

}  // namespace voussoir::paper
