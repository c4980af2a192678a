// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace voussoir {

// Numbers as text for tables and pictures. std::to_chars throughout: a stream or printf would write
// a decimal comma on a machine set to German, and the file would not be read back.

namespace detail {
template <class... Format>
std::string to_chars_text(double value, Format... format) {
  if (std::isnan(value)) return "nan";  // never "-nan": other programs do not read it
  std::array<char, 400> buffer;         // the longest fixed double has 309 digits before the point
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format...);
  return {buffer.data(), result.ptr};
}
}  // namespace detail

/// The shortest text that reads back to the same double: "0.1", "1e+22", "-0", "nan", "inf".
[[nodiscard]] inline std::string shortest_text(double value) {
  return detail::to_chars_text(value);
}

/// At most `digits` significant digits (1 to 17), exponent where shorter: "1.23e+07".
[[nodiscard]] inline std::string significant_text(double value, int digits) {
  return detail::to_chars_text(value, std::chars_format::general, std::clamp(digits, 1, 17));
}

/// Exactly `decimals` digits (0 to 40) after the point, never an exponent and never "-0.00".
[[nodiscard]] inline std::string fixed_text(double value, int decimals) {
  std::string text =
      detail::to_chars_text(value, std::chars_format::fixed, std::clamp(decimals, 0, 40));
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  if (is_zero && text.front() == '-') text.erase(0, 1);
  return text;
}

/// As `fixed_text` without trailing zeros: "12.5", "3", "0".
[[nodiscard]] inline std::string trimmed_text(double value, int decimals) {
  std::string text = fixed_text(value, decimals);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// For a reader: about `digits` significant digits, never an exponent: "812", "12.4", "0.0531".
/// Digits before the point are all kept ("12400" for 12400.3): an engineer reads kN, not powers.
[[nodiscard]] inline std::string readable_text(double value, int digits = 3) {
  if (!std::isfinite(value) || value == 0) return fixed_text(value, 0);
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fixed_text(value, std::max(0, digits - 1 - magnitude));
}

/// `readable_text` with the minus sign of print, not the hyphen of the keyboard.
[[nodiscard]] inline std::string printed_text(double value, int digits = 3) {
  const std::string text = readable_text(value, digits);
  return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

}  // namespace voussoir
