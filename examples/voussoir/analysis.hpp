// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/rockmass/mapped_slicing.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "boundary.hpp"
#include "input.hpp"
#include "models.hpp"

/// From a checked input to results: the analyses behind the verbs of the program.
namespace voussoir::program {

/// What became of the joints of one source: random ones of a set, or those of a set that were
/// mapped. And what the set is made of.
struct JointSource {
  std::string name;
  std::size_t asked = 0;          ///< joints
  std::size_t used = 0;           ///< that cut a block
  std::size_t outside = 0;        ///< that do not reach the domain
  std::size_t refused = 0;        ///< for parts too small or too long, or where a joint was already
  CoulombJoint::Params law = {};  ///< mechanics taken
  std::optional<MappedSet> mapped = {};  ///< none: they are random
};

/// A finished run.
struct RunResult {
  Tunnel tunnel;
  SimplePolygon opening;
  ChosenBoundary boundary = {};
  ConstructionResult<Planar> built = {};
  double in_situ_unbalance = 0;  ///< of the worst block over its weight, before the excavation [-]
  int bonded_nodes =
      0;  ///< of the lining on the full outline, chosen for its bond; 0: they are not
  std::vector<JointSource> joints = {};
  std::string joints_read = {};                 ///< how the file of traces was read, in words
  std::vector<std::string> rock_warnings = {};  ///< of `warnings`, those that the picture shows too
  std::vector<std::string> warnings = {};
  double generation_seconds = 0, equilibrium_seconds = 0;

  [[nodiscard]] const EquilibriumReport& last() const { return built.last(); }
  /// In words: `to_string(verdict(), fallen_measure(), built.has_lost_lining())`.
  [[nodiscard]] Verdict verdict() const { return built.verdict(); }
  [[nodiscard]] double fallen_measure() const { return built.fallen_measure(); }
  /// How much of that hangs on limits and rates; where rock has come off in motion, or nearly.
  [[nodiscard]] std::optional<RockfallRange> rockfall() const { return built.rockfall_range(); }
  /// At the end [m].
  [[nodiscard]] const Convergence& convergence() const { return built.stages.back().convergence; }
};

/// What is being done and how far it is, see `StageProgress`; rock and diagrams too.
using Report = StageProgress;

/// Rock, and what its maker must be told about it.
struct GeneratedRock {
  RockMass<Planar> mass;
  std::vector<JointSource> joints;
  std::vector<std::string> warnings;
  std::string joints_read;  ///< how the file of traces was read, in words; empty: there is none
};

/// Slices the rock of an input: random sets and mapped traces, together.
/// @throws InvalidInput  the file of traces cannot be read or used, it makes too many blocks, or no
///                       joint of those asked for, or of one source of them, cuts the rock
/// @throws Stopped       `progress` said so
[[nodiscard]] GeneratedRock rock_of(const Input& input, const Progress& progress = {});

/// @throws InvalidInput, NumericalFault  the latter names the values of the input that are unusual
/// @throws Stopped       `report` said so while rock was made
[[nodiscard]] RunResult run_tunnel(const Input& input, const Report& report);

/// The rock of an input under its in-situ stress, excavated, nothing moved: the start of every
/// tunnel that differs in its supports only.
struct ExcavatedRock {
  Tunnel tunnel;
  std::vector<JointSource> joints;
  SimplePolygon opening;
  ChosenBoundary boundary;
  double in_situ_unbalance;           ///< of the worst block over its weight [-]
  std::vector<std::string> warnings;  ///< about the rock
  std::string joints_read = {};       ///< how the file of traces was read, in words
};

/// @param wants_bias  see `bounded_tunnel`
/// @throws as `rock_of`
[[nodiscard]] ExcavatedRock excavated_rock(const Input& input, bool wants_bias,
                                           const Report& report);

/// The supports of one tunnel among many in the same rock.
struct SupportChoice {
  std::optional<BoltSpacing> spacing;  ///< none: no bolts
  double thickness = 0;                ///< of the lining [m]; 0: no lining
};
/// Those of the file itself.
[[nodiscard]] SupportChoice supports_of(const Input& input);

/// Refuses bolts that would end outside the rock, before any rock is made. @throws InvalidInput
void check_bolts(const Input& input, const std::vector<std::optional<BoltSpacing>>& spacings);

/// Of one bolt in tension [N], the lower of yield and rupture; infinite: none was given.
[[nodiscard]] double bolt_strength(const BoltsInput& bolts);
/// Supports whose strength is not given, so that nothing says whether they bear what they carry:
/// "bolts", "lining", "feet of the lining".
[[nodiscard]] std::vector<std::string> unchecked_supports(const Input& input);
inline constexpr const char* not_checked = "no strength was given: not checked";

/// What came of one tunnel among many: the numbers that a design is chosen by.
struct TunnelResult {
  Verdict verdict = Verdict::undecided;
  bool failed = false;       ///< it could not be computed: the reason says why
  bool lost_lining = false;  ///< a lining came off its wall
  double fallen = 0;         ///< rock that detached, over all stages [m^2]
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
