// SPDX-License-Identifier: MIT
// Goodman and Bray's slope of 16 blocks through `Solver` by every procedure: the friction at which
// it topples, and the force at its toe that holds it where friction is less. Closed forms f.3.
#include <doctest/doctest.h>

#include <cmath>
#include <tuple>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/laid_problem.hpp"
#include "support/limit_analysis.hpp"
#include "support/reference.hpp"

namespace toppling_slope_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::LaidProblem;
using voussoir_test::limit_factor;
using voussoir_test::reference;
using voussoir_test::toppling_slope;

namespace {

using Procedures = std::tuple<TwoLevel, Relaxation, Explicit>;

constexpr double toe_force = 2010.4e3;  ///< with tan phi = 0.65, closed forms f.3 [N]

/// @param toe      force on the lowest block, as of an anchor that dips into the slope by 4 degrees
///                 [N]
/// @param unbalance  of the worst block that is accepted, over its weight
template <class Method>
bool stands(double tan_friction, double toe,
            double unbalance = Acceptance{}.unbalance_over_weight) {
  LaidProblem slope = toppling_slope();
  const double direction = -34 * degree;  // the base dips by 30, and is level here
  slope.dead[1].force += toe * Vec2(std::cos(direction), std::sin(direction));
  constexpr double stiff = 1e11;  // the highest block sinks by 10 um
  auto solver = slope.solver<Solver<Method>>(CoulombJoint({stiff, stiff, std::atan(tan_friction)}));
  Acceptance close;
  close.unbalance_over_weight = unbalance;
  return solver.equilibrium(0, Method{}, close).verdict == Verdict::stable &&
         solver.fallen().empty();
}

}  // namespace

TEST_SUITE("solver/toppling_slope") {
  TEST_CASE_TEMPLATE_DEFINE(
      "it topples at the friction of Goodman and Bray, and is held at the toe", Method, slope) {
    // Blocks tip about edges, and all faces between those that topple slip: the closed form has no
    // stiffness. Hinges in joints of 1e11 Pa/m and friction on the way take 1 % of it.
    const double limit = reference("F.gb.tanphi_limit");
    CHECK(!stands<Method>(0.98 * limit, 0));
    CHECK(stands<Method>(1.02 * limit, 0));
    // 2 010 kN/m with tan phi = 0.65; 2 013 in print. The slope creeps for long there, and a search
    // is undecided up to 3 % above.
    CHECK(!stands<Method>(0.65, 0.96 * toe_force));
    CHECK(stands<Method>(0.65, 1.05 * toe_force));
  }
  TEST_CASE_TEMPLATE_APPLY(slope, Procedures);

  TEST_CASE("a tenth of that out of balance leaves 2 % of the force at the toe") {
    CHECK(!stands<TwoLevel>(0.65, 0.98 * toe_force, 1e-3));
    CHECK(stands<TwoLevel>(0.65, 1.02 * toe_force, 1e-3));
  }

  TEST_CASE("limit analysis, which lets joints dilate, is no safe bound of it") {
    // Forces without tension and within friction that balance all blocks exist well below the
    // friction at which the slope topples: nothing makes the joints carry them.
    const LaidProblem slope = toppling_slope();
    const std::vector<voussoir_test::Load2> none(slope.blocks.size());
    CHECK(limit_factor(slope, 0.67, none).has_value());
    CHECK(!limit_factor(slope, 0.65, none).has_value());
  }
}

}  // namespace toppling_slope_test
