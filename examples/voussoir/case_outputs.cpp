// SPDX-License-Identifier: MIT
#include "case_outputs.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/histogram_picture.hpp>

#include "case_statistics.hpp"
#include "case_uncertainty.hpp"
#include "diagram_outputs.hpp"

namespace voussoir::program {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A key as a column: its values as numbers with the unit in the name, where all have one unit.
struct KeyColumn {
  std::string name;
  std::vector<std::string> cells;
};

/// "_GPa_per_m" of "GPa/m".
std::string unit_suffix(const std::string& unit) {
  std::string words;
  for (const char c : unit) {
    if (c == '/')
      words += words.empty() ? "per_" : "_per_";
    else if (c == '%')
      words += "percent";
    else if (c != '^' && c != ' ')
      words += c;
  }
  return words.empty() ? "" : "_" + words;
}

KeyColumn column_of(const VariedKey& varied) {
  KeyColumn column{varied.key, varied.values};
  std::string unit;
  std::vector<std::string> numbers;
  for (const std::string& text : varied.values) {
    std::string value = text;
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{}) return column;
    const std::string digits(value.data(), static_cast<std::size_t>(end - value.data()));
    std::string rest = value.substr(digits.size());
    rest.erase(0, std::min(rest.find_first_not_of(' '), rest.size()));
    if (!numbers.empty() && rest != unit) return column;
    unit = rest;
    numbers.push_back(digits);
  }
  column.cells = numbers;
  column.name += unit_suffix(unit);
  return column;
}

/// The cells of a case under the varied keys.
std::vector<std::string> key_cells(const std::vector<KeyColumn>& columns, std::size_t combination) {
  std::vector<std::string> cells(columns.size());
  for (std::size_t k = columns.size(); k-- > 0;) {
    cells[k] = columns[k].cells[combination % columns[k].cells.size()];
    combination /= columns[k].cells.size();
  }
  return cells;
}

std::string number(double value) { return significant_text(value, 6); }

/// All realisations of one combination of varied keys.
Realised realised_in(const CasePlan& plan, const std::vector<TunnelResult>& results,
                     std::size_t combination) {
  const auto seeds = static_cast<std::size_t>(plan.parts().realisations),
             first = combination * seeds;
  std::vector<std::vector<double>> points;
  if (plan.parts().sampling == Sampling::latin)
    points.resize(plan.uncertain().size(), std::vector<double>(seeds));
  for (std::size_t key = 0; key < points.size(); ++key)
    for (std::size_t k = 0; k < seeds; ++k) points[key][k] = plan.at(first + k).drawn[key];
  return {std::span<const TunnelResult>(results).subspan(first, seeds), points};
}

std::string tunnels_csv(const CasePlan& plan, const std::vector<KeyColumn>& columns,
                        const std::vector<TunnelResult>& results) {
  std::vector<std::string> header;
  for (const KeyColumn& column : columns) header.push_back(column.name);
  for (const UncertainKey& key : plan.uncertain())
    header.push_back(key.key + unit_suffix(key.unit));
  for (const char* const name : {"seed",
                                 "verdict",
                                 "marginal",
                                 "detached_area_m2",
                                 "crown_convergence_mm",
                                 "right_springing_mm",
                                 "left_springing_mm",
                                 "invert_mm",
                                 "largest_bolt_force_kN",
                                 "mean_bolt_force_kN",
                                 "largest_thrust_kN_per_m",
                                 "mean_thrust_kN_per_m",
                                 "largest_moment_kNm_per_m",
                                 "bolt_joints_yielded",
                                 "bolt_joints_ruptured",
                                 "feet_yielded",
                                 "largest_bolt_force_of_its_strength",
                                 "bolts_governed_by",
                                 "lining_of_its_strength",
                                 "lining_governed_by",
                                 "error_estimate",
                                 "out_of_balance_force_ratio",
                                 "blocks",
                                 "reason",
                                 "warnings"})
    header.emplace_back(name);
  CsvTable table(header);
  const auto seeds = static_cast<std::size_t>(plan.parts().realisations);
  for (std::size_t k = 0; k < results.size(); ++k) {
    const TunnelResult& r = results[k];
    std::vector<std::string> cells = key_cells(columns, k / seeds);
    const Case the_case = plan.at(k);
    for (const double value : the_case.drawn) cells.push_back(shortest_text(value));
    for (const std::string& cell : {std::to_string(the_case.seed),
                                    r.word(),
                                    std::string(r.marginal ? "1" : "0"),
                                    number(r.fallen),
                                    number(1e3 * r.convergence.crown),
                                    number(1e3 * r.convergence.right_springing),
                                    number(1e3 * r.convergence.left_springing),
                                    number(1e3 * r.convergence.invert),
                                    number(1e-3 * r.demand.largest_bolt_force),
                                    number(1e-3 * r.demand.mean_bolt_force),
                                    number(1e-3 * r.demand.largest_thrust),
                                    number(1e-3 * r.demand.mean_thrust),
                                    number(1e-3 * r.demand.largest_moment),
                                    std::to_string(r.bolts_yielded),
                                    std::to_string(r.bolts_ruptured),
                                    std::to_string(r.feet_yielded),
                                    strength_cell(r.of_bolt_strength),
                                    governed_cell(r.bolts_governed_by),
                                    strength_cell(r.of_lining_strength),
                                    governed_cell(r.lining_governed_by),
                                    number(r.error_estimate),
                                    number(r.out_of_balance),
                                    std::to_string(r.blocks),
                                    r.reason,
                                    warnings_cell(r)})
      cells.push_back(cell);
    table.add_cells(cells);
  }
  return table.text();
}

