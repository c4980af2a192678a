// SPDX-License-Identifier: MIT
// How the wall is divided for its measurements: all of it counts once, each part where it is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>
#include <voussoir/rockmass/isotropic_sets.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace wall_motion_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

constexpr double ray = 6 * degree, circle = 360 * degree;

SimplePolygon flat_roof(double right, double left) {
  return SimplePolygon({{-left, -2}, {right, -2}, {right, 3}, {-left, 3}});
}
/// One with its centre on its outline, one whose floor stands up, one far from the origin.
std::vector<SimplePolygon> sections() {
  return {circular_opening(8, 36),
          horseshoe_opening(9, 3, 30),
          flat_roof(4, 2.5),
          SimplePolygon({{-4, 0}, {4, 0}, {4, 3}, {0, 5}, {-4, 3}}),
          SimplePolygon({{-4, -2}, {0, -0.5}, {4, -2}, {4, 3}, {-4, 3}}),
          SimplePolygon({{13, 11}, {19, 11}, {19, 15}, {13, 15}})};
}
Domain<2> ground_around(const SimplePolygon& section) {
  const Vec2 c = centre_of(section);
  return {{c.x() - 14, c.y() - 12}, {c.x() + 14, c.y() + 12}};
}

/// Of an outline, what a point of it at every 0.1 mm sees in a sector: by another method.
double outline_in(const SimplePolygon& section, double from, double to) {
  const Vec2 centre = centre_of(section);
  double length = 0;
  for (std::size_t e = 0; e < section.size(); ++e) {
    const Segment edge = section.edge(e);
    const auto count = static_cast<int>(std::ceil(edge.length() / 1e-4));
    // A floor through the centre is seen where it faces.
    const Vec2 along = (edge.end - edge.start) / edge.length(), out(along.y(), -along.x());
    const bool is_through = std::abs(out.dot(edge.start - centre)) < 1e-9;
    for (int k = 0; k < count; ++k) {
      const Vec2 p = is_through ? out : Vec2(edge.at((k + 0.5) / count) - centre);
      const double angle = std::remainder(std::atan2(p.y(), p.x()) - from, circle);
      if (angle >= 0 && angle < to - from) length += edge.length() / count;
    }
  }
  return length;
}
double measure_in(const std::vector<WallMotion>& wall, double from, double to) {
  double length = 0;
  for (const WallMotion& part : wall) {
    const double angle = std::remainder(part.angle - from, circle);
    if (angle >= 0 && angle < to - from) length += part.length;
  }
  return length;
}

}  // namespace

