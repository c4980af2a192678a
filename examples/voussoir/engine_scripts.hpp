// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "case_plan.hpp"

/// A plan for engines that exist: scripts that a person reads and edits. No scheduling of our own.
namespace voussoir::program {

/// How a plan is handed to an engine.
struct Engine {
  std::string name;               ///< "slurm", "snakemake"
  std::filesystem::path program;  ///< this one, absolute, or a name that is found
  std::filesystem::path folder;   ///< of the plan, absolute
  int chunks = 1;                 ///< parts of the work: tasks of an array, jobs of a workflow
  int minutes = 60;               ///< that a chunk may take at most
};

/// Files that hand the plan to the engine, by name.
[[nodiscard]] std::map<std::string, std::string> engine_scripts(
    const CasePlan& plan, const Engine& engine, const std::vector<std::string>& results);
/// What to do with them, for a terminal.
[[nodiscard]] std::string engine_advice(const CasePlan& plan, const Engine& engine);

}  // namespace voussoir::program
