// SPDX-License-Identifier: MIT
#include "orientation_input.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir::program {

namespace {

constexpr double degree = std::numbers::pi / 180;

std::string degrees_text(double angle) { return significant_text(angle / degree, 4) + " deg"; }

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

/// A number with `deg`, `rad`, or no unit at all, which then are degrees [rad].
std::optional<double> angle_of(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size()) return number * degree;
  try {
    return parse_quantity(text, dimension::angle);
  } catch (const UnitError&) {
    return std::nullopt;
  }
}

/// What a plane with this azimuth of dip [rad] is in a section from west to east: "W", and its
/// apparent dip where the true one is known.
std::string in_section(double azimuth, std::optional<double> dip) {
  const double east = elementary::sine(azimuth);
  const std::string word = east > 0 ? "\"E\"" : "\"W\"";
  if (std::abs(east) < 1e-3)
    return "a plane that dips along the tunnel: in a section from west to east it is level, "
           "\"0 deg\"";
  std::string text = "in a section from west to east that is " + word;
  if (std::abs(east) < 0.9999)
    text += dip && *dip < 0.5 * std::numbers::pi
                ? ", with the apparent dip " + degrees_text(elementary::angle_of(
                                                   elementary::tangent(*dip) * std::abs(east), 1))
                : ", with an apparent dip of tan = tan(dip) |sin(azimuth)|";
  return text;
}

/// 0 to 360 degrees [rad].
std::optional<double> azimuth_of(const std::string& text) {
  constexpr std::array<std::pair<const char*, double>, 6> points{
      {{"n", 0}, {"ne", 45}, {"se", 135}, {"s", 180}, {"sw", 225}, {"nw", 315}}};
  for (const auto& [name, azimuth] : points)
    if (lower(text) == name) return azimuth * degree;
  const auto angle = angle_of(text);
  return angle && *angle >= 0 && *angle <= 360 * degree ? angle : std::nullopt;
}

/// What a word of another language, or in small letters, means; empty: nothing that is known.
std::string meant_by(const std::string& text) {
  const std::string word = lower(text);
  for (const char* const east : {"e", "east", "est", "este", "ost", "right"})
    if (word == east) return "is \"E\"";
  for (const char* const west : {"w", "west", "ouest", "oeste", "ovest", "left"})
    if (word == west) return "is \"W\"";
  if (word == "o")
    return "reads two ways: west in French, Spanish and Italian (Ouest, Oeste, Ovest), east in "
           "German (Ost)";
  return "";
}

std::optional<double> read_dip(const Value& value, const std::string& direction) {
  const Range range{.low = 0, .high = 90 * degree};
  const std::string& text = value.node().text;
  if (value.node().kind == Node::Kind::text) {
    const std::size_t slash = text.find('/');
    const auto dip = angle_of(text.substr(0, slash));
    if (slash != std::string::npos && dip)
      if (const auto azimuth = azimuth_of(text.substr(slash + 1))) {
        value.refuse("is dip and azimuth in one: " + in_section(*azimuth, dip),
                     "dip = \"" + degrees_text(*dip) + "\" and dip_direction = \"E\" or \"W\"");
        return std::nullopt;
      }
    const std::string other = direction == "W" ? "\"E\"" : direction == "E" ? "\"W\"" : "";
    const auto turned = [&](double angle) {
      value.refuse(
          "is the same plane as " + degrees_text(angle) + " to the other side",
          "from 0 to 90 deg; here dip = \"" + degrees_text(angle) + "\"" +
              (other.empty() ? ", and the other dip_direction" : ", dip_direction = " + other));
      return std::nullopt;
    };
    if (text.find_first_not_of("0123456789.+- ") != std::string::npos && dip) {
      if (*dip > range.high * (1 + 1e-12) && *dip <= 180 * degree)
        return turned(180 * degree - *dip);
      if (*dip < 0 && *dip >= -90 * degree) return turned(-*dip);
    }
  }
  return value.as_quantity(dimension::angle, range);
}

}  // namespace

void read_orientation(Section& s, JointSetInput& set, Need need) {
  const Range range{.low = 0, .high = 90 * degree};
  const auto dip = s.find("dip", need, quantity_form(dimension::angle, range, Infinity::refused));
  const std::vector<std::string> words{"E", "W"};
  const auto direction = s.find("dip_direction", need, words_form(words));
  const auto true_dip =
      dip ? read_dip(*dip, direction ? direction->node().text : "") : std::optional<double>();
  set.dip = true_dip.value_or(set.dip);
  if (!direction) return;
  const Node& node = direction->node();
  const std::string accepted = R"("E", down to the right, or "W", down to the left)";
  std::string text = node.text;
  if (node.kind == Node::Kind::integer || node.kind == Node::Kind::real)
    text = significant_text(node.real, 12);
  const bool is_word = std::find(words.begin(), words.end(), text) != words.end();
  const std::optional<double> azimuth = is_word ? std::nullopt : azimuth_of(text);
  if (const std::string meaning = is_word ? "" : meant_by(text); !meaning.empty())
    return direction->refuse(meaning, accepted);
  if (azimuth)
    return direction->refuse("is an azimuth: " + in_section(*azimuth, true_dip), accepted);
  if (const auto at = direction->as_word(words))
    set.dip_direction = *at == 0 ? DipDirection::east : DipDirection::west;
}

}  // namespace voussoir::program
