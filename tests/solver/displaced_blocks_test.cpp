// SPDX-License-Identifier: MIT
// Fixed blocks that are displaced, and what stands on them.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/laid_blocks.hpp>
#include <voussoir/solver/load_in_steps.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>

#include "support/blocks.hpp"
#include "support/faults.hpp"
#include "support/near.hpp"

namespace displaced_blocks_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::degree;
using voussoir_test::rectangle;

namespace {

constexpr double density = 2500, stiff = 1e12;

/// A base with a block on it, tilted by so many steps of one degree.
/// @return  last angle at which the block stands [degrees]
template <class Solver, class Blocks, class Spin>
int tilted(const Blocks& blocks, const Spin& by_a_degree, double friction, int most) {
  Solver table(laid_blocks<typename Solver::Geometry>(blocks),
               CoulombJoint({stiff, stiff, friction}), {.density = density, .is_laid = true});
  table.fix(0);
  REQUIRE(table.equilibrium().verdict == Verdict::stable);
  const auto reports =
      load_in_steps(table, {{0, zeros<Vec<Solver::dim>>(), Spin(most * by_a_degree)}}, most);
  const bool stands = reports.back().verdict == Verdict::stable && reports.back().fallen.empty();
  return static_cast<int>(reports.size()) - (stands ? 0 : 1);
}

template <class Method>
int tilted_in_the_plane(double height, double friction) {
  return tilted<Solver<Method>>(std::vector<ConvexPolygon>{rectangle({0, -0.5}, 4, 1),
                                                           rectangle({0, 0.5 * height}, 1, height)},
                                Spin<2>(-degree), friction, 30);
}

}  // namespace

