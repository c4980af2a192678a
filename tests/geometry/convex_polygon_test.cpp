// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/mass_properties.hpp>

#include "support/shapes.hpp"

namespace convex_polygon_test {

using namespace voussoir;
using voussoir_test::polygon;

namespace {

std::string refusal(const std::vector<Vec2>& vertices) {
  try {
    (void)polygon(vertices);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::vector<Vec2> unit_square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// Where a face of `shape` carries the label of the new cut; the face.
std::vector<Segment> faces_labelled(const ConvexPolygon& shape, int label) {
  std::vector<Segment> found;
  for (std::size_t k = 0; k < shape.size(); ++k)
    if (shape.cut(k) == label) found.push_back(shape.face(k));
  return found;
}

}  // namespace

TEST_SUITE("geometry/convex_polygon") {
  TEST_CASE("what is not an anticlockwise convex polygon is refused, and the vertex named") {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    CHECK(refusal(unit_square) == "accepted");
    CHECK(contains(refusal({}), "at least 3 vertices"));
    CHECK(contains(refusal({{0, 0}, {1, 0}}), "at least 3 vertices"));
    CHECK(contains(refusal({{0, 0}, {1, 0}, {1, 0}, {1, 1}}), "vertex 1 is repeated"));
    CHECK(contains(refusal({{0, 0}, {1, 0}, {1, 1}, {0, 0}}), "vertex 3 is repeated"));
    // Clockwise: every corner turns right; the first one met is that between faces 0 and 1.
    CHECK(contains(refusal({{0, 0}, {0, 1}, {1, 1}, {1, 0}}), "vertex 1 is a non-convex"));
    CHECK(
        contains(refusal({{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}}), "vertex 3 is a non-convex"));
    CHECK(contains(refusal({{0.5, 0.5}, {2, 0}, {2, 2}, {-1, 1}, {0, 0.9}}), "non-convex"));
    for (std::size_t k = 0; k < 4; ++k)
      for (const double bad : {nan, inf, -inf}) {
        CAPTURE(k);
        CAPTURE(bad);
        std::vector<Vec2> vertices = unit_square;
        vertices[k].y() = bad;
        CHECK(contains(refusal(vertices), "vertex " + std::to_string(k) + " is not finite"));
      }
    CHECK_THROWS_AS(ConvexPolygon(unit_square, {0, 1, 2}), InvalidInput);
    CHECK_THROWS_AS(ConvexPolygon(unit_square, {0, 1, 2, 3, 4}), InvalidInput);
  }

  TEST_CASE(
      "a refusal has the place of the vertex, the value and the rule, and the block's number") {
    CHECK(contains(refusal({{0, 0}, {1, 0}}), "needs at least 3 vertices, has 2"));
    CHECK(contains(refusal({{0, 0}, {1, 0}, {1, std::nan("")}, {0, 1}}),
                   "vertex 2 is not finite: it is at (1, "));
    CHECK(contains(refusal({{0, 0}, {1.5, 0}, {1.5, 0}, {1, 1}}), "it is at (1.5, 0) m"));
    // From along -y to along +x is a turn to the left by 90 degrees, so from -y to -x one right.
    CHECK(contains(refusal({{0, 2}, {0, 0}, {-1, 0}, {-1, 3}}),
                   "vertex 1 is a non-convex or clockwise corner, the outline turns by -90 "
                   "degrees where it must turn left, by 0 or more: it is at (0, 0) m"));
    // There and back again: turns of 180 degrees on a line.
    CHECK(contains(refusal({{0, 0}, {1, 0}, {0.5, 0}}), "encloses an area of 0 m^2, must be > 0"));
    const std::vector<Vec2> corners = voussoir_test::regular(5, 1);
    CHECK(contains(refusal({corners[0], corners[2], corners[4], corners[1], corners[3]}),
                   "it turns by 720 degrees in all, must be 360"));
    std::string text;
    try {
      (void)naming("block 17", [] { return polygon({{0, 0}, {1, 0}}); });
    } catch (const InvalidInput& error) {
      text = error.what();
    }
    CHECK(text == "block 17: convex polygon: needs at least 3 vertices, has 2");
  }

  TEST_CASE("an outline that turns left everywhere but winds twice is refused") {
    // The pentagram: corners of a regular pentagon, every second one.
    const std::vector<Vec2> corners = voussoir_test::regular(5, 1);
    CHECK(refusal(corners) == "accepted");
    CHECK(contains(refusal({corners[0], corners[2], corners[4], corners[1], corners[3]}),
                   "crosses itself"));
  }

  TEST_CASE("an outline without area is refused in every direction") {
    for (const Vec2& along : {Vec2(1, 0), Vec2(0, 1), Vec2(1, 1), Vec2(-1, 1), Vec2(3, -7)}) {
      CAPTURE(along.transpose());
      CHECK(refusal({{0, 0}, along, 0.5 * along}) != "accepted");
      CHECK(refusal({{0, 0}, 0.5 * along, along}) != "accepted");
      CHECK(refusal({along, 2 * along, 4 * along, 3 * along}) != "accepted");
    }
  }

  TEST_CASE("a straight corner is allowed: a neighbour's corner may lie on a face") {
    CHECK(refusal({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}) == "accepted");
  }

  TEST_CASE("every vertex is inside or on every half space of its faces") {
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
      const ConvexPolygon shape = voussoir_test::random_convex(random, 12, 3, 1);
      for (std::size_t k = 0; k < shape.size(); ++k) {
        const HalfSpace<2> side = shape.half_space(k);
        CHECK(std::abs(side.normal.norm() - 1) < 1e-15);
        for (const Vec2& v : shape.vertices())
          CHECK(side.distance(v) <= 4e-16 * 3);  // two products and a sum of lengths up to 3 m
        // A step outwards is outside: the normal points out of the polygon.
        CHECK(side.distance(shape.face(k).centre() + side.normal) > 0.999);
      }
    }
  }

  TEST_CASE("diameter and perimeter of a 3 x 4 rectangle and a regular hexagon") {
    const ConvexPolygon rectangle = polygon({{0, 0}, {3, 0}, {3, 4}, {0, 4}});
    CHECK(rectangle.diameter() == 5);  // 3, 4, 5
    CHECK(rectangle.perimeter() == 14);
    const ConvexPolygon hexagon = polygon(voussoir_test::regular(6, 2));
    CHECK(std::abs(hexagon.diameter() - 4) < 1e-15 * 4);
    CHECK(std::abs(hexagon.perimeter() - 12) < 1e-15 * 12);
  }

  TEST_CASE("a cut gives the part left of the line first, both with their labels") {
    const auto parts = polygon(unit_square).split(left_of({0.25, -1}, {0.25, 2}), 7, 1e-12);
    REQUIRE(parts.has_value());
    // Left of the upward line is x < 0.25: faces bottom 0, cut, top 2, left 3.
    CHECK(mass_properties(parts->first).measure == 0.25);
    CHECK(mass_properties(parts->second).measure == 0.75);
    const auto labels = [](const ConvexPolygon& shape) {
      std::vector<int> all;
      for (std::size_t k = 0; k < shape.size(); ++k) all.push_back(shape.cut(k));
      return all;
    };
    CHECK(labels(parts->first) == std::vector<int>{0, 7, 2, 3});
    CHECK(labels(parts->second) == std::vector<int>{0, 1, 2, 7});
  }

  TEST_CASE("parts add up, share their new vertices bit for bit and keep the parent's labels") {
    Random random(2);
    int cuts = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      CAPTURE(trial);
      const double height = trial % 2 == 0 ? 1 : 1e-3;
      const Vec2 centre = trial % 3 == 0 ? Vec2(700, -300) : Vec2(0, 0);
      const ConvexPolygon shape = voussoir_test::random_convex(random, 10, 2, height, centre);
      const Vec2 through = mass_properties(shape).centroid;
      const double angle = 2 * std::numbers::pi * random.uniform();
      const auto line = left_of(through, through + Vec2(std::cos(angle), std::sin(angle)));
      const double tolerance = 1e-11;
      const auto parts = shape.split(line, 99, tolerance);
      if (!parts) continue;
      ++cuts;
      const auto& [below, above] = *parts;
      // A fan of up to 12 triangles, each of area below 4 m^2 and rounded to 1e-16 of it; vertices
      // at 700 m are rounded to 1e-13 m.
      const double rounding = 1e-14 + 1e-12 * (centre.norm() > 0 ? 1.0 : 0.0);
      CHECK(std::abs(mass_properties(below).measure + mass_properties(above).measure -
                     mass_properties(shape).measure) <= rounding);
      const auto low = faces_labelled(below, 99), high = faces_labelled(above, 99);
      REQUIRE(low.size() == 1);
      REQUIRE(high.size() == 1);
      CHECK(low[0].start == high[0].end);  // == is meant
      CHECK(low[0].end == high[0].start);
      CHECK(below.size() + above.size() <= shape.size() + 4);
      for (const ConvexPolygon* part : {&below, &above})
        for (std::size_t k = 0; k < part->size(); ++k) {
          const double side = line.distance(part->face(k).centre());
          CHECK((part == &below ? side : -side) <= tolerance);
          if (part->cut(k) == 99) continue;
          const auto parent = shape.half_space(static_cast<std::size_t>(part->cut(k)));
          CHECK(std::abs(parent.distance(part->face(k).start)) <= 1e-12);
          CHECK(std::abs(parent.distance(part->face(k).end)) <= 1e-12);
        }
    }
    CHECK(cuts > 950);  // a line through the centroid misses only needles met lengthwise
  }

