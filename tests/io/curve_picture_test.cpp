// SPDX-License-Identifier: MIT
// Curves over a pair of axes: where points come to lie, and what is refused.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <voussoir/io/curve_picture.hpp>

#include "support/near.hpp"

namespace curve_picture_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

/// The centres of the dots of a picture, in their order.
std::vector<Vec2> dots(const std::string& svg) {
  std::vector<Vec2> found;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    const auto number = [&](const char* name) {
      return std::stod(svg.substr(svg.find(name, at) + std::string(name).size()));
    };
    found.emplace_back(number("cx=\""), number("cy=\""));
  }
  return found;
}

CurvePicture picture(std::vector<Vec2> points) {
  return {.header = {.title = "Ground & reaction", .lines = {}, .key_numbers = {}},
          .across = "crown [mm]",
          .up = "traction [%]",
          .curves = {{.name = "rock", .points = std::move(points)}}};
}

}  // namespace

TEST_SUITE("io/curve_picture") {
  TEST_CASE("dots lie as their points do, x to the right and y up") {
    const std::string svg = draw_curve_picture(picture({{0, 100}, {1, 50}, {3, 0}}));
    const std::vector<Vec2> at = dots(svg);
    REQUIRE(at.size() >= 3);
    // A third of the way across, half of the way down; written to a tenth of a pixel.
    CHECK(at[1].x() - at[0].x() == near((at[2].x() - at[0].x()) / 3).epsilon(1e-3));
    CHECK(at[1].y() - at[0].y() == near((at[2].y() - at[0].y()) / 2).epsilon(1e-3));
    CHECK(at[2].y() > at[0].y());
    CHECK(svg.find("Ground &amp; reaction") != std::string::npos);
    for (const char* word : {"crown [mm]", "traction [%]", ">rock<", ">100<", ">40<"})
      CHECK(svg.find(word) != std::string::npos);
  }

  TEST_CASE("a curve does not move when another that lies within its span is drawn too") {
    CurvePicture one = picture({{0, 100}, {4, 0}}), two = one;
    two.curves.push_back({.name = "inside", .points = {{1, 20}, {2, 30}}, .is_marked = false});
    const auto a = dots(draw_curve_picture(one)), b = dots(draw_curve_picture(two));
    REQUIRE(b.size() == a.size());
    CHECK(a[0] == b[0]);
    CHECK(a[1] == b[1]);
  }

  TEST_CASE("what cannot be drawn is refused; a single point can") {
    CHECK_THROWS_AS((void)draw_curve_picture(picture({})), InvalidInput);
    CHECK_THROWS_AS(
        (void)draw_curve_picture(picture({{0, std::numeric_limits<double>::quiet_NaN()}})),
        InvalidInput);
    CHECK(dots(draw_curve_picture(picture({{0, 0}}))).size() >= 1);
  }
}

}  // namespace curve_picture_test
