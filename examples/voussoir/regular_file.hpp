// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <voussoir/io/journal.hpp>

namespace voussoir::program {

/// Opens a file that an input names.
/// @return  why it cannot be read; empty if it can. A device or a pipe may never end, and to open
///          one may take for ever.
[[nodiscard]] inline std::string open_regular(const std::filesystem::path& path,
                                              std::ifstream& file) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found) return "cannot be read: there is no such file";
  if (kind == std::filesystem::file_type::directory) return "cannot be read: it is a folder";
  if (kind != std::filesystem::file_type::regular)
    return "cannot be read: it is not a regular file";
  file.open(path, std::ios::binary);
  return file ? "" : "cannot be read: it cannot be opened";
}

/// A hash of what a file holds, see `text_hash`; empty: it is no file that can be read twice.
[[nodiscard]] inline std::string file_hash(const std::filesystem::path& path) {
  std::ifstream file;
  if (!open_regular(path, file).empty()) return "";
  return text_hash(std::string(std::istreambuf_iterator<char>(file), {}));
}

}  // namespace voussoir::program
