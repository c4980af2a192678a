// SPDX-License-Identifier: MIT
#include "case_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>

#include "case_statistics.hpp"
#include "diagram_outputs.hpp"
#include "realisations_outputs.hpp"
#include "sweep_outputs.hpp"

namespace voussoir::program {

namespace {

std::string number(double value) { return significant_text(value, 6); }

}  // namespace

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

std::string tunnels_csv(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  std::vector<KeyColumn> columns;
  for (const VariedKey& varied : plan.parts().varied) columns.push_back(column_of(varied));
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

std::string seeds_text(const CasePlan& plan) {
  const std::uint64_t first = plan.input().model.seed;
  const int count = plan.parts().realisations;
  return count == 1 ? "seed " + std::to_string(first)
                    : "seeds " + std::to_string(first) + " to " +
                          std::to_string(first + static_cast<std::uint64_t>(count) - 1);
}

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
