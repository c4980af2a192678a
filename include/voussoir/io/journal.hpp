// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/io/operating_system.hpp>
#if VOUSSOIR_BODIES
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <system_error>
#endif

namespace voussoir {

// Long work cut into cases, of which none is computed twice: what is finished stands in a journal,
// one line a case, and survives a killed process, a full disk and a drive that was pulled out.
//
//   {"journal":1,"check":"...","of":"..."}                   what the cases belong to
//   {"case":"3f1c09d2a47b6e58","check":"...","result":...}   one finished case
//
// Lines of JSON: `jq` and pandas read them. `check` is a hash of what follows it, so that half a
// line, or one with a bit turned, is known for what it is.

/// A finished case.
struct JournalEntry {
  std::string name;    ///< of the case: letters and digits
  std::string fields;  ///< of a JSON object, without its braces: "\"result\":3,\"seconds\":0.1"
};

/// What a journal holds.
struct JournalText {
  std::string header;  ///< fields of its first line
  std::vector<JournalEntry> entries = {};
  /// Bytes behind the last whole line: of a line that was being written when its process died.
  std::size_t torn_bytes = 0;
  std::vector<std::size_t> damaged_lines = {};  ///< whole lines, from 1, that fail their check
};

/// 64 bits of FNV-1a as 16 hexadecimal digits: to tell texts apart, not to guard against forgery.
[[nodiscard]] VOUSSOIR_INLINE std::string text_hash(std::string_view text);

/// Reads a journal, be it in use or not.
/// @return  nothing if there is no such file, or nothing but a torn first line in it
/// @throws std::runtime_error  it cannot be read, or it is no journal of this form: its first line
[[nodiscard]] VOUSSOIR_INLINE std::optional<JournalText> read_journal(
    const std::filesystem::path& path);

/// A journal that this process writes.
///
///   auto journal = Journal::open("cases.jsonl", "\"of\":\"tunnel\"");
///   journal->add({"a1", "\"result\":3"});   // on return a killed process loses it no more
///
/// Each line goes to the operating system in one write, and to the disk itself at most a second
/// later (`sync_interval`), if somebody calls `sync_when_due` meanwhile: a power cut costs that
/// second.
class Journal {
 public:
  static constexpr double sync_interval = 1;  ///< [s]

  /// Opens a journal to go on with it, or begins one. A torn last line is cut off.
  /// @param header  fields of the first line of a new one
  /// @return  nothing if another process writes it
  /// @throws std::runtime_error  it can be neither opened nor made, is no journal, or is one with
  ///                             another header
  [[nodiscard]] static VOUSSOIR_INLINE std::optional<Journal> open(
      const std::filesystem::path& path, const std::string& header);

  /// @throws std::runtime_error  disk full: the journal is then as it was
  VOUSSOIR_INLINE void add(const JournalEntry& entry);
  /// @throws std::runtime_error
  VOUSSOIR_INLINE void sync();
  /// Does so if a line waits for it since `sync_interval`. @throws std::runtime_error
  VOUSSOIR_INLINE void sync_when_due();

  [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }
  /// See `LockedFile::is_locked`.
  [[nodiscard]] bool is_locked() const { return file_.is_locked(); }

 private:
  explicit Journal(LockedFile file) : file_(std::move(file)) {}

  LockedFile file_;
  double synced_ = 0;       ///< by the steady clock [s]
  bool is_behind_ = false;  ///< lines were added since
};

#if VOUSSOIR_BODIES

namespace detail {

inline double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline std::string journal_line(const std::string& first, const std::string& fields) {
  return "{" + first + ",\"check\":\"" + text_hash(first + fields) + "\"" +
         (fields.empty() ? "" : ",") + fields + "}\n";
}

/// The fields behind `first` and the check, if the line is whole.
inline std::optional<std::string> checked_fields(std::string_view line, const std::string& first) {
  const std::string before = "{" + first + ",\"check\":\"";
  if (!line.starts_with(before) || !line.ends_with('}') || line.size() < before.size() + 18)
    return std::nullopt;
  const std::string_view check = line.substr(before.size(), 16);
  std::string_view fields = line.substr(before.size() + 16);
  if (!fields.starts_with('"')) return std::nullopt;
  fields = fields.substr(1, fields.size() - 2);
  if (fields.starts_with(',')) fields.remove_prefix(1);
  if (text_hash(first + std::string(fields)) != check) return std::nullopt;
  return std::string(fields);
}

inline const char* const journal_first = "\"journal\":1";

}  // namespace detail

VOUSSOIR_INLINE std::string text_hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  std::string digits(16, '0');
  for (std::size_t k = 0; k < 16; ++k)
    digits[k] = "0123456789abcdef"[(hash >> (60 - 4 * k)) & 0xfU];
  return digits;
}

VOUSSOIR_INLINE std::optional<JournalText> read_journal(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) detail::throw_file_error("cannot read", path, errno != 0 ? errno : EIO);
  JournalText journal;
  std::string line;
  std::size_t number = 0;
  while (std::getline(file, line)) {
    if (file.eof()) {  // no line break behind it
      journal.torn_bytes = line.size();
      break;
    }
    if (++number == 1) {
      const auto header = detail::checked_fields(line, detail::journal_first);
      if (!header)
        throw std::runtime_error("'" + utf8_text(path) +
                                 "' is no journal of this version: its first line is `" +
                                 line.substr(0, 60) + "`\n   = accepted: a file that begins {" +
                                 detail::journal_first + ",\"check\":");
      journal.header = *header;
      continue;
    }
    const std::string before = "{\"case\":\"";
    const std::size_t end = line.find('"', before.size());
    std::optional<std::string> fields;
    std::string name;
    if (line.starts_with(before) && end != std::string::npos) {
      name = line.substr(before.size(), end - before.size());
      fields = detail::checked_fields(line, line.substr(1, end));
    }
    if (fields)
      journal.entries.push_back({std::move(name), *std::move(fields)});
    else
      journal.damaged_lines.push_back(number);
  }
  if (file.bad()) detail::throw_file_error("cannot read", path, EIO);
  if (number == 0) return std::nullopt;
  return journal;
}

VOUSSOIR_INLINE std::optional<Journal> Journal::open(const std::filesystem::path& path,
                                                     const std::string& header) {
  auto file = LockedFile::open(path);
  if (!file) return std::nullopt;
  const auto before = read_journal(path);
  if (before) {
    if (before->header != header)
      throw std::runtime_error("'" + utf8_text(path) + "' is the journal of other work: {" +
                               before->header + "}\n   = accepted: one of {" + header + "}");
    if (before->torn_bytes > 0) file->cut(std::filesystem::file_size(path) - before->torn_bytes);
  } else {
    file->cut(0);
    file->append(detail::journal_line(detail::journal_first, header));
  }
  return Journal(*std::move(file));
}

VOUSSOIR_INLINE void Journal::add(const JournalEntry& entry) {
  file_.append(detail::journal_line("\"case\":\"" + entry.name + "\"", entry.fields));
  is_behind_ = true;
  sync_when_due();
}

VOUSSOIR_INLINE void Journal::sync() {
  file_.sync();
  synced_ = detail::steady_seconds();
  is_behind_ = false;
}

VOUSSOIR_INLINE void Journal::sync_when_due() {
  if (is_behind_ && detail::steady_seconds() - synced_ >= sync_interval) sync();
}

#endif

}  // namespace voussoir
