// SPDX-License-Identifier: MIT
// Bodies that fly, turn and collide: what is kept, and to which order.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace free_motion_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::degree;
using voussoir_test::rectangle;
using voussoir_test::reference;

namespace {

using Plane = Dynamics<2, CoulombJoint>;
using Space = Dynamics<3, CoulombJoint>;
const CoulombJoint joint({5e9, 5e8, 35 * degree});

/// A heap of turned squares thrown at each other, without weight.
Plane heap(const Vec2& at, double turn, unsigned threads = 1, double step = 2e-5) {
  Plane run(joint, {.gravity = 0, .time_step = step, .refresh = 1e-9, .threads = threads});
  const Rotation<2> frame = rotation_by(Spin<2>(turn));
  for (int k = 0; k < 9; ++k) {
    const Vec2 place(1.5 * (k % 3), 1.5 * (k / 3));
    const int b = run.add_block(rectangle(at + frame * place, 1, 0.9, turn + 0.1 * k), 2700);
    run.set_velocity(b, frame * (2 * (Vec2(1.5, 1.5) - place)), Spin<2>(0.5 * (k - 4)));
  }
  return run;
}

template <int Dim>
struct Momenta {
  Vec<Dim> linear = Vec<Dim>::Zero();
  Spin<Dim> angular = Spin<Dim>::Zero();  ///< about the origin
};
template <int Dim>
Momenta<Dim> momenta(const Dynamics<Dim, CoulombJoint>& run) {
  Momenta<Dim> sum;
  for (int b = 0; b < run.body_count(); ++b) {
    const Vec<Dim> p = run.body(b).mass * run.velocity(b);
    sum.linear += p;
    sum.angular += run.angular_momentum(b) + moment_of(run.position(b), p);
  }
  return sum;
}

}  // namespace

