// SPDX-License-Identifier: MIT
// The bound by limit analysis on closed forms, and against a dense simplex of its own rows.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>
#include <voussoir/design/limit_load.hpp>

#include "support/degree.hpp"
#include "support/laid_limit_problem.hpp"
#include "support/laid_problem.hpp"
#include "support/limit_analysis.hpp"
#include "support/near.hpp"

namespace limit_load_test {

using namespace voussoir;
using namespace voussoir::design;
using namespace voussoir_test;

namespace {

LimitBound bound_of(const LaidProblem& laid, const JointStrength& strength) {
  return limit_load(limit_problem(laid, strength), {.width = 1e-6});
}

/// Both ends, within what may be missing of a block's weight, 1e-5.
void check_limit(const LimitBound& bound, double expected) {
  CAPTURE(expected);
  REQUIRE(bound.is_closed());
  CHECK(bound.holds == near(expected).epsilon(5e-5));
  CHECK(bound.fails == near(expected).epsilon(5e-5));
  CHECK(bound.gap() <= 1.001e-6);
}

/// A block 2 m long and 0.4 m high on level ground, and gravity turned.
LaidProblem block_on_incline(double slope) {
  LaidProblem laid{.blocks = {rectangle({1, -0.5}, 8, 1), rectangle({0, 0.2}, 2, 0.4)},
                   .fixed = {0}};
  laid.dead.resize(2);
  laid.dead[1].force = laid.weight(1) * Vec2(-std::sin(slope), 1 - std::cos(slope));
  return laid;
}

/// Whether the blocks are held with all of their strength: over 1.
bool is_held(const LaidProblem& laid, double friction) {
  const LimitBound bound =
      limit_load(limit_problem(laid, {friction, 0, 0}), {.width = 1, .least = 1});
  return bound.holds >= 1;
}

/// The proportional push that the dense simplex finds, from both sides.
void check_push(const LaidProblem& laid, double friction, const std::vector<Load2>& push) {
  const auto most = limit_factor(laid, friction, push);
  REQUIRE(most);
  REQUIRE(std::isfinite(*most));
  CAPTURE(*most);
  // As much as forces that count as balanced may leave: 1e-5 of a block's weight.
  const double margin = 3e-5 * std::max(1.0, *most);
  for (const double applied : {*most - margin, *most + margin}) {
    LaidProblem pushed = laid;
    std::vector<Load2> loads = push;
    for (Load2& load : loads) {
      load.force *= applied;
      load.moment *= applied;
    }
    pushed.add(loads);
    CAPTURE(applied);
    CHECK(is_held(pushed, friction) == (applied < *most));
  }
}

}  // namespace

TEST_SUITE("design/limit_load") {
  TEST_CASE("a block on an incline slides where friction and cohesion say") {
    const double slope = 30 * degree, weight = 2500 * 9.81 * 2 * 0.4;
    const LaidProblem laid = block_on_incline(slope);
    check_limit(bound_of(laid, {std::tan(50 * degree), 0, 0}),
                std::tan(50 * degree) / std::tan(slope));
    check_limit(
        bound_of(laid, {std::tan(25 * degree), 4e3, 0}),
        (4e3 * 2 + weight * std::cos(slope) * std::tan(25 * degree)) / (weight * std::sin(slope)));
    // It stands with friction of 10 degrees three times too little.
    check_limit(bound_of(laid, {std::tan(10 * degree), 0, 0}),
                std::tan(10 * degree) / std::tan(slope));
  }

  TEST_CASE("a block that is glued to a ceiling or a wall comes off where its bond says") {
    const double weight = 2500 * 9.81 * 2 * 0.4;
    // Under a ceiling: tension all over.
    const LaidProblem hanging{.blocks = {rectangle({0, 0.5}, 8, 1), rectangle({0, -0.2}, 2, 0.4)},
                              .fixed = {0}};
    check_limit(bound_of(hanging, {0.5, 60e3, 30e3}), 30e3 * 2 / weight);
    // Beside a wall: half of the bond pulls at the upper end, as much presses at the lower.
    const LaidProblem beside{.blocks = {rectangle({-0.5, 0}, 1, 4), rectangle({1, 0}, 2, 0.4)},
                             .fixed = {0}};
    check_limit(bound_of(beside, {0, 1e6, 200e3}), 200e3 * 0.4 * 0.4 / (weight * 2));
    // The same where the wall is below: without tension nothing holds it.
    const LimitBound loose = bound_of(hanging, {0.5, 60e3, 0});
    CHECK(loose.holds == 0);
    CHECK(loose.fails == near(0.01));
  }

  TEST_CASE("a bond in tension has less left for shear, and a moment has a sign") {
    LaidProblem pulled{.blocks = {rectangle({0, 0.5}, 8, 1), rectangle({0, -0.2}, 2, 0.4)},
                       .fixed = {0}};
    const double weight = pulled.weight(1);
    pulled.dead.resize(2);
    pulled.dead[1].force = Vec2(weight, 0);
    check_limit(bound_of(pulled, {0.5, 20e3, 40e3}), (20e3 * 2 - 0.5 * weight) / weight);
    // On a base that reaches from 1 m left of its middle to 0.2 m right of it.
    LaidProblem turned{.blocks = {rectangle({-2, -0.5}, 4.4, 1), rectangle({0, 0.5}, 2, 1)},
                       .fixed = {0}};
    for (const double moment : {0.99, -0.19, 1.01, -0.21}) {
      turned.dead.assign(2, {});
      turned.dead[1].moment = Spin<2>(moment * turned.weight(1));
      CAPTURE(moment);
      CHECK(is_held(turned, 0.5) == (moment > -0.2 && moment < 1));
    }
  }

  TEST_CASE("a block topples whatever its friction, or is held without any") {
    const LaidProblem slim{.blocks = {rectangle({0, -0.5}, 8, 1), rectangle({0, 1}, 0.5, 2)},
                           .fixed = {0}};
    const double tips = std::atan(0.25);
    for (const double slope : {0.99 * tips, 1.01 * tips}) {
      LaidProblem laid = slim;
      laid.dead.resize(2);
      laid.dead[1].force = laid.weight(1) * Vec2(-std::sin(slope), 1 - std::cos(slope));
      const LimitBound bound = bound_of(laid, {0.8, 0, 0});
      if (slope < tips)
        check_limit(bound, 0.8 / std::tan(slope));
      else
        CHECK(bound.holds == 0);
    }
    const LimitBound level = bound_of(slim, {0.8, 0, 0});
    CHECK(std::isinf(level.fails));
    CHECK(std::isinf(level.holds));
  }

  TEST_CASE(
      "a wedge in a roof between smooth sides is held while friction exceeds its half angle") {
    // Sides that push as hard as they must, as rollers do: however deep, it hangs on the angle.
    constexpr double half_angle = 20 * degree, friction = 0.9;
    const double t = std::tan(half_angle);
    LimitProblem<2> problem;
    // Wider below than above: the wedge would come down between two blocks beside it.
    const auto add = [&](const Vec2& centre, double weight) {
      problem.blocks.push_back({centre, weight, 0.5, {Vec2(0, -weight), Spin<2>(0.0)}, true});
    };
    add({0, 0.5}, 1e4);
    add({-2, 0.5}, 5e4);
    add({2, 0.5}, 5e4);
    const Vec2 right(std::cos(half_angle), std::sin(half_angle));
    problem.add_contact(0, 2, {Vec2(0.5, 0), Vec2(0.5 - t, 1)}, right, {friction, 0, 0});
    problem.add_contact(0, 1, {Vec2(-0.5, 0), Vec2(-0.5 + t, 1)}, Vec2(-right.x(), right.y()),
                        {friction, 0, 0});
    for (const double side : {-1.0, 1.0}) {
      const int beside = side < 0 ? 1 : 2;
      problem.add_edge(beside, {Vec2(3 * side, 0), Vec2(3 * side, 1)}, Vec2(side, 0));
      problem.add_edge(beside, {Vec2(1 * side, 0), Vec2(3 * side, 0)}, Vec2(0, -1));
    }
    check_limit(limit_load(problem, {.width = 1e-6}), friction / t);
  }

  TEST_CASE("random stacks that are pushed bear what a dense simplex says") {
    for (int number = 1; number <= 40; ++number) {
      CAPTURE(number);
      const LaidProblem stack = random_stack(number);
      const auto push = stack.pushed(Vec2(1, 0));
      if (!limit_factor(stack, 0.6, push)) continue;  // it does not stand alone
      for (const double friction : {0.3, 0.6}) check_push(stack, friction, push);
    }
  }

  TEST_CASE("an arch, a wall and a beam bear what a dense simplex says") {
    const LaidProblem arch = circular_arch(11, 1.5);
    check_push(arch, 0.6, arch.pushed(Vec2(1, 0)));
    check_push(arch, 0.35, arch.pushed(Vec2(1, 0)));
    const LaidProblem wall = dry_wall(6, 4);
    check_push(wall, 0.5, wall.pushed(Vec2(1, 0)));
    // Friction over what it can be divided by: where the arch begins to slide.
    const LimitBound bound = bound_of(arch, {0.6, 0, 0});
    REQUIRE(bound.is_closed());
    CHECK(limit_factor(arch, 0.6 / (bound.holds * (1 - 1e-6)), arch.pushed(Vec2(0, -1))));
    CHECK_FALSE(limit_factor(arch, 0.6 / (bound.fails * (1 + 1e-6)), arch.pushed(Vec2(0, -1))));
  }

  TEST_CASE("Goodman and Bray's slope topples below its limit load") {
    // Associated slip lifts the blocks that topple: limit analysis is no safe bound there.
    const LimitBound bound = bound_of(toppling_slope(), {1, 0, 0});
    REQUIRE(bound.is_closed());
    CAPTURE(bound.fails);
    CHECK(bound.fails > 1 / 0.7855);
    MESSAGE("Goodman and Bray: limit load at tan phi = " << 1 / bound.fails
                                                         << ", toppling at 0.7855");
    CHECK(limit_factor(toppling_slope(), 1 / (bound.holds * (1 - 1e-6)),
                       toppling_slope().pushed(Vec2(0, -1))));
    CHECK_FALSE(limit_factor(toppling_slope(), 1 / (bound.fails * (1 + 1e-6)),
                             toppling_slope().pushed(Vec2(0, -1))));
  }

  TEST_CASE("both ends prove themselves, and a solver that errs is found out") {
    const LimitProblem<2> problem =
        limit_problem(block_on_incline(30 * degree), {std::tan(50 * degree), 0, 0});
    const LimitBound bound = limit_load(problem);
    CHECK(bound.unbalance <= 1e-6);
    CHECK(bound.missing > 1e-6);
    // The mechanism: the block slides down and lifts by the friction that is left.
    const auto& v = bound.mechanism[1];
    CHECK(v[0] < 0);
    CHECK(v[1] / -v[0] == near(std::tan(50 * degree) / bound.fails).epsilon(1e-3));
    const InteriorPoint<3> solver({.asked = 1e-6});
    const auto with = [&](const auto& spoil) {
      return limit_load(problem, {}, {}, [&](const LinearProgramme& programme) {
        LinearSolution solution = solver(programme);
        spoil(solution);
        return solution;
      });
    };
    CHECK_THROWS_AS((void)with([](LinearSolution& s) {
                      s.is_solved = false;
                      s.multipliers.assign(s.multipliers.size(), 0.0);
                    }),
                    NumericalFault);
    CHECK_THROWS_AS((void)with([](LinearSolution& s) { s.unknowns[0] += 0.1; }), NumericalFault);
    // Multipliers that are no mechanism prove nothing.
    CHECK_THROWS_AS((void)with([](LinearSolution& s) {
                      for (double& y : s.multipliers) y *= 1e3;
                    }),
                    NumericalFault);
    CHECK_THROWS_AS((void)limit_load(problem, {}, [](double) { return false; }), Stopped);
  }

  TEST_CASE("bad settings are refused") {
    const LimitProblem<2> problem = limit_problem(block_on_incline(0.3), {1, 0, 0});
    CHECK_THROWS_WITH_AS((void)limit_load(problem, {.width = 0}),
                         doctest::Contains("width of a bound"), InvalidInput);
    CHECK_THROWS_WITH_AS((void)limit_load(problem, {.first = 0}), doctest::Contains("first factor"),
                         InvalidInput);
    CHECK_THROWS_WITH_AS((void)limit_load(problem, {.least = 2}), doctest::Contains("least factor"),
                         InvalidInput);
    CHECK_THROWS_WITH_AS((void)limit_load(problem, {.step = 1}),
                         doctest::Contains("step of factors"), InvalidInput);
    LimitProblem<2> fixed = problem;
    for (auto& block : fixed.blocks) block.is_free = false;
    CHECK_THROWS_WITH_AS((void)limit_load(fixed), doctest::Contains("no block is free"),
                         InvalidInput);
  }
}

}  // namespace limit_load_test
