// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/tunnel/construction.hpp>

#include "boundary.hpp"
#include "input.hpp"
#include "models.hpp"

/// From a checked input to results: the analyses behind the verbs of the program.
namespace voussoir::program {

/// What became of the joints of one source: a set, or the file of traces.
struct JointSource {
  std::string name;
  std::size_t asked = 0;    ///< joints
  std::size_t used = 0;     ///< that cut a block
  std::size_t outside = 0;  ///< that do not reach the domain
  std::size_t refused = 0;  ///< for parts too small or too long, or where a joint was already
};

/// How much rock comes off with half and twice the displacement limit, and with the walls unloaded
/// at half the rate, besides what the run itself has: where these differ the rock is marginal by
/// nature, and no single figure is its answer.
struct RockfallRange {
  double low = 0, high = 0;        ///< detached [m^2], over the four runs
  bool has_other_verdict = false;  ///< one of them stands and another does not, or is undecided
  /// A difference below it says nothing [m^2]: a mean block. Of a collapse none does, which ends at
  /// whatever moment its limit is passed.
  double scale = 0;

  [[nodiscard]] bool is_marginal() const {
    return has_other_verdict || high - low > std::max(0.1 * high, scale);
  }
};

/// A finished run.
struct RunResult {
  Tunnel tunnel;
  SimplePolygon opening;
  ChosenBoundary boundary = {};
  ConstructionResult<Planar> built = {};
  double in_situ_unbalance = 0;  ///< of the worst block over its weight, before the excavation [-]
  std::vector<JointSource> joints = {};
  std::vector<std::string> rock_warnings = {};  ///< of `warnings`, those that the picture shows too
  std::vector<std::string> warnings = {};
  double generation_seconds = 0, equilibrium_seconds = 0;
  std::optional<RockfallRange> rockfall = {};  ///< where rock has come off

  [[nodiscard]] const EquilibriumReport& last() const { return built.last(); }
  /// In words: `to_string(verdict(), fallen_measure(), built.has_lost_lining())`.
  [[nodiscard]] Verdict verdict() const { return built.verdict(); }
  [[nodiscard]] double fallen_measure() const { return built.fallen_measure(); }
  /// At the end [m].
  [[nodiscard]] const Convergence& convergence() const { return built.stages.back().convergence; }
};

/// A finished interaction diagram.
struct DiagramResult {
  ChosenBoundary boundary = {};
  std::vector<std::string> warnings = {};  ///< about the rock, and values that are unusual
  std::vector<DiagramPoint> points = {};   ///< spacing by spacing, thickness running faster
  std::size_t blocks = 0;
  double seconds = 0;
};

/// What is being done and how far it is, see `StageProgress`; rock and diagrams too.
using Report = StageProgress;

[[nodiscard]] SimplePolygon opening_of(const Input& input);

/// Rock, and what its maker must be told about it.
struct GeneratedRock {
  RockMass<Planar> mass;
  std::vector<JointSource> joints;
  std::vector<std::string> warnings;
};

/// Slices the rock of an input: random sets and mapped traces, together.
/// @throws InvalidInput  the file of traces cannot be read or used, it makes too many blocks, or no
///                       joint of those asked for, or of one source of them, cuts the rock
/// @throws Stopped       `progress` said so
[[nodiscard]] GeneratedRock rock_of(const Input& input, const Progress& progress = {});

/// @throws InvalidInput, NumericalFault  the latter names the values of the input that are unusual
/// @throws Stopped       `report` said so while rock was made
[[nodiscard]] RunResult run_tunnel(const Input& input, const Report& report);

/// @pre    input.diagram
/// @throws InvalidInput, NumericalFault, Stopped  as above
[[nodiscard]] DiagramResult run_diagram(const Input& input, unsigned threads, const Report& report);

}  // namespace voussoir::program
