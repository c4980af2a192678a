// SPDX-License-Identifier: MIT
#include "case_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <voussoir/core/units.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/statistics/rank_correlation.hpp>

#include "design_criteria.hpp"

namespace voussoir::program {

namespace {

/// "5", "12.5", "0.31"
std::string percent(double share) { return significant_text(100 * share, 3); }

std::string padded(const std::string& text, std::size_t width) {
  std::string cell(std::max(width, text.size()), ' ');
  std::copy(text.begin(), text.end(), cell.begin());
  return cell;
}

}  // namespace

std::vector<UnwantedEvent> unwanted_events(const Input& input,
                                           std::span<const TunnelResult> results) {
  const std::vector<DesignLimit> limits = limits_of(input);
  std::vector<UnwantedEvent> events;
  for (const DesignLimit& limit : limits) events.push_back({limit.what, {}});
  UnwantedEvent any{"any of these", {}};
  for (const TunnelResult& r : results) {
    if (r.failed || r.verdict == Verdict::undecided) continue;
    bool is_any = false;
    for (std::size_t k = 0; k < limits.size(); ++k) {
      const bool happened = limits[k].is_exceeded(r);
      events[k].share.events += happened;
      ++events[k].share.trials;
      is_any = is_any || happened;
    }
    any.share.events += is_any;
    ++any.share.trials;
  }
  const CriteriaInput& c = input.criteria;
  if (c.convergence || c.utilisation || c.bolt_utilisation || c.probability) events.push_back(any);
  return events;
}

double widest_interval(std::span<const UnwantedEvent> events) {
  double width = 0;
  for (const UnwantedEvent& event : events)
    width = std::max(width, event.share.trials > 0 ? event.share.interval().width() : 1);
  return width;
}

std::string probability_text(const CriteriaInput& criteria, std::span<const UnwantedEvent> events) {
  if (!criteria.probability || events.empty()) return "";
  const double most = *criteria.probability;
  const Share& share = events.back().share;
  const std::string asked = "criteria.probability = " + percent(most) + " % ";
  if (share.trials == 0) return asked + "is not known to be kept: no realisation is decided\n";
  const Interval between = share.interval();
  std::string said(1, ' ');
  said.append(percent(between.low)).append(" to ").append(percent(between.high)).append(" %");
  if (between.high <= most) return asked + "is kept with 95 % confidence:" + said + "\n";
  if (between.low > most) return asked + "is not kept, with 95 % confidence:" + said + "\n";
  return asked + "is not known to be kept:" + said + "; more realisations, or a better design\n";
}

std::string more_realisations_text(std::span<const UnwantedEvent> events) {
  const auto widest =
      std::max_element(events.begin(), events.end(), [](const auto& a, const auto& b) {
        return widest_interval({&a, 1}) < widest_interval({&b, 1});
      });
  if (widest == events.end() || widest->share.trials == 0) return "";
  const Share& share = widest->share;
  const double width = share.interval().width();
  std::string text =
      "widest interval: " + percent(width) + " percentage points (" + widest->what + ")";
  bool is_first = true;
  for (const double wanted : {0.2, 0.1, 0.05, 0.02}) {
    if (wanted > 0.8 * width) continue;
    text += (is_first ? "; " : ", ") + percent(wanted) +
            (is_first ? " would take about " : " about ") +
            std::to_string(trials_for_width(share.events, share.trials, wanted)) +
            (is_first ? " realisations" : "");
    if (!is_first) break;
    is_first = false;
  }
  return text + "\n";
}

Influences influences(const CasePlan& plan, std::span<const TunnelResult> results) {
  struct Outcome {
    const char* name;
    double (*value)(const TunnelResult&);
  };
  std::vector<Outcome> outcomes{
      {"crown convergence", [](const TunnelResult& r) { return ranked(r, r.convergence.crown); }}};
  if (!plan.input().bolts.empty())
    outcomes.push_back({"largest bolt force", [](const TunnelResult& r) {
                          return ranked(r, r.demand.largest_bolt_force);
                        }});
  if (has_lining_strength(plan.input()))
    outcomes.push_back({"lining utilisation",
                        [](const TunnelResult& r) { return ranked(r, r.of_lining_strength); }});
  outcomes.push_back({"detached area", [](const TunnelResult& r) { return ranked(r, r.fallen); }});

  const std::size_t keys = plan.uncertain().size();
  std::vector<std::vector<double>> drawn(keys), values(outcomes.size());
  Influences found;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const TunnelResult& r = results[k];
    if (r.failed || r.verdict == Verdict::undecided) continue;
    const Case the_case = plan.at(k);
    for (std::size_t key = 0; key < keys; ++key) drawn[key].push_back(the_case.drawn[key]);
    for (std::size_t o = 0; o < outcomes.size(); ++o) values[o].push_back(outcomes[o].value(r));
    ++found.realisations;
  }
  for (const Outcome& outcome : outcomes) found.outcomes.emplace_back(outcome.name);
  if (found.realisations < Influences::least_realisations) return found;
  found.limit = rank_correlation_limit(found.realisations);
  for (std::size_t key = 0; key < keys; ++key) {
    KeyInfluence& influence = found.keys.emplace_back();
    influence.key = plan.uncertain()[key].key;
    for (const std::vector<double>& value : values)
      influence.correlations.push_back(rank_correlation(drawn[key], value));
  }
  for (const std::vector<double>& value : values)
    found.explained.push_back(rank_variance_explained(drawn, value));
  const auto largest = [](const KeyInfluence& influence) {
    double most = 0;
    for (const double c : influence.correlations)
      if (std::isfinite(c)) most = std::max(most, std::abs(c));
    return most;
  };
  std::stable_sort(found.keys.begin(), found.keys.end(),
                   [&](const auto& a, const auto& b) { return largest(a) > largest(b); });
  return found;
}

std::string Influences::text() const {
  if (realisations < least_realisations)
    return "measure next: not known of fewer than " + std::to_string(least_realisations) +
           " realisations that are decided\n";
  std::string out = "measure next: rank correlations of " + std::to_string(realisations) +
                    " realisations; those beyond +-" + fixed_text(limit, 2) +
                    " (*) are not by chance (95 % confidence)\n";
  std::size_t width = 22;
  for (const KeyInfluence& key : keys) width = std::max(width, key.key.size() + 2);
  out += padded("", width);
  for (const std::string& outcome : outcomes) out += padded(outcome, 20);
  while (out.ends_with(' ')) out.pop_back();
  out += "\n";
  for (const KeyInfluence& key : keys) {
    std::string line = padded(key.key, width);
    for (const double c : key.correlations) {
      std::string cell = !std::isfinite(c) ? "-" : c < 0 ? "" : "+";
      if (std::isfinite(c)) cell.append(fixed_text(c, 2)).append(std::abs(c) > limit ? " *" : "");
      line += padded(cell, 20);
    }
    while (line.ends_with(' ')) line.pop_back();
    out += line + "\n";
  }
  std::string line = padded("explained by the keys", width);
  for (const double part : explained)
    line += padded(std::isfinite(part) ? percent(std::max(0.0, part)) + " %" : "-", 20);
  while (line.ends_with(' ')) line.pop_back();
  return out + line + "\n";
}

}  // namespace voussoir::program
