// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include <voussoir/design/bolt_strength.hpp>
#include <voussoir/io/tunnel_tables.hpp>

#include "input.hpp"

/// The strength of bolts: what is printed of it.
namespace voussoir::program {

/// For the table of bolts.
[[nodiscard]] std::vector<CrossingStrength> crossing_strengths(
    const std::vector<BoltUtilisation>& joints);
/// "governing", beside their forces; nothing where nothing is checked.
void add_bolt_strength(const std::vector<BoltUtilisation>& joints, nlohmann::json& bolts);
/// A line for a terminal; empty: nothing is checked.
[[nodiscard]] std::string bolt_strength_line(const std::vector<BoltUtilisation>& joints);
/// A warning where bolts carry more than their bond, which the model does not know; empty: none do.
[[nodiscard]] std::string bolt_strength_warning(const std::vector<BoltUtilisation>& joints);

}  // namespace voussoir::program
