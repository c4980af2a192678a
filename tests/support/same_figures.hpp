// SPDX-License-Identifier: MIT
#pragma once
// Two answers that should be one, table by table: what a reader of tables sees of a problem and of
// its image.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/core/vec.hpp>

#include "support/transformed.hpp"

namespace voussoir_test {

/// A table of comma-separated text: units are in the names of its columns.
struct FigureTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  explicit FigureTable(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      std::istringstream fields(line);
      for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
      if (columns.empty())
        columns = cells;
      else if (!is_negligible(cells))
        rows.push_back(cells);
    }
  }
  /// Of a contact no longer than a micrometre, which carries nothing and may be there or not.
  [[nodiscard]] bool is_negligible(const std::vector<std::string>& cells) const {
    const int length = column("length_m");
    return length >= 0 && std::atof(cells[static_cast<std::size_t>(length)].c_str()) < 1e-6;
  }
  /// -1: there is none.
  [[nodiscard]] int column(std::string_view name) const {
    const auto at = std::find(columns.begin(), columns.end(), name);
    return at == columns.end() ? -1 : static_cast<int>(at - columns.begin());
  }
  [[nodiscard]] const std::string& cell(std::size_t row, int column) const {
    return rows[row][static_cast<std::size_t>(column)];
  }
};

/// The number that all of a cell is; else none.
[[nodiscard]] inline bool is_number(const std::string& cell, double& value) {
  char* end = nullptr;
  value = std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0';
}

/// The figure of two tables that differs most, over what it may differ by.
struct WorstFigure {
  double difference = 0;  ///< relative [-]; infinite: another word, or other rows
  std::string where;

  void take(double other, const std::string& other_where) {
    if (!(other > difference) && !std::isnan(other)) return;
    difference = std::isnan(other) ? INFINITY : other;
    where = other_where;
  }
  void take(const WorstFigure& other) { take(other.difference, other.where); }
};

/// Which figures of a table are of the same kind, so that one that is next to nothing is measured
/// by the largest: a difference of large figures has their rounding.
///
/// @param floor  part of the largest figure of a column below which one is next to nothing [-]
[[nodiscard]] inline WorstFigure worst_figure(const std::string& name, const std::string& one_text,
                                              const std::string& image_text,
                                              const Transform<2>& map, double floor) {
  const FigureTable one(one_text), image(image_text);
  WorstFigure worst;
  if (one.columns != image.columns || one.rows.size() != image.rows.size()) {
    worst.take(INFINITY, name + ": " + std::to_string(one.rows.size()) + " rows or " +
                             std::to_string(image.rows.size()));
    return worst;
  }
  const bool is_mirrored = map.turn(0, 0) < 0;
  const int x = one.column("x_m"), y = one.column("y_m");
  const auto place = [&](const FigureTable& table, std::size_t row) {
    return voussoir::Vec2(std::atof(table.cell(row, x).c_str()),
                          std::atof(table.cell(row, y).c_str()));
  };
  // Rows that tell of a place belong to the row that tells of its image.
  std::vector<std::size_t> twin(one.rows.size());
  std::vector<char> is_taken(one.rows.size(), 0);
  for (std::size_t k = 0; k < twin.size(); ++k) {
    twin[k] = k;
    if (x < 0 || y < 0) continue;
    const voussoir::Vec2 there = map(place(one, k));
    double least = INFINITY;
    for (std::size_t j = 0; j < twin.size(); ++j)
      if (const double away = (place(image, j) - there).norm(); is_taken[j] == 0 && away < least) {
        least = away;
        twin[k] = j;
      }
    is_taken[twin[k]] = 1;
  }
  for (std::size_t c = 0; c < one.columns.size(); ++c) {
    const std::string& column = one.columns[c];
    // Numbers of things follow their order, which is another in the image.
    const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
      return std::find(names.begin(), names.end(), column) != names.end();
    };
    if (is_one_of({"bolt", "node", "block_a", "block_b", "member"})) continue;
    double largest = 0, value = 0;
    for (const auto& row : one.rows)
      if (is_number(row[c], value) && std::isfinite(value))
        largest = std::max(largest, std::abs(value));
    for (std::size_t k = 0; k < one.rows.size(); ++k) {
      const std::string &a = one.rows[k][c], &b = image.rows[twin[k]][c];
      const std::string where = name + ", row " + std::to_string(k) +
                                (x < 0 ? " " + one.rows[k][0] : std::string()) + ", " + column +
                                ": " + a + ", " + b;
      double v = 0, w = 0;
      if (!is_number(a, v) || !is_number(b, w)) {
        if (a != b) worst.take(INFINITY, where);
        continue;
      }
      if (std::isnan(v) && std::isnan(w)) continue;
      if (is_one_of({"x_m", "y_m"})) {
        const auto to = map(place(one, k));
        // Tables have eight digits.
        worst.take(std::abs((column == "x_m" ? to.x() : to.y()) - w) /
                       (std::abs(map.shift.x()) + std::abs(map.shift.y()) + 10),
                   where);
        continue;
      }
      if (column == "angle_deg") {
        if (is_mirrored) v = 180 - v;
        worst.take(std::abs(std::remainder(v - w, 360)) / 360, where);
        continue;
      }
      if (is_mirrored && column == "shear_kN_per_m") v = -v;  // V changes its sign
      const double difference = std::abs(v - w);
      // A thousandth of a millimetre is next to nothing, too: what plastic slips of 1e-17 mm are.
      const double least =
          column.ends_with("_mm") ? std::max(floor * largest, 1e-3) : floor * largest;
      if (difference > 0) worst.take(difference / std::max(std::abs(v), least), where);
    }
  }
  return worst;
}

}  // namespace voussoir_test
