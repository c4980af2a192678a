// SPDX-License-Identifier: MIT
// Excavating, supporting and equilibrium in any order: what is built in two ways must be one thing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/elastic_tunnel.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace construction_test {

using namespace voussoir;
using voussoir_test::box;
using voussoir_test::deep;
using voussoir_test::degree;
using voussoir_test::difference;
using voussoir_test::elastic;
using voussoir_test::jointed_rock;
using voussoir_test::tight;

namespace {

using Elastic = Solver<Planar, MohrCoulombJoint>;
const CoulombJoint frictional({5e9, 5e8, 35 * degree});
const InSitu shallow{.density = 2700, .k0 = 0.8, .surcharge = 5e5};

const CoulombJoint elastic_coulomb({1e11, 4e10, 60 * degree});
const LiningSection shell = LiningSection::rectangular(0.1, 20e9);

const SimplePolygon whole = box(-3, -3, 3, 3), heading = box(-3, 0, 3, 3),
                    bench = box(-3, -3, 3, 0);
const Domain<2> ground = domain_around(whole, 24, 8, 8);

template <class Tunnel>
void settle(Tunnel& tunnel, double wall_fraction = 0, const Acceptance& acceptance = tight) {
  const EquilibriumReport report = tunnel.equilibrium(wall_fraction, {}, acceptance);
  INFO(report.reason);
  REQUIRE(report.verdict == Verdict::stable);
}

/// The system is in balance where it is, all walls held as they are.
template <class Tunnel>
double unbalance(Tunnel& tunnel) {
  return tunnel.out_of_balance_ratio();
}

}  // namespace

