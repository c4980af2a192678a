// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "case_outputs.hpp"

/// The interaction diagram, of one realisation of the rock or over several.
namespace voussoir::program {

/// @param results  spacing by spacing, thickness by thickness, seeds running fastest
[[nodiscard]] CaseOutputs diagram_outputs(const CasePlan& plan,
                                          const std::vector<TunnelResult>& results);

}  // namespace voussoir::program
