// SPDX-License-Identifier: MIT
// Rock slicing of reference masses A and B, and how its cost grows with the area.
#include <benchmark/benchmark.h>

#include <cmath>

#include "design_case.hpp"

namespace {

using namespace voussoir_bench;

/// Range: the area over 70 m x 60 m. Joints are drawn and blocks sliced in every iteration.
void slicing(benchmark::State& state, const Rock& rock) {
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
BENCHMARK_CAPTURE(slicing, mass_a, mass_a)
    ->Arg(1)
    ->Arg(4)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK_CAPTURE(slicing, mass_b, mass_b)
    ->Arg(1)
    ->Arg(4)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

}  // namespace
