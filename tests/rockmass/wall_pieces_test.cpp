// SPDX-License-Identifier: MIT
// The wall where pieces of rock were dropped: it closes what is left, whatever is dropped.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>

#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/shapes.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_test;

std::size_t index(int k) { return static_cast<std::size_t>(k); }

/// Sum of the area vectors of all that surrounds a body, the largest of all bodies: where its
/// surface is closed it is zero.
/// @param fallen  bodies that are no longer there
template <class Geometry>
double worst_gap(const RockMass<Geometry>& mass, const typename Geometry::Opening& opening,
                 const std::vector<int>& fallen = {}) {
  using Vector = Vec<Geometry::dim>;
  const auto is_there = [&](int b) {
    return std::find(fallen.begin(), fallen.end(), b) == fallen.end();
  };
  std::vector<Vector> sum(mass.bodies.size(), Vector::Zero());
  for (const auto& c : CutContacts::find(mass)) {
    if (!is_there(c.a) || !is_there(c.b)) continue;
    sum[index(c.a)] += c.facet.area_vector();
    sum[index(c.b)] -= c.facet.area_vector();
  }
  for (const auto& f : boundary_facets(mass)) sum[index(f.body)] += f.facet.area_vector();
  for (const auto& w : wall_of(mass, opening, fallen).pieces) {
    CHECK(is_there(w.body));
    sum[index(w.body)] -= w.facet.area_vector();
  }
  double worst = 0;
  for (int b = 0; index(b) < sum.size(); ++b)
    if (is_there(b)) worst = std::max(worst, sum[index(b)].norm());
  return worst;
}

/// Every third body at the wall, and every third of those behind one of these; none at the edge of
/// the domain.
template <class Geometry>
std::vector<int> some_of_the_wall(const RockMass<Geometry>& mass,
                                  const typename Geometry::Opening& opening) {
  std::vector<int> at_wall, fallen;
  for (const auto& piece : wall_pieces(mass, opening))
    if (piece.hole < 0) at_wall.push_back(piece.body);
  const auto at_edge = boundary_facets(mass);
  const auto take_some = [&](std::vector<int> bodies) {
    for (const auto& f : at_edge) std::erase(bodies, f.body);
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (std::size_t k = 0; k < bodies.size(); k += 3) fallen.push_back(bodies[k]);
  };
  take_some(at_wall);
  std::vector<int> behind;
  const auto is_fallen = [&](int b) {
    return std::find(fallen.begin(), fallen.end(), b) != fallen.end();
  };
  for (const auto& c : CutContacts::find(mass))
    if (is_fallen(c.a) != is_fallen(c.b)) behind.push_back(is_fallen(c.a) ? c.b : c.a);
  take_some(behind);
  return fallen;
}

/// Length or area of the outline that the wall stands for.
template <class Geometry>
double seen(const RockMass<Geometry>& mass, const typename Geometry::Opening& opening) {
  const WallOutline outline(opening);
  double sum = 0;
  for (const auto& piece : wall_pieces(mass, opening)) sum += piece.seen_measure(outline);
  return sum;
}

template <class Geometry>
int pieces_of_holes(const RockMass<Geometry>& mass, const typename Geometry::Opening& opening) {
  const auto pieces = wall_pieces(mass, opening);
  return static_cast<int>(std::count_if(pieces.begin(), pieces.end(),
                                        [](const auto& piece) { return piece.hole >= 0; }));
}

const Domain<2> ground{{-10, -8}, {10, 9}};
const SimplePolygon horseshoe(
    {{-3, -2.5}, {3, -2.5}, {3, 0.5}, {1.8, 2.4}, {0, 3}, {-1.8, 2.4}, {-3, 0.5}});
/// With a pillar that hangs from the roof: two corners of it turn the other way.
const SimplePolygon notched(
    {{-3, -2}, {3, -2}, {3, 2}, {0.6, 2}, {0.5, 1.2}, {-0.5, 1.2}, {-0.6, 2}, {-3, 2}});

}  // namespace

