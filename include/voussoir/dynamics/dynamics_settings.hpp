// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// How a dynamic run is stepped. What is 0 by default is chosen from the blocks.
struct DynamicsSettings {
  double gravity = 9.81;       ///< downwards [m/s^2], >= 0
  double local_damping = 0;    ///< alpha [-], 0 <= alpha < 1: opposes motion with alpha |f|
  double viscous_damping = 0;  ///< normal dashpots at contacts, ratio to critical [-], >= 0
  double safety = 0.5;         ///< of the stable step [-], 0 < safety <= 1
  double time_step = 0;        ///< [s]; 0: safety times the stable step
  bool find_contacts = true;   ///< false: the contacts stay those of the beginning
  /// A joint is eight points (`Segment::lobatto_points`), each with the law to itself, in place of
  /// two on what is pressed of it (`PressedPart`): to see what hangs on that rule. Takes twice as
  /// long; 2-D alone.
  bool joint_fibres = false;
  double reach = 0;  ///< contacts are listed up to this gap [m]; 0: 2 % of the mean radius
  /// Bodies of a contact move so far before its contact update [m]; 0: a quarter of the reach.
  double refresh = 0;
  double overlap_limit = 0.3;  ///< of the smaller block's radius, beyond which the run stops [-]
  double speed_limit = 0;      ///< beyond which it stops [m/s]; 0: four times a fall through all
  int check_every = 100;       ///< steps between run diagnostics
  bool goes_back = true;  ///< to the last sound state, of which it keeps a copy, when it goes bad
  unsigned threads = 1;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(gravity >= 0 && std::isfinite(gravity), "gravity", gravity, ">= 0 m/s^2");
    require(local_damping >= 0 && local_damping < 1, "local damping", local_damping,
            ">= 0 and < 1");
    require(viscous_damping >= 0 && std::isfinite(viscous_damping), "viscous damping",
            viscous_damping, ">= 0");
    require(safety > 0 && safety <= 1, "safety of the step", safety, "> 0 and <= 1");
    require(time_step >= 0 && std::isfinite(time_step), "time step", time_step,
            ">= 0 s (0: computed)");
    require(reach >= 0 && std::isfinite(reach), "reach of contacts", reach, ">= 0 m (0: computed)");
    require(refresh >= 0 && std::isfinite(refresh), "refresh of contacts", refresh,
            ">= 0 m (0: computed)");
    require(overlap_limit > 0, "overlap limit", overlap_limit, "> 0");
    require(speed_limit >= 0, "speed limit", speed_limit, ">= 0 m/s (0: computed)");
    require(check_every > 0, "check_every", check_every, "> 0");
  }
};

}  // namespace voussoir
