// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/theory/equivalent_moduli.hpp>
#include <voussoir/theory/initial_friction.hpp>

#include "support/dense_algebra.hpp"
#include "support/reference.hpp"

namespace equivalent_moduli_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::reference_table;
using voussoir_test::relative;

namespace {

constexpr double deg = std::numbers::pi / 180;
constexpr JointStiffness joints{5e9, 5e8};
/// 12 digits are printed.
constexpr double printed = 6e-12;

const double equal = 6 * 0.77 / std::numbers::pi;  ///< spacing of each of the paper's sets
const std::vector<PersistentSet> paper{{75 * deg, equal}, {25 * deg, equal}, {-25 * deg, equal}};

}  // namespace

TEST_SUITE("theory/equivalent_moduli") {
  TEST_CASE("one set: Goodman, and the paper's estimates G1 and G2") {
    const auto rigid = goodman_moduli(joints, 0.77);
    CHECK(relative(rigid.youngs_modulus, reference("E.goodman.E")) <= printed);
    CHECK(relative(rigid.shear_modulus, reference("E.goodman.G1")) <= printed);
    const double g2 = shear_modulus_from(rigid.youngs_modulus, 0.2);
    CHECK(relative(g2, reference("E.goodman.G2")) <= printed);
    CHECK(relative(g2 / rigid.shear_modulus, reference("E.goodman.ratio")) <= printed);
    const auto soft = goodman_moduli(joints, 0.77, 50e9, 20e9);
    CHECK(relative(soft.youngs_modulus, reference("E.goodman.E_int")) <= printed);
    CHECK(relative(soft.shear_modulus, reference("E.goodman.G_int")) <= printed);
  }

  TEST_CASE("one-dimensional compression read as in the paper") {
    const double strain = reference("E.oed.e1"), lateral = reference("E.oed.s3");
    const auto m = oedometer_moduli(662175, lateral, strain);
    CHECK(relative(m.shear_modulus, reference("E.oed.G")) <= printed);
    CHECK(relative(m.poisson_ratio, reference("E.oed.nu")) <= printed);
    CHECK(relative(m.constrained_modulus, reference("E.oed.M")) <= printed);
  }

  TEST_CASE("several sets: an explicit lattice of blocks gives the same stiffness") {
    const auto s = joint_compliance({{75 * deg, 1.1}, {-25 * deg, 0.7}}, joints);
    const Eigen::Matrix3d c = voussoir_test::inverse(s);
    const char* order[3] = {"1", "2", "3"};
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        CHECK(relative(c(i, j), reference(std::string("E.amadei.two.C") + order[i] + order[j])) <=
              1e-11);
    const auto one = joint_compliance({{0, 0.77}}, joints);
    CHECK(relative(1 / one(1, 1), reference("E.amadei.single.E")) <= printed);
    CHECK(relative(1 / one(2, 2), reference("E.amadei.single.G")) <= printed);
  }

  TEST_CASE("the paper's three sets pressed vertically and horizontally") {
    CHECK(relative(equal, reference("E.paper.set_spacing")) <= printed);
    const auto s = joint_compliance(paper, joints);
    for (const auto& [direction, along] : {std::pair("vertical", CompressedAlong::vertical),
                                           std::pair("horizontal", CompressedAlong::horizontal)})
      for (const auto& [name, shear] : {std::pair("tau0", ShearCondition::free),
                                        std::pair("gam0", ShearCondition::prevented)}) {
        const std::string id = std::string("E.paper.oed.") + direction + "." + name + ".";
        const auto m = oedometer_of(s, along, shear);
        CHECK(relative(m.shear_modulus, reference(id + "G")) <= 1e-11);
        CHECK(relative(m.poisson_ratio, reference(id + "nu")) <= 1e-11);
      }
    for (const auto& row : reference_table("equivalent-moduli")) {
      if (row.text("compression") == "any") continue;
      const auto m =
          oedometer_of(s,
                       row.text("compression") == "vertical" ? CompressedAlong::vertical
                                                             : CompressedAlong::horizontal,
                       row.text("shear_condition") == "tau=0" ? ShearCondition::free
                                                              : ShearCondition::prevented);
      CHECK(relative(m.constrained_modulus, row["M_Pa"]) <= 6e-10);
    }
  }

  TEST_CASE("joints of all orientations, and the sum over 720 directions") {
    const auto m = isotropic_joint_moduli(joints, 0.77);
    CHECK(relative(m.shear_modulus, reference("E.iso.G")) <= printed);
    CHECK(relative(m.bulk_modulus, reference("E.iso.K2")) <= printed);
    CHECK(relative(m.poisson_ratio, reference("E.iso.nu")) <= printed);
    std::vector<PersistentSet> all;
    for (int k = 0; k < 720; ++k)  // frequency (2 / pi) 720 / s = 1 / 0.77
      all.push_back({k * 0.25 * deg, 720 * 0.77 * 2 / std::numbers::pi});
    const auto o = oedometer_of(joint_compliance(all, joints), CompressedAlong::vertical,
                                ShearCondition::free);
    CHECK(relative(o.shear_modulus, m.shear_modulus) <= 1e-11);
    CHECK(relative(o.poisson_ratio, m.poisson_ratio) <= 1e-11);
  }

  // Compliance by a sum over directions spread evenly on the sphere, in place of the moments 1/5
  // and 1/15: midpoints of 200 x 400 cells of equal area, an error of about (1 / 200)^2.
  TEST_CASE("joints of all orientations in 3-D, and the sum over a sphere") {
    const JointStiffness soft{5e9, 5e9 / 3};
    double along = 0, across = 0;  // strain along z and x from one stress along z, P32 = 1
    for (int i = 0; i < 200; ++i)
      for (int j = 0; j < 400; ++j) {
        const double z = (i + 0.5) / 200, phi = (j + 0.5) * std::numbers::pi / 200;
        const double x = std::sqrt(1 - z * z) * std::cos(phi);
        along += (z * z * z * z / soft.normal + z * z * (1 - z * z) / soft.shear) / 80000;
        across += x * x * z * z * (1 / soft.normal - 1 / soft.shear) / 80000;
      }
    const double nu = -across / along;
    const auto m = isotropic_joint_oedometer(soft, 2.5);
    CHECK(relative(m.poisson_ratio, nu) <= 1e-4);
    CHECK(relative(m.shear_modulus, 1 / (2.5 * along) / (2 * (1 + nu))) <= 1e-4);
    CHECK(relative(m.constrained_modulus, 2 * m.shear_modulus * (1 - m.poisson_ratio) /
                                              (1 - 2 * m.poisson_ratio)) <= 1e-12);
    CHECK_THROWS_AS(isotropic_joint_oedometer(soft, 0), InvalidInput);
    CHECK_THROWS_AS(isotropic_joint_oedometer({1, 2}, 1), InvalidInput);
  }

  TEST_CASE("scanlines and RQD") {
    for (const auto& [id, direction] : {std::pair("horizontal", 0.0), std::pair("45deg", 45.0),
                                        std::pair("vertical", 90.0), std::pair("135deg", 135.0)})
      CHECK(relative(1 / scanline_frequency(paper, direction * deg),
                     reference(std::string("E.scanline.") + id)) <= printed);
    CHECK(relative(rock_quality_designation(1 / 0.77), reference("E.scanline.freq")) <= printed);
    CHECK(rock_quality_designation(0) == 100);
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan}) {
      CHECK_THROWS_AS(goodman_moduli({bad, 1}, 1), InvalidInput);
      CHECK_THROWS_AS(goodman_moduli({1, bad}, 1), InvalidInput);
      CHECK_THROWS_AS(goodman_moduli(joints, bad), InvalidInput);
      CHECK_THROWS_AS(goodman_moduli(joints, 1, bad, 1), InvalidInput);
      CHECK_THROWS_AS(goodman_moduli(joints, 1, 1, bad), InvalidInput);
      CHECK_THROWS_AS(joint_compliance({{0, bad}}, joints), InvalidInput);
      CHECK_THROWS_AS(isotropic_joint_moduli(joints, bad), InvalidInput);
      CHECK_THROWS_AS(scanline_frequency({{0, bad}}, 0), InvalidInput);
      CHECK_THROWS_AS(shear_modulus_from(bad, 0.2), InvalidInput);
      CHECK_THROWS_AS(oedometer_moduli(bad, 0, 1), InvalidInput);
      CHECK_THROWS_AS(oedometer_moduli(1, 0, bad), InvalidInput);
    }
    CHECK_THROWS_AS(shear_modulus_from(1, 0.5), InvalidInput);
    CHECK_THROWS_AS(oedometer_moduli(1, 1.1, 1), InvalidInput);
    CHECK_THROWS_AS(joint_compliance({}, joints), InvalidInput);
    CHECK_THROWS_AS(joint_compliance({{nan, 1}}, joints), InvalidInput);
    // One set: strain along the joints is impossible.
    CHECK_THROWS_AS(oedometer_of(joint_compliance({{0.3, 1}}, joints), CompressedAlong::vertical,
                                 ShearCondition::free),
                    InvalidInput);
    CHECK_THROWS_AS(rock_quality_designation(-1), InvalidInput);
    CHECK_THROWS_AS(rock_quality_designation(1, 0), InvalidInput);
  }
}