TEST_SUITE("solver/displaced_blocks") {
  TEST_CASE_TEMPLATE("a tilted base: a block slides at its friction angle and topples at b / h",
                     Method, TwoLevel, Relaxation, Explicit) {
    // atan(1 / 2.3) = 23.5 degrees. A state counts as balanced up to 1 % of a weight, which is 0.6
    // degrees of slope: limits lie further from whole degrees than that.
    CHECK(tilted_in_the_plane<Method>(2.3, 60 * degree) == 23);
    CHECK(tilted_in_the_plane<Method>(1.0, 17.2 * degree) == 17);
  }

  TEST_CASE("in 3-D about an axis that lies anyhow") {
    const auto about = [](double direction) {
      return tilted<Solver<Spatial>>(
          std::vector<ConvexPolyhedron>{brick({0, 0, -0.5}, {4, 4, 1}),
                                        brick({0, 0, 1.15}, {1, 1, 2.3})},
          Spin<3>(degree * Vec3(std::cos(direction), std::sin(direction), 0)), 60 * degree, 40);
    };
    CHECK(about(0) == 23);
    // Over a corner: atan(sqrt(2) / 2.3) = 31.6 degrees.
    CHECK(about(45 * degree) == 31);
  }

  TEST_CASE("all that is fixed moves as one: so does what stands on it, and no force changes") {
    // A lintel on two piers, of other stiffness than shear stiffness.
    Solver<> frame(laid_blocks<Planar>({rectangle({-2, -0.5}, 1, 1), rectangle({2, -0.5}, 1, 1),
                                        rectangle({0, 0.25}, 5, 0.5)}),
                   CoulombJoint({1e10, 4e9, 0.6}), {.density = density, .is_laid = true});
    frame.fix(0);
    frame.fix(1);
    REQUIRE(frame.equilibrium().verdict == Verdict::stable);
    const Vec2 before = frame.displacement_of(2, Vec2(0, 0.25));
    const auto forces = joint_states(frame);
    const Vec2 by(0.003, -0.007);
    const auto reports = load_in_steps(frame, {{0, by}, {1, by}}, 2);
    REQUIRE(reports.size() == 2);
    CHECK(reports.back().verdict == Verdict::stable);
    // Sums of half the displacement twice.
    CHECK((frame.displacement_of(2, Vec2(0, 0.25)) - before - by).norm() < 1e-12);
    const auto now = joint_states(frame);
    REQUIRE(now.size() == 2);
    // The search ends within a part of the error that is accepted.
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(now[k].report.normal == voussoir_test::near(forces[k].report.normal).epsilon(1e-6));
  }

  TEST_CASE("one pier settles: the lintel turns about the other, and carries as statics says") {
    Solver<> frame(
        laid_blocks<Planar>({rectangle({-2, -0.5}, 0.02, 1), rectangle({2, -0.5}, 0.02, 1),
                             rectangle({0, 0.25}, 5, 0.5)}),
        CoulombJoint({stiff, stiff, 0.6}), {.density = density, .is_laid = true});
    frame.fix(0);
    frame.fix(1);
    REQUIRE(frame.equilibrium().verdict == Verdict::stable);
    const Vec2 middle(0, 0.25);
    const Vec2 before = frame.displacement_of(2, middle);
    REQUIRE(load_in_steps(frame, {{1, Vec2(0, -0.01)}}, 5).back().verdict == Verdict::stable);
    // Knife edges 4 m apart: the middle between them goes down by half; each presses within its
    // 2 cm, 0.5 % of the way between them.
    const Vec2 moved = frame.displacement_of(2, middle) - before;
    CHECK(moved.y() == voussoir_test::near(-0.005).epsilon(0.005));
    const double weight = density * 9.81 * 2.5;
    for (const auto& at : joint_states(frame))
      CHECK(at.report.normal == voussoir_test::near(0.5 * weight).epsilon(0.01));
  }

  TEST_CASE("a base drawn away from under a block that is stopped: friction, all of it") {
    Solver<> stop(laid_blocks<Planar>({rectangle({0, -0.5}, 6, 1), rectangle({1, 0.5}, 1, 1),
                                       rectangle({2, 0.5}, 1, 1)}),
                  CoulombJoint({1e10, 1e10, std::atan(0.4)}),
                  {.density = density, .is_laid = true});
    stop.fix(0);
    stop.fix(2);
    REQUIRE(stop.equilibrium().verdict == Verdict::stable);
    const auto reports = load_in_steps(stop, {{0, Vec2(0.02, 0)}}, 4);
    REQUIRE(reports.size() == 4);
    CHECK(reports.back().verdict == Verdict::stable);
    for (const auto& at : joint_states(stop)) {
      if (at.a == 2 || at.b == 2) continue;
      // What the stop takes by its own friction is no part of it: both are at rest against it.
      CHECK(std::abs(at.report.shear) == voussoir_test::near(0.4 * at.report.normal).epsilon(1e-6));
    }
  }

  TEST_CASE("a displacement that makes no sense is refused, and nothing has moved") {
    using voussoir_test::refusal_of;
    using voussoir_test::says;
    Solver<> wall(laid_blocks<Planar>({rectangle({0, -0.5}, 4, 1), rectangle({0, 0.5}, 1, 1),
                                       rectangle({9, 0.5}, 1, 1)}),
                  CoulombJoint({1e10, 1e10, 0.6}), {.density = density, .is_laid = true});
    wall.fix(0);
    const Vec2 by(0.001, 0);
    CHECK(says(refusal_of([&] { wall.displace({{0, by}, {1, by}}); }), "the block is free"));
    CHECK(wall.system().displacement.norm() == 0);
    CHECK(says(refusal_of([&] { wall.displace({{7, by}}); }), "0 to 2"));
    CHECK(says(refusal_of([&] { wall.displace({{0, Vec2(NAN, 0)}}); }), "finite"));
    CHECK(says(refusal_of([&] { (void)load_in_steps(wall, {}, 0); }), "steps"));
    CHECK(wall.equilibrium().fallen == std::vector<int>{2});  // nothing holds it
    CHECK(says(refusal_of([&] { wall.displace({{2, by}}); }), "has fallen"));
    CHECK(says(refusal_of([&] { wall.add_body_force(Vec2(0, INFINITY)); }), "finite"));
  }

  TEST_CASE("a body force is the same load on every block, over its weight") {
    const auto blocks = [] {
      return laid_blocks<Planar>(
          {rectangle({0, -0.5}, 4, 1), rectangle({0, 0.5}, 1, 1), rectangle({0, 1.25}, 0.8, 0.5)});
    };
    Solver<> at_once(blocks(), CoulombJoint({1e10, 1e10, 0.6}),
                     {.density = density, .is_laid = true});
    Solver<> one_by_one(at_once);
    for (Solver<>* tower : {&at_once, &one_by_one}) tower->fix(0);
    at_once.add_body_force(Vec2(0.2, 0.1));
    for (int b : {1, 2})
      one_by_one.add_load(b, {Vec2(one_by_one.system().body(b).weight * Vec2(0.2, 0.1))});
    (void)at_once.equilibrium();
    (void)one_by_one.equilibrium();
    CHECK(at_once.system().load == one_by_one.system().load);
    // What is held of two loads is added in another order than that of one.
    CHECK((at_once.system().displacement - one_by_one.system().displacement).norm() <
          1e-9 * at_once.system().displacement.norm());
  }
}

}  // namespace displaced_blocks_test
