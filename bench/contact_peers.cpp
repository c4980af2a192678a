// SPDX-License-Identifier: MIT
// Times one library on the contact workloads and prints one line of JSON per query:
//   contact_peers_<library> [--dir FOLDER] [--budget SECONDS per query] [--only PART OF LABEL]
// `contact_table` runs these programs in turn and makes one table of their lines.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "contact_query.hpp"

namespace {

using namespace voussoir_bench;

struct Options {
  std::string folder = "contact_workloads.data", only;
  double budget = 0.4;  ///< [s]
};

void print(const Query& query, const std::string& workload, std::size_t visited,
           const Timing& timing, const Accuracy& accuracy) {
  const auto text = [](const char* key, const std::string& value) {
    std::printf("\"%s\":\"%s\",", key, value.c_str());
  };
  const auto real = [](const char* key, const char* format, double value) {
    std::printf("\"%s\":", key);
    std::printf(format, value);
    std::putchar(',');
  };
  const auto count = [](const char* key, std::size_t value) {
    std::printf("\"%s\":%zu,", key, value);
  };
  const double per_pair = 1e9 / static_cast<double>(visited);
  std::putchar('{');
  text("peer", query.peer);
  text("build", build_description);
  text("precision", query.precision);
  text("op", query.operation);
  count("warm", query.warm ? 1 : 0);
  text("workload", workload);
  count("pairs", visited);
  real("ns_median", "%.2f", timing.median * per_pair);
  real("ns_min", "%.2f", timing.least * per_pair);
  count("passes", timing.passes);
  count("false_pos", accuracy.invented);
  count("false_neg", accuracy.missed);
  count("false_pos_over_10um", accuracy.invented_clearly);
  count("false_neg_over_10um", accuracy.missed_clearly);
  count("fail", accuracy.failed);
  count("both_touch", accuracy.both_touch);
  real("depth_err_median", "%.3g", accuracy.depth_error_median);
  real("depth_err_p99", "%.3g", accuracy.depth_error_p99);
  real("depth_err_max", "%.3g", accuracy.depth_error_max);
  count("depth_err_over_10um", accuracy.depth_error_over_10um);
  count("depth_err_over_1mm", accuracy.depth_error_over_1mm);
  real("worst_pair", "%.0f", static_cast<double>(accuracy.worst_pair));
  real("normal_err_deg_p50", "%.3g", accuracy.normal_error_median);
  real("normal_err_deg_p99", "%.3g", accuracy.normal_error_p99);
  real("points_mean", "%.3f", accuracy.points_mean);
  count("sliver_pairs", accuracy.sliver_pairs);
  std::printf("\"sliver_bad\":%zu}\n", accuracy.sliver_wrong);
  std::fflush(stdout);
}

template <int Dim>
std::size_t run(const std::string& name, const Options& options) {
  // A folder need not hold all workloads; asking for a missing one by --dir alone is no fault.
  if (!std::filesystem::exists(options.folder + "/" + name + ".pairs")) return 0;
  const Workload<Dim> workload = read_workload<Dim>(options.folder, name);
  std::size_t done = 0;
  for (const Query& query : queries(workload)) {
    if (query.label(name).find(options.only) == std::string::npos) continue;
    const Timing timing = time_passes(query, options.budget);
    const auto answers = answers_of(query, workload.pairs.size());
    print(query, name, query.visited(workload.pairs.size()), timing,
          judge(answers, query, workload));
    ++done;
  }
  return done;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string option = argv[k];
    if (option == "--dir") options.folder = argv[k + 1];
    if (option == "--budget") options.budget = std::atof(argv[k + 1]);
    if (option == "--only") options.only = argv[k + 1];
  }
  try {
    const std::size_t done = run<2>("W2", options) + run<2>("W2deep", options) +
                             run<3>("W3", options) + run<3>("W3deep", options);
    if (done > 0) return 0;
    std::fprintf(stderr, "%s: nothing to time in %s; `contact_workloads` writes the workloads\n",
                 argv[0], options.folder.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
  }
  return 1;
}
