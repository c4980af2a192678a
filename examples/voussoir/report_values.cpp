// SPDX-License-Identifier: MIT
// Values of result files, and numbers as a report prints them.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>
#include <voussoir/drawing/number_text.hpp>

#include "report_sections.hpp"

namespace voussoir::program {

namespace {

const Json* value_at(const Json& json, const std::string& pointer) {
  const Json::json_pointer at(pointer);
  return json.contains(at) ? &json.at(at) : nullptr;
}

constexpr const char* dash = "–";

/// "5 587": a thin blank every three digits, of what has five or more.
std::string grouped(std::string text) {
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::size_t first = text.find_first_of("0123456789");
  if (first == std::string::npos || point - first < 5) return text;
  for (std::size_t at = point; at > first + 3;) text.insert(at -= 3, "\u202f");
  return text;
}

}  // namespace

double number_at(const Json& json, const std::string& pointer) {
  const Json* const value = value_at(json, pointer);
  return value != nullptr && value->is_number() ? value->get<double>()
                                                : std::numeric_limits<double>::quiet_NaN();
}

std::string words_at(const Json& json, const std::string& pointer) {
  const Json* const value = value_at(json, pointer);
  return value != nullptr && value->is_string() ? value->get<std::string>() : "";
}

Json list_at(const Json& json, const std::string& pointer) {
  const Json* const value = value_at(json, pointer);
  return value != nullptr && value->is_array() ? *value : Json::array();
}

bool holds_at(const Json& json, const std::string& pointer) {
  const Json* const value = value_at(json, pointer);
  return value != nullptr && value->is_boolean() && value->get<bool>();
}

std::string shown(double value, int digits) {
  if (!std::isfinite(value)) return dash;
  if (std::abs(value) < 5e-7) value = 0;  // left of rounding, as the moment of a hinge
  const bool is_whole = value == std::round(value) && std::abs(value) < 1e15;
  if (is_whole) return shown_fixed(value, 0);
  return grouped(printed_text(value, digits));
}

std::string shown_given(double value) {
  return std::isfinite(value) ? significant_text(value, 6) : dash;
}

std::string shown_fixed(double value, int decimals) {
  if (!std::isfinite(value)) return dash;
  std::string text = fixed_text(value, decimals);
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return grouped(text);
}

std::string shown_percent(double share, int digits) {
  return std::isfinite(share) ? shown(100 * share, digits) + "\u00a0%" : dash;
}

std::string shown_power(double value) {
  if (!std::isfinite(value)) return dash;
  if (value == 0) return "0";
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.1e", value);
  const std::string text = buffer;
  const std::size_t at = text.find('e');
  const int exponent = std::stoi(text.substr(at + 1));
  constexpr std::string_view raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string power = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent)))
    power += raised[static_cast<std::size_t>(c - '0')];
  std::string digits = text.substr(0, at);
  if (digits.starts_with('-')) digits.replace(0, 1, "\u2212");
  return digits + "\u00a0×\u00a010" + power;
}

std::string shown_count(std::size_t count, const std::string& thing) {
  return grouped(std::to_string(count)) + "\u00a0" + thing + (count == 1 ? "" : "s");
}

std::string left_out(std::size_t all, std::size_t shown_of_them, const std::string& file) {
  return all <= shown_of_them
             ? ""
             : html::paragraph("The first " + std::to_string(shown_of_them) + " of " +
                               std::to_string(all) + "; all of them are in " + file + ".");
}

}  // namespace voussoir::program
