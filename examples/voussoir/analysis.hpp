// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/support_demand.hpp>
#include <voussoir/tunnel/support_forces.hpp>

#include "boundary.hpp"
#include "construction_plan.hpp"
#include "input.hpp"
#include "joint_report.hpp"
#include "models.hpp"

/// From a checked input to results: the analyses behind the verbs of the program.
namespace voussoir::program {

/// A finished run.
template <class Geometry>
struct RunResultIn {
  TunnelIn<Geometry> tunnel;
  SimplePolygon opening;         ///< its section
  ChosenBoundary boundary = {};  ///< 2-D; in 3-D there are rollers
  ConstructionResult<Geometry> built = {};
  double in_situ_unbalance = 0;  ///< of the worst block over its weight, before the excavation [-]
  int bonded_nodes =
      0;  ///< of the lining on the full outline, chosen for its bond; 0: they are not
  std::vector<JointSource> joints = {};
  std::string joints_read = {};                 ///< how the file of traces was read, in words
  std::vector<std::string> in_section = {};     ///< how sets by azimuth show there, a line each
  std::vector<std::string> rock_warnings = {};  ///< of `warnings`, those that the picture shows too
  std::vector<std::string> warnings = {};
  double generation_seconds = 0, equilibrium_seconds = 0;

  [[nodiscard]] const EquilibriumReport& last() const { return built.last(); }
  /// In words: `to_string(verdict(), fallen_measure(), built.has_lost_lining())`.
  [[nodiscard]] Verdict verdict() const { return built.verdict(); }
  [[nodiscard]] double fallen_measure() const { return built.fallen_measure(); }
  /// How much of that hangs on limits and rates; where rock has come off in motion, or nearly.
  [[nodiscard]] std::optional<RockfallRange> rockfall() const { return built.rockfall_range(); }
  /// At the end [m]; in 3-D of the whole length.
  [[nodiscard]] const Convergence& convergence() const { return built.stages.back().convergence; }
};
using RunResult = RunResultIn<Planar>;
using SpatialRunResult = RunResultIn<Spatial>;

/// What is being done and how far it is, see `StageProgress`; rock and diagrams too.
using Report = StageProgress;

/// Rock, and what its maker must be told about it.
template <class Geometry>
struct GeneratedRockIn {
  RockMass<Geometry> mass;
  std::vector<JointSource> joints;
  std::vector<std::string> warnings;
  std::string joints_read;  ///< how the file of traces was read, in words; empty: there is none
  std::vector<std::string> in_section = {};  ///< how sets by azimuth show there, a line each
};
using GeneratedRock = GeneratedRockIn<Planar>;

/// Slices the rock of an input: random sets and mapped traces, together.
/// @throws InvalidInput  the file of traces cannot be read or used, it makes too many blocks, or no
///                       joint of those asked for, or of one source of them, cuts the rock
/// @throws Stopped       `progress` said so
[[nodiscard]] GeneratedRock rock_of(const Input& input, const Progress& progress = {});
/// Slices the rock of an input in 3-D, of the sets alone.
[[nodiscard]] GeneratedRockIn<Spatial> spatial_rock_of(const Input& input,
                                                       const Progress& progress = {});

/// @throws InvalidInput, NumericalFault  the latter names the values of the input that are unusual
/// @throws Stopped       `report` said so while rock was made
[[nodiscard]] RunResult run_tunnel(const Input& input, const Report& report);
/// @pre the input is one in 3-D
/// @param observer  of its stages
[[nodiscard]] SpatialRunResult run_spatial_tunnel(
    const Input& input, const Report& report, const StageObserver<SpatialTunnel>& observer = {});

/// Of the middle third of a tunnel that has been driven, 3-D [m].
[[nodiscard]] Convergence middle_convergence(const Input& input, const SpatialTunnel& tunnel);

/// Of an opening besides the tunnel.
struct OpeningConvergence {
  std::string name;
  Convergence convergence;  ///< [m]; 3-D: of its whole length
};
/// Of those that the model has, in the order of the file.
[[nodiscard]] std::vector<OpeningConvergence> other_convergences(const Input& input,
                                                                 const Tunnel& tunnel);
[[nodiscard]] std::vector<OpeningConvergence> other_convergences(const Input& input,
                                                                 const SpatialTunnel& tunnel);

/// The rock of an input under its in-situ stress, nothing moved: the start of every tunnel that
/// differs in its supports only. A section that is taken out at once is out.
struct ExcavatedRock {
  std::variant<Tunnel, SpatialTunnel> tunnel;
  std::vector<JointSource> joints;
  SimplePolygon opening;
  ChosenBoundary boundary;
  double in_situ_unbalance;                  ///< of the worst block over its weight [-]
  std::vector<std::string> warnings;         ///< about the rock
  std::string joints_read = {};              ///< how the file of traces was read, in words
  std::vector<std::string> in_section = {};  ///< how sets by azimuth show there, a line each
};

/// @param wants_bias  see `bounded_tunnel`
/// @throws as `rock_of`, `spatial_rock_of`
[[nodiscard]] ExcavatedRock excavated_rock(const Input& input, bool wants_bias,
                                           const Report& report);

/// Those of the file itself.
[[nodiscard]] SupportChoice supports_of(const Input& input);

/// Refuses bolts that would end outside the rock, before any rock is made. @throws InvalidInput
void check_bolts(const Input& input, const std::vector<std::optional<BoltSpacing>>& spacings);

/// Of one bolt in tension [N], the lower of yield and rupture; infinite: none was given.
[[nodiscard]] double bolt_strength(const BoltsInput& bolts);
/// Of every bolt that was installed [N].
template <class Solver>
[[nodiscard]] std::vector<double> bolt_strengths(const Input& input, const Solver& tunnel) {
  std::vector<double> strengths;
  for (const BoltsInput* pattern : patterns_of_bars(input, bars_of(tunnel)))
    strengths.push_back(bolt_strength(*pattern));
  return strengths;
}
/// The largest force of a bolt over its strength [-]; none: no bolt has one.
template <class Solver>
[[nodiscard]] std::optional<double> most_of_bolt_strength(const Input& input,
                                                          const Solver& tunnel) {
  const std::vector<double> strengths = bolt_strengths(input, tunnel);
  const std::vector<double> forces = largest_bolt_forces(tunnel);
  std::optional<double> most;
  for (std::size_t k = 0; k < strengths.size(); ++k)
    if (std::isfinite(strengths[k])) most = std::max(most.value_or(0), forces[k] / strengths[k]);
  return most;
}
/// Supports whose strength is not given, so that nothing says whether they bear what they carry:
/// "bolts", "lining", "feet of the lining".
[[nodiscard]] std::vector<std::string> unchecked_supports(const Input& input);
inline constexpr const char* not_checked = "no strength was given: not checked";

/// What came of one tunnel among many: the numbers that a design is chosen by.
struct TunnelResult {
  Verdict verdict = Verdict::undecided;
  bool failed = false;       ///< it could not be computed: the reason says why
  bool lost_lining = false;  ///< a lining came off its wall
  double fallen = 0;         ///< rock that detached, over all stages; 3-D: per metre driven [m^2]
  bool marginal = false;     ///< that hangs on limits and rates, see `RockfallRange`
  std::string reason;        ///< of the verdict, one sentence
  Convergence convergence = {not_computed, not_computed, not_computed, not_computed};  ///< [m]
  SupportDemand demand = {};
  double error_estimate = not_computed;  ///< of displacements [-]
  double out_of_balance = not_computed;  ///< of the worst block over its weight [-]
  std::size_t blocks = 0;
  std::string boundary;  ///< in words
  /// Joints at which a bolt has yielded or ruptured, and feet that have reached their strength.
  int bolts_yielded = 0, bolts_ruptured = 0, feet_yielded = 0;
  /// Largest bolt force over the strength of a bolt [-]; not a number: none was given.
  double of_bolt_strength = not_computed;
  std::vector<std::string> warnings = {};  ///< about the rock, and values that are unusual

