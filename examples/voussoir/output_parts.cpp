// SPDX-License-Identifier: MIT
#include "output_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <voussoir/core/units.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/io/journal.hpp>
#include <voussoir/io/solved_picture.hpp>

#include "analysis.hpp"
#include "case_plan.hpp"
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

namespace {

/// Every key with its value as it was written, overrides included.
nlohmann::json input_json(const Input& input) {
  const InputSource& source = input.source;
  nlohmann::json keys = nlohmann::json::object(), files = nlohmann::json::array();
  for (const std::string& line : input.content) {
    const std::size_t at = line.find(" = ");
    if (at == std::string::npos || line.substr(0, at).ends_with(")")) continue;  // was derived
    std::string value = line.substr(at + 3);
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    keys[line.substr(0, at)] = value;
  }
  for (const InputSource::File& file : source.files)
    files.push_back({{"key", file.key}, {"name", file.name}, {"hash", file.hash}});
  return {{"file", source.name},
          {"hash", source.hash},
          {"overrides", source.overrides},
          {"keys", keys},
          {"other_files", files}};
}

nlohmann::json build_json() {
#if defined(__clang__)
  const std::string compiler = "clang++ " __clang_version__;
#elif defined(__GNUC__)
  const std::string compiler = "g++ " __VERSION__;
#else
  const std::string compiler = "not known";
#endif
#if defined(__OPTIMIZE__)
  const bool is_optimised = true;
#else
  const bool is_optimised = false;
#endif
  return {{"version", VOUSSOIR_VERSION_STRING},
          {"sources", sources_hash},
          {"compiler", compiler},
          {"optimised", is_optimised}};
}

}  // namespace

std::string run_json_text(const Input& input, nlohmann::json results) {
  nlohmann::json hashed = results;
  hashed.erase("time_s");
  using Json = nlohmann::json;
  results["result_hash"] = text_hash(hashed.dump(-1, ' ', false, Json::error_handler_t::replace));
  results["input"] = input_json(input);
  results["build"] = build_json();
  return results.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

nlohmann::json acceptance_json(const Input& input) {
  return {{"error_estimate", input.run.tolerance},
          {"out_of_balance_force_ratio", input.run.out_of_balance}};
}

std::string place_at(const SimplePolygon& opening, const Vec2& centre) {
  const auto [low, high] = *bounding_rect(opening.vertices());
  const double half_width = 0.5 * (high.x() - low.x()),
               aside = std::abs(centre.x() - 0.5 * (low.x() + high.x()));
  if (centre.y() < low.y() && aside < half_width) return "invert";
  // Above a line at 45 degrees through the corners of the crown's box.
  if (centre.y() > 0.5 * (low.y() + high.y()) &&
      aside - half_width < centre.y() - high.y() + 0.5 * half_width)
    return "crown";
  return centre.x() < 0.5 * (low.x() + high.x()) ? "left wall" : "right wall";
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

namespace {

std::string numbers_text(const nlohmann::json& list, const std::string& format) {
  std::string words;
  for (const nlohmann::json& number : list)
    words += (words.empty() ? "(" : ", ") + text(format.c_str(), number.get<double>());
  return words + ")";
}

}  // namespace

std::vector<std::string> load_sentences(const nlohmann::json& loads) {
  std::vector<std::string> lines;
  for (const nlohmann::json& load : loads) {
    const bool is_spatial = load.contains("force_kN");
    std::string line = numbers_text(load.at(is_spatial ? "force_kN" : "force_kN_per_m"), "%.4g") +
                       (is_spatial ? " kN" : " kN/m");
    const nlohmann::json moment =
        is_spatial ? load.at("moment_kNm") : nlohmann::json{load.at("moment_kNm_per_m")};
    bool turns = false;
    for (const nlohmann::json& part : moment) turns = turns || part.get<double>() != 0;
    if (turns)
      line +=
          " and a moment of " + (is_spatial ? numbers_text(moment, "%.4g") + " kN m"
                                            : text("%.4g kN m/m", moment.front().get<double>()));
    line += " at " + numbers_text(load.at("at_m"), "%.4g") + " m";
    if (!load.at("came_on").get<bool>())
      line += ", which did not come on: the construction ended before";
    else if (load.at("came_off").get<bool>())
      line += ", on block " + std::to_string(load.at("block").get<int>()) + ", which came off";
    else
      line += ", on block " + std::to_string(load.at("block").get<int>()) + ", which moved " +
              numbers_text(load.at("displacement_mm"), "%.3g") + " mm there";
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace voussoir::program
