// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

/// What a report is made of: the files of one run, by name.
namespace voussoir::program {

/// A table of results: cells as they were written, found by the name of their column.
class ReportTable {
 public:
  /// @param text  comma-separated, the first row its header (RFC 4180)
  explicit ReportTable(std::string_view text);
  [[nodiscard]] std::size_t size() const { return rows_.size(); }  ///< rows, without the header
  [[nodiscard]] bool has(std::string_view column) const;
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// Empty where there is no such column, or the row is too short.
  [[nodiscard]] std::string_view cell(std::size_t row, std::string_view column) const;
  /// Not a number where the cell is none.
  [[nodiscard]] double number(std::size_t row, std::string_view column) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// The id of the run that wrote a file, see `with_run_id`; empty: the file has none.
[[nodiscard]] std::string run_id_of(const std::string& name, const std::string& text);

/// Results of one run, or of the runs of one design, by the names of their files.
class ReportFiles {
 public:
  /// Takes of a folder what reports show, and nothing else.
  /// @throws InvalidInput  there is no such folder, it holds no results, a file of them is damaged
  ///                       or cannot be read, or they are of different runs: names the file
  [[nodiscard]] static ReportFiles read(const std::string& folder);

  /// Of a run that is being written; files that reports do not show are left out.
  /// @param text  with the id of its run
  void add(const std::string& name, std::string text);

  [[nodiscard]] bool has(const std::string& name) const { return files_.contains(name); }
  /// @throws std::out_of_range  there is none
  [[nodiscard]] const std::string& text(const std::string& name) const { return files_.at(name); }
  /// null: there is no such file
  /// @throws InvalidInput  it is damaged
  [[nodiscard]] nlohmann::json json(const std::string& name) const;
  /// Without rows where there is no such file.
  [[nodiscard]] ReportTable table(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  /// Pictures of stages, "history/stage_001.svg", in their order.
  [[nodiscard]] std::vector<std::string> stage_pictures() const;
  /// Of the file that leads: the run, else what many tunnels came to.
  [[nodiscard]] std::string run_id() const;
  [[nodiscard]] const std::string& folder() const { return folder_; }

 private:
  /// @throws InvalidInput  see `read`
  void check() const;
  [[nodiscard]] std::string path_of(const std::string& name) const;

  std::string folder_;
  std::map<std::string, std::string> files_;
};

}  // namespace voussoir::program
