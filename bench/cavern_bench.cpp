// SPDX-License-Identifier: MIT
// A supported tunnel in 3-D, from the rock as it was sliced to its equilibrium: 4 m bolts, 0.15 m
// of shotcrete with ribs, blocks of about a metre. The floor beside it is the factor of its elastic
// stiffness alone: no search with an error estimate can do with less.
#include <benchmark/benchmark.h>

#include <numbers>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace {

using namespace voussoir;
using Cavern = Solver<Spatial, TimoshenkoBeam>;
constexpr double degree = std::numbers::pi / 180;

/// A 10 m tunnel, 12 m of it, under 20 m of rock; 36 k m3 around it.
Cavern supported(double spacing) {
  SpatialJointSet a{"J1", 75 * degree, 90 * degree}, b{"J2", 25 * degree, 90 * degree},
      c{"J3", 80 * degree, 5 * degree};
  for (SpatialJointSet* set : {&a, &b, &c}) {
    set->fisher_concentration = 2000;
    set->spacing = spacing;
  }
  const Domain<3> ground{{-16, 0, -14}, {16, 12, 20}};
  Cavern cavern(slice<Spatial>(ground, joint_network({a, b, c}, ground, 1),
                               {.min_inscribed_radius = 0.1 * spacing}),
                CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700, .surcharge = 1.3e5});
  cavern.excavate(PrismaticOpening(circular_opening(10, 36)), 0.05);
  for (const auto& bar : bolt_bars({.length = 4, .angular_spacing = 18 * degree},
                                   cavern.mass().openings.back(), 1.5, 0, 12))
    cavern.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8, .yield_force = 5e5}));
  cavern.install_lining(
      lining_frame(cavern.mass(), LiningRibs{.ring = {.nodes = 36}, .spacing = 1.5}),
      {LiningSection::strip(0.15, 1.5, 25e9), LiningSection::strip(0.15, 0.87, 25e9)},
      CoulombJoint({1e10, 1e10, 35 * degree}));
  return cavern;
}

/// Range: spacing of the joints [cm].
void equilibrium(benchmark::State& state) {
  const Cavern start = supported(0.01 * static_cast<double>(state.range(0)));
  EquilibriumReport report;
  for (auto _ : state) {
    state.PauseTiming();
    Cavern cavern = start;
    state.ResumeTiming();
    report = cavern.equilibrium();
  }
  if (report.verdict != Verdict::stable) state.SkipWithError("not stable");
  state.counters["bodies"] = start.system().body_count();
  state.counters["error_estimate"] = report.error_estimate;
  state.counters["fallen"] = static_cast<double>(report.fallen.size());
}
BENCHMARK(equilibrium)->Arg(200)->Arg(100)->Unit(benchmark::kSecond);

void factor(benchmark::State& state) {
  const auto matrix =
      supported(0.01 * static_cast<double>(state.range(0))).system().elastic_stiffness();
  for (auto _ : state) {
    const BlockCholesky<6> made(matrix);
    benchmark::DoNotOptimize(made.block_count());
  }
}
BENCHMARK(factor)->Arg(200)->Arg(100)->Unit(benchmark::kSecond);

}  // namespace
