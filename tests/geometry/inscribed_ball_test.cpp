// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/geometry/inscribed_ball.hpp>
#include <voussoir/geometry/mass_properties.hpp>

#include "support/shapes.hpp"

namespace inscribed_ball_test {

using namespace voussoir;
using voussoir_test::polygon;

namespace {

/// Distance from a point to the nearest face, negative outside, from the vertices alone.
long double clearance(const ConvexPolygon& shape, long double x, long double y) {
  long double least = 1e300L;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const auto [a, b] = shape.face(k);
    const long double ux = static_cast<long double>(b.x()) - a.x(),
                      uy = static_cast<long double>(b.y()) - a.y();
    least = std::min(least, (ux * (y - a.y()) - uy * (x - a.x())) / std::sqrt(ux * ux + uy * uy));
  }
  return least;
}

/// The radius by brute force: the largest circle touches three faces (or, between parallel faces, a
/// third may be chosen); so try the circle of every three, and keep that with the most clearance.
double radius_of_all_triples(const ConvexPolygon& shape) {
  struct Line {
    long double x, y, c;  ///< x p + y q + r = c at distance r, relative to vertex 0
  };
  const Vec2 origin = shape.vertex(0);
  std::vector<Line> lines;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const auto [a, b] = shape.face(k);
    const long double ux = static_cast<long double>(b.x()) - a.x(),
                      uy = static_cast<long double>(b.y()) - a.y(),
                      length = std::sqrt(ux * ux + uy * uy);
    const long double nx = uy / length, ny = -ux / length;
    lines.push_back({nx, ny,
                     nx * (static_cast<long double>(a.x()) - origin.x()) +
                         ny * (static_cast<long double>(a.y()) - origin.y())});
  }
  long double best = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j)
      for (std::size_t k = j + 1; k < lines.size(); ++k) {
        // Subtracting the first equation leaves two for (p, q).
        const Line &l = lines[i], &m = lines[j], &n = lines[k];
        const long double a = m.x - l.x, b = m.y - l.y, c = m.c - l.c;
        const long double d = n.x - l.x, e = n.y - l.y, f = n.c - l.c;
        const long double det = a * e - b * d;
        if (std::abs(det) < 1e-17L) continue;
        const long double p = (c * e - b * f) / det, q = (a * f - c * d) / det;
        best = std::max(best, clearance(shape, p + origin.x(), q + origin.y()));
      }
  return static_cast<double>(best);
}

/// Checks radius and centre against each other and against the brute force.
void check_ball(const ConvexPolygon& shape, double tolerance) {
  const Ball<2> ball = inscribed_ball(shape);
  CHECK(std::abs(ball.radius - radius_of_all_triples(shape)) <= tolerance);
  const auto room = static_cast<double>(clearance(shape, ball.centre.x(), ball.centre.y()));
  CHECK(std::abs(room - ball.radius) <= tolerance);
}

}  // namespace

