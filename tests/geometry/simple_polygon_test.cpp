// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

#include "support/boost_polygon.hpp"
#include "support/shapes.hpp"

namespace simple_polygon_test {

using namespace voussoir;
namespace boost_polygon = voussoir_test::boost_polygon;

namespace {

std::string refusal(const std::vector<Vec2>& vertices) {
  try {
    (void)SimplePolygon(vertices);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A star-shaped outline with deep notches: simple by construction, seldom convex.
std::vector<Vec2> random_star(Random& random, int corners, const Vec2& centre = {0, 0}) {
  std::vector<Vec2> vertices;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.8 * random.uniform()) / corners;
    const double radius = 0.2 + 2 * random.uniform();
    vertices.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return vertices;
}

const std::vector<Vec2> letter_l = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};

}  // namespace

TEST_SUITE("geometry/simple_polygon") {
  TEST_CASE("outlines that are none are refused, and the vertex or the edges named") {
    CHECK(refusal(letter_l) == "accepted");
    CHECK(contains(refusal({{0, 0}, {1, 0}}), "at least 3 vertices"));
    CHECK(contains(refusal({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "vertex 1 is repeated"));
    CHECK(contains(refusal({{0, 0}, {1, 0}, {0, 1}, {0, 0}}), "vertex 3 is repeated"));
    // A bow tie: edges 0 and 2 cross at (0.5, 0.5).
    CHECK(contains(refusal({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), "edges 0 and 2 cross or touch"));
    // Vertex 3 lies on edge 0.
    CHECK(contains(refusal({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}), "edges 0 and 2"));
    // Vertices 1 and 4 are one point: the outline touches itself in a corner.
    CHECK(contains(refusal({{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}), "cross or touch"));
    // A spike: edge 1 runs out and edge 2 comes back on it.
    CHECK(contains(refusal({{0, 0}, {1, 0}, {3, 0}, {2, 0}, {1, 1}}), "edges 1 and 2"));
    // The same where the last edge meets the first.
    CHECK(contains(refusal({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 0}}), "edges 0 and"));
    // Two edges that overlap along a stretch.
    CHECK(contains(refusal({{0, 0}, {3, 0}, {3, 1}, {2, 0}, {1, 0}, {0, 1}}), "cross or touch"));
    CHECK(refusal({{0, 0}, {1, 1}, {2, 2}}) != "accepted");  // no area
    CHECK(refusal({{0, 0}, {2, 2}, {1, 1}}) != "accepted");
  }

  TEST_CASE("a coordinate that is not finite is refused by the number of its vertex") {
    for (std::size_t k = 0; k < letter_l.size(); ++k)
      for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        CAPTURE(k);
        CAPTURE(bad);
        std::vector<Vec2> vertices = letter_l;
        vertices[k].x() = bad;
        CHECK(contains(refusal(vertices), "vertex " + std::to_string(k) + " is not finite"));
      }
  }

  TEST_CASE("both directions give the same anticlockwise outline") {
    std::vector<Vec2> clockwise = letter_l;
    std::reverse(clockwise.begin(), clockwise.end());
    for (const auto& vertices : {letter_l, clockwise}) {
      const SimplePolygon outline(vertices);
      CHECK(outline.area() == 6);        // 3 x 1 and 1 x 3
      CHECK(outline.perimeter() == 14);  // 3 + 1 + 2 + 3 + 1 + 4
      CHECK(outline.vertices() == letter_l);
      CHECK(outline.edge(5).start == Vec2(0, 4));
      CHECK(outline.edge(5).end == Vec2(0, 0));
    }
  }

  TEST_CASE("area and validity agree with Boost.Geometry on random stars") {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
      CAPTURE(trial);
      const auto vertices = random_star(random, 3 + trial % 20);
      const bool simple = boost_polygon::is_valid(vertices);
      const double area = boost_polygon::area(vertices);
      // A star of few corners may miss its centre; then either direction may come out.
      if (area < 0) continue;
      REQUIRE((refusal(vertices) == "accepted") == simple);
      if (simple) CHECK(std::abs(SimplePolygon(vertices).area() - area) < 1e-14 * 16);
    }
  }

  TEST_CASE("random outlines that cross themselves are refused as Boost.Geometry refuses them") {
    Random random(2);
    int crossed = 0;
    for (int trial = 0; trial < 300; ++trial) {
      CAPTURE(trial);
      std::vector<Vec2> vertices;
      for (int k = 0; k < 4 + trial % 4; ++k)
        vertices.emplace_back(random.uniform(), random.uniform());
      const bool simple = boost_polygon::is_valid_either_way(vertices);
      crossed += simple ? 0 : 1;
      CHECK((refusal(vertices) == "accepted") == simple);
    }
    CHECK(crossed > 100);
    CHECK(crossed < 280);
  }

  TEST_CASE("contains agrees with Boost.Geometry's within") {
    Random random(3);
    int inside = 0;
    for (int trial = 0; trial < 100; ++trial) {
      CAPTURE(trial);
      const Vec2 centre = trial % 2 == 0 ? Vec2(0, 0) : Vec2(800, -300);
      const auto vertices = random_star(random, 12, centre);
      const SimplePolygon outline(vertices);
      for (int k = 0; k < 50; ++k) {
        // Random points: none is within rounding of the outline.
        const Vec2 p =
            centre + Vec2(4.6 * (random.uniform() - 0.5), 4.6 * (random.uniform() - 0.5));
        const bool expected = boost_polygon::contains(outline.vertices(), p);
        CHECK(outline.contains(p) == expected);
        inside += expected ? 1 : 0;
      }
    }
    CHECK(inside > 500);
    CHECK(inside < 4500);
  }

  TEST_CASE("a ray level with vertices counts its crossings right") {
    const SimplePolygon outline(letter_l);
    CHECK(outline.contains({0.5, 1}));  // level with the edge from (3,1) to (1,1)
    CHECK_FALSE(outline.contains({2, 1.0001}));
    CHECK_FALSE(outline.contains({-1, 1}));
    CHECK_FALSE(outline.contains({-1, 0}));
    CHECK_FALSE(outline.contains({-1, 4}));
    const SimplePolygon diamond({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
    CHECK(diamond.contains({0, 0}));  // level with two vertices
    CHECK_FALSE(diamond.contains({-2, 0}));
    CHECK_FALSE(diamond.contains({2, 0}));
  }

  TEST_CASE("the last crossing of a ray is the farthest of several") {
    const SimplePolygon outline(letter_l);
    const auto at = [&](const Vec2& from, const Vec2& to) {
      return outline.last_crossing({from, to});
    };
    // Upwards from inside the foot at x = 0.5: through the top y = 4 only.
    REQUIRE(at({0.5, 0.5}, {0.5, 10.5}).has_value());
    CHECK(std::abs(*at({0.5, 0.5}, {0.5, 10.5}) - 0.35) < 1e-15);
    // Level at y = 0.5 from the left: in at x = 0, out at x = 3.
    CHECK(std::abs(at({-1, 0.5}, {9, 0.5}).value() - 0.4) < 1e-15);
    // Down the line x + y = 3.5: through the shaft from (0, 3.5) to (1, 2.5), the foot from (2.5,
    // 1).
    CHECK(std::abs(at({-0.5, 4}, {3.5, 0}).value() - 0.875) < 1e-15);  // out at (3, 0.5)
    CHECK_FALSE(at({5, 5}, {6, 6}).has_value());
    CHECK_FALSE(at({0.25, 0.25}, {0.75, 0.75}).has_value());  // wholly inside
    // It ends on the outline, or starts on it.
    CHECK(std::abs(at({0.5, 2}, {1, 2}).value() - 1) < 1e-15);
    CHECK(std::abs(at({1, 2}, {2, 2}).value()) < 1e-15);
    // Out through a corner: seen by one of its two edges at least.
    CHECK(std::abs(at({0.5, 0.5}, {5.5, 1.5}).value() - 0.5) < 1e-12);
  }
}

}  // namespace simple_polygon_test
