// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <voussoir/lining/beams.hpp>
#include <voussoir/lining/frame_element.hpp>

#include "support/dense_algebra.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace beams_test {

using namespace voussoir;
using voussoir_test::reference;

namespace {

using Element = ElementMatrix<3>;
using Ends = Eigen::Matrix<double, 6, 1>;

/// 0.1 m of concrete, as in the reference table.
LiningSection section() { return LiningSection::rectangular(0.1, 25e9, 0.2); }

/// An element from a to b in world axes.
template <class Beam>
Element world_stiffness(const Vec2& a, const Vec2& b, const LiningSection& s) {
  const Element turn = in_element_axes<2>(frame_axes<2>(b - a, Vec2::Zero()));
  return turn.transpose() * Beam::template stiffness<3>(s, (b - a).norm()) * turn;
}

}  // namespace

TEST_SUITE("lining/beams") {
  TEST_CASE("a rectangular section has E A, E I and 5/6 G A of one metre") {
    const LiningSection s = section();
    // E t = 2.5e9; E t^3 / 12 = 25e9 * 1e-3 / 12; G = 25e9 / 2.4
    CHECK(std::abs(s.axial_stiffness - 2.5e9) <= 1e-15 * 2.5e9);
    CHECK(std::abs(s.bending_stiffness - 25e6 / 12) <= 1e-15 * 4 * 25e6 / 12);
    CHECK(std::abs(s.shear_stiffness - 5.0 / 6 * 25e9 / 2.4 * 0.1) <= 1e-15 * 4 * 8.7e8);
    CHECK(s.mass == 0);  // weightless, as in the paper
  }

  TEST_CASE("element stiffnesses are those of the unit-load flexibility") {
    const double length = 10 * std::sin(std::numbers::pi / 32);  // chord of a 32-gon on R = 5 m
    const Element euler = EulerBernoulliBeam::stiffness<3>(section(), length);
    const Element timoshenko = TimoshenkoBeam::stiffness<3>(section(), length);
    const auto agrees = [](double value, const char* row) {
      CAPTURE(row);
      CHECK(std::abs(value - reference(row)) <= 1e-11 * reference(row));  // 12 printed digits
    };
    agrees(euler(1, 1), "D.k.EB.vv");
    agrees(euler(1, 2), "D.k.EB.vt");
    agrees(euler(2, 2), "D.k.EB.tt");
    agrees(euler(2, 5), "D.k.EB.tf");
    agrees(timoshenko(1, 1), "D.k.T.vv");
    agrees(timoshenko(1, 2), "D.k.T.vt");
    agrees(timoshenko(2, 2), "D.k.T.tt");
    agrees(timoshenko(2, 5), "D.k.T.tf");
    agrees(euler(0, 0), "D.k.axial");
    agrees(timoshenko(0, 0), "D.k.axial");
    agrees(-euler(0, 3), "D.k.axial");
  }

  TEST_CASE("one element carries a tip load exactly") {
    const double length = 2, force = 1000;
    const auto tip = [&](const Element& k) {  // first node clamped, transverse load at the second
      return Vec<3>(voussoir_test::solve(k.bottomRightCorner<3, 3>(), Vec<3>(0, force, 0)));
    };
    const Vec<3> euler = tip(EulerBernoulliBeam::stiffness<3>(section(), length));
    const Vec<3> timoshenko = tip(TimoshenkoBeam::stiffness<3>(section(), length));
    const double bends = reference("D.cantilever.EB"), shears = reference("D.cantilever.T");
    CHECK(std::abs(euler[1] - bends) <= 1e-12 * bends);  // condition of a 3 x 3 of spread 1e3
    CHECK(std::abs(timoshenko[1] - shears) <= 1e-12 * shears);
    const double turn = force * length * length / (2 * section().bending_stiffness);  // P l^2 / 2EI
    CHECK(std::abs(euler[2] - turn) <= 1e-12 * turn);
    CHECK(std::abs(timoshenko[2] - turn) <= 1e-12 * turn);  // shear turns no section
  }

  TEST_CASE_TEMPLATE("rigid motions need no force", Beam, EulerBernoulliBeam, TimoshenkoBeam) {
    const Vec2 a(3, -2), b(3.4, -1.3);
    const Element k = world_stiffness<Beam>(a, b, section());
    Ends along, up, turn;
    along << 1, 0, 0, 1, 0, 0;
    up << 0, 1, 0, 0, 1, 0;
    // About the origin: every node moves by perpendicular(x) and turns by 1.
    turn << perpendicular(a), 1, perpendicular(b), 1;
    for (const Ends& motion : {along, up, turn})
      CHECK((k * motion).norm() <= 1e-15 * 4 * k.norm() * motion.norm());
  }

  TEST_CASE_TEMPLATE("an element is symmetric and resists everything but rigid motion", Beam,
                     EulerBernoulliBeam, TimoshenkoBeam) {
    const Element k = Beam::template stiffness<3>(section(), 0.7);
    CHECK(k == k.transpose());
    const Eigen::VectorXd modes = voussoir_test::eigenvalues(k);
    for (int m = 0; m < 3; ++m) CHECK(std::abs(modes[m]) <= 1e-14 * modes[5]);
    CHECK(modes[3] > 1e-4 * modes[5]);  // EI / l over EA / l is 8e-4
  }

  TEST_CASE("Timoshenko's beam becomes Euler and Bernoulli's as the shear stiffness grows") {
    const double length = 0.7;
    const Element euler = EulerBernoulliBeam::stiffness<3>(section(), length);
    const auto distance = [&](double factor) {
      LiningSection stiff = section();
      stiff.shear_stiffness *= factor;
      return (TimoshenkoBeam::stiffness<3>(stiff, length) - euler).norm() / euler.norm();
    };
    // 1/(1 + phi) - 1 goes like phi, and phi like 1 / (kappa G A): ten times stiffer, ten times
    // nearer, up to a few phi (0.6 % here at factor 10).
    CHECK(distance(1) > 1e-3);
    CHECK(distance(100) / distance(1000) == voussoir_test::near(10).epsilon(0.002));
    CHECK(distance(1e14) <= 1e-15);
  }

  TEST_CASE("element axes: x runs from the first node to the second, y to the left of it") {
    const Vec2 a(1, 2), b(-1, 3);
    const Element turn = in_element_axes<2>(frame_axes<2>(b - a, Vec2::Zero()));
    CHECK((turn * turn.transpose() - Element::Identity()).norm() <= 1e-15);
    const Vec2 along = (b - a).normalized();
    Ends world;
    world << along, 0.25, perpendicular(along), -0.5;
    Ends local;
    local << 1, 0, 0.25, 0, 1, -0.5;  // rotations are the same in all axes of the plane
    CHECK((turn * world - local).norm() <= 1e-15);
  }

  TEST_CASE("sections out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, 0.0, -0.1, std::numeric_limits<double>::infinity()}) {
      CHECK_THROWS_AS((void)LiningSection::rectangular(bad, 25e9), InvalidInput);
      CHECK_THROWS_AS((void)LiningSection::rectangular(0.1, bad), InvalidInput);
    }
    for (const double bad : {nan, -1.0, 0.5})
      CHECK_THROWS_AS((void)LiningSection::rectangular(0.1, 25e9, bad), InvalidInput);
  }
}

}  // namespace beams_test
