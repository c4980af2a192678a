// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>

namespace voussoir::program {

/// The numbers that decided one search.
[[nodiscard]] nlohmann::json report_json(const EquilibriumReport& report);

}  // namespace voussoir::program
