// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
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
#include <voussoir/rockmass/block_intersections.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/statistics.hpp>

#include "support/boost_polygon.hpp"
#include "support/jointed_rock.hpp"

namespace slicing_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;
using voussoir_test::paper_sets;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const Domain<2> paper_ground{{-35, -35}, {35, 25}};

double total_area(const RockMass<Planar>& mass) {
  double sum = 0;
  for (const auto& body : mass.bodies) sum += body.properties.measure;
  return sum;
}

/// Spacing over 21 lines across the paper's ground.
double mean_spacing(const RockMass<Planar>& mass, bool vertical) {
  double length = 0, crossings = 0;
  for (int k = -10; k <= 10; ++k) {
    const double at = 2.5 * k + 0.123;
    const Segment line =
        vertical ? Segment{{at, -30}, {at, 20}} : Segment{{-30, at - 5}, {30, at - 5}};
    length += line.length();
    crossings += static_cast<double>(block_intersections(mass, line).size() - 1);
  }
  return length / crossings;
}

// ---- the plain loop that the tree must agree with ----------------------------------------------

struct PlainBlock {
  std::vector<Vec2> corners;  ///< anticlockwise
};

double signed_distance(const Segment& line, const Vec2& p) {
  return cross(line.end - line.start, p - line.start) / line.length();
}

double plain_area(const PlainBlock& block) {
  double twice = 0;
  for (std::size_t k = 0; k < block.corners.size(); ++k)
    twice += cross(block.corners[k], block.corners[(k + 1) % block.corners.size()]);
  return 0.5 * twice;
}

Vec2 plain_centroid(const PlainBlock& block) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < block.corners.size(); ++k) {
    const Vec2 &a = block.corners[k], &b = block.corners[(k + 1) % block.corners.size()];
    sum += cross(a, b) * (a + b);
  }
  return sum / (6 * plain_area(block));
}

