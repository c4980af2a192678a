// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Values that were derived away from this code: tests/data/reference-values.csv and the tables
/// beside it.
namespace voussoir_test {

/// The fields of one line of comma-separated text; a field in double quotes may hold commas.
[[nodiscard]] inline std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

/// The value of a row of the table, in the unit given there; 12 significant digits.
/// @throws std::runtime_error  no such row, or the table cannot be read: a test must not pass then
[[nodiscard]] inline double reference(const std::string& id) {
  static const std::map<std::string, double> values = [] {
    const std::string path = VOUSSOIR_TEST_DATA "/reference-values.csv";
    std::ifstream file(path);
    std::map<std::string, double> table;
    std::string line;
    std::getline(file, line);  // the header
    constexpr std::size_t value_column = 3;
    while (std::getline(file, line)) {
      const auto fields = csv_fields(line);
      if (fields.size() <= value_column) throw std::runtime_error(path + ": short line " + line);
      char* end = nullptr;
      const double value = std::strtod(fields[value_column].c_str(), &end);
      if (end == fields[value_column].c_str() || *end != '\0') continue;  // a row that holds text
      if (!table.emplace(fields[0], value).second)
        throw std::runtime_error(path + ": id given twice: " + fields[0]);
    }
    if (table.empty()) throw std::runtime_error(path + ": cannot be read");
    return table;
  }();
  const auto found = values.find(id);
  if (found == values.end()) throw std::runtime_error("no reference value with id " + id);
  return found->second;
}

/// One row of a table, by the names of its columns.
class TableRow {
 public:
  explicit TableRow(std::map<std::string, std::string> fields) : fields_(std::move(fields)) {}
  /// @throws std::runtime_error  no such column
  [[nodiscard]] const std::string& text(const std::string& column) const {
    const auto found = fields_.find(column);
    if (found == fields_.end()) throw std::runtime_error("no column " + column);
    return found->second;
  }
  /// @throws std::runtime_error  no such column, or no number ("inf" is one)
  [[nodiscard]] double operator[](const std::string& column) const {
    const std::string& field = text(column);
    char* end = nullptr;
    const double value = std::strtod(field.c_str(), &end);
    if (end == field.c_str() || *end != '\0')
      throw std::runtime_error("column " + column + ": no number: " + field);
    return value;
  }

 private:
  std::map<std::string, std::string> fields_;
};

/// All rows of tests/data/<name>.csv.
/// @throws std::runtime_error  it cannot be read or has no rows
[[nodiscard]] inline std::vector<TableRow> reference_table(const std::string& name) {
  const std::string path = VOUSSOIR_TEST_DATA "/" + name + ".csv";
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const auto columns = csv_fields(line);
  std::vector<TableRow> rows;
  while (std::getline(file, line)) {
    const auto fields = csv_fields(line);
    if (fields.size() != columns.size()) throw std::runtime_error(path + ": bad line " + line);
    std::map<std::string, std::string> row;
    for (std::size_t k = 0; k < columns.size(); ++k) row[columns[k]] = fields[k];
    rows.emplace_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error(path + ": cannot be read or empty");
  return rows;
}

/// |value / expected - 1|, and |value| where zero is expected.
[[nodiscard]] inline double relative(double value, double expected) {
  return expected == 0 ? std::abs(value) : std::abs(value / expected - 1);
}

}  // namespace voussoir_test
