// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/block_intersections.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/shapes.hpp"

namespace block_intersections_test {

using namespace voussoir;
using voussoir_test::jointed_rock;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const Domain<2> ground{{-10, -8}, {10, 9}};

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Bricks of 1 m x 1 m over (0, 0) to (4, 4).
RockMass<Planar> bricks() {
  std::vector<Joint> joints;
  for (int k = 1; k < 4; ++k) {
    joints.push_back({{{1.0 * k, -1}, {1.0 * k, 5}}, 0});
    joints.push_back({{{-1, 1.0 * k}, {5, 1.0 * k}}, 1});
  }
  return slice({{0, 0}, {4, 4}}, joints, {});
}

/// Column and row of the brick that an intersection runs in.
std::vector<Vec2> cells(const RockMass<Planar>& mass,
                        const std::vector<BlockIntersection>& intersections) {
  std::vector<Vec2> result;
  for (const BlockIntersection& p : intersections)
    result.emplace_back(mass.bodies[index(p.body)].properties.centroid.array().floor());
  return result;
}

/// Ordered, without gap or overlap, from `from` to `to`, and each in the body it names.
void check_covered(const RockMass<Planar>& mass, const Segment& line, double from, double to,
                   const std::vector<BlockIntersection>& intersections) {
  // Intersections shorter than the tolerance are left out, and lines are clipped to it at every
  // face.
  const double slack = 4 * mass.domain.tolerance();
  REQUIRE_FALSE(intersections.empty());
  CHECK(std::abs(intersections.front().from - from) <= slack);
  CHECK(std::abs(intersections.back().to - to) <= slack);
  double sum = 0;
  for (std::size_t k = 0; k < intersections.size(); ++k) {
    const BlockIntersection& p = intersections[k];
    sum += p.to - p.from;
    CHECK(p.to > p.from);
    if (k > 0) {
      CHECK(std::abs(p.from - intersections[k - 1].to) <= slack);
      CHECK(p.body != intersections[k - 1].body);
    }
    const Vec2 middle = line.at(0.5 * (p.from + p.to) / line.length());
    const auto& parts = mass.bodies[index(p.body)].parts;
    CHECK(std::any_of(parts.begin(), parts.end(), [&](const ConvexPolygon& part) {
      double outside = -inf;
      for (std::size_t face = 0; face < part.size(); ++face)
        outside = std::max(outside, part.half_space(face).distance(middle));
      return outside <= mass.domain.tolerance();
    }));
  }
  CHECK(std::abs(sum - (to - from)) <= slack * static_cast<double>(intersections.size()));
}

}  // namespace