/// Largest inscribed circle by bisection: push every face inwards by r and see whether anything is
/// left of a square that is cut by all of them.
double plain_inscribed_radius(const PlainBlock& block) {
  const auto something_left = [&](double r) {
    std::vector<Vec2> left = block.corners;
    for (std::size_t k = 0; k < block.corners.size(); ++k) {
      const Segment face{block.corners[k], block.corners[(k + 1) % block.corners.size()]};
      std::vector<Vec2> next;
      for (std::size_t i = 0; i < left.size(); ++i) {
        const Vec2 &a = left[i], &b = left[(i + 1) % left.size()];
        const double da = signed_distance(face, a) - r, db = signed_distance(face, b) - r;
        if (da >= 0) next.push_back(a);
        if (da * db < 0) next.emplace_back(a + da / (da - db) * (b - a));
      }
      left = next;
    }
    return !left.empty();
  };
  double low = 0, high = std::sqrt(plain_area(block));
  for (int k = 0; k < 60; ++k)
    (something_left(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

/// Length of a joint inside a block.
double reach_inside(const PlainBlock& block, const Segment& joint) {
  double from = 0, to = 1;
  for (std::size_t k = 0; k < block.corners.size(); ++k) {
    const Segment face{block.corners[k], block.corners[(k + 1) % block.corners.size()]};
    const double a = signed_distance(face, joint.start), b = signed_distance(face, joint.end);
    if (a < 0 && b < 0) return 0;
    if (a < 0) from = std::max(from, a / (a - b));
    if (b < 0) to = std::min(to, a / (a - b));
  }
  return (to - from) * joint.length();
}

std::vector<PlainBlock> plain_slicing(const Domain<2>& ground, const std::vector<Joint>& joints,
                                      const BlockLimits& limits) {
  std::vector<PlainBlock> blocks = {{as_block(ground).vertices()}};
  for (const Joint& joint : joints) {
    const std::size_t before = blocks.size();
    for (std::size_t b = 0; b < before; ++b) {
      if (reach_inside(blocks[b], joint.trace) < 1e-8) continue;
      PlainBlock left, right;
      const auto& corners = blocks[b].corners;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec2 &here = corners[k], &next = corners[(k + 1) % corners.size()];
        const double a = signed_distance(joint.trace, here), c = signed_distance(joint.trace, next);
        (a > 0 ? left : right).corners.push_back(here);
        if (a * c < 0) {
          const Vec2 crossing = here + a / (a - c) * (next - here);
          left.corners.push_back(crossing);
          right.corners.push_back(crossing);
        }
      }
      if (left.corners.size() < 3 || right.corners.size() < 3) continue;
      bool allowed = true;
      for (const PlainBlock& part : {left, right}) {
        const double radius = plain_inscribed_radius(part);
        double diagonal = 0;
        for (const Vec2& p : part.corners)
          for (const Vec2& q : part.corners) diagonal = std::max(diagonal, (p - q).norm());
        allowed = allowed && radius >= limits.min_inscribed_radius &&
                  diagonal <= 2 * radius * limits.max_elongation;
      }
      if (!allowed) continue;
      blocks[b] = left;
      blocks.push_back(right);
    }
  }
  return blocks;
}

// ---- a geometry that counts how often a joint is clipped at a cut ------------------------------

std::size_t visits = 0;

struct CountedTrace {
  CountedTrace(const Segment& given) : segment(given) {}  // not explicit: takes a Segment's place
  operator const Segment&() const {
    ++visits;
    return segment;
  }
  Segment segment;
};
struct CountedPlanar : Planar {
  using Trace = CountedTrace;
};

}  // namespace

TEST_SUITE("rockmass/slicing") {
  TEST_CASE("blocks fill the domain, obey the limits and are convex") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      const BlockLimits limits{0.25, 5};
      const auto mass = jointed_rock(paper_ground, seed, limits);
      // 5700 areas are added, each known to 1e-15: the sum to well below 1e-12.
      CHECK(std::abs(total_area(mass) / paper_ground.measure() - 1) < 1e-12);
      CHECK(mass.bodies.size() == mass.slicing.cuts + 1);
      CHECK(mass.cuts.size() == mass.slicing.cuts + 4);
      for (const auto& body : mass.bodies) {
        REQUIRE(body.parts.size() == 1);
        const ConvexPolygon& block = body.parts[0];
        const double radius = inscribed_ball(block).radius;
        CHECK(radius >=
              0.25 - 1e-14);  // the limit was tested on the same block, differently added up
        CHECK(block.diameter() <= 5 * 2 * radius * (1 + 1e-13));
        double turning = 0;
        for (std::size_t k = 0; k < block.size(); ++k) {
          const Vec2 u = block.face(k).end - block.face(k).start;
          const Segment next = block.face((k + 1) % block.size());
          const Vec2 v = next.end - next.start;
          // Corners may be straight but for the rounding of coordinates at 35 m, 7e-15 m.
          CHECK(cross(u, v) >= -3e-14 * (u.norm() + v.norm()));
          turning += std::atan2(cross(u, v), u.dot(v));
        }
        CHECK(std::abs(turning - 2 * std::numbers::pi) < 1e-9);
      }
    }
  }

  TEST_CASE("Boost.Geometry finds the blocks valid, convex and apart from each other") {
    namespace boost_polygon = voussoir_test::boost_polygon;
    const auto mass = jointed_rock({{-6, -5}, {6, 5}}, 4);
    std::vector<boost_polygon::Outline> blocks;
    for (const auto& body : mass.bodies) {
      const auto corners = body.parts[0].vertices();
      const boost_polygon::Outline& block = blocks.emplace_back(corners.begin(), corners.end());
      CHECK(boost_polygon::is_valid(block));
      CHECK(std::abs(boost_polygon::area(block) - boost_polygon::area_of_convex_hull(block)) <
            1e-13);  // rounded at 6 m
    }
    CHECK(blocks.size() > 100);
    // No centroid lies in another block: together with the sum of areas, they do not overlap.
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const Vec2 c = mass.bodies[i].properties.centroid;
      for (std::size_t j = 0; j < blocks.size(); ++j)
        CHECK(boost_polygon::contains(blocks[j], c) == (i == j));
    }
  }

  TEST_CASE("the same seed gives the same rock bit for bit, another seed another") {
    const Domain<2> ground{{-10, -10}, {10, 10}};
    const auto one = jointed_rock(ground, 1), again = jointed_rock(ground, 1),
               other = jointed_rock(ground, 2);
    REQUIRE(again.bodies.size() == one.bodies.size());
    for (std::size_t b = 0; b < one.bodies.size(); ++b) {
      const ConvexPolygon &x = one.bodies[b].parts[0], &y = again.bodies[b].parts[0];
      REQUIRE(x.size() == y.size());
      for (std::size_t k = 0; k < x.size(); ++k) {
        CHECK(x.vertex(k) == y.vertex(k));  // == is meant
        CHECK(x.cut(k) == y.cut(k));
      }
    }
    CHECK((other.bodies.size() != one.bodies.size() ||
           other.bodies[0].properties.centroid != one.bodies[0].properties.centroid));
  }

  TEST_CASE("the reference masses have the block counts and spacings of the study") {
    // Another program measured, with its own random numbers: mass A (r 0.25, L 1, mr 5) s = 0.63, B
    // (0.36, 2, 5) s = 0.775, C (0.5, 5, none) 2041 blocks, s = 0.99, and for r 0.25, L 1 without a
    // limit 5759 blocks, s = 0.60. Realisations differ by about 0.01 in s and 1 % in number; three
    // are averaged, and the bounds are 0.03 (0.04 for B) and 3 %.
    struct Reference {
      double radius, elongation, extent, blocks, spacing, margin;
    };
    for (const Reference& r :
         {Reference{0.25, 5, 1, 5700, 0.63, 0.03}, Reference{0.36, 5, 2, 3540, 0.775, 0.04},
          Reference{0.50, inf, 5, 2041, 0.99, 0.03}, Reference{0.25, inf, 1, 5759, 0.60, 0.03}}) {
      CAPTURE(r.radius);
      CAPTURE(r.elongation);
      double blocks = 0, spacing = 0;
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto mass = jointed_rock(paper_ground, seed, {r.radius, r.elongation}, r.extent);
        blocks += static_cast<double>(mass.bodies.size()) / 3;
        spacing += radial_spacing(mass, {0, 0}, 5, 10) / 3;
      }
      CHECK(std::abs(blocks / r.blocks - 1) < 0.03);
      CHECK(std::abs(spacing - r.spacing) < r.margin);
      // Faces at least r from the incentre: the mean chord is pi A / P >= pi r / 2.
      CHECK(spacing > 0.5 * std::numbers::pi * r.radius);
    }
  }

  TEST_CASE("slicing set by set gives another, useless rock") {
    // The study, r 0.5 and L 5: shuffled 0.95 vertical against 1.08 horizontal, ratio 0.88; set 1
    // first 1.63 against 0.69, ratio 2.4. The bounds lie far from both, for realisations scatter.
    const auto shuffled = jointed_rock(paper_ground, 1, {0.5, inf}, 5);
    auto sorted_joints = shuffled.joints;
    std::stable_sort(sorted_joints.begin(), sorted_joints.end(),
                     [](const Joint& a, const Joint& b) { return a.set < b.set; });
    const auto sorted = slice(paper_ground, sorted_joints, {0.5, inf});
    const double good = mean_spacing(shuffled, true) / mean_spacing(shuffled, false);
    const double bad = mean_spacing(sorted, true) / mean_spacing(sorted, false);
    CHECK(good > 0.75);
    CHECK(good < 1.0);
    CHECK(bad > 2.0);
    CHECK(bad < 3.0);
  }

  TEST_CASE("a plain loop over all blocks and joints gives the same blocks") {
    struct Case {
      double radius, elongation, extent;
    };
    const Domain<2> ground{{-5, -4}, {6, 5}};
    for (const Case& c : {Case{0.25, 5, 1}, Case{0.3, inf, 4}, Case{0.2, 3, inf}, Case{0, inf, 1}})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        CAPTURE(c.radius);
        CAPTURE(c.extent);
        CAPTURE(seed);
        const BlockLimits limits{c.radius, c.elongation};
        const auto mass = jointed_rock(ground, seed, limits, c.extent);
        const auto plain = plain_slicing(ground, mass.joints, limits);
        REQUIRE(mass.bodies.size() == plain.size());
        struct Key {
          double x, y, area;
          auto operator<=>(const Key&) const = default;
        };
        std::vector<Key> ours, theirs;
        for (const auto& body : mass.bodies)
          ours.push_back({body.properties.centroid.x(), body.properties.centroid.y(),
                          body.properties.measure});
        for (const PlainBlock& block : plain)
          theirs.push_back(
              {plain_centroid(block).x(), plain_centroid(block).y(), plain_area(block)});
        std::sort(ours.begin(), ours.end());
        std::sort(theirs.begin(), theirs.end());
        double worst_area = 0, worst_centroid = 0;
        for (std::size_t k = 0; k < ours.size(); ++k) {
          worst_area = std::max(worst_area, std::abs(ours[k].area - theirs[k].area));
          worst_centroid =
              std::max({worst_centroid, std::abs(ours[k].x - theirs[k].x) * theirs[k].area,
                        std::abs(ours[k].y - theirs[k].y) * theirs[k].area});
        }
        // The textbook sums of the plain loop round at 50 m2 and 300 m3: 1e-14 and 1e-13.
        CHECK(worst_area < 1e-12);
        CHECK(worst_centroid < 1e-11);
      }
  }

  TEST_CASE("the report accounts for every joint and every cut not made") {
    const auto mass = jointed_rock(paper_ground, 1);
    CHECK(mass.slicing.joints == 12600);
    CHECK(mass.joints.size() == 12600);
    CHECK(mass.slicing.cuts == mass.bodies.size() - 1);
    std::vector<bool> used(mass.joints.size(), false);
    for (const Cut& cut : mass.cuts)
      if (cut.kind == Cut::Kind::joint) used[static_cast<std::size_t>(cut.source)] = true;
    CHECK(mass.slicing.unused_joints ==
          static_cast<std::size_t>(std::count(used.begin(), used.end(), false)));
    CHECK(mass.slicing.refused_too_small > 0);
    CHECK(mass.slicing.refused_too_long > 0);
    // One by one: used is what the cuts name, outside what a box test says.
    REQUIRE(mass.slicing.fates.size() == mass.joints.size());
    for (std::size_t k = 0; k < used.size(); ++k) {
      CHECK((mass.slicing.fates[k] == JointFate::used) == used[k]);
      const Segment& trace = mass.joints[k].trace;
      const bool beside = std::max(trace.start.x(), trace.end.x()) < -35 ||
                          std::min(trace.start.x(), trace.end.x()) > 35 ||
                          std::max(trace.start.y(), trace.end.y()) < -35 ||
                          std::min(trace.start.y(), trace.end.y()) > 25;
      if (beside) CHECK(mass.slicing.fates[k] == JointFate::outside);
    }
    CHECK(static_cast<std::size_t>(std::count(mass.slicing.fates.begin(), mass.slicing.fates.end(),
                                              JointFate::outside)) == mass.slicing.outside_joints);

    const auto free = jointed_rock({{0, 0}, {10, 10}}, 1, {0, inf});
    CHECK(free.slicing.refused_too_small == 0);
    CHECK(free.slicing.refused_too_long == 0);
  }

  TEST_CASE("every face lies on the joint or the side that its cut names") {
    const Domain<2> ground{{-10, -10}, {10, 10}};
    const auto mass = jointed_rock(ground, 5);
    for (const auto& body : mass.bodies)
      for (std::size_t k = 0; k < body.parts[0].size(); ++k) {
        const Segment face = body.parts[0].face(k);
        const Cut& cut = mass.cuts[static_cast<std::size_t>(body.parts[0].cut(k))];
        HalfSpace<2> line;
        if (cut.kind == Cut::Kind::joint) {
          const Segment& trace = mass.joints[static_cast<std::size_t>(cut.source)].trace;
          line = left_of(trace.start, trace.end);
        } else {
          switch (static_cast<Side>(cut.source)) {
            case Side::left:
              line = {{-1, 0}, 10};
              break;
            case Side::bottom:
              line = {{0, -1}, 10};
              break;
            case Side::right:
              line = {{1, 0}, 10};
              break;
            case Side::top:
              line = {{0, 1}, 10};
              break;
          }
        }
        // New vertices are rounded at 10 m, and again where a later cut shortens the face.
        CHECK(std::abs(line.distance(face.start)) < 1e-13);
        CHECK(std::abs(line.distance(face.end)) < 1e-13);
      }
  }

  TEST_CASE(
      "the work per block grows like the depth of the tree, not with the size of the ground") {
    // Four times the area, four times the joints: a loop over all blocks would do four times the
    // work per block, the tree adds the clips of two levels (log2 4).
    // Measured: 21.8, 26.7, 32.9, 38.2.
    std::vector<double> per_block;
    for (const double half : {5.0, 10.0, 20.0, 40.0}) {
      const Domain<2> ground{{-half, -half}, {half, half}};
      const auto joints = joint_network(paper_sets(), ground, 1);
      visits = 0;
      const auto mass = slice<CountedPlanar>(ground, joints, {0.25, 5});
      per_block.push_back(static_cast<double>(visits) / static_cast<double>(mass.bodies.size()));
      CHECK(mass.bodies.size() == slice(ground, joints, {0.25, 5}).bodies.size());
    }
    for (std::size_t k = 1; k < per_block.size(); ++k) CHECK(per_block[k] < 1.4 * per_block[k - 1]);
  }

  TEST_CASE("without joints the ground is one block, its faces labelled by side") {
    const auto mass = slice({{0, 0}, {3, 2}}, {}, {0.25, 5});
    REQUIRE(mass.bodies.size() == 1);
    const ConvexPolygon& block = mass.bodies[0].parts.at(0);
    CHECK(mass.bodies[0].properties.measure == 6);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 out = block.half_space(k).normal;
      const Cut cut = mass.cuts.at(static_cast<std::size_t>(block.cut(k)));
      CHECK(cut.kind == Cut::Kind::boundary);
      switch (static_cast<Side>(cut.source)) {
        case Side::left:
          CHECK(out == Vec2(-1, 0));
          break;
        case Side::bottom:
          CHECK(out == Vec2(0, -1));
          break;
        case Side::right:
          CHECK(out == Vec2(1, 0));
          break;
        case Side::top:
          CHECK(out == Vec2(0, 1));
          break;
      }
    }
  }

  TEST_CASE("a joint cuts right through every block it reaches, and no other") {
    const Domain<2> ground{{0, 0}, {4, 4}};
    // Two vertical joints make three columns; a short horizontal one ends in the second.
    const std::vector<Joint> joints = {
        {{{1, -1}, {1, 5}}, 0}, {{{3, -1}, {3, 5}}, 0}, {{{0.5, 2}, {1.5, 2}}, 1}};
    const auto mass = slice(ground, joints, {});
    std::vector<double> areas;
    for (const auto& body : mass.bodies) areas.push_back(body.properties.measure);
    std::sort(areas.begin(), areas.end());
    CHECK(areas == std::vector<double>{2, 2, 4, 4, 4});  // columns 1, 2, 1 wide; two of them halved
    // A joint that ends on a cut does not go on behind it.
    auto ending = joints;
    ending[2].trace.end = {1, 2};
    CHECK(slice(ground, ending, {}).bodies.size() == 4);
    ending[2].trace.end = {1 + 1e-6, 2};
    CHECK(slice(ground, ending, {}).bodies.size() == 5);
  }

  TEST_CASE("coincident joints cut once") {
    const Domain<2> ground{{0, 0}, {4, 4}};
    const Joint joint{{{-1, 1}, {5, 3}}, 0};
    for (const Joint& other : {joint, Joint{{{5, 3}, {-1, 1}}, 0}, Joint{{{1, 5.0 / 3}, {2, 2}}, 0},
                               Joint{{{-1, 1 + 1e-11}, {5, 3 - 1e-11}}, 0}}) {
      const auto mass = slice(ground, {joint, other}, {});
      CHECK(mass.bodies.size() == 2);
      CHECK(mass.slicing.cuts == 1);
      CHECK(mass.slicing.unused_joints == 1);
      CHECK(std::abs(total_area(mass) - 16) < 1e-14);
    }
  }

  TEST_CASE("many joints through one point: each makes two blocks, none smaller than rounding") {
    const Domain<2> ground{{-2, -2}, {2, 2}};
    for (const int count : {3, 4, 7, 12}) {
      CAPTURE(count);
      std::vector<Joint> joints;
      for (int k = 0; k < count; ++k) {
        const double angle = std::numbers::pi * (k + 0.3) / count;
        const Vec2 along(std::cos(angle), std::sin(angle)), meet(0.25, -0.5);
        joints.push_back({{meet - 5 * along, meet + 5 * along}, k});
      }
      const auto mass = slice(ground, joints, {});
      // n lines through one inner point make 2 n sectors.
      CHECK(mass.bodies.size() == static_cast<std::size_t>(2 * count));
      CHECK(std::abs(total_area(mass) - 16) < 1e-14 * 16);
      for (const auto& body : mass.bodies) CHECK(body.properties.measure > 1e-3);
    }
  }

  TEST_CASE("horizontal and vertical sets make a grid of bricks") {
    const Domain<2> ground{{0, 0}, {10, 5}};
    std::vector<Joint> joints;
    for (int k = 1; k < 10; ++k) joints.push_back({{{1.0 * k, -1}, {1.0 * k, 6}}, 0});
    for (int k = 1; k < 5; ++k) joints.push_back({{{-1, 1.0 * k}, {11, 1.0 * k}}, 1});
    Random(3).shuffle(joints);
    const auto mass = slice(ground, joints, {0.5, inf});  // exactly what a unit square has
    REQUIRE(mass.bodies.size() == 50);
    for (const auto& body : mass.bodies) {
      CHECK(body.parts[0].size() == 4);
      CHECK(std::abs(body.properties.measure - 1) < 1e-14);
    }
  }

  TEST_CASE("slivers are refused when limits say so, and kept when not") {
    const Domain<2> ground{{0, 0}, {4, 4}};
    const std::vector<Joint> joints = {{{{-1, 2}, {5, 2}}, 0}, {{{-1, 2.001}, {5, 2.001}}, 0}};
    const auto kept = slice(ground, joints, {});
    CHECK(kept.bodies.size() == 3);
    CHECK(std::abs(block_sizes(kept).smallest - 0.004) < 1e-14);
    const auto small = slice(ground, joints, {0.01, inf});
    CHECK(small.bodies.size() == 2);
    CHECK(small.slicing.refused_too_small == 1);
    const auto elongated = slice(ground, joints, {0, 100});  // 4 m long, 1 mm thick: 4000
    CHECK(elongated.bodies.size() == 2);
    CHECK(elongated.slicing.refused_too_long == 1);
    CHECK(slice(ground, joints, {0, 4001}).bodies.size() == 3);
  }

  TEST_CASE("the limits decide at their very value") {
    const Domain<2> ground{{0, 0}, {4, 1}};
    const auto at = [&](double x, const BlockLimits& limits) {
      return slice(ground, {{{{x, -1}, {x, 2}}, 0}}, limits).bodies.size();
    };
    // The left part is x wide and 1 high: inscribed radius x/2 for x <= 1.
    CHECK(at(0.5, {0.2500001, inf}) == 1);
    CHECK(at(0.5, {0.2499999, inf}) == 2);
    CHECK(at(3.5, {0.2500001, inf}) == 1);  // the other child counts as well
    // The left part is 0.2 x 1: diagonal sqrt(1.04) over diameter 0.2 is 5.0990; the ground
    // is 4.12.
    CHECK(at(0.2, {0, 5.098}) == 1);
    CHECK(at(0.2, {0, 5.100}) == 2);
  }

  TEST_CASE("a domain longer than the limit allows is cut like any other") {
    // 5682 blocks on the 4200 m^2 of the paper's ground: 1.35 per m^2, +-1 % from seed to seed.
    for (const Vec2& size : {Vec2(300, 28), Vec2(28, 300), Vec2(600, 60)}) {
      CAPTURE(size.x());
      const Domain<2> ground{-0.5 * size, 0.5 * size};
      const auto mass = jointed_rock(ground, 1);
      CHECK(mass.slicing.refused_too_long < mass.slicing.offered_cuts() / 10);
      const double density = static_cast<double>(mass.bodies.size()) / ground.measure();
      CHECK(density > 1.30);
      CHECK(density < 1.40);
      for (const auto& body : mass.bodies) {
        const ConvexPolygon& block = body.parts[0];
        REQUIRE(block.diameter() <= 10 * inscribed_ball(block).radius * (1 + 1e-13));
      }
    }
  }

  TEST_CASE(
      "domains of 1:1 to 1:20, lying and standing, in sets that nobody picked: as many blocks") {
    Random random(20, 7);
    for (int n = 0; n < 4; ++n) {
      CAPTURE(n);
      std::vector<JointSet> sets;
      for (int k = 0; k < 3; ++k) {
        JointSet& set = sets.emplace_back();
        set.name = "J" + std::to_string(k);
        set.dip = (10 + 25 * k + 20 * random.uniform()) * degree;
        set.dip_direction = random.below(2) == 0 ? DipDirection::east : DipDirection::west;
        set.dip_deviation = 3 * degree;
        set.spacing = 0.6 + 0.8 * random.uniform();
        set.extent = (3 + 5 * random.uniform()) * set.spacing;
      }
      double least = inf, most = 0;
      for (const double ratio : {1.0, 3.0, 10.0, 20.0})
        for (const bool stands : {false, true}) {
          const double across = std::sqrt(12000 / ratio);  // 24 m at 1:20
          const Vec2 size = stands ? Vec2(across, ratio * across) : Vec2(ratio * across, across);
          const Domain<2> ground{-0.5 * size, 0.5 * size};
          const auto mass = slice(ground, joint_network(sets, ground, 5), {0.15, 5});
          const double density = static_cast<double>(mass.bodies.size()) / ground.measure();
          least = std::min(least, density);
          most = std::max(most, density);
        }
      // Blocks at the edge are parts of blocks, and 1:20 has 2.3 times as much edge as 1:1.
      CHECK(std::sqrt(most / least) < 1.05);  // of the spacing
    }
  }

  TEST_CASE("of a block that is too long a cut is refused only if a part is worse") {
    // 10 x 1: the longest diagonal is sqrt(101), the elongation 10.05.
    const Domain<2> slab{{0, 0}, {10, 1}};
    const auto cut = [&](const Vec2& from, const Vec2& to) {
      return slice(slab, {Joint{{from, to}, 0}}, {0, 5}).slicing;
    };
    CHECK(cut({3, -1}, {3, 2}).cuts == 1);  // 7 x 1 is still too long, but less so
    CHECK(cut({9.5, -1}, {9.5, 2}).cuts == 1);
    // A corner of 45 degrees (elongation 2.4) goes: the other diagonal stays, as long as before.
    CHECK(cut({9.4, -0.1}, {10.1, 0.6}).cuts == 1);
    CHECK(cut({-1, 0.5}, {11, 0.5}).refused_too_long == 1);  // 10 x 0.5 is twice as long
    CHECK(cut({-1, 0.4}, {11, 0.6}).cuts == 0);
    // A wedge of 45 degrees off the end is longer than the limit of 2 (2.41), the ground is not the
    // worse for it: what it has beyond the limit, 1.41 - 2 * 0.59 m, is less than the ground has.
    CHECK(slice(slab, {Joint{{{8.9, -0.1}, {10.1, 1.1}}, 0}}, {0, 2}).slicing.cuts == 1);
    // Blocks within the limit may not pass it: 4 x 1 (4.1) cut lengthwise gives 8.1.
    const auto brick = slice({{0, 0}, {4, 1}}, {Joint{{{-1, 0.5}, {5, 0.5}}, 0}}, {0, 5}).slicing;
    CHECK(brick.refused_too_long == 1);
    // Not even where the block came from a long one: 8 x 1 in halves, then each lengthwise.
    const auto halves = slice(
        {{0, 0}, {8, 1}}, {Joint{{{4, -1}, {4, 2}}, 0}, Joint{{{-1, 0.5}, {9, 0.5}}, 0}}, {0, 5});
    CHECK(halves.slicing.cuts == 1);
    CHECK(halves.slicing.refused_too_long == 2);
  }

  TEST_CASE("joints along the edge of the domain or outside it cut nothing") {
    const Domain<2> ground{{0, 0}, {4, 4}};
    for (const Segment& trace :
         {Segment{{-1, 0}, {5, 0}}, Segment{{4, 5}, {4, -1}}, Segment{{0, 4}, {4, 4}},
          Segment{{5, 5}, {9, 9}}, Segment{{-3, 1}, {0, 1}}, Segment{{-1, 5}, {-1, -5}}}) {
      CAPTURE(trace.start.transpose());
      const auto mass = slice(ground, {{trace, 0}}, {});
      CHECK(mass.bodies.size() == 1);
      CHECK(mass.slicing.unused_joints == 1);
    }
    // A hair inside, it does: 1e-6 m is far above the tolerance of 6e-10 m.
    CHECK(slice(ground, {{{{-1, 1e-6}, {5, 1e-6}}, 0}}, {}).bodies.size() == 2);
  }

  TEST_CASE("limits and domains out of range are refused") {
    const Domain<2> ground{{0, 0}, {4, 4}};
    const double nan = std::nan("");
    for (const BlockLimits& limits :
         {BlockLimits{-0.1, 5}, BlockLimits{nan, 5}, BlockLimits{inf, 5}, BlockLimits{0.1, 1.9},
          BlockLimits{0.1, nan}})
      CHECK_THROWS_AS((void)slice(ground, {}, limits), InvalidInput);
    for (const Domain<2>& bad :
         {Domain<2>{{0, 0}, {0, 4}}, Domain<2>{{0, 0}, {4, -1}}, Domain<2>{{0, nan}, {4, 4}},
          Domain<2>{{0, 0}, {inf, 4}}, Domain<2>{{-1e300, 0}, {0, 4}}})
      CHECK_THROWS_AS((void)slice(bad, {}, {}), InvalidInput);
  }

  TEST_CASE("a joint that is not finite is refused by its number, in 2-D and 3-D") {
    const double nan = std::nan("");
    const std::vector<Joint> flat{{{{0, 1}, {4, 1}}, 0}, {{{0, nan}, {4, 2}}, 2}};
    CHECK_THROWS_WITH_AS((void)slice({{0, 0}, {4, 4}}, flat, {}),
                         "joint 1 of set 2: every coordinate must be finite, and less than "
                         "1e150 m from 0",
                         InvalidInput);
    const std::vector<Joint> endless{{{{-1e300, 1}, {4, 1}}, 2}};
    CHECK_THROWS_AS((void)slice({{0, 0}, {4, 4}}, endless, {}), InvalidInput);
    const Domain<3> cube{{0, 0, 0}, {4, 4, 4}};
    const JointPlane level{{Vec3(0, 0, 1), 2}, {}};
    JointPlane no_plane = level, no_corner = level;
    no_plane.plane.offset = inf;
    no_corner.corners = {{0, 0, 2}, {1, 0, 2}, {1, nan, 2}};
    for (const JointPlane& bad : {no_plane, no_corner})
      CHECK_THROWS_WITH_AS((void)slice<Spatial>(cube, {{level, 0}, {level, 0}, {bad, 1}}, {}),
                           "joint 2 of set 1: every coordinate must be finite, and less than "
                           "1e150 m from 0",
                           InvalidInput);
  }

  TEST_CASE("a trace whose ends are one point cuts nothing, and is counted") {
    const std::vector<Joint> joints{{{{1, 1}, {1, 1}}, 0}, {{{-1, 2}, {5, 2}}, 0}};
    const auto mass = slice({{0, 0}, {4, 4}}, joints, {});
    CHECK(mass.bodies.size() == 2);
    CHECK(mass.slicing.unused_joints == 1);
  }

  TEST_CASE("one metre or one kilometre, near or far: the same number of blocks") {
    const auto joints_for = [](double scale, const Vec2& shift) {
      Domain<2> ground{{-5, -5}, {5, 5}};
      auto joints = joint_network(paper_sets(), ground, 8);
      for (Joint& joint : joints)
        joint.trace = {scale * joint.trace.start + shift, scale * joint.trace.end + shift};
      ground = {scale * ground.low + shift, scale * ground.high + shift};
      return slice(ground, joints, {0.25 * scale, 5});
    };
    const auto base = joints_for(1, {0, 0});
    for (const double scale : {1e-2, 100.0})
      CHECK(joints_for(scale, {0, 0}).bodies.size() == base.bodies.size());
    const auto far = joints_for(1, {1e4, -3e4});  // vertices rounded to 4e-12 m, tolerance 1.4e-9 m
    CHECK(far.bodies.size() == base.bodies.size());
    CHECK(std::abs(total_area(far) / 100 - 1) < 1e-10);
  }
}

}  // namespace slicing_test
