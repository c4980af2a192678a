// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

namespace spatial_joint_set_test {

using namespace voussoir;

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double inf = std::numeric_limits<double>::infinity();

/// Discs of 2 m, 30 degrees towards 90, one centre per cubic metre.
SpatialJointSet discs() {
  SpatialJointSet set{"bedding", 30 * degree, 90 * degree};
  set.count_per_volume = 1;
  set.shape = DiscJoints{2};
  return set;
}

std::string refusal(const SpatialJointSet& set) {
  try {
    set.check();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

Vec3 centre_of(const JointPlane& joint) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : joint.corners) sum += corner;
  return sum / static_cast<double>(joint.corners.size());
}

/// Area of the part of a joint inside a box, by clipping.
double area_inside(const JointPlane& joint, const Domain<3>& box) {
  std::optional<JointPlane> inside = covering(joint, 0.5 * (box.low + box.high), box.diameter());
  for (int axis = 0; axis < 3; ++axis) {
    if (inside) inside = split(*inside, HalfSpace<3>{Vec3::Unit(axis), box.high[axis]}, 0).below;
    if (inside) inside = split(*inside, HalfSpace<3>{-Vec3::Unit(axis), -box.low[axis]}, 0).below;
  }
  return inside ? inside->area() : 0;
}

double area_per_volume(const std::vector<SpatialJoint>& joints, const Domain<3>& box) {
  double sum = 0;
  for (const SpatialJoint& joint : joints) sum += area_inside(joint.trace, box);
  return sum / box.measure();
}

struct Sample {
  double mean = 0, standard_error = 0;
};

Sample sample(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Sample result;
  for (const double v : values) result.mean += v / n;
  for (const double v : values)
    result.standard_error += (v - result.mean) * (v - result.mean) / ((n - 1) * n);
  result.standard_error = std::sqrt(result.standard_error);
  return result;
}

}  // namespace

