// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/section_part.hpp>

#include "support/near.hpp"

namespace section_part_test {

using namespace voussoir;
using voussoir_test::near;
using Kind = SectionFault::Kind;

namespace {

SectionPart above(double y) { return {.bottom = y}; }
SectionPart below(double y) { return {.top = y}; }

/// Area of a part by counting the midpoints of a fine grid.
double counted_area(const SimplePolygon& section, const SectionPart& part, double size) {
  constexpr int steps = 700;
  const double cell = size / steps;
  int inside = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const Vec2 p((i + 0.5) * cell - 0.5 * size, (j + 0.5) * cell - 0.5 * size);
      inside += p.x() > part.left && p.x() < part.right && p.y() > part.bottom &&
                        p.y() < part.top && section.contains(p)
                    ? 1
                    : 0;
    }
  return inside * cell * cell;
}

std::optional<SectionFault> fault_of(const SimplePolygon& section,
                                     const std::vector<SectionPart>& parts) {
  std::vector<ExcavatedPart> excavated;
  for (const SectionPart& part : parts) {
    const auto outline = outline_of_part(section, part);
    // Beside the section: what is in no part of it.
    excavated.push_back({outline.value_or(SimplePolygon({{90, 0}, {91, 0}, {90, 1}}))});
  }
  return fault_of_parts(section, excavated);
}
std::optional<Kind> fault(const SimplePolygon& section, const std::vector<SectionPart>& parts) {
  const auto found = fault_of(section, parts);
  return found ? std::optional(found->kind) : std::nullopt;
}

}  // namespace

