// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <voussoir/bolt/axial_shear_bolt.hpp>

#include "support/reference.hpp"

namespace axial_shear_bolt_test {

using namespace voussoir;
using voussoir_test::reference;

namespace {

constexpr double axial_stiffness = 0.2e9, shear_stiffness = 0.3e9;

template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

AxialShearBolt dowel(AxialBolt::Params axial = {.axial_stiffness = axial_stiffness}) {
  return AxialShearBolt({.axial = axial, .shear_stiffness = shear_stiffness});
}

}  // namespace

TEST_SUITE("bolt/axial_shear_bolt") {
  TEST_CASE_TEMPLATE("the second spring pulls across the bar only", D, Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const Vec<dim> axis = Vec<dim>::LinSpaced(1, 2).normalized();
    Vec<dim> across = Vec<dim>::Zero();  // a unit vector normal to the bar
    across[0] = axis[1];
    across[1] = -axis[0];
    across.normalize();
    const double along = 1e-3, sideways = 2e-4;
    const Vec<dim> moved = along * axis + sideways * across;
    const BoltSpan<dim> span{0.5 * axis, axis, moved, moved};
    const BoltForce<dim> both = dowel().force(span, {});
    const BoltForce<dim> single = AxialBolt({.axial_stiffness = axial_stiffness}).force(span, {});
    CHECK(both.pull == single.pull);
    CHECK(single.dowel == Vec<dim>::Zero());
    // Roundings of the motion along the bar, five times the one across.
    CHECK((both.dowel - shear_stiffness * sideways * across).norm() <= 1e-14 * both.dowel.norm());
  }

  TEST_CASE("what is called axial is the axial spring alone") {
    const BoltSpan<2> span{{0, 0.5}, Vec2::UnitY(), {2e-3, 1e-3}};
    CHECK(dowel().force(span, {}).axial ==
          AxialBolt({.axial_stiffness = axial_stiffness}).force(span, {}).axial);
  }

  TEST_CASE("a slack dowel still carries shear") {
    const BoltSpan<2> span{{0, 0.5}, Vec2::UnitY(), {1e-3, -1e-3}, {1e-3, -1e-3}};
    const BoltForce<2> force = dowel().force(span, {});
    CHECK(force.pull == Vec2::Zero());
    CHECK((force.dowel - Vec2(shear_stiffness * 1e-3, 0)).norm() <= 1e-15 * 4 * force.dowel.norm());
  }

  TEST_CASE("anchors that turn with the rock move sideways, but no dowel feels it") {
    const BoltSpan<2> span{{0, 0.5}, Vec2::UnitY(), {1e-4, 0}, Vec2::Zero()};
    CHECK(dowel().force(span, {}).dowel == Vec2::Zero());
  }

  TEST_CASE("K_s of a grouted bar is E_b I beta^3, and loads the joint with K_s s") {
    // Bar of 28 mm in a hole of 42 mm, E_b = 200 GPa, grout E_g = 10 GPa. Each half of the bar is a
    // semi-infinite beam on springs of modulus 2 E_g / (d2/d1 - 1).
    const double d1 = 0.028, d2 = 0.042, bar = 200e9, grout = 10e9;
    const double inertia = std::numbers::pi * std::pow(d1, 4) / 64;
    const double modulus = 2 * grout / (d2 / d1 - 1);
    const double beta = std::pow(modulus / (4 * bar * inertia), 0.25);
    const double row = reference("F.lorig.Ks");
    CHECK(std::abs(beta - reference("F.lorig.beta")) <= 1e-11 * beta);  // 12 printed digits
    CHECK(std::abs(bar * inertia * std::pow(beta, 3) - row) <= 1e-11 * row);
    const AxialShearBolt bolt(
        {.axial = {.axial_stiffness = reference("F.lorig.Ka_joint")}, .shear_stiffness = row});
    const double s = 1e-5, d = 0.0672;
    const BoltForce<2> force = bolt.force<2>({{0, d}, Vec2::UnitY(), {s, 0}, {s, 0}}, {});
    CHECK(std::abs(force.dowel.x() - row * s) <= 1e-15 * 4 * row * s);
    // The axial spring adds K_a s^3 / (2 d^2) along the joint, 5e-8 of the dowel's K_s s.
    CHECK(force.pull.x() > 0);
    CHECK(force.pull.x() < 1e-7 * row * s);
  }

  TEST_CASE("the dowel is lost with the bar when it breaks") {
    const AxialShearBolt bolt = dowel({.axial_stiffness = axial_stiffness, .rupture_force = 200e3});
    AxialShearBolt::State state;
    const BoltSpan<2> span{{0, 0.5}, Vec2::UnitY(), {1e-3, 1.5e-3}, {1e-3, 1.5e-3}};
    CHECK(bolt.commit(span, state));
    CHECK(bolt.force(span, state).pull == Vec2::Zero());
    CHECK(bolt.force(span, state).dowel == Vec2::Zero());
  }

  TEST_CASE_TEMPLATE("the stiffness is the derivative of the pull at the initial span", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const AxialShearBolt bolt =
        dowel({.axial_stiffness = axial_stiffness, .carries_compression = true});
    const Vec<dim> axis = Vec<dim>::LinSpaced(1, 2).normalized();
    const double step = 1e-6;
    Stress<dim> k;
    for (int j = 0; j < dim; ++j) {
      const Vec<dim> motion = step * Vec<dim>::Unit(j);
      k.col(j) = (bolt.force<dim>({0.0672 * axis, axis, motion}, {}).pull -
                  bolt.force<dim>({0.0672 * axis, axis, -motion}, {}).pull) /
                 (2 * step);
    }
    // Across the bar the axial spring bends away with s^2 / (2 d^2) = 1e-10 at 1e-6 m.
    const Stress<dim> expected = bolt.stiffness<dim>({0.0672 * axis, axis, Vec<dim>::Zero()}).pull;
    CHECK((k - expected).norm() <= 2e-10 * axial_stiffness);
  }

  TEST_CASE("a shear stiffness that is negative or not finite is refused; zero is none") {
    const AxialBolt::Params axial{.axial_stiffness = axial_stiffness};
    for (const double bad :
         {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
      CHECK_THROWS_AS(AxialShearBolt({.axial = axial, .shear_stiffness = bad}), InvalidInput);
    CHECK_THROWS_AS(AxialShearBolt({.axial = {.axial_stiffness = -1}, .shear_stiffness = 1}),
                    InvalidInput);
    const AxialShearBolt none({.axial = axial, .shear_stiffness = 0});
    const BoltSpan<2> span{{0, 0.5}, Vec2::UnitY(), {1e-3, 1e-3}, {1e-3, 1e-3}};
    CHECK(none.force(span, {}).pull == AxialBolt(axial).force(span, {}).pull);
    CHECK(none.force(span, {}).dowel == Vec2::Zero());
  }
}

}  // namespace axial_shear_bolt_test
