// SPDX-License-Identifier: MIT
// Edge stresses and shear of concrete sections against hand values, the principal stress in the
// middle of the section, and equilibrium of what fibres hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <voussoir/core/random.hpp>
#include <voussoir/design/section_check.hpp>

#include "support/concrete_sections.hpp"
#include "support/near.hpp"

namespace section_check_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;
using voussoir_test::near;
using voussoir_test::plain;
using voussoir_test::reinforced;

ConcreteSection elastic(double thickness, double strength) {
  ConcreteSection s = plain(thickness, strength);
  s.method = SectionMethod::elastic;
  return s;
}

}  // namespace

TEST_SUITE("design/section_check") {
  TEST_CASE("the tensile strength is that of table 3.1, or what is given") {
    // As printed, in MPa to one digit.
    for (const auto& row : {std::pair(12.0, 1.1), std::pair(25.0, 1.8), std::pair(30.0, 2.0),
                            std::pair(50.0, 2.9), std::pair(70.0, 3.2), std::pair(90.0, 3.5)}) {
      CAPTURE(row.first);
      const double found = 1e-6 * plain(0.2, 1e6 * row.first).characteristic_tension();
      CHECK(std::abs(found - row.second) < 0.051);
    }
    // 0.7 x 0.3 x 30^(2/3) = 2.02755; x 0.8 / 1.5.
    CHECK(plain(0.2, 30e6).design_tension() == near(1.081348e6).epsilon(1e-5));
    ConcreteSection given = plain(0.2, 30e6);
    given.tensile_strength = 1.5e6;
    given.tensile_factor = 1;
    CHECK(given.design_tension() == near(1e6).epsilon(1e-12));
  }

  TEST_CASE("edge stresses by hand") {
    // 20 cm: N = 1 MN is 5 MPa, M = 50 kN m is 50 / 6.667 = 7.5 MPa; f_cd = 17 MPa.
    const ConcreteSection s = elastic(0.2, 30e6);
    const auto of = [&](double thrust, double moment) {
      return edge_stress_utilisation(s, {thrust, moment});
    };
    CHECK(of(1e6, 30e3).value == near(9.5 / 17).epsilon(1e-12));
    CHECK(of(1e6, -30e3).mode == SectionMode::pressed_edge);
    CHECK(of(1e6, 50e3).value == near(2.5 / 1.081348).epsilon(1e-5));
    CHECK(of(1e6, -50e3).value == of(1e6, 50e3).value);
    CHECK(of(1e6, 50e3).mode == SectionMode::cracked_edge);
    CHECK(of(-1e5, 0).value == near(0.5 / 1.081348).epsilon(1e-5));
    CHECK(of(17e6 * 0.2, 0).value == near(1).epsilon(1e-12));
    CHECK(of(0, 0).value == 0);
    // The width makes no difference to stresses of forces in it.
    ConcreteSection wide = s;
    wide.width = 2.5;
    CHECK(edge_stress_utilisation(wide, {2.5e6, 2.5 * 50e3}).value ==
          near(of(1e6, 50e3).value).epsilon(1e-12));
  }

  TEST_CASE("every point of the rhombus has its strength, and a method is asked for") {
    ConcreteSection s = elastic(0.2, 30e6);
    const auto corners = SectionCheck(s).envelope();
    REQUIRE(corners.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
      for (const double part : {0.0, 0.3, 0.8}) {
        const SectionForces &a = corners[k], &b = corners[(k + 1) % 4];
        const SectionForces at{a.thrust + part * (b.thrust - a.thrust),
                               a.moment + part * (b.moment - a.moment)};
        CHECK(SectionCheck(s).utilisation(at).value == near(1).epsilon(1e-12));
      }
    const SectionForces load{1e6, 50e3};
    CHECK(SectionCheck(s).utilisation(load).mode == SectionMode::cracked_edge);
    s.method = SectionMethod::en1992;
    CHECK(SectionCheck(s).utilisation(load).value == SectionCapacity(s).utilisation(load).value);
    CHECK(SectionCheck(s).envelope().size() == SectionCapacity(s).envelope().size());
  }

  TEST_CASE("plain shear by hand: 12.6.3 on what is pressed") {
    // f_cd = 17, f_ctd = 1.081348 MPa; limit 17 - 2 sqrt(1.081348 x 18.081348) = 8.1562 MPa.
    const ConcreteSection s = plain(0.2, 30e6);
    // 16 cm pressed by 6.25 MPa: sqrt(1.169314 + 6.758425) = 2.815624; x 0.16 / 1.5.
    CHECK(shear_resistance(s, {1e6, 20e3}) == near(300.333e3).epsilon(1e-5));
    CHECK(shear_resistance(s, {1e6, -20e3}) == shear_resistance(s, {1e6, 20e3}));
    // 10 MPa: 0.921791 over; sqrt(1.169314 + 10.81348 - 0.849698) = 3.336630; x 0.2 / 1.5.
    CHECK(shear_resistance(s, {2e6, 0}) == near(444.884e3).epsilon(1e-5));
    CHECK(shear_resistance(s, {0, 0}) == near(1.081348e6 * 0.2 / 1.5).epsilon(1e-5));
    CHECK(shear_resistance(s, {17e6 * 0.2, 0}) < 1);  // nothing is left beside f_cd
    CHECK(shear_resistance(s, {1e6, 100e3}) == 0);    // the thrust is at the edge
    CHECK(shear_resistance(s, {-1e5, 0}) == 0);
    // An elastic section is whole and has some of its tension left.
    const ConcreteSection whole = elastic(0.2, 30e6);
    CHECK(shear_resistance(whole, {1e6, 20e3}) ==
          near(std::sqrt(1.169314 + 5 * 1.081348) * 0.2e6 / 1.5).epsilon(1e-5));
    CHECK(shear_resistance(whole, {-1e5, 0}) ==
          near(std::sqrt(1.169314 - 0.5 * 1.081348) * 0.2e6 / 1.5).epsilon(1e-5));
  }

  TEST_CASE("at the resistance of a section the principal tension is f_ctd") {
    const ConcreteSection s = plain(0.3, 25e6);
    for (const double eccentricity : {0.0, 0.02, 0.1})
      for (const double thrust : {1e5, 3e5, 6e5}) {
        const double depth = 0.3 - 2 * eccentricity, mean = thrust / depth,
                     shear = 1.5 * shear_resistance(s, {thrust, thrust * eccentricity}) / depth;
        const double least = mean / 2 - std::sqrt(mean * mean / 4 + shear * shear);
        CHECK(least == near(-s.design_tension()).epsilon(1e-9));
      }
  }

  TEST_CASE("bars by hand: 6.2.2 on the side in tension, and never less than without them") {
    const ConcreteSection s = reinforced();
    // d = 20 cm, rho = 0.45 %, k = 2: 0.12 x 2 x 13.5^(1/3) = 0.571464 MPa.
    CHECK(shear_resistance(s, {0, 50e3}) == near(114.293e3).epsilon(1e-5));
    // d = 21 cm, rho = 0.286 %, k = 1.97590: the least, 0.035 k^1.5 sqrt(30) = 0.532447 MPa.
    CHECK(shear_resistance(s, {0, -50e3}) == near(0.532447e6 * 0.21).epsilon(1e-5));
    // Thrust: 0.15 x 2 MPa; a pull of 0.4 MPa takes 0.06; at most 0.15 x 0.2 x 17.
    CHECK(barred_shear_resistance(s, {500e3, 50e3}) == near(174.293e3).epsilon(1e-5));
    CHECK(barred_shear_resistance(s, {-100e3, 50e3}) == near(102.293e3).epsilon(1e-5));
    CHECK(barred_shear_resistance(s, {3e6, 50e3}) == near(216.293e3).epsilon(1e-5));
    Random random(11, 1);
    ConcreteSection bare = s;
    bare.bars.clear();
    for (int k = 0; k < 200; ++k) {
      const SectionForces load{4e6 * random.uniform(), 2e5 * (2 * random.uniform() - 1)};
      CHECK(shear_resistance(s, load) >= shear_resistance(bare, load));
    }
    bare.bars = {{.area = 6e-4, .depth = 0.04}};  // pressed: not counted
    CHECK(shear_resistance(bare, {0, 50e3}) == 0);
    CHECK(shear_resistance(bare, {0, -50e3}) > 1e5);
  }

  TEST_CASE("with fibres the pressed part is in balance with what they pull") {
    ConcreteSection s = plain(0.2, 30e6);
    s.fibre_strength = 1.2e6;
    s.width = 1.5;
    const double pull = 0.8e6 * 1.5, h = 0.2;
    for (const SectionForces load : {SectionForces{6e5, 40e3}, {0, 12e3}, {2e6, 60e3}}) {
      // The depth at which moments about the middle balance, by halving.
      double low = 0, high = h;
      for (int k = 0; k < 100; ++k) {
        const double depth = 0.5 * (low + high), held = load.thrust + pull * (h - depth);
        const double moment = held * (h - depth) / 2 + pull * (h - depth) * depth / 2;
        (moment > load.moment ? low : high) = depth;
      }
      const double stress = (load.thrust + pull * (h - low)) / (s.width * low);
      const double tension = s.design_tension(), compression = s.design_strength();
      const double over =
          std::max(0.0, stress - compression + 2 * std::sqrt(tension * (tension + compression)));
      CHECK(shear_resistance(s, load) ==
            near(std::sqrt(tension * tension + stress * tension - over * over / 4) * s.width * low /
                 1.5)
                .epsilon(1e-9));
    }
    CHECK(shear_resistance(s, {0, 12e3}) > 0);  // of which plain concrete bears nothing
    CHECK(shear_resistance(s, {-pull * h, 0}) == 0);
  }

  TEST_CASE("utilisation in shear is how much all forces may grow together") {
    const ConcreteSection s = plain(0.2, 30e6);
    // (1.5 V / A)^2 f^2 = f_ctd^2 + sigma f_ctd f, solved for f.
    const double t = s.design_tension(), stress = 1e6 / 0.16, shear = 1.5 * 400e3 / 0.16;
    const double factor =
        (stress * t + t * std::sqrt(stress * stress + 4 * shear * shear)) / (2 * shear * shear);
    const SectionUtilisation found = shear_utilisation(s, {1e6, 20e3, -400e3});
    CHECK(found.value == near(1 / factor).epsilon(1e-9));
    CHECK(found.mode == SectionMode::shear);
    Random random(3, 1);
    for (const ConcreteSection& section : {s, reinforced(), elastic(0.15, 20e6)})
      for (int k = 0; k < 100; ++k) {
        SectionForces load{1e6 * random.uniform(), 4e4 * (2 * random.uniform() - 1)};
        load.shear = shear_resistance(section, load);
        if (load.shear > 1) CHECK(shear_utilisation(section, load).value == near(1).epsilon(1e-6));
      }
    CHECK(shear_utilisation(s, {1e6, 20e3, 0}).value == 0);
    CHECK(std::isinf(shear_utilisation(s, {1e6, 101e3, 1}).value));
    // It governs where it is more, not where the forces hardly shear.
    const SectionCheck check(s);
    CHECK(check.utilisation({1e6, 20e3, 400e3}).mode == SectionMode::shear);
    CHECK(check.utilisation({1e6, 20e3, 400e3}).value > 1);
    for (const double moment : {0.0, 10e3, 60e3})
      for (const double thrust : {1e6, 4e6})
        CHECK(check.utilisation({thrust, moment, 1}).mode != SectionMode::shear);
  }

  TEST_CASE("what an equilibrium leaves over is nothing, and the least tension is too much") {
    // Plain, 10 cm of 0.85 x 30 MPa over 1.5: a millionth of 1.7 MN.
    const SectionCheck check(plain(0.1, 30e6));
    for (const SectionForces& noise :
         {SectionForces{-1e-3, 0, 0}, {-1.6, 0.1, -1}, {0, -0.16, 0}, {0, 0, 1.6}})
      CHECK(check.utilisation(noise).value == 0);
    CHECK(std::isinf(check.utilisation({-1.8, 0, 0}).value));
    CHECK(std::isinf(check.utilisation({0, 0.18, 0}).value));
  }

  TEST_CASE("what has no strength in tension is refused by name") {
    ConcreteSection s = plain(0.2, 30e6);
    s.tensile_strength = 0;
    CHECK_THROWS_WITH_AS(SectionCheck{s}, doctest::Contains("tensile strength of concrete"),
                         InvalidInput);
    s.tensile_strength = {};
    s.tensile_factor = 1.2;
    CHECK_THROWS_WITH_AS(SectionCheck{s}, doctest::Contains("factor of the tensile strength"),
                         InvalidInput);
  }
}

}  // namespace section_check_test
