// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/scan_line.hpp>
#include <voussoir/rockmass/slicing.hpp>

#include "support/degree.hpp"
#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/solids.hpp"

namespace scan_line_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::near;

namespace {

/// Upright joints across x at the places given.
RockMass<Planar> upright(const Domain<2>& ground, const std::vector<double>& places) {
  std::vector<Joint> joints;
  for (const double x : places)
    joints.push_back({{{x, ground.low.y() - 1}, {x, ground.high.y() + 1}}, 0});
  return slice<Planar>(ground, joints, {});
}

RockMass<Spatial> cubes(double side, int count) {
  std::vector<SpatialJoint> joints;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 normal = Vec3::Zero();
    normal[axis] = 1;
    for (int k = 1; k < count; ++k)
      joints.push_back({unbounded_joint(Vec3(k * side * normal), normal), axis});
  }
  return slice<Spatial>({{0, 0, 0}, Vec3::Constant(count * side)}, joints, {});
}

}  // namespace

TEST_SUITE("rockmass/scan_line") {
  TEST_CASE("RQD of Priest & Hudson: values of their curve, and the integral it stands for") {
    CHECK(rqd_by_frequency(0) == 100);
    CHECK(rqd_by_frequency(10) == near(200 / std::exp(1.0)).epsilon(1e-12));  // 73.6 %
    // The share of an exponential distribution in spacings above 0.1 m, by the midpoint rule in
    // steps of a millimetre: off by (0.001 lambda)^2 / 24.
    for (const double frequency : {2.0, 8.0, 25.0}) {
      double longer = 0;
      for (double x = 0.1005; x < 40 / frequency + 0.1; x += 0.001)
        longer += 0.001 * x * frequency * frequency * std::exp(-frequency * x);
      CHECK(rqd_by_frequency(frequency) == near(100 * longer).epsilon(1e-4));
    }
    CHECK_THROWS_AS((void)rqd_by_frequency(-1), InvalidInput);
    CHECK_THROWS_AS((void)rqd_by_frequency(std::nan("")), InvalidInput);
  }

  TEST_CASE("RQD by Jv: 110 - 2.5 Jv between 0 and 100") {
    CHECK(rqd_by_volumetric_count(4) == 100);
    CHECK(rqd_by_volumetric_count(20) == 60);
    CHECK(rqd_by_volumetric_count(44) == 0);
    CHECK(rqd_by_volumetric_count(80) == 0);
    CHECK_THROWS_AS((void)rqd_by_volumetric_count(-1), InvalidInput);
  }

  TEST_CASE("core of 3 m with pieces counted by hand") {
    // 1 | 0.05 | 0.1 | 0.35 | 0.09 | 1.41 m; 0.14 m of them are in pieces below 0.1 m.
    const auto mass = upright({{0, 0}, {3, 1}}, {1, 1.05, 1.15, 1.5, 1.59});
    ScanLineLog log;
    add_scan_line(mass, {{-2, 0.5}, {9, 0.5}}, log);
    CHECK(log.joints == 5);
    CHECK(log.spacings == 4);
    CHECK(log.length == near(3).epsilon(1e-13));
    CHECK(log.frequency() == near(5.0 / 3).epsilon(1e-13));
    CHECK(log.mean_spacing() == near(0.59 / 4).epsilon(1e-13));
    CHECK(log.rqd() == near(100 * 2.86 / 3).epsilon(1e-13));
    CHECK(log.theoretical_rqd() == rqd_by_frequency(log.frequency()));
  }

  TEST_CASE("spacings of exactly 0.1 m count, those of 0.099 m do not") {
    for (const double spacing : {0.1, 0.099}) {
      std::vector<double> places;
      for (int k = 1; k < 40; ++k) places.push_back(k * spacing);
      const auto mass = upright({{0, 0}, {40 * spacing, 1}}, places);
      ScanLineLog log;
      add_scan_line(mass, {{-1, 0.5}, {9, 0.5}}, log);
      CHECK(log.joints == 39);
      CHECK(log.rqd() == (spacing < 0.1 ? 0.0 : near(100).epsilon(1e-12)));
    }
  }

  TEST_CASE("an opening ends the core but is no joint; without rock nothing is said") {
    const auto whole = upright({{-5, -5}, {5, 5}}, {-3, -2, 3});
    const SimplePolygon opening({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
    const auto mass = carve(whole, opening, 0);
    ScanLineLog log;
    add_scan_line(mass, {{-4, 0.25}, {4, 0.25}}, log);
    CHECK(log.joints == 3);
    CHECK(log.spacings == 1);  // between -3 and -2; 1 to 3 and 3 to 4 have one joint alone
    CHECK(log.mean_spacing() == near(1).epsilon(1e-13));
    CHECK(log.length == near(6).epsilon(1e-13));
    CHECK(log.rqd() == near(100).epsilon(1e-13));
    const ScanLineLog none;
    CHECK(std::isnan(none.frequency()));
    CHECK(std::isnan(none.rqd()));
    CHECK(std::isinf(none.mean_spacing()));
  }

  TEST_CASE("a grid of cubes: 1 / s along the axes, Jv = 3 / s") {
    const double side = 0.5;
    const auto mass = cubes(side, 8);
    for (int axis = 0; axis < 3; ++axis) {
      const auto lines = lines_along<Spatial>(mass.domain, axis, 3);
      REQUIRE(lines.size() == 9);
      const ScanLineLog log = scan_line_log<Spatial>(mass, lines);
      CHECK(log.length == near(36).epsilon(1e-12));
      CHECK(log.joints == 63);  // 7 between 8 cubes, which is short of 1 / s by an eighth
      CHECK(log.mean_spacing() == near(side).epsilon(1e-12));
    }
    const auto sets = set_frequencies(mass);
    REQUIRE(sets.size() == 3);
    for (const auto& set : sets) {
      CHECK(set.frequency == near(7.0 / 4).epsilon(1e-12));
      CHECK(set.area_density == near(7.0 / 4).epsilon(1e-12));
      CHECK(std::abs(set.normal[set.set]) == near(1).epsilon(1e-12));
    }
    CHECK(volumetric_joint_count(sets) == near(21.0 / 4).epsilon(1e-12));
    const Vec3 diagonal = Vec3::Constant(1 / std::sqrt(3.0));
    CHECK(mean_frequency<Spatial>(mass, diagonal) == near(std::sqrt(3.0) * 7 / 4).epsilon(1e-12));
  }

  TEST_CASE(
      "the lines are inside, parallel and even, and what is not a number of lines is refused") {
    const Domain<2> ground{{-3, 1}, {5, 4}};
    const auto level = lines_along<Planar>(ground, 0, 3);
    REQUIRE(level.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(level[k].start == Vec2(-3, 1.5 + static_cast<double>(k)));
      CHECK(level[k].end == Vec2(5, 1.5 + static_cast<double>(k)));
    }
    const auto up = lines_along<Planar>(ground, 1, 2);
    REQUIRE(up.size() == 2);
    CHECK(up[1].start == Vec2(3, 1));
    CHECK(up[1].end == Vec2(3, 4));
    CHECK_THROWS_AS((void)lines_along<Planar>(ground, 2, 2), InvalidInput);
    CHECK_THROWS_AS((void)lines_along<Planar>(ground, 0, 0), InvalidInput);
  }

  TEST_CASE("scan lines agree with the frequency from the areas of joints: 2-D and 3-D") {
    const auto section = voussoir_test::jointed_rock({{-15, -15}, {15, 15}}, 5);
    for (int axis = 0; axis < 2; ++axis) {
      const auto lines = lines_along<Planar>(section.domain, axis, 200);
      const ScanLineLog log = scan_line_log<Planar>(section, lines);
      Vec2 along = Vec2::Zero();
      along[axis] = 1;
      // Lines 0.15 m apart miss or hit the ends of joints of a metre by chance: some 5000
      // crossings.
      CHECK(log.frequency() == near(mean_frequency<Planar>(section, along)).epsilon(0.01));
    }
    const auto mass = voussoir_test::jointed_mass({{0, 0, 0}, {12, 12, 12}}, 2, 1.1);
    for (int axis = 0; axis < 3; ++axis) {
      const auto lines = lines_along<Spatial>(mass.domain, axis, 20);
      const ScanLineLog log = scan_line_log<Spatial>(mass, lines);
      Vec3 along = Vec3::Zero();
      along[axis] = 1;
      CHECK(log.frequency() == near(mean_frequency<Spatial>(mass, along)).epsilon(0.01));
    }
    // Jv is that of the sets asked for, 3 / 1.1 m, but for a joint a set in 12 m.
    CHECK(volumetric_joint_count(set_frequencies(mass)) == near(3 / 1.1).epsilon(0.05));
  }

  TEST_CASE("two joints of one set, 20 degrees up and down: cos 20 of their length counts") {
    const double rise = 6 * std::tan(20 * degree);
    const auto mass = slice<Planar>(
        {{-5, -5}, {5, 5}},
        {{{{-6, 2.5 - rise}, {6, 2.5 + rise}}, 4}, {{{-6, -2.5 + rise}, {6, -2.5 - rise}}, 4}}, {});
    const auto sets = set_frequencies(mass);
    REQUIRE(sets.size() == 1);
    CHECK(sets[0].set == 4);
    CHECK((sets[0].normal - Vec2(0, 1)).norm() < 1e-12);
    CHECK(sets[0].frequency == near(0.2).epsilon(1e-12));  // any upright line crosses two in 10 m
    CHECK(sets[0].area_density == near(0.2 / std::cos(20 * degree)).epsilon(1e-12));
  }

  TEST_CASE("the mean normal of a set is that asked for, upward") {
    const auto mass = voussoir_test::jointed_mass({{0, 0, 0}, {12, 12, 12}}, 2, 1.1);
    const auto expected = voussoir_test::three_sets(1.1);
    const auto sets = set_frequencies(mass);
    REQUIRE(sets.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 normal = upward_normal({expected[k].dip, expected[k].dip_direction});
      CHECK(sets[k].normal.z() > 0);
      // Mean of ten planes that scatter by 1 degree in dip and direction: three deviations.
      CHECK(std::acos(std::min(1.0, sets[k].normal.dot(normal))) < 1.3 * degree);
      CHECK(sets[k].frequency <= sets[k].area_density);
      CHECK(sets[k].frequency > 0.999 * sets[k].area_density);  // 1 - (1 deg)^2
    }
  }
}

}  // namespace scan_line_test
