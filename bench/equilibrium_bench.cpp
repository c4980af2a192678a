// SPDX-License-Identifier: MIT
// One supported tunnel to equilibrium, what it is made of, and its peers: one force evaluation is
// the floor, explicit time stepping the other method. What its elastic solves cost: elastic_bench.
#include <benchmark/benchmark.h>

#include <utility>
#include <vector>
#include <voussoir/equilibrium/explicit.hpp>

#include "design_case.hpp"

namespace {

using namespace voussoir_bench;
using voussoir::EquilibriumReport;
using voussoir::Explicit;

/// The excavated design case, made once for each scale of the width.
const Tunnel& unsupported(double scale) {
  static std::vector<std::pair<double, Tunnel>> made;
  for (const auto& [of, tunnel] : made)
    if (of == scale) return tunnel;
  return made.emplace_back(scale, excavated(scale)).second;
}

Tunnel design_case(double bolt_spacing, double thickness, double scale = 1) {
  Tunnel tunnel = unsupported(scale);
  support(tunnel, bolt_spacing * degree, thickness);
  return tunnel;
}

template <class T>
void report_on(benchmark::State& state, const T& tunnel, const EquilibriumReport& report) {
  state.counters["bodies"] = static_cast<double>(tunnel.system().movable_bodies().size());
  state.counters["contacts"] = static_cast<double>(tunnel.system().joints.contacts().size());
  state.counters["error_estimate"] = report.error_estimate;
  state.counters["unbalance_over_weight"] = report.unbalance_over_weight;
  state.counters["steps"] = report.steps;
  state.counters["solves"] = report.elastic_solves;
  state.counters["stable"] = report.verdict == voussoir::Verdict::stable;
  state.counters["fallen_m2"] = report.fallen_measure;
  state.counters["crown_mm"] = 1e3 * crown(tunnel);
}

template <class T>
void search(benchmark::State& state, const T& before) {
  T tunnel = before;
  EquilibriumReport report;
  for (auto _ : state) {
    state.PauseTiming();
    tunnel = before;
    state.ResumeTiming();
    report = equilibrium(tunnel);
  }
  report_on(state, tunnel, report);
}

/// From the excavated and supported, unmoved rock to the accepted equilibrium.
void two_level(benchmark::State& state, double bolt_spacing, double thickness, double scale) {
  search(state, design_case(bolt_spacing, thickness, scale));
}
/// The same by models that are known at run time, as an input file has them: beside the fixed
/// types, which are the floor.
void two_level_by_variants(benchmark::State& state, double bolt_spacing, double thickness) {
  static const AnyTunnel unsupported = excavated_of_variants();
  AnyTunnel before = unsupported;
  support(before, bolt_spacing * degree, thickness);
  search(state, before);
}
BENCHMARK_CAPTURE(two_level, bolts_4m_15deg, 15, 0, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_level, bolts_4m_15deg_lining_10cm, 15, 0.1, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_level_by_variants, bolts_4m_15deg_lining_10cm, 15, 0.1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_level, bolts_4m_18deg, 18, 0, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_level, bolts_4m_15deg_4_times_wider, 15, 0, 4)->Unit(benchmark::kMillisecond);

/// The same case and the same acceptance by local damping, 0.7, the wall traction taken away over
/// 2000 steps. The design case stands, so the areas of detached blocks are not needed.
void explicit_stepping(benchmark::State& state, double bolt_spacing, double thickness) {
  const Tunnel before = design_case(bolt_spacing, thickness);
  Tunnel tunnel = before;
  EquilibriumReport report;
  for (auto _ : state) {
    state.PauseTiming();
    tunnel = before;
    state.ResumeTiming();
    report = Explicit({.damping = 0.7, .ramp_steps = 2000, .max_steps = 60000})
                 .find(voussoir::detail::SystemOf::in(tunnel), voussoir::SearchContext{});
  }
  report_on(state, tunnel, report);
  // With the estimates, and the factors that these need.
  const double contacts = static_cast<double>(tunnel.system().joints.contacts().size());
  state.counters["time_per_contact_and_step"] =
      benchmark::Counter(contacts * report.steps, benchmark::Counter::kIsIterationInvariantRate |
                                                      benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(explicit_stepping, bolts_4m_15deg, 15, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(explicit_stepping, bolts_4m_15deg_lining_10cm, 15, 0.1)
    ->Unit(benchmark::kMillisecond);

/// Explicit steps alone, with contacts that stay as they are: forces, slip, damping and motion.
/// While the wall is being unloaded nothing is judged.
void explicit_steps(benchmark::State& state, double scale) {
  const Tunnel before = design_case(15, 0.1, scale);
  Tunnel tunnel = before;
  constexpr int steps = 10000;
  for (auto _ : state) {
    state.PauseTiming();
    tunnel = before;
    state.ResumeTiming();
    const auto report =
        Explicit({.damping = 0.7, .ramp_steps = steps, .max_steps = steps + 1})
            .find(voussoir::detail::SystemOf::in(tunnel), voussoir::SearchContext{});
    if (report.steps <= steps) state.SkipWithError("it ended before");
  }
  const double contacts = static_cast<double>(tunnel.system().joints.contacts().size());
  state.counters["contacts"] = contacts;
  state.counters["time_per_contact_and_step"] =
      benchmark::Counter(contacts * steps, benchmark::Counter::kIsIterationInvariantRate |
                                               benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(explicit_steps, 11k_contacts, 0.7)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(explicit_steps, 16k_contacts, 1)->Unit(benchmark::kMillisecond);

/// All forces once, at the equilibrium: what one step of any method must cost at least.
void force_evaluation(benchmark::State& state) {
  Tunnel tunnel = design_case(15, 0.1);
  equilibrium(tunnel);
  auto& system = voussoir::detail::SystemOf::in(tunnel);
  Eigen::VectorXd f;
  for (auto _ : state) {
    system.forces(system.displacement, f);
    benchmark::DoNotOptimize(f.data());
    benchmark::ClobberMemory();
  }
  state.counters["contacts"] = static_cast<double>(system.joints.contacts().size());
  state.counters["time_per_contact"] = benchmark::Counter(
      static_cast<double>(system.joints.contacts().size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(force_evaluation)->Unit(benchmark::kMicrosecond);

}  // namespace