  TEST_CASE("the parts of a cut are polygons that the constructor accepts") {
    Random random(3);
    for (int trial = 0; trial < 300; ++trial) {
      const ConvexPolygon shape = voussoir_test::random_convex(random, 10, 2, 1);
      const Vec2 through = mass_properties(shape).centroid;
      const auto parts =
          shape.split(left_of(through, through + Vec2(random.normal(), random.normal())), 9, 1e-12);
      REQUIRE(parts.has_value());
      CHECK(refusal(parts->first.vertices()) == "accepted");
      CHECK(refusal(parts->second.vertices()) == "accepted");
    }
  }

  TEST_CASE("a line through two vertices makes no new ones") {
    const auto parts = polygon(unit_square).split(left_of({0, 0}, {1, 1}), 7, 1e-12);
    REQUIRE(parts.has_value());
    // Left of the diagonal: (0,0), (1,1), (0,1).
    CHECK(parts->first.size() == 3);
    CHECK(parts->second.size() == 3);
    CHECK(faces_labelled(parts->first, 7).at(0).start == Vec2(0, 0));
    CHECK(faces_labelled(parts->first, 7).at(0).end == Vec2(1, 1));
    CHECK(faces_labelled(parts->second, 7).at(0).start == Vec2(1, 1));
    CHECK(mass_properties(parts->first).measure == 0.5);
    CHECK(mass_properties(parts->second).measure == 0.5);
  }

