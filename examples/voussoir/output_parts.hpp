// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/tunnel/construction.hpp>

#include "analysis.hpp"
#include "joint_report.hpp"

/// What outputs of runs in 2-D and 3-D, and of blocks that are laid, have in common.
namespace voussoir::program {

/// A number by a format of printf.
[[nodiscard]] std::string text(const char* format, double value);
/// A number by a format of printf; "not computed" of what is no number.
[[nodiscard]] std::string computed(const char* format, double value);

/// With m², m³ for m2, m3: a picture has what a terminal may not.
[[nodiscard]] std::string with_superscripts(std::string text);

/// Strength of what has none.
inline constexpr double unlimited = std::numeric_limits<double>::infinity();
/// The least of all; "not checked" where none has one [N].
[[nodiscard]] nlohmann::json strength_json(const std::vector<double>& strengths);
/// null: none
[[nodiscard]] nlohmann::json number_json(const std::optional<double>& number);

/// The numbers that decided one search.
/// @param measure  what is lost of rock: "area_m2", "volume_m3"
[[nodiscard]] nlohmann::json report_json(const EquilibriumReport& report,
                                         const std::string& measure = "area_m2");
[[nodiscard]] nlohmann::json stages_json(const std::vector<StageResult>& stages,
                                         const std::string& measure);
[[nodiscard]] nlohmann::json rockfall_json(const RockfallRange& range, const std::string& measure);
[[nodiscard]] nlohmann::json joints_json(const std::vector<JointSource>& sources);
[[nodiscard]] nlohmann::json convergence_json(const Convergence& c);
/// Of openings besides the tunnel: a list, and a line each.
[[nodiscard]] nlohmann::json openings_json(const std::vector<OpeningConvergence>& openings);
[[nodiscard]] std::string opening_lines(const std::vector<OpeningConvergence>& openings);
/// run.json: what was computed with a hash of it, which is the same wherever the same bits were
/// computed, then what it was computed from and by which build of the program.
/// @param results  what of them is told otherwise than by their bits, `time_s`, is not hashed
[[nodiscard]] std::string run_json_text(const Input& input, nlohmann::json results);
/// Where at an opening a block was: "crown", "left wall", "invert", ...
/// @param centre  of the block, in the section of the opening [m]
[[nodiscard]] std::string place_at(const SimplePolygon& opening, const Vec2& centre);
/// By which equilibrium is accepted.
[[nodiscard]] nlohmann::json acceptance_json(const Input& input);
/// "crown 1.2 mm, springings 0.3 and 0.2 mm, invert 0.9 mm"
[[nodiscard]] std::string convergence_text(const Convergence& c);

/// Of `loads` in run.json a line for each, as on screen, in the report and under the picture.
[[nodiscard]] std::vector<std::string> load_sentences(const nlohmann::json& loads);

/// How much would come off otherwise; empty where that is the same.
/// @param unit  "m2", "m3"
[[nodiscard]] std::string margin_text(const std::optional<RockfallRange>& range,
                                      const std::string& unit);

/// Lines for a terminal.
[[nodiscard]] std::string joint_lines(const std::vector<JointSource>& sources);
/// @param crown_of  behind the crown of each
[[nodiscard]] std::string stage_lines(const std::vector<StageResult>& stages,
                                      const std::string& crown_of = "");
/// What has come off.
struct LossText {
  double fallen;     ///< over all stages
  std::string unit;  ///< "m2", "m3"
  bool lost_lining;
  std::string margin;  ///< see `margin_text`
};
[[nodiscard]] std::string verdict_lines(const EquilibriumReport& last, const LossText& loss,
                                        double seconds);

}  // namespace voussoir::program
