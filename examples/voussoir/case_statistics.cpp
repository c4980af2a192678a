// SPDX-License-Identifier: MIT
#include "case_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/statistics/latin_mean.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir::program {

namespace {
constexpr double none = std::numeric_limits<double>::quiet_NaN();

void add(Quantity& quantity, bool has_value, double value) {
  ++quantity.realisations;
  if (has_value && std::isfinite(value)) quantity.values.push_back(value);
}
}  // namespace

std::string Share::text() const {
  if (trials == 0) return "not known: no realisation is decided";
  const Interval between = interval();
  return readable_text(100 * value()) + " % (" + std::to_string(events) + " of " +
         std::to_string(trials) + "; 95 % confidence: " + readable_text(100 * between.low, 2) +
         " to " + readable_text(100 * between.high, 2) + " %)";
}

double Quantity::mean() const { return values.empty() ? none : Sample(values).mean(); }
double Quantity::deviation() const { return values.size() < 2 ? none : Sample(values).deviation(); }
std::optional<Interval> Quantity::mean_between() const {
  if (by_points) return by_points;
  if (values.size() < 2) return std::nullopt;
  return mean_interval(Sample(values));
}
double Quantity::quantile(double part) const {
  if (realisations == 0) return none;
  const double at = part * (realisations - 1);
  const auto low = static_cast<std::size_t>(std::floor(at)),
             high = static_cast<std::size_t>(std::ceil(at));
  if (high >= values.size()) return none;
  const std::vector<double> sorted = Sample(values).values();
  return sorted[low] + (at - std::floor(at)) * (sorted[high] - sorted[low]);
}

Realised::Realised(std::span<const TunnelResult> results) {
  for (const TunnelResult& r : results) {
    ++count;
    marginal += r.marginal;
    failed += r.failed;
    const bool stands = !r.failed && r.verdict == Verdict::stable;
    yielded += stands && r.has_yielded();
    undecided += !r.failed && r.verdict == Verdict::undecided;
    collapsed += !r.failed && r.verdict == Verdict::collapse;
    whole += stands && r.is_whole();
    without_lining += stands && r.lost_lining;
    shedding += stands && !r.lost_lining && r.fallen > 0;
    add(crown, stands, r.convergence.crown);
    add(largest_bolt_force, stands, r.demand.largest_bolt_force);
    add(mean_bolt_force, stands, r.demand.mean_bolt_force);
    add(largest_thrust, stands, r.demand.largest_thrust);
    add(largest_moment, stands, r.demand.largest_moment);
    add(of_lining_strength, stands, r.of_lining_strength);
  }
}

Realised::Realised(std::span<const TunnelResult> results,
                   std::span<const std::vector<double>> points)
    : Realised(results) {
  // Where every tenth has as many points, and no value is missing.
  constexpr int even = 10;
  if (points.empty() || count % even != 0) return;
  for (Quantity* const q :
       {&crown, &largest_bolt_force, &mean_bolt_force, &largest_thrust, &largest_moment})
    if (static_cast<int>(q->values.size()) == count)
      q->by_points = latin_mean_interval(points, q->values);
}

std::string Realised::verdicts() const {
  std::string text;
  const auto say = [&](int number, const char* word) {
    if (number > 0) text += (text.empty() ? "" : ", ") + std::to_string(number) + " " + word;
  };
  say(whole, "stable");
  say(shedding, "stable after rockfall");
  say(without_lining, "stable without lining");
  say(collapsed, "collapse");
  say(undecided, "undecided");
  say(failed, "failed");
  if (marginal > 0) text += "; " + std::to_string(marginal) + " of these marginal";
  if (yielded > 0)
    text += "; " + std::to_string(yielded) + " of those that stand with supports at their strength";
  return text;
}

}  // namespace voussoir::program
