// SPDX-License-Identifier: MIT
#include "realisations_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/distribution_picture.hpp>

#include "case_uncertainty.hpp"
#include "design_criteria.hpp"
#include "run_folder.hpp"

namespace voussoir::program {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What is counted over realisations, in an engineer's units.
struct Counted {
  const char* name;
  const char* unit;
  const Quantity* quantity;
  double scale;
  std::optional<double> limit = {};  ///< that [criteria] or a strength sets, in SI
};

/// Those that the tunnel has.
std::vector<Counted> counted_in(const CasePlan& plan, const Realised& r) {
  const CriteriaInput& criteria = plan.input().criteria;
  std::vector<Counted> all = {{"crown convergence", "mm", &r.crown, 1e3, criteria.convergence}};
  if (!plan.input().bolts.empty()) {
    all.push_back({"largest bolt force", "kN", &r.largest_bolt_force, 1e-3});
  }
  if (!plan.input().linings.empty()) {
    all.push_back({"largest lining thrust", "kN/m", &r.largest_thrust, 1e-3});
    all.push_back({"largest lining moment", "kN m/m", &r.largest_moment, 1e-3});
    if (has_lining_strength(plan.input()))
      all.push_back({"lining of its strength", "%", &r.of_lining_strength, 100,
                     criteria.utilisation.value_or(1)});
  }
  return all;
}

/// "1.72 ± 0.15 mm; mean between 1.68 and 1.76 (95 %); 90 % of the tunnels below 1.92"
std::string quantity_text(const Counted& c) {
  const Quantity& q = *c.quantity;
  if (q.values.empty()) return "no realisation has one";
  std::string text = readable_text(c.scale * q.mean());
  if (q.values.size() > 1) text += " +- " + readable_text(c.scale * q.deviation(), 2);
  text += std::string(" ") + c.unit;
  if (const auto between = q.mean_between())
    text += "; mean " + readable_text(c.scale * between->low) + " to " +
            readable_text(c.scale * between->high) + " (95 % confidence)";
  const double quantile = c.scale * q.quantile();
  text += "; " + fixed_text(100 * reported_quantile, 0) + " % quantile " +
          (std::isfinite(quantile) ? readable_text(quantile)
                                   : "none: too many realisations have no value");
  return text;
}

/// A line for every key with a distribution.
std::string uncertain_keys_text(const CasePlan& plan) {
  std::string text;
  for (const UncertainKey& key : plan.uncertain())
    text += (text.empty() ? "drawn    " : "         ") + key.key + ": " + key.written + "\n";
  return text;
}

using Json = nlohmann::ordered_json;

Json share_json(const Share& share) {
  if (share.trials == 0) return nullptr;
  const Interval between = share.interval();
  return {{"events", share.events},
          {"of", share.trials},
          {"share", share.value()},
          {"low_95", between.low},
          {"high_95", between.high}};
}

/// Of the keys with a distribution.
Json uncertain_json(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  const Influences found = influences(plan, results);
  Json keys = Json::array();
  for (const UncertainKey& key : plan.uncertain()) {
    Json correlations = Json::object();
    for (const KeyInfluence& influence : found.keys)
      if (influence.key == key.key)
        for (std::size_t k = 0; k < found.outcomes.size(); ++k)
          correlations[found.outcomes[k]] = influence.correlations[k];
    keys.push_back({{"key", key.key},
                    {"unit", key.unit},
                    {"distribution", key.written},
                    {"median", key.value_at(0.5)},
                    {"least", key.distribution.low()},
                    {"largest", key.distribution.high()},
                    {"rank_correlations", correlations}});
  }
  Json explained = Json::object();
  for (std::size_t k = 0; k < found.explained.size(); ++k)
    explained[found.outcomes[k]] = found.explained[k];
  return {{"sampling", word_of(plan.parts().sampling)},
          {"keys", keys},
          {"decided_realisations", found.realisations},
          {"rank_correlation_by_chance_95", found.keys.empty() ? Json(nullptr) : Json(found.limit)},
          {"rank_variance_explained_by_the_keys", explained}};
}

std::string realisations_json(const CasePlan& plan, const Realised& r,
                              const std::vector<TunnelResult>& results,
                              const std::vector<UnwantedEvent>& events) {
  Json quantities = Json::object();
  for (const Counted& c : counted_in(plan, r)) {
    const Quantity& q = *c.quantity;
    const Interval between = q.mean_between().value_or(Interval{none, none});
    quantities[c.name] = {{"unit", c.unit},
                          {"realisations_with_a_value", q.values.size()},
                          {"mean", c.scale * q.mean()},
                          {"deviation", c.scale * q.deviation()},
                          {"mean_low_95", c.scale * between.low},
                          {"mean_high_95", c.scale * between.high},
                          {"quantile", reported_quantile},
                          {"value_of_quantile", c.scale * q.quantile()}};
  }
  Json probabilities = Json::array();
  for (const UnwantedEvent& event : events)
    probabilities.push_back({{"event", event.what}, {"probability", share_json(event.share)}});
  const CriteriaInput& c = plan.input().criteria;
  const auto limit = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  const Json json = {
      {"schema", 1},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", plan.input().title},
      {"tunnel_id", RunId("tunnel").add(plan.input()).text()},
      {"first_seed", plan.input().model.seed},
      {"realisations", r.count},
      {"verdicts",
       {{"stable", r.whole},
        {"stable after rockfall", r.shedding},
        {"stable without its lining", r.without_lining},
        {"collapse", r.collapsed},
        {"undecided", r.undecided},
        {"failed", r.failed}}},
      {"marginal", r.marginal},
      {"supports_yielded", r.yielded},
      {"not_checked", unchecked_supports(plan.input())},
      {"rockfall_or_collapse", share_json(r.rockfall())},
      {"collapse", share_json(r.collapse())},
      {"criteria",
       {{"convergence_m", limit(c.convergence)},
        {"utilisation", limit(c.utilisation)},
        {"bolt_utilisation", limit(c.bolt_utilisation)},
        {"probability", limit(c.probability)}}},
      {"probabilities", probabilities},
      {"uncertain_keys", plan.uncertain().empty() ? Json(nullptr) : uncertain_json(plan, results)},
      {"quantities", quantities}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string realisations_svg(const CasePlan& plan, const Realised& r,
                             const std::vector<TunnelResult>& results,
                             const std::vector<UnwantedEvent>& events) {
  DistributionPicture picture;
  const std::string& title = plan.input().title;
  picture.header.title = "Realisations of the rock" + (title.empty() ? "" : ": " + title);
  picture.header.lines = {"The same design in " + std::to_string(r.count) +
                          " realisations of the rock (" + seeds_text(plan) + "): " + r.verdicts() +
                          "."};
  for (const UnwantedEvent& event : events)
    picture.header.lines.push_back(event.what + " in " + event.share.text());
  for (const Counted& c : counted_in(plan, r)) {
    const Quantity& q = *c.quantity;
    DistributionPanel panel{.name = c.name,
                            .unit = c.unit,
                            .values = q.values,
                            .realisations = static_cast<std::size_t>(q.realisations),
                            .mean_between = q.mean_between()};
    for (double& value : panel.values) value *= c.scale;
    if (panel.mean_between)
      panel.mean_between = {c.scale * panel.mean_between->low, c.scale * panel.mean_between->high};
    if (c.limit) panel.limit = c.scale * *c.limit;
    const std::size_t without = panel.realisations - q.values.size();
    if (without > 0) panel.note = std::to_string(without) + " realisations have no value";
    if (!q.values.empty())
      picture.header.key_numbers.push_back(
          {std::string("mean ") + c.name, readable_text(c.scale * q.mean()) + " " + c.unit});
    picture.panels.push_back(std::move(panel));
  }
  if (plan.uncertain().empty()) return draw_distribution_picture(picture);
  const Influences found = influences(plan, results);
  for (std::size_t k = 0; k < found.outcomes.size() && !found.keys.empty(); ++k) {
    InfluencePanel panel{found.outcomes[k], {}, {}, found.limit};
    for (const KeyInfluence& key : found.keys) {
      panel.keys.push_back(key.key);
      panel.correlations.push_back(key.correlations[k]);
    }
    const bool is_known = std::any_of(panel.correlations.begin(), panel.correlations.end(),
                                      [](double c) { return std::isfinite(c); });
    if (is_known) picture.influences.push_back(std::move(panel));
  }
  return draw_distribution_picture(picture);
}

}  // namespace

CaseOutputs realisations_outputs(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  const Realised all = realised_in(plan, results, 0);
  const std::vector<UnwantedEvent> events = unwanted_events(plan.input(), results);
  CaseOutputs outputs;
  outputs.files["realisations.csv"] = tunnels_csv(plan, results);
  outputs.files["realisations.json"] = realisations_json(plan, all, results, events);
  outputs.files["realisations.svg"] = realisations_svg(plan, all, results, events);
  std::string& out = outputs.summary;
  out = "rock     " + std::to_string(all.count) + " realisations, " + seeds_text(plan) + "\n";
  if (!plan.uncertain().empty()) out += uncertain_keys_text(plan);
  out += "verdicts " + all.verdicts() + "\n";
  for (const UnwantedEvent& event : events) out += event.what + " in " + event.share.text() + "\n";
  out += probability_text(plan.input().criteria, events) + more_realisations_text(events);
  for (const Counted& c : counted_in(plan, all)) {
    std::string name = c.name;
    name.resize(23, ' ');
    out += name + quantity_text(c) + "\n";
  }
  if (!plan.uncertain().empty()) out += influences(plan, results).text();
  out +=
      "boundary " + results.front().boundary + "\n" + strength_text(plan) + warnings_text(results);
  return outputs;
}

}  // namespace voussoir::program
