// SPDX-License-Identifier: MIT
// Rock slicing of reference masses A and B, and how its cost grows with the area; the same in 3-D
// with the volume, and what the contacts from shared cuts cost.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "design_case.hpp"

namespace {

using namespace voussoir_bench;

/// Range: the area over 70 m x 60 m. Joints are drawn and blocks sliced in every iteration.
void slicing(benchmark::State& state, const voussoir::paper::RockReading& rock) {
  const double scale = std::sqrt(static_cast<double>(state.range(0)));
  std::size_t blocks = 0;
  for (auto _ : state) {
    const auto mass = generate(rock, scale);
    blocks = mass.bodies.size();
    benchmark::DoNotOptimize(mass.bodies.data());
  }
  const auto count = static_cast<double>(blocks);
  state.counters["blocks"] = count;
  state.counters["blocks_per_second"] =
      benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
  state.SetComplexityN(static_cast<benchmark::IterationCount>(blocks));
}
BENCHMARK_CAPTURE(slicing, mass_a, voussoir::paper::mass_a)
    ->Arg(1)
    ->Arg(4)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK_CAPTURE(slicing, mass_b, voussoir::paper::mass_b)
    ->Arg(1)
    ->Arg(4)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

// ---- in 3-D ----------------------------------------------------------------------------------

/// Sets 75/010, 25/130 and 60/250 with a standard deviation of 1 degree, 1 m apart.
std::vector<voussoir::SpatialJointSet> three_sets(voussoir::JointShape shape) {
  constexpr double degree = std::numbers::pi / 180;
  std::vector<voussoir::SpatialJointSet> sets = {{"J1", 75 * degree, 10 * degree},
                                                 {"J2", 25 * degree, 130 * degree},
                                                 {"J3", 60 * degree, 250 * degree}};
  for (voussoir::SpatialJointSet& set : sets) {
    set.dip_deviation = set.dip_direction_deviation = 1 * degree;
    set.spacing = 1;
    set.shape = shape;
  }
  return sets;
}

voussoir::RockMass<voussoir::Spatial> cube(double side, voussoir::JointShape shape,
                                           const voussoir::BlockLimits& limits) {
  const voussoir::Vec3 half = voussoir::Vec3::Constant(0.5 * side);
  const voussoir::Domain<3> ground{-half, half};
  return voussoir::slice<voussoir::Spatial>(
      ground, voussoir::joint_network(three_sets(shape), ground, 1), limits);
}

void count_blocks(benchmark::State& state, std::size_t blocks) {
  const auto count = static_cast<double>(blocks);
  state.counters["blocks"] = count;
  state.counters["s_per_block"] = benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<benchmark::IterationCount>(blocks));
}

/// Range: the side of the cube [m]. Joints are drawn and blocks sliced in every iteration.
void slicing_in_space(benchmark::State& state, voussoir::JointShape shape,
                      const voussoir::BlockLimits& limits) {
  std::size_t blocks = 0;
  for (auto _ : state) {
    const auto mass = cube(static_cast<double>(state.range(0)), shape, limits);
    blocks = mass.bodies.size();
    benchmark::DoNotOptimize(mass.bodies.data());
  }
  count_blocks(state, blocks);
}
const voussoir::BlockLimits no_limits, usual_limits{0.1, 10};
// Sides for 1e3, 8e3, 3e4 and 1e5 blocks.
#define VOUSSOIR_SIDES ->Arg(9)->Arg(20)->Arg(30)->Arg(46)->Unit(benchmark::kMillisecond)
BENCHMARK_CAPTURE(slicing_in_space, persistent, voussoir::PersistentJoints{}, no_limits)
VOUSSOIR_SIDES->Complexity(benchmark::oN);
BENCHMARK_CAPTURE(slicing_in_space, persistent_limits, voussoir::PersistentJoints{}, usual_limits)
VOUSSOIR_SIDES->Complexity(benchmark::oN);
BENCHMARK_CAPTURE(slicing_in_space, discs_8m_limits, voussoir::DiscJoints{8}, usual_limits)
VOUSSOIR_SIDES->Complexity(benchmark::oN);

/// Range as above: the contacts of the sliced cube from its shared cuts.
void contacts_from_cuts(benchmark::State& state) {
  const auto mass =
      cube(static_cast<double>(state.range(0)), voussoir::PersistentJoints{}, no_limits);
  std::size_t contacts = 0;
  for (auto _ : state) {
    const auto found = voussoir::CutContacts::find(mass);
    contacts = found.size();
    benchmark::DoNotOptimize(found.data());
  }
  state.counters["contacts"] = static_cast<double>(contacts);
  count_blocks(state, mass.bodies.size());
}
BENCHMARK(contacts_from_cuts) VOUSSOIR_SIDES->Complexity(benchmark::oN);
#undef VOUSSOIR_SIDES

}  // namespace
