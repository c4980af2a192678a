// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

/// Quantities written as people write them, "5 GPa/m" or "35 deg", and back.
///
/// Inside the toolkit everything is SI with angles in radians; text is the one place where units
/// exist. A number without its unit is refused, because 35 may be degrees or radians and 5e9 may be
/// Pa/m or kPa/m, and either mistake runs without a warning and gives a tunnel that stands.
namespace voussoir {

/// Exponents of a physical dimension. The angle counts as a dimension of its own, so that "35 deg"
/// cannot pass for the plain number 0.61; percent is dimensionless.
struct Dimension {
  int mass = 0;    ///< exponent of kg
  int length = 0;  ///< exponent of m
  int time = 0;    ///< exponent of s
  int angle = 0;   ///< exponent of rad
  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

/// The dimensions that ground and support are described in.
namespace dimension {
inline constexpr Dimension number{};
inline constexpr Dimension mass{1, 0, 0, 0};                  ///< kg
inline constexpr Dimension length{0, 1, 0, 0};                ///< m
inline constexpr Dimension time{0, 0, 1, 0};                  ///< s
inline constexpr Dimension angle{0, 0, 0, 1};                 ///< rad
inline constexpr Dimension area{0, 2, 0, 0};                  ///< m^2
inline constexpr Dimension intensity{0, -2, 0, 0};            ///< joint centres per area, 1/m^2
inline constexpr Dimension velocity{0, 1, -1, 0};             ///< m/s
inline constexpr Dimension acceleration{0, 1, -2, 0};         ///< m/s^2
inline constexpr Dimension density{1, -3, 0, 0};              ///< kg/m^3
inline constexpr Dimension force{1, 1, -2, 0};                ///< N
inline constexpr Dimension moment{1, 2, -2, 0};               ///< N m
inline constexpr Dimension stiffness{1, 0, -2, 0};            ///< N/m
inline constexpr Dimension pressure{1, -1, -2, 0};            ///< Pa
inline constexpr Dimension stiffness_per_area{1, -2, -2, 0};  ///< Pa/m
}  // namespace dimension

/// A text that is no quantity of the wanted dimension. `what()` is a whole sentence with accepted
/// examples; the parts are there for callers that set their own (an input file with its line).
class UnitError : public std::invalid_argument {
 public:
  UnitError(const std::string& text, const std::string& complaint, const std::string& accepted)
      : std::invalid_argument("\"" + text + "\" " + complaint +
                              (accepted.empty() ? "" : "; accepted: " + accepted)),
        complaint_(complaint),
        accepted_(accepted) {}

  [[nodiscard]] const std::string& complaint() const { return complaint_; }  ///< "has no unit"
  [[nodiscard]] const std::string& accepted() const { return accepted_; }    ///< "a length, ..."

