// SPDX-License-Identifier: MIT
// One supported tunnel from joints to equilibrium, in a process of its own: what every part takes
// of processor time and memory.
//   scale planar WIDTH [METHOD]      2-D, the domain WIDTH m wide and 6/7 of it deep
//   scale spatial SPACING [METHOD]   3-D, the joints of each set SPACING m apart
// METHOD of the elastic equations: automatic, direct, iterative.
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "cavern_case.hpp"
#include "design_case.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;

/// Largest resident size so far [MB].
double peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return 1e-6 * static_cast<double>(usage.ru_maxrss);  // bytes there
#else
  return 1e-3 * static_cast<double>(usage.ru_maxrss);
#endif
}

/// Processor time of the process so far [s].
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class Make>
int run(const Make& make, LinearMethod method) {
  const double start = seconds(), empty = peak();
  auto model = make();
  const double built = seconds(), built_peak = peak();
  TwoLevel::Params params;
  params.linear.method = method;
  const EquilibriumReport report = model.equilibrium(0, TwoLevel(params));
  const double end = seconds();
  const auto bodies = static_cast<double>(model.system().body_count());
  std::printf("%.0f bodies, %zu contacts: %s, error estimate %.1e\n", bodies,
              model.system().joints.contacts().size(), to_string(report), report.error_estimate);
  std::printf("elastic equations: %s (%s), %d solves, %d iterations, %.0f MB\n",
              to_string(report.linear.method), report.linear.reason.c_str(), report.elastic_solves,
              report.linear.iterations, 1e-6 * report.linear.memory);
  std::printf("%-22s %10s %12s %14s\n", "", "CPU [s]", "peak [MB]", "kB per body");
  std::printf("%-22s %10.2f %12.0f %14.2f\n", "rock and supports", built - start, built_peak,
              1e3 * (built_peak - empty) / bodies);
  std::printf("%-22s %10.2f %12.0f %14.2f\n", "equilibrium", end - built, peak(),
              1e3 * (peak() - empty) / bodies);
  std::printf("%-22s %10.2f\n", "together", end - start);
  return report.verdict == Verdict::stable ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string space = argc > 2 ? argv[1] : "", word = argc > 3 ? argv[3] : "automatic";
  const double size = argc > 2 ? std::atof(argv[2]) : 0;
  for (const LinearMethod method :
       {LinearMethod::automatic, LinearMethod::direct, LinearMethod::iterative}) {
    if (word != to_string(method)) continue;
    if (space == "planar" && size >= 50 && size <= 2000)
      return run(
          [size] {
            Tunnel tunnel = excavated_square(size);
            support(tunnel, 15 * degree, 0.1);
            return tunnel;
          },
          method);
    if (space == "spatial" && size >= 0.3 && size <= 3)
      return run([size] { return cavern(size); }, method);
  }
  std::fprintf(stderr,
               "usage: scale planar WIDTH [METHOD]     50 to 2000 m\n"
               "       scale spatial SPACING [METHOD]  0.3 to 3 m\n"
               "METHOD: automatic, direct, iterative\n");
  return 2;
}
