// SPDX-License-Identifier: MIT
// Loose blocks that nobody picked (tests/support/loose_blocks.hpp): what energy a run makes. One
// line a case as CSV; counts at the end on the error stream.
//   energy_table [FIRST] [COUNT] [THREADS] [STEPS]      default: 0 1000 1 20000
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <string>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/parallel.hpp>

#include "support/loose_blocks.hpp"

namespace {

struct Line {
  double made = 0, updates = 0, seconds = 0, damping = 0, local = 0;
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

}  // namespace

int main(int argc, char** argv) {
  const int first = argument(argc, argv, 1, 0), count = argument(argc, argv, 2, 1000),
            threads = argument(argc, argv, 3, 1), steps = argument(argc, argv, 4, 20000);
  std::mutex mutex;
  int faults = 0, above = 0, made = 0;
  std::puts("case,dim,blocks,dashpots,local,made_percent,updates_percent,seconds,fault");
  voussoir::parallel_for(
      static_cast<std::size_t>(count), static_cast<unsigned>(threads), [&](std::size_t k) {
        const int number = first + static_cast<int>(k), dim = 2 + number / 2 % 2;
        const Line line = dim == 2 ? follow<2>(number, steps) : follow<3>(number, steps);
        const std::lock_guard lock(mutex);
        faults += line.fault.empty() ? 0 : 1;
        above += line.made > 0.01 ? 1 : 0;
        made += line.updates > 0.01 ? 1 : 0;
        std::printf("%d,%d,%d,%.2f,%.2f,%.3g,%.3g,%.1f,%s\n", number, dim, number % 2 == 1 ? 48 : 1,
                    line.damping, line.local, 100 * line.made, 100 * line.updates, line.seconds,
                    line.fault.c_str());
        std::fflush(stdout);
      });
  std::fprintf(stderr,
               "%d cases: %d with a fault, %d above their start by 1 %%, updates made 1 %% in %d\n",
               count, faults, above, made);
}
