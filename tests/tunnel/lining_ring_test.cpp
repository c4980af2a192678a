// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/lining/node_spacing.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>
#include <voussoir/tunnel/lined_part.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace lining_ring_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

constexpr double pi = std::numbers::pi;

/// Jointed rock round a 5 m circle of 36 facets; wall pieces down to this size are kept.
RockMass<Planar> tunnel_wall(double smallest = 0) {
  const auto opening = circular_opening(5, 36);
  return carve(jointed_rock(domain_around(opening, 14, 4, 4), 3), opening, smallest);
}

double wall_length(const RockMass<Planar>& mass) {
  double sum = 0;
  for (const auto& piece : wall_pieces(mass)) sum += piece.facet.length();
  return sum;
}
double contact_length(const LiningFrame<Planar>& frame) {
  double sum = 0;
  for (const auto& c : frame.contacts) sum += c.facet.length();
  return sum;
}
double angle_of(const Vec2& p) { return std::atan2(p.y(), p.x()); }

}  // namespace

TEST_SUITE("tunnel/lining_ring") {
  TEST_CASE("a full ring is closed, and with as many nodes as facets sits on their middles") {
    const auto mass = tunnel_wall();
    const LiningFrame<Planar> frame = lining_frame(mass, {.nodes = 36});
    REQUIRE(frame.nodes.size() == 36);
    REQUIRE(frame.members.size() == 36);
    for (std::size_t k = 0; k < 36; ++k) {
      CHECK((frame.nodes[k] - mass.openings.back().edge(k).centre()).norm() <= 1e-12);
      const int i = frame.members[k].first, j = frame.members[k].second;
      CHECK((i + 1) % 36 == j);  // anticlockwise, the last one back to the first node
    }
  }

  TEST_CASE("nodes and what touches them are the same whichever vertex comes first, and mirrored") {
    for (const SimplePolygon& opening :
         {horseshoe_opening(5, 1.7, 36), horseshoe_opening(5, 2, 35), circular_opening(5, 30)}) {
      const auto ground = domain_around(opening, 14, 4, 4);
      const auto rock = jointed_rock(ground, 3);
      for (const int count : {31, 50, 72}) {
        const LiningFrame<Planar> frame = lining_frame(carve(rock, opening, 0), {.nodes = count});
        // Even stretches from corner to corner: at most one more on each of two runs.
        const std::size_t stretches = frame.nodes.size() - frame.bare.size();
        CHECK(stretches >= static_cast<std::size_t>(count));
        CHECK(stretches <= static_cast<std::size_t>(count) + frame.bare.size());
        CHECK(frame.bare.size() == (opening.vertices().size() == 30 ? 0 : 2));
        CHECK(std::abs(contact_length(frame) - wall_length(carve(rock, opening, 0))) < 1e-6);
        for (const bool mirrored : {false, true})
          for (const std::ptrdiff_t first : {1, 7, 20}) {
            CAPTURE(count);
            CAPTURE(first);
            std::vector<Vec2> vertices = opening.vertices();
            std::rotate(vertices.begin(), vertices.begin() + first, vertices.end());
            const auto image = [&](const Vec2& p) { return mirrored ? Vec2(-p.x(), p.y()) : p; };
            for (Vec2& v : vertices) v = image(v);
            if (mirrored) std::reverse(vertices.begin(), vertices.end());
            auto joints = rock.joints;
            for (Joint& j : joints) j.trace = {image(j.trace.start), image(j.trace.end)};
            const LiningFrame<Planar> other =
                lining_frame(carve(slice(ground, joints, {0.25, 5}), SimplePolygon(vertices), 0),
                             {.nodes = count});
            REQUIRE(other.nodes.size() == frame.nodes.size());
            CHECK(other.contacts.size() == frame.contacts.size());
            // The length of wall that every node touches, where the node is.
            std::vector<double> touched(frame.nodes.size(), 0), others = touched;
            for (const auto& c : frame.contacts)
              touched[static_cast<std::size_t>(c.node)] += c.facet.length();
            for (const auto& c : other.contacts)
              others[static_cast<std::size_t>(c.node)] += c.facet.length();
            for (std::size_t k = 0; k < frame.nodes.size(); ++k) {
              double nearest = 1e300, length = 0;
              for (std::size_t i = 0; i < other.nodes.size(); ++i)
                if (const double d = (other.nodes[i] - image(frame.nodes[k])).norm(); d < nearest) {
                  nearest = d;
                  length = others[i];
                }
              CHECK(nearest < 1e-12);  // roundings of 20 m of wall summed up
              CHECK(std::abs(length - touched[k]) < 1e-11);
            }
          }
      }
    }
  }

  TEST_CASE("every piece of wall touches the lining once, with its full length") {
    for (const int nodes : {8, 36, 50, 200}) {
      CAPTURE(nodes);
      const auto mass = tunnel_wall();
      const LiningFrame<Planar> frame = lining_frame(mass, {.nodes = nodes});
      CHECK(frame.nodes.size() == static_cast<std::size_t>(nodes));
      const double perimeter = mass.openings.back().perimeter(), stretch = perimeter / nodes;
      CHECK(std::abs(wall_length(mass) - perimeter) <= 1e-9);  // nothing was dropped
      CHECK(std::abs(contact_length(frame) - perimeter) <= 1e-9);
      for (const auto& c : frame.contacts) {
        REQUIRE(c.node >= 0);
        REQUIRE(c.node < nodes);
        // On the stretch of its node, and facing outwards: node on the left, rock on the right.
        CHECK((c.facet.centre() - frame.nodes[static_cast<std::size_t>(c.node)]).norm() <=
              0.5 * stretch + 1e-9);
        CHECK(c.facet.area_vector().dot(c.facet.centre()) > 0);
      }
    }
  }

  TEST_CASE("panels cover the whole outline, rock or not, each in the stretch of its node") {
    for (const int nodes : {8, 36, 50}) {
      CAPTURE(nodes);
      const auto mass = tunnel_wall(0.3);
      REQUIRE(mass.carving.dropped_pieces > 0);
      const double perimeter = mass.openings.back().perimeter();
      const LiningFrame<Planar> frame = lining_frame(mass, {.nodes = nodes});
      std::vector<double> length(frame.nodes.size(), 0.0);
      for (const auto& panel : frame.panels) {
        length[static_cast<std::size_t>(panel.node)] += panel.facet.length();
        CHECK(panel.facet.area_vector().dot(panel.facet.centre()) > 0);
      }
      for (const double l : length)
        CHECK(l == voussoir_test::near(perimeter / nodes).epsilon(1e-9));
    }
  }

  TEST_CASE("where a piece of rock was dropped the lining fills the hole and bears behind it") {
    const auto mass = tunnel_wall(0.3);
    REQUIRE(mass.carving.dropped_pieces > 0);
    const LiningFrame<Planar> frame = lining_frame(mass, {.nodes = 36, .fill_depth = 10});
    CHECK(frame.gaps.empty());
    // It bears all along the outline, which is 1e-9 of slicing's tolerance wide at every corner.
    CHECK(contact_length(frame) ==
          voussoir_test::near(mass.openings.back().perimeter()).epsilon(1e-7));
    // What fills is what was dropped, less what lies behind a ledge.
    double filled = 0;
    for (const auto& fill : frame.fills) {
      filled += mass_properties(fill.shape).measure;
      // Behind it, seen from the tunnel, is the body that it sticks to.
      const Vec2 middle = mass_properties(fill.shape).centroid, out = middle.normalized();
      int first = -1;
      for (double d = 0; first < 0 && d < 2; d += 1e-3)
        first = detail::body_at<Planar>(mass, middle + d * out);
      CHECK(first == fill.body);
    }
    CHECK(filled <= mass.carving.dropped_measure * (1 + 1e-9));
    CHECK(filled > 0.9 * mass.carving.dropped_measure);
    // A pressure that is the same everywhere presses every node as on whole rock.
    std::vector<Vec2> force(36, Vec2::Zero());
    for (const auto& c : frame.contacts)
      force[static_cast<std::size_t>(c.node)] += c.facet.area_vector();
    const double facet = 5 * std::sin(pi / 36);
    for (std::size_t k = 0; k < 36; ++k)
      CHECK((force[k] - facet * frame.nodes[k].normalized()).norm() <= 1e-6);
  }

  TEST_CASE("where a block has fallen it does what it does where a piece was dropped") {
    const auto opening = circular_opening(5, 36);
    const auto rock = jointed_rock(domain_around(opening, 14, 4, 4), 3);
    // Every third block at the wall, out of the rock before or after: the same lining.
    const auto standing = carve(rock, opening, 0.1);
    std::vector<int> fallen, number(standing.bodies.size());
    auto dropped = standing;
    dropped.bodies.clear();
    const auto pieces = wall_pieces(standing);
    for (std::size_t b = 0; b < standing.bodies.size(); ++b) {
      const bool is_at_wall = std::any_of(pieces.begin(), pieces.end(), [&](const auto& piece) {
        return piece.body == static_cast<int>(b);
      });
      number[b] = static_cast<int>(dropped.bodies.size());
      if (is_at_wall && b % 3 == 0) {
        fallen.push_back(static_cast<int>(b));
        dropped.dropped.push_back(standing.bodies[b]);
      } else {
        dropped.bodies.push_back(standing.bodies[b]);
      }
    }
    REQUIRE(fallen.size() > 5);
    const LiningRing ring{.nodes = 36};
    const LiningFrame<Planar> after = lining_frame(standing, ring, fallen),
                              before = lining_frame(dropped, ring),
                              spanning = lining_frame(standing, ring);
    CHECK(spanning.gaps.empty());
    CHECK(after.gaps.size() > 2);  // deeper than half a metre
    CHECK(after.fills.size() > spanning.fills.size());
    REQUIRE(after.contacts.size() == before.contacts.size());
    for (std::size_t k = 0; k < after.contacts.size(); ++k) {
      const auto &a = after.contacts[k], &b = before.contacts[k];
      CHECK(a.node == b.node);
      CHECK(number[static_cast<std::size_t>(a.body)] == b.body);
      CHECK((a.facet.start - b.facet.start).norm() < 1e-12);
      CHECK((a.facet.end - b.facet.end).norm() < 1e-12);
    }
    REQUIRE(after.gaps.size() == before.gaps.size());
    for (std::size_t k = 0; k < after.gaps.size(); ++k)
      CHECK(after.gaps[k].share == voussoir_test::near(before.gaps[k].share).epsilon(1e-9));
  }

  TEST_CASE("a hole deeper than the lining fills is a gap, and said") {
    const auto mass = tunnel_wall(0.3);
    const LiningFrame<Planar> on_outline = lining_frame(mass, {.nodes = 36, .fill_depth = 0});
    double on_wall = 0, gaps = 0;
    for (const auto& piece : wall_pieces(mass))
      if (piece.hole < 0) on_wall += piece.facet.length();
    CHECK(std::abs(contact_length(on_outline) - on_wall) <= 1e-9);
    CHECK(on_outline.fills.empty());
    const double stretch = mass.openings.back().perimeter() / 36;
    for (const LiningGap& gap : on_outline.gaps) gaps += gap.share * stretch;
    CHECK(gaps == voussoir_test::near(36 * stretch - on_wall).epsilon(1e-9));
    // In between, the deeper it fills the less is left.
    double before = gaps;
    for (const double depth : {0.1, 0.3, 1.0}) {
      const LiningFrame<Planar> frame = lining_frame(mass, {.nodes = 36, .fill_depth = depth});
      for (const auto& fill : frame.fills)
        for (const Vec2& p : fill.shape.vertices()) CHECK(p.norm() < 5 + depth + 0.02);
      double left = 0;
      for (const LiningGap& gap : frame.gaps) left += gap.share * stretch;
      CHECK(left < before);
      before = left;
    }
    CHECK_THROWS_WITH_AS((void)lining_frame(mass, {.nodes = 36, .fill_depth = -0.1}),
                         "fill depth of a lining = -0.1: must be >= 0 m and finite", InvalidInput);
  }

  TEST_CASE("contacts belong to the blocks that form the wall there") {
    const auto mass = tunnel_wall();
    const auto pieces = wall_pieces(mass);
    for (const auto& c : lining_frame(mass, {.nodes = 50}).contacts) {
      const Vec2 p = c.facet.centre();
      const bool found = std::any_of(pieces.begin(), pieces.end(), [&](const auto& piece) {
        const Vec2 d = piece.facet.end - piece.facet.start, r = p - piece.facet.start;
        return piece.body == c.body && std::abs(cross(d, r)) <= 1e-9 && r.dot(d) > 0 &&
               r.dot(d) < d.squaredNorm();
      });
      CHECK(found);
    }
  }

  TEST_CASE("a uniform pressure on the wall loads every node outwards without turning it") {
    const auto mass = tunnel_wall();
    const LiningFrame<Planar> frame = lining_frame(mass, {.nodes = 36});
    std::vector<Vec2> force(36, Vec2::Zero());
    std::vector<double> moment(36, 0.0);
    for (const auto& c : frame.contacts) {
      const auto k = static_cast<std::size_t>(c.node);
      force[k] += c.facet.area_vector();  // pressure 1, away from the tunnel
      moment[k] += cross(Vec2(c.facet.centre() - frame.nodes[k]), c.facet.area_vector());
    }
    const double facet = 5 * std::sin(pi / 36);
    for (std::size_t k = 0; k < 36; ++k) {
      CHECK((force[k] - facet * frame.nodes[k].normalized()).norm() <= 1e-9);
      CHECK(std::abs(moment[k]) <= 1e-9);
    }
  }

  TEST_CASE("a partial ring is open, its nodes lie in the arc and follow each other") {
    struct Arc {
      double from, to;
      std::size_t nodes;
    };
    // Nodes at (k + 1/2) 10 degrees. The arcs over the springing start behind their gap.
    for (const Arc& arc : {Arc{0, 180, 18}, Arc{-30, 210, 24}, Arc{-40, 40, 8}, Arc{200, 340, 14},
                           Arc{330, 390, 6}}) {
      CAPTURE(arc.from);
      CAPTURE(arc.to);
      const auto mass = tunnel_wall();
      const LiningFrame<Planar> frame =
          lining_frame(mass, {.nodes = 36, .from = arc.from * degree, .to = arc.to * degree});
      CHECK(frame.nodes.size() == arc.nodes);
      REQUIRE(frame.members.size() + 1 == frame.nodes.size());
      const double between = 2 * 2.5 * std::cos(pi / 36) * std::sin(pi / 36);  // middles of facets
      for (const auto& member : frame.members) {
        const int i = member.first, j = member.second;
        CHECK(i + 1 == j);
        CHECK(std::abs((frame.nodes[static_cast<std::size_t>(j)] -
                        frame.nodes[static_cast<std::size_t>(i)])
                           .norm() -
                       between) <= 1e-9);
      }
      const double first = angle_of(frame.nodes.front()) - arc.from * degree;
      CHECK(std::abs(std::remainder(first - 5 * degree, 2 * pi)) <= 1e-9);
      // Only the wall along the arc is touched: one facet for every node.
      CHECK(std::abs(contact_length(frame) -
                     static_cast<double>(arc.nodes) * 5 * std::sin(pi / 36)) <= 1e-9);
    }
  }

  TEST_CASE("the last opening is the one that is lined") {
    auto mass = tunnel_wall();
    const auto larger = circular_opening(6, 24);
    mass = carve(std::move(mass), larger, 0);
    const LiningFrame<Planar> frame = lining_frame(mass, {.nodes = 24});
    CHECK((frame.nodes[0] - larger.edge(0).centre()).norm() <= 1e-12);
    CHECK(std::abs(contact_length(frame) - larger.perimeter()) <= 1e-9);
  }

  TEST_CASE("corners have a node, curves and rough walls have none but at their corners") {
    const auto bare = [](const SimplePolygon& opening, int nodes) {
      const auto made = detail::ring_nodes(opening, {.nodes = nodes});
      std::vector<Vec2> places;
      for (std::size_t k = 0; k < made.places.size(); ++k)
        if (made.is_bare[k]) places.push_back(made.places[k]);
      return places;
    };
    for (const int facets : {12, 13, 72, 720})
      for (const int nodes : {8, 31, 72, 300}) {
        CAPTURE(facets);
        CAPTURE(nodes);
        CHECK(bare(circular_opening(5, facets), nodes).empty());
        CHECK(detail::ring_nodes(circular_opening(5, facets), {.nodes = nodes}).places.size() ==
              static_cast<std::size_t>(nodes));
        CHECK(bare(horseshoe_opening(5, 2, facets), nodes).size() == 2);
      }
    for (const Vec2& p : bare(horseshoe_opening(5, 2, 36), 72))
      CHECK((Vec2(std::abs(p.x()), p.y()) - Vec2(2.5, -2)).norm() < 1e-12);
    // A box scanned every 5 cm, rough by 4 mm to either side: turns of up to 18 degrees from edge
    // to edge; its four corners alone.
    std::vector<Vec2> scanned;
    const Vec2 corners[] = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
    for (int side = 0; side < 4; ++side)
      for (int k = 0; k < 80; ++k) {
        const Vec2 a = corners[side], b = corners[(side + 1) % 4];
        const double rough = k == 0 ? 0 : 4e-3 * (k % 3 - 1);
        scanned.push_back(a + k / 80.0 * (b - a) + rough * Vec2(perpendicular(b - a)).normalized());
      }
    CHECK(bare(SimplePolygon(scanned), 72).size() == 4);
  }

  TEST_CASE("a lining ends where its arc says, and follows it") {
    for (const SimplePolygon& opening : {circular_opening(5, 36), horseshoe_opening(5, 1.7, 36)})
      for (double to = 20; to < 200; to += 0.37) {
        CAPTURE(to);
        const auto ring = detail::ring_nodes(opening, {.nodes = 50, .from = 0, .to = to * degree});
        REQUIRE(ring.ends.size() == 2);
        CHECK(std::abs(angle_of(ring.ends[0].place)) < 1e-12);
        CHECK(std::abs(std::remainder(angle_of(ring.ends[1].place) - to * degree, 2 * pi)) < 1e-12);
        // Stretches cover what lies between, none longer than even ones and none a sliver.
        double sum = 0;
        for (const auto& at : ring.stretches) {
          CHECK(at.end - at.begin <= ring.stretch * (1 + 1e-9));
          CHECK(at.end - at.begin >= 0.5 * ring.stretch);
          sum += at.end - at.begin;
        }
        double length = 0;
        Vec2 before = ring.ends[0].place;
        for (const Vec2& v : opening.vertices()) {
          const double at = angle_of(v) < -1e-9 ? angle_of(v) + 2 * pi : angle_of(v);
          if (at <= 1e-9 || at >= to * degree) continue;
          length += (v - before).norm();
          before = v;
        }
        length += (ring.ends[1].place - before).norm();
        CHECK(sum == voussoir_test::near(length).epsilon(1e-9));
      }
  }

  TEST_CASE("a floor through the centre is not in the arc over it") {
    const SimplePolygon heading({{-3, 0}, {3, 0}, {3, 3}, {-3, 3}});
    const auto ring = detail::ring_nodes(heading, {.from = 0, .to = pi});
    CHECK_FALSE(ring.closed);
    REQUIRE(ring.ends.size() == 2);
    CHECK((ring.ends[0].place - Vec2(3, 0)).norm() < 1e-9);
    CHECK((ring.ends[1].place - Vec2(-3, 0)).norm() < 1e-9);
    for (const Vec2& p : ring.places) CHECK(p.y() > -1e-12);
    for (const auto& end : ring.ends) CHECK(end.refusal.empty());
  }

  TEST_CASE("roof, walls and floor are found by the shape, wherever it stands") {
    struct Case {
      SimplePolygon opening;
      double roof, walls;  ///< where the roof and where roof and walls begin [degrees]
    };
    const SimplePolygon trapezoid({{-3, -2}, {3, -2}, {2, 2}, {-2, 2}});
    for (const Case& c : {Case{circular_opening(5, 72), 0, -45},
                          Case{horseshoe_opening(5, 1.5), 0, -std::atan(0.6) / degree},
                          Case{SimplePolygon({{-2.5, -1.5}, {2.5, -1.5}, {2.5, 2}, {-2.5, 2}}),
                               std::atan(0.8) / degree, -std::atan(0.6) / degree},
                          Case{trapezoid, 45, -std::atan(2.0 / 3) / degree}})
      for (const Vec2& shift : {Vec2(0, 0), Vec2(40, -300)}) {
        std::vector<Vec2> vertices = c.opening.vertices();
        for (Vec2& v : vertices) v += shift;
        const SimplePolygon moved(vertices);
        const auto from = [&](LinedPart part) {
          const LiningRing ring = lined_part(moved, part, {.nodes = 40, .centre = shift});
          CHECK(ring.nodes == 40);
          CHECK(ring.to == voussoir_test::near(pi - ring.from).epsilon(1e-9));
          return ring.from / degree;
        };
        CHECK(std::abs(from(LinedPart::roof) - c.roof) < 1e-9);
        CHECK(std::abs(from(LinedPart::roof_and_walls) - c.walls) < 1e-9);
        CHECK(lined_part(moved, LinedPart::all).to == 2 * pi);
      }
    const SimplePolygon on_its_tip({{0, -2}, {1, 0}, {0, 2}, {-1, 0}});
    CHECK_THROWS_WITH_AS((void)lined_part(on_its_tip, LinedPart::roof_and_walls),
                         "lining: the outline has no floor: nothing at its bottom is flatter than "
                         "45 degrees; accepted: two angles",
                         InvalidInput);
  }

  TEST_CASE("the number of nodes that a bond is said to need is accepted") {
    const std::vector<LiningSection> shell{LiningSection::rectangular(0.1, 25e9)};
    const auto needed = [&](const auto& frame, double stiffness) {
      try {
        require_nodes_for_bond(frame, shell, stiffness);
      } catch (const InvalidInput& fault) {
        const std::string text = fault.what(), before = "nodes >= ";
        const auto at = text.find(before);
        REQUIRE(at != std::string::npos);
        return std::stoi(text.substr(at + before.size()));
      }
      return 0;
    };
    int refused = 0;
    for (const SimplePolygon& section :
         {circular_opening(5, 36), horseshoe_opening(5, 1.5, 20),
          SimplePolygon({{-3, -2}, {3, -2}, {3, 1.7}, {-3, 1.7}}),
          SimplePolygon({{-2, -2}, {2.3, -2}, {1.1, 1.9}, {-2.4, 0.4}})}) {
      const Domain<2> ground{{-9, -9}, {9, 9}};
      const auto mass = carve(jointed_rock(ground, 3), section, 0);
      const Domain<3> wide{{-6, 0, -6}, {6, 4, 6}};
      const auto drift =
          carve(slice<Spatial>(wide, std::vector<JointOf<3>>{}, {}), PrismaticOpening(section), 0);
      for (const double stiffness : {2e8, 1e9, 2.9e9, 8e9})
        for (const int nodes : {8, 11, 24, 37, 50}) {
          CAPTURE(section.size());
          CAPTURE(stiffness);
          CAPTURE(nodes);
          if (const int n = needed(lining_frame(mass, {.nodes = nodes}), stiffness)) {
            ++refused;
            CHECK(n > nodes);
            CHECK(needed(lining_frame(mass, {.nodes = n}), stiffness) == 0);
          }
          const auto ribs = [&](int count) {
            return lining_frame(drift, LiningRibs{.ring = {.nodes = count}, .spacing = 2});
          };
          if (const int n = needed(ribs(nodes), stiffness)) CHECK(needed(ribs(n), stiffness) == 0);
        }
    }
    CHECK(refused > 20);
  }

  TEST_CASE("rings out of range are refused") {
    const auto mass = tunnel_wall();
    for (const int bad : {7, 0, -72, 2001})
      CHECK_THROWS_AS((void)lining_frame(mass, {.nodes = bad}), InvalidInput);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)lining_frame(mass, {.from = 1, .to = 1}), InvalidInput);
    CHECK_THROWS_AS((void)lining_frame(mass, {.from = 0, .to = 6.4}), InvalidInput);
    CHECK_THROWS_AS((void)lining_frame(mass, {.from = nan, .to = 1}), InvalidInput);
    CHECK_THROWS_AS((void)lining_frame(mass, {.nodes = 36, .from = 0, .to = 9 * degree}),
                    InvalidInput);  // one node only
    const Domain<2> ground{{-5, -5}, {5, 5}};
    CHECK_THROWS_AS((void)lining_frame(jointed_rock(ground, 1), {}), InvalidInput);  // no opening
  }
}

}  // namespace lining_ring_test
