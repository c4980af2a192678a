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

constexpr std::array<std::pair<const char*, double>, 8> compass{{{"N", 0},
                                                                 {"NE", 45},
                                                                 {"E", 90},
                                                                 {"SE", 135},
                                                                 {"S", 180},
                                                                 {"SW", 225},
                                                                 {"W", 270},
                                                                 {"NW", 315}}};

/// As a value of the file.
std::string quoted_degrees(double angle) {
  std::string text = "\"";
  text += significant_text(angle / degree, 4);
  return text += " deg\"";
}

std::string degrees_text(double angle) { return significant_text(angle / degree, 4) + " deg"; }

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

/// Of a point of the compass, or 0 to 360 degrees [rad].
std::optional<double> azimuth_of(const std::string& text) {
  for (const auto& [name, azimuth] : compass)
    if (text == name) return azimuth * degree;
  const auto angle = angle_of(text);
  return angle && *angle >= 0 && *angle <= 360 * degree ? angle : std::nullopt;
}

/// What a word of another language, or in small letters, means; empty: nothing that is known.
std::string meant_by(const std::string& text) {
  const std::string word = lower_case(text);
  for (const char* const east : {"e", "east", "est", "este", "ost", "right"})
    if (word == east) return "is \"E\"";
  for (const char* const west : {"w", "west", "ouest", "oeste", "ovest", "left"})
    if (word == west) return "is \"W\"";
  for (const auto& [name, azimuth] : compass)
    if (word == lower_case(name)) return std::string("is \"") + name + "\"";
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
        value.refuse("is dip and dip direction in one", "dip = \"" + degrees_text(*dip) +
                                                            "\" and dip_direction = \"" +
                                                            degrees_text(*azimuth) + "\"");
        return std::nullopt;
      }
    const auto towards = azimuth_of(direction);
    std::string other = direction == "W" ? "\"E\"" : direction == "E" ? "\"W\"" : "";
    if (other.empty() && towards)
      other = quoted_degrees(std::fmod(*towards + 180 * degree, 360 * degree));
    const auto turned = [&](double angle) {
      value.refuse(
          "is the same plane as " + degrees_text(angle) + " to the other side",
          "from 0 to 90 deg; here dip = " + quoted_degrees(angle) +
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
  const auto dip = s.find("dip", need, KeyForm::quantity(dimension::angle, range));
  const std::string accepted =
      R"(an azimuth, "135 deg", clockwise from North, with tunnel.trend; "N", "NE", "E", ...; without tunnel.trend "E", down to the right, or "W", down to the left)";
  const auto direction = s.find("dip_direction", need, accepted);
  const auto true_dip =
      dip ? read_dip(*dip, direction ? direction->node().text : "") : std::optional<double>();
  set.plane.dip = true_dip.value_or(set.plane.dip);
  if (!direction) return;
  const Node& node = direction->node();
  if (node.kind == Node::Kind::integer || node.kind == Node::Kind::real)
    return direction->refuse(
        "has no unit", quoted_degrees(node.real * degree) + " if degrees are meant; " + accepted);
  if (node.kind != Node::Kind::text) return direction->refuse("is no direction", accepted);
  const std::string& text = node.text;
  for (const auto& [name, azimuth] : compass)
    if (text == name) {
      set.is_azimuth = text != "E" && text != "W";
      set.plane.dip_direction = azimuth * degree;
      return;
    }
  if (const std::string meaning = meant_by(text); !meaning.empty())
    return direction->refuse(meaning, accepted);
  if (text.find_first_of("0123456789") == std::string::npos)
    return direction->refuse("is no direction", accepted);
  const auto azimuth = direction->as_quantity(
      dimension::angle, {.low = 0, .high = std::nextafter(360 * degree, 7.0)});
  set.is_azimuth = azimuth.has_value();
  set.plane.dip_direction = azimuth.value_or(0);
}

}  // namespace voussoir::program
