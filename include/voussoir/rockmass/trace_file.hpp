// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/joint.hpp>

namespace voussoir {

/// What a file of traces may hold.
struct TraceFileLimits {
  /// Number of joint sets: a trace may name those from 0 on. None: any number below 1e6.
  std::optional<int> sets{};
  std::size_t traces = 1'000'000;
  std::size_t line_length = 1000;   ///< characters of a line
  std::size_t bytes = 256'000'000;  ///< of the whole file, comments included
};

namespace detail {

/// A line of a file as a message may show it: its first 60 characters, without line end and with
/// ? for control characters, which a terminal would obey.
[[nodiscard]] VOUSSOIR_INLINE std::string shown(std::string_view line);

/// The lines of a text, whatever ends them: LF, CR LF or CR. Reads no further than limits allow,
/// so that a source without end is refused.
class BoundedLines {
 public:
  BoundedLines(std::istream& in, const std::string& name, const TraceFileLimits& limits,
               StopCheck& stop)
      : in_(in), name_(name), limits_(limits), stop_(stop) {}

  /// The next line, without its end; false after the last.
  /// @throws InvalidInput  a line or the whole is too long, or cannot be read
  bool next(std::string& line) {
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
      if (line.size() == limits_.line_length)
        throw InvalidInput(name_ + ":" + std::to_string(number_ + 1) + ": a line of more than " +
                           std::to_string(limits_.line_length) + " characters, beginning with \"" +
                           shown(line) + "\": is this a file of traces?");
      line.push_back(c);
    }
  }
  /// Lines handed out.
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  bool fill() {
    stop_();
    in_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    if (in_.bad()) throw InvalidInput(name_ + ": cannot be read");
    at_ = 0;
    end_ = static_cast<std::size_t>(in_.gcount());
    bytes_ += end_;
    if (bytes_ > limits_.bytes)
      throw InvalidInput(name_ + ": more than " + std::to_string(limits_.bytes) +
                         " bytes; accepted: files of traces up to that size");
    return end_ > 0;
  }

  std::istream& in_;
  const std::string& name_;
  const TraceFileLimits& limits_;
  StopCheck& stop_;
  std::array<char, 16384> buffer_{};
  std::size_t at_ = 0, end_ = 0, bytes_ = 0, number_ = 0;
  bool after_return_ = false;
};

/// Which set numbers a trace may have, for a message.
[[nodiscard]] inline std::string accepted_sets(const std::optional<int>& sets) {
  if (!sets) return "a whole number from 0 to 999999, or none";
  if (*sets == 0) return "none, as there is no joint set to name";
  if (*sets == 1) return "0 (the only joint set), or none";
  return "0 to " + std::to_string(*sets - 1) + " (joint sets, counted from 0), or none";
}

}  // namespace detail

/// Reads mapped joints: one trace per line, `x1,y1,x2,y2` and optionally a set number, in metres on
/// the site grid. Empty lines and lines that start with # are skipped; the first line may be a
/// header (it must start with x1). Lines end in LF, CR LF or CR.
///
/// @param name      of the source, for messages
/// @param progress  asked now and then whether to go on
/// @return  traces relative to `site_origin`, in the order of the file; at least one
/// @throws InvalidInput  naming file and line: wrong number of fields, not a finite number, zero
///                       length, a set that is not accepted, no trace at all, more than `limits`
/// @throws Stopped
[[nodiscard]] VOUSSOIR_INLINE std::vector<Joint> read_traces(
    std::istream& in, const std::string& name, const Vec2& site_origin = zeros<Vec2>(),
    const TraceFileLimits& limits = {}, const Progress& progress = {});

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::string shown(std::string_view line) {
  constexpr std::size_t most = 60;
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  std::string text(line.substr(0, most));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return line.size() > most ? text + "..." : text;
}

}  // namespace detail

VOUSSOIR_INLINE std::vector<Joint> read_traces(std::istream& in, const std::string& name,
                                               const Vec2& site_origin,
                                               const TraceFileLimits& limits,
                                               const Progress& progress) {
  StopCheck stop(progress);
  detail::BoundedLines lines(in, name, limits, stop);
  std::vector<Joint> joints;
  std::string line;
  std::vector<double> fields;
  while (lines.next(line)) {
    stop();
    const bool is_first = lines.number() == 1;
    const auto refuse = [&](const std::string& what, const std::string& accepted) {
      throw InvalidInput(name + ":" + std::to_string(lines.number()) + ": " + what + " in \"" +
                         detail::shown(line) + "\"; accepted: " + accepted);
    };
    const auto fail = [&](const std::string& what) {
      refuse(what, "x1,y1,x2,y2[,set] in metres, for example 1.5,-2,4.25,3,0");
    };
    std::string_view rest = line;
    if (is_first && rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
    if (rest.empty() || rest.front() == '#' || (is_first && rest.starts_with("x1"))) continue;
    fields.clear();
    while (true) {
      const std::size_t comma = rest.find(',');
      std::string_view field = rest.substr(0, comma);
      while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
      while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
      double value = 0;
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
      if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
        fail("field " + std::to_string(fields.size() + 1) + " is not a finite number");
      fields.push_back(value);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    if (fields.size() != 4 && fields.size() != 5)
      fail(std::to_string(fields.size()) + " fields instead of 4 or 5");
    const double set = fields.size() == 5 ? fields[4] : -1;
    if (fields.size() == 5) {
      if (!(set >= 0 && set < 1e6 && set == std::floor(set)))
        fail("the set is not a whole number >= 0");
      if (limits.sets && !(set < *limits.sets))
        refuse("there is no joint set " + std::to_string(static_cast<int>(set)),
               "as set number " + detail::accepted_sets(limits.sets));
    }
    const Segment trace{Vec2(fields[0], fields[1]) - site_origin,
                        Vec2(fields[2], fields[3]) - site_origin};
    if (!(trace.length() > 0)) fail("a trace of zero length");
    if (!std::isfinite(trace.length())) fail("a trace without a finite length");
    if (joints.size() == limits.traces)
      refuse("trace number " + std::to_string(limits.traces + 1),
             "at most " + std::to_string(limits.traces) + " traces");
    joints.push_back({trace, static_cast<int>(set)});
  }
  if (joints.empty())
    throw InvalidInput(name + ": holds no trace: " +
                       (lines.number() == 0 ? std::string("it is empty")
                                            : std::to_string(lines.number()) +
                                                  " lines, all empty, header or comment") +
                       "; accepted: one trace per line, x1,y1,x2,y2[,set] in metres, for example "
                       "1.5,-2,4.25,3,0");
  return joints;
}

#endif

}  // namespace voussoir
