// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/rockmass/detail/orientation_table.hpp>
#include <voussoir/rockmass/detail/quadrant_angle.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

/// A plane in one field, "N45E/60SE" or "202/52", as two fields; nothing if it is not two parts.
/// The sign between them is a stroke, a comma that is no decimal one, or the blank before the
/// second number.
[[nodiscard]] VOUSSOIR_INLINE std::optional<std::pair<TraceField, TraceField>> parts_of_pair(
    const TraceField& field);

/// Makes two columns of one whose fields hold a plane, where no other columns name one: of
/// "Strike/Dip" or "Dip direction/Dip", whose order is that of the name, and of "Orientation" and
/// the like, which is a strike and a dip by their letters.
/// @param names  of the columns; gets one more
/// @param next   fields of the line that follows: a title is no header, even if it names two angles
VOUSSOIR_INLINE void divide_pair_column(OrientationLayout& layout, std::vector<std::string>& names,
                                        const std::vector<TraceField>& next);

/// Divides the field of a row that holds a plane. An empty one makes two that are empty.
/// @return  what is wrong with it, from "field 1" on, and what is accepted; empty: nothing
[[nodiscard]] VOUSSOIR_INLINE std::pair<std::string, std::string> divide_pair_field(
    const OrientationLayout& layout, std::vector<TraceField>& fields);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<std::pair<TraceField, TraceField>> parts_of_pair(
    const TraceField& field) {
  const std::string& text = field.text;
  const auto is_digit = [&](std::size_t k) {
    return k < text.size() && text[k] >= '0' && text[k] <= '9';
  };
  std::size_t sign = text.find('/');
  for (std::size_t k = 0; k < text.size() && sign == std::string::npos; ++k)
    if (text[k] == ',' && !(k > 0 && is_digit(k - 1) && is_digit(k + 1))) sign = k;
  // "N 45 E" is one angle: its number is no dip.
  const auto is_bearing_begun = [&](std::size_t k) {
    const auto letters = compass_letters(text.substr(0, k));
    return letters == "N" || letters == "S";
  };
  for (std::size_t k = text.size(); k-- > 1 && sign == std::string::npos;)
    if (text[k] == ' ' && is_digit(k + 1) && !is_bearing_begun(k)) sign = k;
  if (sign == std::string::npos) return std::nullopt;
  std::size_t second = sign + 1;
  while (second < text.size() && text[second] == ' ') ++second;
  TraceField first{std::string(trimmed(std::string_view(text).substr(0, sign))), field.column},
      last{std::string(trimmed(std::string_view(text).substr(second))), field.column + second};
  if (first.text.empty() || last.text.empty()) return std::nullopt;
  return std::pair(std::move(first), std::move(last));
}

/// The two names in the name of a column, "Strike" and "Dip" of "Strike/Dip"; nothing if it is not
/// a dip and its direction or strike. What stands in brackets behind both is of both, a rule of the
/// strike alone.
[[nodiscard]] VOUSSOIR_INLINE std::optional<std::pair<std::string, std::string>> names_in_pair(
    const std::string& name) {
  const auto column_of = [](const std::string& part) {
    bool is_weak = false;
    return orientation_column(header_word(part), is_weak);
  };
  const std::size_t open = name.find_first_of("([");
  const std::string whole(trimmed(std::string_view(name).substr(0, open))),
      remark = open == std::string::npos ? "" : name.substr(open);
  const bool is_rule = [&] {
    const std::string letters = " " + letters_of(lower(remark)) + " ";
    return letters.size() > 2 && (right_hand_rules.find(letters) != std::string_view::npos ||
                                  left_hand_rules.find(letters) != std::string_view::npos);
  }();
  for (const std::string_view sign : {"/", "&", " and ", " und ", " et ", " y "}) {
    const std::size_t at = lower(whole).find(sign);
    if (at == std::string::npos) continue;
    std::string first(trimmed(std::string_view(whole).substr(0, at))),
        second(trimmed(std::string_view(whole).substr(at + sign.size())));
    const OrientationColumn columns[] = {column_of(first), column_of(second)};
    const auto is_azimuth = [&](OrientationColumn column) {
      return column == OrientationColumn::direction || column == OrientationColumn::strike ||
             column == OrientationColumn::right_strike;
    };
    const bool dip_first = columns[0] == OrientationColumn::dip && is_azimuth(columns[1]),
               dip_last = columns[1] == OrientationColumn::dip && is_azimuth(columns[0]);
    if (!dip_first && !dip_last) continue;
    if (!is_rule || dip_last) first += remark.empty() ? "" : " " + remark;
    if (!is_rule || dip_first) second += remark.empty() ? "" : " " + remark;
    return std::pair(std::move(first), std::move(second));
  }
  return std::nullopt;
}

VOUSSOIR_INLINE void divide_pair_column(OrientationLayout& layout, std::vector<std::string>& names,
                                        const std::vector<TraceField>& next) {
  using enum OrientationColumn;
  const auto column_of = [](const std::string& name) {
    bool is_weak = false;
    return orientation_column(header_word(name), is_weak);
  };
  for (const std::string& name : names)
    if (const OrientationColumn column = column_of(name);
        column != other && column != set && column != weight)
      return;
  constexpr std::string_view known =
      " orientation orientations attitude attitudes strikedip plane planes planeorientation "
      "jointorientation quadrant orientierung orientacion orientamento giacitura ";
  for (std::size_t k = 0; k < names.size() && k < next.size(); ++k) {
    const std::string word = header_word(names[k]).name;
    auto pair = names_in_pair(names[k]);
    const bool has_order = pair.has_value();
    if (!pair && !word.empty() && known.find(" " + word + " ") != std::string_view::npos)
      pair = std::pair("strike", "dip");
    if (!pair || !parts_of_pair(next[k])) continue;
    layout.pair = k;
    layout.pair_has_order = has_order;
    layout.pair_name = names[k];
    names[k] = pair->first;
    names.insert(names.begin() + static_cast<std::ptrdiff_t>(k) + 1, pair->second);
    return;
  }
}

VOUSSOIR_INLINE std::pair<std::string, std::string> divide_pair_field(
    const OrientationLayout& layout, std::vector<TraceField>& fields) {
  if (!layout.pair || *layout.pair >= fields.size()) return {};
  const auto at = fields.begin() + static_cast<std::ptrdiff_t>(*layout.pair);
  const std::string name = "field " + std::to_string(*layout.pair + 1) + " (column " +
                           std::to_string(at->column) + ", \"" + shown(at->text) + "\") ",
                    order = "\"" + shown(layout.pair_name) + "\"",
                    letters = "strike and dip with letters, as N45E/60SE or 045/60SE";
  auto parts = at->text.empty() ? std::optional(std::pair(*at, *at)) : parts_of_pair(*at);
  if (!parts)
    return {
        name + "is not two angles",
        layout.pair_has_order ? order + " with a stroke between, as 45/120 or N45E/60SE" : letters};
  // Two numbers are a dip and a dip direction to one half of the trade, and the other way round,
  // or a strike and a dip, to the other.
  if (!layout.pair_has_order && !at->text.empty() && !quadrant_text(parts->first.text) &&
      !quadrant_text(parts->second.text))
    return {
        name +
            "is two numbers: which of them is the dip, and is the other a strike or a dip "
            "direction? The name of the column, " +
            order + ", does not say",
        "a column named dip/dip direction, dip direction/dip or strike/dip (RHR); or " + letters};
  *at = std::move(parts->first);
  fields.insert(at + 1, std::move(parts->second));
  return {};
}

#endif

}  // namespace voussoir::detail
