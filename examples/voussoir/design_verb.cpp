// SPDX-License-Identifier: MIT
// `voussoir design`: the places of a diagram that it takes to know the cheapest support that holds.
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "case_work.hpp"
#include "input_document.hpp"
#include "support_design.hpp"
#include "verbs.hpp"

namespace voussoir::program {

int design_verb(const Options& options, const PlanOptions& settings, bool is_sure) {
  work = {"reading " + options.file, "a smaller input file"};
  const CasePlan plan = plan_of(options, PlanVerb::diagram, settings);
  work = {"computing the cases with --threads " + std::to_string(options.threads),
          "a smaller domain (model.width, model.below_invert, tunnel.cover), fewer joints or a "
          "larger blocks.min_inscribed_radius, or fewer --threads"};
  RunFolder outputs(options.folder);
  adopt_plan(utf8_path(options.folder), plan, settings.discard);
  outputs.keep();
  FinishedCases finished_cases;
  finished_cases.add_folder(utf8_path(options.folder), plan);
  for (const std::string& remark : finished_cases.remarks())
    std::cerr << "warning: " << remark << "\n";
  auto journal = journal_of(utf8_path(options.folder), plan, "local");
  if (!journal)
    throw std::runtime_error("another process writes the journal local.jsonl in " + options.folder);
  ProgressLine line(options.quiet);
  const Report report = [&line](const std::string& what, double fraction) {
    return what.empty() ? stop_asked == 0 : line.show(what, fraction);
  };
  const auto realisations = static_cast<std::size_t>(plan.parts().realisations);
  const std::size_t thicknesses = plan.input().diagram->thickness.size();
  const auto results = [&](const SupportPlace& place) {
    std::vector<std::size_t> cases(realisations);
    std::iota(cases.begin(), cases.end(),
              (place.spacing * thicknesses + place.thickness) * realisations);
    const WorkDone done = work_on(plan, cases, finished_cases, *journal,
                                  {.threads = options.threads, .report = report});
    if (!done.refused.empty()) throw std::runtime_error("not computed: " + done.refused.front());
    return finished_cases.results(plan, cases);
  };
  std::optional<SupportDesign> design;
  try {
    design = cheapest_support(plan, results, is_sure);
  } catch (const Stopped&) {
    line.clear();
    std::cerr << "interrupted: " << finished_cases.size()
              << " cases are finished and kept; the same command goes on from there\n";
    return interrupted;
  }
  line.clear();
  work.doing = "writing the results";
  const std::string id = plan.run_id(), json = design_json(plan, *design);
  outputs.add("design.json", json, id);
  outputs.add("design.csv", design_csv(plan, *design), id);
  outputs.add("design.svg", design_svg(plan, *design), id);
  if (options.json)
    std::cout << with_run_id("design.json", json, id);
  else if (!options.quiet)
    std::cout << design_text(plan, *design);
  publish(outputs, options, "design.json, design.csv, design.svg");
  return design->cheapest ? finished : nothing_holds;
}

}  // namespace voussoir::program
