// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <voussoir/theory/lining_in_ground.hpp>
#include <voussoir/theory/thin_lining.hpp>

#include "support/reference.hpp"

namespace lining_in_ground_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::reference_table;
using voussoir_test::relative;

namespace {

constexpr double a = 5, p0 = 662175, pi = std::numbers::pi;
constexpr ElasticGround g1{3.85e8, 0.2}, g3{5.27e8, 0.37};
constexpr double tabled = 6e-10;  ///< 10 digits
/// 12 digits of a solution of linear equations that the formulas match to 1e-8 or better.
constexpr double printed = 1e-10;

ElasticGround ground(const std::string& name) {
  return name == "G1" ? g1 : name == "G3" ? g3 : ElasticGround{1.60416666666667e9, 0.2};
}
LiningInterface interface_of(const std::string& name) {
  return name == "no_slip" ? LiningInterface::no_slip : LiningInterface::full_slip;
}

}  // namespace

TEST_SUITE("theory/lining_in_ground") {
  TEST_CASE("thrust, moment and displacement, against the direct solution") {
    for (const auto& row : reference_table("lining-einstein-schwartz")) {
      CAPTURE(row.text("interface"));
      CAPTURE(row.text("K0"));
      CAPTURE(row.text("modulus"));
      const auto r =
          einstein_schwartz(RingLining::rectangular(a, row["t_m"], 25e9), {p0, row["K0"]},
                            ground(row.text("modulus")), interface_of(row.text("interface")));
      CHECK(relative(r.thrust_at(0), row["N_springing"]) <= tabled);
      CHECK(relative(r.thrust_at(pi / 2), row["N_crown"]) <= tabled);
      CHECK(relative(r.convergence_at(0), row["u_springing_inward"]) <= 1e-8);  // a difference
      CHECK(relative(r.convergence_at(pi / 2), row["u_crown_inward"]) <= tabled);
      if (row["K0"] == 1) continue;  // rounding about zero in the table
      CHECK(relative(r.moment_at(0), row["M_springing"]) <= tabled);
      CHECK(relative(r.moment_at(pi / 2), row["M_crown"]) <= tabled);
      CHECK(relative(r.tangential_amplitude, row["v_amplitude_sin2theta"]) <= tabled);
    }
  }

  TEST_CASE("the same with 12 digits") {
    for (const char* interface : {"no_slip", "full_slip"})
      for (const char* k0 : {"0.5", "1.5"})
        for (const char* name : {"G1", "G3"}) {
          const std::string id = std::string("C.ES.") + interface + ".K" + k0 + "." + name + ".";
          CAPTURE(id);
          const auto r =
              einstein_schwartz(RingLining::rectangular(a, 0.1, 25e9), {p0, std::stod(k0)},
                                ground(name), interface_of(interface));
          for (const auto& [place, theta] : {std::pair("springing", 0.0), {"crown", pi / 2}}) {
            CHECK(relative(r.thrust_at(theta), reference(id + place + ".N")) <= printed);
            CHECK(relative(r.moment_at(theta), reference(id + place + ".M")) <= printed);
            CHECK(relative(r.convergence_at(theta), reference(id + place + ".u")) <= 1e-9);
          }
        }
  }

  TEST_CASE("bending stiffness from a thousandth to a hundred times that of 10 cm") {
    for (const auto& row : reference_table("lining-bending-stiffness")) {
      RingLining lining = RingLining::rectangular(a, 0.1, 25e9);
      lining.inertia *= row["EI_factor"];
      const auto r = einstein_schwartz(lining, {p0, row["K0"]}, ground(row.text("modulus")),
                                       interface_of(row.text("interface")));
      CAPTURE(row.text("interface"));
      CAPTURE(row.text("EI_factor"));
      CHECK(relative(r.thrust + std::abs(r.thrust_amplitude), row["N_max"]) <= tabled);
      CHECK(relative(r.thrust - std::abs(r.thrust_amplitude), row["N_min"]) <= tabled);
      CHECK(relative(std::abs(r.moment_amplitude), row["M_abs_max"]) <= tabled);
    }
  }

  TEST_CASE("equal stresses: the thin lining, but for the curvature of the ring") {
    // C* / F* = I / (A R^2) = (t / R)^2 / 12 = 3e-5 of the stiffness.
    const auto r = einstein_schwartz(RingLining::rectangular(a, 0.1, 25e9), {p0, 1}, g3,
                                     LiningInterface::no_slip);
    CHECK(relative(r.thrust, thin_lining({a, 0.1, 25e9}, p0, g3.shear_modulus).thrust) <= 3.4e-5);
    CHECK(r.thrust_amplitude == 0);
    CHECK(r.moment_amplitude == 0);
  }

  TEST_CASE("inextensible lining: Curtis' form") {
    for (const char* k0 : {"0.5", "1.5"})
      for (const char* name : {"G1", "G3"}) {
        const std::string id = std::string("K") + k0 + "." + name + ".";
        const FarStress far{p0, std::stod(k0)};
        const RingLining lining = RingLining::rectangular(a, 0.1, 25e9);
        const auto slip = curtis(lining, far, ground(name), LiningInterface::full_slip);
        CHECK(relative(slip.moment_amplitude, reference("C.curtis.full_slip." + id + "M")) <=
              printed);
        // Full slip needs no stretching of the ring: the area does not matter.
        CHECK(relative(einstein_schwartz(lining, far, ground(name), LiningInterface::full_slip)
                           .moment_amplitude,
                       slip.moment_amplitude) <= 1e-12);
        CHECK(relative(slip.thrust_amplitude, slip.moment_amplitude / a) <= 1e-14);
        const auto stuck = curtis(lining, far, ground(name), LiningInterface::no_slip);
        CHECK(relative(stuck.moment_amplitude, reference("C.curtis.no_slip." + id + "M")) <=
              printed);
        CHECK(relative(stuck.thrust_amplitude, reference("C.curtis.no_slip." + id + "N2")) <=
              printed);
        RingLining thick = lining;
        thick.area = 1e9;  // C* of 1e-10
        const auto limit = einstein_schwartz(thick, far, ground(name), LiningInterface::no_slip);
        CHECK(relative(limit.moment_amplitude, stuck.moment_amplitude) <= 1e-8);
        CHECK(relative(limit.thrust_amplitude, stuck.thrust_amplitude) <= 1e-8);
        const auto real = einstein_schwartz(lining, far, ground(name), LiningInterface::no_slip);
        CHECK(relative(real.moment_amplitude / stuck.moment_amplitude,
                       reference("C.curtis.no_slip." + id + "M_ratio_extensible")) <= printed);
      }
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto run = [](const RingLining& lining, const FarStress& far, const ElasticGround& g) {
      (void)einstein_schwartz(lining, far, g, LiningInterface::no_slip);
    };
    const auto old = [](const RingLining& lining, const FarStress& far, const ElasticGround& g) {
      (void)curtis(lining, far, g, LiningInterface::full_slip);
    };
    const RingLining good = RingLining::rectangular(a, 0.1, 25e9);
    for (const double bad : {0.0, -1.0, nan}) {
      CHECK_THROWS_AS(run({bad, 0.1, 1e-4, 25e9}, {p0, 1}, g1), InvalidInput);
      CHECK_THROWS_AS(run({a, bad, 1e-4, 25e9}, {p0, 1}, g1), InvalidInput);
      CHECK_THROWS_AS(run({a, 0.1, bad, 25e9}, {p0, 1}, g1), InvalidInput);
      CHECK_THROWS_AS(run({a, 0.1, 1e-4, bad}, {p0, 1}, g1), InvalidInput);
      CHECK_THROWS_AS(run(good, {p0, 1}, {bad, 0.2}), InvalidInput);
      CHECK_THROWS_AS(old(good, {p0, 1}, {bad, 0.2}), InvalidInput);
    }
    for (const double bad : {0.5, -1.0, nan}) {
      CHECK_THROWS_AS(run(good, {p0, 1}, {3.85e8, bad}), InvalidInput);
      CHECK_THROWS_AS(run({a, 0.1, 1e-4, 25e9, bad}, {p0, 1}, g1), InvalidInput);
      CHECK_THROWS_AS(old(good, {p0, 1}, {3.85e8, bad}), InvalidInput);
    }
    CHECK_THROWS_AS(run(good, {p0, -1}, g1), InvalidInput);
  }
}

}  // namespace lining_in_ground_test
