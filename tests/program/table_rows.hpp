// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

/// Tables that the program has written.
namespace voussoir_test {

/// The lines of a table as their cells, those with commas in quotes; the first is its head.
inline std::vector<std::vector<std::string>> cells_of(const std::string& table) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool is_quoted = false;
  for (const char c : table) {
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == '\n' && !is_quoted)
      lines.push_back({""});
    else if (c == ',' && !is_quoted)
      lines.back().emplace_back();
    else if (c != '\r')
      lines.back().back() += c;
  }
  if (lines.back().size() == 1 && lines.back().front().empty()) lines.pop_back();  // it ends so
  return lines;
}

/// Its rows by the names of its columns.
inline std::vector<std::map<std::string, std::string>> rows_of(const std::string& table) {
  const auto lines = cells_of(table);
  std::vector<std::map<std::string, std::string>> rows;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    REQUIRE(lines[k].size() == lines.front().size());
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < lines[k].size(); ++i) row[lines.front()[i]] = lines[k][i];
  }
  return rows;
}

/// @param row  from 1
inline std::string cell(const std::string& table, std::size_t row, const std::string& column) {
  const auto rows = rows_of(table);
  REQUIRE(row <= rows.size());
  REQUIRE(rows[row - 1].contains(column));
  return rows[row - 1].at(column);
}

}  // namespace voussoir_test
