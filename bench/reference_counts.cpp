// SPDX-License-Identifier: MIT
#include "reference_counts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/equilibrium/rockfall_range.hpp>

#include "all_blocks_in_motion.hpp"

namespace voussoir_bench {

namespace {

using Row = std::map<std::string, std::string>;

struct Said {
  std::string verdict;
  double fallen;  ///< [m^2]
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

const std::string& cell(const Row& row, const std::string& name) {
  const auto found = row.find(name);
  if (found == row.end()) throw voussoir::InvalidInput("the table has no column " + name);
  return found->second;
}

Said said(const Row& row, const std::string& name) {
  return {cell(row, name), std::atof(cell(row, name + "_m2").c_str())};
}

/// Whether two answers agree: the verdict, and area but for slivers. Of a collapse the verdict
/// alone, which is ended at whatever moment its limit is passed.
bool is_same(const Said& a, const Said& b) {
  if (a.verdict != b.verdict) return false;
  return a.verdict == "collapse" ||
         std::abs(a.fallen - b.fallen) <=
             voussoir::RockfallRange::slivers * std::max(a.fallen, b.fallen);
}

bool is_decided(const Row& row) {
  std::vector<Said> all;
  for (const Variation& variation : variations)
    if (cell(row, variation.name) != "-") all.push_back(said(row, variation.name));
  if (all.front().verdict == "undecided" || all.front().verdict == "fault") return false;
  for (const Said& a : all)
    for (const Said& b : all)
      if (!is_same(a, b)) return false;
  return true;
}

std::vector<Row> rows_of(const std::vector<std::string>& lines) {
  std::vector<Row> rows;
  if (lines.empty()) return rows;
  const std::vector<std::string> head = cells_of(lines.front());
  for (const std::string& line : lines) {
    if (line == lines.front()) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != head.size())
      throw voussoir::InvalidInput(voussoir::message(
          {"a row of ", cells.size(), " cells in a table of ", head.size(), " columns: ", line}));
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < head.size(); ++k) row[head[k]] = cells[k];
  }
  return rows;
}

double percent(std::ptrdiff_t part, std::ptrdiff_t all) {
  return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0;
}

}  // namespace

void print_counts(const std::vector<std::string>& lines,
                  const std::vector<std::string>& procedures) {
  std::vector<Row> rows = rows_of(lines);
  const auto first_marginal = std::stable_partition(rows.begin(), rows.end(), is_decided);
  const auto count = [](auto begin, auto end, auto&& test) {
    return std::count_if(begin, end, test);
  };
  const auto decided = first_marginal - rows.begin(), marginal = rows.end() - first_marginal;
  std::fprintf(stderr,
               "%zu cases: decided by the reference %td, marginal %td (%.1f %%):", rows.size(),
               decided, marginal, percent(marginal, decided + marginal));
  for (auto row = first_marginal; row != rows.end(); ++row)
    std::fprintf(stderr, " %s", cell(*row, "case").c_str());
  std::fprintf(stderr, "\n");
  for (const std::string& name : procedures) {
    const auto agrees = [&](const Row& row) {
      return is_same(said(row, name), said(row, variations[0].name));
    };
    const auto has_verdict = [&](const Row& row) {
      return cell(row, name) == cell(row, variations[0].name);
    };
    const auto same = count(rows.begin(), first_marginal, agrees);
    std::fprintf(stderr, "%-10s the same on %td of %td decided (%.1f %%), verdict alone on %td:",
                 name.c_str(), same, decided, percent(same, decided),
                 count(rows.begin(), first_marginal, has_verdict));
    for (auto row = rows.begin(); row != first_marginal; ++row)
      if (!agrees(*row)) std::fprintf(stderr, " %s", cell(*row, "case").c_str());
    std::fprintf(stderr, "\n");
  }
  const auto is_called = [](const Row& row) { return cell(row, "marginal") == "1"; };
  const auto hits = count(first_marginal, rows.end(), is_called);
  const auto alarms = count(rows.begin(), first_marginal, is_called);
  std::fprintf(
      stderr,
      "called marginal by the run: %td of %td that are (hit rate %.0f %%), %td of %td that "
      "are not (false alarms %.1f %%)\n",
      hits, marginal, percent(hits, marginal), alarms, decided, percent(alarms, decided));
  const auto print = [&](const char* what, auto begin, auto end, bool wanted) {
    std::fprintf(stderr, "%s:", what);
    for (auto row = begin; row != end; ++row)
      if (is_called(*row) == wanted) std::fprintf(stderr, " %s", cell(*row, "case").c_str());
    std::fprintf(stderr, "\n");
  };
  print("  missed", first_marginal, rows.end(), false);
  print("  false alarms", rows.begin(), first_marginal, true);
}

std::vector<std::string> lines_of(const std::vector<std::string>& files) {
  std::vector<std::string> lines;
  for (const std::string& name : files) {
    std::ifstream file(name);
    if (!file) throw voussoir::InvalidInput(name + " cannot be read");
    for (std::string line; std::getline(file, line);)
      if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace voussoir_bench
