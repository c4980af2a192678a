// SPDX-License-Identifier: MIT
// Bolts between blocks that move: forces against closed forms f.7, energy, turning of the whole.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <string>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/tunnel/support_forces.hpp>

#include "support/blocks.hpp"
#include "support/near.hpp"

namespace bolts_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::rectangle;

namespace {

using Run = Dynamics<2, CoulombJoint>;
using Bolts = BoltSet<2, AxialBolt>;
const CoulombJoint joint({5e9, 5e8, 35 * degree});

/// A bolt between the centres of two bodies, `initial` long, free of force.
std::shared_ptr<Bolts> between(const Run& run, int a, int b, const Vec2& initial,
                               const AxialBolt& law) {
  auto bolts = std::make_shared<Bolts>(law);
  Bolts::Spring spring{};
  spring.a = a;
  spring.b = b;
  spring.span.initial = run.pose(a).rotation.transpose() * initial;
  spring.span.axis = spring.span.initial.normalized();
  spring.share = 1;
  bolts->add(spring);
  return bolts;
}

}  // namespace

TEST_SUITE("dynamics/bolts") {
  TEST_CASE("a block hung from a bolt swings up and down with its period, energy kept") {
    Run run(joint, {.safety = 0.02});
    const int roof = run.add_fixed_block(rectangle({0, 3}, 1, 1));
    const int block = run.add_block(rectangle({0, 0}, 1, 1), 2700);
    const double stiffness = 2e6, mass = 2700;
    const auto bolts =
        between(run, roof, block, {0, -3}, AxialBolt({.axial_stiffness = stiffness}));
    run.add_support(bolts);
    // Let go: it falls by twice m g / K and comes back after 2 pi sqrt(m / K).
    const double period = 2 * std::numbers::pi * std::sqrt(mass / stiffness);
    run.advance(0.5 * period);
    CHECK(-run.position(block).y() ==
          voussoir_test::near(2 * mass * 9.81 / stiffness).epsilon(1e-4));
    CHECK(bolts->axial_force(0) == voussoir_test::near(2 * mass * 9.81).epsilon(1e-4));
    // What is read of it is what acted at the end of the last step, to rounding of poses of 3 m.
    const CrossingForce read = bolt_forces(run, *bolts).front();
    CHECK(read.report.axial == voussoir_test::near(bolts->axial_force(0)).epsilon(1e-12));
    CHECK(read.extension == voussoir_test::near(read.report.axial / stiffness).epsilon(1e-9));
    CHECK(!read.report.has_yielded());
    CHECK(std::abs(run.energy().relative_imbalance()) < 1e-4);
    run.advance(0.5 * period);
    CHECK(std::abs(run.position(block).y()) < 1e-5);
  }

  TEST_CASE("a block that is taken out holds nothing any more by its bolts") {
    Run run(joint, {.safety = 0.1});
    const int held = run.add_block(rectangle({0, 3}, 1, 1), 2700);
    const int block = run.add_block(rectangle({0, 0}, 1, 1), 2700);
    run.add_support(between(run, held, block, {0, -3}, AxialBolt({.axial_stiffness = 2e6})));
    run.fix(held);
    run.advance(0.1);
    const double speed = run.velocity(block).y(), place = run.position(block).y();
    run.remove(held);
    run.advance(0.1);
    // Free fall, to rounding; and the energy of the bolt is no loss of the run.
    CHECK(run.position(block).y() ==
          voussoir_test::near(place + 0.1 * speed - 0.5 * 9.81 * 0.01).epsilon(1e-9));
    CHECK(std::abs(run.energy().relative_imbalance()) < 1e-3);
  }

  TEST_CASE("a run that goes back to its last sound state takes its bolts with it") {
    Run run(joint, {.gravity = 0, .speed_limit = 10});
    const int a = run.add_fixed_block(rectangle({0, 0}, 1, 1));
    const int b = run.add_block(rectangle({2, 0}, 1, 1), 2700);
    const auto bolts =
        between(run, a, b, {2, 0}, AxialBolt({.axial_stiffness = 1e8, .rupture_force = 5e4}));
    run.add_support(bolts);
    run.advance_steps(1);
    run.set_velocity(b, {50, 0});
    CHECK_THROWS_AS(run.advance_steps(200), NumericalFault);
    CHECK(run.steps() == 0);
    CHECK(!bolts->springs()[0].broken);
    CHECK(bolts->axial_force(0) == 0);
    CHECK(run.energy().supports == 0);
  }

  TEST_CASE("its force follows the line between anchors far apart, as the closed form says") {
    // Pulled across by s: K (sqrt(d^2 + s^2) - d), most of it across only when s is large.
    const double stiffness = 2e8, d = 0.77;
    for (const double s : {0.01, 0.1, 0.5}) {
      Run run(joint, {.gravity = 0});
      const int a = run.add_fixed_block(rectangle({0, 0}, 0.4, 0.4));
      const int b = run.add_block(rectangle({s, d}, 0.2, 0.2), 2700);
      const auto bolts = between(run, a, b, {0, d}, AxialBolt({.axial_stiffness = stiffness}));
      run.add_support(bolts);
      CHECK(run.stable_step() < 1);
      CHECK(bolts->axial_force(0) ==
            voussoir_test::near(stiffness * (std::sqrt(d * d + s * s) - d)).epsilon(1e-12));
    }
  }

  TEST_CASE("back from motion a dowel holds K_s times the jump, and goes on from there") {
    // Two blocks on each other, turned as a whole, the upper one shifted by `jump` along the joint:
    // a bar of d from anchor to anchor through it is K_a (sqrt(d^2 + s^2) - d) in tension.
    const double axial = 2e8, shear = 3e8, d = 0.6, jump = 2e-3, more = 5e-4;
    BoltSet<2, AxialShearBolt> bolts(
        AxialShearBolt({.axial = {.axial_stiffness = axial}, .shear_stiffness = shear}));
    BoltSpring<2, AxialShearBolt> spring{};
    spring.a = 0;
    spring.b = 1;
    spring.joint_a = {0, 0.5};
    spring.joint_b = {0, -0.5};
    spring.arm_a = {0, 0.2};
    spring.arm_b = {0, -0.2};
    spring.span.initial = {0, d};
    spring.span.axis = Vec2::UnitY();
    bolts.add(spring);
    const Rotation<2> turn = rotation_by(Spin<2>(0.7));
    const Vec2 along = turn.col(0);
    // Wherever displacements are counted from: here both blocks have some in common.
    const Vec2 common(0.03, -0.02);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(6);
    u.head<2>() = common;
    u.segment<2>(3) = common + jump * along;
    bolts.from_frames({{turn * Vec2(0, -0.5), turn}, {turn * Vec2(jump, 0.5), turn}}, u.data());
    const auto force_along = [&] {  // on the lower block
      Eigen::VectorXd f = Eigen::VectorXd::Zero(6);
      bolts.add_forces(u.data(), f.data(), nullptr);
      CHECK((f.head<2>() + f.segment<2>(3)).norm() <= 1e-12 * f.norm());
      return f.head<2>().dot(along);
    };
    const auto expected = [&](double s) {
      const double length = std::hypot(d, s);
      return shear * s + axial * (length - d) * s / length;
    };
    CHECK(force_along() == voussoir_test::near(expected(jump)).epsilon(1e-9));
    u.segment<2>(3) += more * along;
    CHECK(force_along() == voussoir_test::near(expected(jump + more)).epsilon(1e-9));
  }

  TEST_CASE("turning everything strains no bolt; rupture lets go and keeps the account") {
    Run run(joint, {.gravity = 0, .safety = 0.05});
    const int a = run.add_block(rectangle({0, 0}, 1, 1), 2700);
    const int b = run.add_block(rectangle({2, 0}, 1, 1), 2700);
    const AxialBolt law({.axial_stiffness = 1e7, .rupture_force = 5e4});
    const auto bolts = between(run, a, b, {2, 0}, law);
    run.add_support(bolts);
    // As one rigid body about the middle, slowly enough for the centrifugal force.
    const double spin = 2, centrifugal = 2700 * spin * spin * 1;
    run.set_velocity(a, {0, -spin}, Spin<2>(spin));
    run.set_velocity(b, {0, spin}, Spin<2>(spin));
    double largest = 0;
    for (int k = 0; k < 200; ++k) {
      run.advance(0.005);
      largest = std::max(largest, bolts->axial_force(0));
    }
    CHECK(run.body(a).angle > 1.5);
    CHECK(largest < 2.2 * centrifugal);  // it swings about the centrifugal force
    CHECK(!bolts->springs()[0].broken);
    CHECK(std::abs(run.energy().imbalance()) < 1e-5 * run.kinetic_energy());
    // Torn apart: the work done on the bolt up to rupture is F^2 / 2K, and stays lost.
    Run torn(joint, {.gravity = 0, .safety = 0.02});
    const int c = torn.add_block(rectangle({0, 0}, 1, 1), 2700);
    const int e = torn.add_block(rectangle({2, 0}, 1, 1), 2700);
    const auto other = between(torn, c, e, {2, 0}, law);
    torn.add_support(other);
    torn.set_velocity(e, {1, 0});
    torn.advance(0.3);
    CHECK(other->springs()[0].broken);
    CHECK(bolt_forces(torn, *other).front().report.is_broken);
    CHECK(torn.energy().supports == voussoir_test::near(5e4 * 5e4 / (2 * 1e7)).epsilon(0.05));
    CHECK(-torn.energy().kinetic == voussoir_test::near(torn.energy().supports).epsilon(0.01));
  }
}

}  // namespace bolts_test
