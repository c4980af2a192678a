// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "input.hpp"
#include "input_section.hpp"

/// Joints that were measured with a compass: `joints.orientations`.
namespace voussoir::program {

/// Reads the file of orientations, fits its sets, and gives their mean and K to the joint sets that
/// leave their own out. What is wrong is noted at the key.
/// @param file  the whole input, of which all tables were read
void read_survey(Section& file, Input& input);

/// "survey   ...", a line for the file and one for each set; empty without a survey.
[[nodiscard]] std::string survey_lines(const Input& input);
/// Names the sets of the survey that no joint set takes.
/// @pre there are such sets
[[nodiscard]] std::string left_out_text(const SurveyInput& survey);
[[nodiscard]] nlohmann::json survey_json(const Input& input);
/// Poles, sets and the tunnel's axis.
/// @pre there is a survey
[[nodiscard]] std::string stereonet_svg(const Input& input);

}  // namespace voussoir::program
