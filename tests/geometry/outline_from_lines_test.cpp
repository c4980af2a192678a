// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/outline_from_lines.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

#include "../support/near.hpp"

namespace outline_from_lines_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

std::string refusal(const std::vector<LooseLine>& lines, double tolerance = 1e-3) {
  try {
    (void)outline_from_lines(lines, tolerance);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Floor, walls and an arch of 20 chords, 6 m wide, each on its own, ends up to `off` [m] apart.
std::vector<LooseLine> horseshoe(double off = 0) {
  LooseLine arch;
  for (int k = 0; k <= 20; ++k) {
    const double angle = std::numbers::pi * k / 20;
    arch.points.emplace_back(3 * std::cos(angle), 3 + 3 * std::sin(angle));
  }
  return {arch,
          {{{-3, 0}, {3, off}}},
          {{{3, 0}, arch.points.front() + Vec2(off, 0)}},
          {{{-3 - off, 0}, arch.points.back()}}};
}

std::vector<LooseLine> square(const Vec2& corner, double side) {
  const Vec2 x(side, 0), y(0, side);
  return {{{corner, corner + x}},
          {{corner + x + y, corner + x}},
          {{corner + x + y, corner + y, corner}}};
}

std::vector<LooseLine> together(std::vector<LooseLine> a, const std::vector<LooseLine>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

TEST_SUITE("geometry/outline_from_lines") {
  TEST_CASE("lines and arcs in any order and sense give one outline, bit for bit") {
    for (const double off : {0.0, 5e-4}) {
      const std::vector<LooseLine> lines = horseshoe(off);
      const std::vector<Vec2> expected = outline_from_lines(lines);
      CHECK(expected.size() == 23);  // the ends of the arch and the floor, 19 between
      CHECK(expected[0].y() == 0);
      CHECK((expected[0] - Vec2(-3, 0)).norm() <= 1.001 * off);
      CHECK((expected[1] - Vec2(3, 0)).norm() <= 1.001 * off);
      const double arch = 0.5 * 20 * 9 * std::sin(std::numbers::pi / 20);
      CHECK(SimplePolygon(expected).area() == near(18 + arch).epsilon(off == 0 ? 1e-14 : 1e-3));
      std::mt19937 random(3);
      std::vector<LooseLine> mixed = lines;
      for (int k = 0; k < 200; ++k) {
        std::shuffle(mixed.begin(), mixed.end(), random);
        for (LooseLine& line : mixed)
          if (random() % 2 == 0) std::reverse(line.points.begin(), line.points.end());
        CHECK(outline_from_lines(mixed) == expected);
      }
    }
  }

  TEST_CASE("a closed line is the outline, repeated points and its sense aside") {
    const std::vector<Vec2> expected{{0, 0}, {2, 0}, {2, 1}, {0, 1}};
    for (const LooseLine& line : {
             LooseLine{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, true},
             LooseLine{{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}}, true},
             LooseLine{{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}}, false},
             LooseLine{{{2, 1}, {2, 1}, {2, 0}, {0, 0}, {0, 0.0005}, {0, 1}, {2, 1}}, false},
             LooseLine{{{0, 1}, {2, 1}, {2, 0}, {0, 0}}, true},
         })
      CHECK(outline_from_lines({line}) == expected);
    CHECK(outline_from_lines({{{{5, 5}, {5, 5.0001}}}, {expected, true}}) == expected);
    CHECK(outline_from_lines({{{{5, 5}}}, {{}}, {expected, true}}) == expected);
  }

  TEST_CASE("two lines may make an outline; far from (0, 0) its sense is still found") {
    const Vec2 far(1e8, -3e8);
    std::vector<LooseLine> lines{{{far, far + Vec2(1, 0), far + Vec2(1, 1)}},
                                 {{far, far + Vec2(0, 1), far + Vec2(1, 1)}}};
    const std::vector<Vec2> expected{far, far + Vec2(1, 0), far + Vec2(1, 1), far + Vec2(0, 1)};
    CHECK(outline_from_lines(lines) == expected);
    std::reverse(lines.begin(), lines.end());
    CHECK(outline_from_lines(lines) == expected);
  }

  TEST_CASE("ends meet within the tolerance, and not beyond") {
    CHECK(refusal(horseshoe(0.0009)) == "accepted");
    CHECK(contains(refusal(horseshoe(0.0011)), "outline: it is open"));
    CHECK(refusal(horseshoe(0.0011), 0.002) == "accepted");
    // In any direction, and across the edges of any grid of squares.
    for (double x = -0.01; x < 0.01; x += 0.00013)
      for (const Vec2& way : {Vec2(1, 1), Vec2(-1, 1), Vec2(1, -1), Vec2(-1, -1)}) {
        std::vector<LooseLine> lines = square({x, 2 * x}, 1);
        lines[0].points[0] += 6e-4 * way;
        CHECK(refusal(lines) == "accepted");
        lines[0].points[0] += 2e-4 * way;
        CHECK(contains(refusal(lines), "it is open"));
      }
  }

  TEST_CASE("an open outline names both loose ends and the gap") {
    std::vector<LooseLine> lines = square({1, 2}, 3);
    lines[1].points[0] = {4, 4.75};
    CHECK(refusal(lines) ==
          "outline: it is open: a gap of 0.25 m from (4, 4.75) to (4, 5); accepted: ends that meet "
          "within 0.001 m, or a larger tolerance");
    lines[0].points[0] = {1.5, 2};
    const std::string two = refusal(lines);
    CHECK(contains(two, "a gap of 0.5 m from (1.5, 2) to (1, 2)"));
    CHECK(contains(two, ", a gap of 0.25 m from (4, 4.75) to (4, 5); accepted"));
    std::vector<LooseLine> many;
    for (int k = 0; k < 5; ++k) many.push_back({{{0.0, 1.0 * k}, {0.25, 1.0 * k}}});
    CHECK(contains(refusal(many), "from (0, 2) to (0.25, 2) and 4 more loose ends; accepted"));
    CHECK(contains(refusal({{{{0, 0}, {1, 0}}}}), "a gap of 1 m from (0, 0) to (1, 0)"));
  }

  TEST_CASE("three ends at one point are a branch, and so is a line that is drawn twice") {
    const std::vector<LooseLine> lines = square({0, 0}, 1);
    const std::string branch = refusal(together(lines, {{{{1, 1}, {2, 2}}}}));
    CHECK(contains(branch, "outline: three ends or more meet at (1, 1): a branch, or a line"));
    CHECK(contains(branch, "accepted: one closed outline"));
    CHECK(contains(refusal(together(lines, lines)), "three ends or more meet at"));
    CHECK(contains(refusal(together(lines, {lines[1]})), "a line that is drawn twice"));
  }

  TEST_CASE("several closed outlines are refused, with where they lie") {
    const std::vector<LooseLine> lines = square({0, 0}, 1);
    CHECK(refusal(together(lines, square({5, 6}, 2))) ==
          "outline: there are 2 closed outlines: from (0, 0) to (1, 1), from (5, 6) to (7, 8); "
          "accepted: one, on a layer of its own");
    std::vector<LooseLine> five = lines;
    for (int k = 1; k < 5; ++k)
      five.push_back({{{9.0 * k, 0}, {9.0 * k + 1, 0}, {9.0 * k, 1}}, true});
    CHECK(contains(refusal(five), "there are 5 closed outlines"));
    CHECK(contains(refusal(five), " and 2 more; accepted"));
  }

  TEST_CASE("nothing, nothing but dots, no area, and what is no number are refused") {
    CHECK(refusal({}) == "outline: there are no lines");
    CHECK(refusal({{{{1, 1}, {1, 1.0005}}}}) ==
          "outline: there are no lines longer than the tolerance, 0.001 m");
    CHECK(contains(refusal({{{{0, 0}, {1, 0}}, true}}),
                   "outline: the closed line at (0, 0) has no area"));
    CHECK(contains(refusal({{{{0, 0}, {1, 0}, {2, 0}}, true}}), "has no area"));
    CHECK(contains(refusal({{{{0, 0}, {1, std::numeric_limits<double>::quiet_NaN()}}}}),
                   "outline: line 0 is not finite"));
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
      CHECK(contains(refusal(square({0, 0}, 1), bad), "outline: tolerance = "));
  }
}

}  // namespace outline_from_lines_test
