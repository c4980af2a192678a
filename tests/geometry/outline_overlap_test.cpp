// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>
#include <voussoir/geometry/outline_overlap.hpp>

namespace outline_overlap_test {

using namespace voussoir;

namespace {

SimplePolygon box(double x0, double y0, double x1, double y1) {
  return SimplePolygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
SimplePolygon polygon(int corners, double radius, const Vec2& centre, double turn) {
  std::vector<Vec2> vertices;
  for (int k = 0; k < corners; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / corners;
    vertices.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return SimplePolygon(vertices);
}

}  // namespace

TEST_SUITE("geometry/outline_overlap") {
  TEST_CASE("outlines that overlap have a point in both, whichever comes first") {
    const std::vector<std::pair<SimplePolygon, SimplePolygon>> pairs{
        {box(0, 0, 2, 2), box(0, 0, 2, 2)},      // the same
        {box(0, 0, 2, 2), box(1, -1, 3, 3)},     // corners inside
        {box(-3, -1, 3, 1), box(-1, -3, 1, 3)},  // a cross: no corner inside
        {box(0, 0, 4, 4), box(1, 1, 2, 2)},      // one in the other
        {box(0, 0, 2, 1), box(0, 0, 2, 2)},      // three edges in common
        {polygon(72, 2, {0, 0}, 0), polygon(71, 2, {3.9, 0}, 0.1)},
        {polygon(36, 2, {0, 0}, 0), polygon(36, 2, {0, 0}, 0.05)}};
    for (const auto& [a, b] : pairs)
      for (const auto& place : {overlap_of(a, b, 1e-7), overlap_of(b, a, 1e-7)}) {
        REQUIRE(place.has_value());
        CHECK(a.contains(*place));
        CHECK(b.contains(*place));
      }
  }

  TEST_CASE("outlines that touch, or overlap by less than the tolerance, do not overlap") {
    const SimplePolygon middle = box(0, 0, 2, 2);
    for (const SimplePolygon& other :
         {box(2, 0, 4, 2), box(2, 1, 4, 5), box(0, -3, 2, 0), box(2, 2, 3, 3), box(5, 5, 6, 6),
          box(2 - 1e-9, 0, 4, 2), SimplePolygon({{2, 1}, {3, 0}, {3, 2}}),
          // A frame round it on three sides.
          SimplePolygon({{-1, -1}, {3, -1}, {3, 2}, {2, 2}, {2, 0}, {0, 0}, {0, 2}, {-1, 2}})}) {
      CHECK(!overlap_of(middle, other, 1e-7).has_value());
      CHECK(!overlap_of(other, middle, 1e-7).has_value());
    }
    CHECK(overlap_of(middle, box(2 - 1e-5, 0, 4, 2), 1e-7).has_value());
  }

  TEST_CASE("what one outline has all of, and what it has not") {
    const SimplePolygon large = box(0, 0, 4, 4);
    CHECK(encloses(large, box(1, 1, 2, 2), 1e-7));
    CHECK(encloses(large, box(0, 0, 4, 2), 1e-7));  // along three edges
    CHECK(encloses(large, large, 1e-7));
    CHECK(!encloses(box(1, 1, 2, 2), large, 1e-7));
    CHECK(!encloses(large, box(1, 1, 2, 4.001), 1e-7));
    CHECK(!encloses(box(-3, -1, 3, 1), box(-1, -3, 1, 3), 1e-7));
  }
}

}  // namespace outline_overlap_test
