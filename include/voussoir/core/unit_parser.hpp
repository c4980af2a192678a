// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <voussoir/core/dimension.hpp>

namespace voussoir {

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

namespace detail {

/// A unit symbol: SI value = 10^decimal_exponent * (degrees ? pi/180 : 1) * factor. The power of
/// ten is kept apart because 7 / 100 is the double nearest to 0.07 and 7 * 0.01 is not.
struct Unit {
  std::string_view symbol;
  std::string_view prefixes;  ///< of k c m u M G T, those in use with this symbol
  Dimension dimension;
  int decimal_exponent = 0;
  bool degrees = false;
  double factor = 1;
};

inline constexpr std::array<Unit, 17> unit_table{{
    {"m", "kcmu", dimension::length},
    {"g", "km", dimension::mass, -3},
    {"t", "k", dimension::mass, 3},
    {"s", "mu", dimension::time},
    {"min", "", dimension::time, 0, false, 60},
    {"h", "", dimension::time, 0, false, 3600},
    {"d", "", dimension::time, 0, false, 86400},
    {"a", "", dimension::time, 0, false, 31557600},  // of 365.25 days
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

/// A unit outside of SI that is in use. Read it is not: `t` may be a ton and `in` a word; what it
/// comes to is said.
struct ForeignUnit {
  std::string_view symbol;
  double value;  ///< in `unit`
  std::string_view unit;
};

inline constexpr std::array<ForeignUnit, 18> foreign_units{{
    {"ft", 0.3048, "m"},
    {"feet", 0.3048, "m"},
    {"in", 0.0254, "m"},
    {"inch", 0.0254, "m"},
    {"yd", 0.9144, "m"},
    {"psi", 6.894757293168, "kPa"},
    {"ksi", 6.894757293168, "MPa"},
    {"psf", 47.88025898034, "Pa"},
    {"pcf", 16.01846337396, "kg/m^3"},
    {"lb", 0.45359237, "kg"},
    {"lbs", 0.45359237, "kg"},
    {"lbf", 4.4482216152605, "N"},
    {"kip", 4.4482216152605, "kN"},
    {"kips", 4.4482216152605, "kN"},
    {"kgf", 9.80665, "N"},
    {"tf", 9.80665, "kN"},
    {"gon", 0.9, "deg"},
    {"grad", 0.9, "deg"},
}};

inline const ForeignUnit* find_foreign(std::string_view symbol) {
  for (const ForeignUnit& unit : foreign_units)
    if (unit.symbol == symbol) return &unit;
  return nullptr;
}

/// `value` with so many significant digits at most.
inline std::string short_number(double value, int digits) {
  std::array<char, 32> buffer{};
  const auto [end, status] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                           std::chars_format::general, digits);
  (void)status;  // 32 characters hold every %.15g
  return {buffer.data(), end};
}

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

/// `value` times 10^exponent, rounded once for |exponent| <= 22 (those powers are exact doubles).
inline double scale_by_ten(double value, int exponent) {
  double power = 1;
  for (int k = 0; k < std::abs(exponent); ++k) power *= 10;
  return exponent >= 0 ? value * power : value / power;
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
    return value * times_ / over_;
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
      for (int k = 0; k < std::abs(power); ++k) (power > 0 ? times_ : over_) *= unit.factor;
      return;
    }
    if (const ForeignUnit* foreign = find_foreign(symbol))
      fail("has the unit `" + std::string(symbol) + "`, which is " +
           short_number(foreign->value, 7) + " " + std::string(foreign->unit));
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
    for (const auto& [name, unit] : {std::pair{"day", "d"}, std::pair{"hour", "h"},
                                     std::pair{"minute", "min"}, std::pair{"year", "a"}})
      if (word == name || word == std::string(name) + "s")
        return std::string(", did you mean `") + unit + "`?";
    return "";
  }

  std::string_view whole_, rest_;
  Dimension dimension_;
  int decimal_exponent_ = 0;
  int degrees_ = 0;
  double times_ = 1, over_ = 1;  ///< of units of time, which are no powers of ten
};

}  // namespace detail

}  // namespace voussoir