TEST_SUITE("tunnel/wall_motion") {
  TEST_CASE("every sector of the wall has the length of the outline there, whatever the blocks") {
    for (const SimplePolygon& section : sections()) {
      const auto mass = carve(jointed_rock(ground_around(section), 3), section, 0);
      const auto parts = detail::wall_motion_of(
          mass, section,
          {[](int) { return true; }, [](int, const Vec2&) { return zeros<Vec2>(); }});
      CAPTURE(centre_of(section).x());
      for (int k = 0; k < 60; ++k) {
        CAPTURE(k);
        // Two ends of a sector, each found to the length of a step.
        CHECK(std::abs(measure_in(parts, k * ray, (k + 1) * ray) -
                       outline_in(section, k * ray, (k + 1) * ray)) <= 2.1e-4);
      }
    }
  }

  TEST_CASE("in 3-D a stretch has its outline times its length") {
    const SimplePolygon section = horseshoe_opening(5, 1.5, 20);
    const TunnelAxis axis({0.3, 1, 0.2}, 20 * degree, 10 * degree);
    const PrismaticOpening opening(section, axis);
    const Domain<3> ground{{-7, -6, -7}, {7, 8, 7}};
    const auto mass = carve(slice<Spatial>(ground, joint_network(isotropic_sets(5), ground, 1),
                                           {.min_inscribed_radius = 0.2}),
                            opening, 0);
    const auto parts = detail::wall_motion_of(
        mass, opening, {[](int) { return true; }, [](int, const Vec3&) { return zeros<Vec3>(); }},
        {-0.6, 0.9});
    for (int k = 0; k < 60; ++k) {
      CAPTURE(k);
      CHECK(std::abs(measure_in(parts, k * ray, (k + 1) * ray) -
                     1.5 * outline_in(section, k * ray, (k + 1) * ray)) <= 1.5 * 2.1e-4);
    }
  }

  TEST_CASE("a wide block over a flat roof is the crown there, though its middle is far off") {
    // One block from -2.5 to 4 m: its middle is seen 14 degrees beside the crown.
    const SimplePolygon section = flat_roof(4, 2.5);
    const Domain<2> ground{{-12, -10}, {12, 10}};
    const auto mass = carve(slice<Planar>(ground, std::vector<JointOf<2>>{}, {}), section, 0);
    const double turn = 2e-3;
    const Vec2 sinks(0, -10e-3);
    const auto wall = detail::wall_motion_of(
        mass, section,
        {[](int) { return true; },
         [&](int, const Vec2& p) { return Vec2(sinks + turn * Vec2(-p.y(), p.x())); }});
    // Its parts within 12 degrees lie symmetrically about x = 0, where it sinks by 10 mm; a part is
    // up to 6 degrees of the roof, 0.32 m, and half of that is between the median and its middle.
    // Towards the axis up to a cosine of 12 degrees less.
    const double crown = convergence_of(wall).crown;
    CHECK(crown >= (10e-3 - 0.16 * turn) * std::cos(12 * degree));
    CHECK(crown <= 10e-3 + 0.16 * turn);
  }

  TEST_CASE("a loose block is no movement of the opening as a whole") {
    // A wall that becomes an ellipse while the opening rises, in unequal parts; far pressed
    // sideways.
    std::vector<WallMotion> wall;
    const Vec2 rise(0.2e-3, 1.5e-3);
    for (int k = 0; k < 60; ++k) {
      const double angle = (k + 0.5) * 6 * degree, length = k % 3 == 0 ? 0.6 : 0.3;
      const Vec2 moved = rise + Vec2(-4e-3 * std::cos(angle), 0.5e-3 * std::sin(angle));
      wall.push_back({angle, length, 0, moved});
    }
    // By symmetry about the centre, every third part and its opposite alike.
    CHECK(mean_displacement(wall).x() == voussoir_test::near(rise.x()).epsilon(1e-12));
    CHECK(mean_displacement(wall).y() == voussoir_test::near(rise.y()).epsilon(1e-12));
    // Two opposite ones come loose: the rest is symmetric still.
    wall[4].moved = Vec2(-30e-3, -140e-3);
    wall[34].moved = Vec2(50e-3, -3);
    CHECK(mean_displacement(wall).x() == voussoir_test::near(rise.x()).epsilon(1e-12));
    CHECK(mean_displacement(wall).y() == voussoir_test::near(rise.y()).epsilon(1e-12));
    CHECK(std::isnan(mean_displacement({}).x()));
  }

  // Blocks below 0.1 m2 are dropped, so that rock overhangs in holes, at the springing, too.
  TEST_CASE("heading and bench have the wall of the whole, whichever comes first") {
    const SimplePolygon upper(
        {{-3, 0}, {3, 0}, {3, 0.5}, {1.8, 2.4}, {0, 3}, {-1.8, 2.4}, {-3, 0.5}}),
        lower({{-3, -2.5}, {3, -2.5}, {3, 0}, {-3, 0}}),
        whole({{-3, -2.5}, {3, -2.5}, {3, 0.5}, {1.8, 2.4}, {0, 3}, {-1.8, 2.4}, {-3, 0.5}});
    const auto length = [](const std::vector<WallMotion>& wall) {
      double sum = 0;
      for (const WallMotion& part : wall) sum += part.length;
      return sum;
    };
    const detail::BodiesSeen<Planar> all{[](int) { return true; },
                                         [](int, const Vec2&) { return zeros<Vec2>(); }};
    std::size_t dropped = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
      for (const bool heading_first : {true, false}) {
        CAPTURE(seed);
        CAPTURE(heading_first);
        const auto first =
            carve(jointed_rock(ground_around(whole), seed), heading_first ? upper : lower, 0.1);
        const auto mass = carve(first, heading_first ? lower : upper, 0.1);
        dropped += mass.dropped.size();
        const auto once = voussoir_test::near(whole.perimeter()).epsilon(1e-9);  // as parts of sums
        CHECK(length(detail::wall_motion_of(mass, whole, all)) == once);
        CHECK(length(detail::wall_motion_of_joined(mass, all)) == once);
      }
    CHECK(dropped > 50);
  }

  TEST_CASE("what is detached does not count, nor do others stand for it") {
    const SimplePolygon section = circular_opening(8, 36);
    const auto mass = carve(jointed_rock(ground_around(section), 5), section, 0);
    const int gone = wall_pieces(mass, section).front().body;
    double lost = 0, all = 0, left = 0;
    for (const auto& piece : wall_pieces(mass, section)) {
      all += piece.facet.length();
      if (piece.body == gone) lost += piece.facet.length();
    }
    for (const WallMotion& part : detail::wall_motion_of(
             mass, section,
             {[gone](int b) { return b != gone; }, [](int, const Vec2&) { return zeros<Vec2>(); }}))
      left += part.length;
    CHECK(lost > 0);
    CHECK(std::abs(left - (all - lost)) <= 1e-12 * all);
  }
}

}  // namespace wall_motion_test
