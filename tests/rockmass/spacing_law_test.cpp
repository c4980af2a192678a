// SPDX-License-Identifier: MIT
// Distances between joints that go right through: their distribution, and that no stretch of the
// rock has more of them than another, in 2-D and 3-D.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/spacing_law.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/statistics/sample.hpp>

#include "support/degree.hpp"

namespace spacing_law_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

constexpr double mean = 0.8, reach = 40;
struct Kind {
  SpacingLaw law;
  double deviation;  // given
  double expected;   // standard deviation over the mean
};
const Kind kinds[] = {{SpacingLaw::fixed, 0, 0},
                      {SpacingLaw::exponential, 0, 1},
                      {SpacingLaw::lognormal, 0.5, 0.5},
                      {SpacingLaw::lognormal, 1.2, 1.2}};

std::vector<double> places(const Kind& kind, std::uint64_t seed) {
  Random random(seed, 1);
  return detail::joint_places(kind.law, mean, kind.deviation, reach, random);
}

}  // namespace

TEST_SUITE("rockmass/spacing_law") {
  TEST_CASE("mean and deviation of the spacings are those asked for") {
    for (const Kind& kind : kinds) {
      CAPTURE(static_cast<int>(kind.law));
      double sum = 0, squares = 0, count = 0;
      for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        const auto at = places(kind, seed);
        for (std::size_t k = 1; k < at.size(); ++k) {
          const double spacing = at[k] - at[k - 1];
          CHECK_MESSAGE(spacing > 0, seed);
          sum += spacing;
          squares += spacing * spacing;
          ++count;
        }
      }
      const double found = sum / count,
                   deviation = std::sqrt(std::max(0.0, squares / count - found * found));
      // Spacings that reach beyond the line are missing: long ones, one in a hundred.
      const double few = mean / (2 * reach) * (1 + kind.expected * kind.expected);
      CHECK(std::abs(found - mean) < mean * (few + 4 * kind.expected / std::sqrt(count) + 1e-12));
      CHECK(std::abs(deviation - kind.expected * mean) <
            mean * (0.02 + 4 * few) * kind.expected + 1e-6);
    }
  }

  TEST_CASE("a negative exponential: as many below each quantile as there should be") {
    std::vector<double> spacings;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      const auto at = places(kinds[1], seed);
      for (std::size_t k = 1; k < at.size(); ++k) spacings.push_back(at[k] - at[k - 1]);
    }
    const auto n = static_cast<double>(spacings.size());
    for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const double quantile = -mean * std::log(1 - part);
      const auto below = static_cast<double>(
          std::count_if(spacings.begin(), spacings.end(), [&](double s) { return s < quantile; }));
      // Four standard errors, and those cut off by the ends.
      CHECK(std::abs(below / n - part) < 4 * std::sqrt(part * (1 - part) / n) + 0.01);
    }
  }

  TEST_CASE("every metre has as many, next to the ends too") {
    for (const Kind& kind : kinds) {
      CAPTURE(static_cast<int>(kind.law));
      constexpr int bins = 20, seeds = 4000;
      std::vector<double> found(bins, 0.0);
      for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        for (const double place : places(kind, seed))
          found[static_cast<std::size_t>(
              std::min(bins - 1.0, (place + reach) / (2 * reach) * bins))] += 1;
      const double expected = seeds * 2 * reach / bins / mean;
      for (const double in_bin : found)
        // Counts spread by the deviation of the spacings; five standard errors.
        CHECK(std::abs(in_bin - expected) < 5 * std::sqrt(expected) * std::max(0.3, kind.expected));
    }
  }

  TEST_CASE("a set has it in the section and in 3-D, as far apart in the mean") {
    const Domain<2> section{{-30, -30}, {30, 30}};
    const Domain<3> box{{-30, -30, -30}, {30, 30, 30}};
    for (const Kind& kind : kinds) {
      double joints = 0, planes = 0;
      for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        JointSet set{"S", 0, DipDirection::east, 0, 0, mean};
        set.spacing_law = kind.law;
        set.spacing_deviation = kind.deviation;
        for (const Joint& joint : generate(set, 0, section, seed)) {
          const double y = joint.trace.centre().y();
          joints += std::abs(y) < 30;
        }
        SpatialJointSet level{"S", 0, 0};
        level.spacing = mean;
        level.spacing_law = kind.law;
        level.spacing_deviation = kind.deviation;
        planes += static_cast<double>(generate(level, 0, box, seed).size());
      }
      const double expected = 300 * 60 / mean;
      CHECK(std::abs(joints - expected) < 5 * std::sqrt(expected) * std::max(0.2, kind.expected));
      CHECK(std::abs(planes - expected) < 5 * std::sqrt(expected) * std::max(0.2, kind.expected));
    }
  }

  TEST_CASE("what does not fit is refused") {
    const Domain<2> section{{-3, -3}, {3, 3}};
    JointSet set{"S", 0, DipDirection::east, 0, 0, mean};
    set.spacing_law = SpacingLaw::lognormal;
    CHECK_THROWS_AS((void)generate(set, 0, section, 1), InvalidInput);
    set.spacing_deviation = 0.5;
    CHECK_NOTHROW((void)generate(set, 0, section, 1));
    set.extent = 2;
    CHECK_THROWS_AS((void)generate(set, 0, section, 1), InvalidInput);
    set.extent = std::numeric_limits<double>::infinity();
    set.spacing_law = SpacingLaw::exponential;
    CHECK_THROWS_AS((void)generate(set, 0, section, 1), InvalidInput);
    SpatialJointSet planes{"S", 0, 0};
    planes.area_per_volume = 1;
    planes.spacing_law = SpacingLaw::exponential;
    CHECK_THROWS_AS(planes.check(), InvalidInput);
  }
}

}  // namespace spacing_law_test
