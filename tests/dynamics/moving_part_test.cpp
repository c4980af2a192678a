// SPDX-License-Identifier: MIT
// A few bodies stepped alone while all others stay, and bodies moved by hand amid a run.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/near.hpp"

namespace moving_part_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::degree;
using voussoir_test::rectangle;

namespace {

constexpr double gravity = 9.81, density = 2700;
constexpr double normal_stiffness = 5e9;

/// `count` blocks of 1 m x 0.5 m (x 1 m) on each other and on the ground, which is body 0. At first
/// springs carry nothing.
template <int Dim>
Dynamics<Dim, CoulombJoint> tower(int count, DynamicsSettings settings) {
  Dynamics<Dim, CoulombJoint> run(CoulombJoint({normal_stiffness, 5e8, 30 * degree}), settings);
  const auto block_at = [](double height, double width, double thickness) {
    if constexpr (Dim == 2)
      return rectangle({0, height}, width, thickness);
    else
      return brick({0, 0, height}, {width, width, thickness});
  };
  run.add_fixed_block(block_at(-0.5, 20, 1));
  for (int k = 0; k < count; ++k) run.add_block(block_at(0.25 + 0.5 * k, 1, 0.5), density);
  return run;
}

/// What a run with a long step that all bodies allow is told.
DynamicsSettings settings() { return {.local_damping = 0.3, .time_step = 2e-5}; }

template <int Dim>
void push(Dynamics<Dim, CoulombJoint>& run, int body) {
  Vec<Dim> velocity = zeros<Vec<Dim>>();
  velocity[0] = 0.5;
  run.set_velocity(body, velocity);
}

}  // namespace

