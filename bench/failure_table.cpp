// SPDX-License-Identifier: MIT
// Unsupported tunnels that nobody picked (failure_cases.hpp), by every solution procedure and by
// the varied reference: all blocks in motion, and the same with what is not physics varied
// (all_blocks_in_motion.hpp). One line a case as CSV; counts at the end on the error stream.
//   failure_table [FIRST] [COUNT] [THREADS] [REFERENCES] [EVERY]    default: 0 200 1 2 1; hours
//   failure_table counts FILE...    of pieces that were written before: cases FIRST, FIRST + EVERY
// REFERENCES: 0 none, minutes; 1 with nothing varied; 2 varied; 3 with joints of fibres, too.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/memory.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>

#include "all_blocks_in_motion.hpp"
#include "failure_cases.hpp"
#include "reference_counts.hpp"
#include "whole_number.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;

using Tunnel = Solver<>;

struct Answer {
  std::string verdict = "-";
  double fallen = 0;  ///< [m^2]
  int count = 0;      ///< blocks
  double seconds = 0;
  std::optional<RockfallRange> range;
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

template <class Method>
Answer answer_of(Tunnel tunnel, double collapse_measure, const Method& method) {
  std::vector<double> measures;
  for (const auto& body : tunnel.mass().bodies) measures.push_back(body.properties.measure);
  measures.resize(static_cast<std::size_t>(tunnel.system().body_count()), 0.0);
  SearchContext context;
  context.measures = &measures;
  context.gravity = tunnel.in_situ().gravity;
  context.acceptance.collapse_measure = collapse_measure;
  return timed([&](Answer& answer) {
    const EquilibriumReport report = method.find(detail::SystemOf::in(tunnel), context);
    answer.fallen = report.fallen_measure;
    answer.count = static_cast<int>(report.fallen.size());
    answer.verdict = report.verdict != Verdict::stable ? to_string(report.verdict)
                     : answer.count > 0                ? "rockfall"
                                                       : "stable";
    answer.range = report.rockfall;
  });
}

TwoLevel with_range() {
  TwoLevel::Params params;
  params.motion.range = RangeSought::all;
  return TwoLevel(params);
}

struct Row {
  std::size_t blocks = 0;
  double mean_block = 0;  ///< [m^2]
  Answer procedures[3];   ///< as in `procedure_names`
  Answer ranged;          ///< `TwoLevel` with its range
  Answer motion[std::size(variations)];
};
const std::vector<std::string> procedure_names = {"two_level", "relaxation", "explicit"};

Row row_of(const FailureCase& from, int references) {
  Tunnel tunnel(rock_of(from), CoulombJoint(from.joint), from.in_situ);
  const double collapse = collapse_measure_of(from.opening);
  tunnel.excavate(from.opening);
  Row row;
  row.blocks = tunnel.mass().bodies.size();
  for (const auto& body : tunnel.mass().bodies)
    row.mean_block += body.properties.measure / static_cast<double>(row.blocks);
  row.procedures[0] = answer_of(tunnel, collapse, TwoLevel());
  row.procedures[1] = answer_of(tunnel, collapse, Relaxation());
  row.procedures[2] = answer_of(tunnel, collapse, Explicit());
  row.ranged = answer_of(tunnel, collapse, with_range());
  for (std::size_t k = 0; k < std::size(variations); ++k)
    if (is_wanted(k, references))
      row.motion[k] = answer_of(tunnel, collapse, AllBlocksInMotion(variations[k].motion));
  return row;
}

std::string head() {
  std::string text =
      "case,shape,span_m,cover_m,k0,sets,spacing_m,persistent,friction_deg,blocks,block_m2";
  const auto add = [&](const std::string& name) {
    for (const char* part : {"", "_m2", "_blocks", "_s"})
      text.append(",").append(name).append(part);
  };
  for (const std::string& name : procedure_names) add(name);
  text += ",marginal,least_m2,most_m2,another_verdict,marginal_s";
  for (const Variation& variation : variations) add(variation.name);
  return text;
}

std::string line_of(const FailureCase& from, const Row& row) {
  char text[200];
  std::snprintf(text, sizeof text, "%d,%s,%.2f,%.1f,%.2f,%zu,%.2f,%d,%.1f,%zu,%.4g", from.number,
                from.shape.c_str(), from.span, from.cover, from.k0, from.sets.size(), from.spacing,
                from.persistent, from.joint.friction_angle * 180 / std::numbers::pi, row.blocks,
                row.mean_block);
  std::string line = text;
  const auto add = [&](const Answer& a) {
    std::snprintf(text, sizeof text, ",%s,%.4g,%d,%.3g", a.verdict.c_str(), a.fallen, a.count,
                  a.seconds);
    line += text;
  };
  for (const Answer& answer : row.procedures) add(answer);
  const RockfallRange range =
      row.ranged.range.value_or(RockfallRange{row.ranged.fallen, row.ranged.fallen});
  std::snprintf(text, sizeof text, ",%d,%.4g,%.4g,%d,%.3g", range.is_marginal(), range.low,
                range.high, range.has_other_verdict, row.ranged.seconds);
  line += text;
  for (const Answer& answer : row.motion) add(answer);
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::strcmp(argv[1], "counts") == 0) {
    print_counts(lines_of({argv + 2, argv + argc}), procedure_names);
    return 0;
  }
  keep_freed_memory();
  const int first = argc > 1 ? number_of(argv[1]) : 0;
  const int count = argc > 2 ? number_of(argv[2]) : 200;
  const int threads = argc > 3 ? number_of(argv[3]) : 1;
  const int references = argc > 4 ? number_of(argv[4]) : 2;
  const int every = argc > 5 ? number_of(argv[5]) : 1;
  if (argc > 6 || first < 0 || count < 1 || threads < 1 || references < 0 || references > 3 ||
      every < 1) {
    std::fprintf(
        stderr,
        "usage: failure_table [FIRST >= 0] [COUNT >= 1] [THREADS >= 1] [REFERENCES 0 to 3] "
        "[EVERY >= 1]\n       failure_table counts FILE...\n");
    return 2;
  }
  std::vector<std::string> lines = {head()};
  std::puts(lines.front().c_str());
  std::mutex guard;
  parallel_for(static_cast<std::size_t>(count), static_cast<unsigned>(threads), [&](std::size_t k) {
    const FailureCase from = failure_case(first + every * static_cast<int>(k));
    const Row row = row_of(from, references);
    const std::scoped_lock lock(guard);
    lines.push_back(line_of(from, row));
    std::puts(lines.back().c_str());
    std::fflush(stdout);
  });
  if (references > 1) print_counts(lines, procedure_names);
  return 0;
}
