// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// docs/input.md, which is compiled into the program: its tables say what keys, words and numbers
/// mean.
namespace voussoir::program {

/// The page, as it stands.
[[nodiscard]] std::string_view input_page();

/// A row of a table of the page.
struct PageRow {
  std::string heading;               ///< of its section, without its marks
  std::vector<std::string> names;    ///< code spans of the first cell
  std::vector<std::string> tables;   ///< that the heading names: "support.bolts", "joint_set"
  std::vector<std::string> columns;  ///< head of the table
  std::vector<std::string> cells;

  /// By the head of its column; empty where there is none.
  [[nodiscard]] std::string cell(std::string_view column) const;
  /// Whether it is of a key: "support.bolts.length", "joint_set[].dip".
  [[nodiscard]] bool is_of(std::string_view key) const;
};

[[nodiscard]] const std::vector<PageRow>& page_rows();
/// The first that is of a key.
[[nodiscard]] std::optional<PageRow> page_row_of(std::string_view key);

/// A cell as text: code without its marks, links by their words.
[[nodiscard]] std::string plain_cell(std::string_view cell);

/// What a key, a verdict, an exit status or any other name of the page means; all rows that have
/// it.
/// @throws InvalidInput  nothing has that name: says which is near
[[nodiscard]] std::string explanation(std::string_view name);

}  // namespace voussoir::program
