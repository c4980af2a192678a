// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "case_plan.hpp"
#include "case_statistics.hpp"

/// What a finished plan writes and says: from its results alone, so that it is the same wherever
/// and in whatever order they were computed.
namespace voussoir::program {

struct CaseOutputs {
  std::map<std::string, std::string> files;  ///< contents by name
  std::string summary;                       ///< for a terminal
};

/// @param results  of all cases, in the order of the plan
/// sweep: sweep.csv, and with several realisations sweep_means.csv; realisations: realisations.csv,
/// .json and .svg; diagram: interaction.csv and .svg, with several realisations of the mean, and
/// interaction.json, interaction_quantile.svg and interaction_rockfall.svg.
[[nodiscard]] CaseOutputs outputs_of(const CasePlan& plan,
                                     const std::vector<TunnelResult>& results);

/// All realisations of one combination of varied keys.
[[nodiscard]] Realised realised_in(const CasePlan& plan, const std::vector<TunnelResult>& results,
                                   std::size_t combination);

/// A row for every tunnel: what varies, what was drawn, what came of it.
[[nodiscard]] std::string tunnels_csv(const CasePlan& plan,
                                      const std::vector<TunnelResult>& results);

/// "seeds 3 to 12"
[[nodiscard]] std::string seeds_text(const CasePlan& plan);

/// Which supports nothing says of whether they bear what they carry, a line for the screen; empty:
/// none.
[[nodiscard]] std::string strength_text(const CasePlan& plan);

/// A utilisation [-]; "-" where no strength was given.
[[nodiscard]] std::string strength_cell(double utilisation);
/// Where the lining is nearest to its strength, "-" where none was given.
[[nodiscard]] std::string governed_cell(const std::string& governed_by);

/// Warnings of one tunnel.
[[nodiscard]] std::string warnings_cell(const TunnelResult& result);

/// Warnings of all tunnels for the screen, each once, a line each.
[[nodiscard]] std::string warnings_text(const std::vector<TunnelResult>& results);

}  // namespace voussoir::program