 private:
  std::string complaint_, accepted_;
};

/// Whether the words "inf" and "infinity" stand for a value, as for the extent of a joint.
enum class Infinity { refused, allowed };

/// A value in SI (angles in rad) with its dimension.
struct Quantity {
  double value = 0;
  Dimension dimension;
};

namespace detail {

/// A unit symbol: SI value = 10^decimal_exponent * (degrees ? pi/180 : 1). The power of ten is kept
/// apart because 7 / 100 is the double nearest to 0.07 and 7 * 0.01 is not.
struct Unit {
  std::string_view symbol;
  std::string_view prefixes;  ///< of k c m u M G T, those in use with this symbol
  Dimension dimension;
  int decimal_exponent = 0;
  bool degrees = false;
};

inline constexpr std::array<Unit, 13> unit_table{{
    {"m", "kcmu", dimension::length},
    {"g", "km", dimension::mass, -3},
    {"t", "k", dimension::mass, 3},
    {"s", "mu", dimension::time},
    {"rad", "m", dimension::angle},
    {"deg", "", dimension::angle, 0, true},
    {"\u00b0", "", dimension::angle, 0, true},
    {"N", "kMGm", dimension::force},
    {"Pa", "kMGT", dimension::pressure},
    {"bar", "", dimension::pressure, 5},
    {"J", "kM", dimension::moment},
    {"%", "", dimension::number, -2},
    {"\u2030", "", dimension::number, -3},
}};

inline constexpr int decimal_exponent_of_prefix(char prefix) {
  switch (prefix) {
    case 'T':
      return 12;
    case 'G':
      return 9;
    case 'M':
      return 6;
    case 'k':
      return 3;
    case 'c':
      return -2;
    case 'm':
      return -3;
    default:
      return -6;  // u
  }
}

/// How a dimension is called, shown in examples and echoed; `echo` rises by size.
struct DimensionWords {
  Dimension dimension;
  std::string_view name;
  std::string_view examples;
  std::array<std::string_view, 4> echo;
};

inline constexpr std::array<DimensionWords, 15> dimension_words{{
    {dimension::number, "a fraction", R"("40 %" or "2.5 %")", {"%"}},
    {dimension::mass, "a mass", R"("250 kg" or "1.2 t")", {"kg", "t"}},
    {dimension::length, "a length", R"("4 m", "10 cm" or "28 mm")", {"mm", "m"}},
    {dimension::time, "a time", R"("0.5 s" or "20 ms")", {"ms", "s"}},
    {dimension::angle, "an angle", R"("35 deg" or "0.6 rad")", {"deg"}},
    {dimension::area, "an area", R"("0.074 m^2" or "740 cm^2")", {"m^2"}},
    {dimension::intensity, "a number per area", R"("1 /m^2" or "0.5 1/m^2")", {"/m^2"}},
    {dimension::velocity, "a velocity", R"("0.1 m/s" or "5 mm/s")", {"mm/s", "m/s"}},
    {dimension::acceleration, "an acceleration", R"("9.81 m/s^2")", {"m/s^2"}},
    {dimension::density, "a density", R"("2700 kg/m^3" or "2.7 t/m^3")", {"kg/m^3"}},
    {dimension::force, "a force", R"("500 kN" or "0.5 MN")", {"N", "kN", "MN", "GN"}},
    {dimension::moment, "a moment", R"("120 kN*m" or "0.12 MN*m")", {"N*m", "kN*m", "MN*m"}},
    {dimension::stiffness,
     "a stiffness",
     R"("0.2 GN/m", "200 MN/m" or "2e8 N/m")",
     {"N/m", "kN/m", "MN/m", "GN/m"}},
    {dimension::pressure,
     "a stress",
     R"("662 kPa", "1.2 MPa" or "25 GPa")",
     {"Pa", "kPa", "MPa", "GPa"}},
    {dimension::stiffness_per_area,
     "a stiffness per area",
     R"("5 GPa/m", "5000 MPa/m" or "5e9 Pa/m")",
     {"Pa/m", "kPa/m", "MPa/m", "GPa/m"}},
}};

inline const DimensionWords* find_words(const Dimension& dimension) {
  for (const DimensionWords& words : dimension_words)
    if (words.dimension == dimension) return &words;
  return nullptr;
}

inline std::string base_units(const Dimension& dimension) {
  std::string text;
  const auto add = [&](std::string_view symbol, int exponent) {
    if (exponent == 0) return;
    if (!text.empty()) text += '*';
    text += symbol;
    if (exponent != 1) text += "^" + std::to_string(exponent);
  };
  add("kg", dimension.mass);
  add("m", dimension.length);
  add("s", dimension.time);
  add("rad", dimension.angle);
  return text.empty() ? "1" : text;
}

/// `value` times 10^exponent, rounded once for |exponent| <= 22 (those powers are exact doubles).
inline double scale_by_ten(double value, int exponent) {
  return exponent >= 0 ? value * std::pow(10.0, exponent) : value / std::pow(10.0, -exponent);
}

/// Reads "GPa/m", "kg/m3", "/m^2", "kN*m": factors with whole exponents, `*` or a space for a
/// product, `/` for the one factor behind it.
class UnitParser {
 public:
  UnitParser(std::string_view whole, std::string_view unit) : whole_(whole), rest_(unit) {}

