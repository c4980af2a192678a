// SPDX-License-Identifier: MIT
// Loose blocks that nobody picked, dropped and poured: no energy is made, whatever the damping, and
// nobody passes through anybody. Impacts of every kind are damped with the ratio asked for.
#include "support/loose_blocks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/faults.hpp"
#include "support/near.hpp"

namespace loose_blocks_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::LooseBlocks;
using voussoir_test::rectangle;

namespace {

using Dims = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

/// One impact of two bodies: how fast the points that touch part again, over how fast
/// they met [-].
template <int Dim>
struct OneImpact {
  static constexpr double zeta = 0.2;
  Dynamics<Dim, CoulombJoint> run{
      CoulombJoint({5e9, 5e8, 0}),
      {.gravity = 0, .viscous_damping = zeta, .safety = 0.01, .speed_limit = 100}};

  /// @param arm  from the centre of body b to where it is struck;  @param normal  towards b
  double parting(int b, const Vec<Dim>& arm, const Vec<Dim>& normal, double duration) {
    const auto speed = [&] {
      return normal.dot(run.velocity(b)) + moment_of(arm, normal).dot(run.spin(b));
    };
    const double before = speed();
    run.advance(duration);
    return -speed() / before;
  }
};

/// Spring and dashpot together never pull: closed forms f.8.
double restitution(double zeta) {
  const double root = std::sqrt(1 - zeta * zeta);
  return std::exp(-zeta / root * std::atan2(2 * zeta * root, 2 * zeta * zeta - 1));
}

}  // namespace

