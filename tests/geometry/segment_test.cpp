// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/segment.hpp>

#include "support/shapes.hpp"

namespace segment_test {

using namespace voussoir;

TEST_SUITE("geometry/segment") {
  TEST_CASE("left of a line is inside its half space, and distances are true lengths") {
    const auto side = left_of({1, 1}, {4, 5});  // direction (3, 4) / 5
    CHECK(std::abs(side.distance({1, 1})) < 1e-15);
    CHECK(std::abs(side.distance({4, 5})) < 1e-15 * 5);
    // The point (1, 1) + 2 * (-4, 3)/5 lies 2 m to the left.
    CHECK(std::abs(side.distance({1 - 1.6, 1 + 1.2}) + 2) < 1e-15);
    CHECK(std::abs(side.distance({1 + 1.6, 1 - 1.2}) - 2) < 1e-15);
  }

  TEST_CASE("the area vector points to the right of the segment and is as long as it") {
    const Segment segment{{1, 1}, {4, 5}};
    CHECK(segment.area_vector() == Vec2(4, -3));
    CHECK(segment.length() == 5);
  }

  TEST_CASE("area vectors of a closed outline add up to nothing") {
    Random random(1);
    for (int trial = 0; trial < 50; ++trial) {
      const auto shape = voussoir_test::random_convex(random, 12, 4, 2, {50, -20});
      Vec2 sum = Vec2::Zero();
      for (std::size_t k = 0; k < shape.size(); ++k) sum += shape.face(k).area_vector();
      CHECK(sum.norm() < 1e-14);  // differences of coordinates at 50 m are exact but for their sum
    }
  }

  TEST_CASE("the Gauss points integrate a cubic along the segment exactly") {
    const Segment segment{{-1, 2}, {2, 6}};  // length 5
    const Vec2 along = (segment.end - segment.start) / 5;
    for (int power = 0; power <= 4; ++power) {
      CAPTURE(power);
      double sum = 0;
      for (const auto& point : segment.gauss_points())
        sum += point.weight * std::pow(along.dot(point.offset), power);
      // Integral of x^p from -5/2 to 5/2.
      const double exact = power % 2 == 1 ? 0 : 2 * std::pow(2.5, power + 1) / (power + 1);
      if (power < 4) {
        CHECK(std::abs(sum - exact) < 1e-14);
      } else {
        CHECK(std::abs(sum - exact) > 1);  // two points cannot do more
      }
    }
  }

  TEST_CASE("the centre seen from a near point is exact at mine-grid coordinates") {
    const Vec2 grid(1e6, 3e6), corner(0.5, 0.25), from(0.125, -0.75), to(1.625, 0.5);
    const Segment far{grid + from, grid + to};
    CHECK(far.centre_from(grid + corner) == Vec2(0.5 * (from + to) - corner));
    CHECK(far.at(0.5) == far.centre());
  }

  TEST_CASE("a line in the middle gives two parts that meet in one point, in either direction") {
    const auto side = left_of({0, 0}, {0, 1});  // inside: x < 0
    for (const bool forwards : {true, false}) {
      const Segment segment = forwards ? Segment{{-3, 0}, {1, 2}} : Segment{{1, 2}, {-3, 0}};
      const auto [below, above] = split(segment, side, 1e-12);
      REQUIRE(below.has_value());
      REQUIRE(above.has_value());
      const Vec2 crossing(0, 1.5);
      CHECK((below->centre() - Vec2(-1.5, 0.75)).norm() < 1e-15);
      CHECK((above->centre() - Vec2(0.5, 1.75)).norm() < 1e-15);
      CHECK((forwards ? below->end : below->start) == (forwards ? above->start : above->end));
      CHECK(((forwards ? below->end : below->start) - crossing).norm() < 1e-15);
      CHECK((below->end - below->start).dot(segment.end - segment.start) > 0);  // same direction
      CHECK((above->end - above->start).dot(segment.end - segment.start) > 0);
    }
  }

  TEST_CASE("a segment on one side stays whole; a part within the tolerance is not counted") {
    const auto side = left_of({0, 0}, {0, 1});
    const double tolerance = 1e-6;
    const auto parts = [&](double x0, double x1) {
      const auto [below, above] = split({{x0, 0}, {x1, 5}}, side, tolerance);
      if (below && !above) CHECK(below->length() == Segment{{x0, 0}, {x1, 5}}.length());
      if (above && !below) CHECK(above->length() == Segment{{x0, 0}, {x1, 5}}.length());
      return (below ? 1 : 0) + (above ? 2 : 0);
    };
    CHECK(parts(-2, -1) == 1);
    CHECK(parts(1, 2) == 2);
    CHECK(parts(-1, 0) == 1);
    CHECK(parts(0, 1) == 2);
    CHECK(parts(-1, 0.9e-6) == 1);
    CHECK(parts(0.9e-6, -1) == 1);
    CHECK(parts(1, -0.9e-6) == 2);
    CHECK(parts(-1, 1.1e-6) == 3);
    CHECK(parts(-1.1e-6, 1) == 3);
    CHECK(parts(0, 0) == 0);  // along the line
    CHECK(parts(-0.9e-6, 0.9e-6) == 0);
  }

  TEST_CASE("the parts of random segments add up to the whole") {
    Random random(2);
    for (int trial = 0; trial < 500; ++trial) {
      const auto point = [&] { return Vec2(random.normal(), random.normal()); };
      const Segment segment{point(), point()};
      const auto side = left_of(point(), point());
      const auto [below, above] = split(segment, side, 1e-12);
      const double sum = (below ? below->length() : 0) + (above ? above->length() : 0);
      CHECK(std::abs(sum - segment.length()) < 1e-14);  // a few roundings of lengths near 3 m
      if (below) CHECK(side.distance(below->centre()) <= 1e-12);
      if (above) CHECK(side.distance(above->centre()) >= -1e-12);
    }
  }

  TEST_CASE("the tangent of a contact is its normal turned to the left") {
    for (int k = 0; k < 16; ++k) {
      const Vec2 normal(std::cos(0.4 * k), std::sin(0.4 * k));
      const Vec2 tangent = tangent_basis(normal);
      CHECK(std::abs(tangent.dot(normal)) < 1e-16);
      CHECK(std::abs(cross(normal, tangent) - 1) < 1e-15);
    }
  }
}

}  // namespace segment_test
