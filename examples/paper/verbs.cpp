// SPDX-License-Identifier: MIT
// The verbs `paper` and `verify` of the program.
#include "verbs.hpp"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <vector>
#include <voussoir/core/version.hpp>
#include <voussoir/io/journal.hpp>

#include "analyses.hpp"
#include "pages.hpp"
#include "plotting.hpp"
#include "report.hpp"
#include "scoreboard.hpp"
#include "section.hpp"
#include "study.hpp"
#include "verification.hpp"

namespace voussoir::program {

const bool has_paper = true;

namespace {

/// The tunnels and collapses of the analyses, whatever the number of realisations. @throws
Journal paper_journal(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "paper.journal" / "local.jsonl";
  std::filesystem::create_directories(path.parent_path());
  auto journal = Journal::open(
      path, "\"of\":\"paper " VOUSSOIR_VERSION_STRING " " + std::string(sources_hash) + "\"");
  if (!journal)
    throw std::runtime_error("another process writes '" + path.string() +
                             "'\n   = accepted: another --out");
  return *std::move(journal);
}

std::map<std::string, std::string> stored_in(const std::filesystem::path& path) {
  std::map<std::string, std::string> stored;
  const auto text = read_journal(path);
  if (!text) return stored;
  const std::string head = "\"result\":";
  for (const JournalEntry& entry : text->entries)
    if (entry.fields.starts_with(head)) stored[entry.name] = entry.fields.substr(head.size());
  return stored;
}

}  // namespace

int paper_verb(const Options& options, int samples, const std::string& pages) {
  voussoir::paper::check_gnuplot();
  RunFolder outputs(options.folder);
  std::optional<RunFolder> pages_outputs;
  std::error_code other;
  const bool same_folder =
      !pages.empty() && std::filesystem::equivalent(options.folder, pages, other);
  if (!pages.empty() && !same_folder) pages_outputs.emplace(pages, "--pages");
  work = {"", "fewer --samples or --threads"};
  const auto start = std::chrono::steady_clock::now();
  ProgressLine line(options.quiet);
  std::string doing;
  Journal journal = paper_journal(options.folder);
  outputs.keep();
  std::map<std::string, std::string> stored = stored_in(journal.path());
  std::mutex guard;
  const voussoir::paper::CaseStore store{
      [&](const std::string& what) -> std::optional<std::string> {
        const std::scoped_lock lock(guard);
        const auto found = stored.find(text_hash(what));
        return found == stored.end() ? std::nullopt : std::optional(found->second);
      },
      [&](const std::string& what, const std::string& result) {
        const std::scoped_lock lock(guard);
        journal.add({text_hash(what), "\"result\":" + result});
        stored[text_hash(what)] = result;
      }};
  voussoir::paper::Study study(
      samples, options.threads,
      [&](const std::string& what, double fraction) {
        return line.show(doing + ": " + what, fraction);
      },
      store);
  std::vector<voussoir::paper::Section> sections;
  try {
    for (const auto& analysis : voussoir::paper::analyses()) {
      doing = analysis.name;
      work.doing = "the analysis " + doing;
      line.show(doing, -1);
      sections.push_back(analysis.run(study));
      if (stop_asked != 0) throw voussoir::paper::Study::Stopped{};
    }
  } catch (const voussoir::paper::Study::Stopped&) {
    line.clear();
    std::cerr << "interrupted: " << stored.size()
              << " cases are finished and kept; the same command goes on from there\n";
    return interrupted;
  }
  line.show("plots", -1);
  const voussoir::paper::Drawings drawings = voussoir::paper::drawn(sections);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::map<std::string, std::string> results = voussoir::paper::plot_files(sections, drawings);
  results["paper.html"] = voussoir::paper::report_html(sections, drawings, study);
  results["scoreboard.csv"] = voussoir::paper::scoreboard_csv(sections);
  line.clear();
  const std::string id = RunId("paper").add(samples).text();
  if (!pages.empty()) {
    const auto texts = voussoir::paper::documentation_pages(sections, drawings, study);
    if (same_folder) results.insert(texts.begin(), texts.end());  // the same pictures
    if (pages_outputs)
      for (const auto& [name, text] : texts) pages_outputs->add(name, text, id);
  }
  for (const auto& [name, text] : results) outputs.add(name, text, id);
  if (pages_outputs) pages_outputs->publish();
  if (!options.quiet)
    std::cout << voussoir::paper::score_text(voussoir::paper::scores(sections)) << samples
              << (samples == 1 ? " realisation" : " realisations") << " of the rock, "
              << study.tunnels_solved() << " supported tunnels, " << static_cast<int>(seconds)
              << " s\n";
  publish(outputs, options, "paper.html, scoreboard.csv, plots (.svg, .csv, .gp)");
  if (!options.quiet && !pages.empty())
    std::cout << "written  README.md, pages in " << pages << "\n";
  return finished;
}

int verify_verb(const Options& options) {
  work = {"the checks", "fewer --threads"};
  ProgressLine line(options.quiet);
  voussoir::paper::Study study(3, options.threads, [&](const std::string& what, double fraction) {
    return line.show(what, fraction);
  });
  std::vector<voussoir::paper::Check> checks;
  try {
    line.show("closed forms", -1);
    checks = voussoir::paper::verification(study);
  } catch (const voussoir::paper::Study::Stopped&) {
    line.clear();
    return say_interrupted();
  }
  line.clear();
  if (!options.quiet) std::cout << voussoir::paper::verification_text(checks);
  for (const auto& check : checks)
    if (!check.passes()) return not_verified;
  return finished;
}

}  // namespace voussoir::program
