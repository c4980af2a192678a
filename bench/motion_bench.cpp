// SPDX-License-Identifier: MIT
// A step of moving blocks. The floor beside it is one evaluation of the contact forces of the same
// rock with fixed contacts and small displacements; the peer is the paper's code, 109 to 131
// microseconds per contact and step (Boon et al. 2015: 642 ms for 5 894 contacts on one thread).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>
#include <utility>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "design_case.hpp"

namespace {

using namespace voussoir_bench;
using namespace voussoir;

const CoulombJoint joint({5e9, 5e8, 35 * degree});

/// Contacts that touch: places are kept for a while for those that no longer do.
template <class Group>
std::size_t touching(const Group& joints) {
  return static_cast<std::size_t>(std::count_if(joints.contacts().begin(), joints.contacts().end(),
                                                [](const auto& c) { return c.first < c.last; }));
}

void report(benchmark::State& state, std::size_t contacts, int steps) {
  state.counters["contacts"] = static_cast<double>(contacts);
  // Shown in nanoseconds: seconds per (steps x contacts).
  state.counters["per_contact_and_step"] = benchmark::Counter(
      static_cast<double>(contacts) * steps,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The design case, excavated at once and falling; `found`: contacts are updated.
void plane(benchmark::State& state, bool found) {
  auto mass = carve(generate(voussoir::paper::mass_a), circular_opening(10), 0.074);
  auto run = moving_rock(mass, joint, InSitu{.density = 2700},
                         {.local_damping = 0.3,
                          .find_contacts = found,
                          .threads = static_cast<unsigned>(state.range(0))});
  run.set_held(0);
  run.advance_steps(3000);  // the first blocks are on their way
  constexpr int steps = 200;
  for (auto _ : state) run.advance_steps(steps);
  report(state, touching(run.joints()), steps);
}

void space(benchmark::State& state) {
  SpatialJointSet a{"J1", 75 * degree, 80 * degree}, b{"J2", 25 * degree, 100 * degree},
      c{"J3", 80 * degree, 5 * degree};
  for (SpatialJointSet* set : {&a, &b, &c}) {
    set->fisher_concentration = 1000;
    set->spacing = 1.6;
  }
  const Domain<3> ground{{-14, 0, -14}, {14, 12, 14}};
  auto mass = carve(
      slice<Spatial>(ground, joint_network({a, b, c}, ground, 1), {.min_inscribed_radius = 0.2}),
      PrismaticOpening(circular_opening(10, 36)), 0.05);
  auto run = moving_rock(mass, joint, InSitu{.density = 2700, .surcharge = 4e5},
                         {.local_damping = 0.3, .threads = static_cast<unsigned>(state.range(0))});
  run.set_held(0);
  run.advance_steps(1500);
  constexpr int steps = 50;
  for (auto _ : state) run.advance_steps(steps);
  report(state, touching(run.joints()), steps);
}

/// The floor: forces of the same joints, history brought up to date, nothing moves.
void forces(benchmark::State& state) {
  Tunnel tunnel = excavated();
  auto& system = voussoir::detail::SystemOf::in(tunnel);
  Eigen::VectorXd f;
  for (auto _ : state) {
    system.forces<Committing>(system.displacement, f);
    benchmark::DoNotOptimize(f.data());
  }
  report(state, system.joints.contacts().size(), 1);
}

}  // namespace

BENCHMARK(forces)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(plane, fixed, false)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(plane, moving, true)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(space)->Arg(1)->Arg(2)->UseRealTime();
