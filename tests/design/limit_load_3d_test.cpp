// SPDX-License-Identifier: MIT
// The bound by limit analysis in 3-D: closed forms, sections made thick, and all of it turned.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/design/limit_load.hpp>

#include "support/degree.hpp"
#include "support/laid_limit_problem.hpp"
#include "support/laid_problem.hpp"
#include "support/near.hpp"

namespace limit_load_3d_test {

using namespace voussoir;
using namespace voussoir::design;
using namespace voussoir_test;

namespace {

using Problem = LimitProblem<3>;

/// Rock that does not move.
Problem rock() {
  Problem problem;
  problem.blocks.push_back({Vec3(0, 0, -1), 1, 1, {}, false});
  return problem;
}

void add_block(Problem& problem, const Vec3& centre, const Vec3& force,
               const Vec3& moment = zeros<Vec3>()) {
  problem.blocks.push_back({centre, 1e4, 0.5, {force, moment}, true});
}

Problem turned_by(const Rotation<3>& rotation, Problem problem) {
  for (auto& block : problem.blocks) {
    block.centre = rotation * block.centre;
    block.load = {rotation * block.load.force, rotation * block.load.moment};
  }
  for (auto& corner : problem.corners) {
    corner.place = rotation * corner.place;
    corner.normal = rotation * corner.normal;
  }
  for (auto& edge : problem.edges) {
    edge.place = rotation * edge.place;
    edge.outward = rotation * edge.outward;
  }
  return problem;
}

/// Both ends, within what may be missing of a block's weight, 1e-5; and as much when all is turned.
void check_limit(const Problem& problem, double expected) {
  CAPTURE(expected);
  for (const Vec3& spin : {zeros<Vec3>(), Vec3(0.7, -1.1, 0.4)}) {
    const LimitBound bound = limit_load(turned_by(rotation_by(spin), problem), {.width = 1e-6});
    REQUIRE(bound.is_closed());
    CHECK(bound.holds == near(expected).epsilon(5e-5));
    CHECK(bound.fails == near(expected).epsilon(5e-5));
    CHECK(bound.gap() <= 1.001e-6);
  }
}

bool is_held(const Problem& problem) {
  return limit_load(problem, {.width = 1, .least = 1}).holds >= 1;
}

/// A corner of a regular polygon.
Vec3 on_circle(double radius, double angle, double height = 0) {
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

std::vector<Vec3> square(double side, double height = 0) {
  const double h = 0.5 * side;
  return {{-h, -h, height}, {h, -h, height}, {h, h, height}, {-h, h, height}};
}

/// A block 1 m thick, on level rock, under a force at its centre half a metre above.
Problem block_on_rock(const Vec3& force, const JointStrength& strength, double side = 2) {
  Problem problem = rock();
  add_block(problem, {0, 0, 0.5}, force);
  problem.add_contact(0, 1, square(side), Vec3(0, 0, 1), strength);
  return problem;
}

/// A regular pyramid, point up, in a roof of rock that does not move.
Problem pyramid(int faces, double semi_apical, double turned, double friction) {
  Problem problem = rock();
  constexpr double height = 2;
  add_block(problem, {0, 0, 0.25 * height}, {0, 0, -1e4});
  const double out = height * std::tan(semi_apical) / std::cos(std::numbers::pi / faces);
  for (int k = 0; k < faces; ++k) {
    const double from = turned + 2 * std::numbers::pi * k / faces,
                 to = from + 2 * std::numbers::pi / faces;
    const Vec3 outward = on_circle(std::cos(semi_apical), 0.5 * (from + to), std::sin(semi_apical));
    problem.add_contact(1, 0, {on_circle(out, from), on_circle(out, to), Vec3(0, 0, height)},
                        outward, {friction, 0, 0});
  }
  return problem;
}

/// A section of this thickness: blocks that touch along lines touch along rectangles.
Problem thickened(const LaidProblem& laid, double friction, double thickness) {
  Problem problem;
  const auto at = [](const Vec2& p, double along) { return Vec3(p.x(), along, p.y()); };
  // Anticlockwise in the section is clockwise about its normal, which points away from the eye.
  for (const auto& flat : limit_problem(laid, {}).blocks)
    problem.blocks.push_back(
        {at(flat.centre, 0.5 * thickness),
         flat.weight * thickness,
         flat.gyration,
         {thickness * at(flat.load.force, 0), thickness * Vec3(0, -flat.load.moment[0], 0)},
         flat.is_free});
  for (const FlatJoint& joint : joints_of(laid))
    problem.add_contact(
        joint.a, joint.b,
        {at(joint.p, 0), at(joint.q, 0), at(joint.q, thickness), at(joint.p, thickness)},
        at(joint.normal, 0), {friction, 0, 0});
  return problem;
}

}  // namespace

TEST_SUITE("design/limit_load_3d") {
  TEST_CASE("a block slides down whichever way the rock dips, by friction and cohesion") {
    for (const double way : {0.0, 17.0, 45.0, 100.0, 211.0}) {
      CAPTURE(way);
      const double dip = 25 * degree, w = 1e4;
      const Vec3 down = on_circle(w * std::sin(dip), way * degree, -w * std::cos(dip));
      check_limit(block_on_rock(down, {std::tan(50 * degree), 0, 0}),
                  std::tan(50 * degree) / std::tan(dip));
      check_limit(block_on_rock(down, {std::tan(15 * degree), 3e3, 0}),
                  (3e3 * 4 / w + std::cos(dip) * std::tan(15 * degree)) / std::sin(dip));
      check_limit(block_on_rock(down, {0, 3e3, 0}), 3e3 * 4 / w / std::sin(dip));
    }
  }

  TEST_CASE("a block that hangs on its bond comes off, with what tension leaves of its shear") {
    check_limit(block_on_rock({0, 0, 1e4}, {0.5, 5e3, 6e3}), 6e3 * 4 / 1e4);
    // Pulled along too, by a force in the plane of its bond: 5e3 A / F = T + 0.5 N / F.
    Problem pulled = block_on_rock({3e3, -4e3, 1e4}, {0.5, 5e3, 1e4});
    pulled.blocks[1].centre.z() = 0;
    check_limit(pulled, (5e3 * 4 - 0.5 * 1e4) / 5e3);
  }

  TEST_CASE("a column tips about an edge or a corner of its base, whichever way it is pushed") {
    // 1 x 1 x 3: the resultant leaves the square.
    for (int way = 0; way <= 90; way += 9) {
      CAPTURE(way);
      const double c = std::cos(way * degree), s = std::sin(way * degree),
                   push = 0.5 / std::max(c, s) / 1.5;
      for (const double part : {0.99, 1.01}) {
        const Vec3 force = part * push * 1e4 * Vec3(c, s, 0) + Vec3(0, 0, -1e4);
        Problem column = block_on_rock(force, {2, 0, 0}, 1);
        column.blocks[1].centre.z() = 1.5;
        CHECK(is_held(column) == (part < 1));
      }
    }
  }

  TEST_CASE("a square that is turned on its base is held by friction at its corners") {
    Problem problem = block_on_rock({0, 0, -1e4}, {0.8, 0, 0});
    problem.blocks[1].load.moment = Vec3(0, 0, 4e3);
    check_limit(problem, 0.8 * 1e4 * std::sqrt(2.0) / 4e3);
  }

  TEST_CASE("pyramids in a roof fall where friction is less than their half angle") {
    Random random(1, 5);
    for (int number = 0; number < 16; ++number) {
      const int faces = 3 + number % 4;
      const double semi_apical = (10 + 30 * random.uniform()) * degree,
                   turned = 2 * std::numbers::pi * random.uniform();
      CAPTURE(faces);
      CAPTURE(semi_apical / degree);
      // Rock that does not move presses as hard as it must: the normals balance one another.
      check_limit(pyramid(faces, semi_apical, turned, 1.2), 1.2 / std::tan(semi_apical));
    }
  }

  TEST_CASE("a section that is made thick has the limit of the section") {
    // What holds it in 3-D and its mirror image together have no force along the thickness.
    for (int number = 1; number <= 12; ++number) {
      CAPTURE(number);
      LaidProblem stack = random_stack(number);
      stack.add(stack.pushed(Vec2(1, 0), 0.1));
      const double thickness = 0.5 + 0.25 * number;
      const LimitBound section = limit_load(limit_problem(stack, {0.7, 0, 0}), {.width = 1e-5}),
                       thick = limit_load(thickened(stack, 0.7, thickness), {.width = 1e-5});
      CHECK(thick.is_closed() == section.is_closed());
      if (!section.is_closed()) continue;
      CHECK(thick.fails == near(section.fails).epsilon(5e-5));
      CHECK(thick.holds == near(section.holds).epsilon(5e-5));
    }
    const LimitBound slope =
                         limit_load(limit_problem(toppling_slope(), {1, 0, 0}), {.width = 1e-5}),
                     thick = limit_load(thickened(toppling_slope(), 1, 3), {.width = 1e-5});
    CHECK(thick.fails == near(slope.fails).epsilon(5e-5));
  }

  TEST_CASE("shares of a contact add up to its area, and to its centre") {
    Problem problem = rock();
    add_block(problem, {0, 0, 1}, {0, 0, -1});
    const std::vector<Vec3> facet{{0, 0, 0}, {3, 0, 0}, {4, 1, 0}, {2, 3, 0}, {0, 2, 0}};
    problem.add_contact(0, 1, facet, Vec3(0, 0, 1), {0.5, 1e3, 0});
    double area = 0;
    Vec3 moment = zeros<Vec3>();
    for (const auto& corner : problem.corners) {
      area += corner.share;
      moment += corner.share * corner.place;
    }
    CHECK(area == near(8.5));  // by the shoelace formula
    CHECK(moment.x() / area == near(89.0 / 6 / 8.5));
    CHECK(moment.y() / area == near(10.5 / 8.5));
  }
}

}  // namespace limit_load_3d_test
