// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/errors.hpp>

namespace voussoir {

// The numbers inside the search for equilibrium that are neither physics nor accuracy. Nobody needs
// to set them: they are here to have a name, and to be varied. Each was halved and doubled over
// tunnels with and without rockfall, supported, and in 3-D: docs/sensitivity.md has what changed.

/// Of the local search: bodies out of balance, all others fixed.
struct LocalSearchTuning {
  /// Bodies out of balance by more than this part of the accepted out-of-balance force ratio are
  /// searched; Newton steps end when none is [-], 0 to 1.
  double active_above = 0.1;
  /// How far a body that nothing holds may go in the first Newton step, over the longest move,
  /// which is the displacement limit or that of contact updates, whichever is shorter [-].
  double first_reach = 0.2;
  /// No body goes further in a Newton step, over the longest move [-].
  double longest_step = 0.5;
  double reach_growth = 4;       ///< of the reach, after a whole step that succeeded [-], >= 1
  double reach_shrinkage = 0.1;  ///< after one that failed [-], > 0 and < 1
  double shortest_reach = 1e-6;  ///< [m]
  /// A Newton step is halved down to this part of it; one that fails even so is taken back [-].
  double shortest_step = 0.2;
  /// It succeeds while the sum of squared out-of-balance force ratios grows no further [-], >= 1.
  double accepted_growth = 1.02;
  /// A step has spoilt the balance of a body if its ratio is now beyond factor * before + addition.
  double spoilt_factor = 2, spoilt_addition = 0.3;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(active_above > 0 && active_above <= 1, "active_above", active_above, "> 0 and <= 1");
    require(first_reach > 0, "first_reach", first_reach, "> 0");
    require(longest_step > 0 && longest_step <= 1, "longest_step", longest_step, "> 0 and <= 1");
    require(reach_growth >= 1, "reach_growth", reach_growth, ">= 1");
    require(reach_shrinkage > 0 && reach_shrinkage < 1, "reach_shrinkage", reach_shrinkage,
            "> 0 and < 1");
    require(shortest_reach > 0, "shortest_reach", shortest_reach, "> 0 m");
    require(shortest_step > 0 && shortest_step < 1, "shortest_step", shortest_step, "> 0 and < 1");
    require(accepted_growth >= 1, "accepted_growth", accepted_growth, ">= 1");
    require(spoilt_factor >= 1, "spoilt_factor", spoilt_factor, ">= 1");
    require(spoilt_addition >= 0, "spoilt_addition", spoilt_addition, ">= 0");
  }
};

/// Of the elastic corrections, and of what is done with them.
struct CorrectionTuning {
  /// A correction is computed to this part of itself, since the next one corrects that too ...
  double exactness = 0.1;  ///< [-], > 0 and < 1
  /// ... but no better than this part of the error that is accepted.
  double share_of_error = 0.05;  ///< [-], > 0 and < 1
  /// It is halved while it would make the residual so many times larger [-], >= 1.
  double residual_growth = 4;
  /// Down to this part of it; then none of it is added [-], > 0 and < 1.
  double shortest = 0.2;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(exactness > 0 && exactness < 1, "exactness", exactness, "> 0 and < 1");
    require(share_of_error > 0 && share_of_error < 1, "share_of_error", share_of_error,
            "> 0 and < 1");
    require(residual_growth >= 1, "residual_growth", residual_growth, ">= 1");
    require(shortest > 0 && shortest < 1, "shortest", shortest, "> 0 and < 1");
  }
};

/// Of telling detached blocks by their displacement, which needs that the rock as a whole does not
/// move as far.
struct DetachmentTuning {
  double far_limit = 0.5;     ///< the rock moves too far beyond this part of the limit [-]
  double far_blocks = 0.01;   ///< if so many of its blocks do [-], > 0 and < 1
  double first_look = 0.05;   ///< exactness of the elastic step that tells [-] ...
  double second_look = 1e-6;  ///< ... and where that leaves it open

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(far_limit > 0 && far_limit <= 1, "far_limit", far_limit, "> 0 and <= 1");
    require(far_blocks > 0 && far_blocks < 1, "far_blocks", far_blocks, "> 0 and < 1");
    require(first_look > 0 && first_look < 1, "first_look", first_look, "> 0 and < 1");
    require(second_look > 0 && second_look < 1, "second_look", second_look, "> 0 and < 1");
  }
};

/// Of the order of searches where blocks detach.
struct RestartTuning {
  /// The fallback follows falling blocks until the others are out of balance by no more than this
  /// [-]: it mostly has to tell what detaches, and what is a tenth of its weight out does not.
  double follow_to = 0.1;
  double follow_closer = 0.3;  ///< times that, when nothing had detached [-], > 0 and < 1
  /// Contact updates in a search: so many, and so many more for each time that the displacement
  /// limit holds that of updates. A block that needs more makes no progress.
  int updates = 4, updates_on_the_way = 8;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(follow_to > 0, "follow_to", follow_to, "> 0");
    require(follow_closer > 0 && follow_closer < 1, "follow_closer", follow_closer, "> 0 and < 1");
    require(updates >= 0, "updates", updates, ">= 0");
    require(updates_on_the_way >= 0, "updates_on_the_way", updates_on_the_way, ">= 0");
  }
};

/// Of an unloading that is followed in increments, because friction remembers the path.
struct PathTuning {
  /// One step is enough where no more than this part of the movement is slip and opening [-].
  double one_step_share = 0.2;
  /// On the way states are accepted with so many times the error and the out-of-balance force ratio
  /// of the last one [-], >= 1 ...
  double looseness = 30;
  int burst_steps = 20;  ///< ... after local searches of so many steps, > 0
  /// An increment is halved where more than this part of its movement is not that of the increment
  /// before, in proportion to their lengths [-], > 0; doubled again below a quarter of it ...
  double turn = 0.3;
  int halvings = 5;  ///< ... so many times at most, 0 to 10
  int open = 1;      ///< increments without an end before the stage is followed in motion, >= 0
  /// It is a jump where half the increment leaves more than this part of the turn [-], > 0.
  double jump = 0.8;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(one_step_share >= 0, "one_step_share", one_step_share, ">= 0");
    require(looseness >= 1, "looseness", looseness, ">= 1");
    require(burst_steps > 0, "burst_steps", burst_steps, "> 0");
    require(turn > 0, "turn", turn, "> 0");
    require(open >= 0, "open", open, ">= 0");
    require(jump > 0, "jump", jump, "> 0");
    require(halvings >= 0 && halvings <= 10, "halvings", halvings, "0 to 10");
  }
};

}  // namespace voussoir
