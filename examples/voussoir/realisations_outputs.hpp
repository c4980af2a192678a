// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "case_outputs.hpp"

/// One design in many realisations: what came of it, how likely that is, and what decides it.
namespace voussoir::program {

/// @param results  in the order of the seeds
[[nodiscard]] CaseOutputs realisations_outputs(const CasePlan& plan,
                                               const std::vector<TunnelResult>& results);

}  // namespace voussoir::program