TEST_SUITE("rockmass/wall_pieces") {
  TEST_CASE("the wall closes every body, whatever was dropped") {
    std::size_t dropped = 0;
    for (const SimplePolygon& opening :
         {SimplePolygon(regular(36, 3)), SimplePolygon(regular(4, 3)), horseshoe, notched})
      for (std::uint64_t seed = 1; seed <= 8; ++seed)
        for (const double smallest : {0.0, 0.01, 0.1, 0.3}) {
          CAPTURE(seed);
          CAPTURE(smallest);
          const auto mass = carve(jointed_rock(ground, seed), opening, smallest);
          CHECK(mass.dropped.size() == mass.carving.dropped_pieces);
          dropped += mass.dropped.size();
          // Corners at the wall are moved by the tolerance of slicing at most, a few at a body.
          CHECK(worst_gap<Planar>(mass, opening) < 20 * mass.domain.tolerance());
          // And the void: by the divergence of the radius its area, that of the holes with it.
          double doubled_area = 0;
          for (const auto& piece : wall_pieces(mass, opening))
            doubled_area += piece.facet.area_vector().dot(piece.facet.centre());
          CHECK(doubled_area ==
                near(2 * (opening.area() + mass.carving.dropped_measure)).epsilon(1e-8));
        }
    CHECK(dropped > 300);
  }

  TEST_CASE("what it stands for is the outline") {
    int of_holes = 0;
    for (const SimplePolygon& opening :
         {SimplePolygon(regular(36, 3)), SimplePolygon(regular(4, 3)), horseshoe, notched})
      for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        CAPTURE(opening.size());
        CAPTURE(seed);
        const auto whole = carve(jointed_rock(ground, seed), opening, 0);
        CHECK(seen<Planar>(whole, opening) == near(opening.perimeter()).epsilon(1e-9));
        const auto mass = carve(jointed_rock(ground, seed), opening, 0.1);
        of_holes += pieces_of_holes<Planar>(mass, opening);
        // Of what overhangs nothing is seen, nor of what it hides.
        CHECK(seen<Planar>(mass, opening) == near(opening.perimeter()).epsilon(1e-9));
      }
    CHECK(of_holes > 100);
  }

  TEST_CASE("where bodies have fallen it closes what stands, and the void with them") {
    for (const SimplePolygon& opening :
         {SimplePolygon(regular(36, 3)), SimplePolygon(regular(4, 3)), horseshoe})
      for (std::uint64_t seed = 1; seed <= 8; ++seed)
        for (const double smallest : {0.0, 0.1}) {
          CAPTURE(opening.size());
          CAPTURE(seed);
          CAPTURE(smallest);
          const auto mass = carve(jointed_rock(ground, seed), opening, smallest);
          const std::vector<int> fallen = some_of_the_wall<Planar>(mass, opening);
          REQUIRE(fallen.size() > 5);
          CHECK_THROWS_AS((void)wall_of(mass, opening, {1000000}), InvalidInput);
          CHECK(worst_gap<Planar>(mass, opening, fallen) < 20 * mass.domain.tolerance());
          double doubled_area = 0, missing = mass.carving.dropped_measure, length = 0;
          for (const int b : fallen) missing += mass.bodies[index(b)].properties.measure;
          const WallOutline outline(opening);
          for (const auto& piece : wall_of(mass, opening, fallen).pieces) {
            doubled_area += piece.facet.area_vector().dot(piece.facet.centre());
            length += piece.seen_measure(outline);
          }
          CHECK(doubled_area == near(2 * (opening.area() + missing)).epsilon(1e-8));
          CHECK(length == near(opening.perimeter()).epsilon(1e-9));
        }
  }

  TEST_CASE("a slab dropped off a flat roof: the wall is its upper side, at its depth") {
    for (const double thickness : {1e-9, 1e-6, 1e-3, 1e-2, 0.1}) {
      CAPTURE(thickness);
      const SimplePolygon box({{-4, -3}, {4, -3}, {4, 3}, {-4, 3}});
      const double roof = 3 + thickness;
      const std::vector<Joint> joints{{{{-10, roof}, {10, roof}}, 0},
                                      {{{0, roof}, {0, 9}}, 0},
                                      {{{-4, -8}, {-4, roof}}, 0},
                                      {{{4, -8}, {4, roof}}, 0}};
      const auto mass = carve(slice(ground, joints, {0, 1e30}), box, 0.9);
      double length = 0;
      for (const auto& piece : wall_pieces(mass, box)) {
        if (piece.edge != 2) continue;
        if (std::abs(piece.facet.start.x() - piece.facet.end.x()) < 1e-12) {  // a flank of the hole
          CHECK(std::abs(std::abs(piece.facet.start.x()) - 4) < 1e-12);
          CHECK(piece.facet.length() == near(thickness));
          continue;
        }
        length += piece.facet.length();
        // A joint within the tolerance of slicing runs along the outline.
        CHECK(std::abs(piece.facet.start.y() - 3 - thickness) < 2e-9);
        CHECK(piece.facet.end.x() < piece.facet.start.x());
        CHECK(std::abs(piece.depth - (piece.hole < 0 ? 0 : thickness)) < 2e-9);
      }
      CHECK(length == near(8).epsilon(1e-9));
      CHECK(worst_gap<Planar>(mass, box) < 1e-7);
    }
  }

  TEST_CASE("a joint along the wall, on it or behind it: the same bodies, and the same wall") {
    // A joint through the whole rock along the roof or the right wall; one across it above, so that
    // two bodies are behind it; and with `parted` one beside the opening.
    const SimplePolygon box({{-4, -3}, {4, -3}, {4, 3}, {-4, 3}}), circle(regular(72, 3));
    for (const SimplePolygon* opening : {&box, &horseshoe, &circle})
      for (const bool at_roof : {true, false})
        for (const bool parted : {false, true}) {
          double wall = 0;
          for (const Vec2& v : opening->vertices()) wall = std::max(wall, at_roof ? v.y() : v.x());
          std::vector<double> areas;
          double dropped = 0;
          for (const double behind : {0.0, 1e-9, 1e-6, 1e-3, 1e-2, 2e-2}) {
            CAPTURE(at_roof);
            CAPTURE(behind);
            const double w = wall + behind;
            std::vector<Joint> joints{{{{-10, w}, {10, w}}, 0}, {{{0.3, w}, {0.3, 9}}, 0}};
            if (parted) joints.push_back({{{-7, -8}, {-7, w}}, 0});
            if (!at_roof)
              for (Joint& joint : joints)
                for (Vec2* p : {&joint.trace.start, &joint.trace.end}) {
                  std::swap(p->x(), p->y());
                  if (p->x() < -8) p->x() = -10;
                }
            const auto mass = carve(slice(ground, joints, {0, 1e30}), *opening, 0.074);
            std::vector<double> here;
            for (const auto& body : mass.bodies) here.push_back(body.properties.measure);
            std::sort(here.begin(), here.end());
            if (areas.empty()) areas = here;
            REQUIRE(here.size() == areas.size());
            // What the joint moves from one side of it to the other: 20 m of it.
            for (std::size_t k = 0; k < here.size(); ++k)
              CHECK(std::abs(here[k] - areas[k]) <= 20 * behind + 1e-6);
            CHECK(worst_gap<Planar>(mass, *opening) < 1e-7);
            // Along the straight walls what is behind them; along a circle of 3 m, also without the
            // joint's distance, where it comes within a tenth of 0.272 m: 0.8 m of it.
            CHECK(mass.carving.dropped_measure <=
                  behind * opening->perimeter() + (opening == &circle ? 0.8 * 0.0272 : 0));
            dropped = mass.carving.dropped_measure;
          }
          // The apex of the horseshoe is a point: no joint runs along it.
          CHECK((dropped > 0) == !(opening == &horseshoe && at_roof));
        }
  }

  TEST_CASE("in 3-D, beyond the face a skin is rock") {
    const Domain<3> rock{{-6, -4, -6}, {6, 4, 6}};
    const SimplePolygon box({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}});
    const PrismaticOpening opening(box, TunnelAxis({0, 0, 0}, 0.4), -1.5, 1);
    std::size_t bodies = 0;
    for (const double behind : {0.0, 1e-6, 1e-3, 2e-2}) {
      CAPTURE(behind);
      const std::vector<SpatialJoint> bed{
          {joint_rectangle({0, 0, 2 + behind}, {40, 0, 0}, {0, 40, 0}), 0}};
      const auto mass = carve(slice<Spatial>(rock, bed, {0, 1e30}), opening, 0.02);
      if (bodies == 0) bodies = mass.bodies.size();
      CHECK(mass.bodies.size() == bodies);
      // Over the corners of the roof half of a square.
      CHECK(mass.carving.dropped_measure == near(2.5 * (4 + behind) * behind).epsilon(1e-6));
      CHECK(worst_gap<Spatial>(mass, opening) < 1e-7);
    }
  }

  TEST_CASE("in 3-D") {
    const Domain<3> rock{{-6, -4, -6}, {6, 4, 6}};
    for (const auto& axis : {TunnelAxis(), TunnelAxis({0, 0, 0}, 0.4)})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        CAPTURE(seed);
        const PrismaticOpening opening(SimplePolygon(regular(12, 2.5)), axis);
        const auto whole = carve(jointed_mass(rock, seed, 2), opening, 0);
        CHECK(worst_gap<Spatial>(whole, opening) < 1e-7);
        const auto mass = carve(jointed_mass(rock, seed, 2), opening, 0.1);
        CHECK(pieces_of_holes<Spatial>(mass, opening) > 5);
        CHECK(worst_gap<Spatial>(mass, opening) < 1e-7);
        CHECK(seen<Spatial>(mass, opening) == near(seen<Spatial>(whole, opening)).epsilon(0.02));
        const std::vector<int> fallen = some_of_the_wall<Spatial>(mass, opening);
        REQUIRE(fallen.size() > 5);
        CHECK(worst_gap<Spatial>(mass, opening, fallen) < 1e-7);
      }
  }

  TEST_CASE("holes of another opening are not of this one") {
    const SimplePolygon left(regular(24, 2, {-4, 0})), right(regular(24, 1.5, {4, 1}));
    auto mass = carve(jointed_rock(ground, 5), left, 0.1);
    const int of_left = pieces_of_holes<Planar>(mass, left);
    REQUIRE(of_left > 0);
    mass = carve(mass, right, 0.1);
    CHECK(pieces_of_holes<Planar>(mass, left) == of_left);
    for (const auto& piece : wall_pieces(mass, right))
      CHECK((piece.facet.centre() - Vec2(4, 1)).norm() < 2.5);
  }
}
