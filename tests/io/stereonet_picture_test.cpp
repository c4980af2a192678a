// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/io/stereonet_picture.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "io/xml_check.hpp"
#include "support/degree.hpp"
#include "support/near.hpp"

namespace stereonet_picture_test {

using namespace voussoir;
using voussoir_test::degree, voussoir_test::near;

namespace {

constexpr double pi = std::numbers::pi;

SurveyedPlane plane(double dip, double direction, int set = -1, double weight = 1) {
  return {{dip * degree, direction * degree}, set, weight};
}

/// Two sets and some planes of none.
std::vector<SurveyedPlane> survey() {
  Random random(5);
  std::vector<SurveyedPlane> planes;
  for (int set = 0; set < 2; ++set) {
    SpatialJointSet joints{"J", (set == 0 ? 75 : 20) * degree, (set == 0 ? 265 : 140) * degree};
    joints.fisher_concentration = 40;
    for (int k = 0; k < 40; ++k)
      planes.push_back({orientation_of(detail::random_frame(joints, random).normal), set, 1});
  }
  planes.push_back(plane(45, 10));
  return planes;
}

StereonetPicture plain() {
  StereonetPicture picture;
  picture.header.title = "Survey";
  picture.planes = survey();
  picture.sets = fitted_sets(picture.planes, {"J1", "bedding"});
  picture.tunnel = LineOrientation{118 * degree, 4 * degree};
  return picture;
}

std::string refusal(const StereonetPicture& picture) {
  try {
    (void)draw_stereonet_picture(picture);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
  return found;
}
bool contains(const std::string& text, const std::string& part) { return count(text, part) > 0; }

/// Mean over the hemisphere by the midpoint rule in the net, which keeps areas.
double mean_over_net(const PoleDensity& density) {
  constexpr int parts = 200;
  double sum = 0;
  int inside = 0;
  for (int i = -parts; i < parts; ++i)
    for (int j = -parts; j < parts; ++j) {
      const Vec2 at((i + 0.5) / parts, (j + 0.5) / parts);
      if (at.squaredNorm() > 1) continue;
      sum += density(equal_area_direction(at));
      ++inside;
    }
  return sum / inside;
}

}  // namespace

TEST_SUITE("io/stereonet_picture") {
  TEST_CASE("a pole is at r = sqrt(2) sin(dip / 2), opposite to the dip direction") {
    for (double dip = 0; dip <= 90; dip += 7.5)
      for (double direction = 0; direction < 360; direction += 22.5) {
        const Vec2 at = equal_area_point(upward_normal(plane(dip, direction).plane));
        const double r = std::sqrt(2.0) * std::sin(dip * degree / 2);
        CHECK((at + r * Vec2(std::sin(direction * degree), std::cos(direction * degree))).norm() <
              1e-15);
      }
    // A plane that falls to the East has its pole in the West; a level one in the centre.
    CHECK(equal_area_point(upward_normal(plane(30, 90).plane)).x() < -0.3);
    CHECK(equal_area_point(upward_normal(plane(0, 90).plane)) == Vec2(0, 0));
    CHECK(equal_area_point(upward_normal(plane(90, 90).plane)).norm() == near(1).epsilon(1e-15));
  }

  TEST_CASE("a normal and its opposite are one pole, and the point leads back to it") {
    for (const SurveyedPlane& p : survey()) {
      const Vec3 normal = upward_normal(p.plane);
      const Vec2 at = equal_area_point(normal);
      CHECK(at == equal_area_point(-normal));
      CHECK(at.norm() <= 1 + 1e-15);
      CHECK((equal_area_direction(at) + normal).norm() < 1e-14);
    }
    // Beyond the rim the net goes on: a direction above the horizon at sqrt(2) sin(theta / 2).
    const double theta = 110 * degree;
    const Vec3 above = equal_area_direction({std::sqrt(2.0) * std::sin(theta / 2), 0});
    CHECK((above - Vec3(std::sin(theta), 0, -std::cos(theta))).norm() < 1e-14);
    CHECK(equal_area_direction({3, 0}) == Vec3(0, 0, 1));
  }

  TEST_CASE("equal solid angles have equal areas") {
    // A cap of the angle theta has the part 1 - cos(theta) of the hemisphere.
    for (double theta = 5; theta < 90; theta += 5) {
      const double r =
          equal_area_point(Vec3(std::sin(theta * degree), 0, -std::cos(theta * degree))).norm();
      CHECK(r * r == near(1 - std::cos(theta * degree)).epsilon(1e-13));
    }
  }

  TEST_CASE("a great circle is a right angle from the pole, from rim to rim") {
    for (const auto& [dip, direction] :
         {std::pair{30.0, 120.0}, {90.0, 45.0}, {75.0, 265.0}, {0.0, 0.0}, {5.0, 359.0}}) {
      const Orientation p = plane(dip, direction).plane;
      const std::vector<Vec2> circle = detail::great_circle(p);
      for (const Vec2& at : circle) {
        CHECK(at.norm() <= 1 + 1e-14);
        CHECK(std::abs(equal_area_direction(at).dot(upward_normal(p))) < 1e-14);
      }
      CHECK(circle.front().norm() == near(1).epsilon(1e-14));
      CHECK((circle.front() + circle.back()).norm() < 1e-14);
      CHECK((circle[circle.size() / 2] - equal_area_point(dip_vector(p))).norm() < 1e-14);
    }
    // Across a tunnel that falls 30 degrees to the East: a plane of dip 60 to the West.
    const Orientation across = detail::plane_across(pi / 2, 30 * degree);
    CHECK(across.dip == near(60 * degree).epsilon(1e-14));
    CHECK(across.dip_direction == near(1.5 * pi).epsilon(1e-14));
  }

  TEST_CASE("density has the mean 1 over the hemisphere, whatever the planes") {
    for (const std::vector<SurveyedPlane>& planes :
         {std::vector{plane(30, 40)}, std::vector{plane(90, 10), plane(3, 77, 0, 5)}, survey()})
      CHECK(mean_over_net(PoleDensity(planes)) == near(1).epsilon(2e-3));
    // One plane: k = 2 (1 + 1 / 9), at its pole k coth(k), a right angle away k / sinh(k).
    const PoleDensity one(std::vector{plane(30, 40)});
    const double k = 20.0 / 9;
    CHECK(one.concentration() == near(k).epsilon(1e-14));
    CHECK(one(upward_normal(plane(30, 40).plane)) == near(k / std::tanh(k)).epsilon(1e-13));
    CHECK(one(dip_vector(plane(30, 40).plane)) == near(k / std::sinh(k)).epsilon(1e-12));
  }

  TEST_CASE("density turns with the planes, knows no sense, and weights as copies") {
    std::vector<SurveyedPlane> planes = survey(), turned = planes, doubled = planes;
    for (SurveyedPlane& p : turned)
      p.plane.dip_direction = std::fmod(p.plane.dip_direction + 37 * degree, 2 * pi);
    const PoleDensity density(planes), other(turned);
    for (double dip = 0; dip <= 90; dip += 15)
      for (double direction = 0; direction < 300; direction += 30) {
        const Vec3 at = upward_normal(plane(dip, direction).plane);
        CHECK(other(upward_normal(plane(dip, direction + 37).plane)) ==
              near(density(at)).epsilon(1e-9));
        CHECK(density(-at) == density(at));
      }
    // Three times the weight draws the density three times as high beside the rest.
    const PoleDensity even(std::vector{plane(90, 0), plane(90, 90)}),
        heavy(std::vector{plane(90, 0, -1, 3), plane(90, 90)});
    const Vec3 north = Vec3::UnitY(), east = Vec3::UnitX();
    CHECK(even(north) == near(even(east)).epsilon(1e-12));
    CHECK(heavy(north) > 1.9 * heavy(east));
  }

  TEST_CASE("many planes, put together by the half degree, have the density of them all") {
    SpatialJointSet joints{"J", 60 * degree, 200 * degree};
    joints.fisher_concentration = 40;
    Random random(9);
    std::vector<SurveyedPlane> planes;
    for (int k = 0; k < 6000; ++k)
      planes.push_back({orientation_of(detail::random_frame(joints, random).normal), -1, 1});
    const PoleDensity density(planes);
    CHECK(density.concentration() == 100);
    double direct = 0;
    const Vec3 at = upward_normal(plane(65, 195).plane);
    for (const SurveyedPlane& p : planes)
      direct += 200 * std::exp(100 * (std::abs(at.dot(upward_normal(p.plane))) - 1)) / 2 / 6000;
    CHECK(density(at) == near(direct).epsilon(0.01));
  }

  TEST_CASE("levels are 2, 4, 6, ... and farther apart where there would be more than seven") {
    using Levels = std::vector<double>;
    CHECK(detail::density_levels(1.5) == Levels{});
    CHECK(detail::density_levels(9) == Levels{2, 4, 6, 8});
    CHECK(detail::density_levels(15) == Levels{2, 4, 6, 8, 10, 12, 14});
    CHECK(detail::density_levels(28) == Levels{4, 8, 12, 16, 20, 24});
    CHECK(detail::density_levels(100) == Levels{20, 40, 60, 80});
    CHECK(detail::density_levels(60) == Levels{10, 20, 30, 40, 50});
  }

  TEST_CASE("planes and directions in words") {
    CHECK(dip_text(plane(45, 270).plane) == "dip 45\u00B0 towards 270\u00B0");
    CHECK(dip_text(plane(4.6, 44.6).plane) == "dip 5\u00B0 towards 045\u00B0");
    CHECK(dip_text(plane(90, 359.7).plane) == "dip 90\u00B0 towards 000\u00B0");
  }

  TEST_CASE("the picture is well-formed and has what the sets are") {
    const StereonetPicture picture = plain();
    const std::string svg = draw_stereonet_picture(picture);
    CHECK(xml_fault(svg) == "");
    for (const char* part :
         {">N<", ">E<", ">S<", ">W<", ">J1<", ">bedding<", ">section<", ">axis<",
          "tunnel axis, trend 118\u00B0, plunge 4\u00B0", "section across the axis",
          "poles of planes of no set", ">K<", "pole density, multiples of uniform", "81 poles"})
      CHECK_MESSAGE(contains(svg, part), part);
    for (const FittedSet& set : picture.sets) {
      CHECK(contains(svg, dip_text(set.mean)));
      CHECK(contains(svg, ">" + readable_text(*set.concentration, 2) + "<"));
      CHECK(contains(svg, ">40<"));
    }
    // A pole at its place: that of a plane 45 towards 010, r = sqrt(2) sin(22.5 degrees).
    StereonetPicture one;
    one.header.title = "One";
    one.planes = {plane(45, 90)};
    one.contours = false;
    const std::string single = draw_stereonet_picture(one);
    CHECK(xml_fault(single) == "");
    // Centre 20 + 32 + 280 from the left; the mark of 3.6 px begins at its right corner.
    const double x = 332 - 280 * std::sqrt(2.0) * std::sin(22.5 * degree) + 3.6;
    CHECK(contains(single, "d=\"m" + trimmed_text(x, 2) + " "));
    CHECK(contains(single, "1 poles"));
    CHECK_FALSE(contains(single, "multiples of uniform"));
  }

  TEST_CASE("where there is one set and no plane names one, all are of it") {
    StereonetPicture picture;
    picture.header.title = "One set";
    for (int k = 0; k < 30; ++k) picture.planes.push_back(plane(60 + k % 7, 100 + k % 11));
    picture.sets = fitted_sets(picture.planes, {});
    const std::string svg = draw_stereonet_picture(picture);
    CHECK(contains(svg, ">all<"));
    CHECK_FALSE(contains(svg, "no set"));
    CHECK_FALSE(contains(svg, "tunnel"));
    // Marks that coincide are drawn once: 7 dips by 11 directions, at most 30.
    picture.planes.insert(picture.planes.end(), 5000, picture.planes.front());
    CHECK(draw_stereonet_picture(picture).size() < svg.size() + 20'000);
  }

  TEST_CASE("a level tunnel has its axis at both sides of the rim, a rising one below the other") {
    StereonetPicture picture = plain();
    picture.tunnel = LineOrientation{90 * degree, 0};
    const std::string level = draw_stereonet_picture(picture);
    const auto axis_at = [](const std::string& svg, double x) {
      return contains(svg, "cx=\"" + trimmed_text(x, 2) + "\"");
    };
    CHECK(axis_at(level, 332 + 280));
    CHECK(axis_at(level, 332 - 280));
    // Rising 30 degrees to the East it is seen 30 degrees down in the West: 60 from the vertical.
    picture.tunnel = LineOrientation{90 * degree, -30 * degree};
    const std::string rising = draw_stereonet_picture(picture);
    CHECK(axis_at(rising, 332 - 280 * std::sqrt(2.0) * std::sin(30 * degree)));
    CHECK(contains(rising, "trend 090\u00B0, rising 30\u00B0"));
  }

  TEST_CASE("names of any length and with any signs, sets without K, no planes") {
    StereonetPicture picture = plain();
    picture.sets[0].name = "bedding of the <lower> marl & sandstone, as mapped in the adit";
    picture.sets[1].concentration.reset();
    picture.sets[1].cone_95.reset();
    picture.planes.clear();
    const std::string svg = draw_stereonet_picture(picture);
    CHECK(xml_fault(svg) == "");
    CHECK(contains(svg, "1: bedding of"));
    CHECK(contains(svg, ">\u2013<"));
    CHECK(contains(svg, "0 poles"));
  }

  TEST_CASE("names keep off each other and off marks, and stay inside the rim") {
    const detail::NetFrame net{{300, 300}, 280};
    SvgCanvas canvas(600, 600, 100, "names");
    detail::LabelPlaces places(net);
    for (int k = 0; k < 6; ++k) {
      const Vec2 at(300 + 4 * k, 30);
      places.keep_off(at, 8);
      places.beside(at, 10, "set " + std::to_string(k), {.size = 15});
    }
    places.draw(canvas);
    const std::string svg = canvas.document();
    std::vector<ViewRect> boxes;
    for (std::size_t at = 0; (at = svg.find("<text x=\"", at)) != std::string::npos; ++at) {
      const Vec2 base(std::stod(svg.substr(at + 9)),
                      std::stod(svg.substr(svg.find("y=\"", at) + 3)));
      const Vec2 half(0.5 * text_width("set 0", {.size = 15}), 0.45 * 15);
      const Vec2 middle = base - Vec2(0, 0.35 * 15);
      if (boxes.empty() || (boxes.back().centre() - middle).norm() > 0.1)
        boxes.push_back({middle - half, middle + half});
    }
    REQUIRE(boxes.size() == 6);
    for (std::size_t a = 0; a < boxes.size(); ++a) {
      CHECK((boxes[a].centre() - net.centre).norm() < net.radius);
      for (std::size_t b = a + 1; b < boxes.size(); ++b) CHECK_FALSE(boxes[a].overlaps(boxes[b]));
    }
  }

  TEST_CASE("what cannot be drawn is refused") {
    CHECK(refusal({}) == "stereonet picture: needs at least one plane or one set");
    StereonetPicture picture = plain();
    picture.planes[3].set = 2;
    CHECK(refusal(picture) ==
          "stereonet picture, plane 4: set = 2: must be below 2, the number of sets, or -1");
    picture = plain();
    picture.planes[0] = plane(95, 0);
    CHECK(contains(refusal(picture), "stereonet picture, plane 1: dip = 1.65806 rad (95 deg)"));
    picture.planes[0] = plane(5, 0, 0, -1);
    CHECK(contains(refusal(picture), "stereonet picture, plane 1: weight = -1: must be > 0"));
    picture = plain();
    picture.sets[1].mean.dip = 2;
    CHECK(contains(refusal(picture), "stereonet picture, set bedding: dip = 2 rad"));
    picture = plain();
    picture.sets[1].mean.dip_direction = -1;
    CHECK(contains(refusal(picture), "stereonet picture, set bedding: dip direction = -1 rad"));
    picture = plain();
    picture.tunnel->trend = 100;
    CHECK(contains(refusal(picture), "stereonet picture: trend of the tunnel = 100 rad"));
    picture.tunnel = LineOrientation{1, 2};
    CHECK(contains(refusal(picture), "stereonet picture: plunge of the tunnel = 2 rad"));
  }
}

}  // namespace stereonet_picture_test
