// SPDX-License-Identifier: MIT
// The program of one analysis, VOUSSOIR_ANALYSIS: computes it, prints what it found beside what the
// paper says, and writes its plots.  paper_<name> [--samples N] [--threads N] [--out FOLDER]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <voussoir/io/atomic_file.hpp>

#include "analyses.hpp"
#include "claims.hpp"
#include "plotting.hpp"

using namespace voussoir;

int main(int argc, char** argv) {
  CLI::App app("One analysis of Boon, Houlsby & Utili (2015): " VOUSSOIR_ANALYSIS_NAME);
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
  CLI11_PARSE(app, argc, argv);
  try {
    paper::check_gnuplot();
    paper::Study study(samples, threads);
    const paper::Section section = paper::VOUSSOIR_ANALYSIS(study);
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
    for (const paper::Finding& f : section.findings) {
      std::cout << f.claim << "  " << to_string(f.agreement) << "\n";
      for (const paper::Claim& c : paper::claims())
        if (f.claim == c.id) std::cout << "  paper:    " << c.statement << "\n";
      std::cout << "  measured: " << f.measured << "\n";
      if (!f.as_the_paper.empty()) std::cout << "  explicit: " << f.as_the_paper << "\n";
      if (!f.why.empty()) std::cout << "  why:      " << f.why << "\n";
    }
    const std::vector<std::string> drawings = paper::drawn(section.plots);
    std::filesystem::create_directories(out);
    OutputSet outputs;
    for (std::size_t k = 0; k < drawings.size(); ++k) {
      const std::filesystem::path base = std::filesystem::path(out) / section.plots[k].name;
      outputs.add(base.string() + ".svg", drawings[k]);
      outputs.add(base.string() + ".csv", paper::plot_csv(section.plots[k]));
      outputs.add(base.string() + ".gp", paper::plot_script(section.plots[k]));
    }
    for (const paper::Picture& picture : section.pictures)
      outputs.add(std::filesystem::path(out) / (picture.name + ".svg"), picture.svg);
    outputs.publish();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
}