  /// @throws UnitError  with an empty list of accepted examples: the caller knows what it wants
  void run() {
    skip_space();
    if (rest_.starts_with("1/")) rest_.remove_prefix(1);
    bool divide = false, after_slash = false;
    if (take("/")) divide = after_slash = true;
    while (true) {
      skip_space();
      factor(divide ? -1 : 1);
      const bool space = skip_space();
      if (rest_.empty()) return;
      if (take("/")) {
        divide = after_slash = true;
        continue;
      }
      if (!take("*") && !take("\u00b7") && !space)
        fail("continues with `" + printable(rest_) + "`");
      // N/m s: is that N/(m s) or (N/m) s? Nobody should have to know our rule.
      if (after_slash) fail("has a product behind `/`, which reads two ways");
      divide = false;
    }
  }

  [[nodiscard]] const Dimension& dimension() const { return dimension_; }

  /// The value in SI of `number` times this unit.
  [[nodiscard]] double to_si(double number) const {
    double value = scale_by_ten(number, decimal_exponent_);
    for (int i = 0; i < degrees_; ++i) value = value * std::numbers::pi / 180;
    for (int i = 0; i > degrees_; --i) value = value * 180 / std::numbers::pi;
    return value;
  }

  /// Control characters would garble a terminal, and a pasted page is no message.
  static std::string printable(std::string_view text) {
    std::string result;
    for (const char c : text) {
      // Cut between characters: bytes 10xxxxxx continue one.
      if (result.size() >= 60 && (static_cast<unsigned char>(c) & 0xc0U) != 0x80U)
        return result + "...";
      result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& complaint) const {
    throw UnitError(printable(whole_), complaint, "");
  }
  bool take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  bool skip_space() {
    bool any = false;
    while (take(" ") || take("\t") || take("\u00a0")) any = true;
    return any;
  }
  static bool is_symbol(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' ||
           static_cast<unsigned char>(c) >= 0x80U;
  }
  bool at_superscript() const {
    return rest_.starts_with("\u00b2") || rest_.starts_with("\u00b3") ||
           rest_.starts_with("\u00b7") || rest_.starts_with("\u00a0");
  }

  void factor(int sign) {
    const std::string_view from = rest_;
    while (!rest_.empty() && is_symbol(rest_.front()) && !at_superscript()) rest_.remove_prefix(1);
    const std::string_view symbol = from.substr(0, from.size() - rest_.size());
    if (symbol.empty()) {
      fail(from.empty() ? "ends where a unit is expected"
                        : "has `" + printable(from) + "` where a unit is expected");
    }
    const int power = sign * exponent();
    for (const Unit& unit : unit_table) {
      int prefix = 0;
      if (!matches(unit, symbol, prefix)) continue;
      dimension_.mass += power * unit.dimension.mass;
      dimension_.length += power * unit.dimension.length;
      dimension_.time += power * unit.dimension.time;
      dimension_.angle += power * unit.dimension.angle;
      decimal_exponent_ += power * (unit.decimal_exponent + prefix);
      if (unit.degrees) degrees_ += power;
      return;
    }
    fail("has the unknown unit `" + printable(symbol) + "`" + suggestion(symbol));
  }

  /// The exponent behind a symbol: "^2", "^-2", "2" as in kg/m3, a superscript, or none.
  int exponent() {
    if (take("\u00b2")) return 2;
    if (take("\u00b3")) return 3;
    const bool caret = take("^");
    const bool negative = caret && take("-");
    if (rest_.empty() || rest_.front() < '0' || rest_.front() > '9') {
      if (caret) fail("has no whole number behind `^`");
      return 1;
    }
    const int digit = rest_.front() - '0';
    rest_.remove_prefix(1);
    if (digit == 0 || (!rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'))
      fail("has an exponent outside 1 to 9");
    return negative ? -digit : digit;
  }

  static bool matches(const Unit& unit, std::string_view symbol, int& prefix) {
    if (symbol == unit.symbol) return true;
    if (!symbol.ends_with(unit.symbol)) return false;
    std::string_view front = symbol.substr(0, symbol.size() - unit.symbol.size());
    if (front == "\u00b5" || front == "\u03bc") front = "u";  // micro sign, Greek mu
    if (front.size() != 1 || unit.prefixes.find(front.front()) == std::string_view::npos)
      return false;
    prefix = decimal_exponent_of_prefix(front.front());
    return true;
  }

  /// Units are case sensitive (m and M, mN and MN), which is the usual slip: "kpa", "KN", "GPA".
  static std::string suggestion(std::string_view symbol) {
    const auto lower = [](std::string_view text) {
      std::string result(text);
      for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      return result;
    };
    for (const Unit& unit : unit_table) {
      if (lower(symbol) == lower(unit.symbol))
        return ", did you mean `" + std::string(unit.symbol) + "`?";
      for (const char prefix : unit.prefixes) {
        const std::string candidate = prefix + std::string(unit.symbol);
        if (lower(symbol) == lower(candidate)) return ", did you mean `" + candidate + "`?";
      }
    }
    const std::string word = lower(symbol);
    if (word == "degree" || word == "degrees") return ", did you mean `deg`?";
    if (word == "meter" || word == "metre" || word == "meters" || word == "metres")
      return ", did you mean `m`?";
    return "";
  }

  std::string_view whole_, rest_;
  Dimension dimension_;
  int decimal_exponent_ = 0;
  int degrees_ = 0;
};

}  // namespace detail

/// "a length, such as "4 m", "10 cm" or "28 mm"": what to write for a quantity of this dimension.
[[nodiscard]] inline std::string accepted_examples(const Dimension& dimension) {
  const detail::DimensionWords* words = detail::find_words(dimension);
  if (words == nullptr) return "a quantity in " + detail::base_units(dimension);
  return std::string(words->name) + ", such as " + std::string(words->examples);
}

/// Reads a number and its unit, of whatever dimension.
///
/// Units: m g t s rad deg N Pa bar J % with the prefixes in use (mm, cm, km, kg, kN, MPa, GPa ...);
/// products with `*` or a space, quotients with `/`, exponents as m^2, m2 or superscript. The
/// decimal sign is a point under every locale.
///
/// @throws UnitError  no number, no unit, unknown unit, text behind the unit, NaN, or too large for
///                    a double; the message then holds no accepted examples
[[nodiscard]] inline Quantity parse_quantity(std::string_view text,
                                             Infinity infinity = Infinity::refused) {
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

  detail::UnitParser unit(text, rest);
  unit.run();
  const double value = unit.to_si(number);
  if (std::isinf(value) && infinity == Infinity::refused) fail("is outside the range of numbers");
  return {value, unit.dimension()};
}

/// Reads a quantity of a known dimension into SI, angles in rad.
///
/// @param infinity  `allowed` takes "inf" (no unit needed: no unit would change it)
/// @throws UnitError  as above, and a dimension other than the expected one; the message says what
///                    was found and shows accepted examples
[[nodiscard]] inline double parse_quantity(std::string_view text, const Dimension& expected,
                                           Infinity infinity = Infinity::refused) {
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

/// Writes an SI value in the unit an engineer expects: 5e9 Pa/m as "5 GPa/m", 0.61 rad as
/// "34.9504 deg". Six significant digits, for reading; not for storing. Infinity is "inf".
[[nodiscard]] inline std::string format_quantity(double value, const Dimension& dimension) {
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
  std::array<char, 32> buffer{};
  const auto [end, status] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                           std::chars_format::general, 6);
  (void)status;  // 32 characters hold every %.6g
  return std::string(buffer.data(), end) + " " + std::string(unit);
}

}  // namespace voussoir
