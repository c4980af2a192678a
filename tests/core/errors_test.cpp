// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <voussoir/core/errors.hpp>

namespace errors_test {

using namespace voussoir;

TEST_SUITE("core/errors") {
  TEST_CASE("a message is its pieces one after the other, numbers as message_number writes them") {
    const std::string words = "of set";
    CHECK(message({"joint ", std::size_t{7}, " ", words, " ", -3, ": ", 5e9, " Pa/m, ", -2e-8,
                   " m"}) == "joint 7 of set -3: 5e9 Pa/m, -2e-8 m");
    CHECK(message({}).empty());
  }

  TEST_CASE("a number in a message keeps its first digits, however small or large it is") {
    CHECK(message_number(-2e-8) == "-2e-8");
    CHECK(message_number(5e9) == "5e9");
    CHECK(message_number(2.5e-300) == "2.5e-300");
    CHECK(message_number(-1.5e120) == "-1.5e120");
    CHECK(message_number(35) == "35");
    CHECK(message_number(0.1) == "0.1");
    CHECK(message_number(100000) == "100000");
    CHECK(message_number(1234567) == "1.23457e6");
    CHECK(message_number(0.1234567, 3) == "0.123");
    CHECK(message_number(0.0) == "0");
    CHECK(message_number(-0.0) == "0");
    const double infinite = std::numeric_limits<double>::infinity();
    CHECK(message_number(std::numeric_limits<double>::quiet_NaN()) == "nan");
    CHECK(message_number(-std::numeric_limits<double>::quiet_NaN()) == "nan");
    CHECK(message_number(infinite) == "inf");
    CHECK(message_number(-infinite) == "-inf");
  }

  TEST_CASE("a refusal names what, its value and the rule") {
    CHECK_THROWS_WITH_AS(require(false, "cohesion", -2e-8, ">= 0 Pa"),
                         "cohesion = -2e-8: must be >= 0 Pa", InvalidInput);
    CHECK_NOTHROW(require(true, "cohesion", 1, ">= 0 Pa"));
    CHECK_THROWS_WITH_AS(require_plausible(5, "E", "Pa", 1e6, "GPa", 1e9),
                         "E = 5 Pa: must be >= 1e6 Pa; did you mean 5 GPa = 5e9 Pa?", InvalidInput);
    CHECK_NOTHROW(require_plausible(1e6, "E", "Pa", 1e6, "GPa", 1e9));
    CHECK_THROWS_WITH_AS(require_angle(false, "phi", 35, "< pi/2 rad"),
                         "phi = 35 rad (2005.35 deg): must be < pi/2 rad; did you mean 35 deg = "
                         "0.610865 rad?",
                         InvalidInput);
    // Not every bad angle is one in degrees.
    CHECK_THROWS_WITH_AS(require_angle(false, "phi", -0.5, ">= 0 rad"),
                         "phi = -0.5 rad (-28.6479 deg): must be >= 0 rad", InvalidInput);
  }
}

}  // namespace errors_test
