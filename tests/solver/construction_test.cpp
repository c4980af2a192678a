// SPDX-License-Identifier: MIT
// Excavating, supporting and equilibrium in any order: what is built in two ways must be one thing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"

namespace construction_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_mass;
using voussoir_test::jointed_rock;

namespace {

/// Two searches to this error each are compared within 1e-6 of the largest displacement.
const Acceptance tight{.error_estimate = 1e-8, .unbalance_over_weight = 1e-6};

/// Joints that neither open nor slip.
const MohrCoulombJoint elastic({.joint_normal_stiffness = 1e11,
                                .joint_shear_stiffness = 4e10,
                                .friction_angle = 60 * degree,
                                .cohesion = 2e9,
                                .tensile_strength = 1e9});
template <class Geometry>
using Elastic = Solver<Geometry, MohrCoulombJoint>;
const InSitu deep{.density = 2700, .k0 = 0.9, .surcharge = 2e7};
const CoulombJoint frictional({5e9, 5e8, 35 * degree});
const InSitu shallow{.density = 2700, .k0 = 0.8, .surcharge = 5e5};

SimplePolygon box(double x0, double y0, double x1, double y1) {
  return SimplePolygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
const SimplePolygon whole = box(-3, -3, 3, 3), heading = box(-3, 0.5, 3, 3),
                    bench = box(-3, -3, 3, 0.5);
const Domain<2> ground = domain_around(whole, 24, 8, 8);

template <class Tunnel>
void settle(Tunnel& tunnel, double wall_fraction = 0, const Acceptance& acceptance = tight) {
  const EquilibriumReport report = tunnel.equilibrium(wall_fraction, {}, acceptance);
  INFO(report.reason);
  REQUIRE(report.verdict == Verdict::stable);
}

/// The largest difference of displacements of two tunnels in the same rock, over the largest
/// displacement; blocks are matched by their centroids.
template <class Tunnel>
double difference(const Tunnel& x, const Tunnel& y) {
  REQUIRE(x.mass().bodies.size() == y.mass().bodies.size());
  double apart = 0, largest = 0;
  for (std::size_t b = 0; b < x.mass().bodies.size(); ++b) {
    const auto centre = x.mass().bodies[b].properties.centroid;
    std::size_t same = 0;
    double least = 1e300;
    for (std::size_t k = 0; k < y.mass().bodies.size(); ++k) {
      const double distance = (y.mass().bodies[k].properties.centroid - centre).norm();
      if (distance < least) {
        least = distance;
        same = k;
      }
    }
    REQUIRE(least < 1e-9);
    const auto u = x.displacement_of(static_cast<int>(b), centre),
               v = y.displacement_of(static_cast<int>(same), centre);
    apart = std::max(apart, (u - v).norm());
    largest = std::max(largest, u.norm());
  }
  return apart / largest;
}

/// The system is in balance where it is, all walls held as they are.
template <class Tunnel>
double unbalance(Tunnel& tunnel) {
  Eigen::VectorXd f;
  tunnel.system().forces(tunnel.system().displacement, f);
  return tunnel.system().unbalance_over_weight(f);
}

}  // namespace

TEST_SUITE("solver/construction") {
  TEST_CASE("elastic rock: heading and bench end as the whole section") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      const auto rock = jointed_rock(ground, seed);
      Elastic<Planar> at_once(rock, elastic, deep), in_rounds(rock, elastic, deep);
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
    Elastic<Planar> first(rock, elastic, deep), second(rock, elastic, deep), together(rock, elastic, deep);
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
    Elastic<Planar> tunnel(rock, elastic, deep), other(rock, elastic, deep);
    tunnel.excavate(left, 0);
    tunnel.excavate(right, 0);
    const auto reached = [&](Elastic<Planar>& it, const std::vector<double>& fractions) {
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
      for (const double x : {-1.5, 0.0, 1.5})
        tunnel.install_bolt({{x, 3}, {x, 6}}, AxialBolt({.axial_stiffness = 2e8}));
      settle(tunnel, 0.2, {});
      const double before = unbalance(tunnel);
      std::vector<double> pulls;
      for (const auto& s : tunnel.bolts()->springs())
        pulls.push_back(tunnel.bolts()
                            ->law_of(s)
                            .force(s.span_at(tunnel.system().displacement.data()), s.state)
                            .axial);
      const auto moved = [&](const SimplePolygon& opening) {
        auto copy = tunnel;
        copy.excavate(opening);
        return copy;
      };
      auto next = moved(bench);
      // What was out of balance before stays; where the bench was, nothing is.
      CHECK(unbalance(next) <= before * (1 + 1e-9));
      const auto& springs = next.bolts()->springs();
      REQUIRE(springs.size() == pulls.size());
      for (std::size_t k = 0; k < pulls.size(); ++k) {
        const auto& s = springs[k];
        const double pull = next.bolts()
                                ->law_of(s)
                                .force(s.span_at(next.system().displacement.data()), s.state)
                                .axial;
        // Displacements of a millimetre, rounded at 1e-19 m, times 2e8 N/m.
        CHECK(std::abs(pull - pulls[k]) <= 1e-9);
      }
      // Slip is remembered: with the wall held, the rock stays where it is.
      const Eigen::VectorXd u = next.system().displacement;
      REQUIRE(next.equilibrium(std::vector<double>{0.2, 1}).verdict == Verdict::stable);
      CHECK((next.system().displacement - u).norm() <= 1e-2 * u.norm());
    }
  }

  TEST_CASE("3-D: rounds along the axis end as one drift") {
    const Domain<3> space{{-6, 0, -6}, {6, 8, 6}};
    const auto section = circular_opening(4, 12);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      CAPTURE(seed);
      const auto rock = jointed_mass(space, seed, 2.2, {.min_inscribed_radius = 0.25});
      Elastic<Spatial> at_once(rock, elastic, deep), in_rounds(rock, elastic, deep);
      at_once.excavate(PrismaticOpening(section, -1, 6), 0);
      settle(at_once);
      for (int round = 0; round < 3; ++round) {
        in_rounds.excavate(PrismaticOpening(section, round == 0 ? -1 : 2 * round, 2 * round + 2),
                           0);
        settle(in_rounds);
      }
      CHECK(difference(at_once, in_rounds) < 1e-6);
    }
  }
}

}  // namespace construction_test