TEST_SUITE("rockmass/spatial_joint_set") {
  TEST_CASE("a set out of range is refused by name, value and rule") {
    CHECK(refusal(discs()) == "accepted");
    const auto refused = [](auto change, const std::string& message) {
      SpatialJointSet set = discs();
      change(set);
      CHECK(refusal(set) == "joint set bedding: " + message);
    };
    using Set = SpatialJointSet;
    const double nan = std::nan("");
    const std::string dips = " deg): must be 0 to 1.5708 rad (0 to 90 deg)";
    const std::string azimuths = " deg): must be 0 to 6.28319 rad (0 to 360 deg)";
    refused([](Set& s) { s.dip = 100 * degree; },
            "dip = 1.74533 rad (100" + dips + "; the same plane dips 80 deg towards 270 deg");
    refused([](Set& s) { s.dip = 75; },
            "dip = 75 rad (4297.18" + dips + "; did you mean 75 deg = 1.309 rad?");
    refused([](Set& s) { s.dip = -1 * degree; }, "dip = -0.0174533 rad (-1" + dips);
    refused([=](Set& s) { s.dip = nan; }, "dip = nan rad (nan" + dips);
    refused([](Set& s) { s.dip_direction = 120; },
            "dip_direction = 120 rad (6875.49" + azimuths + "; did you mean 120 deg = 2.0944 rad?");
    refused([](Set& s) { s.dip_direction = -90 * degree; },
            "dip_direction = -1.5708 rad (-90" + azimuths);
    refused([](Set& s) { s.dip_deviation = 5; },
            "dip_deviation = 5 rad (286.479 deg): must be 0 to 0.785398 rad (0 to 45 deg); did you "
            "mean 5 deg = 0.0872665 rad?");
    refused([](Set& s) { s.dip_direction_deviation = inf; },
            "dip_direction_deviation = inf rad (inf deg): must be 0 to 3.14159 rad (0 to 180 deg)");
    refused([=](Set& s) { s.fisher_concentration = nan; },
            "fisher_concentration = nan must be >= 0 and finite");
    refused(
        [](Set& s) {
          s.fisher_concentration = 50;
          s.dip_deviation = 0.1;
        },
        "fisher_concentration = 50 must be 0 where deviations of dip or dip direction are "
        "given: one kind of scatter");
    const std::string one = ": exactly one must be > 0";
    refused([](Set& s) { s.count_per_volume = 0; },
            "spacing = 0, area_per_volume = 0, count_per_volume = 0" + one);
    refused([](Set& s) { s.spacing = 2; },
            "spacing = 2, area_per_volume = 0, count_per_volume = 1" + one);
    refused([](Set& s) { s.spacing = s.area_per_volume = 1; },
            "spacing = 1, area_per_volume = 1, count_per_volume = 1" + one);
    refused([](Set& s) { s.area_per_volume = -3; }, "area_per_volume = -3 must be >= 0 and finite");
    refused([](Set& s) { s.spacing = inf; }, "spacing = inf must be >= 0 and finite");
    refused([](Set& s) { s.shape = DiscJoints{0}; }, "diameter = 0 must be > 0 and finite");
    refused([=](Set& s) { s.shape = DiscJoints{nan}; }, "diameter = nan must be > 0 and finite");
    refused(
        [](Set& s) {
          s.shape = RectangularJoints{-1, 2};
        },
        "strike_length = -1 must be > 0 and finite");
    refused(
        [](Set& s) {
          s.shape = RectangularJoints{1, inf};
        },
        "dip_length = inf must be > 0 and finite");
    refused([](Set& s) { s.shape = PersistentJoints{}; },
            "count_per_volume = 1 must be 0 for fully persistent joints, which have no centre: "
            "give spacing or area_per_volume");
    CHECK_THROWS_AS((void)joint_network({discs()}, {{0, 0, 0}, {1, 0, 1}}, 1), InvalidInput);
  }

  TEST_CASE("discs and rectangles lie as their dip and dip direction say") {
    const Domain<3> ground{{0, 0, 0}, {4, 4, 4}};
    SpatialJointSet set = discs();
    for (const SpatialJoint& joint : generate(set, 3, ground, 1)) {
      CHECK(joint.set == 3);
      CHECK((joint.trace.plane.normal - Vec3(0.5, 0, std::sqrt(0.75))).norm() < 1e-14);
      CHECK(std::abs(joint.trace.area() - std::numbers::pi) < 1e-13);
    }
    set.shape = RectangularJoints{3, 2};
    for (const SpatialJoint& joint : generate(set, 3, ground, 1)) {
      CHECK((joint.trace.plane.normal - Vec3(0.5, 0, std::sqrt(0.75))).norm() < 1e-14);
      Vec3 low = joint.trace.corners[0], high = low;
      for (const Vec3& corner : joint.trace.corners) {
        low = low.cwiseMin(corner).eval();
        high = high.cwiseMax(corner).eval();
      }
      // 3 m along the strike, which is North; 2 m down a dip of 30 degrees to the East.
      CHECK((high - low - Vec3(2 * std::sqrt(0.75), 3, 1)).norm() < 1e-13);
    }
  }

  TEST_CASE("centres are uniform over the domain and as far around it as joints reach") {
    // Discs of 2 m in 4 m x 5 m x 6 m: the number is that of the enlarged box, 6 x 7 x 8 (times
    // 1.003 for the polygon), of which those are kept that reach the domain.
    const Domain<3> ground{{-1, 2, 3}, {3, 7, 9}};
    SpatialJointSet set = discs();
    set.count_per_volume = 20;
    const auto joints = generate(set, 0, ground, 1);
    // Kept are the centres in the domain's Minkowski sum with the disc. For a thin disc with normal
    // n its measure is V + sum over axes of (2 r sqrt(1 - n_i^2)) A_i + pi r^2 sum |n_i| L_i: the
    // volume, the faces swept by the disc's half widths, and the edges by its shadows.
    const double r = 1;
    const Vec3 n(0.5, 0, std::sqrt(0.75)), size = ground.size();
    double expected = ground.measure();
    for (int i = 0; i < 3; ++i) {
      expected += 2 * r * std::sqrt(1 - n[i] * n[i]) * ground.measure() / size[i];
      expected += std::numbers::pi * r * r * std::abs(n[i]) * size[i];
    }
    expected *= 20;
    // A binomial number of about 5000: four standard deviations are at most 4 sqrt(5000).
    CHECK(std::abs(static_cast<double>(joints.size()) - expected) < 4 * std::sqrt(expected));
    std::array<int, 60> cells{};  // 3 x 4 x 5 cells inside the domain
    int inside = 0;
    for (const SpatialJoint& joint : joints) {
      const Vec3 at = (centre_of(joint.trace) - ground.low).cwiseQuotient(size);
      if (at.minCoeff() < 0 || at.maxCoeff() >= 1) continue;
      ++inside;
      const auto cell = [&](int axis, int count) { return static_cast<int>(at[axis] * count); };
      ++cells[static_cast<std::size_t>((cell(0, 3) * 4 + cell(1, 4)) * 5 + cell(2, 5))];
    }
    CHECK(std::abs(inside - 20 * ground.measure()) < 4 * std::sqrt(20 * ground.measure()));
    double chi_squared = 0;
    for (const int count : cells) {
      const double mean = inside / 60.0;
      chi_squared += (count - mean) * (count - mean) / mean;
    }
    CHECK(chi_squared < 98.3);  // 59 degrees of freedom, 0.1 %
    CHECK(chi_squared > 30.9);  // 99.9 %
  }

  TEST_CASE("P32 in the domain is the one given, for every shape and every way to say how many") {
    // Joints half as large as the domain: centres inside it alone would leave a quarter too little.
    const Domain<3> ground{{0, 0, 0}, {6, 5, 4}};
    struct Case {
      const char* text;
      JointShape shape;
      double area;
    };
    for (const Case& c : {Case{"disc", DiscJoints{3}, 2.25 * std::numbers::pi},
                          Case{"rectangle", RectangularJoints{4, 1.5}, 6}}) {
      CAPTURE(c.text);
      for (int way = 0; way < 3; ++way) {
        CAPTURE(way);
        SpatialJointSet set{"J", 50 * degree, 200 * degree};
        set.fisher_concentration = 20;
        set.shape = c.shape;
        if (way == 0) set.area_per_volume = 1.5;
        if (way == 1) set.count_per_volume = 1.5 / c.area;
        if (way == 2) set.spacing = 1 / 1.5;
        std::vector<double> found;
        for (std::uint64_t seed = 1; seed <= 60; ++seed)
          found.push_back(area_per_volume(generate(set, 0, ground, seed), ground));
        const Sample s = sample(found);
        CHECK(s.standard_error < 0.04);
        // The number of joints is rounded: half of one in about 60.
        CHECK(std::abs(s.mean - 1.5) < 4 * s.standard_error + 0.01);
      }
    }
  }

  TEST_CASE(
      "fully persistent joints: P32 is 1 / spacing, or as given, whatever their orientation") {
    const Domain<3> ground{{-3, -4, -5}, {6, 5, 4}};
    for (const double dip : {0.0, 35.0, 90.0}) {
      CAPTURE(dip);
      SpatialJointSet set{"J", dip * degree, 70 * degree};
      set.spacing = 0.4;
      std::vector<double> equidistant, independent;
      for (std::uint64_t seed = 1; seed <= 40; ++seed)
        equidistant.push_back(area_per_volume(generate(set, 0, ground, seed), ground));
      set.spacing = 0;
      set.area_per_volume = 2.5;
      set.fisher_concentration = 30;
      for (std::uint64_t seed = 1; seed <= 40; ++seed)
        independent.push_back(area_per_volume(generate(set, 0, ground, seed), ground));
      const Sample regular = sample(equidistant), scattered = sample(independent);
      CHECK(std::abs(regular.mean - 2.5) < 4 * regular.standard_error);
      CHECK(regular.standard_error < 0.02);
      CHECK(std::abs(scattered.mean - 2.5) < 4 * scattered.standard_error + 0.02);
      CHECK(scattered.standard_error < 0.12);
    }
  }

  TEST_CASE("an equidistant set covers the domain at its spacing, the first joint anywhere in it") {
    const Domain<3> ground{{-30, -10, 0}, {20, 30, 25}};
    SpatialJointSet set{"J", 25 * degree, 140 * degree};
    set.spacing = 1.25;
    const Vec3 normal = upward_normal({set.dip, set.dip_direction});
    std::array<int, 8> phases{};
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      std::vector<double> offsets;
      for (const SpatialJoint& joint : generate(set, 0, ground, seed)) {
        CHECK(joint.trace.is_unbounded());
        CHECK((joint.trace.plane.normal - normal).norm() < 1e-15);
        offsets.push_back(joint.trace.plane.offset);
      }
      std::sort(offsets.begin(), offsets.end());
      double lowest = 1e9, highest = -1e9;
      for (int k = 0; k < 8; ++k) {
        const Vec3 corner((k & 1 ? ground.high : ground.low).x(),
                          (k & 2 ? ground.high : ground.low).y(),
                          (k & 4 ? ground.high : ground.low).z());
        lowest = std::min(lowest, normal.dot(corner));
        highest = std::max(highest, normal.dot(corner));
      }
      // All that reach the domain, and no other.
      CHECK(offsets.front() > lowest);
      CHECK(offsets.front() <= lowest + 1.25);
      CHECK(offsets.back() < highest);
      CHECK(offsets.back() >= highest - 1.25);
      for (std::size_t k = 1; k < offsets.size(); ++k)
        CHECK(std::abs(offsets[k] - offsets[k - 1] - 1.25) < 1e-13);
      const double phase = offsets.front() / 1.25 - std::floor(offsets.front() / 1.25);
      ++phases[static_cast<std::size_t>(8 * phase)];
    }
    double chi_squared = 0;
    for (const int count : phases) chi_squared += (count - 50.0) * (count - 50.0) / 50;
    CHECK(chi_squared < 24.3);  // 7 degrees of freedom, 0.1 %
  }

  TEST_CASE("normal scatter has the means and deviations asked for, each on its own") {
    SpatialJointSet set{"J", 40 * degree, 250 * degree};
    set.count_per_volume = 1;
    set.shape = DiscJoints{0.1};
    set.dip_deviation = 3 * degree;
    set.dip_direction_deviation = 8 * degree;
    const auto joints = generate(set, 0, {{0, 0, 0}, {16, 16, 16}}, 1);
    const auto n = static_cast<double>(joints.size());
    REQUIRE(n > 3800);
    double dip = 0, direction = 0, dip_square = 0, direction_square = 0, product = 0;
    for (const SpatialJoint& joint : joints) {
      const Orientation found = orientation_of(joint.trace.plane.normal);
      const double a = found.dip - set.dip, b = found.dip_direction - set.dip_direction;
      dip += a / n;
      direction += b / n;
      dip_square += a * a / n;
      direction_square += b * b / n;
      product += a * b / n;
    }
    // Four standard errors: sigma / sqrt(n) of a mean, sigma / sqrt(2 n) of a deviation.
    CHECK(std::abs(dip) < 4 * set.dip_deviation / std::sqrt(n));
    CHECK(std::abs(direction) < 4 * set.dip_direction_deviation / std::sqrt(n));
    CHECK(std::abs(std::sqrt(dip_square) / set.dip_deviation - 1) < 4 / std::sqrt(2 * n));
    CHECK(std::abs(std::sqrt(direction_square) / set.dip_direction_deviation - 1) <
          4 / std::sqrt(2 * n));
    CHECK(std::abs(product) < 4 * set.dip_deviation * set.dip_direction_deviation / std::sqrt(n));
  }

  TEST_CASE("Fisher scatter: the mean resultant length is coth kappa - 1 / kappa") {
    SpatialJointSet set{"J", 30 * degree, 310 * degree};
    set.count_per_volume = 1;
    set.shape = DiscJoints{0.1};
    const Vec3 mean = upward_normal({set.dip, set.dip_direction});
    for (const double kappa : {40.0, 1e3, 1e7}) {
      CAPTURE(kappa);
      set.fisher_concentration = kappa;
      const auto joints = generate(set, 0, {{0, 0, 0}, {16, 16, 16}}, 2);
      const auto n = static_cast<double>(joints.size());
      REQUIRE(n > 3800);
      Vec3 sum = Vec3::Zero();
      std::array<int, 8> sectors{};
      const Vec3 down = dip_vector({set.dip, set.dip_direction});
      const Vec3 level = strike_vector({set.dip, set.dip_direction});
      for (const SpatialJoint& joint : joints) {
        const Vec3& normal = joint.trace.plane.normal;
        sum += normal / n;
        const double azimuth = std::atan2(normal.dot(level), normal.dot(down));
        ++sectors[static_cast<std::size_t>(
            std::clamp(4 * (azimuth / std::numbers::pi + 1), 0.0, 7.999))];
      }
      // The component along the mean has the expectation coth k - 1/k and, for k this large, the
      // standard deviation 1/k (1 - cos theta is nearly exponential); across, 1/sqrt(k) per axis.
      const double expected = 1 / std::tanh(kappa) - 1 / kappa;
      CHECK(std::abs(sum.dot(mean) - expected) < 4 / kappa / std::sqrt(n));
      CHECK((sum - sum.dot(mean) * mean).norm() < 4 * std::sqrt(2 / kappa / n));
      double chi_squared = 0;
      for (const int count : sectors) chi_squared += (count - n / 8) * (count - n / 8) / (n / 8);
      CHECK(chi_squared < 24.3);  // 7 degrees of freedom, 0.1 %
    }
  }

  TEST_CASE("Fisher scatter nearly without preference: the mean |cos| is 1 - tanh(k/2) / k") {
    // Integral of |c| k exp(k c) / (2 sinh k) over c from -1 to 1. Normals are turned upward, which
    // leaves |c| as it is.
    SpatialJointSet set{"J", 70 * degree, 20 * degree};
    set.count_per_volume = 1;
    set.shape = DiscJoints{0.1};
    const Vec3 mean = upward_normal({set.dip, set.dip_direction});
    for (const double kappa : {1e-9, 0.5, 4.0}) {
      CAPTURE(kappa);
      set.fisher_concentration = kappa;
      std::vector<double> found;
      for (const SpatialJoint& joint : generate(set, 0, {{0, 0, 0}, {16, 16, 16}}, 3)) {
        CHECK(joint.trace.plane.normal.z() >= 0);
        found.push_back(std::abs(joint.trace.plane.normal.dot(mean)));
      }
      const Sample s = sample(found);
      CHECK(std::abs(s.mean - (1 - std::tanh(0.5 * kappa) / kappa)) < 4 * s.standard_error);
      CHECK(s.standard_error < 0.005);
    }
  }

  TEST_CASE("the same seed gives the same joints; another set does not disturb them") {
    const Domain<3> ground{{0, 0, 0}, {5, 5, 5}};
    SpatialJointSet other = discs();
    other.dip_direction = 200 * degree;
    other.fisher_concentration = 15;
    const auto one = joint_network({discs(), other}, ground, 1);
    const auto again = joint_network({discs(), other}, ground, 1);
    const auto another = joint_network({discs(), other}, ground, 2);
    REQUIRE(again.size() == one.size());
    for (std::size_t k = 0; k < one.size(); ++k)
      CHECK(again[k].trace.corners == one[k].trace.corners);  // == is meant
    CHECK(another[0].trace.corners != one[0].trace.corners);
    const auto alone = generate(other, 1, ground, 1);
    std::size_t of_other = 0, first_half = 0;
    for (std::size_t k = 0; k < one.size(); ++k) {
      if (one[k].set != 1) continue;
      ++of_other;
      first_half += k < one.size() / 2 ? 1 : 0;
      CHECK(std::any_of(alone.begin(), alone.end(), [&](const SpatialJoint& joint) {
        return joint.trace.corners == one[k].trace.corners;
      }));
    }
    CHECK(of_other == alone.size());
    // Shuffled: about half of the second set's joints are in the first half of the list.
    CHECK(std::abs(static_cast<double>(first_half) - 0.5 * static_cast<double>(of_other)) <
          2 * std::sqrt(static_cast<double>(of_other)));
  }

  TEST_CASE("all joints given reach the domain") {
    const Domain<3> ground{{0, 0, 0}, {3, 3, 3}};
    SpatialJointSet set = discs();
    set.fisher_concentration = 5;
    const auto joints = generate(set, 0, ground, 4);
    CHECK(joints.size() > 50);
    for (const SpatialJoint& joint : joints) CHECK(area_inside(joint.trace, ground) > 0);
  }
}

}  // namespace spatial_joint_set_test
