// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/in_situ.hpp>

#include "analysis.hpp"
#include "input.hpp"

/// What of an analysis differs in 3-D.
namespace voussoir::program {

[[nodiscard]] InSitu in_situ_of(const Input& input);

inline constexpr const char* spatial_boundary_text = "rollers at the four sides and the base";

/// @throws as `spatial_rock_of`
[[nodiscard]] ExcavatedRock spatial_rock_in_situ(const Input& input, const Report& report);

/// Forces of the strips of a lining [N] over their width [N/m]; bolts as they are.
[[nodiscard]] SupportDemand per_metre(const Input& input, SupportDemand demand);

}  // namespace voussoir::program
