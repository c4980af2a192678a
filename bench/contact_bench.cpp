// SPDX-License-Identifier: MIT
// The contact queries of one library under Google Benchmark:
//   contact_<library>_bench [--dir=FOLDER] [Google Benchmark's own options]
// The column Time is per candidate pair. FOLDER is what `contact_workloads` wrote.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include "contact_query.hpp"

namespace {

using namespace voussoir_bench;

/// Whole passes are timed and their time is divided by the pairs. Passes alternate between the two
/// steps, as in `time_passes`.
template <int Dim>
void run(benchmark::State& state, const Query& query, const Workload<Dim>& workload) {
  using Clock = std::chrono::steady_clock;
  const auto pairs = static_cast<double>(query.visited(workload.pairs.size()));
  benchmark::DoNotOptimize(query.pass(0, nullptr));
  std::vector<double> times;
  for (auto _ : state) {
    const int step = times.size() % 2 == 0 ? 1 : 0;
    const auto start = Clock::now();
    benchmark::DoNotOptimize(query.pass(step, nullptr));
    times.push_back(std::chrono::duration<double>(Clock::now() - start).count() / pairs);
    state.SetIterationTime(times.back());
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  const Accuracy accuracy = judge(answers_of(query, workload.pairs.size()), query, workload);
  state.counters["median_ns"] = 1e9 * *middle;
  state.counters["pairs"] = pairs;
  state.counters["wrong"] = static_cast<double>(accuracy.invented + accuracy.missed);
  state.counters["failed"] = static_cast<double>(accuracy.failed);
  if (accuracy.both_touch > 0) state.counters["depth_error"] = accuracy.depth_error_max;
}

template <int Dim>
void add(const std::string& folder, const std::string& name, std::list<Workload<Dim>>& kept) {
  if (!std::filesystem::exists(folder + "/" + name + ".pairs")) return;
  const Workload<Dim>& workload = kept.emplace_back(read_workload<Dim>(folder, name));
  for (const Query& query : queries(workload))
    benchmark::RegisterBenchmark(
        (query.label(name) + "/" + query.precision).c_str(),
        [query, &workload](benchmark::State& state) { run(state, query, workload); })
        ->UseManualTime()
        // 0.3 s of passes, in the unit of one pair.
        ->MinTime(0.3 / static_cast<double>(query.visited(workload.pairs.size())));
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::string folder = "contact_workloads.data";
  for (int k = 1; k < argc; ++k)
    if (const std::string option = argv[k]; option.rfind("--dir=", 0) == 0)
      folder = option.substr(6);
  std::list<Workload<2>> sections;
  std::list<Workload<3>> cubes;
  try {
    for (const char* name : {"W2", "W2deep"}) add(folder, name, sections);
    for (const char* name : {"W3", "W3deep"}) add(folder, name, cubes);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 1;
  }
  if (sections.empty() && cubes.empty()) {
    std::fprintf(stderr, "%s: no workloads in %s; run `contact_workloads %s` first\n", argv[0],
                 folder.c_str(), folder.c_str());
    return 1;
  }
  benchmark::AddCustomContext("library", build_description);
  benchmark::RunSpecifiedBenchmarks();
}
