// SPDX-License-Identifier: MIT
// `voussoir report`: the results of a folder as one page.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>
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

/// A browser on the PATH that prints without a window; empty: there is none.
std::string browser() {
  for (const char* const name :
       {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"})
    if (finds_program(name)) return name;
  return "";
}

/// A folder of this process for what a browser keeps, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("voussoir-report-" + std::to_string(process_number()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;  // nothing that anybody needs
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The page as a browser prints it.
/// @throws std::runtime_error  the browser prints nothing
std::string printed(const std::string& program, const std::string& page) {
  const ScratchFolder scratch;
  const auto html = scratch.path() / "report.html", pdf = scratch.path() / "report.pdf";
  write_atomically(html, page);
  std::vector<std::string> words{program,
                                 "--headless",
                                 "--disable-gpu",
                                 "--no-first-run",
                                 "--no-pdf-header-footer",
                                 "--user-data-dir=" + utf8_text(scratch.path() / "profile"),
                                 "--print-to-pdf=" + utf8_text(pdf),
                                 utf8_text(html)};
  std::error_code error;
  // In containers, and for root, its sandbox does not start. The page is ours and fetches nothing.
  for (const bool has_sandbox : {true, false}) {
    if (!has_sandbox) words.insert(words.begin() + 1, "--no-sandbox");
    if (run_to_its_end(words) == 0 && std::filesystem::file_size(pdf, error) > 0 && !error) {
      std::ifstream file(pdf, std::ios::binary);
      return {std::istreambuf_iterator<char>(file), {}};
    }
  }
  throw std::runtime_error(
      "--pdf: " + program +
      " printed nothing\n   = accepted: without --pdf; any browser prints the page");
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
  const Json safety = files.json("safety.json");
  if (const double factor = number_at(safety, "/factor_of_safety"); std::isfinite(factor))
    page.cards.push_back({"Factor of safety", shown(factor), "",
                          "stands over " + shown(number_at(safety, "/stands_over")) +
                              ", falls over " + shown(number_at(safety, "/falls_over"))});
  for (auto section : {realisations_section, design_section, diagram_section, sweep_section})
    page.sections.push_back(section(files));
  page.sections.insert(page.sections.end(), last.begin(), last.end());
  std::string names;
  for (const std::string& name : files.names()) names += (names.empty() ? "" : ", ") + name;
  page.foot = "Made of " + names + " of run " + files.run_id() + ".";
  return page.text();
}

int report_verb(const Options& options, const std::string& file, bool wants_pdf) {
  work = {"reading " + options.folder, "a smaller folder of results"};
  const std::string program = wants_pdf ? browser() : "";
  if (wants_pdf && program.empty())
    throw InvalidInput(
        "--pdf: no Chromium is found on the PATH\n   = accepted: one of chromium, "
        "chromium-browser, google-chrome (Debian: apt-get install chromium), or no --pdf: any "
        "browser prints the page");
  if (utf8_path(file).extension() == ".pdf")
    throw InvalidInput("-o " + file +
                       " is the page, and --pdf prints it beside that\n   = accepted: a name that "
                       "ends with .html");
  const ReportFiles files = ReportFiles::read(options.folder);
  work.doing = "writing the report";
  std::filesystem::path path =
      file.empty() ? utf8_path(options.folder) / "report.html" : utf8_path(file);
  const std::string page = with_run_id("report.html", report_page(files), files.run_id());
  OutputSet outputs;
  outputs.add(path, page);
  std::string names = utf8_text(path);
  if (wants_pdf) {
    path.replace_extension(".pdf");
    outputs.add(path, printed(program, page));
    names += ", " + utf8_text(path);
  }
  outputs.publish();
  if (!options.quiet) std::cout << "written  " << names << "\n";
  return finished;
}

}  // namespace voussoir::program
