// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/statistics.hpp>

#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/solids.hpp"

namespace spatial_statistics_test {

using namespace voussoir;
using voussoir_test::jointed_mass;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Domain<3> cube{{-10, -10, -10}, {10, 10, 10}};

/// Equidistant joints without end or scatter.
RockMass<Spatial> layers(double dip, double dip_direction, double spacing, std::uint64_t seed = 1) {
  auto set = voussoir_test::spaced_set(dip, dip_direction, spacing);
  set.dip_deviation = set.dip_direction_deviation = 0;
  return slice<Spatial>(cube, joint_network({set}, cube, seed), {});
}

/// Level joints at the heights given.
RockMass<Spatial> level(const Domain<3>& ground, const std::vector<double>& heights) {
  std::vector<SpatialJoint> joints;
  for (const double z : heights) joints.push_back({unbounded_joint({0, 0, z}, {0, 0, 1}), 0});
  return slice<Spatial>(ground, joints, {});
}

}  // namespace

TEST_SUITE("rockmass/spatial_statistics") {
  TEST_CASE("an equidistant set: spacing s along its normal, s / cos t at the angle t to it") {
    const double s = 0.7;
    const auto mass = layers(55, 320, s);
    const Vec3 normal = upward_normal({55 * degree, 320 * degree});
    const Vec3 across = tangent_basis(normal).col(0);
    for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
      CAPTURE(angle);
      const Vec3 along = std::cos(angle * degree) * normal + std::sin(angle * degree) * across;
      const double expected = s / std::cos(angle * degree);
      // From the middle of a layer to the middle of another: exactly as many joints as spacings.
      const int joints = 2 * static_cast<int>(8 / expected);
      double to_middle = 0;
      for (const SpatialJoint& joint : mass.joints) {
        const double d = joint.trace.plane.distance({0, 0, 0});
        if (std::abs(d) < s) to_middle = 0.5 * s - d;
      }
      const Vec3 start = to_middle * normal - 0.5 * joints * expected * along;
      const double found =
          scanline_spacing(mass, SpatialLine{start, start + joints * expected * along});
      CHECK(std::abs(found - expected) < 1e-12);
    }
    CHECK(std::isinf(scanline_spacing(mass, SpatialLine{-5 * across, 5 * across})));
  }

  TEST_CASE("three sets: a scanline meets sum |n.d| / s joints per metre") {
    // Each set misses its mean number by less than one, and its normals scatter by 1 degree.
    const auto mass = jointed_mass(cube, 1, 1.5);
    Random random(1);
    for (int trial = 0; trial < 30; ++trial) {
      const Vec3 along = voussoir_test::random_direction(random);
      Scanline found;
      scan(mass, SpatialLine{-9 * along, 9 * along}, found);
      double expected = 0;
      for (const auto& set : voussoir_test::three_sets(1.5))
        expected += 18 / 1.5 * std::abs(along.dot(upward_normal({set.dip, set.dip_direction})));
      CHECK(std::abs(found.length - 18) < 1e-9);
      CHECK(std::abs(static_cast<double>(found.joints) - expected) < 4);
    }
  }

  TEST_CASE("a line runs through rock without gap or overlap, in the bodies it names") {
    const auto mass = jointed_mass(cube, 2, 1.8, {0.1, 10}, DiscJoints{6});
    const double slack = 4 * cube.tolerance();
    Random random(2);
    for (int trial = 0; trial < 30; ++trial) {
      const Vec3 low = Vec3::Constant(-9.9), high = Vec3::Constant(9.9);
      const SpatialLine line{voussoir_test::random_point(random, low, high),
                             voussoir_test::random_point(random, low, high)};
      const auto intersections = block_intersections(mass, line);
      REQUIRE_FALSE(intersections.empty());
      CHECK(intersections.front().from == 0);
      CHECK(std::abs(intersections.back().to - line.length()) < slack);
      for (std::size_t k = 0; k < intersections.size(); ++k) {
        const auto& p = intersections[k];
        if (k > 0) CHECK(std::abs(p.from - intersections[k - 1].to) < slack);
        const Vec3 middle = line.at(0.5 * (p.from + p.to) / line.length());
        CHECK(mass.bodies[static_cast<std::size_t>(p.body)].parts[0].contains(middle, slack));
      }
    }
  }

  TEST_CASE("a line along a joint, or along the line where joints meet, is in one body at a time") {
    const auto bricks = slice<Spatial>(cube,
                                       {{unbounded_joint({0, 0, 0}, {1, 0, 0}), 0},
                                        {unbounded_joint({0, 0, 0}, {0, 1, 0}), 1},
                                        {unbounded_joint({0, 0, 0}, {0, 0, 1}), 2}},
                                       {});
    for (const auto& [start, end] : {std::pair<Vec3, Vec3>{{0, -12, 3}, {0, 12, 3}},
                                     {{0, 0, 15}, {0, 0, -15}},
                                     {{-11, 0, 0}, {11, 0, 0}},
                                     {{0, -9, -9}, {0, 9, 9}}}) {
      const auto intersections = block_intersections(bricks, SpatialLine{start, end});
      REQUIRE(intersections.size() == 2);
      CHECK(intersections[0].body != intersections[1].body);
      CHECK(std::abs(intersections[0].to - intersections[1].from) < 1e-12);
      double inside = 0;
      for (const auto& p : intersections) inside += p.to - p.from;
      const double expected = std::abs(start.y()) == 9 ? 18 * std::sqrt(2.0) : 20;
      CHECK(std::abs(inside - expected) < 1e-12);
    }
  }

  TEST_CASE("P32 of a sliced mass is 1 / s, each set by itself and all together") {
    for (const double dip : {0.0, 40.0, 90.0}) {
      double sum = 0;
      const int seeds = 20;
      for (int seed = 1; seed <= seeds; ++seed)
        sum += joint_intensity(layers(dip, 75, 0.8, static_cast<std::uint64_t>(seed))) / seeds;
      // One joint more or less in 20 m: 5 % a sample at most, for level layers.
      CHECK(std::abs(sum * 0.8 - 1) < 0.02);
    }
    const auto mass = jointed_mass(cube, 3, 0.9);
    double sum = 0;
    for (int set = 0; set < 3; ++set) {
      const double of_set = joint_intensity(mass, set);
      CHECK(std::abs(of_set * 0.9 - 1) < 0.03);
      sum += of_set;
    }
    CHECK(std::abs(joint_intensity(mass) - sum) < 1e-12);
    CHECK(joint_intensity(mass, 3) == 0);
    // Three planes of 400 m2 in 8000 m3.
    CHECK(std::abs(joint_intensity(level(cube, {-5, 0, 5})) - 0.15) < 1e-15);
  }

  TEST_CASE("in a section the same function gives the length per area, P21") {
    const Domain<2> ground{{0, 0}, {10, 10}};
    const auto mass = slice(ground, {{{{-1, 1}, {11, 1}}, 0}, {{{5, 1}, {5, 2}}, 1}}, {});
    CHECK(std::abs(joint_intensity(mass, 0) - 0.1) < 1e-15);
    CHECK(std::abs(joint_intensity(mass, 1) - 0.09) < 1e-15);  // right through, 9 m
  }

  TEST_CASE("discs are lengthened to the ends of the blocks: P32 after slicing is larger") {
    std::vector<SpatialJointSet> sets = voussoir_test::three_sets(2, DiscJoints{5});
    const Domain<3> ground{{-6, -6, -6}, {6, 6, 6}};
    const auto mass = slice<Spatial>(ground, joint_network(sets, ground, 4), {});
    CHECK(joint_intensity(mass) > 1.5 * 1.05);
    CHECK(joint_intensity(mass) < 1.5 * 4);
  }

  TEST_CASE("the curve of block sizes, weighted by size: layers of known height") {
    // 1, 2, 3 and 4 m3: a tenth, three tenths, six tenths and all of the rock.
    const auto mass = level({{0, 0, 0}, {1, 1, 10}}, {4, 6, 9});
    const BlockSizeCurve curve(mass);
    REQUIRE(curve.sizes().size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(std::abs(curve.sizes()[k] - static_cast<double>(k + 1)) < 1e-14);
      CHECK(std::abs(curve.passing()[k] - std::vector{0.1, 0.3, 0.6, 1.0}[k]) < 1e-15);
    }
    CHECK(std::abs(curve.size_at(0.05) - 1) < 1e-14);
    CHECK(std::abs(curve.size_at(0.2) - 2) < 1e-14);
    CHECK(std::abs(curve.size_at(0.5) - 3) < 1e-14);
    CHECK(std::abs(curve.size_at(0.9) - 4) < 1e-14);
    CHECK(std::abs(curve.size_at(0) - 1) < 1e-14);
    CHECK(std::abs(curve.size_at(1) - 4) < 1e-14);
    CHECK_THROWS_AS((void)curve.size_at(1.1), InvalidInput);
    CHECK_THROWS_AS((void)curve.size_at(std::nan("")), InvalidInput);
    CHECK_THROWS_AS(BlockSizeCurve(RockMass<Spatial>{}), InvalidInput);
  }

  TEST_CASE("half of the rock is in blocks up to V50, and V50 is above the median") {
    const auto mass = jointed_mass(cube, 5, 1.5, {0.1, 8});
    const BlockSizeCurve curve(mass);
    for (const double part : {0.1, 0.5, 0.9}) {
      double below = 0, up_to = 0;
      for (const auto& body : mass.bodies) {
        if (body.properties.measure < curve.size_at(part)) below += body.properties.measure;
        if (body.properties.measure <= curve.size_at(part)) up_to += body.properties.measure;
      }
      CHECK(below < part * 8000);
      CHECK(up_to >= part * 8000 - 1e-9);
    }
    CHECK(curve.size_at(0.5) > block_sizes(mass).median);
    CHECK(curve.size_at(0.1) < curve.size_at(0.5));
    CHECK(curve.size_at(0.5) < curve.size_at(0.9));
    CHECK(block_sizes(mass).smallest_inscribed_radius >= 0.1 - 1e-12);
  }
}

}  // namespace spatial_statistics_test
