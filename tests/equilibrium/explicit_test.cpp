// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/bolt_spring.hpp>
#include <voussoir/model/system.hpp>

namespace explicit_test {

using namespace voussoir;

namespace {

using Masses = System<Planar>;

constexpr double stiffness = 3e6;

/// Two bodies joined by one spring along x through both centres, free in space.
Masses two_masses() {
  Masses system(CoulombJoint({1, 1, 0}, any_units), 1, CoulombJoint({1, 1, 0}, any_units));
  system.add_body({Vec2(0, 0), 1, 1, true});
  system.add_body({Vec2(1, 0), 1, 1, true});
  auto bolts = std::make_shared<BoltSet<2, AxialBolt>>(
      AxialBolt({.axial_stiffness = stiffness, .carries_compression = true}));
  BoltSpring<2, AxialBolt> spring{};
  spring.a = 0;
  spring.b = 1;
  spring.arm_a = spring.arm_b = Vec2::Zero();
  spring.joint_a = {0.5, 0};
  spring.joint_b = {-0.5, 0};
  spring.span = {{1, 0}, {1, 0}, {0, 0}};
  spring.share = 1;
  bolts->add(spring);
  system.supports.add(bolts);
  return system;
}

Eigen::VectorXd masses(double m1, double m2) {
  Eigen::VectorXd mass(6);
  mass << m1, m1, m1, m2, m2, m2;
  return mass;
}

/// Largest |u| after many leapfrog steps from a small relative velocity.
double swing(Masses& system, const Eigen::VectorXd& mass, double step) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6), v = Eigen::VectorXd::Zero(6), f;
  v[0] = -1e-3 / mass[0];
  v[3] = 1e-3 / mass[3];
  for (int k = 0; k < 2000; ++k) {
    system.forces(u, f);
    v += step * f.cwiseQuotient(mass);
    u += step * v;
  }
  return u.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_SUITE("equilibrium/explicit") {
  TEST_CASE("the critical step of two equal masses on a spring is 2 / omega") {
    const Masses system = two_masses();
    const double mass = 40, omega = std::sqrt(2 * stiffness / mass);  // k (1/m + 1/m)
    const double step = Explicit::critical_step(system, masses(mass, mass));
    CHECK(std::abs(step - 2 / omega) <= 1e-15 * 4 / omega);
  }

  TEST_CASE("with unequal masses Gershgorin's bound stays on the safe side, within sqrt 2") {
    const Masses system = two_masses();
    for (const double ratio : {1.5, 4.0, 100.0}) {
      const double omega = std::sqrt(stiffness * (1 / 40.0 + 1 / (40.0 * ratio)));
      const double part = Explicit::critical_step(system, masses(40, 40 * ratio)) * omega / 2;
      // omega^2 lies between k / m and the bound 2 k / m of the lighter mass.
      CHECK(part <= 1);
      CHECK(part >= std::sqrt(0.5));
    }
  }

  TEST_CASE("a step just below the critical one is stable, one just above is not") {
    Masses system = two_masses();
    const Eigen::VectorXd mass = masses(40, 40);
    const double critical = Explicit::critical_step(system, mass);
    const double amplitude = 1e-3 / 40 / std::sqrt(2 * stiffness / 40);  // v / omega
    // At 0.99 of the critical step leapfrog exaggerates by 1 / sqrt(1 - 0.99^2) = 7; at 1.01 it
    // grows by a factor 1.15 a step, without end.
    CHECK(swing(system, mass, 0.99 * critical) < 10 * amplitude);
    CHECK(!(swing(system, mass, 1.01 * critical) <= 1e6 * amplitude));  // not a number by then
  }

  TEST_CASE("parameters out of range are refused") {
    const auto with = [](auto&& change) {
      Explicit::Params params;
      change(params);
      return params;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, -0.1, 1.0})
      CHECK_THROWS_AS(Explicit(with([&](auto& p) { p.damping = bad; })), InvalidInput);
    for (const double bad : {nan, 0.0, 1.1})
      CHECK_THROWS_AS(Explicit(with([&](auto& p) { p.safety = bad; })), InvalidInput);
    CHECK_THROWS_AS(Explicit(with([](auto& p) { p.ramp_steps = -1; })), InvalidInput);
    CHECK_THROWS_AS(Explicit(with([](auto& p) { p.max_steps = p.ramp_steps; })), InvalidInput);
  }
}

}  // namespace explicit_test
