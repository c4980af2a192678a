// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <istream>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/joint_set.hpp>

namespace voussoir {

namespace detail {

/// A line of a file as a message may show it: its first 60 characters, without line end and with
/// ? for control characters, which a terminal would obey.
[[nodiscard]] inline std::string shown(std::string_view line) {
  constexpr std::size_t most = 60;
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  std::string text(line.substr(0, most));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return line.size() > most ? text + "..." : text;
}

}  // namespace detail

/// Reads mapped joints: one trace per line, `x1,y1,x2,y2` and optionally a set number, in metres on
/// the site grid. Empty lines and lines that start with # are skipped; the first line may be a
/// header (it must start with x1).
///
/// @param name  of the source, for messages
/// @return  traces relative to `site_origin`, in the order of the file
/// @throws InvalidInput  naming file and line: wrong number of fields, not a finite number, zero
///                       length, set not a whole number >= 0
[[nodiscard]] inline std::vector<Joint> read_traces(std::istream& in, const std::string& name,
                                                    const Vec2& site_origin = Vec2::Zero()) {
  std::vector<Joint> joints;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto fail = [&](const std::string& what) {
      throw InvalidInput(name + ":" + std::to_string(number) + ": " + what + " in \"" +
                         detail::shown(line) +
                         "\"; accepted: x1,y1,x2,y2[,set] in metres, for example 1.5,-2,4.25,3,0");
    };
    std::string_view rest = line;
    if (number == 1 && rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    while (!rest.empty() && (rest.back() == '\r' || rest.back() == ' ')) rest.remove_suffix(1);
    if (rest.empty() || rest.front() == '#' || (number == 1 && rest.starts_with("x1"))) continue;
    std::vector<double> fields;
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
    if (fields.size() == 5 && !(set >= 0 && set < 1e6 && set == std::floor(set)))
      fail("the set is not a whole number >= 0");
    const Segment trace{Vec2(fields[0], fields[1]) - site_origin,
                        Vec2(fields[2], fields[3]) - site_origin};
    if (!(trace.length() > 0)) fail("a trace of zero length");
    joints.push_back({trace, static_cast<int>(set)});
  }
  if (in.bad()) throw InvalidInput(name + ": cannot be read");
  return joints;
}

}  // namespace voussoir
