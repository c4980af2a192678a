// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir {

/// A table as comma-separated text (RFC 4180): UTF-8, lines end in CR LF, the first one is the
/// header. Columns carry their unit in the name: "axial_force_kN", "angle_deg", "utilisation".
///
///   CsvTable table({"bolt", "angle_deg", "axial_force_kN"});
///   table.add_row("B1", 90.0, 112.5);
///   write_atomically("bolts.csv", table.text());
///
/// Numbers have a decimal point whatever the locale; NaN is written as "nan", infinity as "inf".
class CsvTable {
 public:
  /// @param columns             names, at least one
  /// @param significant_digits  of every real number; 0: as many as needed to read back the same
  /// bits
  /// @throws InvalidInput  no columns, or one without a name
  explicit CsvTable(const std::vector<std::string>& columns, int significant_digits = 0)
      : column_count_(columns.size()), significant_digits_(significant_digits) {
    if (columns.empty()) throw InvalidInput("CsvTable: at least one column is needed");
    for (const std::string& name : columns) {
      if (name.empty()) throw InvalidInput("CsvTable: a column has no name");
    }
    add_line(columns);
  }

  /// One value a column: text, whole or real numbers, bool (written 1 or 0).
  /// @throws InvalidInput  the number of values is not the number of columns
  template <class... Values>
  void add_row(const Values&... values) {
    add_cells({cell(values)...});
  }

  /// As `add_row`, for a row whose length is known at run time only.
  void add_cells(const std::vector<std::string>& cells) {
    if (cells.size() != column_count_) {
      throw InvalidInput("CsvTable: row " + std::to_string(row_count_ + 1) + " has " +
                         std::to_string(cells.size()) + " values for " +
                         std::to_string(column_count_) + " columns");
    }
    add_line(cells);
    ++row_count_;
  }

  [[nodiscard]] std::size_t row_count() const { return row_count_; }  ///< without the header
  [[nodiscard]] const std::string& text() const { return text_; }

  /// A cell in quotes where RFC 4180 asks for them, inner quotes doubled.
  [[nodiscard]] static std::string quoted(std::string_view cell) {
    // Blanks at the ends are quoted too: several readers would strip them.
    const bool is_padded = !cell.empty() && (cell.front() == ' ' || cell.back() == ' ');
    if (!is_padded && cell.find_first_of(",\"\r\n") == std::string_view::npos) {
      return std::string(cell);
    }
    std::string result = "\"";
    for (const char c : cell) {
      if (c == '"') result += '"';
      result += c;
    }
    return result + '"';
  }

 private:
  template <class Value>
  [[nodiscard]] std::string cell(const Value& value) const {
    if constexpr (std::floating_point<Value>) {
      const double number = static_cast<double>(value);
      return significant_digits_ > 0 ? significant_text(number, significant_digits_)
                                     : shortest_text(number);
    } else if constexpr (std::same_as<Value, bool>) {
      return value ? "1" : "0";
    } else if constexpr (std::integral<Value>) {
      return std::to_string(value);
    } else {
      return std::string(value);
    }
  }

  void add_line(const std::vector<std::string>& cells) {
    // A lone empty cell would be an empty line, which readers skip: quote it.
    if (cells.size() == 1 && cells.front().empty()) {
      text_ += "\"\"\r\n";
      return;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) text_ += ',';
      text_ += quoted(cells[i]);
    }
    text_ += "\r\n";
  }

  std::size_t column_count_;
  int significant_digits_;
  std::size_t row_count_ = 0;
  std::string text_;
};

}  // namespace voussoir
