// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>

namespace voussoir::detail {

/// A line of a file as a message may show it: its first 60 characters, without line end and with
/// ? for control characters, which a terminal would obey.
[[nodiscard]] VOUSSOIR_INLINE std::string shown(std::string_view line);

/// What a file is that holds no lines of text with numbers, by its first bytes: its name and what
/// to do; empty if it may be a text.
[[nodiscard]] VOUSSOIR_INLINE std::string foreign_format(std::string_view head);

/// The lines of a text in UTF-8 or UTF-16, with or without byte order mark, whatever ends them: LF,
/// CR LF or CR. Reads no further than limits allow, so that a source without end is refused.
class BoundedLines {
 public:
  struct Limits {
    std::size_t line_length, bytes;
  };

  BoundedLines(std::istream& in, const std::string& name, const Limits& limits, StopCheck& stop)
      : in_(in), name_(name), limits_(limits), stop_(stop) {}

  /// The next line in UTF-8, without its end; false after the last.
  /// @throws InvalidInput  a line or the whole is too long, is no text, or cannot be read
  bool next(std::string& line) {
    line.clear();
    for (bool begun = false;;) {
      while (at_ == text_.size()) {
        if (!fill()) {
          number_ += begun;
          return begun;
        }
      }
      const char c = text_[at_++];
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
        throw InvalidInput(
            name_ + ":" + std::to_string(number_ + 1) +
            ": holds a byte 0: this is no text; accepted: a table of traces as text");
      if (line.size() == limits_.line_length)
        throw InvalidInput(name_ + ":" + std::to_string(number_ + 1) + ": a line of more than " +
                           std::to_string(limits_.line_length) + " characters, beginning with \"" +
                           shown(line) + "\": is this a file of traces?");
      line.push_back(c);
    }
  }
  /// Lines handed out.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// "UTF-8", "UTF-16": as it was found. After the first line.
  [[nodiscard]] const char* encoding() const {
    return encoding_ == Encoding::bytes ? "UTF-8" : "UTF-16";
  }

 private:
  enum class Encoding { unknown, bytes, little, big };

  bool fill();
  void find_encoding(std::string_view head);
  /// Adds two bytes of UTF-16 to the text as UTF-8.
  void append_unit(std::uint32_t unit);

