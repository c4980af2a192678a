// SPDX-License-Identifier: MIT
#include "distribution_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <voussoir/core/units.hpp>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir::program {

namespace {

constexpr int digits_of_values = 7;

/// What stands behind the number of a quantity: "deg" of "35 deg".
std::string unit_of(std::string_view text) {
  const std::size_t begin = text.find_first_not_of("0123456789.+- \t");
  if (begin == std::string_view::npos) return "";
  std::string_view unit = text.substr(begin);
  // 5e9 Pa/m: the exponent is of the number.
  if ((unit.front() == 'e' || unit.front() == 'E') && unit.size() > 1 &&
      std::string_view("0123456789+-").find(unit[1]) != std::string_view::npos)
    return unit_of(unit.substr(1));
  while (!unit.empty() && (unit.back() == ' ' || unit.back() == '\t')) unit.remove_suffix(1);
  return std::string(unit);
}

/// The number in front of it.
double number_of(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t+"), text.size()));
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// The parts of a distribution as they are read.
struct Parts {
  const Node& table;
  const std::string& key;
  const RefuseDistribution& refuse;
  std::string unit = {};
  double one = 1;  ///< of the unit, in SI
  Dimension dimension = {};
  std::map<std::string, double, std::less<>> values = {};  ///< in that unit
  bool is_sound = true;

  [[nodiscard]] std::string full(const std::string& name) const { return key + "." + name; }
  /// A value as it stands in the file, or as it was read from an override.
  [[nodiscard]] static std::string written(const Node& part) {
    if (!part.written.empty()) return printable(part.written);
    if (part.kind == Node::Kind::text) {
      std::string quoted(1, '"');
      return quoted.append(printable(part.text)).append(1, '"');
    }
    const bool is_number = part.kind == Node::Kind::integer || part.kind == Node::Kind::real;
    return is_number ? shortest_text(part.real) : "...";
  }
  void complain(const std::string& name, const std::string& complaint,
                const std::string& accepted = distribution_form) {
    is_sound = false;
    const Node* const part = name.empty() ? nullptr : table.find(name);
    const std::string of =
        part == nullptr ? key + (table.written.empty() ? "" : " = " + printable(table.written))
                        : full(name) + " = " + written(*part);
    refuse(part == nullptr ? table.place : part->place, name.empty() ? key : full(name),
           of + " " + complaint, accepted);
  }

  /// @return  whether the part is there and sound
  bool read(const std::string& name) {
    const Node* const part = table.find(name);
    if (part == nullptr) return false;
    double si = 0;
    if (part->kind == Node::Kind::integer || part->kind == Node::Kind::real) {
      if (!std::isfinite(part->real)) return complain(name, "is not finite"), false;
      if (!values.empty() && !unit.empty()) return complain(name, "has no unit"), false;
      values[name] = part->real;
      return true;
    }
    if (part->kind != Node::Kind::text)
      return complain(name, "is neither a number nor a quantity"), false;
    Dimension found;
    try {
      const Quantity quantity = parse_quantity(part->text);
      si = quantity.value;
      found = quantity.dimension;
    } catch (const UnitError& error) {
      return complain(name, error.complaint()), false;
    }
    if (values.empty()) {
      unit = unit_of(part->text);
      dimension = found;
      one = parse_quantity("1 " + unit).value;
    } else if (unit.empty() || dimension != found) {
      return complain(name, "has another dimension than the other values of the distribution"),
             false;
    }
    // 0.035 / (pi / 180) need not be 2: a value written in the unit is read as it stands.
    values[name] = unit_of(part->text) == unit ? number_of(part->text) : si / one;
    return true;
  }
  [[nodiscard]] std::optional<double> at(std::string_view name) const {
    const auto value = values.find(name);
    return value == values.end() ? std::nullopt : std::optional(value->second);
  }
};

}  // namespace

const char* const distribution_form =
    R"({mean, sd} normal, {mean, sd, distribution = "lognormal"}, either with min and max where it is cut off; {min, max} uniform; {min, mode, max} triangular)";

const std::vector<std::string>& UncertainKey::names() {
  static const std::vector<std::string> all{"mean", "sd", "min", "max", "mode", "distribution"};
  return all;
}

double UncertainKey::value_at(double probability) const {
  const double value = distribution.quantile(probability);
  const double rounded = number_of(significant_text(value, digits_of_values));
  return std::clamp(rounded, distribution.low(), distribution.high());
}

std::string UncertainKey::text_of(double value) const {
  const std::string number = shortest_text(value);
  return unit.empty() ? number : number + " " + unit;
}

std::string UncertainKey::text_at(double probability) const {
  return text_of(value_at(probability));
}

std::optional<UncertainKey> uncertain_key(const Node& table, const std::string& key,
                                          const RefuseDistribution& refuse) {
  Parts parts{table, key, refuse};
  const auto& names = UncertainKey::names();
  for (const Entry& entry : table.table)
    if (std::find(names.begin(), names.end(), entry.key) == names.end()) {
      const std::string guess = closest(entry.key, names);
      parts.is_sound = false;
      refuse(entry.place, key + "." + entry.key,
             "unknown key `" + printable(entry.key) + "` in the distribution of " + key +
                 (guess.empty() ? "" : ", did you mean `" + guess + "`?"),
             distribution_form);
    }
  for (const char* const name : {"mean", "mode", "min", "max", "sd"}) (void)parts.read(name);
  using Kind = BoundedDistribution::Kind;
  const auto mean = parts.at("mean"), sd = parts.at("sd"), low = parts.at("min"),
             high = parts.at("max"), mode = parts.at("mode");
  const auto has = [&](const char* name) { return table.find(name) != nullptr; };
  Kind kind = has("mean") || has("sd") ? Kind::normal
              : has("mode")            ? Kind::triangular
                                       : Kind::uniform;
  if (const Node* const word = table.find("distribution")) {
    const std::map<std::string, Kind, std::less<>> kinds{{"normal", Kind::normal},
                                                         {"lognormal", Kind::lognormal},
                                                         {"uniform", Kind::uniform},
                                                         {"triangular", Kind::triangular}};
    const auto found = kinds.find(word->text);
    if (word->kind != Node::Kind::text || found == kinds.end())
      parts.complain("distribution", "is none that is known",
                     R"("normal", "lognormal", "uniform", "triangular")");
    else
      kind = found->second;
  }
  if (!parts.is_sound) return std::nullopt;
  const bool is_bell = kind == Kind::normal || kind == Kind::lognormal;
  std::vector<std::string> needed = is_bell ? std::vector<std::string>{"mean", "sd"}
                                    : kind == Kind::triangular
                                        ? std::vector<std::string>{"min", "mode", "max"}
                                        : std::vector<std::string>{"min", "max"};
  for (const std::string& name : needed)
    if (!has(name.c_str())) parts.complain("", "lacks " + name);
  for (const char* const name : {"mean", "sd", "mode"})
    if (has(name) && std::find(needed.begin(), needed.end(), name) == needed.end())
      parts.complain(name, "does not belong to this distribution");
  if (!parts.is_sound) return std::nullopt;
  if (sd && !(*sd > 0)) parts.complain("sd", "is not above 0", "above 0");
  if (kind == Kind::lognormal && mean && !(*mean > 0))
    parts.complain("mean", "is not above 0, as a lognormal one is", "above 0");
  if (kind == Kind::lognormal && low && !(*low >= 0))
    parts.complain("min", "is below 0, as no lognormal value is", "0 or more");
  const auto text = [&](double value) {
    return shortest_text(value) + (parts.unit.empty() ? "" : " " + parts.unit);
  };
  if (low && high && !(*low < *high))
    parts.complain("min", "is not below max = " + text(*high), "below " + text(*high));
  for (const auto& [name, centre] : {std::pair("mean", mean), std::pair("mode", mode)}) {
    if (!centre || !parts.is_sound) continue;
    if ((low && *centre < *low) || (high && *centre > *high))
      parts.complain(
          name, "lies outside of min and max",
          "from " + (low ? text(*low) : "any value") + " to " + (high ? text(*high) : "any value"));
  }
  if (!parts.is_sound) return std::nullopt;
  try {
    const BoundedDistribution distribution =
        kind == Kind::normal      ? BoundedDistribution::normal(*mean, *sd, low, high)
        : kind == Kind::lognormal ? BoundedDistribution::lognormal(*mean, *sd, low, high)
        : kind == Kind::uniform   ? BoundedDistribution::uniform(*low, *high)
                                  : BoundedDistribution::triangular(*low, *mode, *high);
    std::string words = kind == Kind::normal      ? "normal"
                        : kind == Kind::lognormal ? "lognormal"
                        : kind == Kind::uniform   ? "uniform"
                                                  : "triangular";
    for (const auto& [name, value] :
         {std::pair("mean", mean), std::pair("sd", sd), std::pair("mode", mode),
          std::pair("min", low), std::pair("max", high)})
      if (value) words += std::string(", ") + name + " " + text(*value);
    return UncertainKey{key, parts.unit, words, distribution};
  } catch (const InvalidInput& error) {
    parts.complain("", std::string("is no distribution: ") + error.what());
    return std::nullopt;
  }
}

}  // namespace voussoir::program
