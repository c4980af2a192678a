// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/tunnel_axis.hpp>

#include "support/near.hpp"

namespace tunnel_axis_test {

using namespace voussoir;
constexpr double right_angle = 0.5 * std::numbers::pi;

TEST_SUITE("geometry/tunnel_axis") {
  TEST_CASE("North, East and down have axes of whole numbers") {
    const TunnelAxis north, east({1, 2, 3}, right_angle), down({0, 0, 9}, 0, right_angle);
    CHECK(north.right() == Vec3(1, 0, 0));
    CHECK(north.up() == Vec3(0, 0, 1));
    CHECK(north.along() == Vec3(0, 1, 0));
    CHECK(east.right() == Vec3(0, -1, 0));
    CHECK(east.up() == Vec3(0, 0, 1));
    CHECK(east.along() == Vec3(1, 0, 0));
    CHECK(down.right() == Vec3(1, 0, 0));
    CHECK(down.up() == Vec3(0, 1, 0));
    CHECK(down.along() == Vec3(0, 0, -1));
    CHECK(down.point({0, 0}, 4) == Vec3(0, 0, 5));  // 4 m below the collar
  }

  TEST_CASE("a point and its local coordinates are inverse, the axes right angled") {
    for (double trend = -3; trend < 4; trend += 0.7)
      for (double plunge = -1.5; plunge < 1.6; plunge += 0.5) {
        const TunnelAxis axis({4, -5, 6}, trend, plunge);
        const Vec3 p = axis.point({1.5, -2}, 7);
        CHECK((axis.local(p) - Vec3(1.5, -2, 7)).norm() < 1e-13);
        // Right, up and back make a right-handed frame, and right stays level.
        CHECK((cross(axis.right(), axis.up()) + axis.along()).norm() < 1e-14);
        CHECK(axis.right().z() == 0);
        CHECK(axis.along().z() == voussoir_test::near(-std::sin(plunge)));
        CHECK(axis.is_parallel_to(TunnelAxis({0, 0, 0}, trend + std::numbers::pi, -plunge)));
        CHECK(!axis.is_parallel_to(
            TunnelAxis({0, 0, 0}, trend, plunge > 0 ? plunge - 0.1 : plunge + 0.1)));
      }
  }

  TEST_CASE("a turned prism holds what the prism along y holds, turned") {
    const SimplePolygon section({{-1, -1}, {2, -1}, {2, 0.5}, {-1, 0.5}});
    const PrismaticOpening north(section, -1, 3),
        turned(section, TunnelAxis({10, 20, 30}, 0.4, -0.3), -1, 3);
    int inside = 0;
    for (double x = -1.87; x < 3; x += 0.45)
      for (double y = -1.87; y < 4; y += 0.45)
        for (double z = -1.87; z < 1; z += 0.45) {
          const bool held = north.contains({x, y, z});
          CHECK(turned.contains(turned.in_space({x, z}, y)) == held);
          inside += held;
        }
    CHECK(inside > 50);
    for (std::size_t k = 0; k < turned.size(); ++k) {
      // The middle of every side lies on its plane, and a little further in is inside.
      const JointPlane side = turned.side(k, 100);
      Vec3 middle = zeros<Vec3>();
      for (const Vec3& corner : side.corners) middle += 0.25 * corner;
      CHECK(std::abs(side.plane.distance(middle)) < 1e-12);
      CHECK(turned.contains(middle - 1e-6 * side.plane.normal) !=
            turned.contains(middle + 1e-6 * side.plane.normal));
    }
  }

  TEST_CASE("what is out of range is refused") {
    CHECK_THROWS_AS(TunnelAxis({0, 0, 0}, 0, 2), InvalidInput);
    CHECK_THROWS_AS(TunnelAxis({0, 0, 0}, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
    CHECK_THROWS_AS(TunnelAxis({std::numeric_limits<double>::infinity(), 0, 0}), InvalidInput);
  }
}

}  // namespace tunnel_axis_test
