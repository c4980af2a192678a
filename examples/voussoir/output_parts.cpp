// SPDX-License-Identifier: MIT
#include "output_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <voussoir/core/units.hpp>
#include <voussoir/io/solved_picture.hpp>

#include "analysis.hpp"
#include "joint_laws.hpp"

namespace voussoir::program {

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string computed(const char* format, double value) {
  return std::isfinite(value) ? text(format, value) : "not computed";
}

std::string with_superscripts(std::string text) {
  for (const auto& [plain, raised] : {std::pair("m2", "m\u00b2"), std::pair("m3", "m\u00b3")})
    for (auto at = text.find(plain); at != std::string::npos; at = text.find(plain, at))
      text.replace(at, 2, raised);
  return text;
}

nlohmann::json strength_json(const std::vector<double>& strengths) {
  const auto least = std::min_element(strengths.begin(), strengths.end());
  if (least == strengths.end() || !std::isfinite(*least)) return not_checked;
  return text("%.6g kN", 1e-3 * *least);
}
nlohmann::json number_json(const std::optional<double>& number) {
  return number ? nlohmann::json(*number) : nlohmann::json(nullptr);
}

nlohmann::json report_json(const EquilibriumReport& report, const std::string& measure) {
  return {{"verdict", to_string(report)},
          {"reason", report.reason},
          {"error_estimate", report.error_estimate},
          {"out_of_balance_force_ratio", report.unbalance_over_weight},
          {"largest_displacement_mm", 1e3 * report.largest_displacement},
          {"force_evaluations", report.steps},
          {"elastic_solves", report.elastic_solves},
          {"factorisations", report.factorisations},
          {"linear_solver",
           {{"method", to_string(report.linear.method)},
            {"reason", report.linear.reason},
            {"bodies", report.linear.bodies},
            {"memory_MB", 1e-6 * report.linear.memory},
            {"iterations", report.linear.iterations}}},
          {"detached_bodies", report.fallen.size()},
          {"detached_" + measure, report.fallen_measure},
          {"broken_bolt_springs", report.broken_bolts}};
}

nlohmann::json stages_json(const std::vector<StageResult>& stages, const std::string& measure) {
  nlohmann::json list = nlohmann::json::array();
  for (const StageResult& stage : stages) {
    list.push_back({{"name", stage.name},
                    {"residual_wall_traction", stage.wall_traction},
                    {"residual_wall_traction_asked", stage.wall_traction_asked},
                    {"equilibrium", report_json(stage.report, measure)},
                    {"convergence", convergence_json(stage.convergence)}});
    for (const CreptState& state : stage.crept)
      list.back()["creep"].push_back({{"time_d", state.time / 86400},
                                      {"verdict", to_string(state.report.verdict)},
                                      {"detached_" + measure, state.report.fallen_measure},
                                      {"convergence", convergence_json(state.convergence)}});
  }
  return list;
}

nlohmann::json rockfall_json(const RockfallRange& range, const std::string& measure) {
  return {{"marginal", range.is_marginal()},
          {"least_detached_" + measure, range.low},
          {"most_detached_" + measure, range.high},
          {"another_verdict", range.has_other_verdict},
          {"near_collapse", range.is_near_collapse}};
}

nlohmann::json joints_json(const std::vector<JointSource>& sources) {
  nlohmann::json list = nlohmann::json::array();
  for (const JointSource& s : sources) {
    list.push_back({{"source", s.name},
                    {"asked", s.asked},
                    {"used", s.used},
                    {"outside", s.outside},
                    {"refused", s.refused},
                    {"law", s.law.law}});
    for (const LawParameter& parameter : joint_law_row(s.law.law).parameters)
      list.back()[json_name(parameter)] = json_value(parameter, s.law.at(parameter.key));
    if (s.mapped)
      list.back().update({{"set", s.mapped->set},
                          {"mapped_m", s.mapped->mapped},
                          {"cut_m", s.mapped->cut},
                          {"made_m", s.mapped->made}});
  }
  return list;
}

nlohmann::json convergence_json(const Convergence& c) {
  return {{"crown_mm", 1e3 * c.crown},
          {"right_springing_mm", 1e3 * c.right_springing},
          {"left_springing_mm", 1e3 * c.left_springing},
          {"invert_mm", 1e3 * c.invert},
          {"rise_of_opening_mm", 1e3 * c.rise}};
}

nlohmann::json openings_json(const std::vector<OpeningConvergence>& openings) {
  nlohmann::json list = nlohmann::json::array();
  for (const OpeningConvergence& opening : openings)
    list.push_back(
        {{"name", opening.name}, {"convergence", convergence_json(opening.convergence)}});
  return list;
}

std::string convergence_text(const Convergence& c) {
  return "crown " + millimetres_text(c.crown) + " mm, springings " +
         millimetres_text(c.right_springing) + " and " + millimetres_text(c.left_springing) +
         " mm, invert " + millimetres_text(c.invert) + " mm";
}

std::string opening_lines(const std::vector<OpeningConvergence>& openings) {
  std::string out;
  for (const OpeningConvergence& opening : openings)
    out += "         of the " + opening.name + ": " + convergence_text(opening.convergence) + "\n";
  return out;
}

std::string margin_text(const std::optional<RockfallRange>& range, const std::string& unit) {
  if (!range || !range->is_marginal()) return "";
  return text("%.2f", range->low) + text(" to %.2f ", range->high) + unit +
         (range->has_other_verdict ? ", and not the same verdict," : "") +
         " with half and three times the displacement limit, other damping and slower unloading";
}

std::string joint_lines(const std::vector<JointSource>& sources) {
  std::string out;
  for (const JointSource& s : sources) {
    out += "joints   " + s.name + ": " + std::to_string(s.asked) +
           (s.mapped ? (s.asked == 1 ? " trace, " : " traces, ") : " joints, ") +
           std::to_string(s.used) + " used, " + std::to_string(s.refused) +
           (s.mapped ? " part nothing, " : " without room, ") + std::to_string(s.outside) +
           " outside";
    if (const auto& mapped = s.mapped)
      out += text("; %.1f m mapped", mapped->mapped) + text(", %.1f m of it cut", mapped->cut) +
             text(", %.1f m made beyond", mapped->made);
    out += "; " + law_text(s.law) + "\n";
  }
  return out;
}

std::string stage_lines(const std::vector<StageResult>& stages, const std::string& crown_of) {
  std::string out;
  for (const StageResult& stage : stages) {
    out += "stage    " + stage.name + ": " + to_string(stage.report) +
           text(" at a residual wall traction of %.3g %%", 100 * stage.wall_traction);
    if (!stage.fully_unloaded())
      out += text(", ended on the way to the %.3g %% asked for", 100 * stage.wall_traction_asked);
    out += "; crown " + millimetres_text(stage.convergence.crown) + " mm" + crown_of;
    if (!stage.crept.empty())
      out += ", after " + format_quantity(stage.crept.back().time, dimension::time) +
             " of creep, " + std::to_string(stage.crept.size()) +
             " steps: " + to_string(stage.last());
    out += "\n";
  }
  return out;
}

std::string verdict_lines(const EquilibriumReport& last, const LossText& loss, double seconds) {
  std::string out;
  out += std::string("verdict  ") + to_string(last.verdict, loss.fallen, loss.lost_lining);
  if (last.verdict == Verdict::stable && loss.fallen > 0)
    out += (loss.lost_lining ? ", after rockfall of " : " of ") + text("%.2f ", loss.fallen) +
           loss.unit;
  if (!loss.margin.empty()) out += ", marginal";
  out += ": " + last.reason + "\n";
  out += "         error estimate " + computed("%.1e", last.error_estimate) +
         ", worst out-of-balance force ratio " + computed("%.1e", last.unbalance_over_weight) +
         ", " + text("%.2f s\n", seconds);
  if (last.linear.method != LinearMethod::automatic) {
    out += std::string("solver   ") + to_string(last.linear.method) + " (" + last.linear.reason +
           "): " + std::to_string(last.elastic_solves) + " elastic solves";
    if (last.linear.iterations > 0)
      out += " in " + std::to_string(last.linear.iterations) + " iterations";
    out += text(", %.3g MB\n", 1e-6 * last.linear.memory);
  }
  return out;
}

}  // namespace voussoir::program
