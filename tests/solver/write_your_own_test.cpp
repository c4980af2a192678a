// SPDX-License-Identifier: MIT
// The laws of docs/write-your-own.md, taken from the page when this was configured, in a solver.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>
#include <write_your_own.hpp>

#include "support/jointed_rock.hpp"

namespace write_your_own_test {

using voussoir_test::degree;

namespace {

/// A 5 m opening in some 500 blocks.
template <class Tunnel, class Law>
Tunnel excavated(const Law& law) {
  const auto opening = circular_opening(5, 36);
  Tunnel tunnel(voussoir_test::jointed_rock(domain_around(opening, 25, 10, 10), 2), law,
                {.density = 2700});
  tunnel.excavate(opening);
  return tunnel;
}

}  // namespace

TEST_SUITE("solver/write_your_own") {
  TEST_CASE("the joint law of the page carries a tunnel; without teeth it is CoulombJoint") {
    const CoulombJoint plain({5e9, 5e8, 35 * degree});
    auto rough = excavated<RoughTunnel>(PattonJoint({5e9, 5e8, 35 * degree, 10 * degree, 1e5}));
    CHECK(rough.equilibrium().verdict == Verdict::stable);

    // One point, pressed shut and slid far beyond its strength, then back.
    const PattonJoint smooth({5e9, 5e8, 35 * degree, 0, 0});
    PattonJoint::State<2> ours;
    CoulombJoint::State<2> theirs;
    for (const double slip : {1e-5, 2e-3, 1e-3, -1e-3}) {
      const PointLoad<2> load{0.4, {1e5, Vec<1>(2e4)}, {-1e-5, Vec<1>(slip)}};
      const PointForce<2> a = smooth.force(load, ours), b = plain.force(load, theirs);
      CHECK(a.normal == b.normal);
      CHECK(std::abs(a.tangential[0] - b.tangential[0]) <= 1e-12 * b.normal);
      smooth.commit(load, ours);
      plain.commit(load, theirs);
      CHECK(std::abs(smooth.force(load, ours).tangential[0] - a.tangential[0]) <= 1e-12 * b.normal);
    }
  }

  TEST_CASE("the bolt law of the page holds a tunnel, and slides at its grip") {
    const auto hold = [](double grip) {
      auto tunnel = excavated<BoltedTunnel>(CoulombJoint({5e9, 5e8, 35 * degree}));
      for (const auto& bar :
           bolt_bars({.length = 3, .angular_spacing = 22.5 * degree, .from = 0, .to = 180 * degree},
                     circular_opening(5, 36)))
        tunnel.install_bolt(bar, FrictionBolt({2e8, grip}));
      CHECK(tunnel.equilibrium().verdict != Verdict::undecided);
      const std::vector<double> forces = largest_bolt_forces(tunnel);
      for (const CrossingForce& c : bolt_forces(tunnel))
        CHECK(!c.yielded);  // its state says nothing
      return *std::max_element(forces.begin(), forces.end());
    };
    const double strong = hold(1e6);
    CHECK(strong > 1e3);
    CHECK(strong < 1e6);
    CHECK(hold(0.5 * strong) == 0.5 * strong);
  }
}

}  // namespace write_your_own_test
