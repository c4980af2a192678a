// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <voussoir/core/bodies.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

/// An angle in quadrant notation, in parts: "N", "45" and "E" of N45E, N 45 E or N45°E; "60" and
/// "SE" of 60SE. Letters are N, S, E and W, in upper case.
struct QuadrantText {
  std::string before, number, after;
};

#if VOUSSOIR_BODIES

/// The letters N, S, E and W of a text, in upper case, without blanks around; nothing if there is
/// anything else.
[[nodiscard]] VOUSSOIR_INLINE std::optional<std::string> compass_letters(std::string_view text) {
  std::string letters;
  for (const char c : lower(trimmed(text))) {
    const std::size_t at = std::string_view("nsew").find(c);
    if (at == std::string_view::npos) return std::nullopt;
    letters.push_back("NSEW"[at]);
  }
  return letters;
}

/// The parts of a field in quadrant notation; nothing if it has no letters, or others than these.
/// Between the letters of a line, N-S, there may be a hyphen.
[[nodiscard]] VOUSSOIR_INLINE std::optional<QuadrantText> quadrant_text(std::string_view text) {
  constexpr std::string_view digits = "0123456789";
  const std::size_t first = text.find_first_of(digits), last = text.find_last_of(digits);
  if (first == std::string_view::npos) {
    std::string letters(text);
    for (const std::string_view hyphen : {"-", "\xE2\x80\x93"})
      if (const std::size_t at = letters.find(hyphen);
          at != std::string::npos && at > 0 && at + hyphen.size() < letters.size())
        letters.erase(at, hyphen.size());
    const auto found = compass_letters(letters);
    if (!found || found->empty()) return std::nullopt;
    return QuadrantText{*found, "", ""};
  }
  const std::string_view number = text.substr(first, last - first + 1);
  if (number.find_first_not_of("0123456789.,") != std::string_view::npos) return std::nullopt;
  std::string_view rest = trimmed(text.substr(last + 1));
  for (const std::string_view sign : {"\xC2\xB0", "\xC2\xBA", "\xB0", "\xBA"})
    if (rest.starts_with(sign)) {
      rest.remove_prefix(sign.size());
      break;
    }
  const auto before = compass_letters(text.substr(0, first)), after = compass_letters(rest);
  if (!before || !after || before->size() + after->size() == 0) return std::nullopt;
  return QuadrantText{*before, std::string(number), *after};
}

/// Azimuth of a point of the compass, N, NE, E, SE, S, SW, W or NW [degrees]; nothing of others.
[[nodiscard]] VOUSSOIR_INLINE std::optional<double> azimuth_of_letters(std::string_view letters) {
  double azimuth = 0;
  for (const std::string_view point : {"N", "NE", "E", "SE", "S", "SW", "W", "NW"}) {
    if (letters == point) return azimuth;
    azimuth += 45;
  }
  return std::nullopt;
}

/// The point of the compass that is nearest to an azimuth [degrees].
[[nodiscard]] VOUSSOIR_INLINE std::string nearest_point(double azimuth) {
  constexpr const char* points[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  return points[static_cast<std::size_t>(azimuth / 45 + 0.5) % 8];
}

/// Azimuth of a bearing of so many degrees from North or South towards East or West, 0 to 360.
/// @param from     N or S
/// @param towards  E or W
[[nodiscard]] VOUSSOIR_INLINE double azimuth_of_bearing(char from, double angle, char towards) {
  if (from == 'N') return towards == 'E' ? angle : 360 - angle;
  return towards == 'E' ? 180 - angle : 180 + angle;
}

/// The side of a strike that letters name: 1, to its right; -1, to its left; 0: neither, because
/// they are within 22.5 degrees of the strike itself. Right letters, of the quadrant in which the
/// dip direction is or of the nearest cardinal point, are 45 degrees and more from the strike.
/// @param strike   [degrees], 0 to 360
/// @param letters  their azimuth [degrees], 0 to 360
[[nodiscard]] VOUSSOIR_INLINE int side_of_strike(double strike, double letters) {
  constexpr double along = 22.5;
  // Clockwise, from the strike to the letters.
  const double turned = letters < strike ? letters - strike + 360 : letters - strike;
  const double off = std::min(std::abs(turned - 180), std::min(turned, 360 - turned));
  if (off < along) return 0;
  return turned < 180 ? 1 : -1;
}

/// What is wrong with a bearing but for the size of its angle; follows "field 1"; empty: nothing.
/// @param is_line  a strike, of which a point of the compass is as good
[[nodiscard]] VOUSSOIR_INLINE std::string fault_of_bearing(const QuadrantText& text, bool is_line) {
  const auto is_one_of = [](std::string_view letters, std::string_view known) {
    return !letters.empty() && known.find(letters) != std::string_view::npos;
  };
  const std::string& before = text.before;
  if (text.number.empty()) {
    if (is_line && (before.size() == 1 || is_one_of(before, "NS SN EW WE"))) return "";
    return is_line ? "has no angle between its letters"
                   : "has no angle: letters alone name a side, not a direction";
  }
  if (before.empty()) return "has an angle with letters behind it only, as a dip has";
  if (!is_one_of(before, "N S")) return "does not begin with N or S";
  if (!is_one_of(text.after, "E W")) return "does not end with E or W";
  return "";
}

#endif

}  // namespace voussoir::detail