TEST_SUITE("rockmass/block_intersections") {
  TEST_CASE("random bars: intersections are in order, without gap, as long as the bar") {
    Random random(1);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const auto mass = jointed_rock(ground, seed);
      for (int k = 0; k < 300; ++k) {
        CAPTURE(k);
        const auto point = [&] {
          return Vec2(19.8 * (random.uniform() - 0.5), -7.9 + 16.8 * random.uniform());
        };
        const Segment line{point(), point()};
        check_covered(mass, line, 0, line.length(), block_intersections(mass, line));
      }
    }
  }

  TEST_CASE("no block reaches beyond what its second moment allows; a needle nearly does") {
    double nearest = 0;
    const auto check = [&](const auto& mass) {
      for (const auto& body : mass.bodies)
        for (const auto& v : body.parts.front().vertices()) {
          const double share =
              squared_length_of(v - body.properties.centroid) / squared_reach(body.properties);
          CHECK(share <= 1 + 1e-9);
          nearest = std::max(nearest, share);
        }
    };
    for (std::uint64_t seed = 1; seed <= 5; ++seed) check(jointed_rock(ground, seed));
    CHECK(nearest > 0.5);
    // Of a triangle and a cone as slender as this the tip reaches it.
    const MassProperties<2> needle = mass_properties(
        std::vector<ConvexPolygon>{ConvexPolygon({Vec2(0, -1e-4), Vec2(3, 0), Vec2(0, 1e-4)})});
    CHECK(squared_length_of(Vec2(3, 0) - needle.centroid) / squared_reach(needle) ==
          voussoir_test::near(1).epsilon(1e-7));
    const Domain<3> space{{-4, -4, -4}, {4, 4, 4}};
    Random random(5);
    std::vector<JointOf<3>> joints;
    for (int k = 0; k < 60; ++k) {
      const auto unit = [&] { return 2 * random.uniform() - 1; };
      const Vec3 point(4 * unit(), 4 * unit(), 4 * unit()), normal(unit(), unit(), unit());
      joints.push_back({unbounded_joint(point, normal), 0});
    }
    check(slice<Spatial>(space, joints, {}));
  }

  TEST_CASE("bars along a joint, through corners and T-junctions, belong to one body everywhere") {
    const auto mass = jointed_rock(ground, 3, {0.25, 5}, 3);
    int along_joint = 0;
    for (const auto& body : mass.bodies) {
      const ConvexPolygon& block = body.parts[0];
      for (std::size_t k = 0; k < block.size(); ++k) {
        if (mass.cuts[index(block.cut(k))].kind == Cut::Kind::boundary) continue;
        const Segment face = block.face(k);
        // The face made longer by half at both ends: along the joint, then on through other blocks.
        const Segment line{face.at(-0.5), face.at(1.5)};
        if (!((line.start.array() > ground.low.array()).all() &&
              (line.start.array() < ground.high.array()).all() &&
              (line.end.array() > ground.low.array()).all() &&
              (line.end.array() < ground.high.array()).all()))
          continue;
        ++along_joint;
        check_covered(mass, line, 0, line.length(), block_intersections(mass, line));
      }
    }
    CHECK(along_joint > 500);
  }

  TEST_CASE("bars through the corners of blocks, in every direction") {
    Random random(2);
    const auto mass = jointed_rock(ground, 4);
    for (const auto& body : mass.bodies) {
      const Vec2 corner = body.parts[0].vertex(0);
      const double angle = 2 * std::numbers::pi * random.uniform();
      const Vec2 along(std::cos(angle), std::sin(angle));
      const Segment line{corner - 0.7 * along, corner + 0.7 * along};
      if ((corner.cwiseAbs().array() > Vec2(9, 7).array()).any()) continue;
      check_covered(mass, line, 0, line.length(), block_intersections(mass, line));
      // It starts, or ends, in the corner.
      const Segment from{corner, line.end}, to{line.start, corner};
      check_covered(mass, from, 0, from.length(), block_intersections(mass, from));
      check_covered(mass, to, 0, to.length(), block_intersections(mass, to));
    }
  }

  TEST_CASE("a bar inside one block has one intersection, its whole length") {
    const auto intersections = block_intersections(bricks(), {{1.2, 2.3}, {1.8, 2.9}});
    REQUIRE(intersections.size() == 1);
    CHECK(intersections[0].from == 0);
    CHECK(std::abs(intersections[0].to - 0.6 * std::sqrt(2.0)) < 1e-15);
  }

  TEST_CASE("a bar along a joint of bricks runs in those on its left") {
    const auto mass = bricks();
    const auto up = block_intersections(mass, {{2, 0.5}, {2, 3.5}}),
               down = block_intersections(mass, {{2, 3.5}, {2, 0.5}});
    CHECK(cells(mass, up) == std::vector<Vec2>{{1, 0}, {1, 1}, {1, 2}, {1, 3}});
    CHECK(cells(mass, down) == std::vector<Vec2>{{2, 3}, {2, 2}, {2, 1}, {2, 0}});
    const std::vector<double> ends = {0, 0.5, 1.5, 2.5, 3};
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(std::abs(up[k].from - ends[k]) < 1e-15);
      CHECK(std::abs(up[k].to - ends[k + 1]) < 1e-15);
    }
    const auto right = block_intersections(mass, {{0.5, 1}, {2.5, 1}});
    CHECK(cells(mass, right) == std::vector<Vec2>{{0, 1}, {1, 1}, {2, 1}});
  }

  TEST_CASE("a bar through the corners of bricks touches only those on the diagonal") {
    const auto mass = bricks();
    const auto intersections = block_intersections(mass, {{0.5, 0.5}, {3.5, 3.5}});
    CHECK(cells(mass, intersections) == std::vector<Vec2>{{0, 0}, {1, 1}, {2, 2}, {3, 3}});
    CHECK(std::abs(intersections[1].to - intersections[1].from - std::sqrt(2.0)) < 1e-14);
  }

  TEST_CASE("outside the domain there is no intersection") {
    const auto mass = bricks();
    const Segment across{{-1, 0.5}, {6, 0.5}};
    const auto intersections = block_intersections(mass, across);
    REQUIRE(intersections.size() == 4);
    check_covered(mass, across, 1, 5, intersections);
    CHECK(block_intersections(mass, {{-1, -1}, {5, -1}}).empty());
    CHECK(block_intersections(mass, {{5, 5}, {6, 6}}).empty());
    // Along the edge: the rock is on the left going up the right-hand side, on the right going
    // down.
    CHECK(block_intersections(mass, {{4, 0.5}, {4, 3.5}}).size() == 4);
    CHECK(block_intersections(mass, {{4, 3.5}, {4, 0.5}}).empty());
  }

  TEST_CASE("an opening is a gap, and parts of one body are one intersection") {
    // One block round a square hole: cut into parts by the lines of the outline, yet one body.
    const auto mass =
        carve(slice(ground, {}, {}), SimplePolygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), 0);
    REQUIRE(mass.bodies.size() == 1);
    REQUIRE(mass.bodies[0].parts.size() == 4);
    const auto through = block_intersections(mass, {{-5, 0.25}, {5, 0.25}});
    REQUIRE(through.size() == 2);
    CHECK(std::abs(through[0].to - 4) < 1e-12);
    CHECK(std::abs(through[1].from - 6) < 1e-12);
    const auto beside = block_intersections(mass, {{-5, 2}, {5, 2}});
    REQUIRE(beside.size() == 1);
    CHECK(std::abs(beside[0].to - 10) < 1e-14);
    CHECK(block_intersections(mass, {{-0.5, -0.5}, {0.5, 0.5}}).empty());
  }

  TEST_CASE("bolts from the wall of an opening start in rock and are covered to their tip") {
    const SimplePolygon opening(voussoir_test::regular(36, 3));
    const auto mass = carve(jointed_rock(ground, 5), opening, 0);
    for (int k = 0; k < 90; ++k) {
      CAPTURE(k);
      const double angle = 4 * std::numbers::pi / 180 * k;
      const Vec2 out(std::cos(angle), std::sin(angle));
      const Vec2 head = opening.last_crossing({{0, 0}, 5 * out}).value() * 5 * out;
      const Segment bolt{head, head + 3 * out};
      check_covered(mass, bolt, 0, 3, block_intersections(mass, bolt));
    }
  }

  TEST_CASE("turning a bar round gives the same intersections the other way") {
    Random random(6);
    const auto mass = jointed_rock(ground, 6);
    for (int k = 0; k < 100; ++k) {
      const Segment line{{18 * (random.uniform() - 0.5), 14 * (random.uniform() - 0.5)},
                         {18 * (random.uniform() - 0.5), 14 * (random.uniform() - 0.5)}};
      const auto there = block_intersections(mass, line),
                 back = block_intersections(mass, {line.end, line.start});
      REQUIRE(there.size() == back.size());
      for (std::size_t i = 0; i < there.size(); ++i) {
        const BlockIntersection& other = back[back.size() - 1 - i];
        CHECK(there[i].body == other.body);
        CHECK(std::abs(there[i].from - (line.length() - other.to)) < 1e-12);  // coordinates of 10 m
      }
    }
  }
}

}  // namespace block_intersections_test
