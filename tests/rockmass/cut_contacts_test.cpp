// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>

#include "support/jointed_rock.hpp"
#include "support/shapes.hpp"

namespace cut_contacts_test {

using namespace voussoir;
using voussoir_test::jointed_rock;
using voussoir_test::regular;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const Domain<2> ground{{-10, -8}, {10, 9}};

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Contact length of every pair of bodies, the lower number first.
using PairLengths = std::map<std::pair<int, int>, double>;

PairLengths lengths(const std::vector<ContactFacet<Planar>>& contacts) {
  PairLengths result;
  for (const auto& c : contacts) result[std::minmax(c.a, c.b)] += c.facet.length();
  return result;
}

/// The plain way: any two faces of different bodies that lie on one line, back to back.
PairLengths lengths_of_all_pairs(const RockMass<Planar>& mass) {
  struct Face {
    int body;
    Segment side;
    Vec2 along;
    double length;
  };
  std::vector<Face> faces;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const auto& part : mass.bodies[b].parts)
      for (std::size_t k = 0; k < part.size(); ++k) {
        const Segment side = part.face(k);
        faces.push_back(
            {static_cast<int>(b), side, (side.end - side.start).normalized(), side.length()});
      }
  const double near = 1e-9;
  PairLengths result;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Face &f = faces[i], &g = faces[j];
      if (f.body == g.body || f.along.dot(g.along) > 0) continue;
      if (std::abs(cross(f.along, g.side.start - f.side.start)) > near ||
          std::abs(cross(f.along, g.side.end - f.side.start)) > near)
        continue;
      const double from = std::max(0.0, f.along.dot(g.side.end - f.side.start));
      const double to = std::min(f.length, f.along.dot(g.side.start - f.side.start));
      if (to - from > 10 * near) result[std::minmax(f.body, g.body)] += to - from;
    }
  return result;
}

void check_same(const PairLengths& ours, const PairLengths& theirs) {
  CHECK(ours.size() == theirs.size());
  double worst = 0;
  for (const auto& [pair, length] : theirs) {
    const auto found = ours.find(pair);
    REQUIRE(found != ours.end());
    worst = std::max(worst, std::abs(found->second - length));
  }
  CHECK(worst < 1e-12);  // ends are vertices rounded at 10 m, 2e-15 m
}

/// Sum over each body of the area vectors of all that surrounds it, and of their lengths.
struct Surroundings {
  std::vector<Vec2> area;
  std::vector<double> length;
};

Surroundings surroundings(const RockMass<Planar>& mass) {
  const std::size_t n = mass.bodies.size();
  Surroundings sum{std::vector<Vec2>(n, Vec2::Zero()), std::vector<double>(n, 0.0)};
  for (const auto& c : CutContacts::find(mass)) {
    sum.area[index(c.a)] += c.facet.area_vector();
    sum.area[index(c.b)] -= c.facet.area_vector();
    sum.length[index(c.a)] += c.facet.length();
    sum.length[index(c.b)] += c.facet.length();
  }
  for (const auto& f : boundary_facets(mass)) {
    sum.area[index(f.body)] += f.facet.area_vector();
    sum.length[index(f.body)] += f.facet.length();
  }
  for (const auto& w :
       wall_pieces(mass)) {  // anticlockwise round the opening: clockwise round the rock
    sum.area[index(w.body)] -= w.facet.area_vector();
    sum.length[index(w.body)] += w.facet.length();
  }
  return sum;
}

bool holds(const Body<Planar>& body, const Vec2& p) {
  return std::any_of(body.parts.begin(), body.parts.end(), [&](const ConvexPolygon& part) {
    for (std::size_t k = 0; k < part.size(); ++k)
      if (part.half_space(k).distance(p) > 0) return false;
    return true;
  });
}

}  // namespace

