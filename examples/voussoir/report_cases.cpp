// SPDX-License-Identifier: MIT
// What a report says of many tunnels: realisations of the rock, the cheapest support, the
// interaction diagram, a sweep; and of the factor of safety.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "report_pictures.hpp"
#include "report_sections.hpp"

namespace voussoir::program {

namespace {

using html::Column;
using html::Kind;
using html::Section;
using html::Table;

constexpr std::size_t listed = 60;  ///< rows of a table of tunnels

/// A share of tunnels with its interval.
void add_share(Table& table, const Json& json, const char* key, const std::string& name) {
  if (!json.contains(key) || !json[key].is_object()) return;
  const Json& share = json[key];
  table.add({name, shown(number_at(share, "/events")) + " of " + shown(number_at(share, "/of")),
             shown_percent(number_at(share, "/share")),
             shown_percent(number_at(share, "/low_95")) + " to " +
                 shown_percent(number_at(share, "/high_95"))});
}

bool is_of_strength(std::string_view column) { return column.ends_with("of_its_strength"); }

/// The name of a column of a table of results, and its unit: "largest_thrust_kN_per_m".
Column column_of(const std::string& name, Kind kind) {
  struct Unit {
    const char *ending, *unit;
  };
  constexpr Unit units[] = {{"_percent_of_radius", "% of radius"},
                            {"_kNm_per_m", "kN m/m"},
                            {"_kN_per_m", "kN/m"},
                            {"_kN", "kN"},
                            {"_mm", "mm"},
                            {"_cm", "cm"},
                            {"_m2", "m²"},
                            {"_m3", "m³"},
                            {"_deg", "°"},
                            {"_m", "m"}};
  Column column{name, "", kind};
  if (is_of_strength(name)) column = {name, "%", kind};
  for (const Unit& unit : units)
    if (name.ends_with(unit.ending)) {
      column = {name.substr(0, name.size() - std::string_view(unit.ending).size()), unit.unit,
                kind};
      break;
    }
  std::replace(column.title.begin(), column.title.end(), '_', ' ');
  return column;
}

/// A table of tunnels as it was written, but for columns that are for programs.
std::string tunnels_table(const ReportTable& tunnels, const std::string& file,
                          const std::string& caption) {
  constexpr std::string_view left_out[] = {"run_id",
                                           "warnings",
                                           "reason",
                                           "failed",
                                           "marginal",
                                           "crown_convergence_percent_of_radius",
                                           "mean_bolt_force_kN",
                                           "bolt_joints_yielded",
                                           "bolt_joints_ruptured",
                                           "feet_yielded",
                                           "error_estimate",
                                           "out_of_balance_force_ratio"};
  std::vector<std::string> names;
  std::vector<Column> columns;
  for (const std::string& name : tunnels.columns()) {
    if (std::find(std::begin(left_out), std::end(left_out), name) != std::end(left_out)) continue;
    const bool is_number = tunnels.size() > 0 && std::isfinite(tunnels.number(0, name));
    names.push_back(name);
    columns.push_back(column_of(name, is_number           ? Kind::number
                                      : name == "verdict" ? Kind::name
                                                          : Kind::text));
  }
  Table table(caption, columns);
  for (std::size_t k = 0; k < std::min(tunnels.size(), listed); ++k) {
    std::vector<std::string> cells;
    for (const std::string& name : names) {
      const std::string cell(tunnels.cell(k, name));
      const double value = tunnels.number(k, name);
      const bool is_short = cell.size() <= 5;  // as an input has it
      if (is_of_strength(name) && std::isfinite(value))
        cells.push_back(shown_fixed(100 * value, 1));
      else
        cells.push_back(std::isfinite(value) && !is_short ? shown(value) : cell);
    }
    const std::string_view verdict = tunnels.cell(k, "verdict");
    table.add(cells, verdict.empty() || verdict == "stable" ? html::Tone::plain
                     : verdict.starts_with("stable")        ? html::Tone::doubtful
                                                            : html::Tone::bad);
  }
  std::string out = table.text();
  if (tunnels.size() > listed)
    out += html::paragraph("The first " + std::to_string(listed) + " of " +
                           std::to_string(tunnels.size()) + "; all of them are in " + file + ".");
  return out;
}

/// Numbers and words of a JSON object, a row each, whatever they are called.
void add_values(Table& table, const Json& json, const std::string& before = "") {
  for (const auto& [key, value] : json.items()) {
    std::string name = before + key;
    for (char& c : name)
      if (c == '_') c = ' ';
    if (value.is_number())
      table.add({name, shown(value.get<double>(), 4)});
    else if (value.is_string())
      table.add({name, value.get<std::string>()});
    else if (value.is_boolean())
      table.add({name, value.get<bool>() ? "yes" : "no"});
    else if (value.is_object() && before.empty())
      add_values(table, value, name + ": ");
  }
}

}  // namespace

Section safety_section(const ReportFiles& files) {
  Section section{"safety", "Factor of safety", ""};
  Json safety = files.json("safety.json");
  if (safety.is_null()) return section;
  section.body = html::paragraph(words_at(safety, "/text"));
  if (files.has("safety.svg"))
    section.body += html::figure(files.text("safety.svg"), "safety-figure",
                                 "What falls, over the larger of the two factors.", true);
  Table trials("Trials by which it was found", {{"factor"},
                                                {"outcome", "", Kind::text},
                                                {"verdict", "", Kind::text},
                                                {"detached", "m² per m"},
                                                {"crown", "mm"},
                                                {"reason", "", Kind::text}});
  for (const Json& trial : list_at(safety, "/trials"))
    trials.add({shown(number_at(trial, "/factor"), 4), words_at(trial, "/outcome"),
                words_at(trial, "/verdict"), shown(number_at(trial, "/detached_m2_per_m")),
                shown_fixed(number_at(trial, "/crown_mm"), 2), words_at(trial, "/reason")});
  std::vector<std::string> warnings;
  for (const Json& warning : list_at(safety, "/warnings"))
    if (warning.is_string()) warnings.push_back(warning.get<std::string>());
  // Whatever else it says; what of it is for programs, or is another at every run, is left out.
  for (const char* const key :
       {"schema", "program", "title", "text", "run_id", "tunnel_id", "input", "build",
        "result_hash", "time_s", "seconds", "models", "trials", "warnings"})
    safety.erase(key);
  Table table("", {{"what", "", Kind::text}, {"value", "", Kind::text}});
  add_values(table, safety);
  section.body += table.text() + trials.text() + html::list(warnings);
  return section;
}

Section realisations_section(const ReportFiles& files) {
  Section section{"realisations", "Realisations and probabilities", ""};
  const Json json = files.json("realisations.json");
  if (json.is_null()) return section;
  section.body = html::paragraph(
      "The same design in " +
      shown_count(static_cast<std::size_t>(std::max(0.0, number_at(json, "/realisations"))),
                  "realisation") +
      " of the rock, seeds from " + shown(number_at(json, "/first_seed")) + " on.");
  Table shares("Probabilities, with their 95 % confidence interval (Clopper and Pearson)",
               {{"event", "", Kind::text}, {"tunnels"}, {"share"}, {"between"}});
  for (const Json& event : list_at(json, "/probabilities"))
    add_share(shares, event, "probability", words_at(event, "/event"));
  std::vector<Column> columns{{"key", "", Kind::text}, {"distribution", "", Kind::text}};
  const std::vector<Json> keys = list_at(json, "/uncertain_keys/keys");
  if (!keys.empty())
    for (const auto& [outcome, value] : keys.front().at("rank_correlations").items())
      columns.push_back({outcome});
  Table influences(
      "Rank correlations of what is not known: those beyond ±" +
          shown_fixed(number_at(json, "/uncertain_keys/rank_correlation_by_chance_95"), 2) +
          " are not by chance (95 %)",
      columns);
  for (const Json& key : keys) {
    std::vector<std::string> cells{words_at(key, "/key"), words_at(key, "/distribution")};
    for (const auto& [outcome, value] : key.at("rank_correlations").items())
      cells.push_back(value.is_number() ? shown_fixed(value.get<double>(), 2) : "–");
    cells.resize(columns.size());
    influences.add(cells);
  }
  Table verdicts("", {{"verdict", "", Kind::text}, {"tunnels"}});
  if (json.contains("verdicts") && json["verdicts"].is_object())
    for (const auto& [verdict, count] : json["verdicts"].items())
      if (count.is_number()) verdicts.add({verdict, shown(count.get<double>())});
  Table quantities("Means of the realisations that have a value", {{"quantity", "", Kind::text},
                                                                   {"unit", "", Kind::text},
                                                                   {"mean"},
                                                                   {"deviation"},
                                                                   {"mean between"},
                                                                   {"quantile"},
                                                                   {"of"}});
  if (json.contains("quantities") && json["quantities"].is_object())
    for (const auto& [name, value] : json["quantities"].items())
      quantities.add({name, words_at(value, "/unit"), shown(number_at(value, "/mean")),
                      shown(number_at(value, "/deviation"), 2),
                      shown(number_at(value, "/mean_low_95")) + " to " +
                          shown(number_at(value, "/mean_high_95")),
                      shown(number_at(value, "/value_of_quantile")) + " (" +
                          shown_percent(number_at(value, "/quantile")) + ")",
                      shown(number_at(value, "/realisations_with_a_value"))});
  section.body += shares.text() + verdicts.text() + quantities.text() + influences.text();
  if (files.has("realisations.svg"))
    section.body += html::figure(files.text("realisations.svg"), "realisations-figure",
                                 "How the realisations are distributed.");
  return section;
}

Section design_section(const ReportFiles& files) {
  Section section{"design", "Cheapest support that holds", ""};
  const Json json = files.json("design.json");
  if (json.is_null()) return section;
  const std::string unit = words_at(json, "/currency") + "/m";
  section.body = html::paragraph(words_at(json, "/text"));
  if (files.has("design.svg"))
    section.body += html::figure(files.text("design.svg"), "design-figure",
                                 "What supports cost, and which of them hold.", true);
  Table tried("Supports that were computed", {{"bolts", "", Kind::text},
                                              {"lining", "cm"},
                                              {"cost", unit},
                                              {"holds", "", Kind::text},
                                              {"broken in"},
                                              {"nearest criterion", "", Kind::text},
                                              {"of its limit"}});
  for (const Json& support : list_at(json, "/supports")) {
    if (!holds_at(support, "/computed")) continue;
    std::string nearest = "–";
    double most = std::numeric_limits<double>::quiet_NaN();
    for (const Json& criterion : list_at(support, "/criteria")) {
      const double worst = number_at(criterion, "/worst_over_limit");
      if (!(most >= worst) && std::isfinite(worst)) {
        most = worst;
        nearest = words_at(criterion, "/broken_by");
      }
    }
    const bool holds = holds_at(support, "/holds");
    tried.add(
        {words_at(support, "/bolt_spacing"), shown(number_at(support, "/lining_thickness_cm")),
         shown(number_at(support, "/cost_per_m"), 4), holds ? "yes" : "no",
         shown(number_at(support, "/broken/events")) + " of " +
             shown(number_at(support, "/broken/of")),
         nearest, shown_percent(most, 3)},
        holds ? html::Tone::plain : html::Tone::bad);
  }
  section.body += tried.text();
  return section;
}

Section diagram_section(const ReportFiles& files) {
  Section section{"diagram", "Interaction diagram", ""};
  struct Picture {
    const char *name, *id, *caption;
  };
  constexpr Picture pictures[] = {
      {"interaction.svg", "interaction-figure",
       "Convergence of the crown over lining thickness and bolt spacing. On screen, point at a design for its values; a click shows its row in the table."},
      {"interaction_quantile.svg", "interaction-quantile-figure",
       "The convergence that most realisations stay below."},
      {"interaction_rockfall.svg", "interaction-rockfall-figure",
       "Realisations in which rock falls or the tunnel collapses."}};
  for (const Picture& picture : pictures)
    if (files.has(picture.name))
      section.body += html::figure(files.text(picture.name), picture.id, picture.caption, true);
  if (files.has("interaction.csv"))
    section.body += tunnels_table(files.table("interaction.csv"), "interaction.csv", "The tunnels");
  return section;
}

Section sweep_section(const ReportFiles& files) {
  Section section{"sweep", "Sweep", ""};
  if (files.has("sweep.svg"))
    section.body += html::figure(files.text("sweep.svg"), "sweep-figure",
                                 "Convergence of the crown over what is varied.");
  if (files.has("sweep_means.csv"))
    section.body += tunnels_table(files.table("sweep_means.csv"), "sweep_means.csv",
                                  "Means over the realisations");
  if (files.has("sweep.csv"))
    section.body += tunnels_table(files.table("sweep.csv"), "sweep.csv", "The tunnels");
  return section;
}

}  // namespace voussoir::program
