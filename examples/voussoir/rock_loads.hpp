// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/units.hpp>
#include <voussoir/tunnel/placed_load.hpp>

#include "analysis.hpp"
#include "input.hpp"
#include "input_section.hpp"

/// Loads on blocks of the rock around a tunnel, from [[load]] to what a run says of them.
namespace voussoir::program {

/// A force or a moment, in 2-D per metre: these have the dimensions of other quantities.
/// @param what  "a force per metre"
/// @param form  what to write
[[nodiscard]] std::optional<double> load_value(const Value& value, const Dimension& dimension,
                                               const char* what, const std::string& form);

/// Reads the [[load]] of a tunnel into `input.loads`, and refuses the tables of laid blocks.
/// @pre  stages have been read
void read_rock_loads(Section& file, Input& input);

/// What loads and stages, openings and the domain must agree on.
void check_rock_loads(Checker& checker, const Input& input);

/// Those of a section that have come on, for its picture.
/// @param built  stages, of those planned
[[nodiscard]] std::vector<PlacedLoad<2>> loads_in_section(const Input& input, std::size_t built);

/// A list, `loads` of run.json: what acts, where, and where the block went.
[[nodiscard]] nlohmann::json loads_json(const Input& input, const RunResult& run);
[[nodiscard]] nlohmann::json loads_json(const Input& input, const SpatialRunResult& run);

}  // namespace voussoir::program
