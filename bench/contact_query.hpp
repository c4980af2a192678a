// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "contact_workload.hpp"

/// What the contact benchmarks ask of every library, how they time it and how they judge it.
namespace voussoir_bench {

/// What a library says of one pair.
struct Answer {
  bool touch = false;              ///< its own decision
  bool failed = false;             ///< it reports that it could not tell
  bool has_separation = false;     ///< it gives a separation
  int points = 0;                  ///< contact points
  double separation = 0;           ///< < 0: depth of the overlap [m]
  std::array<double, 3> normal{};  ///< from a to b
};

/// One question asked of all pairs of a workload.
struct Query {
  std::string peer;        ///< library and function
  std::string precision;   ///< "f64" or "f32"
  std::string operation;   ///< "bool", "depth" (and normal), "manifold" (depth and contact points)
  bool warm = false;       ///< uses what it found for the same pair in the pass before
  std::size_t stride = 1;  ///< slow ones visit every `stride`-th pair
  /// Asks at the places of `step`, pairs in the order of the workload; fills answers[k] of the
  /// pairs visited, if given. Returns a number that depends on all answers, so that none is left
  /// out.
  std::function<double(int step, std::vector<Answer>* answers)> pass{};

  [[nodiscard]] std::size_t visited(std::size_t pairs) const {
    return (pairs + stride - 1) / stride;
  }
  /// "peer/operation/cold/workload", e.g. to choose by.
  [[nodiscard]] std::string label(const std::string& workload) const {
    return peer + "/" + operation + (warm ? "/warm/" : "/cold/") + workload;
  }
};

/// A query whose pass calls `ask(k, pair, answer)` for every `stride`-th pair k, where `ask` is
/// what `begin(step)` returns and `answer` may be null; `ask` returns a number that depends on the
/// answer.
template <class Begin>
[[nodiscard]] Query query_over(const std::vector<CandidatePair>& pairs, Query described,
                               Begin begin) {
  described.pass = [&pairs, stride = described.stride, begin = std::move(begin)](
                       int step, std::vector<Answer>* answers) {
    auto ask = begin(step);
    double sum = 0;
    for (std::size_t k = 0; k < pairs.size(); k += stride)
      sum += ask(k, pairs[k], answers != nullptr ? &(*answers)[k] : nullptr);
    return sum;
  };
  return described;
}

/// The queries of the library that a program measures, defined in the one file of it that knows
/// that library. The workload must outlive them.
[[nodiscard]] std::vector<Query> queries(const Workload<2>& workload);
[[nodiscard]] std::vector<Query> queries(const Workload<3>& workload);
/// How library and caller were compiled.
extern const char* const build_description;

/// Times of whole passes over all pairs.
struct Timing {
  double median = 0, least = 0;  ///< [s]
  std::size_t passes = 0;
};

/// One pass that is not timed, then passes that alternate between the two steps, so that a warm
/// start never sees an unchanged place; 5 to 41 of them, until `budget` seconds are spent.
[[nodiscard]] Timing time_passes(const Query& query, double budget);

/// Answers at step 0, after having been at step 1.
[[nodiscard]] std::vector<Answer> answers_of(const Query& query, std::size_t pairs);

/// Answers against the exact ones.
struct Accuracy {
  std::size_t invented = 0, missed = 0;                  ///< wrong decisions
  std::size_t invented_clearly = 0, missed_clearly = 0;  ///< of these, by more than 10 um
  std::size_t failed = 0;      ///< it says so, or gives a separation that is no number
  std::size_t both_touch = 0;  ///< pairs whose depth is compared: touching in truth and by answer
  double depth_error_median = 0, depth_error_p99 = 0, depth_error_max = 0;  ///< [m]; -1: none given
  std::size_t depth_error_over_10um = 0, depth_error_over_1mm = 0;
  std::ptrdiff_t worst_pair = -1;                        ///< of the largest depth error
  double normal_error_median = 0, normal_error_p99 = 0;  ///< [degrees]; -1: no normal
  double points_mean = 0;                                ///< contact points of a touching pair
  std::size_t sliver_pairs = 0;  ///< pairs with a block thinner than 5 % of its diameter
  std::size_t sliver_wrong = 0;  ///< of these, decided wrong by 10 um or deep wrong by 1 mm
};

template <int Dim>
[[nodiscard]] Accuracy judge(const std::vector<Answer>& answers, const Query& query,
                             const Workload<Dim>& workload);

extern template Accuracy judge<2>(const std::vector<Answer>&, const Query&, const Workload<2>&);
extern template Accuracy judge<3>(const std::vector<Answer>&, const Query&, const Workload<3>&);

}  // namespace voussoir_bench
