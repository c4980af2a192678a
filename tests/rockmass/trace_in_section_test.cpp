// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/rockmass/trace_in_section.hpp>

#include "support/near.hpp"

namespace trace_in_section_test {

using namespace voussoir;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Axis of a level tunnel.
Vec3 along(double trend) { return {std::sin(trend), std::cos(trend), 0}; }
/// To the right, looking along it.
Vec3 right_of(double trend) { return {std::cos(trend), -std::sin(trend), 0}; }

}  // namespace

TEST_SUITE("rockmass/trace_in_section") {
  TEST_CASE("the trace is the line in which plane and section cross: 1000 planes and tunnels") {
    Random random(7, 0);
    for (int k = 0; k < 1000; ++k) {
      const Orientation plane{0.5 * std::numbers::pi * random.uniform(),
                              2 * std::numbers::pi * random.uniform()};
      const double trend = 2 * std::numbers::pi * random.uniform();
      CAPTURE(k);
      const TraceInSection trace = trace_in_section(plane, trend);
      const Vec3 normal = upward_normal(plane), line = cross(normal, along(trend));
      REQUIRE(trace.sine == voussoir_test::near(line.norm()).epsilon(1e-9));
      // Down the line, seen along the tunnel.
      const Vec3 down = line.z() > 0 ? Vec3(-line) : line;
      const double to_the_right = down.dot(right_of(trend));
      const double fall = std::atan2(-down.z(), std::abs(to_the_right));
      REQUIRE(std::abs(trace.dip - fall) < 1e-9);
      if (std::abs(to_the_right) > 1e-9 && trace.dip > 1e-9)
        REQUIRE((trace.direction == DipDirection::east) == (to_the_right > 0));
    }
  }

  TEST_CASE("the same of tunnels that plunge, on the plane at right angles to their axis") {
    Random random(8, 0);
    for (int k = 0; k < 1000; ++k) {
      const Orientation plane{0.5 * std::numbers::pi * random.uniform(),
                              2 * std::numbers::pi * random.uniform()};
      const double trend = 2 * std::numbers::pi * random.uniform(),
                   plunge = (random.uniform() - 0.5) * std::numbers::pi / 2;
      CAPTURE(k);
      const Vec3 axis(std::cos(plunge) * along(trend) - Vec3(0, 0, std::sin(plunge))),
          up = cross(right_of(trend), axis);
      const TraceInSection trace = trace_in_section(plane, trend, plunge);
      const Vec3 line = cross(upward_normal(plane), axis);
      REQUIRE(trace.sine == voussoir_test::near(line.norm()).epsilon(1e-9));
      const Vec3 down = line.dot(up) > 0 ? Vec3(-line) : line;
      const double to_the_right = down.dot(right_of(trend));
      REQUIRE(std::abs(trace.dip - std::atan2(-down.dot(up), std::abs(to_the_right))) < 1e-9);
      if (std::abs(to_the_right) > 1e-9 && trace.dip > 1e-9)
        REQUIRE((trace.direction == DipDirection::east) == (to_the_right > 0));
    }
  }

  TEST_CASE("planes that strike along the tunnel keep their dip to the last bit") {
    for (const double dip : {0.0, 25 * degree, 75 * degree, 90 * degree}) {
      CAPTURE(dip);
      const TraceInSection east = trace_in_section({dip, 90 * degree}, 0),
                           west = trace_in_section({dip, 270 * degree}, 0);
      CHECK(east.dip == dip);
      CHECK(west.dip == dip);
      CHECK(east.direction == DipDirection::east);
      CHECK(west.direction == DipDirection::west);
      CHECK(east.sine == 1);
    }
  }

  TEST_CASE("by hand: 60 deg towards 045 with a tunnel to the North; parallel to the section") {
    // tan a = tan 60 sin 45 = sqrt(3/2)
    const TraceInSection trace = trace_in_section({60 * degree, 45 * degree}, 0);
    CHECK(std::abs(std::tan(trace.dip) - std::sqrt(1.5)) < 1e-12);
    // The normal makes sin 60 cos 45 = sqrt(3/8) with the tunnel.
    CHECK(std::abs(trace.sine - std::sqrt(1 - 3.0 / 8)) < 1e-12);
    CHECK(trace_in_section({90 * degree, 180 * degree}, 0).sine < 1e-12);
  }

  TEST_CASE("joints in space cross a line of the section as often as their traces do") {
    // Persistent planes s apart, against lines in the section at right angles to the traces.
    const Domain<3> ground{{-60, -60, -60}, {60, 60, 60}};
    for (const double towards : {70.0, 35.0, 160.0, 300.0}) {
      CAPTURE(towards);
      const SpatialJointSet set{
          .name = "J", .dip = 65 * degree, .dip_direction = towards * degree, .spacing = 1.5};
      const TraceInSection trace = trace_in_section({set.dip, set.dip_direction}, 0);
      const double sign = trace.direction == DipDirection::east ? 1 : -1;
      const Vec3 across(sign * std::sin(trace.dip), 0, std::cos(trace.dip));
      int crossings = 0;
      for (const SpatialJoint& joint : generate(set, 0, ground, 3)) {
        const HalfSpace<3>& plane = joint.trace.plane;
        const double t = plane.offset / plane.normal.dot(across);
        crossings += std::abs(t) < 50 ? 1 : 0;
      }
      CHECK(std::abs(crossings - 100 * trace.sine / set.spacing) <= 1);  // either end of the line
    }
  }
}

}  // namespace trace_in_section_test
