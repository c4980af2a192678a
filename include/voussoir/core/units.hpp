// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/dimension.hpp>
#include <voussoir/core/unit_parser.hpp>

/// Quantities written as people write them, "5 GPa/m" or "35 deg", and back.
///
/// Inside the toolkit everything is SI with angles in radians; text is the one place where units
/// exist. A number without its unit is refused, because 35 may be degrees or radians and 5e9 may be
/// Pa/m or kPa/m, and either mistake runs without a warning and gives a tunnel that stands.
namespace voussoir {

/// Whether the words "inf" and "infinity" stand for a value, as for the extent of a joint.
enum class Infinity { refused, allowed };

/// A value in SI (angles in rad) with its dimension.
struct Quantity {
  double value = 0;
  Dimension dimension;
};

/// Reads a number and its unit, of whatever dimension.
///
/// Units: m g t s min h d a rad deg N Pa bar J % with the prefixes in use (mm, cm, km, kg, kN, MPa,
/// GPa ...); products with `*` or a space, quotients with `/`, exponents as m^2, m2 or superscript.
/// The decimal sign is a point under every locale. Feet, inches, psi, gon and the like are refused
/// with what they come to.
///
/// @throws UnitError  no number, no unit, unknown unit, text behind the unit, NaN, or too large for
///                    a double; the message then holds no accepted examples
[[nodiscard]] VOUSSOIR_INLINE Quantity parse_quantity(std::string_view text,
                                                      Infinity infinity = Infinity::refused);

/// Reads a quantity of a known dimension into SI, angles in rad.
///
/// @param infinity  `allowed` takes "inf" (no unit needed: no unit would change it)
/// @throws UnitError  as above, and a dimension other than the expected one; the message says what
///                    was found (of a unit weight, which density it is) and shows accepted examples
[[nodiscard]] VOUSSOIR_INLINE double parse_quantity(std::string_view text,
                                                    const Dimension& expected,
                                                    Infinity infinity = Infinity::refused);

/// Writes an SI value in the unit an engineer expects: 5e9 Pa/m as "5 GPa/m", 0.61 rad as
/// "34.9504 deg". Six significant digits, for reading; not for storing. Infinity is "inf".
[[nodiscard]] VOUSSOIR_INLINE std::string format_quantity(double value, const Dimension& dimension);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE Quantity parse_quantity(std::string_view text, Infinity infinity) {
  const auto fail = [&](const std::string& complaint) {
    throw UnitError(detail::UnitParser::printable(text), complaint, "");
  };
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  std::string_view rest = text;
  while (!rest.empty() && blank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && blank(rest.back())) rest.remove_suffix(1);
  if (rest.empty()) fail("is empty");
  if (rest.front() == '+' && rest.size() > 1 && rest[1] != '-') rest.remove_prefix(1);

  double number = 0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (status == std::errc::invalid_argument) fail("does not start with a number");
  if (status == std::errc::result_out_of_range) fail("is outside the range of numbers");
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  if (std::isnan(number)) fail("is not a number");
  if (std::isinf(number) && infinity == Infinity::refused) fail("is not finite");
  if (!rest.empty() && rest.front() == ',') fail("has a comma: the decimal sign is a point");
  while (!rest.empty() && blank(rest.front())) rest.remove_prefix(1);
  if (rest.empty()) fail("has no unit");

  if (const detail::ForeignUnit* foreign = detail::find_foreign(rest))
    fail("is " + detail::short_number(number * foreign->value, 6) + " " +
         std::string(foreign->unit));
  detail::UnitParser unit(text, rest);
  unit.run();
  const double value = unit.to_si(number);
  if (std::isinf(value) && infinity == Infinity::refused) fail("is outside the range of numbers");
  return {value, unit.dimension()};
}

VOUSSOIR_INLINE double parse_quantity(std::string_view text, const Dimension& expected,
                                      Infinity infinity) {
  if (infinity == Infinity::allowed && (text == "inf" || text == "+inf" || text == "infinity"))
    return HUGE_VAL;
  Quantity quantity;
  try {
    quantity = parse_quantity(text, infinity);
  } catch (const UnitError& error) {
    throw UnitError(detail::UnitParser::printable(text), error.complaint(),
                    accepted_examples(expected));
  }
  if (quantity.dimension == expected) return quantity.value;
  // 26 kN/m^3 of rock has the units of a stiffness per area, and is meant for what it is.
  constexpr double standard_gravity = 9.80665;  // [m/s^2]
  const double density = quantity.value / standard_gravity;
  if (expected == dimension::density && quantity.dimension == dimension::stiffness_per_area &&
      density >= 1 && density < 1e5)
    throw UnitError(detail::UnitParser::printable(text),
                    "is a unit weight: density " + detail::short_number(density, 4) + " kg/m^3",
                    accepted_examples(expected));
  const detail::DimensionWords* found = detail::find_words(quantity.dimension);
  const detail::DimensionWords* wanted = detail::find_words(expected);
  throw UnitError(
      detail::UnitParser::printable(text),
      "is " +
          (found != nullptr ? std::string(found->name)
                            : "a quantity in " + detail::base_units(quantity.dimension)) +
          ", not " +
          (wanted != nullptr ? std::string(wanted->name)
                             : "a quantity in " + detail::base_units(expected)),
      accepted_examples(expected));
}

VOUSSOIR_INLINE std::string format_quantity(double value, const Dimension& dimension) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  const detail::DimensionWords* words = detail::find_words(dimension);
  const std::string base = detail::base_units(dimension);
  std::string_view unit = base;
  double number = value;
  if (words != nullptr) {
    for (const std::string_view candidate : words->echo) {
      if (candidate.empty()) break;
      detail::UnitParser parser(candidate, candidate);
      parser.run();
      const double one = parser.to_si(1);
      // The first unit serves what is below all of them. 1 - 1e-9: 1000 kPa computed a rounding
      // low is still 1 MPa.
      if (candidate != words->echo.front() && std::abs(value) < one * (1 - 1e-9)) break;
      unit = candidate;
      number = value / one;
    }
    if (number == 0) unit = words->echo[dimension == dimension::length ? 1 : 0];
  }
  return detail::short_number(number, 6) + " " + std::string(unit);
}

#endif

}  // namespace voussoir
