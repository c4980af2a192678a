// SPDX-License-Identifier: MIT
// One bolted tunnel, every way to its equilibrium: a 5 m opening under 10 m of cover in 35 m x 30 m
// of rock like reference mass A, 1420 blocks, seed 2. Differences are relative L2 norms over the
// displacements of all blocks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>
#include <voussoir/solver/explicit.hpp>
#include <voussoir/solver/relaxation.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/solver/two_level.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

/// The tunnel, excavated and bolted, not yet relaxed.
const Solver<>& bolted_tunnel() {
  static const Solver<> tunnel = [] {
    const auto opening = circular_opening(5, 36);
    Solver<> made(jointed_rock(domain_around(opening, 35, 10, 15), 2),
                  CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700});
    made.excavate(opening);
    for (const auto& bar : bolt_bars({.length = 3,
                           .angular_spacing = 22.5 * degree,
                           .from = -22.5 * degree,
                           .to = 202.5 * degree},
                                     opening))
      made.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8}));
    return made;
  }();
  return tunnel;
}

/// The answer to compare with: the default method, a thousand times tighter than usual.
const Solver<>& exact_tunnel() {
  static const Solver<> tunnel = [] {
    Solver<> made = bolted_tunnel();
    const EquilibriumReport report =
        made.equilibrium(0, {}, {.error_estimate = 1e-7, .unbalance_over_weight = 1e-5});
    REQUIRE(report.verdict == Verdict::stable);
    REQUIRE(report.fallen.empty());
    return made;
  }();
  return tunnel;
}

Eigen::VectorXd translations(const Solver<>& tunnel) {
  Eigen::VectorXd u = tunnel.system().displacement;
  for (Eigen::Index k = 2; k < u.size(); k += 3) u[k] = 0;
  return u;
}

/// Relative L2 distance from the exact displacements.
double error_of(const Solver<>& tunnel) {
  const Eigen::VectorXd exact = translations(exact_tunnel());
  return (translations(tunnel) - exact).norm() / exact.norm();
}
double crown_ratio(const Solver<>& tunnel) {
  return convergence(tunnel).crown / convergence(exact_tunnel()).crown;
}

/// Another method than the solver's own, on its system.
template <class Method>
EquilibriumReport find(Solver<>& tunnel, const Method& method, double wall_fraction = 0) {
  std::vector<double> measures;
  for (const auto& body : tunnel.mass().bodies) measures.push_back(body.properties.measure);
  measures.resize(static_cast<std::size_t>(tunnel.system().body_count()), 0.0);
  SearchContext context;
  context.measures = &measures;
  context.wall_fraction = wall_fraction;
  return method.find(tunnel.system(), context);
}

Explicit explicit_run(double damping, int ramp_steps) {
  Explicit::Params params;
  params.damping = damping;
  params.ramp_steps = ramp_steps;
  return Explicit(params);
}

}  // namespace

TEST_SUITE("solver/equilibrium_methods") {
  TEST_CASE("two-level search at its default settings") {
    Solver<> tunnel = bolted_tunnel();
    const EquilibriumReport report = tunnel.equilibrium();
    CHECK(report.verdict == Verdict::stable);
    CHECK(error_of(tunnel) <= 0.001);  // measured 0.007 %
  }

  TEST_CASE("ten increments with a commit after each agree with one") {
    Solver<> tunnel = bolted_tunnel();
    EquilibriumReport report;
    for (int k = 9; k >= 0; --k) report = tunnel.equilibrium(0.1 * k);
    CHECK(report.verdict == Verdict::stable);
    CHECK(error_of(tunnel) <= 0.005);  // measured 0.005 %; seeds 1 and 3: 0.04, 0.01 %
  }

  TEST_CASE("a long explicit ramp agrees, by the whole field and at the crown") {
    Solver<> tunnel = bolted_tunnel();
    const EquilibriumReport report = find(tunnel, explicit_run(0.7, 8000));
    CHECK(report.verdict == Verdict::stable);
    CHECK(error_of(tunnel) <= 0.005);  // measured 0.18 %; seeds 1 and 3: 0.40, 0.64 %
    CHECK(std::abs(crown_ratio(tunnel) - 1) <= 0.002);  // measured 0.08 %
  }

  TEST_CASE("sudden excavation overshoots, the more the less it is damped") {
    // Slip made on the way out stays. Measured crown: ramp over 2000 steps +0.1 %, sudden with
    // local damping 0.7, 0.3, 0.1: +11, +35, +54 %.
    std::vector<double> crown;
    Solver<> ramped = bolted_tunnel();
    (void)find(ramped, explicit_run(0.7, 2000));
    crown.push_back(crown_ratio(ramped));
    for (const double damping : {0.7, 0.3, 0.1}) {
      Solver<> sudden = bolted_tunnel();
      const EquilibriumReport report = find(sudden, explicit_run(damping, 0));
      CHECK(report.verdict == Verdict::stable);  // with as good an unbalance as anybody's
      CHECK(report.unbalance_over_weight < 1e-2);
      crown.push_back(crown_ratio(sudden));
    }
    CHECK(std::abs(crown[0] - 1) <= 0.01);
    CHECK(crown[1] > 1.05);
    CHECK(crown[2] > crown[1] + 0.05);
    CHECK(crown[3] > crown[2] + 0.05);
  }

  TEST_CASE("a committing relaxation overshoots as a sudden excavation does") {
    // It commits slip on the way; hence it only finds out what falls. Measured crown: +13 %.
    Solver<> tunnel = bolted_tunnel();
    const EquilibriumReport report = find(tunnel, Relaxation{});
    CHECK(report.verdict == Verdict::stable);
    CHECK(crown_ratio(tunnel) > 1.02);
    CHECK(crown_ratio(tunnel) < 1.3);
  }

  TEST_CASE("a committing relaxation agrees if the wall is unloaded in small steps") {
    Solver<> tunnel = bolted_tunnel();
    for (int k = 19; k >= 0; --k) (void)find(tunnel, Relaxation{}, k / 20.0);
    CHECK(error_of(tunnel) <= 0.005);                   // measured 0.35 %; in 40 steps 0.30 %
    CHECK(std::abs(crown_ratio(tunnel) - 1) <= 0.005);  // measured 0.17 %
  }

  TEST_CASE("the error estimate tells the true error within a factor of two") {
    for (const int burst_steps : {60, 120})
      for (const double unbalance : {1e-2, 1e-3}) {
        CAPTURE(burst_steps);
        CAPTURE(unbalance);
        Solver<> tunnel = bolted_tunnel();
        TwoLevel::Params params;
        params.burst_steps = burst_steps;
        const EquilibriumReport report =
            tunnel.equilibrium(0, TwoLevel(params), {.unbalance_over_weight = unbalance});
        REQUIRE(report.verdict == Verdict::stable);
        const Eigen::VectorXd miss = translations(tunnel) - translations(exact_tunnel());
        const double truth = System<Planar, CoulombJoint, AxialBolt>::largest_translation(miss) /
                             report.largest_displacement;
        CAPTURE(truth);
        CAPTURE(report.error_estimate);
        // Measured: 1.12 to 1.13 of estimates between 4e-6 and 4e-5.
        CHECK(truth <= 2 * report.error_estimate);
        CHECK(truth >= 0.5 * report.error_estimate);
      }
  }
}
