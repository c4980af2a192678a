// SPDX-License-Identifier: MIT
// Unsupported tunnels that nobody picked (failure_cases.hpp), by every solution procedure and by
// the reference: all blocks in motion as inert as they are, the wall unloaded slowly, what has
// moved beyond the displacement limit taken out; once more with half the step and half the rate.
// One line a case as CSV; counts at the end on the error stream.
//   failure_table [FIRST] [COUNT] [THREADS] [REFERENCES]      default: 0 200 1 2; hours
// With 1 reference the finer one is left out, with 0 both: minutes.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/memory.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>

#include "failure_cases.hpp"
#include "whole_number.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;

using Tunnel = Solver<>;

struct Answer {
  std::string verdict;
  double fallen = 0;  ///< [m^2]
  int count = 0;      ///< blocks
  double seconds = 0;
};

/// What a procedure says, as one word; a fault of the run is an answer, too.
template <class Run>
Answer timed(Run&& run) {
  const auto start = std::chrono::steady_clock::now();
  Answer answer;
  try {
    run(answer);
  } catch (const NumericalFault& fault) {
    answer.verdict = "fault";
    std::fprintf(stderr, "%s\n", fault.what());
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

struct Limits {
  double detached;  ///< a block that moved further has come off [m]
  double collapse;  ///< [m^2]
};

/// How the reference is carried out.
struct Unloading {
  double duration = 1;  ///< of taking away all of the wall traction [s]
  double safety = 0.5;  ///< of the stable step
};

constexpr double damping = 0.7;
constexpr double patience = 2;  ///< at rest: nothing would come off within so long [s]
constexpr double longest = 30;  ///< after which no end is expected [s]
constexpr int check_every = 50;

/// Takes out the blocks that have come off.
template <class Run>
void take_out(Run& run, const Tunnel& tunnel, double limit, Answer& answer) {
  for (int b = 0; b < run.body_count(); ++b) {
    if (!run.body(b).movable()) continue;
    if ((run.position(b) - tunnel.system().body(b).centre).norm() <= limit) continue;
    run.remove(b);
    ++answer.count;
    answer.fallen += tunnel.mass().bodies[static_cast<std::size_t>(b)].properties.measure;
  }
}

template <class Run>
bool rests(Run& run, double limit) {
  if (run.unbalance_over_weight() >= 1e-2) return false;
  for (int b = 0; b < run.body_count(); ++b)
    if (run.body(b).movable() && run.velocity(b).norm() * patience > limit) return false;
  return true;
}

void simulate(const Tunnel& tunnel, const Limits& limits, const Unloading& unloading,
              Answer& answer) {
  auto run = set_in_motion(tunnel, {.local_damping = damping, .safety = unloading.safety});
  while (run.time() < longest) {
    const double done = std::min(run.time() / unloading.duration, 1.0);
    run.set_held(1 - done);
    run.advance_steps(check_every);
    take_out(run, tunnel, limits.detached, answer);
    if (answer.fallen > limits.collapse) {
      answer.verdict = "collapse";
      return;
    }
    if (done < 1 || !rests(run, limits.detached)) continue;
    answer.verdict = answer.count > 0 ? "rockfall" : "stable";
    return;
  }
  answer.verdict = "undecided";
}

/// @param limits  `detached` is set: as chosen by the rock
template <class Method>
void search(Tunnel tunnel, Limits& limits, Answer& answer) {
  std::vector<double> measures;
  for (const auto& body : tunnel.mass().bodies) measures.push_back(body.properties.measure);
  measures.resize(static_cast<std::size_t>(tunnel.system().body_count()), 0.0);
  SearchContext context;
  context.measures = &measures;
  context.gravity = tunnel.in_situ().gravity;
  context.acceptance.collapse_measure = limits.collapse;
  const EquilibriumReport report = Method().find(detail::SystemOf::in(tunnel), context);
  limits.detached = report.displacement_limit;
  answer.fallen = report.fallen_measure;
  answer.count = static_cast<int>(report.fallen.size());
  answer.verdict = report.verdict == Verdict::collapse    ? "collapse"
                   : report.verdict == Verdict::undecided ? "undecided"
                   : answer.count > 0                     ? "rockfall"
                                                          : "stable";
}

constexpr const char* names[] = {"two_level", "relaxation", "explicit", "reference", "finer"};
constexpr std::size_t reference = 3;

std::vector<Answer> answers_of(const FailureCase& from, int references, std::size_t& blocks) {
  Tunnel tunnel(rock_of(from), CoulombJoint(from.joint), from.in_situ);
  blocks = tunnel.mass().bodies.size();
  Limits limits{0, collapse_measure_of(from.opening)};
  tunnel.excavate(from.opening);
  std::vector<Answer> answers(std::size(names), Answer{"-"});
  answers[0] = timed([&](Answer& a) { search<TwoLevel>(tunnel, limits, a); });
  answers[1] = timed([&](Answer& a) { search<Relaxation>(tunnel, limits, a); });
  answers[2] = timed([&](Answer& a) { search<Explicit>(tunnel, limits, a); });
  if (references > 0)
    answers[reference] = timed([&](Answer& a) { simulate(tunnel, limits, {1, 0.5}, a); });
  if (references > 1)
    answers[reference + 1] = timed([&](Answer& a) { simulate(tunnel, limits, {2, 0.25}, a); });
  return answers;
}

void print_head() {
  std::printf("case,shape,span_m,cover_m,k0,sets,spacing_m,persistent,friction_deg,blocks");
  for (const char* name : names) std::printf(",%s,%s_m2,%s_blocks,%s_s", name, name, name, name);
  std::printf("\n");
}

void print(const FailureCase& from, std::size_t blocks, const std::vector<Answer>& answers) {
  std::printf("%d,%s,%.2f,%.1f,%.2f,%zu,%.2f,%d,%.1f,%zu", from.number, from.shape.c_str(),
              from.span, from.cover, from.k0, from.sets.size(), from.spacing, from.persistent,
              from.joint.friction_angle * 180 / std::numbers::pi, blocks);
  for (const Answer& a : answers)
    std::printf(",%s,%.4g,%d,%.3g", a.verdict.c_str(), a.fallen, a.count, a.seconds);
  std::printf("\n");
  std::fflush(stdout);
}

/// How many cases have the verdict of the reference, by procedure.
void print_counts(const std::vector<std::vector<Answer>>& all) {
  for (std::size_t m = 0; m < std::size(names); ++m) {
    const auto count = [&](auto&& test) { return std::count_if(all.begin(), all.end(), test); };
    const auto says = [&](const char* word) {
      return count([&](const auto& a) { return a[m].verdict == word; });
    };
    std::fprintf(stderr,
                 "%-10s stable %3td, rockfall %3td, collapse %3td, undecided %3td, fault %3td; "
                 "verdict of the reference: %3td of %zu\n",
                 names[m], says("stable"), says("rockfall"), says("collapse"), says("undecided"),
                 says("fault"),
                 count([&](const auto& a) { return a[m].verdict == a[reference].verdict; }),
                 all.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  const int first = argc > 1 ? number_of(argv[1]) : 0;
  const int count = argc > 2 ? number_of(argv[2]) : 200;
  const int threads = argc > 3 ? number_of(argv[3]) : 1;
  const int references = argc > 4 ? number_of(argv[4]) : 2;
  if (argc > 5 || first < 0 || count < 1 || threads < 1 || references < 0 || references > 2) {
    std::fprintf(
        stderr,
        "usage: failure_table [FIRST >= 0] [COUNT >= 1] [THREADS >= 1] [REFERENCES 0 to 2]\n");
    return 2;
  }
  print_head();
  std::vector<std::vector<Answer>> all(static_cast<std::size_t>(count));
  std::mutex guard;
  parallel_for(all.size(), static_cast<unsigned>(threads), [&](std::size_t k) {
    const FailureCase from = failure_case(first + static_cast<int>(k));
    std::size_t blocks = 0;
    all[k] = answers_of(from, references, blocks);
    const std::scoped_lock lock(guard);
    print(from, blocks, all[k]);
  });
  print_counts(all);
  return 0;
}
