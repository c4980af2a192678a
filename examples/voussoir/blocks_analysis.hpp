// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>
#include <voussoir/design/models.hpp>
#include <voussoir/voussoir.hpp>

#include "analysis.hpp"
#include "input.hpp"

/// Blocks that are laid one by one: their weight comes on, then loads and displacements in steps.
namespace voussoir::program {

struct BlocksRun {
  Tunnel solver;
  EquilibriumReport weight;              ///< with the dead loads
  std::vector<EquilibriumReport> steps;  ///< of the loading, as far as it went
  double reached = 0;                    ///< part of the loading under which all blocks stand [-]
  std::vector<std::string> warnings = {};
  double seconds = 0;

  [[nodiscard]] const EquilibriumReport& last() const {
    return steps.empty() ? weight : steps.back();
  }
  /// "stands", "part of it falls", "falls" or "undecided".
  [[nodiscard]] std::string word() const;
};

/// @throws InvalidInput, NumericalFault, Stopped
[[nodiscard]] BlocksRun run_blocks(const Input& input, const Report& report);

}  // namespace voussoir::program
