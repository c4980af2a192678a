// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>
#include <voussoir/rockmass/orientation.hpp>

namespace orientation_test {

using namespace voussoir;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Vec3 east(1, 0, 0), north(0, 1, 0), up(0, 0, 1);

Orientation plane(double dip, double dip_direction) {
  return {dip * degree, dip_direction * degree};
}

}  // namespace

TEST_SUITE("rockmass/orientation") {
  TEST_CASE("dip 30 towards 090: down to the East, its normal (sin 30, 0, cos 30)") {
    const double s = 0.5, c = std::sqrt(0.75);
    CHECK((upward_normal(plane(30, 90)) - Vec3(s, 0, c)).norm() < 1e-15);
    CHECK((dip_vector(plane(30, 90)) - Vec3(c, 0, -s)).norm() < 1e-15);
    CHECK((strike_vector(plane(30, 90)) - north).norm() < 1e-15);
  }

  TEST_CASE("the compass by name: towards North, South, West, level and upright planes") {
    const double h = std::sqrt(0.5);
    CHECK((dip_vector(plane(45, 0)) - Vec3(0, h, -h)).norm() < 1e-15);
    CHECK((dip_vector(plane(45, 180)) - Vec3(0, -h, -h)).norm() < 1e-15);
    CHECK((dip_vector(plane(45, 270)) - Vec3(-h, 0, -h)).norm() < 1e-15);
    CHECK((dip_vector(plane(0, 45)) - Vec3(h, h, 0)).norm() < 1e-15);  // North-East
    CHECK((upward_normal(plane(0, 123)) - up).norm() < 1e-15);
    CHECK((upward_normal(plane(90, 90)) - east).norm() < 1e-15);
    CHECK((dip_vector(plane(90, 90)) + up).norm() < 1e-15);
  }

  TEST_CASE("dip, strike and normal are a right-handed set of unit vectors") {
    for (double dip = 0; dip <= 90; dip += 7.5)
      for (double direction = 0; direction < 360; direction += 11.25) {
        const Orientation p = plane(dip, direction);
        CHECK((cross(dip_vector(p), strike_vector(p)) - upward_normal(p)).norm() < 4e-16);
        CHECK(strike_vector(p).z() == 0);
        CHECK(dip_vector(p).z() <= 0);
        CHECK(upward_normal(p).z() >= 0);
      }
  }

  TEST_CASE("a normal of either sense and any length gives dip and dip direction back") {
    for (double dip = 2.5; dip < 90; dip += 7.5)
      for (double direction = 0; direction < 360; direction += 11.25)
        for (const double factor : {1.0, -1.0, -7.0, 1e-3}) {
          const Orientation found = orientation_of(factor * upward_normal(plane(dip, direction)));
          CHECK(std::abs(found.dip - dip * degree) < 1e-15);
          const double turn =
              std::remainder(found.dip_direction - direction * degree, 2 * std::numbers::pi);
          CHECK(std::abs(turn) < 1e-14);
          CHECK(found.dip_direction >= 0);
          CHECK(found.dip_direction <= 2 * std::numbers::pi);
        }
    CHECK(orientation_of(up).dip == 0);
    CHECK(orientation_of(-up).dip == 0);
    CHECK(orientation_of(up).dip_direction == 0);
    CHECK(std::abs(orientation_of(-east).dip - 90 * degree) < 1e-15);
  }

  TEST_CASE("a dip beyond 90 degrees, and a strike by the right-hand rule, are the same planes") {
    for (double dip = 0; dip <= 180; dip += 7.5)
      for (double direction = -360; direction <= 720; direction += 33.75) {
        CAPTURE(dip);
        CAPTURE(direction);
        const Orientation same = upright(plane(dip, direction));
        CHECK(same.dip <= 90 * degree);
        CHECK(same.dip_direction >= 0);
        CHECK(same.dip_direction < 360 * degree);
        // The normal of an overturned plane points down: the same plane, of the other sense.
        const double sense = dip > 90 ? -1 : 1;
        CHECK((upward_normal(same) - sense * upward_normal(plane(dip, direction))).norm() < 4e-15);
      }
    for (double strike = 0; strike < 360; strike += 11.25) {
      const Orientation p = orientation_by_strike(strike * degree, 60 * degree);
      CHECK(p.dip_direction < 360 * degree);
      const Vec3 along(std::sin(strike * degree), std::cos(strike * degree), 0);
      CHECK((strike_vector(p) - along).norm() < 1e-14);  // and it falls to the right of that
    }
  }

  TEST_CASE("the mean of normals of either sense, also of upright planes") {
    for (const double dip : {0.0, 40.0, 88.0, 90.0}) {
      CAPTURE(dip);
      // Four planes about the mean, two of them given by the normal that points the other way.
      const Vec3 n = upward_normal(plane(dip, 70));
      const Vec3 u = dip_vector(plane(dip, 70)), v = strike_vector(plane(dip, 70));
      const std::vector<Vec3> normals = {n + 0.2 * u, -n + 0.2 * u, -(n + 0.2 * v), n - 0.2 * v};
      const Orientation mean = mean_orientation(normals);
      // The normal of an upright plane may be turned round: its dip direction by 180 degrees.
      CHECK(std::abs(std::abs(upward_normal(mean).dot(n)) - 1) < 1e-15);
    }
  }
}

}  // namespace orientation_test
