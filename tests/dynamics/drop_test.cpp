// SPDX-License-Identifier: MIT
// Blocks let go above others: contacts are seen before blocks overlap, however far they fall, and
// an impact gives them no energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/faults.hpp"
#include "support/flat_drop.hpp"
#include "support/near.hpp"

namespace drop_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::degree;
using voussoir_test::rectangle;
using voussoir_test::says;

namespace {

const CoulombJoint joint({5e9, 5e8, 35 * degree});
constexpr double density = 2700, gravity = 9.81;

/// Cubes of 1 m (2-D: squares) above a fixed floor whose top is at height 0.
template <int Dim>
struct Drop {
  Dynamics<Dim, CoulombJoint> run;
  std::vector<int> cubes;
  explicit Drop(const DynamicsSettings& settings) : run(joint, settings) {
    if constexpr (Dim == 2)
      run.add_fixed_block(rectangle({0, -0.5}, 20, 1));
    else
      run.add_fixed_block(brick({0, 0, -0.5}, {20, 20, 1}));
  }
  /// @param height  of the middle above the floor [m];  @param tilt  about a level axis [rad]
  int add(double height, double tilt = 0) {
    if constexpr (Dim == 2)
      cubes.push_back(run.add_block(rectangle({0, height}, 1, 1, tilt), density));
    else
      cubes.push_back(run.add_block(
          brick({0, 0, height}, {1, 1, 1}, rotation_by(Spin<3>(tilt, 0.7 * tilt, 0))), density));
    return cubes.back();
  }
  [[nodiscard]] double height(int b) const { return run.position(b)[Dim - 1]; }
  /// Of motion, height and springs [J]; of 0 where all lies still on the floor's level.
  [[nodiscard]] double energy() {
    double sum = run.kinetic_energy() + run.energy().contacts;
    for (const int b : cubes) sum += density * gravity * height(b);
    return sum;
  }
  /// The most energy there is from a time on, less that of the beginning, over `stake`
  /// [-].
  [[nodiscard]] double gain(double duration, double stake) {
    const double before = energy();
    // In one go: the run itself must see when to look for contacts.
    run.advance(duration);
    double most = energy();
    for (int k = 0; k < 20; ++k) {
      run.advance(duration / 200);
      most = std::max(most, energy());
    }
    return (most - before) / stake;
  }
};

/// The time of a fall, of the impact, and of part of the rise after it [s].
double one_impact(double drop) { return 1.5 * std::sqrt(2 * drop / gravity) + 2.5e-3; }

constexpr double weight = density * gravity;  // of a cube of 1 m

}  // namespace

