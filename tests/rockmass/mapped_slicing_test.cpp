// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <sstream>
#include <string>
#include <vector>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/mapped_slicing.hpp>
#include <voussoir/rockmass/trace_file.hpp>

#include "support/trace_maps.hpp"

namespace mapped_slicing_test {

using namespace voussoir;

namespace {

constexpr double radius = 0.1, snap = 0.05;
const Domain<2> ground{{-30, -30}, {30, 30}};

MappedRock rock(const std::vector<MappedTrace>& traces, DeadEnds dead_ends = DeadEnds::do_not_cut,
                const std::vector<Joint>& others = {},
                const std::vector<SimplePolygon>& openings = {}) {
  return slice_mapped(ground, mapped_joints(traces, ground, {snap, dead_ends}), others, {radius},
                      openings);
}

std::size_t blocks(const std::vector<MappedTrace>& traces,
                   DeadEnds dead_ends = DeadEnds::do_not_cut) {
  return rock(traces, dead_ends).mass.bodies.size();
}

/// A trace right through the ground.
MappedTrace level(double y) { return {{{-40, y}, {40, y}}}; }

/// An arc from side to side of the ground, 61 m long, in chords.
MappedTrace arc(int chords) {
  MappedTrace trace;
  const double half = 0.312, size = 30 / std::sin(half);
  for (int k = 0; k <= chords; ++k) {
    const double angle = half * (2.0 * k / chords - 1);
    trace.points.emplace_back(size * std::sin(angle), size * (std::cos(angle) - 1));
  }
  return trace;
}

/// How far the faces of a body are from closing, the largest of all bodies: every stretch of its
/// outline is a contact or an edge of the domain.
double largest_gap(const RockMass<Planar>& mass) {
  std::vector<Vec2> sum(mass.bodies.size(), Vec2::Zero());
  for (const auto& c : CutContacts::find(mass)) {
    // Its normal points out of body a.
    sum[static_cast<std::size_t>(c.a)] += c.facet.area_vector();
    sum[static_cast<std::size_t>(c.b)] -= c.facet.area_vector();
  }
  for (const auto& edge : boundary_facets(mass))
    sum[static_cast<std::size_t>(edge.body)] += edge.facet.area_vector();
  double largest = 0;
  for (const Vec2& s : sum) largest = std::max(largest, s.norm());
  return largest;
}

double total_area(const RockMass<Planar>& mass) {
  double area = 0;
  for (const auto& body : mass.bodies) area += body.properties.measure;
  return area;
}

/// Whether two masses have the same bodies, bit for bit.
bool same(const RockMass<Planar>& a, const RockMass<Planar>& b) {
  if (a.bodies.size() != b.bodies.size() || a.cuts.size() != b.cuts.size()) return false;
  for (std::size_t k = 0; k < a.bodies.size(); ++k) {
    const auto &p = a.bodies[k].parts, &q = b.bodies[k].parts;
    if (p.size() != q.size()) return false;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p[i].vertices() != q[i].vertices()) return false;
  }
  return true;
}

/// A map of so many traces is the same rock in other orders, directions, pieces, and on other
/// grids.
void check_map(std::size_t count, DeadEnds dead_ends) {
  CAPTURE(count);
  const auto map = voussoir_test::trace_map(count, 11 + count, ground);
  const auto reference = rock(map, dead_ends).mass;
  CHECK(reference.bodies.size() > count / 8);
  CHECK(std::abs(total_area(reference) - 3600) < 1e-7);  // thousands of areas, to roundings
  CHECK(largest_gap(reference) < 1e-8);                  // the tolerance of the ground
  std::size_t apart = 0;
  for (const auto& body : reference.bodies)
    apart += detail::connected_groups(body.parts, reference.cuts, ground.tolerance()).size() != 1;
  CHECK(apart == 0);
  for (std::uint64_t k = 1; k <= 20; ++k)
    CHECK(same(reference, rock(voussoir_test::shuffled(map, k), dead_ends).mass));
  CHECK(same(reference, rock(voussoir_test::turned(map), dead_ends).mass));
  CHECK(same(reference,
             rock(voussoir_test::shuffled(voussoir_test::in_pieces(map), 3), dead_ends).mass));
  for (const Vec2& origin : {Vec2(0, 0), Vec2(621000, 5140000), Vec2(-37.5, 12.25)}) {
    std::istringstream in(voussoir_test::table_of(map, origin));
    CHECK(same(reference, rock(read_traces(in, "map", origin).traces, dead_ends).mass));
  }
}

}  // namespace

