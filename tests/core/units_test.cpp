// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <voussoir/core/units.hpp>

namespace units_test {

using namespace voussoir;

namespace {

std::string message_of(const std::string& text, const Dimension& expected) {
  try {
    (void)parse_quantity(text, expected);
  } catch (const UnitError& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("core/units") {
  TEST_CASE("quantities read to the double nearest their SI value") {
    struct Case {
      const char* text;
      Dimension dimension;
      double value;
    };
    // == is meant: decimal prefixes are applied with one rounding, so 7 cm is the literal 0.07.
    const Case cases[] = {
        {"5 GPa/m", dimension::stiffness_per_area, 5e9},
        {"0.5 GPa/m", dimension::stiffness_per_area, 0.5e9},
        {"5e9 Pa/m", dimension::stiffness_per_area, 5e9},
        {"2700 kg/m^3", dimension::density, 2700},
        {"2700 kg/m3", dimension::density, 2700},
        {"2.7 t/m\u00b3", dimension::density, 2700},
        {"1 /m^2", dimension::intensity, 1},
        {"1/m^2", dimension::intensity, 1},
        {"3 1/m2", dimension::intensity, 3},
        {"4 m^-2", dimension::intensity, 4},
        {"500 kN", dimension::force, 5e5},
        {"0.2 GN/m", dimension::stiffness, 2e8},
        {"10 cm", dimension::length, 0.1},
        {"7 cm", dimension::length, 0.07},
        {"28 mm", dimension::length, 0.028},
        {"-3 mm", dimension::length, -0.003},
        {"+3 mm", dimension::length, 0.003},
        {"3 \u00b5m", dimension::length, 3e-6},
        {"  4m\t", dimension::length, 4},
        {"4\u00a0m", dimension::length, 4},
        {"40 %", dimension::number, 0.4},
        {"662 kPa", dimension::pressure, 662e3},
        {"25 GPa", dimension::pressure, 25e9},
        {"1 bar", dimension::pressure, 1e5},
        {"9.81 m/s^2", dimension::acceleration, 9.81},
        {"120 kN m", dimension::moment, 120e3},
        {"120 kN*m", dimension::moment, 120e3},
        {"120 kN\u00b7m", dimension::moment, 120e3},
        {"2 N/m/m", dimension::pressure, 2},
        {"740 cm^2", dimension::area, 0.074},
        {"90 min", dimension::time, 5400},
        {"2 h", dimension::time, 7200},
        {"30 d", dimension::time, 2592000},
        {"1 a", dimension::time, 31557600},  // Julian: 365.25 days
        {"3.6 m/h", dimension::velocity, 0.001},
        {"20 GPa d/m", dimension::viscosity_per_area, 1.728e15},
        {"20 GPa*d/m", dimension::viscosity_per_area, 1.728e15},
        {"0.6 rad", dimension::angle, 0.6},
        {"180 deg", dimension::angle, std::numbers::pi},
        {"90 \u00b0", dimension::angle, std::numbers::pi / 2},
    };
    for (const Case& c : cases) {
      CAPTURE(c.text);
      double value = std::numeric_limits<double>::quiet_NaN();
      CHECK_NOTHROW(value = parse_quantity(c.text, c.dimension));
      CHECK(value == c.value);
    }
  }

  TEST_CASE("a text that is no such quantity says what was found and what is accepted") {
    struct Case {
      const char* text;
      Dimension dimension;
      const char* found;
    };
    const Case cases[] = {
        {"", dimension::length, "is empty"},
        {"   ", dimension::length, "is empty"},
        {"m", dimension::length, "does not start with a number"},
        {"\u22123 mm", dimension::length, "does not start with a number"},  // typographic minus
        {"+-3 mm", dimension::length, "does not start with a number"},
        {"5", dimension::stiffness_per_area, "has no unit"},
        {"5e9", dimension::stiffness_per_area, "has no unit"},
        {"0.4", dimension::number, "has no unit"},
        {"1,5 m", dimension::length, "the decimal sign is a point"},
        {"5 kpa", dimension::pressure, "unknown unit `kpa`, did you mean `kPa`?"},
        {"5 GPA/m", dimension::stiffness_per_area, "unknown unit `GPA`, did you mean `GPa`?"},
        {"5 degrees", dimension::angle, "did you mean `deg`?"},
        {"5 furlong", dimension::length, "unknown unit `furlong`"},
        {"5 mdeg", dimension::angle, "unknown unit `mdeg`"},  // prefixes in use only
        {"5 m foo", dimension::length, "unknown unit `foo`"},
        {"5 m; drop", dimension::length, "continues with `; drop`"},
        {"5 m/", dimension::length, "ends where a unit is expected"},
        {"5 N/m s", dimension::stiffness, "reads two ways"},
        {"5 m^", dimension::length, "no whole number behind `^`"},
        {"5 m^0", dimension::length, "exponent outside 1 to 9"},
        {"5 m^12", dimension::length, "exponent outside 1 to 9"},
        {"5 m^1.5", dimension::length, "continues with `.5`"},
        {"nan m", dimension::length, "is not a number"},
        {"inf m", dimension::length, "is not finite"},
        {"inf", dimension::length, "is not finite"},
        {"1e400 m", dimension::length, "outside the range of numbers"},
        {"1e308 GPa", dimension::pressure, "outside the range of numbers"},
        {"5 GPa", dimension::stiffness_per_area, "is a stress, not a stiffness per area"},
        {"35 deg", dimension::number, "is an angle, not a fraction"},
        {"40 %", dimension::angle, "is a fraction, not an angle"},
        {"3 m^5", dimension::length, "is a quantity in m^5, not a length"},
        {"864 cm^4", dimension::area, "is a second moment, not an area"},
        // 26 kN/m^3 over 9.80665 m/s^2, the standard gravity
        {"26 kN/m^3", dimension::density, "is a unit weight: density 2651 kg/m^3"},
        {"0.027 MN/m3", dimension::density, "is a unit weight: density 2753 kg/m^3"},
        {"5 GPa/m", dimension::density, "is a stiffness per area, not a density"},
        // By definition: 0.3048 m, 0.0254 m, 400 gon on a circle, 0.45359237 kg.
        {"10 ft", dimension::length, "is 3.048 m"},
        {"2 in", dimension::length, "is 0.0508 m"},
        {"50gon", dimension::angle, "is 45 deg"},
        {"3000 psi", dimension::pressure, "is 20684.3 kPa"},
        {"165 lb/ft^3", dimension::density, "has the unit `lb`, which is 0.4535924 kg"},
        {"3 m/ft", dimension::number, "has the unit `ft`, which is 0.3048 m"},
    };
    for (const Case& c : cases) {
      CAPTURE(c.text);
      const std::string message = message_of(c.text, c.dimension);
      CAPTURE(message);
      CHECK(contains(message, c.found));
      CHECK(contains(message, "; accepted: " + accepted_examples(c.dimension)));
    }
  }

  TEST_CASE("infinity is a value only where it is allowed") {
    CHECK(parse_quantity("inf", dimension::length, Infinity::allowed) == HUGE_VAL);
    CHECK(parse_quantity("inf m", dimension::length, Infinity::allowed) == HUGE_VAL);
    CHECK(parse_quantity("4 m", dimension::length, Infinity::allowed) == 4);
    CHECK_THROWS_AS((void)parse_quantity("inf", dimension::length), UnitError);
    CHECK_THROWS_AS((void)parse_quantity("nan m", dimension::length, Infinity::allowed), UnitError);
    CHECK_THROWS_AS((void)parse_quantity("inf deg", dimension::length, Infinity::allowed),
                    UnitError);
  }

  TEST_CASE("messages carry no control characters and no more than a line") {
    const std::string bell = message_of("5 \a\x1b[31m", dimension::length);
    CHECK(bell.find('\a') == std::string::npos);
    CHECK(bell.find('\x1b') == std::string::npos);
    CHECK(message_of("5 " + std::string(100000, 'x'), dimension::length).size() < 500);
  }

  TEST_CASE("the decimal sign is a point under a locale that writes a comma") {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    // Not every machine has one of these; the test then says nothing.
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
    CHECK(parse_quantity("1.5 m", dimension::length) == 1.5);
    CHECK(format_quantity(1.5, dimension::length) == "1.5 m");
    std::setlocale(LC_ALL, before.c_str());
  }

  TEST_CASE("values are echoed in the unit an engineer expects") {
    CHECK(format_quantity(5e9, dimension::stiffness_per_area) == "5 GPa/m");
    CHECK(format_quantity(0.5e9, dimension::stiffness_per_area) == "500 MPa/m");
    CHECK(format_quantity(35 * std::numbers::pi / 180, dimension::angle) == "35 deg");
    CHECK(format_quantity(662175, dimension::pressure) == "662.175 kPa");
    CHECK(format_quantity(0.028, dimension::length) == "28 mm");
    CHECK(format_quantity(-70, dimension::length) == "-70 m");
    CHECK(format_quantity(0, dimension::length) == "0 m");
    CHECK(format_quantity(2700, dimension::density) == "2700 kg/m^3");
    CHECK(format_quantity(1, dimension::intensity) == "1 /m^2");
    CHECK(format_quantity(0.4, dimension::number) == "40 %");
    CHECK(format_quantity(0.5, dimension::time) == "500 ms");
    CHECK(format_quantity(5400, dimension::time) == "1.5 h");
    CHECK(format_quantity(2592000, dimension::time) == "30 d");
    CHECK(format_quantity(1.728e15, dimension::viscosity_per_area) == "20 GPa*d/m");
    CHECK(format_quantity(3, {0, 5, 0, 0}) == "3 m^5");
    CHECK(format_quantity(864e-8, dimension::second_moment) == "864 cm^4");
    CHECK(format_quantity(144e-6, dimension::section_modulus) == "144 cm^3");
    CHECK(format_quantity(HUGE_VAL, dimension::length) == "inf");
    CHECK(format_quantity(std::nan(""), dimension::length) == "nan");
  }

  TEST_CASE("what is echoed reads back, for every dimension that has a name") {
    for (const detail::DimensionWords& words : detail::dimension_words) {
      for (const double value : {1e-4, 0.35, 1.0, 999.9, 1e6, 1.5e11, -2.5}) {
        const std::string text = format_quantity(value, words.dimension);
        CAPTURE(text);
        // 6 digits are written: at most half a unit of the sixth, 5e-6 of the value.
        CHECK(std::abs(parse_quantity(text, words.dimension) - value) <= 5e-6 * std::abs(value));
      }
    }
  }
}

}  // namespace units_test
