// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/io/atomic_file.hpp>

#include "claims.hpp"
#include "plotting.hpp"
#include "report.hpp"

namespace voussoir::paper {

int run_program(int argc, char** argv, const char* name, Analysis analysis) {
  CLI::App app(std::string("One analysis of Boon, Houlsby & Utili (2015): ") + name);
  int samples = 5;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string out = ".";
  app.add_option("--samples", samples, "random samples of the rock mass")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("-j,--threads", threads, "tunnels computed at a time")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1024U));
  app.add_option("-o,--out", out, "folder for plots and data, made if missing")
      ->capture_default_str();
  bool page = false;
  app.add_flag("--page", page,
               "write a page of documentation beside the plots instead of their data");
  CLI11_PARSE(app, argc, argv);
  try {
    check_gnuplot();
    Study study(samples, threads);
    const Section section = analysis(study);
    std::cout << section.title << " (Boon et al. 2015: " << section.paper << ")\n\n";
    for (const std::string& paragraph : section.text) std::cout << paragraph << "\n\n";
    for (const auto& table : section.tables) {
      std::cout << table.title << "\n";
      std::vector<std::size_t> widths;
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        widths.push_back(table.columns[c].size());
        for (const auto& row : table.rows) widths[c] = std::max(widths[c], row[c].size());
      }
      const auto print = [&](const std::vector<std::string>& row) {
        for (std::size_t c = 0; c < row.size(); ++c)
          std::cout << "  " << row[c] << std::string(widths[c] - row[c].size(), ' ');
        std::cout << "\n";
      };
      print(table.columns);
      for (const auto& row : table.rows) print(row);
      std::cout << "\n";
    }
    for (const Finding& f : section.findings) {
      std::cout << f.claim << "  " << to_string(f.agreement) << "\n";
      for (const Claim& c : claims())
        if (f.claim == c.id) std::cout << "  paper:    " << c.statement << "\n";
      std::cout << "  measured: " << f.measured << "\n";
      if (!f.as_the_paper.empty()) std::cout << "  explicit: " << f.as_the_paper << "\n";
      if (!f.why.empty()) std::cout << "  why:      " << f.why << "\n";
    }
    const std::vector<std::string> drawings = drawn(section.plots);
    std::filesystem::create_directories(out);
    OutputSet outputs;
    for (std::size_t k = 0; k < drawings.size(); ++k) {
      const std::filesystem::path base = std::filesystem::path(out) / section.plots[k].name;
      outputs.add(base.string() + ".svg", drawings[k]);
      if (page) continue;
      outputs.add(base.string() + ".csv", plot_csv(section.plots[k]));
      outputs.add(base.string() + ".gp", plot_script(section.plots[k]));
    }
    for (const Picture& picture : section.pictures)
      outputs.add(std::filesystem::path(out) / (picture.name + ".svg"), picture.svg);
    if (page)
      outputs.add(std::filesystem::path(out) / (section.name + ".md"),
                  page_markdown(section, "paper_" + section.name + " --page --samples " +
                                             std::to_string(samples)));
    outputs.publish();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace voussoir::paper
