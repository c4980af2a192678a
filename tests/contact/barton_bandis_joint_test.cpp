// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <type_traits>
#include <voussoir/contact/barton_bandis_joint.hpp>

namespace barton_bandis_joint_test {

using namespace voussoir;

namespace {

constexpr double degree = std::numbers::pi / 180, w = 0.4;
template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

constexpr BartonBandisJoint::Params params{.roughness = 10,
                                           .wall_strength = 100e6,
                                           .residual_friction_angle = 28 * degree,
                                           .initial_stiffness = 20e9,
                                           .maximum_closure = 2e-4};

template <int Dim>
PointLoad<Dim> point(double stress, double opening, double slip) {
  PointLoad<Dim> load{w, {}, {opening, Vec<Dim - 1>::Zero()}};
  load.initial.normal = stress * w;
  if constexpr (Dim == 2)
    load.motion.slip[0] = slip;
  else
    load.motion.slip = slip * Vec<2>(0.6, -0.8);
  return load;
}

}  // namespace

TEST_SUITE("contact/barton_bandis_joint") {
  TEST_CASE("the closure curve is the hyperbola through its three known points") {
    const BartonBandisJoint law(params);
    // Slope K_ni at the beginning, V_m / 2 at K_ni V_m, and its own inverse.
    CHECK(law.stress(1e-9) == doctest::Approx(20.0).epsilon(1e-4));
    CHECK(law.stress(1e-4) == doctest::Approx(4e6).epsilon(1e-12));
    CHECK(law.closure(4e6) == doctest::Approx(1e-4).epsilon(1e-12));
    CHECK(law.stress(0) == 0);
    CHECK(law.stress(-1e-5) == 0);
    // Beyond the largest stress it goes on along its tangent.
    const double v = law.closure(5e6), slope = law.joint_normal_stiffness();
    CHECK((law.stress(v) - law.stress(v - 1e-9)) / 1e-9 == doctest::Approx(slope).epsilon(1e-3));
    CHECK(law.stress(v + 1e-4) == doctest::Approx(5e6 + slope * 1e-4));
    CHECK(law.closure(6e6) == doctest::Approx(v + 1e6 / slope));
  }

  TEST_CASE("peak strength is phi_r at JCS, phi_r + JRC at a tenth, and no steeper than 70 deg") {
    const BartonBandisJoint law(params);
    CHECK(law.peak_strength(100e6) == doctest::Approx(100e6 * std::tan(28 * degree)));
    CHECK(law.peak_strength(10e6) == doctest::Approx(10e6 * std::tan(38 * degree)));
    CHECK(law.peak_strength(1e6) == doctest::Approx(1e6 * std::tan(48 * degree)));
    CHECK(law.peak_strength(100) == doctest::Approx(100 * std::tan(70 * degree)));
    CHECK(law.peak_strength(200e6) == doctest::Approx(200e6 * std::tan(28 * degree)));
  }

  TEST_CASE("a joint ten times as long as the sample is smoother and weaker") {
    auto longer = params;
    longer.sample_length = 0.1;
    longer.joint_length = 1;
    const BartonBandisJoint law(longer);
    CHECK(law.roughness() == doctest::Approx(10 * std::pow(10, -0.2)));         // 6.31
    CHECK(law.wall_strength() == doctest::Approx(100e6 * std::pow(10, -0.3)));  // 50.1 MPa
    // Peak slip of the sample: 0.1/500 (10/0.1)^0.33 = 0.914 mm, about 1 % of its length.
    CHECK(BartonBandisJoint(params).peak_slip() == doctest::Approx(0.914e-3).epsilon(1e-3));
  }

  TEST_CASE("stiffness and closure from JRC, JCS and the strength of the rock") {
    // By hand: JRC 10, JCS 100 MPa, sigma_c 150 MPa: a_j = 2 (0.3 - 0.1) = 0.4 mm,
    // K_ni = -7.15 + 17.5 + 0.02 * 250 = 15.35 MPa/mm, V_m = -0.296 - 0.056 + 2.241 * 250^-0.245.
    const auto found = BartonBandisJoint::from_index_tests(10, 100e6, 28 * degree, 150e6);
    CHECK(found.initial_stiffness == doctest::Approx(15.35e9));
    CHECK(found.maximum_closure == doctest::Approx(1e-3 * (2.241 * 0.2585 - 0.352)).epsilon(2e-3));
  }

  TEST_CASE_TEMPLATE("it returns the in-situ force, and follows the curve from there", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const BartonBandisJoint law(params);
    BartonBandisJoint::State<dim> state;
    auto load = point<dim>(1e6, 0, 0);
    load.initial.tangential[0] = 1e5;
    const auto force = law.force(load, state);
    CHECK(force.normal == doctest::Approx(1e6 * w).epsilon(1e-12));
    CHECK(force.tangential[0] == doctest::Approx(1e5).epsilon(1e-12));
    // Opened by all its closure it carries nothing, and closes on the same curve.
    load.motion.opening = law.closure(1e6);
    CHECK(std::abs(law.force(load, state).normal) < 1e-6);
    law.commit(load, state);
    load.motion.opening = law.closure(1e6) - law.closure(3e6);
    CHECK(law.force(load, state).normal == doctest::Approx(3e6 * w).epsilon(1e-12));
    CHECK(law.force(load, state).tangential.norm() < 1e-6);  // it has been open
  }

  TEST_CASE_TEMPLATE("in shear it reaches the peak at the peak slip, and stays there", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const BartonBandisJoint law(params);
    BartonBandisJoint::State<dim> state;
    const double peak = law.peak_strength(1e6) * w, slip = law.peak_slip();
    const auto shear = [&](double s) {
      return law.force(point<dim>(1e6, 0, s), state).tangential.norm();
    };
    CHECK(shear(0.5 * slip) == doctest::Approx(0.5 * peak).epsilon(1e-12));
    CHECK(shear(slip) == doctest::Approx(peak).epsilon(1e-12));
    CHECK(shear(3 * slip) == doctest::Approx(peak).epsilon(1e-12));
    double lost = 0;
    for (int k = 1; k <= 300; ++k) lost += law.commit(point<dim>(1e6, 0, 0.01 * k * slip), state);
    CHECK(lost == doctest::Approx(2 * slip * peak).epsilon(1e-9));
    CHECK(shear(2.5 * slip) == doctest::Approx(0.5 * peak).epsilon(1e-9));  // unloading
  }

  TEST_CASE("the energy it stores is the area under its curves") {
    const BartonBandisJoint law(params);
    const BartonBandisJoint::State<2> state;
    double work = 0;
    constexpr int steps = 2000;
    const double end = 3e-4;  // beyond the largest stress
    for (int k = 0; k < steps; ++k) work += law.stress((k + 0.5) * end / steps) * end / steps * w;
    CHECK(law.stored_energy(point<2>(0, -end, 0), state) == doctest::Approx(work).epsilon(1e-5));
    const double s = 0.3 * law.peak_slip();
    CHECK(law.stored_energy(point<2>(1e6, 0, s), state) -
              law.stored_energy(point<2>(1e6, 0, 0), state) ==
          doctest::Approx(0.5 * s * law.force(point<2>(1e6, 0, s), state).tangential.norm()));
  }

  TEST_CASE("parameters out of range are refused by name") {
    auto bad = params;
    bad.roughness = 21;
    CHECK_THROWS_WITH_AS(BartonBandisJoint{bad}, "JRC = 21: must be >= 0 and <= 20", InvalidInput);
    bad = params;
    bad.maximum_closure = 0;
    CHECK_THROWS_AS(BartonBandisJoint{bad}, InvalidInput);
    bad = params;
    bad.joint_length = 0.01;
    CHECK_THROWS_AS(BartonBandisJoint{bad}, InvalidInput);
    CHECK_THROWS_AS((void)BartonBandisJoint::from_index_tests(10, 200e6, 0.5, 150e6), InvalidInput);
  }
}

}  // namespace barton_bandis_joint_test
