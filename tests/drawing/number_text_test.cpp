// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/round_ticks.hpp>

#include "support/near.hpp"

namespace number_text_test {

using namespace voussoir;

TEST_SUITE("drawing/number_text") {
  TEST_CASE("the shortest text reads back to the same bits") {
    CHECK(shortest_text(0.1) == "0.1");
    for (const double value : {0.1, 1.0 / 3, 6.02e23, 5e-324, -1.7976931348623157e308}) {
      CHECK(std::strtod(significant_text(value, 17).c_str(), nullptr) == value);
      CHECK(std::strtod(shortest_text(value).c_str(), nullptr) == value);
    }
    CHECK(shortest_text(std::copysign(std::numeric_limits<double>::quiet_NaN(), -1.0)) == "nan");
    CHECK(shortest_text(-std::numeric_limits<double>::infinity()) == "-inf");
  }

  TEST_CASE("no number is minus zero, none loses its sign otherwise") {
    CHECK(fixed_text(-0.004, 2) == "0.00");
    CHECK(fixed_text(-0.006, 2) == "-0.01");
    CHECK(trimmed_text(-0.0, 2) == "0");
    CHECK(trimmed_text(12.50, 2) == "12.5");
    CHECK(trimmed_text(100, 2) == "100");  // zeros before the point stay
    CHECK(trimmed_text(100, 0) == "100");
  }

  TEST_CASE("numbers for readers keep three digits and never use an exponent") {
    CHECK(readable_text(812.4) == "812");
    CHECK(readable_text(12.44) == "12.4");
    CHECK(readable_text(0.05312) == "0.0531");
    CHECK(readable_text(1234567) == "1234567");
    CHECK(readable_text(0) == "0");
    CHECK(readable_text(1e308).size() == 309);
    CHECK(printed_text(-6.96) == "\u22126.96");
  }

  TEST_CASE("a German locale changes nothing") {
    // Where the machine has no such locale the test says nothing, and nothing can go wrong either.
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
      if (std::setlocale(LC_ALL, name) != nullptr) break;
    }
    CHECK(shortest_text(1.5) == "1.5");
    CHECK(fixed_text(1234.5, 1) == "1234.5");
    std::setlocale(LC_ALL, before.c_str());
  }
}

TEST_SUITE("io/round_ticks") {
  TEST_CASE("steps are 1, 2 or 5 times a power of ten") {
    CHECK(round_up_125(0.3) == voussoir_test::near(0.5));
    CHECK(round_up_125(2.0000000000000004) == 2);
    CHECK(round_up_125(6) == 10);
    CHECK(round_up_125(0) == 1);
    CHECK(round_down_125(6) == 5);
    CHECK(round_down_125(0.99) == voussoir_test::near(0.5));
    CHECK(round_down_125(4.9) == 2);
    CHECK(round_down_125(1.9) == 1);
    CHECK(round_down_125(100) == voussoir_test::near(100));
  }

  TEST_CASE("ticks cover the range and are labelled without superfluous digits") {
    const RoundTicks ticks = round_ticks(0, 0.31, 5);  // 0.31 / 5 = 0.062 -> 0.1
    REQUIRE(ticks.values.size() == 4);
    CHECK(ticks.label(ticks.values[3]) == "0.3");  // 3 * 0.1 is 0.30000000000000004
    CHECK(round_ticks(1, 1, 5).values.empty());
    CHECK(round_ticks(0, std::numeric_limits<double>::infinity(), 5).values.empty());
  }

  TEST_CASE("contour levels enclose the values") {
    struct Range {
      double low, high;
    };
    for (const Range range :
         {Range{0.05, 0.3}, {0.02, 3.0}, {-4, 4}, {0, 0}, {0.7, 0.7}, {-2, -2}}) {
      const std::vector<double> levels = contour_levels(range.low, range.high, 10);
      CAPTURE(range.low);
      REQUIRE(levels.size() >= 2);
      CHECK(levels.size() <= 14);
      CHECK(levels.front() <= range.low + 1e-12);
      CHECK(levels.back() >= range.high - 1e-12);
      for (std::size_t i = 0; i + 1 < levels.size(); ++i) CHECK(levels[i] < levels[i + 1]);
    }
    CHECK(contour_levels(0.02, 3, 10) ==  // more than a factor of 15: the series 1, 2, 5
          std::vector<double>{0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5});
  }
}

}  // namespace number_text_test
