// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/bolt_strength.hpp>

#include "input.hpp"
#include "joint_report.hpp"

/// From a checked input to results: the analyses of the library, with what the verbs of the program
/// print beside them. Messages name the keys of the file.
namespace voussoir::program {

/// What is being done and how far it is, see `StageProgress`; rock and diagrams too.
using Report = StageProgress;

/// A finished run.
template <class Geometry>
struct RunResultIn : TunnelRun<Geometry>, DescribedRock {
  int bonded_nodes =
      0;  ///< of the lining on the full outline, chosen for its bond; 0: they are not
  std::vector<std::string> rock_warnings = {};  ///< of `warnings`, those that the picture shows too
  double generation_seconds = 0, equilibrium_seconds = 0;
};
using RunResult = RunResultIn<Planar>;
using SpatialRunResult = RunResultIn<Spatial>;

/// Rock, and what its maker must be told about it.
template <class Geometry>
struct RockIn : JointedRock<Geometry>, DescribedRock {};

/// Slices the rock of an input: random sets and mapped traces, together.
/// @throws InvalidInput  the file of traces cannot be read or used, it makes too many blocks, or no
///                       joint of those asked for, or of one source of them, cuts the rock
/// @throws Stopped       `progress` said so
[[nodiscard]] RockIn<Planar> described_rock(const Input& input, const Progress& progress = {});
/// Slices the rock of an input in 3-D, of the sets alone.
[[nodiscard]] RockIn<Spatial> described_spatial_rock(const Input& input,
                                                     const Progress& progress = {});

/// @throws InvalidInput, NumericalFault  the latter names the values of the input that are unusual
/// @throws Stopped       `report` said so while rock was made
/// @param observer  of its stages
[[nodiscard]] RunResult run_of(const Input& input, const Report& report,
                               const StageObserver<Tunnel>& observer = {});
/// @pre the input is one in 3-D
/// @param observer  of its stages
[[nodiscard]] SpatialRunResult spatial_run_of(const Input& input, const Report& report,
                                              const StageObserver<SpatialTunnel>& observer = {});

/// See `ExcavatedRock`.
struct RockInSitu : ExcavatedRock, DescribedRock {};

/// @param wants_bias  see `bounded_tunnel`
/// @throws as `described_rock`, `described_spatial_rock`
[[nodiscard]] RockInSitu rock_in_situ(const Input& input, bool wants_bias, const Report& report);

/// Refuses bolts that would end outside the rock, before any rock is made.
/// @param first  spacings of the first pattern, which a diagram varies; none: it is left out
/// @throws InvalidInput
void check_bolt_ends(const Input& input, const std::vector<std::optional<BoltSpacing>>& first);

/// See `supported_tunnel`; with the warnings about its rock and its values.
[[nodiscard]] TunnelResult tunnel_in(const Input& input, const RockInSitu& rock,
                                     const SupportChoice& supports, const Report& report);

/// What the file has chosen, by the names of the models.
[[nodiscard]] std::string composition_of(const Input& input);

}  // namespace voussoir::program