TEST_SUITE("rockmass/mapped_slicing") {
  TEST_CASE("a curved joint parts two blocks, however many its points and rows") {
    for (const int chords : {1, 2, 8, 64, 512}) {
      CAPTURE(chords);
      const MappedTrace whole = arc(chords);
      std::vector<MappedTrace> rows;
      for (std::size_t k = 1; k < whole.points.size(); ++k)
        rows.push_back({{whole.points[k - 1], whole.points[k]}});
      for (const auto& traces : {std::vector{whole}, rows}) {
        const MappedRock made = rock(traces);
        CHECK(made.mass.bodies.size() == 2);
        CHECK(std::abs(total_area(made.mass) - 3600) < 1e-8);
        CHECK(largest_gap(made.mass) < 1e-9);
        REQUIRE(made.sets.size() == 1);
        CHECK(made.sets[0].joints == 1);
        // Drawn with fewer points it is shorter by no more than that many corners of 5 mm allow.
        CHECK(std::abs(made.sets[0].cut - made.sets[0].mapped) < 1e-6);
        if (chords >= 64) CHECK(std::abs(made.sets[0].cut - 60.99) < 0.05);
      }
    }
  }

  TEST_CASE("an end within the tolerance of another joint ends on it") {
    const auto tee = [](double from, double to) {
      return std::vector<MappedTrace>{level(-12), level(12), {{{15, from}, {15, to}}}};
    };
    CHECK(blocks(tee(-12, 12)) == 4);
    CHECK(blocks(tee(-12, 12.000001)) == 4);  // was 5
    CHECK(blocks(tee(-12.04, 12.04)) == 4);
    CHECK(blocks(tee(-11.96, 11.96)) == 4);
    // Farther off: a bridge of rock of 0.2 m is left, or an end in whole rock parts nothing.
    CHECK(blocks(tee(-12, 11.8)) == 3);
    CHECK(blocks(tee(-12, 13)) == 4);
    CHECK(blocks(tee(-12, 13), DeadEnds::cut_through) == 5);
    CHECK(blocks(tee(-12, 11.8), DeadEnds::cut_through) == 4);
    // Nearly along another: 1 degree off, its end 4 cm above, which it would meet 2 m farther on.
    CHECK(blocks({level(0), {{{-40, 0.7}, {0, 0.04}}}}) == 3);
  }

  TEST_CASE("one short trace in whole rock cuts nothing, or as far as the next joints") {
    const std::vector<MappedTrace> traces{level(-12), level(12), {{{20, -5}, {20.9, -4.5}}}};
    const MappedRock left = rock(traces), cut = rock(traces, DeadEnds::cut_through);
    CHECK(left.mass.bodies.size() == 3);
    CHECK(left.sets[0].used == 2);
    CHECK(std::abs(left.sets[0].mapped - left.sets[0].cut - std::sqrt(0.81 + 0.25)) < 1e-9);
    CHECK(left.sets[0].made == 0);
    CHECK(cut.mass.bodies.size() == 4);
    // Down to the joint at y = -12, to the right to the edge at x = 30.
    const double slope = 5.0 / 9, down = 7 / slope, right = 30 - 20.9;
    CHECK(std::abs(cut.sets[0].made - std::sqrt(1 + slope * slope) * (down + right)) < 1e-6);
    CHECK(blocks({{{{20, -5}, {20.9, -4.5}}}}) == 1);
    CHECK(blocks({{{{20, -5}, {20.9, -4.5}}}}, DeadEnds::cut_through) == 2);
  }

  TEST_CASE("a trace that crosses itself, leaves the ground and returns, or closes") {
    // A loop of 4 m2 between an end on the left edge and one on the right.
    const MappedTrace loop{{{-40, 0}, {2, 0}, {2, 2}, {0, 2}, {0, -2}, {40, -2}}};
    CHECK(blocks({loop}) == 3);
    const MappedTrace returns{{{-10, 40}, {-10, 0}, {0, 40}, {10, 0}, {10, 40}}};
    CHECK(blocks({returns}) == 3);
    const MappedTrace ring{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}};
    const MappedRock closed = rock({ring});
    REQUIRE(closed.mass.bodies.size() == 2);
    CHECK(largest_gap(closed.mass) < 1e-9);
    const double a = closed.mass.bodies[0].properties.measure,
                 b = closed.mass.bodies[1].properties.measure;
    CHECK(std::abs(std::min(a, b) - 16) < 1e-9);
    CHECK(std::abs(std::max(a, b) - 3584) < 1e-9);
    // Outside, repeated points, nothing at all.
    CHECK(blocks({{{{50, 50}, {60, 60}}}}) == 1);
    CHECK(blocks({{{{-40, 0}, {-40, 0}, {0, 0}, {0, 0}, {40, 0}}}}) == 2);
    CHECK(blocks({}) == 1);
  }

  TEST_CASE("a block that is too small stays with its neighbour beyond the shortest joint") {
    // 0.15 m apart: no circle of 0.1 m between the two levels. Both are as long; the upper goes.
    const MappedRock made = rock({level(0), level(0.15), {{{0, 0}, {0, 30}}}});
    CHECK(made.mass.bodies.size() == 3);
    CHECK(made.too_small == 2);
    CHECK(largest_gap(made.mass) < 1e-9);
    // A copy within the tolerance is no joint of its own.
    const MappedJoints twice = mapped_joints({level(0), level(0.03)}, ground, {snap});
    CHECK(twice.duplicates == 1);
    CHECK(twice.joints == 1);
  }

  TEST_CASE("a joint that ends at the opening parts the wall") {
    const SimplePolygon opening({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}});
    // From inside the opening to a level above it, and from there down the other side.
    const std::vector<MappedTrace> traces{
        level(12), {{{0, 0}, {0, 12}}}, level(-12), {{{0, -2.98}, {0, -12}}}};
    const MappedRock made = rock(traces, DeadEnds::do_not_cut, {}, {opening});
    CHECK(made.mass.bodies.size() == 3);  // in whole ground the two part nothing
    const RockMass<Planar> mass = carve(made.mass, opening, 0);
    CHECK(mass.bodies.size() == 4);
    // Left and right touch above the opening and below it, and each what is above and below.
    std::size_t upright = 0, level_ones = 0;
    for (const auto& c : CutContacts::find(mass)) {
      const Vec2 along = c.facet.end - c.facet.start;
      ++(std::abs(along.x()) < std::abs(along.y()) ? upright : level_ones);
    }
    CHECK(upright == 2);
    CHECK(level_ones >= 4);
    // One that ends 1 m before the wall parts nothing, opening or not.
    const MappedRock short_one =
        rock({level(12), {{{0, 4}, {0, 12}}}}, DeadEnds::do_not_cut, {}, {opening});
    CHECK(carve(short_one.mass, opening, 0).bodies.size() == 2);
  }

  TEST_CASE("a map gives the same rock in any order, direction, pieces and on any grid") {
    for (const DeadEnds dead_ends : {DeadEnds::do_not_cut, DeadEnds::cut_through}) {
      check_map(100, dead_ends);
      check_map(1000, dead_ends);
    }
  }
  TEST_CASE("so does a map of 3000 traces [long]") { check_map(3000, DeadEnds::cut_through); }

  TEST_CASE("a polyline that was split keeps the points that it had") {
    // The middle point is 0.2 mm beyond what may be left out; the split beside it, a tenth of a
    // millimetre off the line, would be taken in its place.
    const std::vector<MappedTrace> whole{{{{0, 0}, {5, 0.0052}, {10, 0}}}},
        split{{{{0, 0}, {4.99, 0.0053}}}, {{{4.99, 0.0053}, {5, 0.0052}, {10, 0}}}};
    const auto a = mapped_joints(whole, ground, {snap}), b = mapped_joints(split, ground, {snap});
    REQUIRE(a.pieces.size() == 2);
    REQUIRE(b.pieces.size() == 2);
    CHECK(a.pieces[0].mapped.end == Vec2(5, 0.0052));
    CHECK(b.pieces[0].mapped.end == Vec2(5, 0.0052));
  }

  TEST_CASE("random joints cut blocks of several parts right through, within the limits") {
    const std::vector<JointSet> sets{{"a", 0.9, DipDirection::east, 0.1, 0.3, 0, 3},
                                     {"b", 0.3, DipDirection::west, 0.1, 0.3, 0, 3}};
    const auto random = joint_network(sets, ground, 1);
    // As many blocks, to some per cent, whether the arc among them is one chord or many.
    const MappedRock straight = rock({arc(1)}, DeadEnds::do_not_cut, random),
                     curved = rock({arc(64)}, DeadEnds::do_not_cut, random);
    for (const MappedRock* made : {&straight, &curved}) {
      CHECK(std::abs(total_area(made->mass) - 3600) < 1e-7);
      CHECK(largest_gap(made->mass) < 1e-8);
      CHECK(made->mass.slicing.fates.size() == made->mass.joints.size());
    }
    const auto count = [](const MappedRock& made) {
      return static_cast<double>(made.mass.bodies.size());
    };
    CHECK(std::abs(count(curved) / count(straight) - 1) < 0.05);
    for (const auto& body : curved.mass.bodies)
      CHECK(detail::connected_groups(body.parts, curved.mass.cuts, ground.tolerance()).size() == 1);
    // Without mapped joints it is the slicing of random ones, block for block.
    const MappedRock none = rock({}, DeadEnds::do_not_cut, random);
    CHECK(same(none.mass, slice(ground, random, {radius})));
  }

  TEST_CASE("a map of 32 000 pieces is cut in seconds, and stops when told to [long]") {
    const Domain<2> wide{{-100, -100}, {100, 100}};
    const auto map = voussoir_test::trace_map(20000, 5, wide);
    std::size_t pieces = 0;
    for (const auto& trace : map) pieces += trace.points.size() - 1;
    CHECK(pieces > 32000);
    const std::clock_t start = std::clock();
    const MappedRock made = slice_mapped(wide, mapped_joints(map, wide, {snap}), {}, {radius}, {});
    const double took = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    MESSAGE(pieces, " pieces, ", made.mass.bodies.size(), " blocks in ", took, " s");
    CHECK(took < 120);  // unoptimised; 5 s as released
    CHECK(largest_gap(made.mass) < 1e-8);
    int left = 3;
    CHECK_THROWS_AS((void)mapped_joints(map, wide, {snap}, [&](double) { return --left > 0; }),
                    Stopped);
  }
}

}  // namespace mapped_slicing_test
