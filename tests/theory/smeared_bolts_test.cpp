// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <voussoir/theory/bolts_and_lining.hpp>
#include <voussoir/theory/smeared_bolts.hpp>

#include "support/reference.hpp"

namespace smeared_bolts_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::reference_table;
using voussoir_test::relative;

namespace {

constexpr double deg = std::numbers::pi / 180, a = 5, p0 = 662175, norm = p0 * 10;
constexpr double rigidity = 2e8 * 0.77;
constexpr double g1 = 3.85e8, g2 = 1.60416666666667e9, g3 = 5.27e8;
/// The values have 12 digits, some of their inputs 9 that stand for more (G2): see thin_lining.
constexpr double printed = 2e-11;
/// The tables have 10.
constexpr double tabled = 6e-10;

double modulus(const std::string& name) { return name == "G1" ? g1 : name == "G2" ? g2 : g3; }
double spacing(const std::string& configuration) {
  return std::stod(configuration.substr(0, configuration.find("deg"))) * deg;
}
double length(const std::string& configuration) {
  return configuration.find("7m") != std::string::npos ? 7 : 4;
}
SmearedBoltPattern pattern(const std::string& configuration) {
  return {a, length(configuration), spacing(configuration), rigidity, 1};
}

}  // namespace

TEST_SUITE("theory/smeared_bolts") {
  TEST_CASE("three patterns in four grounds, against finite elements") {
    for (const char* configuration : {"11.25deg_7m", "15deg_4m", "22.5deg_4m"})
      for (const auto& [name, nu] :
           {std::pair("G1", 0.2), {"G2", 0.2}, {"G3", 0.37}, {"G3_nu0.2", 0.2}}) {
        const std::string id = std::string("A.") + configuration + "." + name;
        CAPTURE(id);
        const ElasticGround ground{modulus(std::string(name).substr(0, 2)), nu};
        const SmearedBolts s(pattern(configuration), ground, p0);
        CHECK(relative(s.beta(), reference(id + ".beta")) <= printed);
        CHECK(relative(s.convergence(), reference(id + ".u_wall")) <= printed);
        CHECK(relative(s.convergence() / (p0 * a / (2 * ground.shear_modulus)),
                       reference(id + ".u_ratio")) <= printed);
        CHECK(relative(s.bolt_force(a) / norm, reference(id + ".F_wall_norm")) <= printed);
        CHECK(relative(s.bolt_force(a + length(configuration)) / norm,
                       reference(id + ".F_end_norm")) <= printed);
      }
  }

  TEST_CASE("profiles along the bolt, and the reading that is not in equilibrium") {
    for (const auto& row : reference_table("bolt-smeared-profiles")) {
      const std::string configuration = row.text("configuration");
      const ElasticGround ground{modulus(row.text("modulus").substr(0, 2)), row["nu"]};
      const double r = row["r_m"];
      CAPTURE(configuration);
      CAPTURE(r);
      const SmearedBolts s(pattern(configuration), ground, p0);
      CHECK(relative(s.inward(r), -row["u_m_outward"]) <= tabled);
      CHECK(relative(s.radial_strain(r), row["du_dr"]) <= tabled);
      CHECK(relative(s.bolt_force(r), row["F_N"]) <= tabled);
      const SmearedBolts loose(pattern(configuration), ground, p0, BoltHead::rock_only);
      CHECK(relative(loose.bolt_force(r) / norm, row["F_over_p0D_rock_only_bc"]) <= tabled);
    }
    for (const auto& row : reference_table("bolt-smeared-summary")) {
      const SmearedBolts s(pattern(row.text("configuration")),
                           {modulus(row.text("modulus").substr(0, 2)), row["nu"]}, p0);
      CHECK(relative(s.kappa(), row["kappa"]) <= tabled);
    }
  }

  TEST_CASE("weak bolts leave Lame's hole, and bear at most K_a s_mean / (2 G D s_l)") {
    const SmearedBoltPattern weak{a, 4, 15 * deg, 1e-12 * 2 * g1 * 15 * deg * a, 1};
    const SmearedBolts s(weak, {g1, 0.2}, p0);
    CHECK(relative(s.convergence(), reference("A.limit_beta0")) <= printed);
    // F / (p0 D) without the bolts' own effect on the ground: strain p0 / (2 G) times rigidity.
    CHECK(relative(s.radial_strain(a) * rigidity / norm, reference("A.limit_weak_F")) <= printed);
  }

  TEST_CASE("series and logarithm meet: no step in bolt stiffness") {
    // Both forms beside the switch; 1e-7 of stiffness changes u by 1e-9 or so.
    const auto at = [](double c_over_r) {
      const double beta = c_over_r * (1 - 0.2) / (1 - 2 * 0.2);
      return SmearedBolts({a, 4, 15 * deg, beta * 2 * g1 * 15 * deg * a, 1}, {g1, 0.2}, p0)
          .convergence();
    };
    CHECK(relative(at(0.02 * (1 + 1e-9)), at(0.02 * (1 - 1e-9))) <= 1e-9);
  }

  TEST_CASE("total stress and displacement are continuous at the end of the bolts") {
    const SmearedBoltPattern p{a, 4, 15 * deg, rigidity, 1};
    const ElasticGround ground{g3, 0.37};
    const SmearedBolts s(p, ground, p0);
    const double b = a + 4, lambda = ground.lame_constant(), m = ground.constrained_modulus();
    CHECK(relative(s.inward(b * (1 + 1e-13)), s.inward(b)) <= 1e-12);
    CHECK(s.bolt_force(b * (1 + 1e-12)) == 0);
    // Tension positive, u = -inward: inside M u' + lambda u / r + the bolts' a / r part, outside
    // -2 G u / r.
    const double bolts = s.bolt_force(b) / (p.wall_spacing() * 1) * a / b;
    const double inside = m * s.radial_strain(b) - lambda * s.inward(b) / b + bolts;
    CHECK(relative(inside, 2 * g3 * s.inward(b) / b) <= 1e-12);
    // At the wall it is what was taken off it.
    const double wall =
        m * s.radial_strain(a) - lambda * s.inward(a) / a + s.bolt_force(a) / p.wall_spacing();
    CHECK(relative(wall, p0) <= 1e-12);
  }

  TEST_CASE("bolts and lining together: the elastic interaction diagram") {
    for (const auto& row : reference_table("elastic-interaction")) {
      const std::string bolts = row.text("theta_b_deg");
      const ElasticGround ground{modulus(row.text("modulus")),
                                 row.text("modulus") == "G3" ? 0.37 : 0.2};
      CAPTURE(bolts);
      CAPTURE(row.text("t_m"));
      std::optional<SmearedBoltPattern> p;
      if (bolts != "none") p = SmearedBoltPattern{a, 4, row["theta_b_deg"] * deg, rigidity, 1};
      std::optional<ThinLining> lining;
      if (row["t_m"] > 0) lining = ThinLining{a, row["t_m"], 25e9, 1e9};
      const ElasticSupport s = elastic_support(a, p, lining, ground, p0);
      CHECK(relative(s.convergence, row["u_wall_m"]) <= tabled);
      CHECK(relative(s.thrust, row["N_lining_N_per_m"]) <= tabled);
      CHECK(relative(s.bolt_force / norm, row["F_wall_over_p0D"]) <= tabled);
      if (p && !lining)
        CHECK(relative(s.convergence, SmearedBolts(*p, ground, p0).convergence()) <= 1e-14);
      if (lining && !p)
        CHECK(relative(s.thrust, thin_lining(*lining, p0, ground.shear_modulus).thrust) <= 1e-14);
    }
    const auto s = elastic_support(a, SmearedBoltPattern{a, 4, 15 * deg, rigidity, 1},
                                   ThinLining{a, 0.1, 25e9, 1e9}, {g3, 0.37}, p0);
    CHECK(relative(s.convergence, reference("P.composite.u")) <= printed);
    CHECK(relative(s.thrust, reference("P.composite.N")) <= printed);
  }

  TEST_CASE("values out of range are refused, NaN too") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const SmearedBoltPattern good{a, 4, 15 * deg, rigidity, 1};
    const auto run = [](const SmearedBoltPattern& p, const ElasticGround& g, double release = p0) {
      return SmearedBolts(p, g, release).convergence();
    };
    for (const double bad : {0.0, -1.0, nan}) {
      CHECK_THROWS_AS(run({bad, 4, 0.2, rigidity, 1}, {g1, 0.2}), InvalidInput);
      CHECK_THROWS_AS(run({a, bad, 0.2, rigidity, 1}, {g1, 0.2}), InvalidInput);
      CHECK_THROWS_AS(run({a, 4, bad, rigidity, 1}, {g1, 0.2}), InvalidInput);
      CHECK_THROWS_AS(run({a, 4, 0.2, bad, 1}, {g1, 0.2}), InvalidInput);
      CHECK_THROWS_AS(run({a, 4, 0.2, rigidity, bad}, {g1, 0.2}), InvalidInput);
      CHECK_THROWS_AS(run(good, {bad, 0.2}), InvalidInput);
    }
    CHECK_THROWS_AS(run(good, {g1, 0.5}), InvalidInput);
    // A support pressure above p0.
    CHECK_THROWS_AS(run(good, {g1, 0.2}, p0 - 1.1 * p0), InvalidInput);
    CHECK_THROWS_AS(SmearedBolts(good, {g1, 0.2}, p0).bolt_force(4.9), InvalidInput);
    CHECK_THROWS_AS(elastic_support(6, good, {}, {g1, 0.2}, p0), InvalidInput);
    CHECK_THROWS_AS(elastic_support(6, {}, ThinLining{5, 0.1, 25e9}, {g1, 0.2}, p0), InvalidInput);
    CHECK_THROWS_AS(elastic_support(a, good, {}, {g1, 0.2}, 0), InvalidInput);
    CHECK_THROWS_AS(elastic_support(0, {}, {}, {g1, 0.2}, p0), InvalidInput);
  }
}

}  // namespace smeared_bolts_test
