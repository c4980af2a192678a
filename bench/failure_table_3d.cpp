// SPDX-License-Identifier: MIT
// Unsupported tunnels in 3-D that nobody picked (tests/support/failing_rock.hpp), by every solution
// procedure and by all blocks in motion. One line a case as CSV; counts at the end on the error
// stream.
//   failure_table_3d [FIRST] [COUNT]      default: 1 40; some ten minutes
//   failure_table_3d FIRST COUNT PERCENT [THREADS]
//                                         blocks of that part of the size, by TwoLevel alone
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/tunnel/construction.hpp>

#include "support/failing_rock.hpp"
#include "whole_number.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_test;

class Clock {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// Of all processors together.
  [[nodiscard]] double processor_seconds() const {
    return static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t processor_start_ = std::clock();
};

struct Column {
  FailureAnswer answer;
  double limit, seconds;
};

template <class Method>
Column by(const DrawnInSpace& drawn) {
  const Clock clock;
  const EquilibriumReport report =
      report_by<Method>(drawn.tunnel, collapse_measure_of(drawn.section));
  return {{report.verdict, report.fallen, report.fallen_measure},
          report.displacement_limit,
          clock.seconds()};
}

void print(const Column& column) {
  std::printf(",%s,%.3f,%zu,%.2f", to_string(column.answer.verdict), column.answer.area,
              column.answer.fallen.size(), column.seconds);
}

/// Smaller blocks, and how long they take.
void print_scaled(int first, int count, int percent, int threads) {
  std::printf("case,bodies,two_level,two_level_m3,two_level_blocks,steps,wall_s,processor_s\n");
  for (int k = first; k < first + count; ++k) {
    const DrawnInSpace drawn = drawn_tunnel_in_space(static_cast<std::uint64_t>(k), 1e-2 * percent);
    std::printf("%d,%zu", k, drawn.tunnel.mass().bodies.size());
    std::fflush(stdout);
    const Clock clock;
    const EquilibriumReport report =
        report_by<TwoLevel>(drawn.tunnel, collapse_measure_of(drawn.section),
                            TwoLevel({.motion = {.threads = static_cast<unsigned>(threads)}}));
    std::printf(",%s,%.3f,%zu,%d,%.1f,%.1f\n", to_string(report.verdict), report.fallen_measure,
                report.fallen.size(), report.steps, clock.seconds(), clock.processor_seconds());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int first = argc > 1 ? voussoir_bench::number_of(argv[1]) : 1;
  const int count = argc > 2 ? voussoir_bench::number_of(argv[2]) : 40;
  const int percent = argc > 3 ? voussoir_bench::number_of(argv[3]) : 100;
  const int threads = argc > 4 ? voussoir_bench::number_of(argv[4]) : 1;
  if (first < 0 || count < 1 || percent < 1 || threads < 1 || argc > 5) {
    std::fprintf(stderr,
                 "failure_table_3d [FIRST] [COUNT] [PERCENT] [THREADS]: whole numbers, all but "
                 "FIRST > 0\n");
    return 2;
  }
  if (argc > 3) {
    print_scaled(first, count, percent, threads);
    return 0;
  }
  std::printf("case,bodies");
  for (const char* name : {"two_level", "relaxation", "explicit", "reference"})
    std::printf(",%s,%s_m3,%s_blocks,%s_s", name, name, name, name);
  std::printf("\n");
  int same[3] = {0, 0, 0}, shed = 0, collapsed = 0;
  for (int k = first; k < first + count; ++k) {
    const DrawnInSpace drawn = drawn_tunnel_in_space(static_cast<std::uint64_t>(k));
    const Column columns[] = {by<TwoLevel>(drawn), by<Relaxation>(drawn), by<Explicit>(drawn)};
    const Clock clock;
    const FailureAnswer truth = all_blocks_in_motion(
        drawn.tunnel, columns[0].limit,
        collapse_measure_of(drawn.section) * open_length(drawn.tunnel.mass()), 1, 0.5);
    std::printf("%d,%zu", k, drawn.tunnel.mass().bodies.size());
    for (int m = 0; m < 3; ++m) {
      print(columns[m]);
      // A collapse is ended on its way: which blocks are down by then is a matter of the rate.
      same[m] += truth.verdict == Verdict::stable ? columns[m].answer == truth
                                                  : columns[m].answer.verdict == truth.verdict;
    }
    print({truth, 0, clock.seconds()});
    std::printf("\n");
    std::fflush(stdout);
    shed += truth.verdict == Verdict::stable && truth.area > 0;
    collapsed += truth.verdict == Verdict::collapse;
  }
  std::fprintf(
      stderr,
      "%d cases: %d shed rock, %d collapse; the same blocks, or collapse as well: TwoLevel "
      "%d, Relaxation %d, Explicit %d\n",
      count, shed, collapsed, same[0], same[1], same[2]);
  return 0;
}
