// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace bolt_pattern_test {

using namespace voussoir;

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;

std::vector<Segment> bars(const BoltPattern& pattern) {
  return bolt_bars(pattern, circular_opening(10));
}
/// How far the head lies from this angle [rad].
double off(const Segment& bar, double angle) {
  return std::abs(std::remainder(std::atan2(bar.start.y(), bar.start.x()) - angle, 2 * pi));
}

/// Length of the wall of a polygon from vertex 0 to this point on it.
double along_wall(const SimplePolygon& opening, const Vec2& point) {
  double passed = 0;
  for (std::size_t e = 0; e < opening.size(); ++e) {
    const Segment edge = opening.edge(e);
    const double t =
        (point - edge.start).dot(edge.end - edge.start) / (edge.end - edge.start).squaredNorm();
    if (t >= 0 && t < 1 && (edge.at(t) - point).norm() < 1e-9) return passed + t * edge.length();
    passed += edge.length();
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TEST_SUITE("tunnel/bolt_pattern") {
  TEST_CASE("the mirrored pattern of a mirrored opening has the mirrored bars") {
    const auto opening = horseshoe_opening(6, 2.5, 35);
    std::vector<Vec2> vertices;
    for (const Vec2& v : opening.vertices()) vertices.insert(vertices.begin(), Vec2(-v.x(), v.y()));
    for (const double along : {0.0, 1.3}) {
      const BoltPattern pattern{.length = 3,
                                .angular_spacing = along > 0 ? 0 : 17 * degree,
                                .wall_spacing = along,
                                .from = -20 * degree,
                                .to = 150 * degree};
      BoltPattern mirrored = pattern;
      mirrored.from = pi - pattern.to;
      mirrored.to = pi - pattern.from;
      const auto bars = bolt_bars(pattern, opening);
      const auto image = bolt_bars(mirrored, SimplePolygon(vertices));
      REQUIRE(bars.size() == image.size());
      for (std::size_t k = 0; k < bars.size(); ++k) {
        const Segment& twin = image[bars.size() - 1 - k];
        // The wall is summed up in 3600 steps.
        CHECK((Vec2(-twin.start.x(), twin.start.y()) - bars[k].start).norm() < 1e-11);
        CHECK((Vec2(-twin.end.x(), twin.end.y()) - bars[k].end).norm() < 1e-11);
      }
    }
  }

  TEST_CASE("as many bolts as fit the arc, both ends included") {
    struct Case {
      double spacing, from, to;
      std::size_t count;
    };
    for (const Case& c : {Case{15, 0, 180, 13}, Case{11.25, 0, 180, 17}, Case{22.5, 0, 180, 9},
                          Case{11.25, -22.5, 202.5, 21},  // the paper's 7 m pattern
                          Case{15, 0, 360, 24}, Case{15, -180, 180, 24}, Case{22.5, 90, 450, 16},
                          Case{200, 0, 180, 1}}) {
      CAPTURE(c.spacing);
      CAPTURE(c.from);
      CAPTURE(c.to);
      CHECK(bars({.length = 4,
                  .angular_spacing = c.spacing * degree,
                  .from = c.from * degree,
                  .to = c.to * degree})
                .size() == c.count);
    }
  }

  TEST_CASE("bars are radial, head on the wall, in the order of their angle") {
    const auto all = bars({.length = 4, .angular_spacing = 11.25 * degree, .from = 0, .to = pi});
    const SimplePolygon opening = circular_opening(10);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Vec2 head = all[k].start, along = all[k].end - head;
      CHECK(std::abs(along.norm() - 4) <= 1e-14 * 8);
      CHECK(std::abs(cross(head.normalized(), along.normalized())) <= 1e-12);
      CHECK(along.dot(head) > 0);
      CHECK(std::isfinite(along_wall(opening, head)));
      // Sampling the arc at 3600 points is exact for angles.
      CHECK(off(all[k], static_cast<double>(k) * 11.25 * degree) <= 1e-12);
    }
  }

  TEST_CASE("what is left of the arc is shared between its ends") {
    // 0 to 100 degrees at 30: 0..90 fits, 10 degrees are left, 5 on either side.
    const auto all =
        bars({.length = 4, .angular_spacing = 30 * degree, .from = 0, .to = 100 * degree});
    REQUIRE(all.size() == 4);
    CHECK(off(all.front(), 5 * degree) <= 1e-12);
    CHECK(off(all.back(), 95 * degree) <= 1e-12);
  }

  TEST_CASE("on a full circle the spacing is kept and the last gap takes what is left") {
    const auto all = bars({.length = 4, .angular_spacing = 50 * degree, .from = 0, .to = 2 * pi});
    REQUIRE(all.size() == 7);  // at 0 to 300 degrees; an eighth at 350 would be 10 from the first
    CHECK(off(all[1], 50 * degree) <= 1e-12);
    CHECK(off(all[6], 300 * degree) <= 1e-12);
  }

  TEST_CASE("spacing along the wall is in metres of wall, on a circle and on a horseshoe") {
    for (const SimplePolygon& opening : {circular_opening(10), horseshoe_opening(8, 3)}) {
      const double spacing = 1.3;
      const auto all =
          bolt_bars({.length = 4, .wall_spacing = spacing, .from = 0, .to = pi}, opening);
      const double half = along_wall(opening, {-opening.vertices()[0].x(), 0});
      CHECK(all.size() == static_cast<std::size_t>(std::floor(half / spacing)) + 1);
      for (std::size_t k = 1; k < all.size(); ++k)
        // The wall is sampled at 3600 points, chords across a corner lose 1e-7 of a metre.
        CHECK(std::abs(along_wall(opening, all[k].start) - along_wall(opening, all[k - 1].start) -
                       spacing) <= 1e-5);
      // Centred: as far from one end of the arc as from the other.
      CHECK(std::abs(along_wall(opening, all.front().start) -
                     (half - along_wall(opening, all.back().start))) <= 1e-5);
    }
  }

  TEST_CASE("patterns out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), d = 15 * degree;
    for (const double bad : {nan, 0.0, -4.0})
      CHECK_THROWS_AS((void)bars({.length = bad, .angular_spacing = d}), InvalidInput);
    CHECK_THROWS_AS((void)bars({.length = 4}), InvalidInput);  // no spacing
    CHECK_THROWS_AS((void)bars({.length = 4, .angular_spacing = d, .wall_spacing = 1}),
                    InvalidInput);
    CHECK_THROWS_AS((void)bars({.length = 4, .angular_spacing = nan}), InvalidInput);
    CHECK_THROWS_AS((void)bars({.length = 4, .angular_spacing = 1e-12}), InvalidInput);
    CHECK_THROWS_AS((void)bars({.length = 4, .wall_spacing = 1e-12}), InvalidInput);
    CHECK_THROWS_AS((void)bars({.length = 4, .angular_spacing = d, .from = 1, .to = 1}),
                    InvalidInput);
    CHECK_THROWS_AS((void)bars({.length = 4, .angular_spacing = d, .from = 0, .to = 7}),
                    InvalidInput);
    CHECK_THROWS_AS((void)bars({.length = 4, .angular_spacing = d, .from = 0, .to = nan}),
                    InvalidInput);
    const SimplePolygon elsewhere({{1, 1}, {2, 1}, {2, 2}, {1, 2}});
    CHECK_THROWS_WITH_AS(
        (void)bolt_bars({.length = 4, .angular_spacing = d, .centre = Vec2(0, 0)}, elsewhere),
        doctest::Contains("the tunnel centre (0, 0) m is not inside the opening"), InvalidInput);
    // Without that they point away from its own middle.
    for (const Segment& bar : bolt_bars({.length = 4, .angular_spacing = d}, elsewhere))
      CHECK(std::abs(cross(bar.start - Vec2(1.5, 1.5), bar.end - bar.start)) < 1e-12);
  }
}

}  // namespace bolt_pattern_test
