// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>
#include <voussoir/geometry/mass_properties.hpp>

#include "support/reference.hpp"
#include "support/shapes.hpp"

namespace mass_properties_test {

using namespace voussoir;
using voussoir_test::polygon;
using voussoir_test::reference;

TEST_SUITE("geometry/mass_properties") {
  TEST_CASE("regular polygons have the tabled area and polar moment") {
    for (const int corners : {3, 6, 32}) {
      CAPTURE(corners);
      const std::string id = "F.polygon" + std::to_string(corners);
      const auto properties = mass_properties(polygon(voussoir_test::regular(corners, 1)));
      // The table holds 12 digits.
      CHECK(std::abs(properties.measure / reference(id + ".A") - 1) < 1e-11);
      CHECK(std::abs(properties.second_moment(0, 0) / reference(id + ".J") - 1) < 1e-11);
      CHECK(properties.centroid.norm() < 1e-15);
    }
  }

  TEST_CASE("a rectangle b x h: area b h, polar moment b h (b^2 + h^2) / 12") {
    const auto properties = mass_properties(polygon({{1, 2}, {4, 2}, {4, 3}, {1, 3}}));
    CHECK(properties.measure == 3);
    CHECK((properties.centroid - Vec2(2.5, 2.5)).norm() < 1e-15);
    CHECK(std::abs(properties.second_moment(0, 0) - 3.0 * (9 + 1) / 12) < 1e-14);
  }

  TEST_CASE("an L needs no convexity: the whole equals its two rectangles") {
    const std::vector<Vec2> outline = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
    const auto whole = mass_properties(std::span<const Vec2>(outline));
    // 3 x 1 about (1.5, 0.5) and 1 x 3 about (0.5, 2.5): area 6, centroid (1, 1.5), and by the
    // parallel-axis theorem 2.5 + 2.5 + 3 (0.25 + 1) + 3 (0.25 + 1) = 12.5.
    CHECK(std::abs(whole.measure - 6) < 1e-14);
    CHECK((whole.centroid - Vec2(1, 1.5)).norm() < 1e-15);
    CHECK(std::abs(whole.second_moment(0, 0) - 12.5) < 1e-13);

    const std::vector<ConvexPolygon> parts = {polygon({{0, 0}, {3, 0}, {3, 1}, {0, 1}}),
                                              polygon({{0, 1}, {1, 1}, {1, 4}, {0, 4}})};
    const auto joined = mass_properties(parts);
    CHECK(std::abs(joined.measure - 6) < 1e-14);
    CHECK((joined.centroid - Vec2(1, 1.5)).norm() < 1e-15);
    CHECK(std::abs(joined.second_moment(0, 0) - 12.5) < 1e-13);
  }

  TEST_CASE("at mine-grid coordinates a block keeps every digit") {
    // Coordinates in 1/1024 m: adding 1e6 m rounds nothing, so nothing at all may change.
    const std::vector<Vec2> near = {{0, 0}, {1.125, 0.25}, {1.5, 1.0078125}, {0.25, 0.875}};
    std::vector<Vec2> far = near;
    const Vec2 grid(1e6, -2e6);
    for (Vec2& v : far) v += grid;
    const auto here = mass_properties(polygon(near)), there = mass_properties(polygon(far));
    CHECK(there.measure == here.measure);
    CHECK(there.second_moment(0, 0) == here.second_moment(0, 0));
    // Only the centroid is rounded, once, to the 2.3e-10 m that doubles have at 2e6.
    CHECK((there.centroid - grid - here.centroid).norm() < 2.4e-10);
  }

  TEST_CASE("turning, mirroring and renumbering a shape change nothing") {
    Random random(4);
    for (int trial = 0; trial < 50; ++trial) {
      const ConvexPolygon shape = voussoir_test::random_convex(random, 8, 3, 1, {5, -2});
      const auto properties = mass_properties(shape);
      const double angle = 6.3 * random.uniform(), c = std::cos(angle), s = std::sin(angle);
      std::vector<Vec2> turned_by_angle, mirrored, renumbered;
      for (std::size_t k = 0; k < shape.size(); ++k) {
        const Vec2 v = shape.vertex(k);
        turned_by_angle.emplace_back(c * v.x() - s * v.y(), s * v.x() + c * v.y());
        mirrored.insert(mirrored.begin(), Vec2(-v.x(), v.y()));
        renumbered.push_back(shape.vertex((k + 1) % shape.size()));
      }
      for (const auto& vertices : {turned_by_angle, mirrored, renumbered}) {
        const auto other = mass_properties(polygon(vertices));
        // Lengths up to 3 m, coordinates up to 7 m with roundings of 1e-15 m.
        CHECK(std::abs(other.measure - properties.measure) < 3e-14);
        CHECK(std::abs(other.second_moment(0, 0) - properties.second_moment(0, 0)) < 1e-13);
      }
      const auto other = mass_properties(polygon(turned_by_angle)).centroid;
      const Vec2 expected(c * properties.centroid.x() - s * properties.centroid.y(),
                          s * properties.centroid.x() + c * properties.centroid.y());
      CHECK((other - expected).norm() < 1e-13);
    }
  }

  TEST_CASE("cut into pieces and put together again, a shape is the same body") {
    Random random(5);
    for (int trial = 0; trial < 100; ++trial) {
      CAPTURE(trial);
      const ConvexPolygon shape = voussoir_test::random_convex(random, 10, 2, 0.5, {30, 20});
      const auto whole = mass_properties(shape);
      std::vector<ConvexPolygon> parts = {shape};
      for (int cut = 0; cut < 4; ++cut) {
        const double angle = 6.3 * random.uniform();
        const auto line =
            left_of(whole.centroid, whole.centroid + Vec2(std::cos(angle), std::sin(angle)));
        std::vector<ConvexPolygon> next;
        for (const ConvexPolygon& part : parts) {
          if (const auto both = part.split(line, 50 + cut, 1e-12)) {
            next.push_back(both->first);
            next.push_back(both->second);
          } else {
            next.push_back(part);
          }
        }
        parts = next;
      }
      REQUIRE(parts.size() >= 8);  // four lines through an inner point make 8 pieces
      const auto together = mass_properties(parts);
      // Vertices of the pieces are rounded to 4e-15 m at 30 m.
      CHECK(std::abs(together.measure - whole.measure) < 1e-13);
      CHECK((together.centroid - whole.centroid).norm() < 1e-12);
      CHECK(std::abs(together.second_moment(0, 0) - whole.second_moment(0, 0)) < 1e-12);
    }
  }
}

}  // namespace mass_properties_test
