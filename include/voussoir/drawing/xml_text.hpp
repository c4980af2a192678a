// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <voussoir/core/bodies.hpp>

namespace voussoir {

/// Bytes of the character that `text` begins with, if it is UTF-8 and allowed in XML 1.0; else 0.
[[nodiscard]] VOUSSOIR_INLINE std::size_t xml_character_length(std::string_view text);

/// Text for the inside of an XML element or attribute. Bytes that would make the file unreadable
/// (control characters, a title typed in Latin-1) become U+FFFD.
[[nodiscard]] VOUSSOIR_INLINE std::string xml_escaped(std::string_view text);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::size_t xml_character_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) {
    return lead >= 0x20 || lead == '\t' || lead == '\n' || lead == '\r' ? 1 : 0;
  }
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  std::uint32_t code = lead & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};  // longer than needed: refused
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool is_forbidden = is_surrogate || code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
  return code >= smallest[length] && !is_forbidden ? length : 0;
}

VOUSSOIR_INLINE std::string xml_escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = xml_character_length(text);
    switch (length == 1 ? text.front() : '\0') {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += length > 0 ? text.substr(0, length) : "\xEF\xBF\xBD";
        break;
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  return result;
}

#endif

}  // namespace voussoir
