// SPDX-License-Identifier: MIT
// A lining reaches as far as its arc says: what it carries follows the ends of the arc, and jumps
// nowhere but at a corner. Joints are stiff here: where one crosses the wall and is soft, a foot
// that comes to stand on the next block is a step of its own.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/lined_part.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/arch_on_feet.hpp"
#include "support/elastic_tunnel.hpp"
#include "support/faults.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/transformed.hpp"

namespace lining_ends_test {

using namespace voussoir;
using voussoir_test::apart;
using voussoir_test::ArchOnFeet;
using voussoir_test::box;
using voussoir_test::degree;
using voussoir_test::mirrored_2d;
using voussoir_test::says;

namespace {

/// Joints that neither open nor slip, soft enough for a lining to bear something.
const MohrCoulombJoint tied({.joint_normal_stiffness = 5e9,
                             .joint_shear_stiffness = 2e9,
                             .friction_angle = 60 * degree,
                             .cohesion = 2e9,
                             .tensile_strength = 1e9});
const CoulombJoint interface({1e9, 1e9, 30 * degree});
const FootBearing bearing({.width = 0.2, .stiffness = 5e9, .friction_angle = 30 * degree});
const Acceptance exact{.error_estimate = 1e-6};

/// 5 m wide, the floor 1.5 m below the centre: its corners are at -30.964 and 210.964 degrees.
SimplePolygon section(const std::string& name) {
  if (name == "horseshoe") return horseshoe_opening(5, 1.5);
  if (name == "box") return box(-2.5, -1.5, 2.5, 2);
  // D: a flat arch on upright walls, with corners at its haunches.
  std::vector<Vec2> vertices{{-2.5, -1.5}, {2.5, -1.5}};
  const double rise = 1.2, radius = (2.5 * 2.5 + rise * rise) / (2 * rise);
  const double half = std::asin(2.5 / radius);
  for (int k = 0; k <= 24; ++k) {
    const double angle = half * (1 - k / 12.0);
    vertices.emplace_back(radius * std::sin(angle), 1 + rise - radius + radius * std::cos(angle));
  }
  return SimplePolygon(vertices);
}
constexpr double corner = -30.9637565;  // atan(1.5 / 2.5) [degrees]

template <class Tunnel = Solver<MohrCoulombJoint>>
ArchOnFeet carried(const RockMass<Planar>& rock, const SimplePolygon& opening,
                   const LiningRing& ring) {
  Tunnel tunnel(rock, tied, {.density = 2700, .surcharge = 1e6});
  tunnel.excavate(opening, 0);
  tunnel.install_lining(lining_frame(tunnel.mass(), opening, ring),
                        LiningSection::rectangular(0.2, 25e9), interface, bearing);
  REQUIRE(tunnel.equilibrium(0, {}, exact).verdict == Verdict::stable);
  return voussoir_test::arch_on_feet(tunnel);
}
template <class Tunnel = Solver<MohrCoulombJoint>>
ArchOnFeet carried(const RockMass<Planar>& rock, const SimplePolygon& opening, double from,
                   double to) {
  return carried<Tunnel>(rock, opening, {.from = from * degree, .to = to * degree});
}

/// Whether both feet stand on one block each while they go down to the corner.
bool stays_on_blocks(RockMass<Planar> rock, const SimplePolygon& opening) {
  rock = carve(std::move(rock), opening, 0);
  const auto bodies = [&](double from) {
    const auto frame =
        lining_frame(rock, opening, {.from = from * degree, .to = (180 - from) * degree});
    return std::pair(frame.ends[0].body, frame.ends[1].body);
  };
  return bodies(-29) == bodies(-30.95);
}

}  // namespace

TEST_SUITE("solver/lining_ends") {
  void follow(const std::string& name) {
    CAPTURE(name);
    const SimplePolygon opening = section(name);
    const Domain<2> ground = domain_around(opening, 20, 6, 6);
    std::vector<Joint> joints;
    RockMass<Planar> rock;
    std::uint64_t seed = 0;
    do {
      joints = joint_network(voussoir_test::paper_sets(100), ground, ++seed);
      rock = slice(ground, joints, {0.4, 5});
    } while (!stays_on_blocks(rock, opening));
    CAPTURE(seed);
    const auto mirror = mirrored_2d();
    const RockMass<Planar> image = slice(ground, voussoir_test::moved(joints, mirror), {0.4, 5});
    for (const bool both : {true, false}) {
      CAPTURE(both);
      ArchOnFeet before{};
      for (int step = 0; step <= 20; ++step) {
        const double from = -29 - 0.25 * step, to = both ? 180 - from : 210;
        CAPTURE(from);
        // Beyond the corner, by more than half a degree, feet would stand on the floor's surface.
        if (from < corner - 0.5) {
          std::string refusal;
          try {
            (void)carried(rock, opening, from, to);
          } catch (const InvalidInput& refused) {
            refusal = refused.what();
          }
          CAPTURE(refusal);
          CHECK(says(refusal, "would stand on nothing"));
          CHECK(says(refusal, "on the flat floor between its corners at -149.04 and -30.964 deg"));
          continue;
        }
        const ArchOnFeet now = carried(rock, opening, from, to);
        if (step > 0) CHECK(apart(now, before) < 0.05);
        before = now;
        if (both || step % 4 != 0) continue;
        // The mirror image: two searches to an error of 1e-6 of the largest displacement each.
        const ArchOnFeet mirrored =
            carried(image, voussoir_test::moved(opening, mirror), 180 - to, 180 - from);
        CHECK(apart(now, mirrored.mirrored()) < 1e-3);
      }
    }
  }
  TEST_CASE("what an arch carries follows its ends to the corner: horseshoe") {
    follow("horseshoe");
  }
  TEST_CASE("what an arch carries follows its ends to the corner: D-shape") { follow("D"); }
  TEST_CASE("what an arch carries follows its ends to the corner: box") { follow("box"); }

  TEST_CASE("by another procedure, too, the corner is no step") {
    const SimplePolygon opening = section("horseshoe");
    const RockMass<Planar> rock =
        voussoir_test::jointed_rock(domain_around(opening, 20, 6, 6), 1, {0.4, 5}, 100);
    using Relaxed = Solver<MohrCoulombJoint, Relaxation>;
    const ArchOnFeet above = carried<Relaxed>(rock, opening, -30.75, 210.75),
                     on_it = carried<Relaxed>(rock, opening, -31, 211);
    CHECK(apart(above, on_it) < 0.05);
    // Friction on the lining remembers the path: procedures differ.
    CHECK(apart(on_it, carried(rock, opening, -31, 211)) < 0.05);
  }

  TEST_CASE("an end within half a degree beyond a corner is on it, and a word finds it") {
    const SimplePolygon opening = section("box");
    const RockMass<Planar> rock =
        voussoir_test::jointed_rock(domain_around(opening, 20, 6, 6), 2, {0.4, 5}, 100);
    const ArchOnFeet at_corner =
        carried(rock, opening, lined_part(opening, LinedPart::roof_and_walls));
    CHECK(apart(at_corner, carried(rock, opening, -31.4, 211.4)) < 1e-9);
    CHECK(apart(at_corner, carried(rock, opening, -31, 211)) < 1e-9);
  }

  TEST_CASE("roof and walls, then the floor, are the ring at once") {
    for (const std::string name : {"D", "box"}) {
      CAPTURE(name);
      const SimplePolygon opening = section(name);
      Solver<MohrCoulombJoint> at_once(
          voussoir_test::jointed_rock(domain_around(opening, 20, 6, 6), 4, {0.4, 5}, 100), tied,
          {.density = 2700, .surcharge = 1e6});
      at_once.excavate(opening, 0);
      auto in_parts = at_once;
      const LiningSection shell = LiningSection::rectangular(0.2, 25e9);
      const LiningRing upper = lined_part(opening, LinedPart::roof_and_walls);
      LiningRing floor;
      floor.from = upper.to - 360 * degree;
      floor.to = upper.from;
      const auto ring = lining_frame(at_once.mass(), LiningRing{});
      at_once.install_lining(ring, shell, interface);
      for (const LiningRing& part : {upper, floor})
        in_parts.install_lining(lining_frame(in_parts.mass(), part), shell, interface);
      CHECK(lining_members(in_parts).size() == ring.members.size());
      REQUIRE(at_once.equilibrium(0, {}, exact).verdict == Verdict::stable);
      REQUIRE(in_parts.equilibrium(0, {}, exact).verdict == Verdict::stable);
      CHECK(voussoir_test::difference(at_once, in_parts) < 1e-5);
      CHECK(support_demand(in_parts).largest_moment ==
            voussoir_test::near(support_demand(at_once).largest_moment).epsilon(1e-4));
    }
  }

  TEST_CASE("bars on pins go round a corner without a node that nothing holds") {
    const SimplePolygon opening = section("horseshoe");
    Solver<MohrCoulombJoint, PinnedBar> tunnel(
        voussoir_test::jointed_rock(domain_around(opening, 20, 6, 6), 4, {0.4, 5}, 100), tied,
        {.density = 2700, .surcharge = 1e6});
    tunnel.excavate(opening, 0);
    const auto frame = lining_frame(tunnel.mass(), LiningRing{});
    tunnel.install_lining(frame, LiningSection::rectangular(0.2, 25e9), interface);
    CHECK(tunnel.lining()->node_count() == static_cast<int>(frame.nodes.size()) - 2);
    CHECK(static_cast<int>(tunnel.lining()->members().size()) == tunnel.lining()->node_count());
    CHECK(tunnel.equilibrium().verdict == Verdict::stable);
    CHECK(support_demand(tunnel).largest_thrust > 1e4);
  }
}

}  // namespace lining_ends_test