TEST_SUITE("dynamics/moving_part") {
  TEST_CASE_TEMPLATE("bodies that do not move are as bodies that are fixed, to the bit", Dimension,
                     std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
    constexpr int dim = Dimension::value;
    auto part = tower<dim>(4, settings()), fixed = tower<dim>(4, settings());
    for (auto* run : {&part, &fixed}) {
      run->advance(0.05);
      push(*run, 4);
    }
    std::vector<Pose<dim>> before;
    for (int b = 0; b < 5; ++b) before.push_back(part.pose(b));
    part.move_only({4, 3});
    for (const int b : {1, 2}) fixed.fix(b);
    CHECK(part.moves(3));
    CHECK(!part.moves(2));
    part.advance(0.2);
    fixed.advance(0.2);
    for (const int b : {1, 2}) {
      CHECK(part.pose(b).position == before[static_cast<std::size_t>(b)].position);
      CHECK(part.velocity(b).norm() == 0);
    }
    // It has slid by centimetres: contacts were looked for, and their points renewed.
    CHECK((part.position(4) - before[4].position).norm() > 0.01);
    for (const int b : {3, 4}) {
      CHECK(part.position(b) == fixed.position(b));
      CHECK(part.velocity(b) == fixed.velocity(b));
    }
    CHECK(std::abs(part.energy().relative_imbalance()) < 1e-3);  // of the steps, as of all runs
  }

  TEST_CASE("forces on those that stay are up to date, and they go on when they are let go") {
    auto run = tower<2>(4, settings());
    run.advance(0.05);
    push(run, 4);
    run.move_only({4});
    run.advance(0.1);
    std::vector<Load<2>> loads;
    for (int b = 1; b < 5; ++b) loads.push_back(run.out_of_balance(b));
    CHECK(run.unbalance_of(3) > 0.05);  // the block on it has moved off its middle
    run.move_all();
    for (int b = 1; b < 5; ++b) {
      const Load<2> all = run.out_of_balance(b);
      const double scale = density * 0.5 * gravity;
      CHECK((all.force - loads[static_cast<std::size_t>(b - 1)].force).norm() <= 1e-9 * scale);
      CHECK((all.moment - loads[static_cast<std::size_t>(b - 1)].moment).norm() <= 1e-9 * scale);
    }
    const Vec2 third = run.position(3);
    run.advance(0.02);
    CHECK((run.position(3) - third).norm() > 1e-9);
  }

  TEST_CASE_TEMPLATE("the elastic step by hand is equilibrium, and half of its work is taken away",
                     Dimension, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
    // A tower of n blocks on springs of k_n times area sinks, block after block, by the weight
    // above each joint over its stiffness. Springs hold half of what gravity has done.
    constexpr int dim = Dimension::value, count = 3;
    constexpr int dof = dim + spin_count<dim>;
    auto run = tower<dim>(count, {});
    const double weight = density * 0.5 * gravity, stiffness = normal_stiffness;  // area 1
    CHECK(run.unbalance_of(1) == voussoir_test::near(1));
    Eigen::VectorXd step = Eigen::VectorXd::Zero(dof * (count + 1));
    double sunk = 0, work = 0;
    for (int b = 1; b <= count; ++b) {
      sunk += weight * (count + 1 - b) / stiffness;
      step[dof * b + dim - 1] = -sunk;
      work += weight * sunk;
    }
    // Three times as far springs take nine halves of the work, and gravity gives three of it: the
    // rest is given by hand, and taken again on the way back.
    CHECK(run.displace(3 * step) == voussoir_test::near(-1.5 * work));
    CHECK(run.displace(-3 * step) == voussoir_test::near(1.5 * work));
    CHECK(run.displace(step) == voussoir_test::near(0.5 * work));
    // Roundings of springs that carry three weights, of 1e-16 of a metre times their stiffness.
    for (int b = 1; b <= count; ++b) CHECK(run.unbalance_of(b) < 1e-8);
    const EnergyBalance energy = run.energy();
    CHECK(energy.gravity == voussoir_test::near(work));
    CHECK(energy.contacts == voussoir_test::near(0.5 * work));
    CHECK(energy.damping == voussoir_test::near(0.5 * work));
    CHECK(std::abs(energy.relative_imbalance()) < 1e-9);
    CHECK_THROWS_AS(run.displace(Eigen::VectorXd::Zero(3)), InvalidInput);
  }

  TEST_CASE("what had a velocity and is not let move loses it as damping") {
    auto run = tower<2>(2, settings());
    run.advance(0.05);
    push(run, 2);
    const double kinetic = 0.5 * density * 0.5 * 0.25, before = run.energy().damping;
    run.move_only({1});
    CHECK(run.velocity(2).norm() == 0);
    CHECK(run.energy().damping - before == voussoir_test::near(kinetic).epsilon(1e-3));
  }

  TEST_CASE_TEMPLATE("back in an earlier state a run goes on as it did, to the bit", Dimension,
                     std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
    constexpr int dim = Dimension::value;
    auto run = tower<dim>(4, settings());
    run.hold();
    run.advance(0.05);
    push(run, 4);
    run.move_only({4, 3});
    run.advance_steps(500);
    const auto state = run.state();
    const auto go_on = [&] {
      run.set_held(0.5);
      run.advance_steps(3000);
      run.move_only({4, 3, 2});
      run.advance_steps(3000);
      std::vector<Vec<dim>> places;
      for (int b = 0; b < 5; ++b) places.push_back(run.position(b));
      return places;
    };
    const double start = run.time();
    const std::vector<Vec<dim>> first = go_on();
    const EnergyBalance energy = run.energy();
    run.remove({4, 3});  // what was taken out since is back again
    run.set_held(0);
    run.advance_steps(100);
    run.go_back_to(state);
    CHECK(run.time() == start);
    CHECK(run.held() == 1);
    CHECK(run.moves(3));
    CHECK(!run.moves(2));
    CHECK(go_on() == first);
    CHECK(first[4][0] - first[3][0] > 0.03);  // it has slid: contacts were looked for
    CHECK(run.energy().friction == voussoir_test::near(energy.friction));
    CHECK(run.energy().damping == voussoir_test::near(energy.damping));
  }
}

}  // namespace moving_part_test
