// SPDX-License-Identifier: MIT
// A lining installed after a block has fallen out of the roof: it fills the hole that is there and
// bears on the rock behind it, as where that piece was dropped when the opening was carved.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/degree.hpp"
#include "support/near.hpp"

namespace blocks_behind_lining_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::near;

namespace {

const CoulombJoint joint({5e9, 2e9, 40 * degree});
const CoulombJoint interface_law({5e9, 2e9, 30 * degree});
const InSitu in_situ{.density = 2700, .k0 = 1};
const SimplePolygon opening({{-2, -1.5}, {2, -1.5}, {2, 1.5}, {-2, 1.5}});
const Domain<2> ground{{-12, -8}, {12, 10}};
const FootBearing feet({.width = 0.15, .stiffness = 1e9, .friction_angle = 35 * degree});

/// Beds 2 m apart, of which one lies `depth` above the roof, with joints across them, 3 m apart. In
/// the slab between that bed and the roof two joints dip outwards, steeper than friction, so that
/// nothing holds its four pieces.
std::vector<Joint> beds(double depth) {
  std::vector<Joint> joints;
  const double bed = 1.5 + depth;
  for (int k = -5; k <= 4; ++k) {
    const double low = bed + 2 * k;
    joints.push_back({{{-14, low}, {14, low}}, 0});
    for (double x = k % 2 == 0 ? -10.4 : -11.5; x < 12; x += 3) {
      if (k == -1 && std::abs(x) < 2) continue;
      joints.push_back({{{x, low}, {x, low + 2}}, 1});
    }
  }
  for (const double side : {-1.0, 1.0})
    joints.push_back({{{side * (bed - 0.4), 1.4}, {side, bed}}, 2});
  return joints;
}

struct Answer {
  double thrust, moment;
  int gaps;  ///< nodes with nothing behind them
};

/// @param drops  the slab when the opening is carved; else it falls in the first stage
template <class Method>
Answer answer_of(double depth, bool drops, double fill_depth) {
  using Tunnel = Solver<CoulombJoint, Method>;
  Tunnel tunnel(slice(ground, beds(depth), {0, 1e30}), joint, in_situ);
  Construction<Tunnel> plan;
  plan.acceptance.error_estimate = 1e-4;
  plan.add_stage("excavation").excavate(opening, drops ? 2.3 * depth : 0);
  plan.add_stage("lining").install_lining(
      {{.nodes = 40, .from = -20 * degree, .to = 200 * degree, .fill_depth = fill_depth},
       {LiningSection::rectangular(0.15, 25e9)},
       interface_law,
       {},
       feet});
  const auto built = construct(tunnel, plan);
  INFO(built.last().reason);
  CHECK(built.verdict() == Verdict::stable);
  CHECK(tunnel.fallen().size() == (drops ? 0 : 4));
  CHECK(tunnel.mass().dropped.size() == (drops ? 4 : 0));
  CHECK(tunnel.fallen_measure() + tunnel.mass().carving.dropped_measure == near(3 * depth));
  // Half as heavy again: what the lining carries.
  tunnel.add_body_force({0, -0.5});
  CHECK(tunnel.equilibrium(0, {}, plan.acceptance).verdict == Verdict::stable);
  const auto demand = support_demand(tunnel);
  return {demand.largest_thrust, demand.largest_moment, support_condition(tunnel).gaps};
}

}  // namespace

TEST_SUITE("solver/blocks_behind_lining") {
  TEST_CASE_TEMPLATE("the lining bears on what is behind a fallen block", Method, TwoLevel,
                     Relaxation, Explicit) {
    for (const double depth : {0.15, 0.2}) {
      CAPTURE(depth);
      const Answer fallen = answer_of<Method>(depth, false, 0.5),
                   dropped = answer_of<Method>(depth, true, 0.5);
      // The slab is no part of what carries: two searches to an error of 1e-4 each are apart.
      CHECK(fallen.thrust == near(dropped.thrust).epsilon(1e-3));
      CHECK(fallen.moment == near(dropped.moment).epsilon(1e-3));
      CHECK(fallen.gaps == 0);
      CHECK(dropped.gaps == 0);
      // What is not filled is said, and is another lining: it was, silently, what came out.
      const Answer spanned = answer_of<Method>(depth, false, 0.1);
      CHECK(spanned.gaps > 5);
      CHECK(std::abs(spanned.moment - fallen.moment) > 0.2 * fallen.moment);
    }
  }

  TEST_CASE("a lining made as if the fallen block were there has a gap there, and says so") {
    Solver<> tunnel(slice(ground, beds(0.2), {0, 1e30}), joint, in_situ);
    tunnel.excavate(opening, 0);
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    REQUIRE(tunnel.fallen().size() == 4);
    const LiningFrame<Planar> frame = lining_frame(tunnel.mass(), LiningRing{.nodes = 40});
    CHECK(frame.gaps.empty());
    tunnel.install_lining(frame, LiningSection::rectangular(0.15, 25e9), interface_law);
    // The slab is 3 m of the roof, a node has 0.35 m of it, and at either end one has a part.
    const int gaps = support_condition(tunnel).gaps;
    CHECK(gaps >= 8);
    CHECK(gaps <= 10);
  }

  TEST_CASE_TEMPLATE("a block that is held bears on the lining, too", Method, TwoLevel, Relaxation,
                     Explicit) {
    using Tunnel = Solver<CoulombJoint, Method>;
    Tunnel tunnel(slice(ground, beds(1.2), {0, 1e30}), joint, in_situ);
    tunnel.excavate(opening, 0);
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    const int block = detail::body_at<Planar>(tunnel.mass(), {0, 1.55});
    tunnel.fix(block);
    tunnel.install_lining(lining_frame(tunnel.mass(), LiningRing{.nodes = 40}, tunnel.fallen()),
                          LiningSection::rectangular(0.15, 25e9), interface_law);
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    CHECK(support_demand(tunnel).largest_moment < 1);  // it stands free of force
    tunnel.displace({{block, {0, -1e-4}}});
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    CHECK(support_demand(tunnel).largest_moment > 1e3);  // 1.5e3 to 1.7e3 by the three
  }
}

}  // namespace blocks_behind_lining_test
