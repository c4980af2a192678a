// SPDX-License-Identifier: MIT
// Bolts between blocks that move: forces against closed forms f.7, energy, turning of the whole.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/bolt/bar_in_rock.hpp>
#include <voussoir/bolt/curve_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>
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
template <class Law = AxialBolt>
std::shared_ptr<BoltSet<2, Law>> between(const Run& run, int a, int b, const Vec2& initial,
                                         const Law& law) {
  auto bolts = std::make_shared<BoltSet<2, Law>>(law);
  typename BoltSet<2, Law>::Spring spring{};
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

  TEST_CASE("a yielding bolt stops a block whose energy it takes, and is lost with one more") {
    // 40 MN/m to 120 kN and 50 mm more. m v^2 / 2 + m g d = 120 kN (d - 1.5 mm): of 1.5 m/s d is
    // 34.4 mm; of 2 m/s it would be 59.7 mm, and 53 mm is the end.
    const CurveBolt law(BarStrength{.yield_force = 120e3, .rupture_extension = 0.05}.limited(
        BoltCurve::straight(40e6)));
    for (const double speed : {1.5, 2.0}) {
      Run run(joint, {.safety = 0.02});
      const int roof = run.add_fixed_block(rectangle({0, 3}, 1, 1));
      const int block = run.add_block(rectangle({0, 0}, 1, 1), 2700);
      const auto bolts = between(run, roof, block, {0, -3}, law);
      run.add_support(bolts);
      run.set_velocity(block, {0, -speed});
      double lowest = 0;
      for (int k = 0; k < 60; ++k) {
        run.advance(1e-3);
        lowest = std::min(lowest, run.position(block).y());
      }
      const double energy = 0.5 * 2700 * speed * speed,
                   stops = (energy + 120e3 * 1.5e-3) / (120e3 - 2700 * 9.81);
      CHECK(bolts->springs()[0].broken == (stops > 0.053));
      // A millisecond at rest is 17 um of fall.
      if (stops < 0.053) CHECK(std::abs(-lowest - stops) < 5e-5);
      if (stops > 0.053) CHECK(-lowest > stops);
      CHECK(std::abs(run.energy().relative_imbalance()) < 1e-3);
    }
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

  TEST_CASE("a block on a dowel alone swings with its period, in steps that are stable") {
    // A soft bar with a stiff dowel: the dowel sets the step.
    struct Case {
      double axial, shear;
    };
    for (const Case& bar : {Case{2e6, 2e6}, Case{1e5, 2e7}}) {
      const double axial = bar.axial, shear = bar.shear;
      CAPTURE(shear);
      const double mass = 2700, omega = std::sqrt(shear / mass);
      const AxialShearBolt law({.axial = {.axial_stiffness = axial}, .shear_stiffness = shear});
      Run run(joint, {.safety = 0.05});
      const int wall = run.add_fixed_block(rectangle({0, 0}, 1, 1));
      const int block = run.add_block(rectangle({3, 0}, 1, 1), mass);
      auto bolts = std::make_shared<BoltSet<2, AxialShearBolt>>(law);
      BoltSpring<2, AxialShearBolt> spring{};
      spring.a = wall;
      spring.b = block;
      spring.joint_a = spring.span.initial = {3, 0};
      spring.span.axis = Vec2::UnitX();
      bolts->add(spring);
      run.add_support(bolts);
      CHECK(run.stable_step() < 2 / omega);
      // A bound, for both ends may move; no tighter than that by more than the bar.
      CHECK(run.stable_step() > 0.95 * std::sqrt(2.0) / omega * std::sqrt(shear / (axial + shear)));
      run.advance(std::numbers::pi / omega);
      const double fall = 2 * mass * 9.81 / shear;
      // Of half a period in steps of 0.05 * sqrt(2) / omega the phase is off by (omega h)^2 / 24.
      CHECK(-run.position(block).y() == voussoir_test::near(fall).epsilon(1e-3));
      CHECK(run.energy().supports == voussoir_test::near(mass * 9.81 * fall).epsilon(1e-3));
      CHECK(std::abs(run.energy().relative_imbalance()) < 1e-4);
    }
  }

  TEST_CASE("blocks that spin and part on a bolt with a dowel keep their energy and spin") {
    // The dowel turns with its first block: its force and that on the other are one and opposite at
    // one point, or they would turn the pair, with an energy that nobody has stated.
    Run run(joint, {.gravity = 0, .safety = 0.05});
    const int a = run.add_block(rectangle({0, 0}, 1, 1), 2700);
    const int b = run.add_block(rectangle({1.5, 0}, 1, 1), 2700);
    const AxialShearBolt law({.axial = {.axial_stiffness = 1e6}, .shear_stiffness = 4e6});
    auto bolts = std::make_shared<BoltSet<2, AxialShearBolt>>(law);
    BoltSpring<2, AxialShearBolt> spring{};
    spring.a = a;
    spring.b = b;
    spring.joint_a = {0.75, 0};
    spring.joint_b = {-0.75, 0};
    spring.arm_a = {0.4, 0};
    spring.arm_b = {-0.4, 0};
    spring.span.initial = {0.7, 0};
    spring.span.axis = Vec2::UnitX();
    bolts->add(spring);
    run.add_support(bolts);
    run.set_velocity(b, {1.2, 0.8}, Spin<2>(0.5));
    const auto spin_of = [&](int k) {
      const auto& body = run.body(k);
      return body.inertia[0] * run.spin(k)[0] + 2700 * (run.position(k).x() * run.velocity(k).y() -
                                                        run.position(k).y() * run.velocity(k).x());
    };
    const double before = run.kinetic_energy();
    run.advance_steps(1);
    const double spin = spin_of(a) + spin_of(b);
    double apart = 0;
    for (int k = 0; k < 40; ++k) {
      run.advance(0.005);
      apart = std::max(apart, (run.position(b) - run.position(a)).norm() - 1.5);
    }
    CHECK(apart > 0.03);  // far beyond what small displacements are
    CHECK(std::abs(run.energy().imbalance()) < 1e-4 * before);
    // Velocities are those of half a step before the positions: of order (omega h)^2.
    CHECK(spin_of(a) + spin_of(b) == voussoir_test::near(spin).epsilon(2e-3));
  }

  TEST_CASE("bolts go into the rock that is there, in motion as at rest") {
    const Domain<2> ground{{0, 0}, {4, 4}};
    const std::vector beds = {
        JointSet{"H", 0, DipDirection::east, 0, 3, 0, 20}};  // five slabs, a bar through all
    const auto mass = slice(ground, joint_network(beds, ground, 3), {0.3, 50});
    REQUIRE(mass.bodies.size() == 5);
    const Segment bar{{2, 0.2}, {2, 3.8}};
    const AxialBolt law({.axial_stiffness = 2e8});
    const InSitu in_situ{.density = 2700, .k0 = 1};
    auto run = moving_rock(mass, joint, in_situ);
    const auto whole = add_bolts(run, mass, {bar}, law, 1.0, LorigAnchors{});
    CHECK(whole->springs().size() == 4);
    const int gone = whole->springs()[1].a;
    auto other = moving_rock(mass, joint, in_situ);
    other.remove(gone);
    const auto after = add_bolts(other, mass, {bar}, law, 1.0, LorigAnchors{});
    CHECK(after->springs().size() == 3);  // one of them across the hole
    for (const auto& s : after->springs()) {
      CHECK(s.a != gone);
      CHECK(s.b != gone);
    }
    // What is held where it is holds bolts, too, at rest as in motion.
    Solver<> solver(mass, joint, in_situ);
    solver.fix(gone);
    CHECK(solver.install_bolt(bar, law) == 4);
    // Outside the domain there is no rock, in motion either.
    CHECK_THROWS_WITH_AS(add_bolts(other, mass, {{{2, 2}, {2, 5}}}, law, 1.0, LorigAnchors{}),
                         doctest::Contains("outside the domain"), InvalidInput);
    CHECK_THROWS_AS(add_bolts(other, mass, {bar}, law, 0.0, LorigAnchors{}), InvalidInput);
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
