// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <voussoir/theory/circular_opening.hpp>

#include "support/reference.hpp"

namespace circular_opening_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::relative;

namespace {

constexpr double pi = std::numbers::pi, a = 5, pressure = 662175;
constexpr ElasticGround g1{3.85e8, 0.2}, g3{5.27e8, 0.37};
/// Twelve digits are printed.
constexpr double printed = 6e-12;

}  // namespace

TEST_SUITE("theory/circular_opening") {
  TEST_CASE("wall displacement and hoop stress at crown and springing") {
    for (const char* k0 : {"0.5", "1.0", "1.5", "2.0"})
      for (const auto& [place, theta] : {std::pair("crown", pi / 2), std::pair("springing", 0.0)}) {
        const FarStress far{pressure, std::stod(k0)};
        const std::string id = std::string("C.kirsch.K") + k0;
        CAPTURE(id);
        CHECK(relative(kirsch(a, far, g1, a, theta).inward,
                       reference(id + ".G1." + place + ".u")) <= printed);
        CHECK(relative(kirsch(a, far, g3, a, theta).inward,
                       reference(id + ".G3." + place + ".u")) <= printed);
        CHECK(relative(kirsch(a, far, g1, a, theta).hoop_stress,
                       reference(id + "." + place + ".hoop")) <= printed);
      }
  }

  TEST_CASE("stresses at a point away from the wall and the axes") {
    const auto at = kirsch(a, {pressure, 0.5}, g1, 8, pi / 6);
    CHECK(relative(at.radial_stress, reference("C.kirsch.point.sr")) <= printed);
    CHECK(relative(at.hoop_stress, reference("C.kirsch.point.st")) <= printed);
    CHECK(relative(at.shear_stress, reference("C.kirsch.point.trt")) <= printed);
  }

  TEST_CASE("no traction on the wall, the far stress far away") {
    for (const double theta : {0.1, 1.0, 2.5}) {
      const FarStress far{pressure, 1.7};
      const auto wall = kirsch(a, far, g1, a, theta);
      CHECK(std::abs(wall.radial_stress) <= 1e-9 * pressure);
      CHECK(std::abs(wall.shear_stress) <= 1e-9 * pressure);
      const auto away = kirsch(a, far, g1, 1e6 * a, theta);  // (a / r)^2 = 1e-12
      CHECK(relative(away.radial_stress, far.mean() + far.deviator() * std::cos(2 * theta)) <=
            1e-11);
      CHECK(relative(away.shear_stress, -far.deviator() * std::sin(2 * theta)) <= 1e-11);
      CHECK(std::abs(away.inward) <= 1e-5 * wall.inward);
    }
  }

  TEST_CASE("displacements and stresses fit together by Hooke's law") {
    // Plane strain, induced parts, compression positive: eps_r = d u_in / dr by differences of
    // fourth order; (1e-3)^4 of the scale r is 1e-12, and rounding is 1e-13 / 1e-3.
    const FarStress far{pressure, 0.4};
    for (const double r : {5.5, 7.0, 20.0})
      for (const double theta : {0.3, 1.2}) {
        const auto u = [&](double radius) { return kirsch(a, far, g3, radius, theta).inward; };
        const auto at = [&](double angle) { return kirsch(a, far, g3, r, angle); };
        const double h = 1e-3 * r;
        const double radial =
            (8 * (u(r + h) - u(r - h)) - (u(r + 2 * h) - u(r - 2 * h))) / (12 * h);
        const double d = 1e-3;
        const auto v = [&](double angle) { return at(angle).tangential; };
        const double turning =
            (8 * (v(theta + d) - v(theta - d)) - (v(theta + 2 * d) - v(theta - 2 * d))) / (12 * d);
        const double hoop = (at(theta).inward - turning) / r;  // compression positive
        const double c = std::cos(2 * theta);
        const double sr = at(theta).radial_stress - (far.mean() + far.deviator() * c);
        const double st = at(theta).hoop_stress - (far.mean() - far.deviator() * c);
        const double nu = g3.poisson_ratio, two_g = 2 * g3.shear_modulus;
        CHECK(std::abs(radial - ((1 - nu) * sr - nu * st) / two_g) <= 1e-9 * pressure / two_g);
        CHECK(std::abs(hoop - ((1 - nu) * st - nu * sr) / two_g) <= 1e-9 * pressure / two_g);
      }
  }

  TEST_CASE("the crown moves more than the springing where K0 is below 1, and the reverse") {
    const auto more = [](double k0) {
      return kirsch(a, {pressure, k0}, g3, a, pi / 2).inward -
             kirsch(a, {pressure, k0}, g3, a, 0).inward;
    };
    CHECK(more(0.7) > 0);
    CHECK(more(1.3) < 0);
    // -(a / G) s (3 - 4 nu)
    CHECK(relative(more(0.7), a / 5.27e8 * 0.15 * pressure * (3 - 4 * 0.37)) <= 1e-13);
  }

  TEST_CASE("values out of range are refused by name") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
      CHECK_THROWS_AS(kirsch(bad, {pressure, 1}, g1, 8, 0), InvalidInput);
    for (const double bad : {4.9, nan})
      CHECK_THROWS_AS(kirsch(a, {pressure, 1}, g1, bad, 0), InvalidInput);
    CHECK_THROWS_AS(kirsch(a, {nan, 1}, g1, 8, 0), InvalidInput);
    CHECK_THROWS_AS(kirsch(a, {pressure, -0.1}, g1, 8, 0), InvalidInput);
    CHECK_THROWS_AS(kirsch(a, {pressure, 1}, g1, 8, nan), InvalidInput);
    CHECK_THROWS_WITH_AS(kirsch(a, {pressure, 1}, {3.85e8, 0.5}, 8, 0),
                         "Poisson's ratio nu = 0.5: must be > -1 and < 0.5", InvalidInput);
    CHECK_THROWS_WITH_AS(kirsch(a, {pressure, 1}, {-1, 0.2}, 8, 0),
                         "shear modulus G = -1: must be > 0 Pa", InvalidInput);
  }
}

}  // namespace circular_opening_test
