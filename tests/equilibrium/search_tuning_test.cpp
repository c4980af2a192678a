// SPDX-License-Identifier: MIT
// The numbers inside the search: refused out of range, and not what an answer depends on.
#include <doctest/doctest.h>

#include <functional>
#include <vector>
#include <voussoir/equilibrium/two_level.hpp>

#include "support/bolted_tunnel.hpp"

namespace search_tuning_test {

using namespace voussoir_test;
using Params = TwoLevel::Params;
using Change = std::function<void(Params&)>;

TEST_SUITE("equilibrium/search_tuning") {
  TEST_CASE("a number out of its range is refused, whichever part it is of") {
    for (const Change& spoil :
         std::vector<Change>{[](Params& p) { p.local.active_above = 0; },
                             [](Params& p) { p.local.first_reach = 0; },
                             [](Params& p) { p.local.longest_step = 1.5; },
                             [](Params& p) { p.local.reach_growth = 0.5; },
                             [](Params& p) { p.local.reach_shrinkage = 1; },
                             [](Params& p) { p.local.shortest_reach = 0; },
                             [](Params& p) { p.local.shortest_step = 1; },
                             [](Params& p) { p.local.accepted_growth = 0.9; },
                             [](Params& p) { p.local.spoilt_factor = 0; },
                             [](Params& p) { p.local.spoilt_addition = -1; },
                             [](Params& p) { p.correction.exactness = 1; },
                             [](Params& p) { p.correction.share_of_error = 0; },
                             [](Params& p) { p.correction.residual_growth = 0; },
                             [](Params& p) { p.correction.shortest = 0; },
                             [](Params& p) { p.detachment.far_limit = 2; },
                             [](Params& p) { p.detachment.far_blocks = 0; },
                             [](Params& p) { p.detachment.first_look = 1; },
                             [](Params& p) { p.detachment.second_look = 0; },
                             [](Params& p) { p.restart.follow_to = 0; },
                             [](Params& p) { p.restart.follow_closer = 1; },
                             [](Params& p) { p.path.one_step_share = -0.1; },
                             [](Params& p) { p.path.looseness = 0.9; },
                             [](Params& p) { p.path.burst_steps = 0; },
                             [](Params& p) { p.path.turn = 0; },
                             [](Params& p) { p.path.halvings = -1; },
                             [](Params& p) { p.path.open = -1; },
                             [](Params& p) { p.path.jump = 0; },
                             [](Params& p) { p.motion.viscous_damping = -0.1; },
                             [](Params& p) { p.motion.local_damping = 1; },
                             [](Params& p) { p.motion.safety = 0; },
                             [](Params& p) { p.motion.inert_share = 1; },
                             [](Params& p) { p.motion.ramp = 0; },
                             [](Params& p) { p.motion.rest_ratio = 0; },
                             [](Params& p) { p.motion.patience = -1; },
                             [](Params& p) { p.motion.longest = 0; },
                             [](Params& p) { p.motion.looks_in_ramp = 0; },
                             [](Params& p) { p.motion.check_every = 0; },
                             [](Params& p) { p.motion.quiet_speed = -1; },
                             [](Params& p) { p.motion.looseness = 0.5; },
                             [](Params& p) { p.motion.batches = 0; },
                             [](Params& p) { p.restart.updates = -1; },
                             [](Params& p) { p.restart.updates_on_the_way = -1; },
                             [](Params& p) { p.fire.largest_step = 1; },
                             [](Params& p) { p.fire.first_step = 0.9; },
                             [](Params& p) { p.fire.mixing = 2; },
                             [](Params& p) { p.fire.patience = -1; },
                             [](Params& p) { p.fire.step_growth = 0.5; },
                             [](Params& p) { p.fire.step_cut = 1; },
                             [](Params& p) { p.fire.mixing_decay = 0; },
                             [](Params& p) { p.fallback.active_above = 0; },
                             [](Params& p) { p.fallback.detachment.far_limit = 0; }}) {
      Params params;
      CHECK_NOTHROW((void)TwoLevel(params));
      spoil(params);
      CHECK_THROWS_AS((void)TwoLevel(params), InvalidInput);
    }
  }

  TEST_CASE("a bolted tunnel comes to the same equilibrium, whatever the numbers") {
    for (const double factor : {0.5, 2.0}) {
      CAPTURE(factor);
      Params params;
      params.local.active_above *= factor;
      params.local.first_reach *= factor;
      params.local.reach_growth *= factor;
      params.local.spoilt_addition *= factor;
      params.correction.exactness *= factor;
      params.correction.residual_growth *= factor;
      params.fire.mixing *= factor;
      Solver<> tunnel = bolted_tunnel();
      const EquilibriumReport report = tunnel.equilibrium(0, TwoLevel(params));
      REQUIRE(report.verdict == Verdict::stable);
      CHECK(report.fallen.empty());
      // Accepted at an estimate of 1e-3, which tells the true error within a factor of two.
      const Eigen::VectorXd miss = translations(tunnel) - translations(exact_tunnel());
      CHECK(tunnel.system().largest_translation(miss) / report.largest_displacement < 2e-3);
    }
  }
}

}  // namespace search_tuning_test
