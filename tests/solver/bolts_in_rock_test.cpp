// SPDX-License-Identifier: MIT
// Blocks that hang from cables, from bolts held by their ends and from yielding ones: how far they
// come down of which load, by every procedure, against the pull-out test and by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <type_traits>
#include <vector>
#include <voussoir/bolt/any_anchors.hpp>
#include <voussoir/bolt/any_bolt.hpp>
#include <voussoir/bolt/curve_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/load_in_steps.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/theory/pull_out.hpp>
#include <voussoir/tunnel/support_forces.hpp>

#include "support/blocks.hpp"
#include "support/laid_problem.hpp"
#include "support/near.hpp"

namespace bolts_in_rock_test {

using namespace voussoir;
using voussoir_test::LaidProblem;
using voussoir_test::near;
using voussoir_test::rectangle;

namespace {

constexpr int steps = 40;
constexpr double rigidity = 181e-6 * 98.6e9, bond = 0.175e6;
const BondedBolt strand{rigidity, 112e6, bond};
const Acceptance tight{.error_estimate = 1e-6,
                       .unbalance_over_weight = 1e-6,
                       .displacement_limit = 0.2,
                       .contact_update_limit = 0.15};

template <class Method>
using Blocks = Solver<CoulombJoint, AnyBolt, AnyAnchors, Method>;

/// Blocks one under the other from a fixed one down, 1 m wide, so high; all that hangs weighs and
/// is loaded so much [N per metre].
LaidProblem hung(const std::vector<double>& heights, double force) {
  LaidProblem problem;
  double top = heights.front(), hanging = 0;
  for (const double height : heights) {
    problem.blocks.push_back(rectangle({0, top - 0.5 * height}, 1, height));
    top -= height;
    if (problem.blocks.size() > 1) hanging += height;
  }
  problem.fixed = {0};
  problem.density = 10;  // next to nothing: the load decides
  problem.dead.resize(heights.size());
  problem.dead.back().force = {0, -(force - 10 * 9.81 * hanging)};
  return problem;
}

struct Answer {
  bool stands;
  double down;  ///< of the lowest block [m]
  std::vector<CrossingForce> forces;
};

/// Hung from one bolt a metre through all of them, from the lower face up, `above` into the first.
template <class Method>
Answer answer(const std::vector<double>& heights, double force, double above, const AnyBolt& law,
              const AnyAnchors& anchors) {
  auto blocks = hung(heights, force).solver<Blocks<Method>>(CoulombJoint({1e10, 1e10, 0.6}));
  double below = 0;
  for (std::size_t k = 1; k < heights.size(); ++k) below += heights[k];
  blocks.install_bolt(Segment{{0, -below}, {0, above}}, law, 1.0, anchors);
  // The path counts: a search moves, and what it overruns a bolt that gives has given.
  const auto reports = load_in_steps(blocks, {}, steps, Method(), tight);
  const EquilibriumReport& report = reports.back();
  const bool stands = report.verdict == Verdict::stable && report.fallen.empty();
  const int last = static_cast<int>(heights.size()) - 1;
  return {stands, stands ? -blocks.displacement_of(last, Vec2(0, -below)).y() : 0.0,
          bolt_forces(blocks)};
}

/// By how much a block is down. Relaxation moves under a step of load at once and overruns it: what
/// then gives is no more than another step would have made it give.
template <class Method>
void check_down(double down, double exact, double of_a_step_more, double tolerance) {
  CHECK(down > exact * (1 - tolerance));
  CHECK(down < (std::is_same_v<Method, Relaxation> ? of_a_step_more : exact) * (1 + tolerance));
}

}  // namespace

TEST_SUITE("solver/bolts_in_rock") {
  TEST_CASE_TEMPLATE("a block on a cable comes down as two pull-out tests say", Method, TwoLevel,
                     Relaxation, Explicit) {
    // 6 m on both sides of the joint: 44.7 MN/m and 1.5625 mm at the first slip each, 69.86 kN.
    const PullOut side({rigidity, 112e6, bond, 6});
    const auto hangs = [&](double force) {
      return answer<Method>({7, 6}, force, 6, CurveBolt(strand), LorigAnchors{});
    };
    const auto opens = [&](double force) { return 2 * side.at_force(force).displacement; };
    constexpr double more = 1 + 1.0 / steps;
    const Answer elastic = hangs(40e3);
    REQUIRE(elastic.stands);
    CHECK(elastic.down == near(2 * 40e3 / 44.708e6).epsilon(1e-4));
    CHECK(!elastic.forces.front().report.has_yielded());
    const Answer first = hangs(69.857e3);
    REQUIRE(first.stands);
    check_down<Method>(first.down, 2 * 1.5625e-3, opens(more * 69.857e3), 1e-4);
    for (const double force : {100e3, 400e3}) {
      const Answer slips = hangs(force);
      REQUIRE(slips.stands);
      REQUIRE(slips.forces.size() == 1);
      CHECK(slips.forces.front().report.axial == near(force).epsilon(1e-5));
      check_down<Method>(slips.down, opens(force), opens(more * force), 2e-3);  // of chords
      CHECK(slips.forces.front().report.has_yielded());
    }
  }

  TEST_CASE_TEMPLATE("a cable lets go where the bond of its shorter side is used up", Method,
                     TwoLevel, Relaxation) {
    // 0.5 m in the block: 87.5 kN; with a plate of 40 kN at its head 127.5 kN.
    const auto stands = [&](double force, double plate) {
      BondedBolt bolt = strand;
      bolt.plate_strength = plate;
      return answer<Method>({4, 0.5}, force, 3, CurveBolt(bolt), LorigAnchors{}).stands;
    };
    CHECK(stands(86e3, 0));
    CHECK(!stands(89e3, 0));
    CHECK(stands(126e3, 40e3));
    CHECK(!stands(129e3, 40e3));
  }

  TEST_CASE_TEMPLATE("a bolt held by its ends ties these alone, and holds what lies between",
                     Method, TwoLevel, Relaxation, Explicit) {
    // 1 + 1 + 1 m of 35.69 MN, on an anchor of 20 MN/m: 7.46 MN/m; 60 kN pull it out by 8.04 mm.
    EndAnchoredBolt bolt{35.69e6, 20e6, 90e3, 80e3};
    const auto hangs = [&](double force, double pretension) {
      return answer<Method>({2, 1, 1}, force, 1, CurveBolt(bolt, pretension), EndAnchors{});
    };
    const Answer held = hangs(60e3, 0);
    REQUIRE(held.stands);
    REQUIRE(held.forces.size() == 1);  // of two joints
    CHECK(held.forces.front().report.axial == near(60e3).epsilon(1e-5));
    CHECK(held.down == near(60e3 * (3 / 35.69e6 + 1 / 20e6)).epsilon(1e-4));
    // Tensioned first to 50 kN it lets them down by 10 kN alone, and presses joints until then.
    const Answer taut = hangs(60e3, 50e3);
    REQUIRE(taut.stands);
    CHECK(taut.down == near(10e3 * (3 / 35.69e6 + 1 / 20e6)).epsilon(1e-3));
    // Without its plate the bolt is lost, and all comes down.
    CHECK(hangs(78e3, 0).stands);
    CHECK(!hangs(82e3, 0).stands);
    // An anchor that slips below that lets go, too.
    bolt.anchor_strength = 70e3;
    CHECK(hangs(68e3, 0).stands);
    CHECK(!hangs(72e3, 0).stands);
  }

  TEST_CASE_TEMPLATE("a yielding bolt lets a block down as far as its load asks for", Method,
                     TwoLevel, Relaxation, Explicit) {
    // 40 MN/m to 120 kN at 3 mm, then to 170 kN at 53 mm: 145 kN at 28 mm.
    const CurveBolt law(
        BarStrength{.yield_force = 120e3, .rupture_force = 170e3, .rupture_extension = 0.05}
            .limited(BoltCurve::straight(40e6)));
    const auto hangs = [&](double force) {
      return answer<Method>({2, 1}, force, 1, law, LorigAnchors{});
    };
    CHECK(hangs(100e3).down == near(2.5e-3).epsilon(1e-4));
    const double a_step_more = 28e-3 + 145e3 / steps / 1e6;  // 1 MN/m beyond yield
    const Answer yields = hangs(145e3);
    REQUIRE(yields.stands);
    check_down<Method>(yields.down, 28e-3, a_step_more, 1e-4);
    CHECK(yields.forces.front().report.plastic_extension ==
          near(yields.down - 145e3 / 40e6).epsilon(1e-4));
    CHECK(!hangs(172e3).stands);
  }

  TEST_CASE("in one block a bolt held by its ends does nothing") {
    auto blocks = hung({2, 1}, 5e3).solver<Blocks<TwoLevel>>(CoulombJoint({1e10, 1e10, 0.6}));
    CHECK(blocks.install_bolt(Segment{{0, -0.9}, {0, -0.1}}, CurveBolt(EndAnchoredBolt{3e7}), 1.0,
                              EndAnchors{}) == 0);
    CHECK(blocks.install_bolt(Segment{{0, -0.9}, {0, 0.1}}, CurveBolt(EndAnchoredBolt{3e7}), 1.0,
                              EndAnchors{}) == 1);
  }
}

}  // namespace bolts_in_rock_test