std::string means_csv(const CasePlan& plan, const std::vector<KeyColumn>& columns,
                      const std::vector<TunnelResult>& results) {
  const std::string quantile = "_quantile_" + fixed_text(100 * reported_quantile, 0) + "_percent";
  std::vector<std::string> header;
  for (const KeyColumn& column : columns) header.push_back(column.name);
  for (const char* const name :
       {"realisations", "stable", "stable_after_rockfall", "stable_without_lining", "collapse",
        "undecided", "failed", "marginal", "supports_yielded", "rockfall_share",
        "rockfall_share_low_95", "rockfall_share_high_95"})
    header.emplace_back(name);
  for (const std::string quantity :
       {"crown_convergence_mm", "largest_bolt_force_kN", "mean_bolt_force_kN",
        "largest_thrust_kN_per_m", "largest_moment_kNm_per_m", "lining_of_its_strength"})
    for (const std::string& what :
         {std::string("_mean"), std::string("_deviation"), std::string("_mean_low_95"),
          std::string("_mean_high_95"), quantile})
      header.push_back(quantity + what);
  CsvTable table(header);
  const auto seeds = static_cast<std::size_t>(plan.parts().realisations);
  for (std::size_t k = 0; k * seeds < results.size(); ++k) {
    const Realised r = realised_in(plan, results, k);
    std::vector<std::string> cells = key_cells(columns, k);
    for (const int count : {r.count, r.whole, r.shedding, r.without_lining, r.collapsed,
                            r.undecided, r.failed, r.marginal, r.yielded})
      cells.push_back(std::to_string(count));
    const Share share = r.rockfall();
    const Interval shares = share.trials > 0 ? share.interval() : Interval{none, none};
    cells.push_back(number(share.trials > 0 ? share.value() : none));
    cells.push_back(number(shares.low));
    cells.push_back(number(shares.high));
    const auto add = [&](const Quantity& q, double scale) {
      const Interval between = q.mean_between().value_or(Interval{none, none});
      for (const double value : {q.mean(), q.deviation(), between.low, between.high, q.quantile()})
        cells.push_back(number(scale * value));
    };
    add(r.crown, 1e3);
    add(r.largest_bolt_force, 1e-3);
    add(r.mean_bolt_force, 1e-3);
    add(r.largest_thrust, 1e-3);
    add(r.largest_moment, 1e-3);
    add(r.of_lining_strength, 1);
    table.add_cells(cells);
  }
  return table.text();
}

/// What is counted over realisations, in an engineer's units.
struct Counted {
  const char* name;
  const char* unit;
  const Quantity* quantity;
  double scale;
};

/// Those that the tunnel has.
std::vector<Counted> counted_in(const CasePlan& plan, const Realised& r) {
  std::vector<Counted> all = {{"crown convergence", "mm", &r.crown, 1e3}};
  if (!plan.input().bolts.empty()) {
    all.push_back({"largest bolt force", "kN", &r.largest_bolt_force, 1e-3});
  }
  if (!plan.input().linings.empty()) {
    all.push_back({"largest lining thrust", "kN/m", &r.largest_thrust, 1e-3});
    all.push_back({"largest lining moment", "kN m/m", &r.largest_moment, 1e-3});
    const auto& linings = plan.input().linings;
    if (std::any_of(linings.begin(), linings.end(),
                    [](const LiningInput& lining) { return lining.concrete.has_value(); }))
      all.push_back({"lining of its strength", "%", &r.of_lining_strength, 100});
  }
  return all;
}

