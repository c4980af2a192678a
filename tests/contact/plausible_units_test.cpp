// SPDX-License-Identifier: MIT
// A value in the unit that people say (GPa/m, MPa, kN, degrees) instead of SI: every law, bolt and
// section says what was meant. Those of CoulombJoint stand with its other tests.
#include <doctest/doctest.h>

#include <string>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/lining/lining_model.hpp>

namespace plausible_units_test {

using namespace voussoir;

namespace {

template <class Make>
std::string refusal(Make&& make) {
  try {
    (void)make();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}
bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("contact/plausible_units") {
  TEST_CASE("joint laws") {
    using M = MohrCoulombJoint;
    CHECK(has(refusal([] {
                return M({5, 0.5, 0.6});
              }),
              "joint_normal_stiffness = 5 Pa/m: must be >= 1000 Pa/m; did you mean 5 GPa/m"));
    CHECK(refusal([] {
            return M({5e9, 5e8, 0.6, 0.3});
          }) == "cohesion = 0.3 Pa: must be >= 100 Pa; did you mean 0.3 MPa = 300000 Pa?");
    CHECK(has(refusal([] {
                return M({5e9, 5e8, 0.6, 3e5, 0.1});
              }),
              "tensile_strength = 0.1 Pa: must be >= 100 Pa; did you mean 0.1 MPa"));
    CHECK(has(refusal([] {
                return M({5e9, 5e8, 0.6, 3e5, 0, 10});
              }),
              "dilation_angle = 10 rad (572.958 deg): must be >= 0 and <= friction_angle; did you "
              "mean 10 deg = 0.174533 rad?"));
    CHECK(refusal([] { return M({5e9, 5e8, 0.6}); }) == "");
    CHECK(refusal([] { return M({5, 0.5, 0.6, 0.3, 0.1}, any_units); }) == "");

    BartonBandisJoint::Params rough{.roughness = 8,
                                    .wall_strength = 100e6,
                                    .residual_friction_angle = 0.5,
                                    .initial_stiffness = 20e9,
                                    .maximum_closure = 2e-4};
    const auto barton = [&](auto change) {
      auto bad = rough;
      change(bad);
      return refusal([&] { return BartonBandisJoint(bad); });
    };
    CHECK(barton([](auto&) {}) == "");
    CHECK(barton([](auto& p) { p.wall_strength = 100; }) ==
          "JCS = 100 Pa: must be >= 10000 Pa; did you mean 100 MPa = 1e8 Pa?");
    CHECK(has(barton([](auto& p) { p.initial_stiffness = 20; }),
              "K_ni = 20 Pa/m: must be >= 1000 Pa/m; did you mean 20 GPa/m"));
    CHECK(has(barton([](auto& p) { p.largest_stress = 5; }), "did you mean 5 MPa"));
    CHECK(has(barton([](auto& p) { p.residual_friction_angle = 28; }),
              "residual_friction_angle = 28 rad (1604.28 deg)"));
    rough.wall_strength = 100;
    CHECK(refusal([&] { return BartonBandisJoint(rough, any_units); }) == "");

    CHECK(has(refusal([] { return BurgersJoint({5, 0.5, 0.6, 1e15}); }), "did you mean 5 GPa/m"));
    CHECK(refusal([] {
            return BurgersJoint({5e9, 5e8, 0.6, 1e15, 0.2, 1e14});
          }) ==
          "kelvin_stiffness = 0.2 Pa/m: must be >= 1000 Pa/m; did you mean 0.2 GPa/m = 2e8 Pa/m?");
    CHECK(has(refusal([] { return BurgersJoint({5e9, 5e8, 35, 1e15}); }), "(2005.35 deg)"));
    CHECK(refusal([] { return BurgersJoint({5, 0.5, 0.6, 1, 0.2, 1}, any_units); }) == "");
    CHECK_THROWS_AS(BurgersJoint({5, 0.5, 0.6, 0}, any_units), InvalidInput);
  }

  TEST_CASE("bolts") {
    using B = AxialBolt;
    CHECK(refusal([] { return B({.axial_stiffness = 200}); }) ==
          "axial_stiffness = 200 N/m: must be >= 1000 N/m; did you mean 200 MN/m = 2e8 N/m?");
    CHECK(refusal([] { return B({.axial_stiffness = 2e8, .pretension = 100}); }) ==
          "pretension = 100 N: must be >= 1000 N; did you mean 100 kN = 100000 N?");
    CHECK(has(refusal([] { return B({.axial_stiffness = 2e8, .yield_force = 250}); }),
              "yield_force = 250 N: must be >= 1000 N; did you mean 250 kN"));
    CHECK(has(refusal([] { return B({.axial_stiffness = 2e8, .rupture_force = 300}); }),
              "rupture_force = 300 N"));
    CHECK(refusal([] { return B({.axial_stiffness = 2, .pretension = 1}, any_units); }) == "");
    using S = AxialShearBolt;
    CHECK(
        has(refusal([] { return S({.axial = {.axial_stiffness = 2e8}, .shear_stiffness = 300}); }),
            "shear_stiffness = 300 N/m: must be >= 1000 N/m; did you mean 300 MN/m"));
    CHECK(refusal([] { return S({.axial = {.axial_stiffness = 2e8}, .shear_stiffness = 0}); }) ==
          "");
    CHECK(refusal([] {
            return S({.axial = {.axial_stiffness = 2}, .shear_stiffness = 3}, any_units);
          }) == "");
  }

  TEST_CASE("lining sections") {
    CHECK(refusal([] { return LiningSection::rectangular(0.1, 25); }) ==
          "lining modulus = 25 Pa: must be >= 1e6 Pa; did you mean 25 GPa = 2.5e10 Pa?");
    CHECK(refusal([] { return LiningSection::rectangular(100, 25e9); }) ==
          "lining thickness = 100 m: must be <= 10 m; did you mean 100 mm = 0.1 m?");
    CHECK(has(refusal([] { return LiningSection::strip(0.1, 1, 25); }), "did you mean 25 GPa"));
    CHECK(refusal([] { return LiningSection::strip(0.1, 1, 25e9); }) == "");
  }
}

}  // namespace plausible_units_test
