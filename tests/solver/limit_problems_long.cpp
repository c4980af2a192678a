// SPDX-License-Identifier: MIT
// A dry wall that is pushed: blocks slip past each other there, and limit analysis, which lets them
// dilate as they do, is above what stands, unless they dilate.
#include <doctest/doctest.h>

#include <cmath>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/laid_problem.hpp"
#include "support/limit_analysis.hpp"

namespace limit_problems_long {

using namespace voussoir;
using voussoir_test::dry_wall;
using voussoir_test::LaidProblem;
using voussoir_test::limit_factor;

namespace {

constexpr double tan_friction = 0.7;

bool wall_stands(LaidProblem wall, double push, bool dilates) {
  wall.add(wall.pushed(Vec2(1, 0), push));
  const double angle = std::atan(tan_friction);
  auto solver = wall.solver<Solver<MohrCoulombJoint>>(
      MohrCoulombJoint({.joint_normal_stiffness = 1e12,
                        .joint_shear_stiffness = 1e12,
                        .friction_angle = angle,
                        .dilation_angle = dilates ? angle : 0,
                        .dilation_limit = dilates ? 1.0 : 0}));
  return solver.equilibrium().verdict == Verdict::stable && solver.fallen().empty();
}

}  // namespace

TEST_SUITE("solver/limit_problems_long") {
  TEST_CASE("a dry wall stands up to limit analysis if its joints dilate, and not otherwise") {
    const LaidProblem wall = dry_wall(4, 4);
    const double limit = limit_factor(wall, tan_friction, wall.pushed(Vec2(1, 0))).value();
    // 1 % of a block's weight may be out of balance, 1.5 % of the push.
    CHECK(wall_stands(wall, 0.98 * limit, true));
    CHECK(!wall_stands(wall, 1.03 * limit, true));
    CHECK(wall_stands(wall, 0.94 * limit, false));
    CHECK(!wall_stands(wall, 0.98 * limit, false));
  }
}

}  // namespace limit_problems_long
