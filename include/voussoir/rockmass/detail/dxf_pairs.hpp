// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/rockmass/detail/bounded_lines.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

inline constexpr const char* dxf_wanted = "a drawing saved as ASCII DXF, R12 to 2018";

/// A group of a DXF: a line with its code, which says what it is, and a line with its value.
struct DxfGroup {
  int code = 0;
  std::string value;     ///< without blanks around
  std::size_t line = 0;  ///< of the value in the file, from 1
};

/// The groups of an ASCII DXF one after the other, comments (code 999) left out. Lines end in LF,
/// CR LF or CR. Not by BoundedLines, which reads tables of traces and refuses a DXF.
///
/// Source: Autodesk, DXF Reference (2018), "Group codes in numerical order".
class DxfPairs {
 public:
  struct Limits {
    std::size_t line_length, bytes;
  };

  DxfPairs(std::istream& in, const std::string& name, const Limits& limits, TraceFaults& faults,
           StopCheck& stop)
      : in_(in), name_(name), limits_(limits), faults_(faults), stop_(stop) {}

  /// The next group; false at the end of the file.
  /// @throws InvalidInput  another format or encoding, a code that is no number, a code without its
  ///                       value, a line or the whole too long, with what was found before
  bool next(DxfGroup& group);
  /// Lines read.
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  [[nodiscard]] bool next_line(std::string& line);
  [[nodiscard]] bool fill();
  void find_format(std::string_view head);
  /// One more fault, and all of them thrown.
  void stop_at(std::size_t line, const std::string& what, std::string_view text,
               const std::string& accepted = dxf_wanted) {
    faults_.add(line, what, text, accepted);
    faults_.finish();
  }

  std::istream& in_;
  const std::string& name_;
  Limits limits_;
  TraceFaults& faults_;
  StopCheck& stop_;
  std::array<char, 16384> buffer_{};
  std::size_t at_ = 0, end_ = 0, bytes_ = 0, number_ = 0;
  bool after_return_ = false;
  std::string code_line_;
};

/// Text of a DXF in UTF-8: \U+00FC of older versions is a letter; bytes that are no UTF-8 are taken
/// as Latin-1, and `is_guessed` set.
[[nodiscard]] VOUSSOIR_INLINE std::string dxf_text(std::string_view text, bool& is_guessed);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE bool DxfPairs::next(DxfGroup& group) {
  for (;;) {
    if (!next_line(code_line_)) return false;
    const std::string_view text = trimmed(code_line_);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), group.code);
    const bool is_code = error == std::errc() && end == text.data() + text.size() &&
                         group.code >= -5 && group.code <= 1071;
    if (!is_code)
      stop_at(number_,
              number_ == 1 ? "this is no DXF: its first line is no group code"
                           : "a group code is no number from -5 to 1071: lines are missing, or "
                             "there is one too many",
              code_line_);
    if (!next_line(group.value))
      stop_at(number_, "the file ends after a group code, without its value: it was cut off",
              code_line_);
    group.value = std::string(trimmed(group.value));
    group.line = number_;
    if (group.code != 999) return true;
  }
}

VOUSSOIR_INLINE bool DxfPairs::next_line(std::string& line) {
  line.clear();
  for (bool begun = false;;) {
    if (at_ == end_ && !fill()) {
      number_ += begun;
      return begun;
    }
    const char c = buffer_[at_++];
    if (after_return_ && c == '\n') {  // the second half of CR LF
      after_return_ = false;
      continue;
    }
    after_return_ = c == '\r';
    begun = true;
    if (c == '\n' || c == '\r') {
      ++number_;
      return true;
    }
    if (c == '\0')
      stop_at(number_ + 1, "holds a byte 0: this is no text, or not in ASCII or UTF-8", line);
    if (line.size() == limits_.line_length)
      stop_at(number_ + 1, message({"a line of more than ", limits_.line_length, " characters"}),
              line);
    line.push_back(c);
  }
}

VOUSSOIR_INLINE bool DxfPairs::fill() {
  stop_();
  in_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  if (in_.bad()) throw InvalidInput(name_ + ": cannot be read");
  at_ = 0;
  end_ = static_cast<std::size_t>(in_.gcount());
  const bool is_first = bytes_ == 0;
  bytes_ += end_;
  if (bytes_ > limits_.bytes)
    throw InvalidInput(message(
        {name_, ": more than ", limits_.bytes, " bytes; accepted: drawings up to that size"}));
  if (is_first) find_format({buffer_.data(), end_});
  return at_ < end_;
}

VOUSSOIR_INLINE void DxfPairs::find_format(std::string_view head) {
  using namespace std::string_view_literals;
  if (head.starts_with("AutoCAD Binary DXF"))
    stop_at(1, "this is a binary DXF", head.substr(0, 18),
            std::string(dxf_wanted) + ": save it again as ASCII (SAVEAS, DXF, options: ASCII)");
  if (head.starts_with("AC10") || head.starts_with("AC1.") || head.starts_with("AC2."))
    stop_at(1, "this is a DWG", head.substr(0, 6),
            std::string(dxf_wanted) + ": save it again as DXF in the CAD program");
  const auto zeros_at = [&](std::size_t first) {
    std::size_t count = 0;
    for (std::size_t k = first; k < head.size(); k += 2) count += head[k] == '\0';
    return 4 * count > head.size();
  };
  if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF") ||
      (!head.starts_with("\0\0"sv) && (zeros_at(0) != zeros_at(1))))
    stop_at(1, "this is a text in UTF-16 or UTF-32, which no DXF is in", "",
            std::string(dxf_wanted) + ", in ASCII, UTF-8 or the code page of its CAD program");
  if (const std::string foreign = foreign_format(head);
      !foreign.empty() && !foreign.starts_with("DXF"))
    stop_at(1, "this is " + foreign.substr(0, foreign.find_first_of(":,")), head.substr(0, 8));
  if (head.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

VOUSSOIR_INLINE std::string dxf_text(std::string_view text, bool& is_guessed) {
  std::string out;
  const auto letter = [&](std::uint32_t c) {
    const auto byte = [&](std::uint32_t b) { out.push_back(static_cast<char>(b)); };
    if (c < 0x80) return byte(c);
    if (c < 0x800) {
      byte(0xC0 | (c >> 6));
    } else {
      byte(0xE0 | (c >> 12));
      byte(0x80 | ((c >> 6) & 0x3F));
    }
    byte(0x80 | (c & 0x3F));
  };
  const auto at = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[k])) : 0U;
  };
  for (std::size_t k = 0; k < text.size();) {
    if (text.substr(k, 3) == "\\U+" && k + 7 <= text.size()) {
      std::uint32_t c = 0;
      const char* digits = text.data() + k + 3;
      if (std::from_chars(digits, digits + 4, c, 16).ptr == digits + 4 && c >= 0x20 &&
          (c < 0xD800 || c >= 0xE000)) {
        letter(c);
        k += 7;
        continue;
      }
    }
    const unsigned c = at(k);
    const std::size_t size = c < 0x80 ? 1 : c >= 0xF0 ? 4 : c >= 0xE0 ? 3 : c >= 0xC2 ? 2 : 0;
    bool is_utf8 = size > 0 && c < 0xF5;
    for (std::size_t more = 1; more < size; ++more)
      is_utf8 = is_utf8 && (at(k + more) & 0xC0) == 0x80;
    if (is_utf8) {
      out += text.substr(k, size);
      k += size;
    } else {
      letter(c);
      is_guessed = true;
      ++k;
    }
  }
  return out;
}

#endif

}  // namespace voussoir::detail
