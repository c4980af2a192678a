// SPDX-License-Identifier: MIT
#include "contact_query.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace voussoir_bench {

namespace {

volatile double kept;  // what a pass returns ends here, so that the pass must be made

/// The value that a share of the numbers does not exceed; -1 without numbers. Reorders them.
double quantile(std::vector<double>& numbers, double share) {
  if (numbers.empty()) return -1;
  const auto count = static_cast<double>(numbers.size());
  const auto rank = std::min(numbers.size() - 1, static_cast<std::size_t>(share * count));
  const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(numbers.begin(), at, numbers.end());
  return *at;
}

/// Angle between two vectors of any length [degrees]; good near 0, where acos is not.
double angle(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double cross =
      std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  return std::atan2(cross, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / std::numbers::pi;
}

}  // namespace

Timing time_passes(const Query& query, double budget) {
  constexpr std::size_t at_least = 5, at_most = 41;
  using Clock = std::chrono::steady_clock;
  kept = query.pass(0, nullptr);
  std::vector<double> times;
  double spent = 0;
  while (times.size() < at_least || (spent < budget && times.size() < at_most)) {
    const int step = times.size() % 2 == 0 ? 1 : 0;
    const auto start = Clock::now();
    kept = query.pass(step, nullptr);
    times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    spent += times.back();
  }
  const double least = *std::min_element(times.begin(), times.end());
  return {quantile(times, 0.5), least, times.size()};
}

std::vector<Answer> answers_of(const Query& query, std::size_t pairs) {
  std::vector<Answer> answers(pairs);
  kept = query.pass(1, nullptr);
  kept = query.pass(0, &answers);
  return answers;
}

template <int Dim>
Accuracy judge(const std::vector<Answer>& answers, const Query& query,
               const Workload<Dim>& workload) {
  Accuracy result;
  std::vector<double> depth_errors, normal_errors;
  std::size_t touching = 0, points = 0;
  for (std::size_t k = 0; k < workload.pairs.size(); k += query.stride) {
    const CandidatePair& truth = workload.pairs[k];
    const Answer& answer = answers[k];
    if (answer.failed || std::isnan(answer.separation)) {
      ++result.failed;
      continue;
    }
    bool wrong = false;
    const bool touch = truth.separation<0, clearly = std::abs(truth.separation)> 1e-5;
    if (answer.touch && !touch) {
      ++result.invented;
      wrong = clearly;
      if (clearly) ++result.invented_clearly;
    }
    if (!answer.touch && touch) {
      ++result.missed;
      wrong = clearly;
      if (clearly) ++result.missed_clearly;
    }
    if (answer.touch && touch) {
      ++touching;
      points += static_cast<std::size_t>(answer.points);
      if (answer.has_separation) {
        const double error = std::abs(answer.separation - truth.separation);
        depth_errors.push_back(error);
        if (error >= result.depth_error_max) {
          result.depth_error_max = error;
          result.worst_pair = static_cast<std::ptrdiff_t>(k);
        }
        if (error > 1e-5) ++result.depth_error_over_10um;
        if (error > 1e-3) {
          ++result.depth_error_over_1mm;
          wrong = true;
        }
        if (answer.normal != std::array<double, 3>{})
          normal_errors.push_back(angle(answer.normal, truth.normal));
      }
    }
    if (workload.slenderness(truth) < 0.05) {
      ++result.sliver_pairs;
      if (wrong) ++result.sliver_wrong;
    }
  }
  result.both_touch = depth_errors.size();
  if (depth_errors.empty()) result.depth_error_max = -1;
  result.depth_error_median = quantile(depth_errors, 0.5);
  result.depth_error_p99 = quantile(depth_errors, 0.99);
  result.normal_error_median = quantile(normal_errors, 0.5);
  result.normal_error_p99 = quantile(normal_errors, 0.99);
  if (touching > 0)
    result.points_mean = static_cast<double>(points) / static_cast<double>(touching);
  return result;
}

template Accuracy judge<2>(const std::vector<Answer>&, const Query&, const Workload<2>&);
template Accuracy judge<3>(const std::vector<Answer>&, const Query&, const Workload<3>&);

}  // namespace voussoir_bench
