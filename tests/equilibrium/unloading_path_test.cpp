// SPDX-License-Identifier: MIT
// Friction remembers the path: a stage solved at once gives what a gradual unloading gives.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/jointed_rock.hpp"

namespace unloading_path_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

const TwoLevel in_one_step({.increments = 1});
constexpr double relaxed = 0.75;  // traction left when the supports come

/// Deep, bolted and lined while most of the traction is left, in rock that slips much.
Solver<> supported(std::uint64_t seed) {
  Random random(61, seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  const auto opening = horseshoe_opening(between(4, 6), between(1, 2), 32);
  const double stiffness = between(3e9, 20e9), friction = between(20, 40);
  Solver<> tunnel(jointed_rock(domain_around(opening, 30, 10, 12), seed),
                  CoulombJoint({stiffness, between(0.1, 0.5) * stiffness, friction * degree}),
                  {.density = 2700, .k0 = between(0.5, 2), .surcharge = between(1e6, 7e6)});
  tunnel.excavate(opening);
  REQUIRE(tunnel.equilibrium(relaxed, in_one_step).verdict == Verdict::stable);
  for (const auto& bar : bolt_bars({.length = 4, .angular_spacing = 20 * degree}, opening))
    tunnel.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8}));
  tunnel.install_lining(lining_frame(tunnel.mass(), {}), LiningSection::rectangular(0.15, 25e9),
                        CoulombJoint({2e9, 2e9, 30 * degree}));
  return tunnel;
}

/// Of crown and supports, over the larger value.
double apart(const Solver<>& a, const Solver<>& b) {
  const auto ratio = [](double x, double y) {
    return std::abs(x - y) / std::max(std::abs(x), std::abs(y));
  };
  const SupportDemand in_a = support_demand(a), in_b = support_demand(b);
  return std::max({ratio(convergence(a).crown, convergence(b).crown),
                   ratio(in_a.mean_thrust, in_b.mean_thrust),
                   ratio(in_a.mean_bolt_force, in_b.mean_bolt_force)});
}

}  // namespace

TEST_SUITE("equilibrium/unloading_path") {
  /// Tunnels that stand, and those that one step alone puts elsewhere.
  struct Compared {
    int tunnels = 0, one_step_apart = 0;
  };
  Compared compare(std::uint64_t seeds) {
    Compared compared;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      CAPTURE(seed);
      Solver<> one_call = supported(seed), one_step = one_call, stages = one_call;
      if (one_call.equilibrium(0).verdict != Verdict::stable) continue;
      REQUIRE(one_step.equilibrium(0, in_one_step).verdict == Verdict::stable);
      for (int k = 1; k <= 32; ++k)
        REQUIRE(stages.equilibrium(relaxed - relaxed * k / 32, in_one_step).verdict ==
                Verdict::stable);
      ++compared.tunnels;
      // A fifth of the 1 % by which procedures may differ.
      CHECK(apart(one_call, stages) <= 2e-3);
      compared.one_step_apart += apart(one_step, stages) > 2e-3;
    }
    return compared;
  }
  TEST_CASE("one call is within 0.2 % of 32 stages where one step is not") {
    const Compared compared = compare(4);
    CHECK(compared.tunnels == 4);
    CHECK(compared.one_step_apart >= 1);
  }
  TEST_CASE("one call is within 0.2 % of 32 stages, ten tunnels [long]") {
    const Compared compared = compare(10);
    CHECK(compared.tunnels >= 8);
    CHECK(compared.one_step_apart >= 3);
  }
}

}  // namespace unloading_path_test
