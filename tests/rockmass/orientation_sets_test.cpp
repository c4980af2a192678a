// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "support/degree.hpp"
#include "support/near.hpp"

namespace orientation_sets_test {

using namespace voussoir;
using voussoir_test::degree, voussoir_test::near;

namespace {

constexpr double pi = std::numbers::pi;

SurveyedPlane plane(double dip, double direction, int set = 0, double weight = 1) {
  return {{dip * degree, direction * degree}, set, weight};
}

/// Planes drawn from Fisher's distribution about a mean.
std::vector<SurveyedPlane> sample(double dip, double direction, double kappa, int count,
                                  std::uint64_t seed) {
  SpatialJointSet set{"J", dip * degree, direction * degree};
  set.fisher_concentration = kappa;
  Random random(seed);
  std::vector<SurveyedPlane> planes;
  for (int k = 0; k < count; ++k)
    planes.push_back({orientation_of(detail::random_frame(set, random).normal), 0, 1});
  return planes;
}

double angle_between(const Orientation& a, const Orientation& b) {
  const Vec3 across = cross(upward_normal(a), upward_normal(b));
  return std::atan2(across.norm(), std::abs(upward_normal(a).dot(upward_normal(b))));
}

template <class Call>
std::string refusal(const Call& call) {
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

TEST_SUITE("rockmass/orientation_sets") {
  TEST_CASE("four planes about the vertical axis: R, K and the cone by hand") {
    // Normals lean 10 degrees to four sides: R = 4 cos 10, K = 3 / (4 - R).
    const std::vector<SurveyedPlane> planes = {plane(10, 0), plane(10, 90), plane(10, 180),
                                               plane(10, 270)};
    const FittedSet fit = fitted_set(planes, 0, "J1");
    const double r = 4 * std::cos(10 * degree);
    CHECK(fit.name == "J1");
    CHECK(fit.count == 4);
    CHECK(fit.weight == 4);
    CHECK(fit.effective_count == 4);
    CHECK(fit.mean.dip < 1e-12);
    REQUIRE(fit.concentration);
    CHECK(*fit.concentration == near(3 / (4 - r)).epsilon(1e-12));
    CHECK(fit.largest_angle == near(10 * degree).epsilon(1e-12));
    // Fisher (1953): cos a = 1 - (N - R) / R ((1 / 0.05)^(1 / (N - 1)) - 1)
    REQUIRE(fit.cone_95);
    CHECK(std::cos(*fit.cone_95) ==
          near(1 - (4 - r) / r * (std::pow(20, 1.0 / 3) - 1)).epsilon(1e-12));
  }

  TEST_CASE("the mean and kappa that planes were drawn with are found within their errors") {
    constexpr int count = 400;
    for (const double kappa : {15.0, 40.0, 200.0})
      for (const auto& mean : {std::pair{35.0, 120.0}, {88.0, 10.0}, {90.0, 359.0}, {2.0, 200.0}}) {
        const double dip = mean.first, direction = mean.second;
        CAPTURE(kappa);
        CAPTURE(dip);
        const FittedSet fit = fitted_set(sample(dip, direction, kappa, count, 7), 0, "J");
        // 2 kappa (N - R) has 2 (N - 1) degrees of freedom: K scatters by kappa / sqrt(N).
        CHECK(std::abs(*fit.concentration - kappa) < 3 * kappa / std::sqrt(count));
        // Of the mean, each component scatters by 1 / sqrt(kappa N).
        const double off = angle_between(fit.mean, {dip * degree, direction * degree});
        CHECK(off < 3.5 / std::sqrt(kappa * count));
        CHECK(off > 1e-5);
      }
  }

  TEST_CASE("95 of 100 cones hold the true mean") {
    int held = 0;
    constexpr int tries = 400;
    for (int k = 0; k < tries; ++k) {
      const FittedSet fit =
          fitted_set(sample(60, 80, 30, 12, static_cast<std::uint64_t>(k) + 100), 0, "J");
      held += angle_between(fit.mean, {60 * degree, 80 * degree}) < *fit.cone_95;
    }
    // Binomial: 380 +- 4.4; three standard deviations.
    CHECK(held > 366);
    CHECK(held < 394);
  }

  TEST_CASE("steep planes that dip to both sides are one set: planes have no sense") {
    // 85 towards 090 and 85 towards 270 are 10 degrees apart.
    const std::vector<SurveyedPlane> planes = {plane(85, 90),  plane(85, 270), plane(85, 90),
                                               plane(85, 270), plane(90, 92),  plane(90, 268)};
    const FittedSet fit = fitted_set(planes, 0, "J");
    CHECK(fit.mean.dip == near(pi / 2).epsilon(1e-12));
    CHECK(std::abs(std::sin(fit.mean.dip_direction - pi / 2)) < 1e-12);
    CHECK(fit.largest_angle == near(5 * degree).epsilon(1e-9));
    CHECK(*fit.concentration > 300);
  }

  TEST_CASE("an outlier in the first place does not decide the side") {
    std::vector<SurveyedPlane> planes = {plane(80, 90)};
    for (int k = 0; k < 12; ++k) planes.push_back(plane(70 + 0.5 * k, 270 + k));
    for (int k = 0; k < 12; ++k) planes.push_back(plane(88, 85 + k));
    std::vector<SurveyedPlane> turned(planes.rbegin(), planes.rend());
    const FittedSet a = fitted_set(planes, 0, "J"), b = fitted_set(turned, 0, "J");
    CHECK(*a.concentration == near(*b.concentration).epsilon(1e-10));
    CHECK(angle_between(a.mean, b.mean) < 1e-12);
  }

  TEST_CASE("the side is that where planes are densest, whichever comes first") {
    // Normals 15 and 30 degrees to both sides of East, after one to the North: turned to the North
    // they would add up to that, 2.5 long; turned to the East to (3.66, 1).
    const std::vector<SurveyedPlane> planes = {plane(90, 0), plane(90, 60), plane(90, 75),
                                               plane(90, 105), plane(90, 120)};
    const FittedSet fit = fitted_set(planes, 0, "J");
    CHECK(angle_between(fit.mean, {90 * degree, 90 * degree}) < 16 * degree);
  }

  TEST_CASE("turned by 37 degrees, mirrored: the mean goes along, K stays") {
    const std::vector<SurveyedPlane> planes = sample(55, 300, 25, 60, 3);
    const FittedSet fit = fitted_set(planes, 0, "J");
    std::vector<SurveyedPlane> turned = planes, mirrored = planes;
    for (SurveyedPlane& p : turned)
      p.plane.dip_direction = std::fmod(p.plane.dip_direction + 37 * degree, 2 * pi);
    for (SurveyedPlane& p : mirrored) p.plane.dip_direction = 2 * pi - p.plane.dip_direction;
    const FittedSet other = fitted_set(turned, 0, "J"), image = fitted_set(mirrored, 0, "J");
    CHECK(other.mean.dip == near(fit.mean.dip).epsilon(1e-12));
    CHECK(other.mean.dip_direction ==
          near(std::fmod(fit.mean.dip_direction + 37 * degree, 2 * pi)).epsilon(1e-12));
    CHECK(image.mean.dip_direction == near(2 * pi - fit.mean.dip_direction).epsilon(1e-12));
    for (const FittedSet& same : {other, image}) {
      CHECK(*same.concentration == near(*fit.concentration).epsilon(1e-11));
      CHECK(*same.cone_95 == near(*fit.cone_95).epsilon(1e-11));
      CHECK(same.largest_angle == near(fit.largest_angle).epsilon(1e-11));
    }
  }

  TEST_CASE("weights: their scale is without effect, a heavy plane draws the mean, Kish's N") {
    std::vector<SurveyedPlane> planes = sample(40, 100, 30, 50, 5);
    const FittedSet plain = fitted_set(planes, 0, "J");
    for (SurveyedPlane& p : planes) p.weight = 7;
    const FittedSet scaled = fitted_set(planes, 0, "J");
    CHECK(scaled.weight == near(350).epsilon(1e-14));
    CHECK(scaled.effective_count == near(50).epsilon(1e-14));
    CHECK(*scaled.concentration == near(*plain.concentration).epsilon(1e-12));

    // Leaning 10 degrees to the East three times, to the West once: the mean leans by
    // atan(2 sin 10 / (4 cos 10)), and N = 16 / 10... of weights 3, 1: 4^2 / (9 + 1) = 1.6.
    const FittedSet two = fitted_set(std::vector{plane(10, 90, 0, 3), plane(10, 270)}, 0, "J");
    CHECK(two.mean.dip == near(std::atan(0.5 * std::tan(10 * degree))).epsilon(1e-12));
    CHECK(two.mean.dip_direction == near(pi / 2).epsilon(1e-12));
    CHECK(two.effective_count == near(1.6).epsilon(1e-14));
    // K by its definition, N = (3 + 1 + 1)^2 / 11.
    const std::vector<SurveyedPlane> three = {plane(10, 90, 0, 3), plane(10, 270), plane(0, 0)};
    const double n = 25.0 / 11, x = 2 * std::sin(10 * degree), z = 4 * std::cos(10 * degree) + 1;
    const double r = n * std::hypot(x, z) / 5;
    CHECK(*fitted_set(three, 0, "J").concentration == near((n - 1) / (n - r)).epsilon(1e-10));
  }

  TEST_CASE("planes that are alike, or fewer than three: a mean but no K") {
    for (const std::vector<SurveyedPlane>& planes :
         {std::vector{plane(30, 40)}, std::vector{plane(30, 40), plane(32, 44)},
          std::vector(5, plane(30, 40))}) {
      const FittedSet fit = fitted_set(planes, 0, "J");
      CHECK_FALSE(fit.concentration);
      CHECK_FALSE(fit.cone_95);
      CHECK(fit.count == planes.size());
      CHECK(angle_between(fit.mean, {30 * degree, 40 * degree}) < 2.5 * degree);
    }
    // A tenth of a degree apart there is one, to eight digits: N - R does not cancel.
    const std::vector<SurveyedPlane> close = {plane(0.001, 0), plane(0.001, 90), plane(0.001, 180),
                                              plane(0.001, 270)};
    CHECK(*fitted_set(close, 0, "J").concentration ==
          near(3 / (8 * std::pow(std::sin(0.0005 * degree), 2))).epsilon(1e-8));
  }

  TEST_CASE("every set of a file is fitted to its own planes; planes of none are left out") {
    std::vector<SurveyedPlane> planes = sample(70, 20, 50, 30, 1);
    for (SurveyedPlane p : sample(20, 200, 50, 40, 2)) {
      p.set = 1;
      planes.push_back(p);
    }
    planes.push_back(plane(45, 300, -1));
    const std::vector<FittedSet> fits = fitted_sets(planes, {"J1", "bedding"});
    REQUIRE(fits.size() == 2);
    CHECK(fits[0].name == "J1");
    CHECK(fits[0].count == 30);
    CHECK(fits[1].name == "bedding");
    CHECK(fits[1].count == 40);
    CHECK(angle_between(fits[1].mean, {20 * degree, 200 * degree}) < 3 * degree);
    CHECK(fitted_set(planes, -1, "rest").count == 1);
  }

  TEST_CASE("without sets all planes are one, unless they do not look like one") {
    std::vector<SurveyedPlane> planes = sample(70, 20, 50, 30, 1);
    planes.front().set = -1;  // whatever their sets
    const std::vector<FittedSet> fits = fitted_sets(planes, {});
    REQUIRE(fits.size() == 1);
    CHECK(fits[0].name == "all");
    CHECK(fits[0].count == 30);
    // Planes along the axes: R = 3 / sqrt(3), K = 2 / (3 - sqrt 3) = 1.577.
    const std::vector<SurveyedPlane> axes = {plane(0, 0), plane(90, 0), plane(90, 90)};
    CHECK(refusal([&] { return fitted_sets(axes, {}); }) ==
          "the planes do not look like one set (K = 1.6): add a set column");
    CHECK(fitted_set(axes, 0, "J").concentration);  // who says that it is a set gets it
  }

  TEST_CASE("planes of all directions have K = 2 once they are turned to one side") {
    Random random(11);
    std::vector<SurveyedPlane> planes;
    for (int k = 0; k < 4000; ++k)
      planes.push_back({{std::acos(random.uniform()), 2 * pi * random.uniform()}, 0, 1});
    CHECK(std::abs(*fitted_set(planes, 0, "J").concentration - 2) < 0.1);
  }

  TEST_CASE("Terzaghi's weight: 1 across the line, 2 at 30 degrees, no more than the largest") {
    const Orientation upright{pi / 2, pi / 2};  // strikes North
    CHECK(terzaghi_weight(upright, pi / 2, 0, 10) == near(1).epsilon(1e-14));
    CHECK(terzaghi_weight(upright, 1.5 * pi, 0, 10) == near(1).epsilon(1e-14));
    CHECK(terzaghi_weight(upright, 30 * degree, 0, 10) == near(2).epsilon(1e-14));
    CHECK(terzaghi_weight(upright, 0, 0, 10) == 10);
    CHECK(terzaghi_weight(upright, 1 * degree, 0, 5) == 5);
    // A vertical borehole meets a plane of dip d at 90 - d: 1 / cos d.
    CHECK(terzaghi_weight({60 * degree, 1}, 2, pi / 2, 10) == near(2).epsilon(1e-14));
    // A line that falls 30 degrees to the East and a plane that falls 60 to the West: across it.
    CHECK(terzaghi_weight({60 * degree, 1.5 * pi}, pi / 2, 30 * degree, 10) ==
          near(1).epsilon(1e-14));
  }

  TEST_CASE("what is out of range is refused by plane, value and range") {
    const std::vector<SurveyedPlane> good = {plane(30, 40)};
    CHECK(refusal([&] { return fitted_set(good, 1, "J2"); }) ==
          "set J2: has no plane; needs at least one");
    CHECK(refusal([&] { return fitted_sets({}, {}); }) ==
          "no planes to fit a set to; needs at least one");
    const auto fit = [](const SurveyedPlane& p) {
      return refusal([&] { return fitted_set(std::vector{p}, 0, "J2"); });
    };
    CHECK(
        contains(fit(plane(95, 40)), "set J2, plane 1: dip = 1.65806 rad (95 deg): must be 0 to"));
    CHECK(contains(fit(plane(30, 370)), "set J2, plane 1: dip direction = 6.45772 rad (370 deg)"));
    CHECK(
        contains(fit(plane(30, 40, 0, 0)), "set J2, plane 1: weight = 0: must be > 0 and finite"));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(contains(fit(plane(30, 40, 0, nan)), "weight = "));
    CHECK(contains(fit(plane(nan, 40)), "dip = "));
    const auto weight = [](double trend, double plunge, double largest) {
      return refusal([&] { return terzaghi_weight({1, 1}, trend, plunge, largest); });
    };
    CHECK(contains(weight(7, 0, 5), "trend of the scanline = 7 rad"));
    CHECK(contains(weight(1, 2, 5), "plunge of the scanline = 2 rad"));
    CHECK(contains(weight(1, 0, 0.5), "largest Terzaghi weight = 0.5: must be >= 1 and finite"));
  }
}

}  // namespace orientation_sets_test
