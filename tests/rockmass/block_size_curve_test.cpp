// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/rockmass/block_size_curve.hpp>
#include <voussoir/rockmass/slicing.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace block_size_curve_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

/// Fully persistent planes across an axis at the places given.
void add_planes(std::vector<SpatialJoint>& joints, int axis, const std::vector<double>& places) {
  for (const double place : places) {
    Vec3 normal = Vec3::Zero();
    normal[axis] = 1;
    joints.push_back({unbounded_joint(Vec3(place * normal), normal), axis});
  }
}

}  // namespace

TEST_SUITE("rockmass/block_size_curve") {
  TEST_CASE("a grid of cubes: 27 of 8 m3 inside, and the shell of 98 is left out") {
    std::vector<SpatialJoint> joints;
    for (int axis = 0; axis < 3; ++axis) add_planes(joints, axis, {2, 4, 6, 8});
    const WholeBlockSizes sizes(slice<Spatial>({{0, 0, 0}, {10, 10, 10}}, joints, {}));
    CHECK(sizes.count() == 27);
    CHECK(sizes.cut_count() == 98);
    // Sums of some 100 roundings.
    CHECK(sizes.cut_measure() == near(98.0 * 8).epsilon(1e-13));
    CHECK(sizes.mean() == near(8).epsilon(1e-13));
    CHECK(sizes.median() == near(8).epsilon(1e-13));
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      CHECK(sizes.size_at(share) == near(8).epsilon(1e-13));
      CHECK(sizes.true_size_at(share) == near(8).epsilon(1e-13));
    }
    // A cube of 2 m has 8 m of 10 to lie in: 1 / 0.8^3.
    for (const WholeBlock& block : sizes.blocks())
      CHECK(block.weight == near(1 / 0.512).epsilon(1e-12));
  }

  TEST_CASE("cells of 1, 2, 3 and 4 m2: shares of the rock, by size and with the edge correction") {
    // One row of cells between 0.5 m of rock above and below; ends of 5 m are cut by the domain.
    std::vector<Joint> joints;
    for (const double y : {0.5, 1.5}) joints.push_back({{{-1, y}, {21, y}}, 0});
    for (const double x : {5.0, 9.0, 11.0, 14.0, 15.0}) joints.push_back({{{x, -1}, {x, 3}}, 1});
    const WholeBlockSizes sizes(slice<Planar>({{0, 0}, {20, 2}}, joints, {}));
    REQUIRE(sizes.count() == 4);
    CHECK(sizes.cut_count() == 14);
    CHECK(sizes.mean() == near(2.5).epsilon(1e-13));
    CHECK(sizes.median() == near(2.5).epsilon(1e-13));
    const std::vector<double> passing{0.1, 0.3, 0.6, 1.0};
    // All are 1 m high, which leaves 1 m of 2: w = 2 * 20 / (20 - l).
    double true_sum = 0;
    for (int l = 1; l <= 4; ++l) true_sum += l * 40.0 / (20 - l);
    double true_passing = 0;
    for (int l = 1; l <= 4; ++l) {
      const WholeBlock& block = sizes.blocks()[static_cast<std::size_t>(l - 1)];
      true_passing += l * 40.0 / (20 - l) / true_sum;
      CHECK(block.size == near(l).epsilon(1e-13));
      CHECK(block.passing == near(passing[static_cast<std::size_t>(l - 1)]).epsilon(1e-13));
      CHECK(block.weight == near(40.0 / (20 - l)).epsilon(1e-12));
      CHECK(block.true_passing == near(true_passing).epsilon(1e-12));
    }
    CHECK(sizes.size_at(0.05) == near(1).epsilon(1e-13));
    CHECK(sizes.size_at(0.2) == near(2).epsilon(1e-13));
    CHECK(sizes.size_at(0.5) == near(3).epsilon(1e-13));
    CHECK(sizes.size_at(0.9) == near(4).epsilon(1e-13));
    // Between the two curves, 0.6 and what the correction makes of it.
    CHECK(sizes.true_size_at(0.595) == near(4).epsilon(1e-13));
    CHECK(sizes.size_at(0.595) == near(3).epsilon(1e-13));
    CHECK_THROWS_AS((void)sizes.size_at(1.5), InvalidInput);
    CHECK_THROWS_AS((void)sizes.size_at(std::nan("")), InvalidInput);
  }

  TEST_CASE("rock without a whole block has no sizes, and says so") {
    const WholeBlockSizes sizes(slice<Planar>({{0, 0}, {4, 4}}, {{{{-1, 2}, {5, 2}}, 0}}, {}));
    CHECK(sizes.count() == 0);
    CHECK(sizes.cut_count() == 2);
    CHECK(sizes.cut_measure() == near(16).epsilon(1e-13));
    CHECK(std::isnan(sizes.mean()));
    CHECK(std::isnan(sizes.median()));
    CHECK(std::isnan(sizes.size_at(0.5)));
  }

  TEST_CASE("in windows on a large rock the edge correction finds its mean block, else too small") {
    // Blocks of the large rock that lie in a window, as if the window were the domain.
    const Domain<2> ground{{-30, -30}, {30, 30}};
    const auto rock = voussoir_test::jointed_rock(ground, 3);
    const WholeBlockSizes all(rock);
    double by_number = 0, weighted = 0, count = 0, weights = 0;
    Random random(7);
    const double side = 4;
    for (int window = 0; window < 1000; ++window) {
      // Its middle is uniform where it lies in the ground.
      const Vec2 low(-30 + random.uniform() * (60 - side), -30 + random.uniform() * (60 - side));
      RockMass<Planar> seen;
      seen.domain = {low, low + Vec2(side, side)};
      seen.cuts = rock.cuts;
      for (const auto& body : rock.bodies) {
        bool inside = true;
        for (const auto& part : body.parts)
          for (const Vec2& v : part.vertices())
            inside = inside && all_less(low, v) && all_less(v, Vec2(low + Vec2(side, side)));
        if (inside) seen.bodies.push_back(body);
      }
      const WholeBlockSizes sizes(seen);
      for (const WholeBlock& block : sizes.blocks()) {
        by_number += block.size;
        count += 1;
        weighted += block.weight * block.size;
        weights += block.weight;
      }
    }
    // 1000 windows of 16 m2 cover the rock four times; halves of them differ by 2 %.
    const double truth = all.mean();
    CHECK(weighted / weights == near(truth).epsilon(0.02));
    CHECK(by_number / count < 0.95 * truth);
  }
}

}  // namespace block_size_curve_test
