// SPDX-License-Identifier: MIT
// `voussoir report`: the results of a folder as one page.
#include <filesystem>
#include <iostream>
#include <voussoir/core/errors.hpp>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/operating_system.hpp>

#include "report_sections.hpp"
#include "verbs.hpp"

namespace voussoir::program {

namespace {

/// The head of a page without a run: many tunnels.
html::Page cases_head(const ReportFiles& files) {
  html::Page page;
  const Json realisations = files.json("realisations.json"), safety = files.json("safety.json");
  page.title = words_at(realisations, "/title");
  if (page.title.empty()) page.title = words_at(safety, "/title");
  if (page.title.empty()) page.title = "Tunnels in jointed rock";
  std::string of;
  for (const std::string& name : files.names()) of += (of.empty() ? "" : ", ") + name;
  page.subtitle = of;
  if (!realisations.is_null()) {
    page.word = "Realisations of the rock";
    const double share = number_at(realisations, "/rockfall_or_collapse/share");
    page.sentence =
        "Rock falls in " + shown_percent(share) + " of " +
        shown(number_at(realisations, "/rockfall_or_collapse/of")) + " realisations, between " +
        shown_percent(number_at(realisations, "/rockfall_or_collapse/low_95")) + " and " +
        shown_percent(number_at(realisations, "/rockfall_or_collapse/high_95")) +
        " with 95 % confidence.";
  } else if (files.has("interaction.csv")) {
    page.word = "Interaction diagram";
    page.sentence = shown_count(files.table("interaction.csv").size(), "design") +
                    " of bolt spacing and lining thickness.";
  } else if (files.has("sweep.csv")) {
    page.word = "Sweep";
    page.sentence = shown_count(files.table("sweep.csv").size(), "tunnel") + ".";
  } else {
    page.word = "Factor of safety";
  }
  return page;
}

}  // namespace

std::string report_page(const ReportFiles& files) {
  html::Page page;
  std::vector<html::Section> last;
  if (files.has("run.json")) {
    const RunResults run(files);
    page = run_head(run);
    page.sections = {picture_section(run), strength_section(run), safety_section(files),
                     detached_section(run), history_section(run)};
    last = {basis_section(run), inputs_section(run), checks_section(run), limits_section(run),
            reproduce_section(run)};
  } else {
    page = cases_head(files);
    page.sections = {safety_section(files)};
  }
  for (auto section : {realisations_section, diagram_section, sweep_section})
    page.sections.push_back(section(files));
  page.sections.insert(page.sections.end(), last.begin(), last.end());
  std::string names;
  for (const std::string& name : files.names()) names += (names.empty() ? "" : ", ") + name;
  page.foot = "Made of " + names + " of run " + files.run_id() + ".";
  return page.text();
}

int report_verb(const Options& options, const std::string& file) {
  work = {"reading " + options.folder, "a smaller folder of results"};
  const ReportFiles files = ReportFiles::read(options.folder);
  work.doing = "writing the report";
  const std::filesystem::path path =
      file.empty() ? utf8_path(options.folder) / "report.html" : utf8_path(file);
  write_atomically(path, with_run_id("report.html", report_page(files), files.run_id()));
  if (!options.quiet) std::cout << "written  " << utf8_text(path) << "\n";
  return finished;
}

}  // namespace voussoir::program