TEST_SUITE("theory/initial_friction") {
  TEST_CASE("joints of two dips, and the worst") {
    for (const auto& row : reference_table("initial-friction"))
      CHECK(relative(initial_friction(row["K0"], row["dip_deg"] * deg) / deg,
                     row["required_friction_deg"]) <= 6e-10);
    for (const char* k0 : {"0.25", "0.5", "0.75", "1.0", "1.5", "2.0", "3.0"}) {
      const double worst = largest_initial_friction(std::stod(k0));
      CHECK(relative(worst / deg, reference(std::string("E.minfric.K") + k0 + ".max")) <= printed);
      // The worst of all dips: a maximum is flat, 0.01 degrees away 1e-7 is lost.
      double seen = 0;
      for (int d = 0; d <= 9000; ++d)
        seen = std::max(seen, initial_friction(std::stod(k0), 0.01 * d * deg));
      CHECK(std::abs(seen - worst) <= 1e-7);
    }
    for (const char* k0 : {"0.5", "1.5"})
      for (const char* dip : {"25", "75"})
        CHECK(relative(initial_friction(std::stod(k0), std::stod(dip) * deg) / deg,
                       reference(std::string("E.minfric.K") + k0 + ".dip" + dip)) <= printed);
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {-0.1, nan}) {
      CHECK_THROWS_AS(initial_friction(bad, 0.5), InvalidInput);
      CHECK_THROWS_AS(largest_initial_friction(bad), InvalidInput);
    }
    CHECK_THROWS_AS(initial_friction(1, nan), InvalidInput);
  }
}

}  // namespace equivalent_moduli_test
