// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case_outputs.hpp"

/// The interaction diagram, of one realisation of the rock or over several.
namespace voussoir::program {

/// In degrees or metres, as it is given.
[[nodiscard]] double in_own_unit(const BoltSpacing& spacing);
/// "15°", "1.2 m", "no bolts"
/// @param degrees  how the unit of an angle is written
[[nodiscard]] std::string spacing_text(const std::optional<BoltSpacing>& spacing,
                                       const char* degrees);
/// As a cell of a table, and the name of its column.
[[nodiscard]] std::string spacing_cell(const std::optional<BoltSpacing>& spacing);
[[nodiscard]] const char* spacing_column(const DiagramInput& axes);

/// @param results  spacing by spacing, thickness by thickness, seeds running fastest
[[nodiscard]] CaseOutputs diagram_outputs(const CasePlan& plan,
                                          const std::vector<TunnelResult>& results);

}  // namespace voussoir::program
