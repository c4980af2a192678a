// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis.hpp"

/// What the rock of an input does without support and with it: `voussoir grc`.
namespace voussoir::program {

/// The wall at the end of a stage.
struct ReactionPoint {
  std::string stage;
  double traction;          ///< left on the wall, of the in-situ traction [-]
  Convergence convergence;  ///< [m]
  Verdict verdict;
  double fallen;     ///< until then [m^2]
  bool lost_lining;  ///< it had come off its wall by then
};

/// In 2-D: ground reaction and how the supports of the file change it.
struct GroundReaction {
  std::vector<ReactionPoint> ground;     ///< no support, the traction taken off in even steps
  std::vector<ReactionPoint> supported;  ///< stages of the file; empty: it has no support
  double stress = 0;                     ///< vertical, in situ, at the centre [Pa]
  /// Traction under which the bare wall moves as far at its crown as the supported one: what
  /// supports do for it [-]; none where it stands by itself within less, or fell before.
  std::optional<double> equivalent;
  std::vector<std::string> warnings;
};
/// Loads on blocks are left out of both, with a warning.
/// @pre the input is one in 2-D, with a tunnel
/// @throws as `run_of`
[[nodiscard]] GroundReaction ground_reaction(const Input& given, int steps, const Report& report);

/// In 3-D: the wall along the tunnel once it is driven.
struct ProfilePoint {
  double behind_face;       ///< [m]
  Convergence convergence;  ///< [m]; not a number where no wall is
};
struct LongitudinalProfile {
  std::vector<ProfilePoint> points;
  Verdict verdict = Verdict::undecided;
  double fallen = 0;  ///< [m^3]
  std::vector<std::string> warnings;
};
/// @pre the input is one in 3-D
/// @throws as `spatial_run_of`
[[nodiscard]] LongitudinalProfile longitudinal_profile(const Input& input, const Report& report);

[[nodiscard]] std::string grc_text(const GroundReaction& reaction);
[[nodiscard]] std::string grc_json(const GroundReaction& reaction);
[[nodiscard]] std::string grc_csv(const GroundReaction& reaction);
[[nodiscard]] std::string grc_svg(const Input& input, const GroundReaction& reaction);
[[nodiscard]] std::string profile_text(const LongitudinalProfile& profile);
[[nodiscard]] std::string profile_json(const LongitudinalProfile& profile);
[[nodiscard]] std::string profile_csv(const LongitudinalProfile& profile);
[[nodiscard]] std::string profile_svg(const Input& input, const LongitudinalProfile& profile);

}  // namespace voussoir::program