TEST_SUITE("tunnel/section_part") {
  TEST_CASE("parts of sections have the areas that counting says, and add up to the section") {
    Random random(11, 0);
    for (const SimplePolygon& section :
         {circular_opening(10, 36), horseshoe_opening(8, 4, 36),
          SimplePolygon({{-4, -3}, {4, -3}, {4, 1}, {2.5, 3}, {-2.5, 3}, {-4, 1}})}) {
      for (int k = 0; k < 8; ++k) {
        const double y = -2.5 + 4 * random.uniform(), x = -2 + 4 * random.uniform();
        CAPTURE(y);
        CAPTURE(x);
        const SectionPart parts[] = {above(y), {.right = x, .top = y}, {.left = x, .top = y}};
        double sum = 0;
        for (const SectionPart& part : parts) {
          const auto outline = outline_of_part(section, part);
          REQUIRE(outline);
          sum += outline->area();
          // A cell of the grid along the outline may count either way: 700 cells on 11 m.
          CHECK(std::abs(outline->area() - counted_area(section, part, 11)) <
                outline->perimeter() * 11 / 700);
        }
        CHECK(std::abs(sum - section.area()) < 1e-12 * section.area());
      }
    }
  }

  TEST_CASE("a line through corners leaves no repeated corners") {
    const SimplePolygon horseshoe = horseshoe_opening(8, 4, 36);
    const auto heading = outline_of_part(horseshoe, above(0));  // along the springing
    REQUIRE(heading);
    CHECK(heading->size() == 19);  // 18 chords of the half circle and the floor
    CHECK_FALSE(outline_of_part(horseshoe, above(4)));
    CHECK_FALSE(outline_of_part(horseshoe, below(-5)));
  }

  TEST_CASE("a section that falls into pieces is refused") {
    const SimplePolygon pillar(
        {{-4, -2}, {4, -2}, {4, 3}, {2, 3}, {2, 0}, {-2, 0}, {-2, 3}, {-4, 3}});
    CHECK_THROWS_AS(outline_of_part(pillar, above(1)), InvalidInput);
    CHECK(outline_of_part(pillar, below(-1)));
  }

  TEST_CASE("orders of excavation: heading, bench, drifts, and what is wrong with them") {
    const SimplePolygon section = horseshoe_opening(8, 4, 36);
    const SectionPart all, middle{.bottom = -2, .top = 0};
    const SectionPart left{.right = -1}, right{.left = 1}, core{.left = -1, .right = 1};
    CHECK_FALSE(fault(section, {all}));
    CHECK_FALSE(fault(section, {above(-1), below(-1)}));
    CHECK_FALSE(fault(section, {above(0), middle, below(-2)}));
    CHECK_FALSE(fault(section, {left, right, core}));
    CHECK_FALSE(fault(section, {above(-1), {.right = 0, .top = -1}, {.left = 0, .top = -1}}));
    CHECK(fault(section, {below(-1), above(-1)}) == Kind::undermined);
    CHECK(fault(section, {above(0), below(-2), middle}) == Kind::undermined);
    CHECK(fault(section, {above(-1), below(-0.5)}) == Kind::twice);
    CHECK(fault(section, {all, all}) == Kind::twice);
    CHECK(fault(section, {above(-1)}) == Kind::left_over);
    CHECK(fault(section, {left, right}) == Kind::left_over);
    CHECK(fault(section, {above(10)}) == Kind::empty);
    const auto twice = fault_of(section, {above(-1), below(-0.5)});
    REQUIRE(twice);
    CHECK(twice->part == 1);
    CHECK(twice->where.bottom == -1);
    CHECK(twice->where.top == -0.5);
    CHECK(twice->where.right - twice->where.left == near(8).epsilon(1e-9));
  }

  TEST_CASE("drifts that are drawn, and the rest of the section") {
    const SimplePolygon section = horseshoe_opening(8, 4, 36);
    // A side drift whose inner wall leans over, and a pilot that touches no wall.
    const SimplePolygon drift({{-4, -4}, {-1.5, -4}, {-0.5, -1}, {-1.5, 1}, {-3.8, 1}, {-4, 0}}),
        pilot = circular_opening(3, 24);
    const ExcavatedPart rest{section, true};
    CHECK_FALSE(fault_of_parts(section, {{drift, false, true}, rest}));
    CHECK_FALSE(fault_of_parts(section, {{pilot, false, true}, rest}));
    const auto hanging = fault_of_parts(section, {{drift}, rest});
    REQUIRE(hanging);
    CHECK(hanging->kind == Kind::undermined);
    CHECK(hanging->part == 0);
    const auto all_again = fault_of_parts(section, {{pilot, false, true}, {section}});
    REQUIRE(all_again);
    CHECK(all_again->kind == Kind::twice);
    CHECK(all_again->where.top == near(1.5).epsilon(0.03));  // seen midway between its corners
    CHECK(fault_of_parts(section, {{section}, rest})->kind == Kind::empty);
    CHECK(fault_of_parts(section, {{pilot, false, true}})->kind == Kind::left_over);
  }

  TEST_CASE("faults of random parts are those that counting points finds") {
    Random random(5, 0);
    const SimplePolygon section = horseshoe_opening(8, 4, 24);
    int found[4] = {};
    for (int n = 0; n < 60; ++n) {
      // Convex parts about random places, clipped to the section by being small.
      std::vector<ExcavatedPart> parts;
      for (int k = 0; k < 3; ++k) {
        const double x = -2.5 + 5 * random.uniform(), y = -2.8 + 4.5 * random.uniform(),
                     r = 0.2 + 0.9 * random.uniform();
        parts.push_back(
            {SimplePolygon({{x - r, y}, {x, y - r}, {x + 0.8 * r, y}, {x, y + r}}), false, true});
      }
      bool overlap = false;
      for (int i = 0; i < 200; ++i)
        for (int j = 0; j < 200; ++j) {
          const Vec2 p(-4 + 8 * (i + 0.5) / 200, -4 + 8 * (j + 0.5) / 200);
          int in = 0;
          for (const ExcavatedPart& part : parts) in += part.outline.contains(p) ? 1 : 0;
          overlap = overlap || in > 1;
        }
      const auto fault = fault_of_parts(section, parts);
      REQUIRE(fault);  // they never take all of it
      ++found[static_cast<int>(fault->kind)];
      if (overlap) CHECK(fault->kind == Kind::twice);
      // Less than a cell of the grid in common may escape the points.
      if (fault->kind == Kind::twice && !overlap)
        CHECK((fault->where.right - fault->where.left) * (fault->where.top - fault->where.bottom) <
              4 * 0.04 * 0.04);
    }
    CHECK(found[static_cast<int>(Kind::twice)] > 5);
    CHECK(found[static_cast<int>(Kind::left_over)] > 5);
  }
}

}  // namespace section_part_test
