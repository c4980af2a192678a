// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Whether a stage in which blocks come off, or nearly, is followed in other ways too, each from
/// where it parts: with half and with three times the displacement limit; with other damping, and
/// at half the rate, from where blocks become fast (`EquilibriumReport::rockfall`).
enum class RangeSought {
  none,
  until_marginal,  ///< no further than it takes to know whether it is
  all,             ///< and whether the stage is near to what counts as a collapse
};

/// What is true where rock fails: the stage as it happens, in time.
///
/// The walls are unloaded slowly, along a ramp of eight times the time in which a block falls
/// through the displacement limit: in a quarter of it rock comes off that a slower ramp spares. A
/// block that has moved further than that limit has come off and is taken out: what it held up may
/// follow. The stage is over when the blocks that are left are in balance and so slow that none
/// would come off within `patience`; or when more has come off than a collapse needs. Dashpots at
/// contacts take the energy out, and not local damping, which takes its part of the blows within a
/// mechanism and so holds it; contacts follow the blocks wherever they go. The smallest tenth of
/// the blocks is made as inert as the next, so that slivers do not set the step: with the smaller
/// half, which halves the number of steps, other blocks came off in one tunnel of forty. And of
/// thousands of blocks only the few that move are stepped.
///
/// Held against all blocks in motion, and the same with half the step and half the rate:
/// tests/equilibrium/rock_failure_test.cpp, bench/failure_table.cpp.
struct MotionTuning {
  double viscous_damping = 0.3;  ///< of dashpots at contacts, ratio to critical [-], >= 0
  /// Besides: linings, bolts and shear springs have no dashpots. Much of it holds up what should
  /// fall [-], >= 0 and < 1.
  double local_damping = 0.1;
  double safety = 0.9;       ///< of the stable step [-], > 0 and <= 1
  double inert_share = 0.1;  ///< of the bodies get more inertia, for longer steps [-]
  double ramp = 8;           ///< its duration over the time of a fall through the limit [-], > 0
  double rest_ratio = 1e-2;  ///< out-of-balance force ratio at rest [-], > 0; less if accepted
  double patience = 2;       ///< at rest nothing would come off within so long [s], > 0
  double longest = 30;       ///< after which no end is expected [s], > 0
  int looks_in_ramp = 800;   ///< times that the load is changed, and what has come off looked for
  int looks_at_once = 4;     ///< in the ramp, while all that move are slow, > 0
  int check_every = 50;      ///< steps between two looks afterwards
  // Who is stepped: bodies that are fast or out of balance, and rings around them. All others are
  // brought to balance elastically (`detail::ElasticBalance`).
  double quiet_speed =
      0.3;                ///< of the speed that comes off within `patience`: faster is fast, >= 0
  double slow = 0.02;     ///< of the speed that is fast, >= 0
  int rings = 2;          ///< of bodies that those touch; < 0: all bodies are stepped
  double looseness = 10;  ///< times `rest_ratio`, at which one that is not stepped is seen to, >= 1
  int batches = 20;       ///< of `check_every` steps, after which all are seen to in any case
  unsigned threads = 1;   ///< that share the steps; the result does not depend on it
  RangeSought range = RangeSought::none;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(viscous_damping >= 0 && std::isfinite(viscous_damping), "viscous_damping",
            viscous_damping, ">= 0");
    require(local_damping >= 0 && local_damping < 1, "local_damping", local_damping,
            ">= 0 and < 1");
    require(safety > 0 && safety <= 1, "safety", safety, "> 0 and <= 1");
    require(inert_share >= 0 && inert_share < 1, "inert_share", inert_share, ">= 0 and < 1");
    require(ramp > 0, "ramp", ramp, "> 0");
    require(rest_ratio > 0, "rest_ratio", rest_ratio, "> 0");
    require(patience > 0, "patience", patience, "> 0 s");
    require(longest > 0, "longest", longest, "> 0 s");
    require(looks_in_ramp > 0, "looks_in_ramp", looks_in_ramp, "> 0");
    require(looks_at_once > 0, "looks_at_once", looks_at_once, "> 0");
    require(check_every > 0, "check_every", check_every, "> 0");
    require(looseness >= 1, "looseness", looseness, ">= 1");
    require(batches > 0, "batches", batches, "> 0");
    require(quiet_speed >= 0, "quiet_speed", quiet_speed, ">= 0");
    require(slow >= 0, "slow", slow, ">= 0");
  }
};

}  // namespace voussoir
