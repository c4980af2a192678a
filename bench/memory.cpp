// SPDX-License-Identifier: MIT
// Peak memory of one supported tunnel, from joints to equilibrium, in a process of its own:
//   memory [width of the model over 70 m]
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>

#include "design_case.hpp"

namespace {

/// Largest resident size so far [kB].
long peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return usage.ru_maxrss / 1024;  // bytes there
#else
  return usage.ru_maxrss;
#endif
}

}  // namespace

int main(int argc, char** argv) {
  using namespace voussoir_bench;
  const double scale = argc > 1 ? std::atof(argv[1]) : 1;
  if (!(scale >= 0.5 && scale <= 50)) {
    std::fprintf(stderr, "usage: memory [width over 70 m, 0.5 to 50]\n");
    return 2;
  }
  const long start = peak();
  Tunnel tunnel = excavated(scale);
  support(tunnel, 15 * degree, 0.1);
  const long built = peak();
  const auto report = equilibrium(tunnel);
  const long end = peak();
  const auto blocks = static_cast<double>(tunnel.mass().bodies.size());
  std::printf("%.0f blocks, %zu contacts, %s, error estimate %.1e\n", blocks,
              tunnel.system().joints.contacts().size(), to_string(report), report.error_estimate);
  std::printf("%-28s %8ld kB\n", "program alone", start);
  std::printf("%-28s %8ld kB %7.2f kB per block\n", "peak, rock and supports", built,
              static_cast<double>(built - start) / blocks);
  std::printf("%-28s %8ld kB %7.2f kB per block\n", "peak, equilibrium", end,
              static_cast<double>(end - start) / blocks);
  return report.verdict == voussoir::Verdict::stable ? 0 : 1;
}
