// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <voussoir/theory/ground_reaction.hpp>
#include <voussoir/theory/longitudinal_profile.hpp>

#include "support/reference.hpp"

namespace ground_reaction_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::reference_table;
using voussoir_test::relative;

namespace {

constexpr double deg = std::numbers::pi / 180;
/// The values come from a numerical integration that holds 1e-7 and from the closed form; printed
/// with 12 and, in the tables, 10 digits.
constexpr double printed = 2e-11, tabled = 6e-10;

MohrCoulombGround ground(double c, double phi, double psi, double youngs_modulus, double nu) {
  return {{youngs_modulus / (2 * (1 + nu)), nu}, c, phi * deg, psi * deg};
}

}  // namespace

TEST_SUITE("theory/ground_reaction") {
  TEST_CASE("convergence and plastic ring of three grounds") {
    for (const auto& row : reference_table("ground-reaction-curve")) {
      const double p0 = row["p0_Pa"];
      const GroundReactionCurve curve(
          row["a_m"], p0,
          ground(row["c_Pa"], row["phi_deg"], row["psi_deg"], row["E_Pa"], row["nu"]));
      CAPTURE(row.text("case"));
      CAPTURE(row.text("p_i_over_p0"));
      const double pressure = row["p_i_over_p0"] * p0;
      CHECK(relative(curve.critical_pressure(), row["p_cr_Pa"]) <= tabled);
      CHECK(relative(curve.plastic_radius(pressure), row["plastic_radius_m"]) <= tabled);
      CHECK(relative(curve.convergence(pressure), row["u_wall_inward_m"]) <= tabled);
    }
  }

  TEST_CASE("the same with 12 digits") {
    const std::map<std::string, GroundReactionCurve> curves{
        {"caseA", {5, 5e6, ground(5e5, 30, 0, 1e9, 0.3)}},
        {"caseB", {5, 5e6, ground(5e5, 30, 10, 1e9, 0.3)}},
        {"caseP", {5, 662175, ground(2e4, 35, 0, 1.44398e9, 0.37)}}};
    for (const auto& [key, curve] : curves) {
      const std::string name = key;
      CAPTURE(name);
      const double p0 = name == "caseP" ? 662175 : 5e6;
      CHECK(relative(curve.critical_pressure(), reference("C.grc." + name + ".pcr")) <= printed);
      for (const auto& [id, part] : {std::pair(".pi0.0", 0.0), {".pi0.1", 0.1}}) {
        CHECK(relative(curve.plastic_radius(part * p0), reference("C.grc." + name + id + ".rp")) <=
              printed);
        CHECK(relative(curve.convergence(part * p0), reference("C.grc." + name + id + ".u")) <=
              printed);
      }
    }
  }

  TEST_CASE("without dilation it is Duncan Fama's formula") {
    const GroundReactionCurve curve(5, 5e6, ground(5e5, 30, 0, 1e9, 0.3));
    const double two_g = 1e9 / 1.3;
    for (const double p : {0.0, 1e5, 1e6}) {
      const double ratio = curve.plastic_radius(p) / 5;
      const double u =
          5 / two_g *
          (2 * 0.7 * (5e6 - curve.critical_pressure()) * ratio * ratio - 0.4 * (5e6 - p));
      CHECK(relative(curve.convergence(p), u) <= 1e-13);
    }
  }

  TEST_CASE("smooth where yielding begins, elastic above") {
    const GroundReactionCurve curve(5, 5e6, ground(5e5, 30, 10, 1e9, 0.3));
    const double p = curve.critical_pressure(), h = 1e-4 * p;
    CHECK(relative(curve.convergence(p * (1 - 1e-12)), curve.convergence(p)) <= 1e-11);
    const double below = (curve.convergence(p - h) - curve.convergence(p)) / h;
    CHECK(relative(below, 5 / (1e9 / 1.3)) <= 1e-3);  // first order in h
    CHECK(curve.convergence(5e6) == 0);
    CHECK(curve.plastic_radius(p) == 5);
  }

  TEST_CASE("the curve inverted, and met by a support that comes late") {
    const GroundReactionCurve curve(5, 5e6, ground(5e5, 30, 0, 1e9, 0.3));
    for (const double p : {0.0, 3e5, 2e6, 4e6, 5e6})
      CHECK(std::abs(curve.pressure_at(curve.convergence(p)) - p) <= 1e-8 * 5e6);
    for (const double late : {0.0, 0.01, 0.05})
      for (const double flexibility : {0.0, 1e-9, 1e-7}) {
        const double dp = curve.support_pressure(late, flexibility);
        CHECK(relative(curve.convergence(dp), late + flexibility * dp) <= 1e-9);
      }
    CHECK(curve.support_pressure(1.0, 1e-9) == 0);
    // Elastic ground: (1 - u / u_max) of what a support wished in place gets.
    const GroundReactionCurve elastic(5, 1e6, ground(1e9, 30, 0, 1e9, 0.3));
    const double whole = elastic.support_pressure(0, 1e-8);
    CHECK(relative(elastic.support_pressure(0.3 * elastic.convergence(0), 1e-8), 0.7 * whole) <=
          1e-12);
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const MohrCoulombGround good = ground(5e5, 30, 0, 1e9, 0.3);
    for (const double bad : {0.0, -1.0, nan}) {
      CHECK_THROWS_AS(GroundReactionCurve(bad, 5e6, good), InvalidInput);
      CHECK_THROWS_AS(GroundReactionCurve(5, bad, good), InvalidInput);
      CHECK_THROWS_AS(GroundReactionCurve(5, 5e6, ground(5e5, bad, 0, 1e9, 0.3)), InvalidInput);
      CHECK_THROWS_AS(GroundReactionCurve(5, 5e6, ground(5e5, 30, 0, bad, 0.3)), InvalidInput);
    }
    CHECK_THROWS_AS(GroundReactionCurve(5, 5e6, ground(-1, 30, 0, 1e9, 0.3)), InvalidInput);
    CHECK_THROWS_AS(GroundReactionCurve(5, 5e6, ground(5e5, 30, 31, 1e9, 0.3)), InvalidInput);
    CHECK_THROWS_AS(GroundReactionCurve(5, 5e6, ground(5e5, 90, 0, 1e9, 0.3)), InvalidInput);
    CHECK_THROWS_AS(GroundReactionCurve(5, 5e6, ground(5e5, 30, 0, 1e9, 0.5)), InvalidInput);
    const GroundReactionCurve curve(5, 5e6, good);
    for (const double bad : {-1.0, 5.1e6, nan}) {
      CHECK_THROWS_AS(curve.convergence(bad), InvalidInput);
      CHECK_THROWS_AS(curve.plastic_radius(bad), InvalidInput);
    }
    for (const double bad : {-1e-9, 1.0, nan})
      CHECK_THROWS_AS(curve.pressure_at(bad), InvalidInput);
    CHECK_THROWS_AS(curve.support_pressure(-1, 1e-9), InvalidInput);
    CHECK_THROWS_AS(curve.support_pressure(0, nan), InvalidInput);
  }
}