std::string seeds_text(const CasePlan& plan) {
  const std::uint64_t first = plan.input().model.seed;
  const int count = plan.parts().realisations;
  return count == 1 ? "seed " + std::to_string(first)
                    : "seeds " + std::to_string(first) + " to " +
                          std::to_string(first + static_cast<std::uint64_t>(count) - 1);
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
          {"rank_correlation_by_chance_95", found.limit},
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

std::string realisations_svg(const CasePlan& plan, const Realised& r) {
  HistogramPicture picture;
  const std::string& title = plan.input().title;
  picture.header.title = "Realisations of the rock" + (title.empty() ? "" : ": " + title);
  picture.header.lines = {"The same design in " + std::to_string(r.count) +
                          " realisations of the rock (" + seeds_text(plan) + "): " + r.verdicts() +
                          ". Rock falls in " + r.rockfall().text() + "."};
  for (const Counted& c : counted_in(plan, r)) {
    const Quantity& q = *c.quantity;
    HistogramPanel panel{c.name, c.unit, q.values, q.mean_between(), ""};
    for (double& value : panel.values) value *= c.scale;
    if (panel.mean_between)
      panel.mean_between = {c.scale * panel.mean_between->low, c.scale * panel.mean_between->high};
    const std::size_t without = static_cast<std::size_t>(q.realisations) - q.values.size();
    if (without > 0) panel.note = std::to_string(without) + " realisations have no value";
    if (!q.values.empty())
      picture.header.key_numbers.push_back(
          {std::string("mean ") + c.name, readable_text(c.scale * q.mean()) + " " + c.unit});
    picture.panels.push_back(std::move(panel));
  }
  return draw_histogram_picture(picture);
}

CaseOutputs sweep_outputs(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  std::vector<KeyColumn> columns;
  for (const VariedKey& varied : plan.parts().varied) columns.push_back(column_of(varied));
  CaseOutputs outputs;
  outputs.files["sweep.csv"] = tunnels_csv(plan, columns, results);
  if (plan.parts().realisations > 1)
    outputs.files["sweep_means.csv"] = means_csv(plan, columns, results);
  const Realised all(results);
  outputs.summary = "sweep    " + std::to_string(results.size()) + " tunnels over";
  for (const VariedKey& varied : plan.parts().varied)
    outputs.summary += (&varied == &plan.parts().varied.front() ? " " : ", ") + varied.key + " (" +
                       std::to_string(varied.values.size()) + ")";
  outputs.summary += ", " + seeds_text(plan) + "\nverdicts " + all.verdicts() + "\n";
  outputs.summary += strength_text(plan) + warnings_text(results);
  return outputs;
}

CaseOutputs realisations_outputs(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  const Realised all = realised_in(plan, results, 0);
  const std::vector<UnwantedEvent> events = unwanted_events(plan.input(), results);
  CaseOutputs outputs;
  outputs.files["realisations.csv"] = tunnels_csv(plan, {}, results);
  outputs.files["realisations.json"] = realisations_json(plan, all, results, events);
  outputs.files["realisations.svg"] = realisations_svg(plan, all);
  std::string& out = outputs.summary;
  out = "rock     " + std::to_string(all.count) + " realisations, " + seeds_text(plan) + "\n";
  if (!plan.uncertain().empty()) out += uncertain_keys_text(plan);
  out += "verdicts " + all.verdicts() + "\n";
  for (const UnwantedEvent& event : events) out += event.what + " in " + event.share.text() + "\n";
  out += probability_text(plan.input().criteria, events) + more_realisations_text(events);
  for (const Counted& c : counted_in(plan, all)) {
    std::string name = c.name;
    name.resize(22, ' ');
    out += name + quantity_text(c) + "\n";
  }
  if (!plan.uncertain().empty()) out += influences(plan, results).text();
  out +=
      "boundary " + results.front().boundary + "\n" + strength_text(plan) + warnings_text(results);
  return outputs;
}

}  // namespace

std::string strength_text(const CasePlan& plan) {
  std::string names;
  // Of the first case: what varies may give a strength that the file does not.
  for (const std::string& name : unchecked_supports(plan.input_of(plan.at(0))))
    names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "" : "strength " + names + ": " + not_checked + "\n";
}

std::string warnings_cell(const TunnelResult& result) {
  std::string text;
  for (const std::string& warning : result.warnings) text += (text.empty() ? "" : "; ") + warning;
  return text;
}

std::string strength_cell(double utilisation) {
  return std::isnan(utilisation)   ? "-"
         : std::isinf(utilisation) ? "inf"
                                   : significant_text(utilisation, 6);
}

std::string governed_cell(const std::string& governed_by) {
  return governed_by.empty() ? "-" : governed_by;
}

std::string warnings_text(const std::vector<TunnelResult>& results) {
  constexpr std::size_t most = 20;
  std::string out;
  std::vector<std::string> seen;
  std::size_t count = 0;
  for (const TunnelResult& r : results)
    for (const std::string& warning : r.warnings)
      if (std::find(seen.begin(), seen.end(), warning) == seen.end()) {
        if (++count > most) continue;
        seen.push_back(warning);
        out += "warning  " + warning + "\n";
      }
  if (count > most) out += "warning  and more of this kind, case by case\n";
  return out;
}

CaseOutputs outputs_of(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  switch (plan.parts().verb) {
    case PlanVerb::diagram:
      return diagram_outputs(plan, results);
    case PlanVerb::realisations:
      return realisations_outputs(plan, results);
    case PlanVerb::sweep:
      return sweep_outputs(plan, results);
  }
  return sweep_outputs(plan, results);
}

}  // namespace voussoir::program