TEST_SUITE("dynamics/loose_blocks") {
  // The limits are those of the issue that asked for it, 1 % of what is at stake. 1 000 cases of
  // 20 000 steps: bench/energy_table, docs/validation.md.
  TEST_CASE_TEMPLATE_DEFINE("dropped and poured, blocks gain no energy", Constant, no_energy_made) {
    constexpr int dim = Constant::value;
    for (int number = 2000; number < 2024; ++number) {
      CAPTURE(number);
      LooseBlocks<dim> blocks(number);
      const auto account = blocks.advance(dim == 2 ? 6000 : 3000);
      CHECK(account.stake > 0);
      CHECK(account.made < 0.01);
      // They take away or do nothing: not one contact gets more than was there, but for rounding.
      CHECK(account.updates < 1e-12);
      CHECK(account.given < 1e-12);
      auto& run = blocks.run();
      for (int b = 0; b < run.body_count(); ++b)
        if (run.body(b).movable()) CHECK(run.position(b)[dim - 1] > 0);
    }
  }
  TEST_CASE_TEMPLATE_APPLY(no_energy_made, Dims);

  TEST_CASE("a contact that is found deep gives back nothing, one that was pressed what it took") {
    // Two squares overlap by 2 cm, for they were added while the run went on; they are at rest.
    Dynamics<2, CoulombJoint> run(CoulombJoint({5e9, 5e8, 0.6}), {.gravity = 0});
    const int floor = run.add_fixed_block(rectangle({0, -0.5}, 4, 1));
    run.add_block(rectangle({1.2, 0.6}, 0.5, 0.5), 2700);
    run.advance(1e-3);
    const int late = run.add_block(rectangle({-0.5, 0.48}, 1, 1), 2700);
    run.advance(0.01);
    CHECK(run.kinetic_energy() == 0);
    CHECK(run.contact_load(late).force.norm() == 0);
    // Driven in at 1 m/s it comes back at 1 m/s, not faster: within the error of the steps, q / 4
    // with q <= 2 safety^2.
    run.set_velocity(late, {0, -1});
    run.advance(0.05);
    CHECK(run.velocity(late).y() > 1 - 0.125);
    CHECK(run.velocity(late).y() < 1 + 0.125);
    CHECK(run.body(floor).movable() == false);
  }

  TEST_CASE("a block that lies in another is named, though it presses on nothing") {
    Dynamics<2, CoulombJoint> run(CoulombJoint({5e9, 5e8, 0.6}), {.gravity = 0});
    run.add_fixed_block(rectangle({0, -0.5}, 4, 1));
    run.add_block(rectangle({1.2, 0.6}, 0.5, 0.5), 2700);
    run.advance(1e-3);
    const int late = run.add_block(rectangle({-0.5, 0.2}, 1, 1), 2700);  // 30 cm deep, of 71
    const std::string text = voussoir_test::fault_of([&] { run.advance_steps(200); });
    CAPTURE(text);
    CHECK(voussoir_test::says(text, "block " + std::to_string(late) + " at (-0.5, 0.2) m"));
    CHECK(voussoir_test::says(text, "by 300 mm, more than 30 %"));
  }

  TEST_CASE("a sliver is struck as wide as a corner would crush") {
    // A square comes down at 10 m/s on another that it overlaps by 1 mm. Both turn about corners:
    // 1 / m = 2 (1 + 0.4995^2 / (1 / 6)) / 2700. A spring d long lets it come d deep if
    // v^2 m / k = d^3.
    const double mass = 0.5 * 2700 / (1 + 6 * 0.4995 * 0.4995);
    const double width = std::cbrt(100 * mass / 5e9);
    Dynamics<2, CoulombJoint> run(CoulombJoint({5e9, 5e8, 0.3}),
                                  {.gravity = 0, .speed_limit = 100});
    run.add_block(rectangle({0, 0}, 1, 1), 2700);
    const int b = run.add_block(rectangle({0.999, 1.01}, 1, 1), 2700);
    run.set_velocity(b, {0, -10});
    run.advance(0.9e-3);  // 1 mm above it
    const auto area = [&] {
      double sum = 0;
      for (const auto& p : run.joints().points()) sum += p.weight;
      return sum;
    };
    REQUIRE(run.joints().size() == 1);
    CHECK(area() == voussoir_test::near(width).epsilon(1e-3));
    CHECK(width > 0.02);
    // Come down slowly it bears on what there is.
    Dynamics<2, CoulombJoint> slow(CoulombJoint({5e9, 5e8, 0.3}), {.gravity = 0});
    slow.add_block(rectangle({0, 0}, 1, 1), 2700);
    slow.set_velocity(slow.add_block(rectangle({0.999, 1.01}, 1, 1), 2700), {0, -1e-3});
    slow.advance(7);
    REQUIRE(slow.joints().size() == 1);
    double sum = 0;
    for (const auto& p : slow.joints().points()) sum += p.weight;
    CHECK(sum == voussoir_test::near(1e-3).epsilon(1e-3));
  }

  // Within 1 %: a dashpot sees the velocity of half a step ago, zeta omega h / 2 = 2e-3, and the
  // arm turns a little while it is struck.
  TEST_CASE("impacts of every kind are damped with the ratio asked for") {
    const double exact = restitution(OneImpact<2>::zeta);
    SUBCASE("flat, on a smooth wall") {
      OneImpact<2> it;
      it.run.add_wall(rectangle({0, -0.5}, 4, 1));
      const int b = it.run.add_block(rectangle({0, 0.5001}, 1, 1), 2700);
      it.run.set_velocity(b, {0, -1});
      CHECK(it.parting(b, {0, -0.5}, {0, 1}, 0.01) == voussoir_test::near(exact).epsilon(0.01));
    }
    SUBCASE("with a corner on a face, in the middle and beside it") {
      for (const double angle : {0.25 * std::numbers::pi, 0.5, 1.0}) {
        CAPTURE(angle);
        OneImpact<2> it;
        it.run.add_fixed_block(rectangle({0, -0.5}, 4, 1));
        const auto shape = rectangle({0, 2}, 1, 0.7, angle);
        Vec2 low = shape.vertex(0);
        for (const Vec2& v : shape.vertices())
          if (v.y() < low.y()) low = v;
        const int b = it.run.add_block(shape, 2700);
        it.run.set_velocity(b, {0, -1});
        it.run.advance(low.y() - 1e-4);
        const Vec2 arm = low - Vec2(0, 2);
        // An edge touches by one of its two faces: the place where it presses wanders inwards as it
        // is driven in, and where both faces are tilted alike it is turned by that.
        const double off = angle > 0.7 && angle < 0.8 ? 0.2 : 0.04;
        CHECK(it.parting(b, arm, {0, 1}, 0.02) == voussoir_test::near(exact).epsilon(off));
      }
    }
    SUBCASE("in 3-D with a corner, an edge, and crossing edges") {
      const Rotation<3> on_corner = rotation_by(Spin<3>(0.5, 0.4, 0.2));
      const Rotation<3> on_edge = rotation_by(Spin<3>(0, 0.6, 0));
      for (const Rotation<3>& turn : {on_corner, on_edge}) {
        OneImpact<3> it;
        it.run.add_fixed_block(brick({0, 0, -0.5}, {4, 4, 1}));
        const auto shape = brick({0, 0, 2}, {1, 0.8, 0.6}, turn);
        double low = 2;
        for (const Vec3& v : shape.vertices()) low = std::min(low, v.z());
        Vec3 arm = Vec3::Zero();
        int count = 0;
        for (const Vec3& v : shape.vertices())
          if (v.z() < low + 1e-9) {
            arm += v - Vec3(0, 0, 2);
            ++count;
          }
        arm /= count;
        CAPTURE(count);
        const int b = it.run.add_block(shape, 2700);
        it.run.set_velocity(b, {0, 0, -1});
        it.run.advance(low - 1e-4);
        // A corner is driven in farther, and its force grows with the cube of the depth.
        const double off = count == 1 ? 0.2 : 0.04;
        CHECK(it.parting(b, arm, {0, 0, 1}, count == 1 ? 0.2 : 0.02) ==
              voussoir_test::near(exact).epsilon(off));
      }
      // Two ridges that cross at right angles.
      OneImpact<3> it;
      const double half = 0.5 * std::sqrt(2);
      it.run.add_fixed_block(brick({0, 0, -half}, {2, 1, 1}, rotation_by(Spin<3>(0.785398, 0, 0))));
      const int b = it.run.add_block(
          brick({0, 0, half + 1e-3}, {1, 2, 1}, rotation_by(Spin<3>(0, 0.785398, 0))), 2700);
      it.run.set_velocity(b, {0, 0, -1});
      CHECK(it.parting(b, {0, 0, -half}, {0, 0, 1}, 0.03) ==
            voussoir_test::near(exact).epsilon(0.01));
    }
    SUBCASE("on a node of a lining") {
      OneImpact<2> it;
      const int b = it.run.add_block(rectangle({0, 0.6}, 1, 1), 2700);
      const int node = it.run.add_lining_nodes(
          {{{0, 0}, {rectangle({0, 0}, 1, 0.198)}, 500, Spin<2>(40)}}, CoulombJoint({5e9, 5e8, 0}));
      it.run.set_velocity(b, {0, -1});
      it.run.advance(0.02);
      CHECK(it.run.velocity(node).y() - it.run.velocity(b).y() ==
            voussoir_test::near(-exact).epsilon(0.01));
    }
  }

  TEST_CASE("dashpots of any ratio are stable") {
    // A tower of three on its dashpots, over-critical; one stiff contact more than the mass of the
    // blocks says. What is dropped by 1 mm comes to rest.
    for (const double ratio : {0.1, 0.5, 1.0, 3.0, 10.0}) {
      CAPTURE(ratio);
      Dynamics<2, CoulombJoint> run(CoulombJoint({5e9, 5e8, 0.6}),
                                    {.viscous_damping = ratio, .safety = 1});
      run.add_fixed_block(rectangle({0, -0.5}, 4, 1));
      for (int k = 0; k < 3; ++k) run.add_block(rectangle({0, 0.501 + 1.001 * k}, 1, 1), 2700);
      double most = 0;
      for (int k = 0; k < 40; ++k) {
        run.advance(0.01);
        most = std::max(most, run.energy().above_start());
      }
      CHECK(most <= 0.01 * run.energy().gravity);
      CHECK(run.kinetic_energy() < 1);  // J, of 160 that the fall has brought
    }
  }
}

}  // namespace loose_blocks_test
