// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <numbers>
#include <voussoir/core/literals.hpp>
#include <voussoir/core/units.hpp>

namespace literals_test {

using namespace voussoir;
using namespace voussoir::literals;

namespace {

double text(const char* quantity, const Dimension& dimension) {
  return parse_quantity(quantity, dimension);
}

}  // namespace

TEST_SUITE("core/literals") {
  TEST_CASE("a literal is the double that the same text gives in an input file") {
    CHECK(75_deg == text("75 deg", dimension::angle));
    CHECK(0.1_deg == text("0.1 deg", dimension::angle));
    CHECK(0.6_rad == text("0.6 rad", dimension::angle));
    CHECK(2.5_percent == text("2.5 %", dimension::number));
    CHECK(28_mm == text("28 mm", dimension::length));
    CHECK(10_cm == text("10 cm", dimension::length));
    CHECK(0.3_m == text("0.3 m", dimension::length));
    CHECK(1.2_km == text("1.2 km", dimension::length));
    CHECK(0.074_m2 == text("0.074 m^2", dimension::area));
    CHECK(0.7_per_m2 == text("0.7 /m^2", dimension::intensity));
    CHECK(20_ms == text("20 ms", dimension::time));
    CHECK(0.5_s == text("0.5 s", dimension::time));
    CHECK(9.81_m_per_s2 == text("9.81 m/s^2", dimension::acceleration));
    CHECK(2700_kg_per_m3 == text("2700 kg/m^3", dimension::density));
    CHECK(2.7_t_per_m3 == text("2.7 t/m^3", dimension::density));
    CHECK(500_kN == text("500 kN", dimension::force));
    CHECK(0.5_MN == text("0.5 MN", dimension::force));
    CHECK(12_N == text("12 N", dimension::force));
    CHECK(0.2_GN_per_m == text("0.2 GN/m", dimension::stiffness));
    CHECK(200_MN_per_m == text("200 MN/m", dimension::stiffness));
    CHECK(30_kN_per_m == text("30 kN/m", dimension::stiffness));
    CHECK(3_N_per_m == text("3 N/m", dimension::stiffness));
    CHECK(100_Pa == text("100 Pa", dimension::pressure));
    CHECK(662_kPa == text("662 kPa", dimension::pressure));
    CHECK(1.2_MPa == text("1.2 MPa", dimension::pressure));
    CHECK(25_GPa == text("25 GPa", dimension::pressure));
    CHECK(5_GPa_per_m == text("5 GPa/m", dimension::stiffness_per_area));
    CHECK(0.5_GPa_per_m == text("0.5 GPa/m", dimension::stiffness_per_area));
    CHECK(5000_MPa_per_m == text("5000 MPa/m", dimension::stiffness_per_area));
    CHECK(7_kPa_per_m == text("7 kPa/m", dimension::stiffness_per_area));
    CHECK(9_Pa_per_m == text("9 Pa/m", dimension::stiffness_per_area));
  }

  TEST_CASE("right angles are exact, and literals are constants") {
    static_assert(90_deg == 0.5 * std::numbers::pi && 180_deg == std::numbers::pi);
    static_assert(1_m == 1 && 2_per_m == 2 && 3_per_m3 == 3 && 4_m == 4);
    CHECK(-5_deg == -(5_deg));
  }
}

}  // namespace literals_test
