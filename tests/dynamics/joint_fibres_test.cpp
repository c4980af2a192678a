// SPDX-License-Identifier: MIT
// Joints of eight points, each with the law to itself, against the product's rule: two points on
// what is pressed. Two answers to one question, from the forces on.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/laid_problem.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace joint_fibres_test {

using namespace voussoir;
using voussoir_test::circular_arch;
using voussoir_test::comes_to_rest;
using voussoir_test::degree;
using voussoir_test::rectangle;
using voussoir_test::reference;

namespace {

/// Quarter of the period of a block, 2b wide and 2h high, let go at part f of the angle at which it
/// tips over [s].
double quarter_period(double b, double h, double f, bool joint_fibres) {
  const double alpha = std::atan(b / h), tilt = f * alpha, radius = std::hypot(b, h);
  Dynamics<2, CoulombJoint> run(CoulombJoint({2e12, 2e11, 30 * degree}),
                                {.safety = 0.25, .joint_fibres = joint_fibres});
  run.add_fixed_block(rectangle({0, -1}, 20, 2));
  const Vec2 centre = radius * Vec2(-std::sin(alpha - tilt), std::cos(alpha - tilt));
  const int block = run.add_block(rectangle(centre, 2 * b, 2 * h, -tilt), 2700);
  while (run.body(block).angle < tilt && run.time() < 5) run.advance(1e-3);
  CHECK(std::abs(run.energy().relative_imbalance()) < 1e-3);
  return run.time();
}

/// Whether the arch comes to rest under its weight before a block has moved by 5 cm.
bool arch_stands(double thickness, bool joint_fibres) {
  auto run = circular_arch(7, thickness)
                 .run(CoulombJoint({2e11, 2e11, 45 * degree}),
                      {.local_damping = 0.7, .joint_fibres = joint_fibres});
  return comes_to_rest(run, 0.05, 1e-5);
}

}  // namespace

TEST_SUITE("dynamics/joint_fibres") {
  TEST_CASE("Lobatto's eight points: all powers up to the 13th, the ends among them") {
    const Segment s{{-1, 2}, {3, 2}};
    const auto points = s.lobatto_points();
    CHECK(points.front().offset.x() == -2);
    CHECK(points.back().offset.x() == 2);
    for (int power = 0; power <= 14; ++power) {
      CAPTURE(power);
      double sum = 0;
      for (const auto& p : points) sum += p.weight * std::pow(0.5 * p.offset.x(), power);
      const double exact = power % 2 == 0 ? 4.0 / (power + 1) : 0;
      // 15 digits are written of the rule. The 14th power is the first that it misses, by 1e-3.
      if (power < 14)
        CHECK(std::abs(sum - exact) < 1e-13);
      else
        CHECK(std::abs(sum - exact) > 1e-4);
    }
  }

  TEST_CASE("closed joints: the same motion as by two points") {
    // A leaning pile, pushed, all joints closed: both rules are exact there, so all that differs is
    // rounding, which damped motion keeps as it is.
    double angle[2], x[2];
    for (const bool joint_fibres : {false, true}) {
      Dynamics<2, CoulombJoint> run(CoulombJoint({5e9, 5e8, 50 * degree}),
                                    {.local_damping = 0.3, .joint_fibres = joint_fibres});
      run.add_fixed_block(rectangle({0, -0.5}, 6, 1));
      run.add_block(rectangle({0, 0.5}, 2, 1), 2700);
      const int top = run.add_block(rectangle({0.3, 1.5}, 1.6, 1), 2700);
      Stress<2> stress = Stress<2>::Zero();
      stress(1, 1) = 1e5;
      run.prescribe([&](const Vec2&) { return stress; }, 1e-9);
      for (int b = 1; b < 3; ++b) run.add_load(b, {2e3, -6e4});
      run.advance(0.05);
      angle[joint_fibres] = run.body(top).angle;
      x[joint_fibres] = run.position(top).x();
      for (const auto& c : run.joints().contacts())
        CHECK(c.last - c.first == (joint_fibres ? 8 : 2));
    }
    CHECK(std::abs(angle[0]) > 1e-6);  // it has turned
    CHECK(angle[1] == voussoir_test::near(angle[0]).epsilon(1e-9));
    CHECK(x[1] - 0.3 == voussoir_test::near(x[0] - 0.3).epsilon(1e-9));
  }

  TEST_CASE("a rocking block has Housner's quarter period") {
    // The outermost fibre is at the edge and bears all while 1 % of the joint is pressed.
    for (const auto& [key, b, h, f] :
         {std::tuple{"b0.5.h2.0.f0.5", 0.5, 2.0, 0.5}, {"b0.25.h1.5.f0.2", 0.25, 1.5, 0.2}}) {
      const std::string id = key;
      CAPTURE(id);
      const double exact = 0.25 * reference("F.rock." + id + ".T_exact");
      CHECK(quarter_period(b, h, f, true) == voussoir_test::near(exact).epsilon(1e-2));
      CHECK(quarter_period(b, h, f, false) == voussoir_test::near(exact).epsilon(1e-2));
    }
  }

  TEST_CASE("an arch stands and falls with the thickness of Milankovitch") {
    const double limit = 10 * reference("F.arch.N7");
    for (const bool joint_fibres : {false, true}) {
      CAPTURE(joint_fibres);
      CHECK(!arch_stands(0.97 * limit, joint_fibres));
      CHECK(arch_stands(1.03 * limit, joint_fibres));
    }
  }

  TEST_CASE("in 3-D there are none") {
    using Run = Dynamics<3, CoulombJoint>;
    CHECK_THROWS_WITH_AS(Run(CoulombJoint({5e9, 5e8, 0.5}), {.joint_fibres = true}),
                         "joint_fibres: joints are of fibres in 2-D alone", InvalidInput);
  }
}

}  // namespace joint_fibres_test