TEST_SUITE("solver/construction") {
  TEST_CASE("elastic rock: heading and bench end as the whole section") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      const auto rock = jointed_rock(ground, seed);
      Elastic at_once(rock, elastic, deep), in_rounds(rock, elastic, deep);
      at_once.excavate(whole, 0);
      settle(at_once);
      in_rounds.excavate(heading, 0);
      settle(in_rounds);
      in_rounds.excavate(bench, 0);
      settle(in_rounds);
      CHECK(in_rounds.wall_fractions() == std::vector<double>{0, 0});
      CHECK(difference(at_once, in_rounds) < 1e-6);
    }
  }

  TEST_CASE("elastic rock: two tunnels in either order, each relaxed by its own steps") {
    const SimplePolygon left = box(-6, -1.5, -3, 1.5), right = box(2, -2, 5, 1.5);
    const auto rock = jointed_rock(ground, 3);
    Elastic first(rock, elastic, deep), second(rock, elastic, deep), together(rock, elastic, deep);
    first.excavate(left, 0);
    settle(first, 0.4);
    first.excavate(right, 0);
    CHECK(first.wall_fractions() == std::vector<double>{0.4, 1});
    settle(first, 0.7);
    CHECK(first.wall_fractions() == std::vector<double>{0.4, 0.7});
    settle(first, 0.2);
    CHECK(first.wall_fractions() == std::vector<double>{0.2, 0.2});
    settle(first);
    second.excavate(right, 0);
    settle(second);
    second.excavate(left, 0);
    settle(second);
    together.excavate(left, 0);
    together.excavate(right, 0);
    settle(together);
    CHECK(difference(first, second) < 1e-6);
    CHECK(difference(first, together) < 1e-6);
  }

  TEST_CASE("a part of its own for every wall") {
    const auto rock = jointed_rock(ground, 5);
    const SimplePolygon left = box(-6, -1.5, -3, 1.5), right = box(2, -2, 5, 1.5);
    Elastic tunnel(rock, elastic, deep), other(rock, elastic, deep);
    tunnel.excavate(left, 0);
    tunnel.excavate(right, 0);
    const auto reached = [&](Elastic& it, const std::vector<double>& fractions) {
      REQUIRE(it.equilibrium(fractions, {}, tight).verdict == Verdict::stable);
      CHECK(it.wall_fractions() == fractions);
    };
    reached(tunnel, {0.25, 0.75});
    reached(tunnel, {0.25, 0.5});
    reached(tunnel, {0, 0.5});
    other.excavate(left, 0);
    other.excavate(right, 0);
    reached(other, {0, 0.5});
    CHECK(difference(tunnel, other) < 1e-6);
    CHECK_THROWS_WITH_AS(tunnel.equilibrium(std::vector<double>{0.1, 0.5}),
                         doctest::Contains("no more than was left before"), InvalidInput);
    CHECK_THROWS_AS(tunnel.equilibrium(std::vector<double>{0}), InvalidInput);
  }

  TEST_CASE("nothing moves by excavating alone, in rock that has slipped and is supported") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      Solver<> tunnel(jointed_rock(ground, seed), frictional, shallow);
      tunnel.excavate(heading);
      settle(tunnel, 0.5, {});
      // Those through the side walls hold blocks that the bench cuts.
      for (const double y : {0.1, 0.3, 0.5, 1.5})
        for (const double side : {-1.0, 1.0})
          tunnel.install_bolt({{3 * side, y}, {6 * side, y}}, AxialBolt({.axial_stiffness = 2e8}));
      settle(tunnel, 0.2, {});
      const double before = unbalance(tunnel);
      // By bolt and place on it: those that hold a piece too small to be kept are gone.
      const auto pulls_of = [](const Solver<>& it) {
        std::map<std::pair<int, double>, double> pulls;
        for (const auto& s : it.bolts()->springs()) {
          const auto span = s.span_at(it.system().displacement.data());
          pulls[{s.bolt, s.position}] = it.bolts()->law_of(s).force(span, s.state).axial;
        }
        return pulls;
      };
      const auto moved = [&](const SimplePolygon& opening) {
        auto copy = tunnel;
        copy.excavate(opening);
        return copy;
      };
      auto next = moved(bench);
      // What was out of balance before stays; where the bench was, nothing is.
      CHECK(unbalance(next) <= before * (1 + 1e-9));
      auto held = pulls_of(tunnel);
      const auto pulls = pulls_of(next);
      CHECK(pulls.size() + 2 >= held.size());
      // Displacements of a millimetre, rounded at 1e-19 m, times 2e8 N/m.
      for (const auto& [place, pull] : pulls) CHECK(std::abs(pull - held[place]) <= 1e-9);
      // Slip is remembered: with the wall held, the rock stays where it is.
      const Eigen::VectorXd u = next.system().displacement;
      REQUIRE(next.equilibrium(std::vector<double>{0.2, 1}).verdict == Verdict::stable);
      CHECK((next.system().displacement - u).norm() <= 1e-2 * u.norm());
    }
  }

  TEST_CASE("joints that the excavation leaves alone carry what they did, slip and all") {
    int compared = 0, slipped = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      Solver<> tunnel(jointed_rock(ground, seed), CoulombJoint({5e9, 5e8, 30 * degree}), shallow);
      tunnel.excavate(heading);
      (void)tunnel.equilibrium(0.3);
      Solver<> next = tunnel;
      next.excavate(bench);
      const auto force = [](const Solver<>& it, const auto& c, int k) {
        const auto& p = it.system().joints.points()[static_cast<std::size_t>(k)];
        const auto motion = c.motion(p, c.offset_of(p), it.system().displacement.data());
        return it.system().joints.law_of(c).force({p.weight, p.initial, motion}, p.state);
      };
      const auto middle = [](const Solver<>& it, const auto& c) {
        return Vec2(it.system().body(c.a).centre + c.arm_a);
      };
      const auto origin = [&](int b) { return next.mass().origins[static_cast<std::size_t>(b)]; };
      const auto& before = tunnel.system().joints;
      for (const auto& c : next.system().joints.contacts())
        for (const auto& was : before.contacts()) {
          if (was.a != origin(c.a) || was.b != origin(c.b)) continue;
          if ((middle(tunnel, was) - middle(next, c)).norm() > 1e-9) continue;
          if (was.count != c.count) continue;
          for (int k = 0; k < c.count; ++k) {
            // Points may be told the other way round.
            const auto
                first = before.points()[static_cast<std::size_t>(was.first)].offset,
                here = next.system().joints.points()[static_cast<std::size_t>(c.first + k)].offset;
            const int same = (first - here).norm() < 1e-9 ? was.first : was.last() - 1;
            const auto now = force(next, c, c.first + k), then = force(tunnel, was, same);
            // Of stresses of 1e6 Pa: 1e-9 of the force, and of displacements rounded at 1e-18 m.
            CHECK(std::abs(now.normal - then.normal) <= 1e-9 * std::abs(then.normal) + 1e-6);
            CHECK((now.tangential - then.tangential).norm() <= 1e-9 * std::abs(then.normal) + 1e-6);
            // A joint that slides carries the same without its history, but not when it turns back.
            const auto slip_of = [](const auto& points, int n) {
              return points[static_cast<std::size_t>(n)]
                  .template history<CoulombJoint>()
                  .plastic_slip;
            };
            const auto slip = slip_of(before.points(), same);
            CHECK(slip_of(next.system().joints.points(), c.first + k) == slip);
            slipped += slip.norm() > 1e-6;
            ++compared;
          }
        }
    }
    CHECK(compared > 3000);
    CHECK(slipped > 20);
  }

  TEST_CASE("an arch in the heading carries on over the bench") {
    Solver<> tunnel(jointed_rock(ground, 2), frictional, shallow);
    tunnel.excavate(heading);
    settle(tunnel, 0.6, {});
    tunnel.install_lining(
        lining_frame(tunnel.mass(), {.nodes = 72, .from = 2 * degree, .to = 178 * degree}), shell,
        CoulombJoint({1e9, 1e9, 30 * degree}));
    settle(tunnel, 0.2, {});
    const auto before = lining_forces(tunnel);
    const double out_of_balance = unbalance(tunnel);
    tunnel.excavate(bench);
    // The lowest nodes bear on blocks that the bench cuts. What nodes without weight are held
    // against, the lightest block, is another then: by 1.2 %.
    CHECK(unbalance(tunnel) <= out_of_balance * 1.02);
    const auto after = lining_forces(tunnel);
    REQUIRE(after.size() == before.size());
    for (std::size_t k = 0; k < before.size(); ++k) {
      CHECK(after[k].thrust == before[k].thrust);
      CHECK(after[k].moment == before[k].moment);
    }
    for (const double left : {1.0, 0.5}) {
      const EquilibriumReport report = tunnel.equilibrium(std::vector<double>{0.2, left});
      INFO(report.reason);
      CHECK(report.verdict == Verdict::stable);
    }
    CHECK(lining_forces(tunnel)[10].thrust != before[10].thrust);
  }

  TEST_CASE("after contact updates, too, excavating alone moves nothing") {
    const Acceptance updating{.contact_update_limit = 2e-4};
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      Solver<> tunnel(jointed_rock(ground, seed), frictional, shallow);
      tunnel.excavate(heading);
      tunnel.install_bolt({{0, 3}, {0, 6}}, AxialBolt({.axial_stiffness = 2e8}));
      settle(tunnel, 0.2, updating);
      REQUIRE(tunnel.system().has_updated_contacts());
      const double largest = tunnel.system().largest_translation(tunnel.system().displacement);
      Solver<> next = tunnel;
      next.excavate(bench);
      REQUIRE(next.equilibrium(std::vector<double>{0.2, 1}, {}, updating).verdict ==
              Verdict::stable);
      // A block that is not cut has the same centre; it stays within what an update moves it.
      double apart = 0;
      std::size_t same = 0;
      for (std::size_t b = 0; b < next.mass().bodies.size(); ++b) {
        const auto old = static_cast<std::size_t>(next.mass().origins[b]);
        const Vec2 centre = next.mass().bodies[b].properties.centroid;
        if (centre != tunnel.mass().bodies[old].properties.centroid) continue;
        ++same;
        apart = std::max(apart, (next.displacement_of(static_cast<int>(b), centre) -
                                 tunnel.displacement_of(static_cast<int>(old), centre))
                                    .norm());
      }
      CHECK(same > 100);
      CHECK(apart < 0.03 * largest);
    }
  }

  TEST_CASE("what has detached stays detached, under its new numbers") {
    Solver<> tunnel(jointed_rock(ground, 4), CoulombJoint({5e9, 5e8, 25 * degree}), shallow);
    tunnel.excavate(heading);
    (void)tunnel.equilibrium();
    REQUIRE(!tunnel.fallen().empty());
    std::vector<Vec2> places;
    for (const int b : tunnel.fallen())
      places.push_back(tunnel.mass().bodies[static_cast<std::size_t>(b)].properties.centroid);
    tunnel.excavate(box(-8, -6, -6, -4));  // far from there
    REQUIRE(tunnel.fallen().size() == places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto b = static_cast<std::size_t>(tunnel.fallen()[k]);
      CHECK(tunnel.mass().bodies[b].properties.centroid == places[k]);
      CHECK(tunnel.system().body(tunnel.fallen()[k]).is_gone);
    }
  }

  TEST_CASE("an island between two rounds hangs on nothing and falls") {
    Solver<> tunnel(slice(ground, {}, {}), elastic_coulomb, shallow);
    const auto c_shape = [](double side) {
      std::vector<Vec2> v{{0, 3}, {3, 3}, {3, -3}, {0, -3}, {0, -1}, {1, -1}, {1, 1}, {0, 1}};
      for (Vec2& p : v) p.x() *= side;
      if (side > 0) std::reverse(v.begin(), v.end());
      return SimplePolygon(v);
    };
    tunnel.excavate(c_shape(1), 0);
    settle(tunnel, 0, {});
    CHECK(tunnel.fallen().empty());
    tunnel.excavate(c_shape(-1), 0);
    const EquilibriumReport report = tunnel.equilibrium();
    CHECK(report.verdict == Verdict::stable);
    CHECK(report.fallen.size() == 1);
    CHECK(report.fallen_measure == voussoir_test::near(4));
  }

  TEST_CASE("supports that would lose their rock are named, and nothing is changed") {
    Solver<> tunnel(jointed_rock(ground, 2), frictional, shallow);
    tunnel.excavate(heading);
    settle(tunnel, 0.5, {});
    Solver<> bolted = tunnel;
    bolted.install_bolt({{0, 0.5}, {0, -6}}, AxialBolt({.axial_stiffness = 2e8}));
    CHECK_THROWS_WITH_AS(bolted.excavate(bench),
                         doctest::Contains("excavate: bolt 0 holds rock at"), InvalidInput);
    CHECK(bolted.mass().openings.size() == 1);
    CHECK(bolted.wall_fractions() == std::vector<double>{0.5});
    CHECK(bolted.equilibrium(0.4).verdict == Verdict::stable);
  }

  TEST_CASE("2-D: a bench takes the invert out of the ring of its heading") {
    Elastic tunnel(jointed_rock(ground, 2), elastic, deep);
    tunnel.excavate(heading, 0);
    settle(tunnel, 0.5);
    tunnel.install_lining(lining_frame(tunnel.mass(), {.nodes = 36}), shell,
                          CoulombJoint({1e9, 1e9, 60 * degree}));
    settle(tunnel, 0.2);
    const std::size_t members = lining_members(tunnel).size();
    tunnel.excavate(bench, 0);
    const auto& opened = tunnel.opened_linings();
    REQUIRE(opened.size() == 1);
    CHECK(opened[0].lining == 0);
    CHECK(!opened[0].is_gone);
    // Of 36 nodes on 18 m the invert of 6 m has 12, its corners shared with the walls.
    CHECK(opened[0].nodes >= 11);
    CHECK(opened[0].nodes <= 13);
    CHECK(opened[0].members == opened[0].nodes + 1);
    REQUIRE(opened[0].ends.size() == 2);
    for (const Vec2& end : opened[0].ends) {
      CHECK(std::abs(std::abs(end.x()) - 3) < 1e-9);
      CHECK(std::abs(end.y()) < 0.51);
    }
    // What the members carried is held with the wall: nothing jumps.
    CHECK(unbalance(tunnel) < 1e-5);
    settle(tunnel);
    CHECK(lining_members(tunnel).size() == members - static_cast<std::size_t>(opened[0].members));

    // A round beside it opens it again: what the first took out stays said.
    const OpenedLining<2> first = opened[0];
    tunnel.excavate(box(3, 1, 4, 2), 0);
    REQUIRE(opened.size() == 2);
    CHECK(opened[0].nodes == first.nodes);
    CHECK(opened[1].lining == 0);
    CHECK(opened[1].nodes >= 1);
    CHECK(opened[1].nodes <= 3);  // half a metre apart on a metre of wall
    CHECK(opened[1].ends.size() == 2);
    settle(tunnel);
    CHECK(lining_members(tunnel).size() ==
          members - static_cast<std::size_t>(opened[0].members + opened[1].members));
  }
}

}  // namespace construction_test