TEST_SUITE("dynamics/free_motion") {
  // F.free: principal moments 3, 2, 1 and the given angular velocity; Jacobi's elliptic functions.
  TEST_CASE("an asymmetric body turns freely as Euler's equations say, of second order") {
    // A brick with these moments and mass 6: I = m (b^2 + c^2) / 12.
    const Vec3 squared(0.0, 2.0, 4.0);  // a^2 + b^2 = 2, a^2 + c^2 = 4, b^2 + c^2 = 6
    // A thin plate would have no volume: add the same to all sides, which adds 2 to all moments.
    const Vec3 size = (squared.array() + 2.0).sqrt();
    const double density = 6 / size.prod();
    const auto period_error = [&](double step) {
      Space run(joint, {.gravity = 0, .time_step = step});
      const int b = run.add_block(brick(Vec3::Zero(), size), density);
      // About x, y, z: 5, 4, 3.
      run.set_velocity(b, Vec3::Zero(), Vec3(0.8, 0.1, 0.5));
      const Vec3 before = run.angular_momentum(b);
      const double energy = run.kinetic_energy();
      double drift = 0, energy_error = 0;
      for (int k = 0; k < 400; ++k) {
        run.advance_steps(1);
        drift = std::max(drift, (run.angular_momentum(b) - before).norm());
        energy_error = std::max(energy_error, std::abs(run.kinetic_energy() - energy));
      }
      CHECK(drift < 1e-13 * before.norm());  // 400 steps, each good to a rounding
      return energy_error / energy;
    };
    const double coarse = period_error(0.04), fine = period_error(0.02);
    CHECK(coarse < 1e-3);
    CHECK(coarse / fine == voussoir_test::near(4).epsilon(0.05));
  }

  TEST_CASE("the middle component of a free spin has the period of the elliptic integral") {
    // Moments 5, 4, 3 of the brick above; L and T from the start, K(m) by the arithmetic-geometric
    // mean: period 4 K / rate (closed form of the free top).
    const Vec3 inertia(5, 4, 3), omega(0.8, 0.1, 0.5);
    const Vec3 l = inertia.cwiseProduct(omega);
    const double t2 = l.dot(omega), l2 = l.squaredNorm();
    REQUIRE(l2 > t2 * inertia[1]);
    const double m = (inertia[1] - inertia[2]) * (t2 * inertia[0] - l2) /
                     ((inertia[0] - inertia[1]) * (l2 - t2 * inertia[2]));
    const double rate =
        std::sqrt((inertia[0] - inertia[1]) * (l2 - t2 * inertia[2]) / inertia.prod());
    double a = 1, g = std::sqrt(1 - m);
    for (int k = 0; k < 20; ++k) {
      const double mean = 0.5 * (a + g);
      g = std::sqrt(a * g);
      a = mean;
    }
    const double period = 4 * (std::numbers::pi / (2 * a)) / rate;

    Space run(joint, {.gravity = 0, .time_step = 1e-3});
    const Vec3 size(std::sqrt(2.0), 2.0, std::sqrt(6.0));
    const int b = run.add_block(brick(Vec3::Zero(), size), 6 / size.prod());
    run.set_velocity(b, Vec3::Zero(), omega);
    // In the body's frame: components of the angular momentum, by falling size of the moment.
    const auto middle = [&] {
      const auto& body = run.body(b);
      Eigen::Index smallest = 0, largest = 0;
      body.inertia.minCoeff(&smallest);
      body.inertia.maxCoeff(&largest);
      return body.momentum[3 - smallest - largest];
    };
    // Times at which it passes 0 upwards or downwards, by linear interpolation.
    std::vector<double> crossings;
    double before = middle();
    while (crossings.size() < 5) {
      run.advance(1e-2);
      const double now = middle();
      if (before * now < 0) crossings.push_back(run.time() - 1e-2 * now / (now - before));
      before = now;
    }
    const double measured = 0.5 * (crossings[4] - crossings[0]);
    CHECK(measured == voussoir_test::near(period).epsilon(1e-5));  // interpolation 1e-2 s of 12 s
  }

  TEST_CASE("two blocks that meet exchange their velocities, however long the step") {
    const auto lost = [](double safety) {
      double worst = 0;
      for (const double gap : {1e-3, 1.13e-3, 1.29e-3, 1.41e-3}) {  // other phases of the steps
        Plane run(joint, {.gravity = 0, .safety = safety});
        const int a = run.add_block(rectangle({0, 0}, 1, 1), 2700);
        const int b = run.add_block(rectangle({1 + gap, 0}, 1, 1), 2700);
        run.set_velocity(a, {1, 0});
        run.advance(0.02);
        CHECK(run.velocity(a).x() + run.velocity(b).x() == voussoir_test::near(1).epsilon(1e-12));
        worst = std::max(worst, std::abs(run.velocity(b).x() - 1));
      }
      return worst;
    };
    // Steps that closed and opened the joint left 1e-2 at 0.2 of the stable one. What is left is
    // the rounding of 1e-9 m, by which a joint is pressed in, beside 1 m.
    for (const double safety : {0.05, 0.2, 0.5}) CHECK(lost(safety) < 1e-6);
  }

  TEST_CASE("a dashpot of ratio zeta lets a block bounce with the known restitution") {
    // The contact ends when spring and dashpot together would pull (closed forms f.8).
    const double zeta = 0.2, root = std::sqrt(1 - zeta * zeta);
    const double exact = std::exp(-zeta / root * std::atan2(2 * zeta * root, 2 * zeta * zeta - 1));
    Plane run(joint, {.gravity = 0, .viscous_damping = zeta, .safety = 0.005});
    const int a = run.add_block(rectangle({0, 0}, 1, 1), 2700);
    const int b = run.add_block(rectangle({1.0001, 0}, 1, 1), 2700);
    run.set_velocity(a, {1, 0});
    run.advance(0.01);
    // A dashpot sees the velocity of half a step ago: an error of zeta omega step / 2 = 1e-3.
    CHECK(run.velocity(b).x() - run.velocity(a).x() == voussoir_test::near(exact).epsilon(2e-3));
    const EnergyBalance energy = run.energy();
    CHECK(energy.viscosity == voussoir_test::near(-energy.kinetic).epsilon(1e-2));
  }

  TEST_CASE("a closed heap that collides keeps momentum and angular momentum") {
    Plane run = heap(Vec2::Zero(), 0);
    const auto before = momenta(run);
    const double speed = 2700 * 2 * 9;  // of the parts that cancel
    run.advance(0.5);
    const auto after = momenta(run);
    CHECK((after.linear - before.linear).norm() < 1e-11 * speed);
    CHECK(std::abs(after.angular[0] - before.angular[0]) < 1e-11 * speed);
    CHECK(run.energy().friction > 100);
    CHECK(std::abs(run.energy().relative_imbalance()) < 2e-3);
  }

  TEST_CASE("so does one in 3-D") {
    Space run(joint, {.gravity = 0, .safety = 0.05});
    for (int k = 0; k < 8; ++k) {
      const Vec3 place = 1.2 * Vec3(k & 1, (k >> 1) & 1, (k >> 2) & 1);
      const int b =
          run.add_block(brick(place, {1, 0.9, 0.8}, rotation_by(Spin<3>(0.1 * k, 0.2, 0.3))), 2700);
      run.set_velocity(b, 2 * (Vec3(0.6, 0.6, 0.6) - place), Spin<3>(0.5, -0.1 * k, 0.2));
    }
    const auto before = momenta(run);
    run.advance(0.4);
    const auto after = momenta(run);
    CHECK((after.linear - before.linear).norm() < 1e-10 * 2e4);
    CHECK((after.angular - before.angular).norm() < 1e-10 * 2e4);
    CHECK(run.energy().friction > 100);
    CHECK(std::abs(run.energy().relative_imbalance()) < 2e-3);
  }

  TEST_CASE("turned and moved a million metres away, the same heap does the same") {
    // Vertices at 1e6 m are rounded to 1e-10 m, and every collision enlarges what is different.
    // Contacts are updated at every step: else the time of an update is a matter of boxes along the
    // axes.
    Plane here = heap(Vec2::Zero(), 0);
    const Vec2 far(1e6, -2e6);
    const double turn = 0.7;
    Plane there = heap(far, turn);
    const Rotation<2> frame = rotation_by(Spin<2>(turn));
    here.advance(0.2);
    there.advance(0.2);
    double worst = 0;
    for (int b = 0; b < here.body_count(); ++b)
      worst = std::max(worst, (frame * here.position(b) + far - there.position(b)).norm());
    CHECK(here.energy().kinetic < -100);  // some have met
    CHECK(worst < 1e-8);
  }

  TEST_CASE("any number of threads gives the same bits") {
    Plane one = heap(Vec2::Zero(), 0.3, 1, 1e-4), three = heap(Vec2::Zero(), 0.3, 3, 1e-4);
    one.advance(0.15);
    three.advance(0.15);
    for (int b = 0; b < one.body_count(); ++b) {
      const Vec2 p = one.position(b), q = three.position(b);
      CHECK(std::memcmp(p.data(), q.data(), sizeof p) == 0);
    }
  }

  TEST_CASE("the step is of second order") {
    // A smooth problem: a block that sways on its joint, closed and without slip all the time.
    const auto place = [](double step) {
      Plane run(joint, {.gravity = 0, .time_step = step});
      run.add_fixed_block(rectangle({0, -0.5}, 4, 1));
      const int b = run.add_block(rectangle({0, 0.25}, 1, 0.5), 2700);
      // In equilibrium under a pressure that keeps all points closed; then pushed sideways.
      run.add_load(b, {0, -1e6});
      run.prescribe([](const Vec2&) { return Stress<2>(1e6 * Stress<2>::Identity()); }, 1e-9);
      run.add_load(b, {2e5, 0});
      run.advance(0.024);
      return run.position(b);
    };
    const Vec2 a = place(8e-5), b = place(4e-5), c = place(2e-5);
    CHECK((a - b).norm() / (b - c).norm() == voussoir_test::near(4).epsilon(0.1));
  }

  // Free fall is exact in velocity Verlet; at rest a joint of length 1 m carries the weight above.
  TEST_CASE("a block that comes in the middle of a run falls and lands like any other") {
    Plane run(joint, {.safety = 0.25});
    run.add_fixed_block(rectangle({0, -0.5}, 20, 1));
    const int lower = run.add_block(rectangle({0, 0.5}, 1, 1), 2700);
    run.advance(0.05);
    const int late = run.add_block(rectangle({0, 1.8}, 1, 1), 2700);
    run.advance(0.2);
    CHECK(run.position(late).y() == voussoir_test::near(1.8 - 0.5 * 9.81 * 0.04).epsilon(1e-12));
    run.advance(0.1);
    // 0.2 % is lost in the impacts, in each of which a joint closes and opens within some steps.
    CHECK(std::abs(run.energy().relative_imbalance()) < 5e-3);
    run.set_local_damping(0.8);
    run.advance(1);
    // At rest the energy balance is compared with what was at stake: the fall, seen every 100
    // steps.
    CHECK(run.energy().highest_kinetic == voussoir_test::near(2700 * 9.81 * 0.3).epsilon(0.2));
    CHECK(run.energy().scale() >= run.energy().highest_kinetic);
    const double weight = 2700 * 9.81;
    const double fallen = 1.5 - run.position(late).y(), sunk = 0.5 - run.position(lower).y();
    CHECK(sunk == voussoir_test::near(2 * weight / 5e9).epsilon(1e-3));
    CHECK(fallen - sunk == voussoir_test::near(weight / 5e9).epsilon(1e-3));
    CHECK(run.kinetic_energy() < 1e-9 * weight * 0.3);
  }
}

}  // namespace free_motion_test
