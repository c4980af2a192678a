// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "plotting.hpp"
#include "run_folder.hpp"
#include "scoreboard.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

/// Of a text in UTF-8: bytes that do not continue a letter.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

}  // namespace

int run_program(int argc, char** argv, const char* name, Analysis analysis) {
  CLI::App app(std::string("One analysis of Boon, Houlsby & Utili (2015): ") + name);
  int samples = 5;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string out = ".";
  app.add_option("--samples", samples, "random realisations of the rock mass")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("-j,--threads", threads, "tunnels computed at a time")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1024U));
  app.add_option("-o,--out", out, "folder for plots and data, made if missing")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    check_gnuplot();
    voussoir::program::RunFolder outputs(out);
    Study study(samples, threads);
    const Section section = analysis(study);
    std::cout << section.title << " (" << section.source() << ")\n\n";
    for (const std::string& paragraph : section.text) std::cout << paragraph << "\n\n";
    for (const auto& table : section.tables) {
      std::cout << table.title << "\n";
      std::vector<std::size_t> widths;
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        widths.push_back(letters(table.columns[c]));
        for (const auto& row : table.rows) widths[c] = std::max(widths[c], letters(row[c]));
      }
      const auto print = [&](const std::vector<std::string>& row) {
        for (std::size_t c = 0; c < row.size(); ++c)
          std::cout << "  " << row[c] << std::string(widths[c] - letters(row[c]), ' ');
        std::cout << "\n";
      };
      print(table.columns);
      for (const auto& row : table.rows) print(row);
      std::cout << "\n";
    }
    for (const Finding& f : section.findings) {
      std::cout << f.claim << "  " << verdict_word(f) << "\n";
      std::cout << "  paper:    " << claim_of(f).statement << "\n";
      std::cout << "  measured: " << f.measured << "\n";
      if (!f.as_the_paper.empty()) std::cout << "  explicit: " << second_column(f) << "\n";
      if (const std::string why = cause(f); !why.empty())
        std::cout << "  why:      " << why << "\n";
    }
    const std::string id = voussoir::program::RunId("paper").add(samples).text();
    for (const auto& [file, text] : plot_files({section}, drawn({section})))
      outputs.add(file, text, id);
    outputs.publish();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace voussoir::paper
