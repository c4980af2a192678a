// SPDX-License-Identifier: MIT
// Runs that go bad are stopped within a check interval, say what and where, and lose nothing.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/faults.hpp"

namespace health_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::rectangle;
using voussoir_test::says;

namespace {

using Run = Dynamics<2, CoulombJoint>;
const CoulombJoint joint({5e9, 5e8, 35 * degree});

/// A floor and a tower of three blocks, numbers 1 to 3.
Run tower(const DynamicsSettings& settings, const CoulombJoint& law = joint) {
  Run run(law, settings);
  run.add_fixed_block(rectangle({0, -0.5}, 20, 1));
  for (int k = 0; k < 3; ++k) run.add_block(rectangle({0, 0.5 + k}, 1.5, 1), 2700);
  return run;
}

/// The message of the fault that advancing by `steps` ends in; "" without.
std::string fault_of(Run& run, int steps) {
  return voussoir_test::fault_of([&] { run.advance_steps(steps); });
}

}  // namespace

TEST_SUITE("dynamics/run_diagnostics") {
  TEST_CASE("a time step that is too large is refused with the one that is not") {
    Run probe = tower({});
    const double stable = probe.stable_step();
    Run run = tower({.time_step = 1.1 * stable});
    const std::string text = fault_of(run, 1);
    CAPTURE(text);
    CHECK(says(text, "longer than the stable one"));
    CHECK(says(text, "leave time_step at 0"));
    CHECK(run.steps() == 0);
  }

  TEST_CASE("the stable step is stable, four times as much is not") {
    // Through the back door: a spring law that says it is 16 times softer than it is.
    struct Liar : CoulombJoint {
      using CoulombJoint::CoulombJoint;
      [[nodiscard]] double joint_normal_stiffness() const {
        return CoulombJoint::joint_normal_stiffness() / 16;
      }
      [[nodiscard]] double joint_shear_stiffness() const {
        return CoulombJoint::joint_shear_stiffness() / 16;
      }
    };
    const Liar liar({5e9, 5e8, 35 * degree});
    Dynamics<2, Liar> run(liar, {.safety = 1, .check_every = 20});
    run.add_fixed_block(rectangle({0, -0.5}, 20, 1));
    for (int k = 0; k < 3; ++k) run.add_block(rectangle({0, 0.5 + k}, 1.5, 1), 2700);
    std::string text;
    try {
      run.advance_steps(20000);
    } catch (const NumericalFault& fault) {
      text = fault.what();
    }
    CAPTURE(text);
    CHECK(says(text, "J that nothing has brought"));
    CHECK(says(text, "block "));
    CHECK(says(text, " m/s"));
    CHECK(says(text, "stiffer than it says"));
    // Where joints open and close again the step makes an error at each time, which near the stable
    // step adds up; half of it is the default.
    Run limit = tower({.safety = 0.5});
    CHECK(fault_of(limit, 20000) == "");
    CHECK(limit.kinetic_energy() < 100);  // J: the tower is dropped by 10 um, 120 kN
  }

  TEST_CASE("a velocity that is not a number is found, and the state before it kept") {
    Run run = tower({.check_every = 10});
    run.advance_steps(50);
    const Vec2 place = run.position(2);
    const std::int64_t step = run.steps();
    const EnergyBalance before = run.energy();
    run.set_velocity(2, {std::numeric_limits<double>::quiet_NaN(), 0});
    const std::string text = fault_of(run, 10);
    CAPTURE(text);
    CHECK(says(text, "step 60"));
    CHECK(says(text, " is not a number"));
    CHECK(says(text, "block "));
    CHECK(says(text, "state kept is that of step 50"));
    CHECK(run.steps() == step);
    CHECK(run.position(2) == place);
    CHECK(run.energy().imbalance() == before.imbalance());
    CHECK(run.energy().gravity == before.gravity);
    CHECK(run.energy().kinetic == before.kinetic);
    // It goes on from there as if nothing had happened.
    CHECK(fault_of(run, 100) == "");
  }

  TEST_CASE("a block at 50 m/s is named, with its place") {
    Run run = tower({.check_every = 10});
    run.advance_steps(10);
    run.set_velocity(3, {50, 0});
    const std::string text = fault_of(run, 10);
    CAPTURE(text);
    CHECK(says(text, "block 3 at ("));
    CHECK(says(text, "50 m/s"));
    CHECK(!says(text, "raise speed_limit"));  // there is none to raise
    CHECK(says(text, "drop pieces of its size"));
    Run limited = tower({.speed_limit = 40, .check_every = 10});
    limited.advance_steps(10);
    limited.set_velocity(3, {50, 0});
    CHECK(says(fault_of(limited, 10), "raise speed_limit"));
  }

  TEST_CASE("too much overlap is named with both blocks, and whose fault it may be") {
    // Joints so soft that three blocks sink in by a tenth of their size.
    Run run = tower({.local_damping = 0.7, .check_every = 10}, CoulombJoint({3e5, 3e5, 0.6}));
    const std::string text = fault_of(run, 20000);
    CAPTURE(text);
    CHECK(says(text, "block 1 at ("));
    CHECK(says(text, "fixed block 0 at ("));
    CHECK(says(text, "raise joint_normal_stiffness"));
    Run beginning(joint, {});
    beginning.add_block(rectangle({0, 0}, 1, 1), 2700);
    beginning.add_block(rectangle({0.5, 0}, 1, 1), 2700);
    CHECK(says(fault_of(beginning, 1), "overlapped from the beginning"));
  }

  TEST_CASE("what cannot move, or is out of range, is refused") {
    Run fixed(joint, {});
    fixed.add_fixed_block(rectangle({0, 0}, 1, 1));
    CHECK_THROWS_WITH_AS(fixed.advance(1), "dynamics: there is no block that can move",
                         InvalidInput);
    CHECK_THROWS_AS(Run(joint, {.local_damping = 1}), InvalidInput);
    CHECK_THROWS_AS(Run(joint, {.safety = 0}), InvalidInput);
    CHECK_THROWS_AS(Run(joint, {.time_step = -1}), InvalidInput);
    CHECK_THROWS_AS(Run(joint, {.check_every = 0}), InvalidInput);
    Run run = tower({});
    run.advance_steps(1);
    CHECK_THROWS_AS(run.add_block(rectangle({5, 5}, 1, 1), 0), InvalidInput);
    CHECK_THROWS_AS(run.advance(-1), InvalidInput);
    CHECK_THROWS_AS(run.set_local_damping(1.5), InvalidInput);
    CHECK(run.settings().local_damping == 0);  // as it was
  }

  TEST_CASE("without damping and without friction a run is not at fault") {
    Run run = tower({.local_damping = 0, .safety = 0.2}, CoulombJoint({5e9, 5e8, 0}));
    CHECK(fault_of(run, 5000) == "");
    CHECK(run.energy().friction == 0);
    CHECK(std::abs(run.energy().relative_imbalance()) < 0.02);
  }
}

}  // namespace health_test
