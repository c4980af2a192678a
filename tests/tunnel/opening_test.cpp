// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <voussoir/tunnel/opening.hpp>

#include "support/near.hpp"

namespace opening_test {

using namespace voussoir;

namespace {
constexpr double pi = std::numbers::pi;
/// Twice the signed area of the vertices in their order: positive if anticlockwise.
double turning(const SimplePolygon& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    sum += cross(polygon.edge(k).start, polygon.edge(k).end);
  return sum;
}
}  // namespace

TEST_SUITE("tunnel/opening") {
  TEST_CASE("a circle is a regular polygon with its vertices on it, anticlockwise") {
    for (const int n : {12, 36, 72, 720}) {
      const SimplePolygon circle = circular_opening(10, n);
      REQUIRE(circle.size() == static_cast<std::size_t>(n));
      // (n/2) R^2 sin(2 pi/n)
      CHECK(circle.area() ==
            voussoir_test::near(0.5 * n * 25 * std::sin(2 * pi / n)).epsilon(1e-13));
      CHECK(circle.perimeter() == voussoir_test::near(n * 10 * std::sin(pi / n)).epsilon(1e-13));
      CHECK(turning(circle) > 0);
      CHECK((circle.vertices().front() - Vec2(5, 0)).norm() == 0);  // right-hand springing
      for (const Vec2& v : circle.vertices()) CHECK(std::abs(v.norm() - 5) <= 1e-14);
    }
  }

  TEST_CASE("a horseshoe is half a polygon on a rectangle") {
    const double width = 8, wall = 3;
    const SimplePolygon shape = horseshoe_opening(width, wall, 72);
    const double half_polygon = 0.25 * 72 * 16 * std::sin(2 * pi / 72);
    CHECK(shape.area() == voussoir_test::near(half_polygon + width * wall).epsilon(1e-13));
    CHECK(shape.perimeter() ==
          voussoir_test::near(36 * width * std::sin(pi / 72) + 2 * wall + width).epsilon(1e-13));
    CHECK(turning(shape) > 0);
    double low = 0, high = 0;
    for (const Vec2& v : shape.vertices()) {
      low = std::min(low, v.y());
      high = std::max(high, v.y());
    }
    CHECK(low == -wall);
    CHECK(high == voussoir_test::near(4).epsilon(1e-15));  // the crown is a vertex: 36 chords
    CHECK(shape.contains({0, 0}));
  }

  TEST_CASE("the domain keeps its cover and its rock below, whatever the shape") {
    const auto around = [](const SimplePolygon& opening) {
      return domain_around(opening, 70, 20, 30);
    };
    const Domain<2> circle = around(circular_opening(10));
    CHECK((circle.low - Vec2(-35, -35)).norm() <= 1e-14);
    CHECK((circle.high - Vec2(35, 25)).norm() <= 1e-14);
    const Domain<2> horseshoe = around(horseshoe_opening(8, 3));
    CHECK((horseshoe.low - Vec2(-35, -33)).norm() <= 1e-14);
    CHECK((horseshoe.high - Vec2(35, 24)).norm() <= 1e-14);
  }

  TEST_CASE("sizes out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, 0.0, -1.0, std::numeric_limits<double>::infinity()}) {
      CHECK_THROWS_AS((void)circular_opening(bad), InvalidInput);
      CHECK_THROWS_AS((void)horseshoe_opening(bad, 3), InvalidInput);
      CHECK_THROWS_AS((void)horseshoe_opening(8, bad), InvalidInput);
      const SimplePolygon opening = circular_opening(10);
      CHECK_THROWS_AS((void)domain_around(opening, bad, 20, 30), InvalidInput);
      CHECK_THROWS_AS((void)domain_around(opening, 70, bad, 30), InvalidInput);
      CHECK_THROWS_AS((void)domain_around(opening, 70, 20, bad), InvalidInput);
    }
    for (const int bad : {11, 721, 0, -72}) {
      CHECK_THROWS_AS((void)circular_opening(10, bad), InvalidInput);
      CHECK_THROWS_AS((void)horseshoe_opening(8, 3, bad), InvalidInput);
    }
  }
}

}  // namespace opening_test
