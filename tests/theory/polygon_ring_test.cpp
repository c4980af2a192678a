// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <voussoir/theory/polygon_ring.hpp>
#include <voussoir/theory/thin_lining.hpp>

#include "support/reference.hpp"

namespace polygon_ring_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::reference_table;
using voussoir_test::relative;

namespace {

/// 12 digits are printed.
constexpr double printed = 6e-12;

}  // namespace

TEST_SUITE("theory/polygon_ring") {
  TEST_CASE("a ring squeezed by two loads: circle and polygons") {
    const SqueezedRing circle = squeezed_circle();
    CHECK(relative(circle.moment_at_load, reference("D.pinch.M_load")) <= printed);
    CHECK(relative(circle.moment_between, reference("D.pinch.M_perp")) <= printed);
    CHECK(relative(circle.shortening, reference("D.pinch.delta")) <= printed);
    CHECK(relative(circle.widening, reference("D.pinch.delta_perp")) <= printed);
    for (const auto& row : reference_table("polygon-ring-convergence")) {
      const int n = static_cast<int>(row["n"]);
      const std::string id = "D.pinch.polygon.n" + std::to_string(n);
      const SqueezedRing ring = squeezed_polygon(n);
      CHECK(relative(ring.shortening, reference(id + ".delta")) <= printed);
      CHECK(relative(ring.moment_at_load, reference(id + ".M_load")) <= printed);
      // Frame elements, nearly inextensible: good to about 1e-6 by their conditioning.
      CHECK(relative(ring.moment_between, row["fe_M_90deg_over_PR"]) <= 5e-6);
    }
  }

  TEST_CASE("moments of harmonic loads at the vertices") {
    for (const int n : {8, 16, 32, 64, 128})
      for (const int m : {2, 3, 4}) {
        if (n == 8 && m == 4) continue;  // not in the table
        CHECK(relative(polygon_moment_factor(n, m),
                       reference("D.harm.n" + std::to_string(n) + ".m" + std::to_string(m))) <=
              printed);
      }
    for (const auto& row : reference_table("polygon-moment-factor"))
      CHECK(relative(
                1 / polygon_moment_factor(static_cast<int>(row["n"]), static_cast<int>(row["m"])),
                row["correction_factor"]) <= 6e-10);
    // E I = 25e9 / 12 * 1e-3, p R^4 / (9 E I)
    CHECK(relative(harmonic_ring(2).displacement * 1e5 * std::pow(5, 4) / (25e9 / 12 * 1e-3),
                   reference("D.ring.harm2.w")) <= printed);
    CHECK(relative(harmonic_ring(3).moment, 1.0 / 8) <= 1e-15);
  }

  TEST_CASE("uniform pressure: at the vertices and along the chords") {
    const double p = 1e5, radius = 5;
    const PressedPolygon nodal = pressed_at_vertices(32), spread = pressed_on_chords(32);
    CHECK(relative(nodal.thrust * p * radius, reference("D.uniform.nodal.N")) <= printed);
    CHECK(relative(nodal.thrust * p * radius * radius / (25e9 * 0.1),
                   reference("D.uniform.nodal.u")) <= printed);
    CHECK(nodal.moment_at_vertex == reference("D.uniform.nodal.M"));
    CHECK(relative(nodal.thrust, ThinLining{5, 0.1, 25e9, 1e9, 32}.chord_factor()) <= 1e-15);
    CHECK(relative(spread.thrust * p * radius, reference("D.uniform.chord.N")) <= printed);
    CHECK(relative(spread.moment_at_vertex * p * radius * radius,
                   reference("D.uniform.chord.M_vertex")) <= printed);
    const double half = radius * std::sin(std::numbers::pi / 32), thrust = spread.thrust * p * 5;
    CHECK(relative(chord_moment(thrust, radius, 32, half), reference("D.uniform.chord.M_corr")) <=
          printed);
    CHECK(relative(chord_moment(1, radius, 32, half), reference("D.uniform.chord.e_vertex")) <=
          printed);
    CHECK(relative(chord_moment(thrust, radius, 32, 0),
                   spread.moment_at_middle * p * radius * radius) <= 1e-12);
    CHECK(relative(radius * (1 - std::cos(std::numbers::pi / 32)), reference("D.sagitta.n32")) <=
          1e-11);
  }

  TEST_CASE("values out of range are refused") {
    for (const int bad : {-4, 0, 3, 6, 10}) CHECK_THROWS_AS(squeezed_polygon(bad), InvalidInput);
    for (const int bad : {-1, 0, 2}) {
      CHECK_THROWS_AS(pressed_at_vertices(bad), InvalidInput);
      CHECK_THROWS_AS(pressed_on_chords(bad), InvalidInput);
      CHECK_THROWS_AS(chord_moment(1, 5, bad, 0), InvalidInput);
      CHECK_THROWS_AS(polygon_moment_factor(bad, 2), InvalidInput);
    }
    for (const int bad : {1, 0, 15}) CHECK_THROWS_AS(polygon_moment_factor(16, bad), InvalidInput);
    CHECK_THROWS_AS(harmonic_ring(1), InvalidInput);
    CHECK_THROWS_AS(chord_moment(1, 0, 16, 0), InvalidInput);
    CHECK_THROWS_AS(chord_moment(1, 5, 16, 3), InvalidInput);
  }
}

}  // namespace polygon_ring_test
