// SPDX-License-Identifier: MIT
// The pull-out curve of a bonded bar: hand values of a strand, and its equation integrated.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <voussoir/theory/pull_out.hpp>

#include "support/near.hpp"

namespace pull_out_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

/// A strand of 15.2 mm: 181 mm2, 98.6 GPa, 112 MN/m/m, 0.175 MN/m.
BondedBar strand(double length) { return {181e-6 * 98.6e9, 112e6, 0.175e6, length}; }

/// E A u'' = min(k_b u, s_b) from the far end, moved by `slip` and pulled there by `force`, to the
/// pulled end, by Runge-Kutta: the state there.
PullOutPoint integrated(const BondedBar& bar, double slip, double force) {
  constexpr int steps = 20000;
  const double h = bar.length / steps;
  const auto bond = [&](double u) { return std::min(bar.bond_stiffness * u, bar.bond_strength); };
  double u = slip, n = force;
  for (int k = 0; k < steps; ++k) {
    const double ea = bar.axial_stiffness;
    const double u1 = n / ea, n1 = bond(u);
    const double u2 = (n + 0.5 * h * n1) / ea, n2 = bond(u + 0.5 * h * u1);
    const double u3 = (n + 0.5 * h * n2) / ea, n3 = bond(u + 0.5 * h * u2);
    const double u4 = (n + h * n3) / ea, n4 = bond(u + h * u3);
    u += h * (u1 + 2 * u2 + 2 * u3 + u4) / 6;
    n += h * (n1 + 2 * n2 + 2 * n3 + n4) / 6;
  }
  return {u, n, 0};
}

}  // namespace

TEST_SUITE("theory/pull_out") {
  TEST_CASE("a strand in a long hole: 44.7 MN/m, and it slips first at 1.56 mm and 69.9 kN") {
    // sqrt(112 x 17.8466) = 44.708; 0.175 / 112 = 1.5625 mm; their product 69.86 kN.
    const PullOut test(strand(10));
    CHECK(test.head_stiffness() == near(std::sqrt(112e6 * 17.8466e6)).epsilon(1e-12));
    CHECK(std::abs(test.head_stiffness() - 44.7e6) < 0.05e6);
    CHECK(std::abs(test.first_slip().displacement - 1.5625e-3) < 1e-9);
    CHECK(std::abs(test.first_slip().force - 69.9e3) < 0.05e3);
    CHECK(test.last().force == near(0.175e6 * 10).epsilon(1e-12));
    // All slipped: u_s + s L^2 / 2 E A = 1.5625 mm + 0.175 x 100 / (2 x 17.8466) m.
    CHECK(test.last().displacement == near(1.5625e-3 + 0.175 * 100 / (2 * 17.8466)).epsilon(1e-12));
  }

  TEST_CASE("the curve is that of the equation, integrated from the far end") {
    // Of the step in which bond yields the integration keeps its square: 1e-8.
    for (const double length : {0.25, 1.0, 3.0})
      for (const double plate : {0.0, 20e3, 150e3}) {
        BondedBar bar = strand(length);
        bar.end_strength = plate;
        const PullOut test(bar);
        CAPTURE(length);
        CAPTURE(plate);
        const auto check = [&](double slip, double force) {
          const PullOutPoint exact = integrated(bar, slip, force);
          if (exact.force > test.last().force * (1 - 1e-9)) return;  // all of it has slipped
          CHECK(test.at_displacement(exact.displacement).force == near(exact.force).epsilon(1e-6));
          CHECK(test.at_force(exact.force).displacement == near(exact.displacement).epsilon(1e-6));
        };
        for (const double part : {1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6, 0.9, 0.999}) {
          if (plate > 0) check(0, part * plate);  // which does not give
          check(part * 1.5625e-3, plate);         // free, or given
        }
      }
  }

  TEST_CASE("elastic to the first slip, then softer and softer, and never weaker") {
    for (const double plate : {0.0, 40e3}) {
      BondedBar bar = strand(2);
      bar.end_strength = plate;
      const PullOut test(bar);
      const PullOutPoint first = test.first_slip(), last = test.last();
      CHECK(first.slipped == 0);
      CHECK(test.at_displacement(0.3 * first.displacement).force <=
            near(0.3 * first.displacement * test.head_stiffness()).epsilon(1e-12));
      double before = test.head_stiffness() * (1 + 1e-9);
      PullOutPoint from{0, 0, 0};
      for (int k = 0; k <= 100; ++k) {
        const PullOutPoint to = test.at_slipped(0.02 * k);
        const double slope = (to.force - from.force) / (to.displacement - from.displacement);
        CHECK(slope >= 0);
        CHECK(slope <= before * (1 + 1e-9));
        before = slope;
        from = to;
      }
      CHECK(test.at_displacement(2 * last.displacement).force == last.force);
      CHECK(last.force == near(0.175e6 * 2 + plate).epsilon(1e-12));
      // Force is flat there, with the cube of the rest: a third of its digits tell the slip.
      CHECK(test.at_force(last.force).slipped == near(2).epsilon(1e-4));
    }
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan}) {
      CHECK_THROWS_AS(PullOut({bad, 1, 1, 1}), InvalidInput);
      CHECK_THROWS_AS(PullOut({1, bad, 1, 1}), InvalidInput);
      CHECK_THROWS_AS(PullOut({1, 1, bad, 1}), InvalidInput);
      CHECK_THROWS_AS(PullOut({1, 1, 1, bad}), InvalidInput);
    }
    CHECK_THROWS_AS(PullOut({1, 1, 1, 1, -1}), InvalidInput);
    const PullOut test(strand(1));
    CHECK_THROWS_AS(test.at_force(176e3), InvalidInput);  // bond bears 175 kN
    CHECK_THROWS_AS(test.at_force(nan), InvalidInput);
    CHECK_THROWS_AS(test.at_displacement(-1e-3), InvalidInput);
    CHECK_THROWS_AS(test.at_slipped(1.1), InvalidInput);
  }
}

}  // namespace pull_out_test