  static constexpr double not_computed = std::numeric_limits<double>::quiet_NaN();

  /// "stable", "stable after rockfall", "stable, bolts yielded", ..., "failed".
  [[nodiscard]] std::string word() const;
  /// Something of the supports has reached its strength.
  [[nodiscard]] bool has_yielded() const {
    return bolts_yielded + bolts_ruptured + feet_yielded > 0;
  }
  /// It has a verdict and, where no rock has fallen, a number for the crown.
  [[nodiscard]] bool is_decided() const {
    return !failed && verdict != Verdict::undecided &&
           (verdict == Verdict::collapse || fallen > 0 || std::isfinite(convergence.crown));
  }
  /// It stands, and all of its rock and its lining with it.
  [[nodiscard]] bool is_whole() const {
    return verdict == Verdict::stable && fallen == 0 && !lost_lining;
  }
};

/// Builds one tunnel in rock that is ready for it. The rock stays as it is: any number at a time.
/// What is computed does not depend on the machine: neither on its memory, which elsewhere decides
/// how elastic equations are solved, nor on its number of processors.
/// @return  a numerical fault is a result too: failed, with its text
/// @throws Stopped  `report` said so
[[nodiscard]] TunnelResult supported_tunnel(const Input& input, const ExcavatedRock& rock,
                                            const SupportChoice& supports, const Report& report);

}  // namespace voussoir::program