  TEST_CASE("a line through one vertex uses it; within the tolerance it counts as on the line") {
    for (const double miss : {0.0, 0.9e-9, -0.9e-9}) {
      CAPTURE(miss);
      const auto parts = polygon(unit_square).split(left_of({miss, 0}, {0.5 + miss, 1}), 7, 1e-9);
      REQUIRE(parts.has_value());
      CHECK(parts->first.size() == 3);  // (0,0), (0.5,1), (0,1)
      CHECK(parts->second.size() == 4);
      CHECK(faces_labelled(parts->first, 7).at(0).start == Vec2(0, 0));
    }
    // Beyond the tolerance the vertex is its own and a sliver of a face appears.
    const auto parts = polygon(unit_square).split(left_of({1e-6, 0}, {0.5, 1}), 7, 1e-9);
    REQUIRE(parts.has_value());
    CHECK(parts->first.size() == 4);
  }

  TEST_CASE("a line that misses, touches a vertex or runs along a face cuts nothing") {
    const ConvexPolygon square = polygon(unit_square);
    CHECK_FALSE(square.split(left_of({2, 0}, {2, 1}), 7, 1e-12).has_value());
    CHECK_FALSE(square.split(left_of({-2, 0}, {-2, 1}), 7, 1e-12).has_value());
    CHECK_FALSE(square.split(left_of({0, 1}, {1, 2}), 7, 1e-12).has_value());  // vertex (0,1) only
    CHECK_FALSE(square.split(left_of({0, 0}, {1, 0}), 7, 1e-12).has_value());
    CHECK_FALSE(square.split(left_of({1, 0}, {0, 0}), 7, 1e-12).has_value());
    // Nearly along a face: both its vertices are within the tolerance.
    CHECK_FALSE(square.split(left_of({0, 1e-10}, {1, -1e-10}), 7, 1e-9).has_value());
    CHECK(square.split(left_of({0, 1e-8}, {1, 1e-8}), 7, 1e-9).has_value());
  }
}

}  // namespace convex_polygon_test