TEST_SUITE("rockmass/cut_contacts") {
  TEST_CASE("total contact length is half of what the perimeters leave beside the boundary") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto mass = jointed_rock(ground, seed);
      double contact = 0, perimeters = 0, boundary = 0;
      for (const auto& c : CutContacts::find(mass)) contact += c.facet.length();
      for (const auto& f : boundary_facets(mass)) boundary += f.facet.length();
      for (const auto& body : mass.bodies) perimeters += body.parts[0].perimeter();
      CHECK(std::abs(boundary - 2 * (20 + 17)) < 1e-11);
      CHECK(std::abs(contact - 0.5 * (perimeters - boundary)) < 1e-12 * contact);
    }
  }

  TEST_CASE("contacts and boundary close round every block") {
    for (const auto& [limits, extent] :
         {std::pair{BlockLimits{0.25, 5}, 1.0}, std::pair{BlockLimits{0.1, inf}, 3.0}}) {
      const auto mass = jointed_rock(ground, 4, limits, extent);
      const Surroundings sum = surroundings(mass);
      for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
        // Ends are shared bit for bit, so only the sum of up to 20 differences of coordinates below
        // 10 m is rounded, to 2e-15 m each; the in-situ stress balances as well as this does.
        CHECK(sum.area[b].norm() < 1e-13);
        CHECK(std::abs(sum.length[b] - mass.bodies[b].parts[0].perimeter()) < 1e-12);
      }
    }
  }

  TEST_CASE("with an opening, the wall closes what is left") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto mass = carve(jointed_rock(ground, seed), SimplePolygon(regular(36, 3)), 0);
      const Surroundings sum = surroundings(mass);
      std::size_t of_parts = 0;
      for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
        // Wall pieces end on the outline's own line, within the tolerance of slicing.
        CHECK(sum.area[b].norm() < 1e-11);
        of_parts += mass.bodies[b].parts.size() > 1 ? 1 : 0;
        double perimeters = 0;
        for (const auto& part : mass.bodies[b].parts) perimeters += part.perimeter();
        // Parts of one body touch each other without a contact.
        if (mass.bodies[b].parts.size() > 1)
          CHECK(sum.length[b] < perimeters - 1e-3);
        else
          CHECK(std::abs(sum.length[b] - perimeters) < 1e-11);
      }
      CHECK(of_parts > 5);
    }
  }

  TEST_CASE("body a is on the left of the facet, body b on the right") {
    for (const auto& mass : {jointed_rock(ground, 5),
                             carve(jointed_rock(ground, 5), SimplePolygon(regular(36, 3)), 0)}) {
      for (const auto& c : CutContacts::find(mass)) {
        CHECK(c.a != c.b);
        const double length = c.facet.length();
        if (length < 1e-4) continue;
        const Vec2 out = 1e-3 * c.facet.area_vector();  // away from a, short beside the facet
        CHECK(holds(mass.bodies[index(c.a)], c.facet.centre() - out));
        CHECK(holds(mass.bodies[index(c.b)], c.facet.centre() + out));
      }
    }
  }

  TEST_CASE("all pairs of faces, tried in turn, give the same pairs and lengths") {
    const Domain<2> small{{-6, -5}, {6, 5}};
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      const auto sliced = jointed_rock(small, seed);
      check_same(lengths(CutContacts::find(sliced)), lengths_of_all_pairs(sliced));
      const auto persistent = jointed_rock(small, seed, {0.2, inf}, inf);
      check_same(lengths(CutContacts::find(persistent)), lengths_of_all_pairs(persistent));
      const auto carved = carve(sliced, SimplePolygon(regular(24, 2)), 0.05);
      check_same(lengths(CutContacts::find(carved)), lengths_of_all_pairs(carved));
    }
  }

  TEST_CASE("a T-junction: one face against two neighbours, parted at their corner") {
    // A horizontal joint, and a vertical one that ends on it from above.
    const auto mass =
        slice({{0, 0}, {4, 2}}, {{{{-1, 1}, {5, 1}}, 0}, {{{1.5, 1}, {1.5, 3}}, 1}}, {});
    REQUIRE(mass.bodies.size() == 3);
    const auto contacts = CutContacts::find(mass);
    REQUIRE(contacts.size() == 3);
    std::vector<double> found;
    for (const auto& c : contacts) found.push_back(c.facet.length());
    std::sort(found.begin(), found.end());
    CHECK(found == std::vector<double>{1.0, 1.5, 2.5});
  }

  TEST_CASE("a cross of two joints: four contacts, none between blocks that meet in a point") {
    const auto mass = slice({{0, 0}, {2, 2}}, {{{{-1, 1}, {3, 1}}, 0}, {{{1, -1}, {1, 3}}, 1}}, {});
    REQUIRE(mass.bodies.size() == 4);
    const auto contacts = CutContacts::find(mass);
    CHECK(contacts.size() == 4);
    for (const auto& c : contacts) CHECK(std::abs(c.facet.length() - 1) < 1e-15);
  }

  TEST_CASE("offset bricks: every overlap of two rows is a contact of its own") {
    // Below y = 1 the bricks end at 1, 2, 3; above it at 0.25, 1.25, 2.25, 3.25.
    std::vector<Joint> joints = {{{{-1, 1}, {5, 1}}, 0}};
    for (int k = 1; k < 4; ++k) joints.push_back({{{1.0 * k, -1}, {1.0 * k, 1}}, 1});
    for (int k = 0; k < 4; ++k) joints.push_back({{{k + 0.25, 1}, {k + 0.25, 3}}, 1});
    const auto mass = slice({{0, 0}, {4, 2}}, joints, {});
    REQUIRE(mass.bodies.size() == 9);
    double bed = 0;
    std::size_t on_bed = 0, upright = 0;
    for (const auto& c : CutContacts::find(mass)) {
      if (std::abs(c.facet.start.y() - 1) < 1e-12 && std::abs(c.facet.end.y() - 1) < 1e-12) {
        ++on_bed;
        bed += c.facet.length();
      } else {
        ++upright;
        CHECK(std::abs(c.facet.length() - 1) < 1e-15);
      }
    }
    CHECK(on_bed == 8);  // 7 corners part the bed
    CHECK(std::abs(bed - 4) < 1e-14);
    CHECK(upright == 7);
  }

  TEST_CASE("no contact between parts of one body") {
    const auto one = carve(slice(ground, {}, {}), SimplePolygon(regular(12, 3)), 0);
    REQUIRE(one.bodies.size() == 1);
    REQUIRE(one.bodies[0].parts.size() > 10);
    CHECK(CutContacts::find(one).empty());
  }

  TEST_CASE("boundary facets: the sides of the domain in full, the rock on their left") {
    const auto mass = jointed_rock(ground, 6);
    std::map<Side, double> sides;
    for (const auto& f : boundary_facets(mass)) {
      sides[f.side] += f.facet.length();
      const Vec2 out = f.facet.area_vector().normalized();
      switch (f.side) {
        case Side::left:
          CHECK((out - Vec2(-1, 0)).norm() < 1e-12);
          break;
        case Side::bottom:
          CHECK((out - Vec2(0, -1)).norm() < 1e-12);
          break;
        case Side::right:
          CHECK((out - Vec2(1, 0)).norm() < 1e-12);
          break;
        case Side::top:
          CHECK((out - Vec2(0, 1)).norm() < 1e-12);
          break;
      }
    }
    CHECK(std::abs(sides[Side::left] - 17) < 1e-12);
    CHECK(std::abs(sides[Side::right] - 17) < 1e-12);
    CHECK(std::abs(sides[Side::bottom] - 20) < 1e-12);
    CHECK(std::abs(sides[Side::top] - 20) < 1e-12);
  }

  TEST_CASE("at 10 000 m from the origin the chains close as well as the coordinates allow") {
    const Vec2 shift(1e4, -2e4);
    auto joints = joint_network(voussoir_test::paper_sets(), ground, 7);
    for (Joint& joint : joints) joint.trace = {joint.trace.start + shift, joint.trace.end + shift};
    const auto mass = slice({ground.low + shift, ground.high + shift}, joints, {0.25, 5});
    const Surroundings sum = surroundings(mass);
    // Differences of coordinates are exact; what is left is the rounding of sums of metres.
    for (std::size_t b = 0; b < mass.bodies.size(); ++b) CHECK(sum.area[b].norm() < 1e-13);
  }
}

}  // namespace cut_contacts_test
