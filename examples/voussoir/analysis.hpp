// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "input.hpp"
#include "models.hpp"

/// From a checked input to results: the analyses behind the verbs of the program.
namespace voussoir::program {

/// A stage and what came of it.
struct StageResult {
  std::string name;
  double wall_traction;        ///< residual, when it ended [-]
  double wall_traction_asked;  ///< at its end; reached unless the stage ended before [-]
  EquilibriumReport report;
  Convergence convergence;  ///< at its end [m]

  /// False where blocks detached or the search ended while the wall was still being unloaded.
  [[nodiscard]] bool fully_unloaded() const {
    return std::abs(wall_traction - wall_traction_asked) < 1e-9;
  }
};

/// A finished run.
struct RunResult {
  Tunnel tunnel;
  SimplePolygon opening;
  std::vector<Segment> bars;   ///< of the bolts
  std::vector<int> crossings;  ///< joints that each crossed when it was installed
  std::vector<StageResult> stages;
  double in_situ_unbalance = 0;  ///< of the worst block over its weight, before the excavation [-]
  std::vector<std::string> warnings;
  double generation_seconds = 0, equilibrium_seconds = 0;

  [[nodiscard]] const EquilibriumReport& last() const { return stages.back().report; }
  /// That of the last stage; a stage that does not end stable ends the run. In words:
  /// `to_string(verdict(), fallen_measure())`.
  [[nodiscard]] Verdict verdict() const { return last().verdict; }
  [[nodiscard]] double fallen_measure() const;  ///< over all stages [m^2]
};

/// A finished interaction diagram.
struct DiagramResult {
  std::vector<std::string> warnings;  ///< about the rock, and values that are unusual
  std::vector<DiagramPoint> points;   ///< spacing by spacing, thickness running faster
  std::size_t blocks = 0;
  double seconds = 0;
};

/// What is being done and how far it is, 0 to 1, or a negative number where that is unknown.
/// Returns false to stop.
using Report = std::function<bool(const std::string& what, double fraction)>;

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
