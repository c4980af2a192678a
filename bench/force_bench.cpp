// SPDX-License-Identifier: MIT
// Forces of all contacts at rest by size, per contact: what every step of a search must cost at
// least. At small sizes arithmetic limits them, at large ones the bytes of a contact.
//   force_bench [--large] [Google Benchmark's flags]   --large: 860 000 blocks in 2-D, 86 000 in
//   3-D
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/model/contact_update.hpp>

#include "cavern_case.hpp"
#include "design_case.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;

/// A model, and a displacement of its bodies by which few of its points slip [m].
template <class Model>
struct Case {
  Model model;
  Eigen::VectorXd u;

  explicit Case(Model made) : model(std::move(made)), u(model.system().displacement.size()) {
    Random random(7);
    for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = 2e-6 * (random.uniform() - 0.5);
  }
};

/// The last that was asked for: the large ones do not fit into memory together.
template <class Model, class Make>
Case<Model>& case_of(int size, bool is_updated, Make&& make) {
  static std::pair<int, std::unique_ptr<Case<Model>>> last;
  const int key = is_updated ? -size : size;
  if (last.first != key) {
    if (last.first != size) last = {size, std::make_unique<Case<Model>>(make(size))};
    // Points get a height and a start of their own.
    if (is_updated) {
      auto& system = voussoir::detail::SystemOf::in(last.second->model);
      system.displacement = last.second->u;
      update_contacts(system, 1e-3);
      last.first = key;
    }
  }
  return *last.second;
}
Case<Tunnel>& planar(int width, bool is_updated) {
  return case_of<Tunnel>(width, is_updated, [](int of) { return excavated_square(of); });
}
Case<Cavern>& spatial(int spacing, bool is_updated) {
  return case_of<Cavern>(spacing, is_updated, [](int of) { return excavated_cavern(0.01 * of); });
}

template <class History, class Of>
void forces(benchmark::State& state, Of& of) {
  auto& joints = voussoir::detail::SystemOf::in(of.model).joints;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(of.u.size());
  for (auto _ : state) {
    joints.template add_forces<History>(of.u.data(), f.data());
    benchmark::DoNotOptimize(f.data());
    benchmark::ClobberMemory();
  }
  const auto contacts = static_cast<double>(joints.contacts().size());
  state.counters["contacts"] = contacts;
  state.counters["points"] = static_cast<double>(joints.points().size());
  state.counters["time_per_contact"] = benchmark::Counter(
      contacts, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// A fifth of the contacts, by number: what local searches ask for.
template <class Of>
void forces_of_some(benchmark::State& state, Of& of) {
  auto& joints = voussoir::detail::SystemOf::in(of.model).joints;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(of.u.size());
  std::vector<int> some;
  for (int k = 0; k < static_cast<int>(joints.contacts().size()); ++k)
    if (k / 50 % 5 == 0) some.push_back(k);
  for (auto _ : state) {
    joints.template add_forces<Frozen>(some, of.u.data(), f.data());
    benchmark::DoNotOptimize(f.data());
    benchmark::ClobberMemory();
  }
  state.counters["time_per_contact"] = benchmark::Counter(
      static_cast<double>(some.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Get>
void add_family(const std::string& space, const std::vector<int>& sizes, Get get) {
  for (const int size : sizes) {
    const auto add = [&](const char* name, bool is_updated, auto run) {
      benchmark::RegisterBenchmark(
          (space + "/" + name + "/" + std::to_string(size)).c_str(),
          [run, get, size, is_updated](benchmark::State& s) { run(s, get(size, is_updated)); })
          ->Unit(benchmark::kMicrosecond);
    };
    add("frozen", false, [](auto& s, auto& of) { forces<Frozen>(s, of); });
    add("committing", false, [](auto& s, auto& of) { forces<Committing>(s, of); });
    add("some", false, [](auto& s, auto& of) { forces_of_some(s, of); });
    add("updated", true, [](auto& s, auto& of) { forces<Frozen>(s, of); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool large = false;
  for (int k = 1; k < argc; ++k)
    if (std::strcmp(argv[k], "--large") == 0) {
      large = true;
      std::copy(argv + k + 1, argv + argc, argv + k);
      --argc, --k;
    }
  std::vector<int> widths{70, 150, 300}, spacings{200, 100, 69};
  if (large) {
    widths.push_back(858);
    spacings.push_back(45);
  }
  add_family("planar", widths, planar);
  add_family("spatial", spacings, spatial);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
