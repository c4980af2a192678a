// SPDX-License-Identifier: MIT
// A tunnel driven in 12 rounds through about 4 000 blocks in 3-D: round after round in one model,
// and by hand, a model made anew for every round. Elastic, and with joints that slip.
#include <benchmark/benchmark.h>

#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/isotropic_sets.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace {

using namespace voussoir;
using Tunnel = Solver<Spatial, MohrCoulombJoint>;

constexpr int round_count = 12;
constexpr double round_length = 2.5;  // [m]

const RockMass<Spatial>& rock() {
  static const RockMass<Spatial> made = [] {
    const Domain<3> ground{{-20, 0, -20}, {20, 40, 20}};
    return slice<Spatial>(ground, joint_network(isotropic_sets(5.4), ground, 1),
                          {.min_inscribed_radius = 0.3});
  }();
  return made;
}

PrismaticOpening drift(double from, double to) {
  return PrismaticOpening(circular_opening(10, 36), from, to);
}

/// @param strength  cohesion, and half of it as tensile strength [Pa]
Tunnel in_situ(double strength) {
  return {rock(),
          MohrCoulombJoint({.joint_normal_stiffness = 5e10,
                            .joint_shear_stiffness = 5e10 / 3,
                            .friction_angle = 0.6,
                            .cohesion = strength,
                            .tensile_strength = 0.5 * strength}),
          {.density = 2700, .surcharge = 5e6}};
}

void report_on(benchmark::State& state, const Tunnel& tunnel, int stable) {
  state.counters["bodies"] = static_cast<double>(tunnel.system().movable_bodies().size());
  state.counters["stable"] = stable;  // rounds
  state.counters["fallen"] = static_cast<double>(tunnel.fallen().size());
  state.counters["largest_mm"] =
      1e3 * tunnel.system().largest_translation(tunnel.system().displacement);
}

void in_rounds(benchmark::State& state, double strength) {
  for (auto _ : state) {
    Tunnel tunnel = in_situ(strength);
    int stable = 0;
    for (int k = 0; k < round_count; ++k) {
      tunnel.excavate(drift(k == 0 ? -1 : k * round_length, (k + 1) * round_length));
      if (tunnel.equilibrium().verdict == Verdict::stable) ++stable;
    }
    state.PauseTiming();
    report_on(state, tunnel, stable);
    state.ResumeTiming();
  }
}
BENCHMARK_CAPTURE(in_rounds, elastic, 1e9)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(in_rounds, slipping, 2e5)->Unit(benchmark::kMillisecond);

/// Each round is excavated with all before it from rock in its in-situ state: without history, so
/// only elastic rock has the same answer.
void by_hand(benchmark::State& state, double strength) {
  for (auto _ : state) {
    int stable = 0;
    for (int k = 0; k < round_count; ++k) {
      Tunnel tunnel = in_situ(strength);
      tunnel.excavate(drift(-1, (k + 1) * round_length));
      if (tunnel.equilibrium().verdict == Verdict::stable) ++stable;
      if (k + 1 < round_count) continue;
      state.PauseTiming();
      report_on(state, tunnel, stable);
      state.ResumeTiming();
    }
  }
}
BENCHMARK_CAPTURE(by_hand, elastic, 1e9)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(by_hand, slipping, 2e5)->Unit(benchmark::kMillisecond);

}  // namespace
