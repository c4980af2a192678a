// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>
#include <voussoir/design/realisations.hpp>

#include "design_case.hpp"
#include "stored_cases.hpp"

namespace voussoir::paper {

using Measured = RealisedQuantity;

/// The same tunnels in the same realisations of the rock, whoever asks: every variant is computed
/// once, all its realisations side by side on all threads.
class Study {
 public:
  /// Called with what is done and how far it is; returns false to stop.
  using Progress = std::function<bool(const std::string& what, double fraction)>;
  /// @param realisations  of the rock mass, seeds 1, 2, ..., >= 1
  /// @param store  where finished tunnels are kept; none: nowhere
  Study(int samples, unsigned threads, Progress progress = {}, CaseStore store = {});

  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] unsigned threads() const { return threads_; }
  /// For what an analysis computes of each realisation itself.
  [[nodiscard]] RealisationSettings realisations() const {
    return {.count = samples_, .threads = threads_};
  }
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
  [[nodiscard]] const CaseStore& store() const { return store_; }

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
  CaseStore store_;
  std::map<Variant, std::vector<Outcome>> done_;
  std::map<RockKey, ExcavatedRock> rocks_;
  std::size_t solved_ = 0;
};

}  // namespace voussoir::paper
