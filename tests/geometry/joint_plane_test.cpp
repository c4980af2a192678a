// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/joint_plane.hpp>

namespace joint_plane_test {

using namespace voussoir;

namespace {

Vec3 random_direction(Random& random) {
  Vec3 v;
  do v = Vec3{random.normal(), random.normal(), random.normal()};
  while (v.norm() < 0.1);
  return v.normalized();
}

Vec3 random_point(Random& random, double size) {
  const double x = random.uniform() - 0.5, y = random.uniform() - 0.5, z = random.uniform() - 0.5;
  return size * Vec3(x, y, z);
}

template <class Call>
std::string refusal(Call&& call) {
  try {
    (void)call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("geometry/joint_plane") {
  TEST_CASE("a disc has the area of its circle, its plane and corners just outside the circle") {
    Random random(1);
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 centre = random_point(random, 20), normal = random_direction(random);
      const double diameter = 0.1 + 5 * random.uniform();
      const JointPlane disc = joint_disc(centre, 3 * normal, diameter);
      REQUIRE(disc.corners.size() == disc_corners);
      CHECK((disc.plane.normal - normal).norm() < 1e-15);
      // 32 triangles, each rounded at 10 m.
      CHECK(std::abs(disc.area() / (0.25 * std::numbers::pi * diameter * diameter) - 1) < 1e-13);
      Vec3 sum = Vec3::Zero();
      for (const Vec3& corner : disc.corners) {
        CHECK(std::abs(disc.plane.distance(corner)) < 1e-14);
        CHECK(std::abs((corner - centre).norm() / (0.5 * diameter * disc_reach()) - 1) < 1e-13);
        sum += corner - centre;
      }
      CHECK(sum.norm() < 1e-13);
    }
    CHECK(disc_reach() > 1);
    CHECK(disc_reach() < 1.0033);
  }

  TEST_CASE("a rectangle has its sides, and its normal is along x across") {
    const JointPlane joint = joint_rectangle({1, 2, 3}, {2, 0, 0}, {0, 0, 1.5});
    CHECK(joint.plane.normal == Vec3(0, -1, 0));
    CHECK(joint.plane.offset == -2);
    CHECK(joint.area() == 12);
    CHECK(joint.corners[2] == Vec3(3, 2, 4.5));
    CHECK_FALSE(joint.is_unbounded());
  }

  TEST_CASE("a surveyed outline gives its plane in either direction of listing") {
    const JointPlane joint = joint_polygon({{0, 0, 1}, {4, 0, 1}, {4, 3, 1}, {0, 3, 1}});
    CHECK(joint.area() == 12);
    CHECK(joint.plane.normal == Vec3(0, 0, 1));
    CHECK(joint.plane.offset == 1);
    const JointPlane other = joint_polygon({{0, 3, 1}, {4, 3, 1}, {4, 0, 1}, {0, 0, 1}});
    CHECK(other.area() == 12);
    CHECK(other.plane.normal == Vec3(0, 0, -1));
  }

  TEST_CASE("joints that are none are refused, and the corner or value named") {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    CHECK(contains(refusal([&] {
                     return joint_disc({0, 0, 0}, {0, 0, 1}, 0);
                   }),
                   "diameter 0 m must be > 0"));
    CHECK(contains(refusal([&] { return joint_disc({0, 0, 0}, {0, 0, 1}, nan); }), "diameter"));
    CHECK(contains(refusal([&] { return joint_disc({0, 0, 0}, {0, 0, 1}, inf); }), "diameter inf"));
    CHECK(contains(refusal([&] { return joint_disc({0, 0, 0}, {0, 0, 0}, 1); }), "(0, 0, 0)"));
    CHECK(contains(refusal([&] { return unbounded_joint({0, nan, 0}, {0, 0, 1}); }), "finite"));
    CHECK(contains(refusal([&] { return unbounded_joint({0, 0, 0}, {0, inf, 1}); }), "inf"));
    CHECK(contains(refusal([&] {
                     return joint_rectangle({0, 0, 0}, {1, 0, 0}, {0.1, 1, 0});
                   }),
                   "perpendicular"));
    CHECK(contains(refusal([&] {
                     return joint_rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, 0});
                   }),
                   "length > 0"));
    const auto outline = [](std::vector<Vec3> corners) {
      return refusal([&] { return joint_polygon(corners); });
    };
    CHECK(outline({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == "accepted");
    CHECK(contains(outline({{0, 0, 0}, {1, 0, 0}}), "at least 3"));
    CHECK(contains(outline({{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}), "corner 1 is not finite"));
    CHECK(contains(outline({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), "no area"));
    CHECK(contains(outline({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "is repeated"));
    CHECK(contains(outline({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}), "not in the plane"));
    CHECK(
        contains(outline({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}), "corner 2 is not convex"));
    // A five-pointed star turns left everywhere, but twice round.
    std::vector<Vec3> star;
    for (int k = 0; k < 5; ++k) {
      const double angle = 0.8 * std::numbers::pi * k;
      star.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    CHECK(contains(outline(star), "crosses itself"));
  }

  TEST_CASE(
      "the parts on two sides of a plane have the area of the whole, and lie on their sides") {
    Random random(2);
    int divided = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const JointPlane joint =
          joint_disc(random_point(random, 2), random_direction(random), 0.5 + random.uniform());
      const auto side = HalfSpace<3>::through(random_point(random, 2), random_direction(random));
      const JointPlaneSplit parts = split(joint, side, 1e-12);
      double area = 0;
      for (const auto& [part, sign] : {std::pair(parts.below, -1.0), std::pair(parts.above, 1.0)})
        if (part) {
          area += part->area();
          CHECK(part->plane.normal == joint.plane.normal);
          for (const Vec3& corner : part->corners) CHECK(sign * side.distance(corner) > -2e-12);
        }
      divided += parts.below && parts.above ? 1 : 0;
      CHECK(std::abs(area - joint.area()) < 1e-14);  // about 1 m2 of triangles
    }
    CHECK(divided > 100);
  }

  TEST_CASE("what reaches less far than the tolerance from the plane is not counted") {
    const JointPlane joint = joint_rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const double tolerance = 1e-9;
    const auto parts_at = [&](double x) {
      return split(joint, HalfSpace<3>{{1, 0, 0}, x}, tolerance);
    };
    CHECK_FALSE(parts_at(1 - 0.9e-9).above);
    CHECK(parts_at(1 - 0.9e-9).below->area() == joint.area());  // untouched
    CHECK(parts_at(1 - 1.1e-9).above);
    CHECK_FALSE(parts_at(-1 + 0.9e-9).below);
    // In the plane itself: on neither side.
    const JointPlaneSplit flat = split(joint, HalfSpace<3>{{0, 0, 1}, 0.5e-9}, tolerance);
    CHECK_FALSE(flat.below);
    CHECK_FALSE(flat.above);
  }

  TEST_CASE("a plane through corners divides a joint at them") {
    const JointPlane square = joint_rectangle({0, 0, 3}, {1, 0, 0}, {0, 1, 0});
    const JointPlaneSplit halves =
        split(square, HalfSpace<3>::through({0, 0, 0}, Vec3(1, -1, 0.0).normalized()), 1e-9);
    REQUIRE((halves.below && halves.above));
    for (const JointPlane& half : {*halves.below, *halves.above}) {
      CHECK(half.corners.size() == 3);
      CHECK(std::abs(half.area() - 2) < 1e-15);
    }
    // Through one corner and the middle of a side.
    const JointPlaneSplit parts =
        split(square, HalfSpace<3>::through({-1, -1, 0}, Vec3(1, -2, 0).normalized()), 1e-9);
    REQUIRE((parts.below && parts.above));
    CHECK(std::abs(parts.below->area() - 3) < 1e-15);
    CHECK(std::abs(parts.above->area() - 1) < 1e-15);
  }

  TEST_CASE("a fully persistent joint covers any ball, and stays in its plane") {
    Random random(3);
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 point = random_point(random, 30), centre = random_point(random, 30);
      const JointPlane endless = unbounded_joint(point, random_direction(random));
      CHECK(endless.is_unbounded());
      CHECK(std::isinf(endless.area()));
      const JointPlane square = covering(endless, centre, 10);
      CHECK(std::abs(square.area() - 400) < 1e-11);
      const Vec3 foot = centre - endless.plane.distance(centre) * endless.plane.normal;
      for (std::size_t k = 0; k < 4; ++k) {
        CHECK(std::abs(endless.plane.distance(square.corners[k])) < 1e-13);
        // Every side is 10 m from the point of the plane nearest to the centre.
        const Vec3 along = (square.corners[(k + 1) % 4] - square.corners[k]).normalized();
        const Vec3 out = cross(along, endless.plane.normal);
        CHECK(std::abs(out.dot(square.corners[k] - foot) - 10) < 1e-12);
      }
    }
    const JointPlane disc = joint_disc({0, 0, 0}, {0, 0, 1}, 1);
    CHECK(covering(disc, {0, 0, 0}, 10).corners == disc.corners);
  }
}

}  // namespace joint_plane_test