TEST_SUITE("geometry/inscribed_ball") {
  TEST_CASE("closed forms: triangle, square, rectangle, regular polygons") {
    // A right triangle of legs 3 and 4: r = (3 + 4 - 5) / 2 = 1 about (1, 1). Bounds: a few
    // roundings of lengths of that size.
    const auto triangle = inscribed_ball(polygon({{0, 0}, {4, 0}, {0, 3}}));
    CHECK(std::abs(triangle.radius - 1) < 2e-15);
    CHECK((triangle.centre - Vec2(1, 1)).norm() < 4e-15);

    const auto square = inscribed_ball(polygon({{1, 1}, {3, 1}, {3, 3}, {1, 3}}));
    CHECK(std::abs(square.radius - 1) < 2e-15);
    CHECK((square.centre - Vec2(2, 2)).norm() < 4e-15);

    // In a rectangle the centre may be anywhere on a line; the radius is half the short side.
    const auto rectangle = inscribed_ball(polygon({{0, 0}, {7, 0}, {7, 0.5}, {0, 0.5}}));
    CHECK(std::abs(rectangle.radius - 0.25) < 2e-15);
    CHECK(std::abs(rectangle.centre.y() - 0.25) < 2e-15);
    CHECK(rectangle.centre.x() > 0.25 - 2e-15);
    CHECK(rectangle.centre.x() < 6.75 + 2e-15);

    for (const int corners : {3, 4, 5, 6, 7, 12, 33, 100}) {
      CAPTURE(corners);
      const auto ball = inscribed_ball(polygon(voussoir_test::regular(corners, 2, {3, -1})));
      CHECK(std::abs(ball.radius - 2 * std::cos(std::numbers::pi / corners)) < 1e-14);
    }
  }

  TEST_CASE("any triangle: r = 2 A / P, at the incentre") {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
      const ConvexPolygon shape = voussoir_test::random_convex(random, 3, 2, 2);
      const auto ball = inscribed_ball(shape);
      const double a = shape.face(1).length(), b = shape.face(2).length(),
                   c = shape.face(0).length();
      const Vec2 incentre =
          (a * shape.vertex(0) + b * shape.vertex(1) + c * shape.vertex(2)) / (a + b + c);
      const double thinness = shape.diameter() * shape.diameter() / mass_properties(shape).measure;
      // The corner of a thin triangle is ill conditioned along its length.
      CHECK(std::abs(ball.radius - 2 * mass_properties(shape).measure / (a + b + c)) < 1e-14);
      CHECK((ball.centre - incentre).norm() < 1e-14 * thinness);
    }
  }

  TEST_CASE("random polygons agree with the circles of all triples of faces") {
    Random random(2);
    std::size_t most_faces = 0;
    for (int trial = 0; trial < 500; ++trial) {
      CAPTURE(trial);
      const ConvexPolygon shape = voussoir_test::random_convex(random, 3 + trial % 20, 2, 1);
      most_faces = std::max(most_faces, shape.size());
      check_ball(shape, 1e-14 * shape.diameter());  // a few dozen roundings
    }
    CHECK(most_faces >= 10);
  }

  TEST_CASE("needles 1 : 10 000 too, to a fraction of their thickness") {
    Random random(3);
    for (int trial = 0; trial < 500; ++trial) {
      CAPTURE(trial);
      const ConvexPolygon shape = voussoir_test::random_convex(random, 3 + trial % 12, 1, 1e-4);
      check_ball(shape, 1e-14 * shape.diameter());  // the radius is about 1e-5
    }
  }

  TEST_CASE("parallel faces: turned rectangles, parallelograms, hexagons of three directions") {
    Random random(4);
    for (int trial = 0; trial < 300; ++trial) {
      CAPTURE(trial);
      const double angle = 6.3 * random.uniform(), ratio = std::pow(10, -4 * random.uniform());
      const Vec2 along(std::cos(angle), std::sin(angle)), across = perpendicular(along);
      const ConvexPolygon rectangle =
          polygon({Vec2(0, 0), Vec2(along), Vec2(along + ratio * across), Vec2(ratio * across)});
      CHECK(std::abs(inscribed_ball(rectangle).radius - 0.5 * ratio) < 1e-15);
      check_ball(rectangle, 1e-14);
      const Vec2 edge = ratio * (across + 2 * (random.uniform() - 0.5) * along);
      check_ball(polygon({Vec2(0, 0), Vec2(along), Vec2(along + edge), Vec2(edge)}), 1e-14);
      const Vec2 third = edge - random.uniform() * along;
      check_ball(polygon({Vec2(0, 0), Vec2(along), Vec2(along + edge), Vec2(along + edge + third),
                          Vec2(edge + third), Vec2(third)}),
                 1e-13);
    }
  }

  TEST_CASE("at mine-grid coordinates it is as good as the coordinates") {
    Random random(5);
    for (int trial = 0; trial < 300; ++trial) {
      CAPTURE(trial);
      const Vec2 centre(1e6, -2e6);
      const ConvexPolygon shape = voussoir_test::random_convex(random, 3 + trial % 12, 2,
                                                               trial % 2 == 0 ? 1 : 1e-2, centre);
      // Doubles are 2.3e-10 m apart at 2e6 m; the offset of a face takes four roundings of that
      // size.
      check_ball(shape, 4 * 2.4e-10);
    }
  }

  TEST_CASE("the size of the shape does not matter: 1 mm and 1 km") {
    Random random(6);
    for (const double scale : {1e-3, 1e3})
      for (int trial = 0; trial < 50; ++trial) {
        const ConvexPolygon shape = voussoir_test::random_convex(random, 9, 2 * scale, scale);
        check_ball(shape, 1e-14 * shape.diameter());
      }
  }

  TEST_CASE("straight corners and tiny faces do not disturb it") {
    // A unit square whose lower side is cut in three, with a bevel of 1e-9 m on one corner.
    const ConvexPolygon shape =
        polygon({{0, 0}, {0.25, 0}, {0.75, 0}, {1, 0}, {1, 1 - 1e-9}, {1 - 1e-9, 1}, {0, 1}});
    CHECK(std::abs(inscribed_ball(shape).radius - 0.5) < 1e-15);
  }
}

}  // namespace inscribed_ball_test
