// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>

#include "support/jointed_rock.hpp"
#include "support/shapes.hpp"

namespace carving_test {

using namespace voussoir;
using voussoir_test::jointed_rock;
using voussoir_test::regular;

namespace {

double total_area(const RockMass<Planar>& mass) {
  double sum = 0;
  for (const auto& body : mass.bodies) sum += body.properties.measure;
  return sum;
}

double wall_length(const RockMass<Planar>& mass) {
  double sum = 0;
  for (const auto& piece : wall_pieces(mass)) sum += piece.facet.length();
  return sum;
}

bool holds(const ConvexPolygon& part, const Vec2& p) {
  for (std::size_t k = 0; k < part.size(); ++k)
    if (part.half_space(k).distance(p) > 0) return false;
  return true;
}

/// Number of parts, of all bodies, that a point is in.
int parts_at(const RockMass<Planar>& mass, const Vec2& p) {
  int count = 0;
  for (const auto& body : mass.bodies)
    for (const ConvexPolygon& part : body.parts) count += holds(part, p) ? 1 : 0;
  return count;
}

/// What must hold of every carving of rock that filled its domain before. `lost` says that pieces
/// may have been dropped at the wall.
void check_carved(const RockMass<Planar>& mass, bool lost) {
  const SimplePolygon& opening = mass.openings.back();
  const CarvingReport& report = mass.carving;
  const double whole = mass.domain.measure();
  // Thousands of areas, each known to 1e-14 of a square metre.
  CHECK(std::abs(total_area(mass) + report.removed_measure + report.dropped_measure - whole) <
        1e-12 * whole);
  CHECK(std::abs(report.removed_measure - opening.area()) < 1e-12 * whole);
  CHECK((report.dropped_pieces > 0) == (report.dropped_measure > 0));
  if (!lost) CHECK(report.dropped_pieces == 0);
  for (const auto& body : mass.bodies) {
    const auto properties = mass_properties(body.parts);
    // Welding moves vertices by roundings, 2e-15 m here, after the properties were taken.
    CHECK(std::abs(properties.measure - body.properties.measure) < 1e-12);
    CHECK(std::abs(properties.second_moment(0, 0) - body.properties.second_moment(0, 0)) <
          1e-12 * std::max(1.0, properties.second_moment(0, 0)));
    CHECK(detail::connected_groups(body.parts, mass.cuts, mass.domain.tolerance()).size() == 1);
    for (const ConvexPolygon& part : body.parts)
      CHECK_FALSE(opening.contains(mass_properties(part).centroid));
  }

  // The wall: in the order of the outline, on it, its body behind it and nothing before it.
  double reached = 0, length = 0;
  const double step = 1e-6;
  for (const auto& piece : wall_pieces(mass)) {
    const Segment edge = opening.edge(static_cast<std::size_t>(piece.edge));
    const auto line = left_of(edge.start, edge.end);  // the opening on its left, inside
    if (piece.hole >= 0) continue;                    // those lie behind it: rockmass/wall_pieces
    CHECK(std::abs(line.distance(piece.facet.start)) < 1e-11);
    CHECK(std::abs(line.distance(piece.facet.end)) < 1e-11);
    CHECK(piece.from >= reached - 1e-11);
    CHECK(std::abs(piece.to - piece.from - piece.facet.length()) < 1e-11);
    reached = piece.to;
    length += piece.facet.length();
    CHECK((piece.facet.end - piece.facet.start).dot(edge.end - edge.start) > 0);
    if (piece.facet.length() < 1e-4) continue;  // for these the step would leave the neighbourhood
    const Vec2 behind = piece.facet.centre() + step * line.normal;
    const auto& parts = mass.bodies[static_cast<std::size_t>(piece.body)].parts;
    CHECK(std::any_of(parts.begin(), parts.end(),
                      [&](const ConvexPolygon& part) { return holds(part, behind); }));
    CHECK(opening.contains(piece.facet.centre() - step * line.normal));
  }
  CHECK(reached <= opening.perimeter() + 1e-11);
  if (!lost) {
    CHECK(std::abs(length - opening.perimeter()) < 1e-9 * opening.perimeter());
  } else {
    CHECK(length <= opening.perimeter() * (1 + 1e-12));
  }
}

const Domain<2> ground{{-10, -8}, {10, 9}};
const std::vector<Vec2> letter_l = {{-2, -2},      {2.5, -2},  {2.5, -0.5},
                                    {-0.25, -0.5}, {-0.25, 3}, {-2, 3}};

}  // namespace

TEST_SUITE("rockmass/carving") {
  TEST_CASE("a round opening: area and wall complete, whatever the joints") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      const SimplePolygon opening(regular(72, 3));
      const auto mass = carve(jointed_rock(ground, seed), opening, 0);
      check_carved(mass, false);
      CHECK(mass.carving.cut_bodies > 20);
      CHECK(mass.carving.removed_bodies > 5);
    }
  }

  TEST_CASE("every point of the ground is in one part or in the opening") {
    const SimplePolygon opening(letter_l);
    const auto rock = jointed_rock(ground, 2);
    const auto mass = carve(rock, opening, 0);
    // Of what every body is a piece: it lies in it.
    REQUIRE(mass.origins.size() == mass.bodies.size());
    for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
      const auto& whole = rock.bodies[static_cast<std::size_t>(mass.origins[b])].parts.front();
      const Vec2 middle = mass.bodies[b].parts.front().vertices().front();
      for (std::size_t k = 0; k < whole.size(); ++k)
        CHECK(whole.half_space(k).distance(middle) < mass.domain.tolerance());
    }
    Random random(1);
    for (int k = 0; k < 3000; ++k) {
      const Vec2 p(10 * (2 * random.uniform() - 1), -8 + 17 * random.uniform());
      CHECK(parts_at(mass, p) == (opening.contains(p) ? 0 : 1));
    }
  }

  TEST_CASE("openings that are not convex: an L, a cross, random stars") {
    Random random(2);
    std::vector<std::vector<Vec2>> outlines = {letter_l};
    outlines.push_back({{1, -1},
                        {3, -1},
                        {3, 1},
                        {1, 1},
                        {1, 3},
                        {-1, 3},
                        {-1, 1},
                        {-3, 1},
                        {-3, -1},
                        {-1, -1},
                        {-1, -3},
                        {1, -3}});
    for (int trial = 0; trial < 40; ++trial) {
      std::vector<Vec2> star;
      const int corners = 5 + trial % 9;
      for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.7 * random.uniform()) / corners;
        star.emplace_back((0.7 + 4 * random.uniform()) * Vec2(std::cos(angle), std::sin(angle)));
      }
      outlines.push_back(star);
    }
    std::uint64_t seed = 1;
    for (const auto& outline : outlines) {
      CAPTURE(seed);
      check_carved(carve(jointed_rock(ground, seed++), SimplePolygon(outline), 0), false);
    }
  }

  TEST_CASE("in unjointed rock the rest stays one body of several parts") {
    for (const auto& outline : {letter_l, regular(12, 3)}) {
      const auto mass = carve(slice(ground, {}, {}), SimplePolygon(outline), 0.1);
      check_carved(mass, false);
      REQUIRE(mass.bodies.size() == 1);
      CHECK(mass.bodies[0].parts.size() > 3);
      CHECK(mass.carving.cut_bodies == 1);
      CHECK(mass.carving.removed_bodies == 0);
      CHECK(mass.carving.separated_bodies == 0);
    }
  }

  TEST_CASE("a block that the opening cuts through becomes two bodies") {
    // A column 1 m wide between two joints; the opening, 4 m wide, takes 2 m out of its height
    // of 17.
    const std::vector<Joint> joints = {{{{-0.5, -9}, {-0.5, 10}}, 0}, {{{0.5, -9}, {0.5, 10}}, 0}};
    const auto mass =
        carve(slice(ground, joints, {}), SimplePolygon({{-2, -1}, {2, -1}, {2, 1}, {-2, 1}}), 0);
    check_carved(mass, false);
    CHECK(mass.carving.separated_bodies == 1);
    CHECK(mass.carving.cut_bodies == 3);
    REQUIRE(mass.bodies.size() == 4);  // left, right, and the column's head and foot
    std::vector<double> areas;
    for (const auto& body : mass.bodies) areas.push_back(body.properties.measure);
    std::sort(areas.begin(), areas.end());
    CHECK(std::abs(areas[0] - 7) < 1e-12);      // foot: -8 to -1
    CHECK(std::abs(areas[1] - 8) < 1e-12);      // head: 1 to 9
    CHECK(std::abs(areas[2] - 158.5) < 1e-12);  // 9.5 * 17 - 1.5 * 2
    CHECK(std::abs(areas[3] - 158.5) < 1e-12);
  }

  TEST_CASE("groups that touch in a corner only are two bodies") {
    // A square opening whose corner reaches the joint x = 0 exactly: it leaves the column to its
    // left in one piece above and below a single point.
    const std::vector<Joint> joints = {{{{0, -9}, {0, 10}}, 0}, {{{2, -9}, {2, 10}}, 0}};
    const SimplePolygon diamond({{3, 0}, {1, 2}, {0, 0}, {1, -2}});
    const auto mass = carve(slice(ground, joints, {}), diamond, 0);
    check_carved(mass, false);
    CHECK(mass.carving.separated_bodies == 1);  // the column between the joints, above and below
    CHECK(mass.bodies.size() == 4);
  }

  TEST_CASE("small pieces at the wall are dropped and counted, others are not touched") {
    const SimplePolygon opening(regular(72, 3));
    const auto all = carve(jointed_rock(ground, 3), opening, 0);
    const double smallest = 0.1;
    const auto mass = carve(jointed_rock(ground, 3), opening, smallest);
    std::size_t small = 0;
    double small_area = 0;
    for (const auto& body : all.bodies)
      if (body.properties.measure < smallest) {
        ++small;
        small_area += body.properties.measure;
      }
    REQUIRE(small >
            0);  // blocks of the mass have an inscribed radius of 0.25 m, 0.2 m2: only at the wall
    CHECK(mass.carving.dropped_pieces == small);
    CHECK(std::abs(mass.carving.dropped_measure - small_area) < 1e-14);
    CHECK(mass.bodies.size() + small == all.bodies.size());
    check_carved(mass, true);
    CHECK(wall_length(mass) > opening.perimeter() + 0.01);  // it goes round the holes
  }

  TEST_CASE("small bodies away from the wall stay, whatever the limit") {
    const std::vector<Joint> joints = {{{{9.99, -9}, {9.99, 10}}, 0}};  // a strip of 0.17 m2
    const auto mass =
        carve(slice(ground, joints, {}), SimplePolygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), 5);
    CHECK(mass.bodies.size() == 2);
    CHECK(mass.carving.dropped_pieces == 0);
  }

  TEST_CASE("an opening along existing joints has a wall too") {
    // Bricks of 1 m; the opening is four of them, or has its floor on a joint.
    std::vector<Joint> joints;
    for (int k = -9; k < 10; ++k) joints.push_back({{{1.0 * k, -9}, {1.0 * k, 10}}, 0});
    for (int k = -7; k < 9; ++k) joints.push_back({{{-11, 1.0 * k}, {11, 1.0 * k}}, 1});
    const auto bricks = slice(ground, joints, {});
    REQUIRE(bricks.bodies.size() == 340);
    for (const auto& outline : {std::vector<Vec2>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                                std::vector<Vec2>{{-1.5, -1}, {1.5, -1}, {1.5, 0.5}, {-1.5, 0.5}}})
      check_carved(carve(bricks, SimplePolygon(outline), 0), false);
  }

  TEST_CASE("a second opening: its own wall, and the report adds up") {
    const SimplePolygon left(regular(24, 2, {-4, 0})), right(regular(24, 1.5, {4, 1}));
    auto mass = carve(jointed_rock(ground, 5), left, 0);
    mass = carve(mass, right, 0);
    REQUIRE(mass.openings.size() == 2);
    CHECK(std::abs(mass.carving.removed_measure - left.area() - right.area()) < 1e-10);
    CHECK(std::abs(total_area(mass) + mass.carving.removed_measure - ground.measure()) < 1e-10);
    double length = 0;
    for (const auto& piece : wall_pieces(mass)) {
      CHECK((piece.facet.centre() - Vec2(4, 1)).norm() < 1.5 + 1e-9);
      const auto& parts = mass.bodies[static_cast<std::size_t>(piece.body)].parts;
      const Vec2 out = piece.facet.area_vector().normalized();
      CHECK(std::any_of(parts.begin(), parts.end(), [&](const ConvexPolygon& part) {
        return holds(part, piece.facet.centre() + 1e-7 * out);
      }));
      length += piece.facet.length();
    }
    CHECK(std::abs(length - right.perimeter()) < 1e-9);
  }

  TEST_CASE("the direction in which the outline is given does not matter") {
    std::vector<Vec2> clockwise = letter_l;
    std::reverse(clockwise.begin(), clockwise.end());
    const auto one = carve(jointed_rock(ground, 6), SimplePolygon(letter_l), 0);
    const auto other = carve(jointed_rock(ground, 6), SimplePolygon(clockwise), 0);
    REQUIRE(one.bodies.size() == other.bodies.size());
    for (std::size_t b = 0; b < one.bodies.size(); ++b)
      CHECK(one.bodies[b].properties.measure == other.bodies[b].properties.measure);
  }

  TEST_CASE("bodies away from the opening are left as they were, bit for bit") {
    const auto before = jointed_rock(ground, 7);
    const auto after = carve(before, SimplePolygon(regular(24, 1, {6, 5})), 0);
    std::size_t same = 0;
    for (const auto& body : after.bodies)
      same += static_cast<std::size_t>(std::count_if(
          before.bodies.begin(), before.bodies.end(),
          [&](const auto& old) { return old.parts[0].vertices() == body.parts[0].vertices(); }));
    // Each body within the bounding box of the opening (2 m x 2 m of 340 m2) is at risk, no other.
    CHECK(same + after.carving.cut_bodies + after.carving.removed_bodies == before.bodies.size());
  }

  TEST_CASE("an opening that touches or leaves the domain is refused, and the place named") {
    const auto rock = slice(ground, {}, {});
    const auto refused = [&](const std::vector<Vec2>& outline) {
      try {
        (void)carve(rock, SimplePolygon(outline), 0);
      } catch (const InvalidInput& error) {
        return std::string(error.what());
      }
      return std::string("accepted");
    };
    CHECK(refused({{0, 0}, {10, 0}, {0, 1}}).find("(10, 0) m") != std::string::npos);
    CHECK(refused({{0, 0}, {1, 0}, {0, 9.5}}).find("touches or leaves the domain") !=
          std::string::npos);
    CHECK(refused({{-10, -8}, {1, 0}, {0, 1}}) != "accepted");
    CHECK(refused({{20, 20}, {21, 20}, {20, 21}}) != "accepted");
    CHECK(refused({{0, 0}, {9.99, 0}, {0, 1}}) == "accepted");
  }

  TEST_CASE("if every piece is below the smallest, nothing is left and that is said") {
    CHECK_THROWS_WITH_AS((void)carve(slice(ground, {}, {}), SimplePolygon(letter_l), 1e4),
                         "opening: no rock is left around it", InvalidInput);
  }

  TEST_CASE("rock without an opening has no wall") {
    CHECK(wall_pieces(jointed_rock({{-3, -3}, {3, 3}}, 1)).empty());
  }
}

}  // namespace carving_test
