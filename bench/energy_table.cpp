// SPDX-License-Identifier: MIT
// What energy a run makes, and what contact updates do: of loose blocks that nobody picked
// (tests/support/loose_blocks.hpp), or of stages in which rock fails (failure_cases.hpp).
// One line a case as CSV; counts at the end on the error stream.
//   energy_table [FIRST] [COUNT] [THREADS] [STEPS]      default: 0 1000 1 20000
//   energy_table stages [FIRST] [COUNT] [THREADS]       default: 0 200 1
//   energy_table flat [FIRST] [COUNT] [PERCENT]         default: 0 200 50
// The last drops one block flat, without any damping, with a step of so much of the stable one.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/memory.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>

#include "failure_cases.hpp"
#include "support/flat_drop.hpp"
#include "support/loose_blocks.hpp"

namespace {

using namespace voussoir;

struct Line {
  double made = 0, updates = 0, given = 0, seconds = 0, damping = 0, local = 0;
  std::string fault;
};

template <int Dim>
Line follow(int number, int steps) {
  Line line;
  const auto start = std::chrono::steady_clock::now();
  voussoir_test::LooseBlocks<Dim> blocks(number);
  line.damping = blocks.run().settings().viscous_damping;
  line.local = blocks.run().settings().local_damping;
  try {
    const auto account = blocks.advance(steps);
    line.made = account.made;
    line.updates = account.updates;
    line.given = account.given;
  } catch (const voussoir::NumericalFault& fault) {
    line.fault = fault.what();
  }
  line.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return line;
}

int argument(int argc, char** argv, int k, int otherwise) {
  if (k >= argc) return otherwise;
  int value = 0;
  std::from_chars(argv[k], argv[k] + std::strlen(argv[k]), value);
  return value;
}

int loose_blocks(int argc, char** argv) {
  const int first = argument(argc, argv, 1, 0), count = argument(argc, argv, 2, 1000),
            threads = argument(argc, argv, 3, 1), steps = argument(argc, argv, 4, 20000);
  std::mutex mutex;
  int faults = 0, above = 0;
  double given = 0;
  std::puts(
      "case,dim,blocks,dashpots,local,made_percent,updates_percent,seconds,fault,given_by_updates");
  parallel_for(static_cast<std::size_t>(count), static_cast<unsigned>(threads), [&](std::size_t k) {
    const int number = first + static_cast<int>(k), dim = 2 + number / 2 % 2;
    const Line line = dim == 2 ? follow<2>(number, steps) : follow<3>(number, steps);
    const std::lock_guard lock(mutex);
    faults += line.fault.empty() ? 0 : 1;
    above += line.made > 0.01 ? 1 : 0;
    given = std::max(given, line.given);
    std::printf("%d,%d,%d,%.2f,%.2f,%.3g,%.3g,%.1f,%s,%.2g\n", number, dim,
                number % 2 == 1 ? 48 : 1, line.damping, line.local, 100 * line.made,
                100 * line.updates, line.seconds, line.fault.c_str(), line.given);
    std::fflush(stdout);
  });
  std::fprintf(stderr,
               "%d cases: %d with a fault, %d above their start by 1 %%; updates gave %.2g of the "
               "work of gravity at most\n",
               count, faults, above, given);
  return 0;
}

/// See `voussoir_test::FlatDrop`, for 3 000 steps of half the stable one.
template <int Dim>
Line drop_flat(int number, double safety) {
  voussoir_test::FlatDrop<Dim> drop(number, safety);
  Line line;
  try {
    line.made = drop.most_above(static_cast<int>(std::lround(15 / safety)));
  } catch (const NumericalFault& fault) {
    line.fault = fault.what();
  }
  const EnergyBalance now = drop.run.energy();
  line.given = now.made_by_updates / drop.stake;
  line.updates = now.contact_updates / drop.stake;
  return line;
}

int flat(int argc, char** argv) {
  const int first = argument(argc, argv, 2, 0), count = argument(argc, argv, 3, 200);
  const double safety = 1e-2 * argument(argc, argv, 4, 50);
  int faults = 0, above = 0;
  double worst = 0, given = 0;
  std::puts("case,dim,made_percent,updates_percent,given_by_updates,fault");
  for (int number = first; number < first + count; ++number) {
    const int dim = 2 + number % 2;
    const Line line = dim == 2 ? drop_flat<2>(number, safety) : drop_flat<3>(number, safety);
    faults += line.fault.empty() ? 0 : 1;
    above += line.made > 0.01 ? 1 : 0;
    worst = std::max(worst, line.made);
    given = std::max(given, line.given);
    std::printf("%d,%d,%.3g,%.3g,%.2g,\"%s\"\n", number, dim, 100 * line.made, 100 * line.updates,
                line.given, line.fault.c_str());
  }
  std::fprintf(stderr,
               "%d drops: %d with a fault, %d above their start by 1 %%, the worst by %.3g %%; "
               "updates gave %.2g of it at most\n",
               count, faults, above, 100 * worst, given);
  return 0;
}

/// The stage in which a tunnel is excavated: the same in motion by every solution procedure.
EquilibriumReport stage_of(const voussoir_bench::FailureCase& from) {
  Solver<> tunnel(voussoir_bench::rock_of(from), CoulombJoint(from.joint), from.in_situ);
  tunnel.excavate(from.opening);
  std::vector<double> measures;
  for (const auto& body : tunnel.mass().bodies) measures.push_back(body.properties.measure);
  measures.resize(static_cast<std::size_t>(tunnel.system().body_count()), 0.0);
  SearchContext context;
  context.measures = &measures;
  context.gravity = tunnel.in_situ().gravity;
  context.acceptance.collapse_measure = collapse_measure_of(from.opening);
  return TwoLevel().find(detail::SystemOf::in(tunnel), context);
}

int stages(int argc, char** argv) {
  const int first = argument(argc, argv, 2, 0), count = argument(argc, argv, 3, 200),
            threads = argument(argc, argv, 4, 1);
  std::mutex mutex;
  int failing = 0;
  double most = 0;
  std::puts(
      "case,verdict,area_m2,gravity_J,loads_J,lost_by_updates_J,given_by_updates_J,given,"
      "updates_at_rest,change_at_rest_J,made_at_rest_J,largest_jump_at_rest");
  parallel_for(static_cast<std::size_t>(count), static_cast<unsigned>(threads), [&](std::size_t k) {
    const auto from = voussoir_bench::failure_case(first + static_cast<int>(k));
    const EquilibriumReport report = stage_of(from);
    const EnergyBalance& motion = report.motion;
    const std::lock_guard lock(mutex);
    if (motion.scale() == 0) return;  // nothing fails
    const double given = (motion.made_by_updates + report.contact_updates.made) /
                         (std::abs(motion.gravity) + std::abs(motion.loads));
    ++failing;
    most = std::max(most, given);
    std::printf("%d,%s,%.4g,%.3g,%.3g,%.3g,%.3g,%.2g,%d,%.3g,%.3g,%.3g\n", from.number,
                to_string(report), report.fallen_measure, motion.gravity, motion.loads,
                -motion.contact_updates, motion.made_by_updates, given,
                report.contact_updates.count, report.contact_updates.energy,
                report.contact_updates.made, report.contact_updates.largest_jump);
    std::fflush(stdout);
  });
  std::fprintf(stderr,
               "%d cases: %d stages in motion; updates gave %.2g of the work of gravity and loads "
               "at most\n",
               count, failing, most);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  const auto is_asked = [&](const char* what) {
    return argc > 1 && std::strcmp(argv[1], what) == 0;
  };
  if (is_asked("stages")) return stages(argc, argv);
  return is_asked("flat") ? flat(argc, argv) : loose_blocks(argc, argv);
}