  std::istream& in_;
  const std::string& name_;
  Limits limits_;
  StopCheck& stop_;
  std::array<char, 16384> buffer_{};
  std::string text_;
  std::size_t at_ = 0, bytes_ = 0, number_ = 0;
  bool after_return_ = false;
  Encoding encoding_ = Encoding::unknown;
  int odd_byte_ = -1;            ///< half a unit of UTF-16 at the end of a buffer
  std::uint32_t high_half_ = 0;  ///< of a pair of units
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string shown(std::string_view line) {
  constexpr std::size_t most = 60;
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  std::string text(line.substr(0, most));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return line.size() > most ? text + "..." : text;
}

VOUSSOIR_INLINE std::string foreign_format(std::string_view head) {
  using namespace std::string_view_literals;
  struct Mark {
    std::string_view begin, what;
  };
  for (const Mark& mark : {
           Mark{"PK\x03\x04"sv,
                "a spreadsheet (.xlsx, .ods) or another ZIP archive: save it as CSV"},
           Mark{"\xD0\xCF\x11\xE0"sv, "an old spreadsheet (.xls): save it as CSV"},
           Mark{"%PDF"sv, "a PDF: digitise the traces and save them as CSV"},
           Mark{"SQLite format 3"sv,
                "a GeoPackage or another SQLite database: export the lines as CSV with WKT"},
           Mark{"\x00\x00\x27\x0A"sv, "a shapefile: export the lines as CSV with WKT"},
           Mark{"AC10"sv, "a drawing (.dwg): export its lines as CSV"},
           Mark{"AutoCAD Binary DXF"sv,
                "a binary DXF: save it as ASCII DXF (R12 to 2018), or export its lines as "
                "CSV, x1,y1,x2,y2"},
           Mark{"\x1F\x8B"sv, "compressed (gzip): unpack it"},
           Mark{"\x89PNG"sv, "a picture: digitise the traces and save them as CSV"},
           Mark{"\xFF\xD8\xFF"sv, "a picture: digitise the traces and save them as CSV"},
           Mark{"{\\rtf"sv, "a formatted text (RTF): save it as plain text"},
       })
    if (head.starts_with(mark.begin)) return std::string(mark.what);
  if (head.starts_with("\xFF\xFE\x00\x00"sv) || head.starts_with("\x00\x00\xFE\xFF"sv))
    return "UTF-32: save it as UTF-8";
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  while (!head.empty() && (head[0] == ' ' || head[0] == '\t' || head[0] == '\r' || head[0] == '\n'))
    head.remove_prefix(1);
  if (head.starts_with("{") || head.starts_with("[{"))
    return (head.find("\"Feature") != std::string_view::npos ||
                    head.find("\"coordinates\"") != std::string_view::npos
                ? std::string("GeoJSON")
                : std::string("JSON")) +
           ", which is not read yet: export the lines as CSV with WKT, or as x1,y1,x2,y2";
  if (head.starts_with("<"))
    return "XML (KML, GML, LandXML, HTML), which is not read: export the lines as CSV with WKT, or "
           "as x1,y1,x2,y2";
  // Group codes and values in turn: 0 SECTION, or a comment, 999, before it.
  const std::size_t end = head.find_first_of("\r\n");
  const std::string_view code = head.substr(0, end);
  if (end != std::string_view::npos && (code.starts_with("0") || code.starts_with("999")) &&
      head.find("SECTION") != std::string_view::npos && code.size() <= 4)
    return "DXF: give it a name that ends in .dxf, or export its lines as CSV, x1,y1,x2,y2";
  return "";
}

VOUSSOIR_INLINE void BoundedLines::find_encoding(std::string_view head) {
  encoding_ = Encoding::bytes;
  const bool is_wide = head.size() >= 2 && !head.starts_with(std::string_view("\xFF\xFE\0\0", 4));
  std::size_t even = 0, odd = 0;  // zero bytes
  for (std::size_t k = 0; k < head.size(); ++k) (k % 2 == 0 ? even : odd) += head[k] == '\0';
  // Latin letters and figures have a zero for their higher byte; a byte order mark says it at once.
  if (is_wide && (head.starts_with("\xFF\xFE") || (odd > head.size() / 4 && even == 0)))
    encoding_ = Encoding::little;
  else if (is_wide && (head.starts_with("\xFE\xFF") || (even > head.size() / 4 && odd == 0)))
    encoding_ = Encoding::big;
}

VOUSSOIR_INLINE void BoundedLines::append_unit(std::uint32_t unit) {
  std::uint32_t c = unit;
  if (unit >= 0xD800 && unit < 0xDC00) {
    high_half_ = unit;
    return;
  }
  if (unit >= 0xDC00 && unit < 0xE000)
    c = high_half_ == 0 ? 0xFFFD : 0x10000 + ((high_half_ - 0xD800) << 10) + (unit - 0xDC00);
  high_half_ = 0;
  const auto byte = [&](std::uint32_t b) { text_.push_back(static_cast<char>(b)); };
  if (c < 0x80) return byte(c);
  if (c < 0x800) {
    byte(0xC0 | (c >> 6));
  } else if (c < 0x10000) {
    byte(0xE0 | (c >> 12));
    byte(0x80 | ((c >> 6) & 0x3F));
  } else {
    byte(0xF0 | (c >> 18));
    byte(0x80 | ((c >> 12) & 0x3F));
    byte(0x80 | ((c >> 6) & 0x3F));
  }
  byte(0x80 | (c & 0x3F));
}

VOUSSOIR_INLINE bool BoundedLines::fill() {
  stop_();
  in_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  if (in_.bad()) throw InvalidInput(name_ + ": cannot be read");
  std::string_view bytes(buffer_.data(), static_cast<std::size_t>(in_.gcount()));
  bytes_ += bytes.size();
  if (bytes_ > limits_.bytes)
    throw InvalidInput(name_ + ": more than " + std::to_string(limits_.bytes) +
                       " bytes; accepted: files of traces up to that size");
  text_.clear();
  at_ = 0;
  const bool is_first = encoding_ == Encoding::unknown;
  if (is_first) find_encoding(bytes);
  if (encoding_ == Encoding::bytes) {
    text_ = bytes;
  } else {
    for (const char c : bytes) {
      const auto byte = static_cast<std::uint32_t>(static_cast<unsigned char>(c));
      if (odd_byte_ < 0) {
        odd_byte_ = static_cast<int>(byte);
        continue;
      }
      const auto first = static_cast<std::uint32_t>(odd_byte_);
      odd_byte_ = -1;
      append_unit(encoding_ == Encoding::little ? first | (byte << 8) : (first << 8) | byte);
    }
  }
  if (is_first) {
    const std::string foreign = foreign_format(encoding_ == Encoding::bytes ? bytes : text_);
    if (!foreign.empty())
      throw InvalidInput(name_ + ": this is " + foreign + "; accepted: a table of traces as text");
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }
  return !bytes.empty();
}

#endif

}  // namespace voussoir::detail
