// SPDX-License-Identifier: MIT
// The 6 x 6 interaction diagram of the design case: 36 supported tunnels in the same rock.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <voussoir/tunnel/interaction_diagram.hpp>

#include "design_case.hpp"

namespace {

using namespace voussoir_bench;
using voussoir::DiagramPoint;

constexpr std::array<double, 6> spacings{9, 11.25, 15, 18, 22.5, 0};        // [deg]; 0: no bolts
constexpr std::array<double, 6> thicknesses{0, 0.05, 0.1, 0.15, 0.2, 0.3};  // [m]; 0: no lining

/// Range: threads. The rock is generated beforehand, as for all diagrams of one realisation.
void diagram(benchmark::State& state) {
  const Tunnel before = excavated();
  std::vector<DiagramPoint> points;
  for (auto _ : state)
    points = voussoir::interaction_diagram(spacings.size(), thicknesses.size(),
                                           static_cast<unsigned>(state.range(0)),
                                           [&](std::size_t i, std::size_t j) {
                                             Tunnel tunnel = before;
                                             support(tunnel, spacings[i] * degree, thicknesses[j]);
                                             DiagramPoint point{};
                                             point.report = equilibrium(tunnel);
                                             point.crown_convergence = crown(tunnel);
                                             return point;
                                           });
  double worst_estimate = 0;
  std::size_t failed = 0, undecided = 0;
  int steps = 0;
  for (const DiagramPoint& point : points) {
    failed += point.failed();
    undecided += point.report.verdict == voussoir::Verdict::undecided;
    steps += point.report.steps;
    if (point.report.verdict == voussoir::Verdict::stable)
      worst_estimate = std::max(worst_estimate, point.report.error_estimate);
  }
  state.counters["bodies"] = static_cast<double>(before.mass().bodies.size());
  state.counters["failed"] = static_cast<double>(failed);  // rock detached: not a design
  state.counters["undecided"] = static_cast<double>(undecided);
  state.counters["worst_estimate"] = worst_estimate;
  state.counters["steps"] = steps;
  state.counters["crown_mm_15deg_10cm"] =
      1e3 * points[2 * thicknesses.size() + 2].crown_convergence;
}
BENCHMARK(diagram)->Arg(1)->Arg(2)->UseRealTime()->MeasureProcessCPUTime()->Unit(
    benchmark::kSecond);

}  // namespace
