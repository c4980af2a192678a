// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>
#include <voussoir/tunnel/construction.hpp>

#include "input.hpp"
#include "models.hpp"

/// From a checked input to results: the analyses behind the verbs of the program.
namespace voussoir::program {

/// A finished run.
struct RunResult {
  Tunnel tunnel;
  SimplePolygon opening;
  ConstructionResult<Planar> built = {};
  double in_situ_unbalance = 0;  ///< of the worst block over its weight, before the excavation [-]
  std::vector<std::string> warnings = {};
  double generation_seconds = 0, equilibrium_seconds = 0;

  [[nodiscard]] const EquilibriumReport& last() const { return built.last(); }
  /// In words: `to_string(verdict(), fallen_measure())`.
  [[nodiscard]] Verdict verdict() const { return built.verdict(); }
  [[nodiscard]] double fallen_measure() const { return built.fallen_measure(); }
  /// At the end [m].
  [[nodiscard]] const Convergence& convergence() const { return built.stages.back().convergence; }
};

/// A finished interaction diagram.
struct DiagramResult {
  std::vector<std::string> warnings;  ///< about the rock, and values that are unusual
  std::vector<DiagramPoint> points;   ///< spacing by spacing, thickness running faster
  std::size_t blocks = 0;
  double seconds = 0;
};

/// What is being done and how far it is, see `StageProgress`; rock and diagrams too.
using Report = StageProgress;

[[nodiscard]] SimplePolygon opening_of(const Input& input);

/// Rock, and what its maker must be told about it.
struct GeneratedRock {
  RockMass<Planar> mass;
  std::vector<std::string> warnings;
};

/// Slices the rock of an input: random sets and mapped traces, together.
/// @throws InvalidInput  the file of traces cannot be read or used, it makes too many blocks, or no
///                       joint of those asked for cuts the rock
/// @throws Stopped       `progress` said so
[[nodiscard]] GeneratedRock rock_of(const Input& input, const Progress& progress = {});

/// @throws InvalidInput, NumericalFault  the latter names the values of the input that are unusual
/// @throws Stopped       `report` said so while rock was made
[[nodiscard]] RunResult run_tunnel(const Input& input, const Report& report);

/// @pre    input.diagram
/// @throws InvalidInput, NumericalFault, Stopped  as above
[[nodiscard]] DiagramResult run_diagram(const Input& input, unsigned threads, const Report& report);

}  // namespace voussoir::program
