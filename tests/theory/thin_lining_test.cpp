// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <voussoir/theory/thin_lining.hpp>

#include "support/reference.hpp"

namespace thin_lining_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::reference_table;
using voussoir_test::relative;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double radius = 5, lining_modulus = 25e9, ground_pressure = 662175;
constexpr double g1 = 3.85e8, g2 = 1.60416666666667e9, g3 = 5.27e8;  // the paper's Table 3 [Pa]

/// Of the table's values: 12 digits are printed, and g2 carries 15.
constexpr double printed = 2e-11;

}  // namespace

TEST_SUITE("theory/thin_lining") {
  TEST_CASE("thrust of eq. (13), against the four equations it was eliminated from") {
    const double moduli[] = {g1, g2, g3};
    for (int g = 0; g < 3; ++g)
      for (const auto& [stiffness, text] :
           {std::pair(1e6, "1e+06"), std::pair(1e8, "1e+08"), std::pair(1e9, "1e+09")}) {
        const std::string id = std::string("B.N.t0.1.KL") + text + ".G" + std::to_string(g + 1);
        CAPTURE(id);
        const auto response =
            thin_lining({radius, 0.1, lining_modulus, stiffness}, ground_pressure, moduli[g]);
        CHECK(relative(response.thrust, reference(id)) <= printed);
      }
  }

  TEST_CASE("thrust, pressure and the three movements of a table from 1 MPa/m to a glued ring") {
    // The table prints 10 digits: half a unit of the last is 5e-10 at most.
    for (const auto& row : reference_table("lining-eq13")) {
      CAPTURE(row.text("t_m"));
      CAPTURE(row.text("K_L_Pa_per_m"));
      const double modulus = row.text("modulus") == "G2" ? g2 : row["G_Pa"];
      const auto r = thin_lining({radius, row["t_m"], lining_modulus, row["K_L_Pa_per_m"]},
                                 ground_pressure, modulus);
      CHECK(relative(r.thrust, row["N_N_per_m"]) <= 6e-10);
      CHECK(relative(r.pressure, row["dp_Pa"]) <= 6e-10);
      CHECK(relative(r.convergence, row["u_ground_m"]) <= 6e-10);
      CHECK(relative(r.lining_shortening, row["u_lining_m"]) <= 6e-10);
    }
  }

  TEST_CASE("the parts fit together: N = a dp, and ground and support move alike") {
    for (const double thickness : {0.05, 0.1, 0.5})
      for (const double stiffness : {1e7, 1e9}) {
        const auto r =
            thin_lining({radius, thickness, lining_modulus, stiffness}, ground_pressure, g3);
        CHECK(relative(r.thrust, radius * r.pressure) <= 1e-14);
        // u_ground = a (p0 - dp) / (2 G); p0 - dp loses digits where dp is near p0, two at the
        // most.
        CHECK(relative(r.convergence, radius * (ground_pressure - r.pressure) / (2 * g3)) <= 1e-13);
        CHECK(relative(r.lining_shortening,
                       radius * radius * r.pressure / (lining_modulus * thickness)) <= 1e-14);
        CHECK(relative(r.convergence - r.lining_shortening, r.pressure / stiffness) <= 1e-12);
      }
  }

  TEST_CASE("eq. (13) as printed") {
    // (B.6) times a: the fractions cleared by 2 G E_L t K_L / a.
    const double t = 0.3, k = 4e8, stiff = lining_modulus * t;
    const double printed_thrust = ground_pressure * radius * stiff * k /
                                  (stiff * k + 2 * g1 * radius * k + 2 * g1 * stiff / radius);
    const auto r = thin_lining({radius, t, lining_modulus, k}, ground_pressure, g1);
    CHECK(relative(r.thrust, printed_thrust) <= 1e-14);
  }

  TEST_CASE("limits: a glued ring, a rigid ring, soft springs, hard ground") {
    const ThinLining glued{.radius = radius, .thickness = 0.1, .elastic_modulus = lining_modulus};
    CHECK(relative(thin_lining(glued, ground_pressure, g3).thrust,
                   reference("B.limit_rigid_interface")) <= printed);
    // Rigid and glued: it takes all of the pressure, and nothing moves.
    const auto rigid = thin_lining({radius, infinity, lining_modulus}, ground_pressure, g3);
    CHECK(rigid.thrust == ground_pressure * radius);
    CHECK(rigid.convergence == 0);
    CHECK(relative(thin_lining({radius, 1e9, lining_modulus, 1e30}, ground_pressure, g3).thrust,
                   reference("B.limit_stiff_all")) <= printed);
    // K_L -> 0: the wall comes in as far as without lining and the springs push back, N = K_L a u.
    const double soft = 1e-3, free_convergence = ground_pressure * radius / (2 * g3);
    const auto loose = thin_lining({radius, 0.1, lining_modulus, soft}, ground_pressure, g3);
    // Next order: K_L times the other flexibilities, 1e-3 * 1.5e-8.
    CHECK(relative(loose.thrust, soft * radius * free_convergence) <= 2e-11);
    CHECK(relative(loose.convergence, free_convergence) <= 2e-11);
    CHECK(thin_lining(glued, ground_pressure, infinity).thrust == 0);
    CHECK(thin_lining(glued, 0, g3).thrust == 0);
  }

  TEST_CASE("a ring of chords carries a little more, second order in their angle") {
    double before = infinity;
    ThinLining lining{radius, 0.1, lining_modulus, 1e9};
    const double circle = thin_lining(lining, ground_pressure, g3).thrust;
    for (const int chords : {16, 32, 64, 128}) {
      lining.chords = chords;
      const double thrust = thin_lining(lining, ground_pressure, g3).thrust;
      CHECK(relative(thrust, reference("B.polygon_N.n" + std::to_string(chords))) <= printed);
      const double more = thrust / circle - 1;
      if (before < infinity) CHECK(std::abs(before / more - 4) < 0.02);  // the next term: phi^2
      before = more;
    }
  }

  TEST_CASE("the ring is the thin limit of Lame's thick one") {
    // u / u_thin = (t / a) (a^2 + r^2) / (a^2 - r^2), r = a - t, outside pressure, nu_L = 0.
    for (const auto& [t, id] : {std::pair(0.1, "B.thick_over_thin.t0.1.nuL0.0"),
                                std::pair(0.5, "B.thick_over_thin.t0.5.nuL0.0")}) {
      const double inner = radius - t;
      const auto r = thin_lining({radius, t, lining_modulus, 1e9}, ground_pressure, g3);
      const double thick = r.pressure * radius / lining_modulus *
                           (radius * radius + inner * inner) / (radius * radius - inner * inner);
      CHECK(relative(thick / r.lining_shortening, reference(id)) <= printed);
    }
  }

  TEST_CASE("values out of range are refused, NaN too") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto run = [](const ThinLining& lining, double pressure = ground_pressure,
                        double g = g3) { return thin_lining(lining, pressure, g).thrust; };
    for (const double bad : {nan, 0.0, -1.0}) {
      CHECK_THROWS_AS(run({bad, 0.1, 25e9, 1e9}), InvalidInput);
      CHECK_THROWS_AS(run({5, bad, 25e9, 1e9}), InvalidInput);
      CHECK_THROWS_AS(run({5, 0.1, bad, 1e9}), InvalidInput);
      CHECK_THROWS_AS(run({5, 0.1, 25e9, bad}), InvalidInput);
      CHECK_THROWS_AS(run({5, 0.1, 25e9, 1e9}, ground_pressure, bad), InvalidInput);
    }
    CHECK_THROWS_AS(run({infinity, 0.1, 25e9, 1e9}), InvalidInput);
    CHECK_THROWS_AS(run({5, 0.1, 25e9, 1e9}, nan), InvalidInput);
    for (const int bad : {-3, 1, 2}) CHECK_THROWS_AS(run({5, 0.1, 25e9, 1e9, bad}), InvalidInput);
  }
}

}  // namespace thin_lining_test