TEST_SUITE("theory/longitudinal_profile") {
  TEST_CASE("a table of distances and plastic radii") {
    for (const auto& row : reference_table("longitudinal-displacement-profile"))
      CHECK(relative(longitudinal_profile(row["X_star"], row["R_star"]), row["u_over_umax"]) <=
            tabled);
    for (const char* r : {"1.0", "2.0"})
      for (const char* x : {"-1", "0", "2"})
        CHECK(relative(longitudinal_profile(std::stod(x), std::stod(r)),
                       reference(std::string("C.ldp.R") + r + ".X" + x)) <= printed);
  }

  TEST_CASE("continuous at the face, 0 far ahead, 1 far behind") {
    CHECK(relative(longitudinal_profile(1e-13, 2), longitudinal_profile(-1e-13, 2)) <= 1e-12);
    CHECK(longitudinal_profile(-100, 2) < 1e-40);
    CHECK(longitudinal_profile(100, 1) == 1);
  }

  // The fit as it is printed: u0 + A_a (1 - exp(B_a x)) ahead, u0 + A_b (1 - (B_b / (B_b + x))^2)
  // behind; figures by hand for nu = 0 and 0.5. Rounding alone: 1e-14.
  TEST_CASE("elastic ground: the face, one radius behind it and ahead, both ends") {
    CHECK(relative(elastic_longitudinal_profile(0, 0), 0.19) <= 1e-14);
    CHECK(relative(elastic_longitudinal_profile(0, 0.5), 0.30) <= 1e-14);
    CHECK(relative(elastic_longitudinal_profile(1, 0), 1 - 0.81 * std::pow(0.65 / 1.65, 2)) <=
          1e-14);
    CHECK(relative(elastic_longitudinal_profile(2, 0.5), 1 - 0.70 * std::pow(0.845 / 2.845, 2)) <=
          1e-14);
    CHECK(relative(elastic_longitudinal_profile(-1, 0.5), 0.30 - 0.30 * (1 - std::exp(-1.175))) <=
          1e-14);
    for (const double nu : {0.0, 0.2, 0.5}) {
      CHECK(relative(elastic_longitudinal_profile(1e-13, nu),
                     elastic_longitudinal_profile(-1e-13, nu)) <= 1e-11);
      CHECK(elastic_longitudinal_profile(-60, nu) < 1e-20);
      CHECK(relative(elastic_longitudinal_profile(1e9, nu), 1) <= 1e-14);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(elastic_longitudinal_profile(nan, 0.2), InvalidInput);
    for (const double bad : {-0.01, 0.51, nan})
      CHECK_THROWS_AS(elastic_longitudinal_profile(0, bad), InvalidInput);
  }

  TEST_CASE("fictitious support pressure of elastic ground") {
    CHECK(relative(fictitious_pressure(662175, longitudinal_profile(1, 1)),
                   reference("C.fict.elastic.X1")) <= printed);
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(longitudinal_profile(nan, 1), InvalidInput);
    for (const double bad : {0.99, nan})
      CHECK_THROWS_AS(longitudinal_profile(0, bad), InvalidInput);
    for (const double bad : {-0.1, 1.1, nan})
      CHECK_THROWS_AS(fictitious_pressure(1e6, bad), InvalidInput);
    CHECK_THROWS_AS(fictitious_pressure(-1, 0.5), InvalidInput);
  }
}

}  // namespace ground_reaction_test
