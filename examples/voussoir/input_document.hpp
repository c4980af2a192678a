// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "input.hpp"

/// An input file as a tree of values that remember where they were written. The TOML library is
/// behind this header: what the keys mean (rock_input.cpp, ...) does not depend on it.
namespace voussoir::program {

/// Where something was written: in the file, or in an override.
struct Place {
  int line = 0;  ///< from 1; 0: no line of the file
  int column = 0;
  int width = 1;
  int override_index = -1;  ///< into Document::overrides; -1: in the file
};

struct Entry;

/// A value of the file.
struct Node {
  enum class Kind { table, array, text, integer, real, boolean, date };
  Kind kind = Kind::table;
  std::string text;          ///< of Kind::text; "true" or "false" of Kind::boolean
  std::int64_t integer = 0;  ///< of Kind::integer
  double real = 0;           ///< of Kind::real, and Kind::integer as a double
  std::vector<Entry> table;  ///< of Kind::table
  bool is_inline = false;    ///< a table in braces
  std::vector<Node> array;   ///< of Kind::array
  Place place;               ///< the value; of a table its header
  std::string written;       ///< the value as it was written; its first line
  /// Of a distribution: its median stands here in its place, as a text or a number, and `table`
  /// holds its parts. Null: a value as any other.
  std::shared_ptr<const UncertainKey> uncertain;

  [[nodiscard]] const Node* find(std::string_view key) const;
  [[nodiscard]] Node* find(std::string_view key);
};

/// A key and its value.
struct Entry {
  std::string key;
  Place place;  ///< of the key
  Node value;
};

/// A file and the overrides laid over it.
struct Document {
  std::string name;
  std::vector<std::string> lines;
  std::vector<std::string> overrides;
  Node root;
  std::vector<InputError> errors;  ///< overrides that could not be applied

  /// An error at a place, with the text of its line.
  [[nodiscard]] InputError error_at(const Place& place, std::string key, std::string message,
                                    std::string accepted) const;
};

/// @throws InputErrors  the file cannot be read, holds no text, or is not TOML
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Tables such as {mean = "35 deg", sd = "3 deg"} stand for distributions: see
/// distribution_input.hpp.
/// @throws InputErrors  the text is empty or is not TOML, or a distribution is none
[[nodiscard]] Document read_document(std::string_view text, const std::string& name,
                                     const std::vector<std::string>& overrides);

/// Every key with its value, `joint_set[0].dip = "75 deg"`, overrides laid over them, sorted: the
/// same for two documents that differ in blanks, comments or the order of keys only.
[[nodiscard]] std::vector<std::string> canonical_lines(const Document& document);

/// Keys with a distribution, in the order of the tree.
[[nodiscard]] std::vector<UncertainKey> uncertain_keys(const Document& document);

/// `text` with control characters shown as `?`, cut behind 80 bytes.
[[nodiscard]] std::string printable(std::string_view text);

/// With its letters of ASCII in lower case.
[[nodiscard]] std::string lower_case(std::string text);

/// The candidate that `word` is probably meant to be: the only one of several words of which it is
/// one, or at most one slip in three letters.
/// @return  empty if none is near
[[nodiscard]] std::string closest(std::string_view word,
                                  const std::vector<std::string>& candidates);

}  // namespace voussoir::program
