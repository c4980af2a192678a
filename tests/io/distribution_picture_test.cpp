// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/io/distribution_picture.hpp>

#include "io/xml_check.hpp"

namespace distribution_picture_test {

using namespace voussoir;

namespace {

std::size_t counted(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

/// What stands between two words of a document.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  REQUIRE(begin != std::string::npos);
  return text.substr(begin, text.find(to, begin) - begin);
}

DistributionPanel three_values() {
  return {.name = "crown convergence",
          .unit = "mm",
          .values = {3, 1, 2},
          .realisations = 4,
          .mean_between = Interval{1.5, 2.5},
          .limit = 4,
          .note = "1 realisation has no value"};
}

}  // namespace

TEST_SUITE("io/distribution_picture") {
  TEST_CASE("every value is a dot, and the steps lack what has no value") {
    DistributionPicture picture;
    picture.header = {"Case <A> & B", {"Stable."}, {}};
    picture.panels = {three_values()};
    const std::string svg = draw_distribution_picture(picture);
    CHECK(xml_fault(svg).empty());
    CHECK(counted(between(svg, "id=\"crown convergence\"", "</g>"), "<circle") == 3);
    // The last dot at three of four: a quarter of the height below the line of 100 %.
    const std::string panel = between(svg, "id=\"crown convergence\"", "</g>");
    const auto height_of_line = [&](const std::string& label) {
      const std::size_t text = panel.find(">" + label + "<");
      REQUIRE(text != std::string::npos);
      const std::size_t y = panel.rfind("y=\"", text);
      return std::stod(panel.substr(y + 3)) - 4.5;
    };
    const std::size_t last = panel.rfind("cy=\"");
    const double dot = std::stod(panel.substr(last + 4));
    CHECK(std::abs(dot - height_of_line("75")) <= 0.02);  // rounded to a hundredth of a pixel
    CHECK(std::abs(height_of_line("50") - 0.5 * (height_of_line("0") + height_of_line("100"))) <=
          0.02);
    CHECK(panel.find("limit 4.00 mm") != std::string::npos);
    CHECK(panel.find("1 realisation has no value") != std::string::npos);
  }

  TEST_CASE("a limit far away is said, not drawn: it would press the values into a corner") {
    DistributionPicture picture;
    picture.panels = {three_values()};
    picture.panels[0].limit = 100;
    const std::string svg = draw_distribution_picture(picture);
    CHECK(svg.find("limit 100 mm, far to the right") != std::string::npos);
    picture.panels[0].limit = -100;
    CHECK(draw_distribution_picture(picture).find("far to the left") != std::string::npos);
  }

  TEST_CASE("one value, equal ones and none are pictures too; what is no number is refused") {
    DistributionPicture picture;
    CHECK_THROWS_AS((void)draw_distribution_picture(picture), InvalidInput);
    for (const std::vector<double>& values :
         {std::vector<double>{}, {0}, {2, 2, 2}, std::vector<double>(300, 1.0)}) {
      picture.panels = {{.name = "force", .unit = "kN", .values = values, .realisations = 300}};
      CHECK(xml_fault(draw_distribution_picture(picture)).empty());
    }
    picture.panels[0].values = {1, std::numeric_limits<double>::quiet_NaN()};
    CHECK_THROWS_AS((void)draw_distribution_picture(picture), InvalidInput);
  }

  TEST_CASE("what decides: a bar for each key that has a correlation") {
    DistributionPicture picture;
    picture.panels = {three_values()};
    const std::string without = draw_distribution_picture(picture);
    picture.influences = {{"crown convergence",
                           {"joint.friction", "stress.K0", "joint.kn"},
                           {-0.8, 0.1, std::numeric_limits<double>::quiet_NaN()},
                           0.3}};
    const std::string svg = draw_distribution_picture(picture);
    CHECK(xml_fault(svg).empty());
    const std::string panel = between(svg, "id=\"what decides: crown convergence\"", "</g>");
    CHECK(counted(panel, "<rect") == 3);  // what chance may do, and two bars
    CHECK(panel.find("joint.kn: all the same") != std::string::npos);
    CHECK(without.find("rank correlation") == std::string::npos);
    CHECK(svg.find("rank correlation") != std::string::npos);
  }
}

}  // namespace distribution_picture_test
