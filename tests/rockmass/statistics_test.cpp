// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/statistics.hpp>

#include "support/jointed_rock.hpp"
#include "support/shapes.hpp"

namespace statistics_test {

using namespace voussoir;

namespace {

/// Horizontal joints at every multiple of `spacing` inside the ground.
RockMass<Planar> layers(const Domain<2>& ground, double spacing) {
  std::vector<Joint> joints;
  for (double y = ground.low.y() + spacing; y < ground.high.y() - 0.5 * spacing; y += spacing)
    joints.push_back({{{ground.low.x() - 1, y}, {ground.high.x() + 1, y}}, 0});
  return slice(ground, joints, {});
}

}  // namespace

TEST_SUITE("rockmass/statistics") {
  TEST_CASE("the spacing on a line is its length over the joints it crosses") {
    const auto mass = layers({{0, 0}, {10, 10}}, 0.5);  // 19 joints, at 0.5 to 9.5
    CHECK(std::abs(scanline_spacing(mass, {{5, 0.1}, {5, 9.9}}) - 9.8 / 19) < 1e-14);
    CHECK(std::abs(scanline_spacing(mass, {{1, 1.25}, {4, 4.25}}) - 3 * std::sqrt(2.0) / 6) <
          1e-14);
    // What lies outside the rock does not count.
    CHECK(std::abs(scanline_spacing(mass, {{5, -7}, {5, 30}}) - 10.0 / 19) < 1e-14);
  }

  TEST_CASE("a line that crosses no joint has an infinite spacing") {
    const auto mass = layers({{0, 0}, {10, 10}}, 0.5);
    CHECK(std::isinf(scanline_spacing(mass, {{1, 1.2}, {9, 1.2}})));
    CHECK(std::isinf(scanline_spacing(mass, {{-5, 1.2}, {-1, 1.2}})));  // outside
    CHECK(std::isinf(radial_spacing(slice({{-9, -9}, {9, 9}}, {}, {}), {0, 0}, 1, 5)));
  }

  TEST_CASE("an opening on the line is not a joint") {
    const SimplePolygon opening({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
    const auto whole = carve(slice({{-5, -5}, {5, 5}}, {}, {}), opening, 0);
    CHECK(std::isinf(scanline_spacing(whole, {{-4, 0.25}, {4, 0.25}})));
    // Upright joints at x = -3, -2 and 3: two in the 3 m before the opening, one behind.
    std::vector<Joint> joints;
    for (const double x : {-3.0, -2.0, 3.0}) joints.push_back({{{x, -6}, {x, 6}}, 0});
    const auto jointed = carve(slice({{-5, -5}, {5, 5}}, joints, {}), opening, 0);
    CHECK(std::abs(scanline_spacing(jointed, {{-4, 0.25}, {4, 0.25}}) - 6.0 / 3) < 1e-14);
  }

  TEST_CASE("radial lines through layers: spacing times the mean of 1 / |sin|") {
    const double spacing = 0.1, length = 8;
    const auto mass = layers({{-12, -12}, {12, 12}}, spacing);
    double expected_crossings = 0;
    for (int k = 0; k < 72; ++k)
      expected_crossings +=
          length * std::abs(std::sin(2 * std::numbers::pi * (k + 0.5) / 72)) / spacing;
    const double found = radial_spacing(mass, {0, 0.03}, 2, length);
    // Every line misses its mean number of crossings by less than one: 72 of some 3700, 2 %.
    CHECK(std::abs(72 * length / found - expected_crossings) < 72);
    // The mean of |sin| over all directions is 2 / pi.
    CHECK(std::abs(found - 0.5 * std::numbers::pi * spacing) < 0.02 * found + 1e-3 * found);
  }

  TEST_CASE("block sizes: three layers of known height") {
    const Domain<2> ground{{0, 0}, {10, 10}};
    const auto mass = slice(ground, {{{{-1, 1}, {11, 1}}, 0}, {{{-1, 4}, {11, 4}}, 0}}, {});
    const BlockSizes sizes = block_sizes(mass);  // 10, 30 and 60 m2
    CHECK(sizes.count == 3);
    CHECK(std::abs(sizes.smallest - 10) < 1e-13);
    CHECK(std::abs(sizes.median - 30) < 1e-13);
    CHECK(std::abs(sizes.largest - 60) < 1e-13);
    CHECK(std::abs(sizes.mean - 100.0 / 3) < 1e-13);
    CHECK(std::abs(sizes.smallest_inscribed_radius - 0.5) < 1e-14);
  }

  TEST_CASE(
      "the mean size times the count is the ground, and the smallest radius obeys the limit") {
    const auto mass = voussoir_test::jointed_rock({{-10, -10}, {10, 10}}, 1);
    const BlockSizes sizes = block_sizes(mass);
    CHECK(std::abs(sizes.mean * static_cast<double>(sizes.count) - 400) < 1e-10);
    CHECK(sizes.smallest_inscribed_radius >= 0.25 - 1e-12);
    CHECK(sizes.smallest_inscribed_radius < 0.26);  // of 500 blocks one comes close to the limit
    CHECK(sizes.smallest >= std::numbers::pi * 0.25 * 0.25);  // it holds its circle
    CHECK(sizes.smallest < sizes.median);
    CHECK(sizes.median < sizes.largest);
  }
}

}  // namespace statistics_test
