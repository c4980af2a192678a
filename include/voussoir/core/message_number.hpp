// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <voussoir/core/bodies.hpp>

namespace voussoir {

/// A number for a message, to `digits` significant digits and with an exponent where that is
/// shorter: "0.35", "-2e-8", "5e9", "nan", "inf". std::to_chars: printf would write a decimal comma
/// on a machine set to German.
[[nodiscard]] VOUSSOIR_INLINE std::string message_number(double value, int digits = 6);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string message_number(double value, int digits) {
  if (std::isnan(value)) return "nan";
  if (value == 0) return "0";
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  std::string number(text, end);
  // "5e+09" to "5e9", "2e-08" to "2e-8"
  const std::size_t e = number.find('e');
  if (e == std::string::npos) return number;
  const bool is_small = number[e + 1] == '-';
  const std::size_t first = number.find_first_not_of("+-0", e + 1);
  return number.substr(0, e) + (is_small ? "e-" : "e") + number.substr(first);
}

#endif

}  // namespace voussoir
