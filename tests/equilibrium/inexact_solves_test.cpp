// SPDX-License-Identifier: MIT
// The error estimate holds whoever solves the linear equations: the same random tunnels by
// iteration and by a factor.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

namespace inexact_solves_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

// In one step: the estimate is that of one search. What increments have committed on the way, each
// within the tolerance of the way, is not in it.
const TwoLevel iterative({.increments = 1, .linear = {.method = LinearMethod::iterative}});
const TwoLevel direct({.increments = 1, .linear = {.method = LinearMethod::direct}});

/// Largest difference of the translation of a block [m].
template <class Tunnel>
double difference(const Tunnel& a, const Tunnel& b) {
  double largest = 0;
  for (int k = 0; k < a.system().body_count(); ++k) {
    if (!a.system().body(k).is_block) continue;
    const Eigen::Index first = Tunnel::dof * static_cast<Eigen::Index>(k);
    largest = std::max(largest, (part<Tunnel::dim>(a.system().displacement, first) -
                                 part<Tunnel::dim>(b.system().displacement, first))
                                    .norm());
  }
  return largest;
}

/// A bolted tunnel in random rock, every other one lined with concrete up to 1000 times stiffer.
Solver<> random_tunnel(Random& random, std::uint64_t seed) {
  const auto opening = circular_opening(4 + 2 * random.uniform(), 32);
  const double stiffness = 1e9 * std::pow(10, random.uniform());
  const double k0 = 0.7 + 0.6 * random.uniform(), friction = 35 + 10 * random.uniform();
  Solver<> tunnel(jointed_rock(domain_around(opening, 30, 10, 12), seed),
                  CoulombJoint({stiffness, 0.2 * stiffness, friction * degree}),
                  {.density = 2700, .k0 = k0});
  tunnel.excavate(opening);
  for (const auto& bar : bolt_bars({.length = 3, .angular_spacing = 20 * degree}, opening))
    tunnel.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8}));
  if (seed % 2 == 0)
    tunnel.install_lining(lining_frame(tunnel.mass(), {}),
                          LiningSection::rectangular(0.15, 25e9 * std::pow(10, random.uniform())),
                          CoulombJoint({1e10, 1e9, 30 * degree}));
  return tunnel;
}

}  // namespace

TEST_SUITE("equilibrium/inexact_solves") {
  void iterate_and_factor(std::uint64_t seeds) {
    Random random(51);
    std::uint64_t compared = 0, iterated = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      CAPTURE(seed);
      Solver<> a = random_tunnel(random, seed), b = a;
      const EquilibriumReport by_iteration = a.equilibrium(0, iterative),
                              by_factor = b.equilibrium(0, direct);
      REQUIRE(by_iteration.verdict == by_factor.verdict);
      REQUIRE(by_iteration.fallen == by_factor.fallen);
      if (by_iteration.verdict != Verdict::stable) continue;
      ++compared;
      iterated += by_iteration.linear.method == LinearMethod::iterative;
      CHECK(by_factor.linear.method == LinearMethod::direct);
      CHECK(by_factor.linear.iterations == 0);
      const double largest =
          std::max(by_iteration.largest_displacement, by_factor.largest_displacement);
      CHECK(difference(a, b) <= (by_iteration.error_estimate + by_factor.error_estimate) * largest);
    }
    CHECK(10 * compared >= 8 * seeds);
    CHECK(iterated == compared);
  }
  TEST_CASE("random tunnels: what iteration and a factor give differ by less than they say") {
    iterate_and_factor(10);
  }
  TEST_CASE("50 random tunnels: iteration and a factor [long]") { iterate_and_factor(50); }

  TEST_CASE("about to move too far: iteration and a factor say the same, near the limit too") {
    Random random(52);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Solver<> tunnel = random_tunnel(random, seed);
      // Where it begins, to a hair, by a factor.
      double low = 0, high = 0.1;
      const auto refused = [&](const TwoLevel& method, double limit) {
        Solver<> one = tunnel;
        const EquilibriumReport report = one.equilibrium(0, method, {.displacement_limit = limit});
        return report.reason.find("raise displacement_limit") != std::string::npos;
      };
      for (int k = 0; k < 16; ++k) {
        const double middle = 0.5 * (low + high);
        (refused(direct, middle) ? low : high) = middle;
      }
      CAPTURE(seed);
      REQUIRE(low > 0);
      for (const double share : {0.9, 0.97, 0.99, 1.01, 1.03, 1.1}) {
        const double limit = share * 0.5 * (low + high);
        CAPTURE(share);
        if (limit > low && limit < high) continue;
        CHECK(refused(iterative, limit) == refused(direct, limit));
      }
    }
  }

  TEST_CASE("a bolted tunnel in 3-D too") {
    const Domain<3> ground{{-10, 0, -8}, {10, 5, 10}};
    SpatialJointSet a{"J1", 75 * degree, 90 * degree}, b{"J2", 25 * degree, 90 * degree},
        c{"J3", 80 * degree, 5 * degree};
    for (SpatialJointSet* set : {&a, &b, &c}) {
      set->fisher_concentration = 2000;
      set->spacing = 1.5;
    }
    Solver<Spatial> by_iteration(
        slice<Spatial>(ground, joint_network({a, b, c}, ground, 3), {.min_inscribed_radius = 0.15}),
        CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700, .surcharge = 1e5});
    by_iteration.excavate(PrismaticOpening(circular_opening(5, 32)), 0.05);
    for (const auto& bar : bolt_bars({.length = 3, .angular_spacing = 20 * degree},
                                     by_iteration.mass().openings.back(), 1.5, 0, 5))
      by_iteration.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8}));
    Solver<Spatial> by_factor = by_iteration;
    const EquilibriumReport one = by_iteration.equilibrium(0, iterative),
                            two = by_factor.equilibrium(0, direct);
    REQUIRE(one.verdict == Verdict::stable);
    REQUIRE(two.verdict == Verdict::stable);
    CHECK(one.linear.method == LinearMethod::iterative);
    CHECK(one.fallen == two.fallen);
    CHECK(difference(by_iteration, by_factor) <=
          (one.error_estimate + two.error_estimate) * two.largest_displacement);
  }
}

}  // namespace inexact_solves_test