TEST_SUITE("dynamics/drop") {
  // Where a spring of frequency omega closes somewhere within a step h, velocity Verlet takes up to
  // q / 4 of the energy, q = (omega h)^2, and gives as much where it opens: the energy after an
  // impact is at most 1 / (1 - q / 4) of that before (the shadow Hamiltonian of the spring,
  // v^2/2 + omega^2 x^2 (1 - q/4) / 2, at the first and the last point inside). The step is
  // `safety` 2 / sqrt(2 L), L >= omega^2: q <= 2 safety^2. Measured over heights, the worst comes
  // near it. Besides, the weight works while the spring is closed: q / 4 of the weight times the
  // way of one step.
  TEST_CASE_TEMPLATE_DEFINE("an impact on a floor gives no energy", Constant, floor_impact) {
    constexpr int dim = Constant::value;
    for (const double damping : {0.0, 0.3})
      for (const double safety : {0.5, 0.05})
        for (const double drop : {1e-4, 1e-3, 0.01, 0.02, 0.05, 0.3, 1.0}) {
          CAPTURE(damping);
          CAPTURE(safety);
          CAPTURE(drop);
          Drop<dim> it({.local_damping = damping, .safety = safety});
          const int cube = it.add(0.5 + drop);
          const double q = 2 * safety * safety;
          const double gain = it.gain(one_impact(drop), weight * drop);
          CHECK(gain <= 1.25 * (1 / (1 - q / 4) - 1));
          CHECK(it.height(cube) > 0.5);
          CHECK(it.height(cube) < 0.5 + drop);
        }
  }
  TEST_CASE_TEMPLATE_APPLY(
      floor_impact, std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>);

  TEST_CASE_TEMPLATE_DEFINE("nor does one on another block, flat or on a corner", Constant,
                            block_impact) {
    constexpr int dim = Constant::value;
    // A small step, so that what a scheme of second order leaves at each of the springs that close
    // and open is small: q / 4 <= 2 safety^2 / 4 each.
    constexpr double safety = 0.05;
    for (const double tilt : {0.0, 0.3})
      for (const double drop : {1e-3, 0.02, 0.05, 0.5}) {
        CAPTURE(tilt);
        CAPTURE(drop);
        Drop<dim> it({.safety = safety});
        it.add(0.5);
        it.add(2 + drop, tilt);
        CHECK(it.gain(one_impact(drop) + 0.1, weight * (drop + 0.5)) < 10 * 0.5 * safety * safety);
      }
  }
  TEST_CASE_TEMPLATE_APPLY(
      block_impact, std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>);

  // Faces that meet flat are apart at one end of a step and pressed at the other, and the force at
  // both ends does another work than the springs store: up to a quarter of all energy at each
  // impact.
  TEST_CASE_TEMPLATE_DEFINE("landing flat again and again, undamped, keeps energy", Constant,
                            flat_again) {
    constexpr int dim = Constant::value;
    for (int n = 0; n < 12; ++n) {
      CAPTURE(n);
      // Steps at which it touches down anywhere between two of them.
      const double height = 0.01 + 0.0037 * n;
      Drop<dim> drop({});
      drop.add(0.5 + height);
      double least = 1, most = -1;
      for (int k = 0; k < 30; ++k) {
        drop.run.advance_steps(37);
        const double above = drop.run.energy().above_start() / (weight * height);
        least = std::min(least, above);
        most = std::max(most, above);
      }
      // Measured: 1e-6. Without the kicks of crossings: 0.04 to 0.4 of what is at stake.
      CHECK(most < 1e-5);
      CHECK(least > -1e-5);
    }
  }
  TEST_CASE_TEMPLATE_APPLY(
      flat_again, std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>);

  TEST_CASE("flat drops at the default step, undamped, gain less than 1 %, with friction or none") {
    for (int n = 0; n < 40; ++n)
      for (const bool has_friction : {true, false}) {
        CAPTURE(n);
        CAPTURE(has_friction);
        const double safety = DynamicsSettings{}.safety;
        CHECK(voussoir_test::FlatDrop<2>(n, safety, has_friction).most_above(30) < 0.01);
        CHECK(voussoir_test::FlatDrop<3>(n, safety, has_friction).most_above(30) < 0.01);
      }
  }

  TEST_CASE("looking for contacts at every step gives the same answer") {
    // With one given step the same forces act in the same steps: what differs is rounding, in the
    // places of springs that were found at other times.
    const auto height_after = [](double drop, int check_every) {
      Drop<2> it({.time_step = 1e-4, .check_every = check_every});
      const int cube = it.add(0.5 + drop);
      it.run.advance_steps(static_cast<int>(one_impact(drop) / 1e-4));
      return it.height(cube);
    };
    for (const double drop : {1e-4, 0.02, 0.05, 0.5}) {
      CAPTURE(drop);
      CHECK(std::abs(height_after(drop, 100) - height_after(drop, 1)) < 1e-9);
    }
  }

  TEST_CASE("what a load or a blow gives within a batch counts") {
    // A block at rest 5 cm beside another, pushed with 50 times its weight: in 100 steps of the
    // free fall it would be 2.4 m further.
    Dynamics<2, CoulombJoint> pushed(joint, {.gravity = 0, .safety = 0.05});
    pushed.add_fixed_block(rectangle({1.55, 0}, 1, 4));
    const int a = pushed.add_block(rectangle({0.5, 0}, 1, 1), density);
    pushed.add_load(a, {50 * weight, 0});
    double farthest = 0;
    for (int k = 0; k < 50; ++k) {
      pushed.advance(1e-3);
      farthest = std::max(farthest, pushed.position(a).x());
    }
    CHECK(farthest < 0.55 + 0.005);  // v / omega = sqrt(2 * 490 * 0.05) / 1361 = 5.1 mm at most
    CHECK(farthest > 0.55);
    CHECK(pushed.kinetic_energy() <= 50 * weight * 0.05 * 1.01);

    // A heavy block at 20 m/s strikes a light one, which flies on at up to 40 m/s to a wall.
    Dynamics<2, CoulombJoint> struck(joint, {.gravity = 0, .safety = 0.2});
    const int heavy = struck.add_block(rectangle({0, 0}, 2, 2), density);
    const int light = struck.add_block(rectangle({1.11, 0}, 0.2, 0.2), density);
    struck.add_fixed_block(rectangle({2.21, 0}, 1, 4));
    struck.set_velocity(heavy, {20, 0});
    double deepest = 0;
    for (int k = 0; k < 200; ++k) {
      struck.advance(1e-4);
      deepest = std::max(deepest, struck.position(light).x() + 0.1 - 1.71);
    }
    CHECK(deepest > 0);
    CHECK(deepest < 0.02);  // 40 m/s / sqrt(5e9 * 0.2 / 108) = 13 mm
  }

  TEST_CASE("a step asked for in which blocks would pass into one another is refused") {
    Drop<2> it({.time_step = 5e-3});
    it.add(6);
    // At 1 m/s it moves 5 mm in a step, a quarter of the reach is 3.5 mm.
    const std::string text = voussoir_test::fault_of([&] { it.run.advance(1); });
    CAPTURE(text);
    CHECK(says(text, "more than a quarter of the reach of contacts of 0.0141 m"));
    CHECK(says(text, "leave time_step at 0, or give <= "));
    // Left to itself the step is shortened as the block gets faster: free fall stays exact.
    Drop<2> free({});
    const int cube = free.add(11);
    free.run.advance(1);
    CHECK(free.height(cube) == voussoir_test::near(11 - 0.5 * gravity).epsilon(1e-12));
    CHECK(free.run.step() * gravity < 0.25 * 0.0142);
  }
}

}  // namespace drop_test
