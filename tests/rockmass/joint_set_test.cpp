// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/rockmass/joint_set.hpp>

#include "support/jointed_rock.hpp"
#include "support/reference.hpp"

namespace joint_set_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::reference;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

std::string refusal(const JointSet& set) {
  try {
    set.check();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

/// Angle of a trace below the horizontal, towards the right.
double dip_to_the_right(const Joint& joint) {
  const Vec2 along = joint.trace.end - joint.trace.start;
  return std::atan2(-along.y(), along.x());
}

std::vector<double> dips(const std::vector<Joint>& joints) {
  std::vector<double> all;
  for (const Joint& joint : joints) all.push_back(dip_to_the_right(joint));
  return all;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - centre) * (v - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace

TEST_SUITE("rockmass/joint_set") {
  TEST_CASE("a set out of range is refused by name and rule") {
    const JointSet good{"bedding", 0.3, DipDirection::east, 0.01, 1, 0, 2};
    CHECK(refusal(good) == "accepted");
    const auto refused = [&](auto change, const std::string& rule) {
      JointSet set = good;
      change(set);
      CHECK(refusal(set) == "joint set bedding: " + rule);
    };
    const double nan = std::nan("");
    const std::string dips = " deg): must be 0 to 1.5708 rad (0 to 90 deg)";
    refused([](JointSet& s) { s.dip = -0.01; }, "dip = -0.01 rad (-0.572958" + dips);
    refused(
        [](JointSet& s) { s.dip = 1.6; },
        "dip = 1.6 rad (91.6732" + dips + "; the same joint dips 88.3268 deg to the other side");
    refused([](JointSet& s) { s.dip = 2 * std::numbers::pi / 3; },
            "dip = 2.0944 rad (120" + dips + "; the same joint dips 60 deg to the other side");
    refused([](JointSet& s) { s.dip = 75; },
            "dip = 75 rad (4297.18" + dips + "; did you mean 75 deg = 1.309 rad?");
    refused([=](JointSet& s) { s.dip = nan; }, "dip = nan rad (nan" + dips);
    const std::string deviations = " deg): must be 0 to 0.785398 rad (0 to 45 deg)";
    refused(
        [](JointSet& s) { s.dip_deviation = 2; },
        "dip_deviation = 2 rad (114.592" + deviations + "; did you mean 2 deg = 0.0349066 rad?");
    refused([](JointSet& s) { s.dip_deviation = -1; },
            "dip_deviation = -1 rad (-57.2958" + deviations);
    for (const double sd : {-1e-9, inf, nan}) {
      JointSet set = good;
      set.dip_deviation = sd;
      CHECK(refusal(set).find("dip_deviation = ") != std::string::npos);
    }
    const auto densities = [](const char* intensity, const char* spacing) {
      return std::string("intensity = ") + intensity + " /m^2 and spacing = " + spacing + " m: ";
    };
    const std::string one = "one of the two must be > 0, the other 0";
    refused([](JointSet& s) { s.spacing = 1; }, densities("1", "1") + one);
    refused([](JointSet& s) { s.intensity = 0; }, densities("0", "0") + one);
    refused([=](JointSet& s) { s.intensity = nan; }, densities("nan", "0") + one);
    refused([](JointSet& s) { s.intensity = inf; }, densities("inf", "0") + "must be finite");
    refused([](JointSet& s) { s.extent = 0; }, "extent = 0 m: must be > 0");
    refused([](JointSet& s) { s.extent = -1; }, "extent = -1 m: must be > 0");
    refused([=](JointSet& s) { s.extent = nan; }, "extent = nan m: must be > 0");
    refused(
        [=](JointSet& s) { s.extent = inf; },
        "intensity = 1 /m^2 counts centres per area, and how far apart endless joints lie would "
        "hang on the size of the domain: give them an extent, or a spacing in place of the "
        "intensity");
    JointSet vertical = good;
    vertical.dip = 90 * degree;
    CHECK(refusal(vertical) == "accepted");
  }

  TEST_CASE("east dips to the right, west to the left, as steeply as asked") {
    const Domain<2> ground{{0, 0}, {10, 10}};
    for (const double dip : {0.0, 25.0, 75.0, 90.0}) {
      CAPTURE(dip);
      const auto east = generate({"E", dip * degree, DipDirection::east, 0, 1, 0, 1}, 0, ground, 1);
      const auto west = generate({"W", dip * degree, DipDirection::west, 0, 1, 0, 1}, 0, ground, 1);
      const Vec2 down_east(std::cos(dip * degree), -std::sin(dip * degree));
      const Vec2 down_west(-down_east.x(), down_east.y());
      REQUIRE(east.size() == 100);
      REQUIRE(west.size() == 100);
      for (std::size_t k = 0; k < east.size(); ++k) {  // traces of 1 m, centred at up to 10 m
        CHECK((east[k].trace.end - east[k].trace.start - down_east).norm() < 1e-14);
        CHECK((west[k].trace.end - west[k].trace.start - down_west).norm() < 1e-14);
      }
    }
  }

  TEST_CASE("number, length, and label of joints of finite extent") {
    const Domain<2> ground{{-10, -5}, {10.3, 12}};  // 20.3 x 17 = 345.1 m2
    const auto joints = generate({"J", 0.4, DipDirection::east, 0.1, 0.7, 0, 3}, 5, ground, 2);
    CHECK(joints.size() == 242);  // 0.7 * 345.1 = 241.57
    for (const Joint& joint : joints) {
      CHECK(joint.set == 5);
      CHECK(std::abs(joint.trace.length() - 3) < 1e-14);
    }
    // Spacing s and extent L: 1/(s L) centres per area. 345.1 / (0.5 * 4) = 172.55.
    CHECK(generate({"J", 0.4, DipDirection::east, 0, 0, 0.5, 4}, 0, ground, 2).size() == 173);
  }

  TEST_CASE("dips have the mean and the deviation asked for") {
    const Domain<2> ground{{0, 0}, {70, 60}};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(seed);
      const auto sample = dips(
          generate({"J", 30 * degree, DipDirection::east, 4 * degree, 1, 0, 1}, 0, ground, seed));
      const auto n = static_cast<double>(sample.size());
      REQUIRE(n == 4200);
      // Standard errors: sigma / sqrt(n) of the mean, sigma / sqrt(2 n) of the deviation; three of
      // them.
      CHECK(std::abs(mean(sample) - 30 * degree) < 3 * 4 * degree / std::sqrt(n));
      CHECK(std::abs(deviation(sample) - 4 * degree) < 3 * 4 * degree / std::sqrt(2 * n));
    }
  }

  TEST_CASE("centres are uniform over the domain") {
    const Domain<2> ground{{-35, -35}, {35, 25}};
    const auto joints = generate({"J", 0.4, DipDirection::west, 0.02, 1, 0, 1}, 1, ground, 3);
    std::array<int, 70> cells{};  // 10 x 7 cells
    for (const Joint& joint : joints) {
      const Vec2 at = (joint.trace.centre() - ground.low).cwiseQuotient(ground.size());
      REQUIRE(at.minCoeff() >= 0);
      REQUIRE(at.maxCoeff() <= 1);
      const auto column = std::min(static_cast<std::size_t>(10 * at.x()), std::size_t{9});
      const auto row = std::min(static_cast<std::size_t>(7 * at.y()), std::size_t{6});
      ++cells[7 * column + row];
    }
    const double expected = 4200.0 / 70;
    double chi_squared = 0;
    for (const int n : cells) chi_squared += (n - expected) * (n - expected) / expected;
    CHECK(chi_squared < 111.06);  // 69 degrees of freedom, 0.1 %
    CHECK(chi_squared > 38.3);    // 99.9 %: a lattice would be too even
  }

  TEST_CASE("a persistent set with a spacing is equidistant and covers the domain") {
    const Domain<2> ground{{-30, -10}, {20, 30}};
    const double dip = 25 * degree;
    const auto joints = generate({"J", dip, DipDirection::east, 0, 0, 1.25, inf}, 0, ground, 4);
    const Vec2 normal(std::sin(dip), std::cos(dip));
    std::vector<double> offsets;
    for (const Joint& joint : joints) {
      offsets.push_back(normal.dot(joint.trace.start));
      CHECK(std::abs(normal.dot(joint.trace.end) - offsets.back()) < 1e-13);
      // Longer than any chord of the domain, to both sides.
      CHECK((joint.trace.start - ground.low).norm() > 0.5 * ground.diameter());
      CHECK(joint.trace.length() > 2 * ground.diameter());
    }
    std::sort(offsets.begin(), offsets.end());
    for (std::size_t k = 1; k < offsets.size(); ++k)
      CHECK(std::abs(offsets[k] - offsets[k - 1] - 1.25) < 1e-12);
    // Every corner lies between two joints or less than a spacing beyond the outermost.
    const ConvexPolygon outline = as_block(ground);
    for (const Vec2& corner : outline.vertices()) {
      CHECK(normal.dot(corner) > offsets.front() - 1.25);
      CHECK(normal.dot(corner) < offsets.back() + 1.25);
    }
  }

  TEST_CASE("along a diagonal of the domain an equidistant set goes from corner to corner") {
    const Domain<2> ground{{0, 0}, {10, 10}};
    const Vec2 normal = Vec2(1, 1).normalized();
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      double lowest = inf, highest = -inf;
      for (const Joint& joint :
           generate({"J", 45 * degree, DipDirection::east, 0, 0, 2, inf}, 0, ground, seed)) {
        lowest = std::min(lowest, normal.dot(joint.trace.start));
        highest = std::max(highest, normal.dot(joint.trace.start));
      }
      // One more joint on either side would miss the square, to rounding.
      CHECK(lowest - 2 < normal.dot(ground.low) + 1e-12);
      CHECK(highest + 2 > normal.dot(ground.high) - 1e-12);
    }
  }

  TEST_CASE("the first joint of an equidistant set lies anywhere in one spacing") {
    const Domain<2> ground{{0, 0}, {10, 10}};
    std::array<int, 10> cells{};
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
      const auto joints = generate({"J", 0, DipDirection::east, 0, 0, 2, inf}, 0, ground, seed);
      const double phase = joints.front().trace.start.y() / 2;
      ++cells[static_cast<std::size_t>(10 * (phase - std::floor(phase)))];
    }
    double chi_squared = 0;
    for (const int n : cells) chi_squared += (n - 100.0) * (n - 100.0) / 100;
    CHECK(chi_squared < 27.88);  // 9 degrees of freedom, 0.1 %
  }

  TEST_CASE("scanlines meet sum |n.d| / s joints per metre, as tabled for the paper's sets") {
    const Domain<2> ground{{0, 0}, {50, 50}};
    const double spacing = 6 * 0.77 / std::numbers::pi;
    std::vector<JointSet> sets = voussoir_test::paper_sets();
    for (JointSet& set : sets) {
      set.intensity = 0;
      set.spacing = spacing;
      set.extent = inf;
      set.dip_deviation = 0;
    }
    struct Line {
      const char* id;
      Segment line;
    };
    for (const Line& scanline :
         {Line{"horizontal", {{1, 25}, {49, 25}}}, Line{"45deg", {{1, 1}, {49, 49}}},
          Line{"vertical", {{25, 1}, {25, 49}}}, Line{"135deg", {{49, 1}, {1, 49}}}}) {
      CAPTURE(scanline.id);
      const Segment& line = scanline.line;
      const double expected = line.length() / reference(std::string("E.scanline.") + scanline.id);
      const int seeds = 200;
      double total = 0;
      for (int seed = 1; seed <= seeds; ++seed) {
        int crossed = 0;
        for (const Joint& joint : joint_network(sets, ground, static_cast<std::uint64_t>(seed))) {
          const auto side = left_of(joint.trace.start, joint.trace.end);
          crossed += side.distance(line.start) * side.distance(line.end) < 0 ? 1 : 0;
        }
        // Each set of equidistant joints misses its mean number by less than one.
        CHECK(std::abs(crossed - expected) < 3);
        total += crossed;
      }
      // A set contributes a deviation of at most 1/2 per line: 4 sqrt(3/4) / sqrt(200) = 0.25
      // of 60.
      CHECK(std::abs(total / seeds - expected) < 4 * std::sqrt(0.75 / seeds));
    }
  }

  TEST_CASE("endless joints are as far apart as asked for, in a small domain and in a large one") {
    for (const double size : {30.0, 60.0, 240.0})
      for (const double dip : {0.0, 35.0, 90.0}) {
        CAPTURE(size);
        CAPTURE(dip);
        const Domain<2> ground{{-0.5 * size, -0.5 * size}, {0.5 * size, 0.5 * size}};
        const auto joints = generate(
            {.name = "J", .dip = dip * degree, .dip_direction = DipDirection::west, .spacing = 0.9},
            0, ground, 4);
        // Along their normal through the middle, from edge to edge of the inscribed circle.
        const Vec2 along(std::sin(dip * degree), std::cos(dip * degree));
        const Segment line{-0.5 * size * Vec2(-along.x(), along.y()),
                           0.5 * size * Vec2(-along.x(), along.y())};
        int crossed = 0;
        for (const Joint& joint : joints) {
          const auto side = left_of(joint.trace.start, joint.trace.end);
          crossed += side.distance(line.start) * side.distance(line.end) < 0 ? 1 : 0;
        }
        CHECK(std::abs(crossed - size / 0.9) < 1);  // equidistant, the first one anywhere
      }
  }

  TEST_CASE("the network is the same for the same seed and another for another") {
    const Domain<2> ground{{0, 0}, {20, 20}};
    const auto one = joint_network(voussoir_test::paper_sets(), ground, 1);
    const auto again = joint_network(voussoir_test::paper_sets(), ground, 1);
    const auto other = joint_network(voussoir_test::paper_sets(), ground, 2);
    REQUIRE(one.size() == 1200);
    REQUIRE(again.size() == one.size());
    REQUIRE(other.size() == one.size());
    std::size_t same = 0;
    for (std::size_t k = 0; k < one.size(); ++k) {
      CHECK(again[k].set == one[k].set);
      CHECK(again[k].trace.start == one[k].trace.start);
      CHECK(again[k].trace.end == one[k].trace.end);
      same += other[k].trace.start == one[k].trace.start ? 1 : 0;
    }
    CHECK(same == 0);
  }

  TEST_CASE("adding a set leaves the joints of the others where they were") {
    const Domain<2> ground{{0, 0}, {20, 20}};
    auto sets = voussoir_test::paper_sets();
    const auto two = generate(sets[1], 1, ground, 7);
    const auto all = joint_network(sets, ground, 7);
    const auto holds = [](const std::vector<Joint>& joints, const Joint& wanted) {
      return std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) {
        return joint.set == wanted.set && joint.trace.start == wanted.trace.start &&
               joint.trace.end == wanted.trace.end;
      });
    };
    for (const Joint& joint : two) CHECK(holds(all, joint));
    sets.pop_back();
    const auto fewer = joint_network(sets, ground, 7);
    CHECK(fewer.size() == 800);
    for (const Joint& joint : fewer) CHECK(holds(all, joint));
  }

  TEST_CASE("the sets are mixed in a network") {
    const Domain<2> ground{{0, 0}, {30, 30}};
    const auto joints = joint_network(voussoir_test::paper_sets(), ground, 1);
    int first_third = 0;
    for (std::size_t k = 0; k < 900; ++k) first_third += joints[k].set == 0 ? 1 : 0;
    // Hypergeometric: 900 of 2700, of which 900 are of set 0: mean 300, deviation
    // sqrt(900 * 1/3 * 2/3 * 1800/2699) = 11.5. Unshuffled it would be 900.
    CHECK(std::abs(first_third - 300) < 4 * 11.5);
  }
}

}  // namespace joint_set_test
