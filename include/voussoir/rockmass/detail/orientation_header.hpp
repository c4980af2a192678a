// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/rockmass/detail/bounded_lines.hpp>
#include <voussoir/rockmass/detail/orientation_pair.hpp>
#include <voussoir/rockmass/detail/orientation_table.hpp>
#include <voussoir/rockmass/detail/quadrant_angle.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

/// The layout of a table by its first lines; those before the header are skipped.
/// @param right_handed  a strike without a rule has the dip to its right
/// @param data          gets the index of the first line that may be data
/// @throws InvalidInput  the header names no plane, one thing twice, or units that do not fit
[[nodiscard]] VOUSSOIR_INLINE OrientationLayout
orientation_layout(const std::vector<std::string>& lines, bool right_handed, TraceFaults& faults,
                   std::size_t& data);

#if VOUSSOIR_BODIES

/// The columns that a line names.
/// @param next  the line that follows: where blanks separate and the header has more fields, "dip
///              direction" is one name
[[nodiscard]] VOUSSOIR_INLINE OrientationLayout header_of(const std::string& line, char told,
                                                          const std::string& next) {
  std::string joined = line;  // "dip [deg]" is one name where blanks separate, too
  for (const char* open : {" [", " ("})
    for (std::size_t at; (at = joined.find(open)) != std::string::npos;) joined.erase(at, 1);
  OrientationLayout layout;
  layout.separator = told != 0 ? told : separator_of(joined);
  if (layout.separator == ' ' && names_in_pair(line)) layout.separator = ',';  // of one column
  if (layout.separator != ' ') joined = line;
  std::vector<std::string> names;
  for (const TraceField& field : fields_of(joined, layout.separator)) names.push_back(field.text);
  const std::vector<TraceField> below = fields_of(next, layout.separator);
  const std::size_t width = below.size();
  for (std::size_t k = 0; layout.separator == ' ' && names.size() > width && k + 1 < names.size();
       ++k) {
    const std::string pair =
        " " + header_word(names[k]).name + "-" + header_word(names[k + 1]).name + " ";
    constexpr std::string_view known =
        " dip-direction dip-dir dip-dirn dip-azimuth dip-angle strike-rhr strike-right pole-trend "
        "pole-plunge pole-azimuth normal-trend normal-plunge trend-pole plunge-pole joint-set "
        "set-no set-nr set-id set-name set-number ";
    if (known.find(pair) == std::string_view::npos) continue;
    names[k] += " " + names[k + 1];
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  }
  divide_pair_column(layout, names, below);
  std::vector<bool> weak;
  bool has_easting = false;
  for (const std::string& name : names) {
    bool is_weak = false;
    const HeaderWord word = header_word(name);
    layout.columns.push_back(orientation_column(word, is_weak));
    weak.push_back(is_weak);
    has_easting = has_easting || column_named(word.name) == TraceColumn::x;
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    // A dip direction beside an azimuth, of the scanline; n, the northing beside an easting.
    OrientationColumn& column = layout.columns[k];
    const bool is_northing = column == OrientationColumn::weight && has_easting;
    if (weak[k] && (is_northing || layout.count(column) > 1)) column = OrientationColumn::other;
    // An azimuth beside a plunge is that of the line.
    if (weak[k] && column == OrientationColumn::direction &&
        layout.count(OrientationColumn::plunge) > 0 && layout.count(OrientationColumn::dip) == 0)
      column = OrientationColumn::trend;
  }
  layout.names = std::move(names);
  return layout;
}

[[nodiscard]] VOUSSOIR_INLINE bool is_angle(OrientationColumn column) {
  using enum OrientationColumn;
  return column != other && column != set && column != weight;
}

/// The unit that a field of a line of units has, "deg" of "[deg]", "(deg)" or "deg"; or empty.
[[nodiscard]] VOUSSOIR_INLINE std::string unit_in(const std::string& field) {
  const HeaderWord word = header_word("angle " + field);
  return word.remarks.empty() ? "" : word.remarks.back();
}

/// Whether a line below the header has units for all angles, as some programs write them there.
[[nodiscard]] VOUSSOIR_INLINE bool is_line_of_units(const OrientationLayout& layout,
                                                    const std::vector<TraceField>& fields) {
  if (fields.size() > layout.columns.size()) return false;
  for (std::size_t k = 0; k < layout.columns.size(); ++k)
    if (is_angle(layout.columns[k]) && (k >= fields.size() || unit_in(fields[k].text).empty()))
      return false;
  return true;
}

/// One unit for all angles, by what stands beside their names or in a line of units below.
VOUSSOIR_INLINE void read_angle_units(OrientationLayout& layout, const std::string& header,
                                      const std::vector<TraceField>& units, std::size_t number,
                                      TraceFaults& faults) {
  std::string unit_before;
  for (std::size_t k = 0; k < layout.columns.size(); ++k) {
    if (!is_angle(layout.columns[k])) continue;
    std::vector<std::string> remarks = header_word(layout.names[k]).remarks;
    if (k < units.size()) remarks.push_back(unit_in(units[k].text));
    for (const std::string& remark : remarks) {
      if (remark.empty()) continue;
      const auto [turn, unit] = turn_of(remark);
      if (turn != 0) {
        if (!unit_before.empty() && turn != layout.turn)
          faults.add(number, "units are mixed, " + unit_before + " and " + unit, header,
                     "one unit for all angles of a file");
        unit_before = layout.unit = unit;
        layout.turn = turn;
        continue;
      }
      const std::string word = " " + letters_of(remark) + " ";
      const auto is_one_of = [&](std::string_view known) {
        return word.size() > 2 && known.find(word) != std::string_view::npos;
      };
      if (is_one_of(" true truenorth tn grid gridnorth quadrant quadrants ")) continue;
      const OrientationColumn column = layout.columns[k];
      if (column == OrientationColumn::right_strike && is_one_of(right_hand_rules)) continue;
      if (column == OrientationColumn::strike && is_one_of(left_hand_rules)) continue;
      if ((column == OrientationColumn::pole_trend || column == OrientationColumn::pole_plunge) &&
          is_one_of(pole_words))
        continue;
      if (is_one_of(" magnetic mag magneticnorth mn "))
        layout.notes.push_back(shown(layout.names[k]) +
                               ": taken as it stands, no magnetic declination is added");
      else
        faults.add(number, "the unit \"" + shown(remark) + "\" of an angle is not known", header,
                   "deg, rad or gon (400 to the turn), in brackets");
    }
  }
}

/// Whether there is a dip with a direction or with a strike.
[[nodiscard]] VOUSSOIR_INLINE bool names_plane(const OrientationLayout& layout) {
  using enum OrientationColumn;
  return layout.count(dip) > 0 &&
         layout.count(direction) + layout.count(strike) + layout.count(right_strike) > 0;
}

/// Whether there are a trend and a plunge, one of which at least is told to be of a pole.
[[nodiscard]] VOUSSOIR_INLINE bool names_pole(const OrientationLayout& layout) {
  using enum OrientationColumn;
  const std::size_t told = layout.count(pole_trend) + layout.count(pole_plunge);
  return told > 0 && layout.count(trend) + layout.count(pole_trend) > 0 &&
         layout.count(plunge) + layout.count(pole_plunge) > 0;
}

/// Leaves of a header the columns that make a plane: one way of the two or three that it has.
VOUSSOIR_INLINE void choose_orientation_columns(OrientationLayout& layout, bool right_handed) {
  using enum OrientationColumn;
  const auto turn_into = [&](OrientationColumn from, OrientationColumn to) {
    for (OrientationColumn& column : layout.columns)
      if (column == from) column = to;
  };
  // Programs write the strike beside the dip direction: one of them is enough.
  if (layout.count(direction) > 0) turn_into(right_strike, other);
  if (layout.count(direction) > 0 || layout.count(right_strike) > 0) turn_into(strike, other);
  if (right_handed) turn_into(strike, right_strike);
  const bool has_both = layout.count(pole_trend) > 0 && layout.count(pole_plunge) > 0;
  const bool by_plane = names_plane(layout) && !(layout.count(strike) > 0 && has_both);
  if (by_plane) {  // a line beside a plane may be the slip on it
    for (const OrientationColumn line : {trend, plunge, pole_trend, pole_plunge})
      turn_into(line, other);
  } else if (names_pole(layout)) {
    for (const OrientationColumn of_plane : {dip, direction, strike, right_strike})
      turn_into(of_plane, other);
    turn_into(trend, layout.count(pole_trend) > 0 ? other : pole_trend);
    turn_into(plunge, layout.count(pole_plunge) > 0 ? other : pole_plunge);
  }
}

/// Refuses what a header lacks and what it has twice; leaves the columns that make a plane.
VOUSSOIR_INLINE void check_orientation_columns(OrientationLayout& layout, bool right_handed,
                                               const std::string& header, std::size_t number,
                                               TraceFaults& faults) {
  using enum OrientationColumn;
  choose_orientation_columns(layout, right_handed);
  const std::size_t trends = layout.count(trend) + layout.count(pole_trend),
                    plunges = layout.count(plunge) + layout.count(pole_plunge);
  if (!names_plane(layout) && !names_pole(layout)) {
    const bool has_direction =
        layout.count(direction) + layout.count(strike) + layout.count(right_strike) > 0;
    if (trends > 0 && plunges > 0)
      faults.add(number, "trend and plunge of a line: is it the pole of the plane or a lineation?",
                 header,
                 "of poles (normals) columns named pole trend and pole plunge; lineations are not "
                 "read");
    else if (layout.count(pole_trend) + layout.count(pole_plunge) > 0)
      faults.add(
          number,
          trends > 0 ? "a pole's trend without its plunge" : "a pole's plunge without its trend",
          header, orientation_names);
    else if (!has_direction)
      faults.add(number, "a dip without a direction", header, orientation_names);
    else
      faults.add(number, "a direction without a dip", header, orientation_names);
  }
  for (std::size_t k = 0; k < layout.columns.size(); ++k) {
    const OrientationColumn column = layout.columns[k];
    if (column != other && layout.count(column) > 1)
      faults.add(number, "two columns mean the same, \"" + shown(layout.names[k]) + "\"", header,
                 orientation_names);
  }
  faults.finish();
}

VOUSSOIR_INLINE OrientationLayout orientation_layout(const std::vector<std::string>& lines,
                                                     bool right_handed, TraceFaults& faults,
                                                     std::size_t& data) {
  using enum OrientationColumn;
  char told = 0;  // "sep=;", as spreadsheets write and read it
  std::optional<std::size_t> first, half;
  OrientationLayout layout, half_layout;
  std::vector<std::string> skipped;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string low = lower(trimmed(lines[k]));
    if (low.starts_with("sep=") && low.size() == 5) {
      told = low[4];
      continue;
    }
    if (is_orientation_comment(lines[k])) continue;
    if (!first) first = k;
    std::size_t below = k + 1;
    while (below < lines.size() && is_orientation_comment(lines[below])) ++below;
    OrientationLayout tried =
        header_of(lines[k], told, below < lines.size() ? lines[below] : std::string());
    if (names_plane(tried) || names_pole(tried)) {
      layout = std::move(tried);
      layout.has_header = true;
      data = k + 1;
      break;
    }
    const bool has_line = tried.count(trend) > 0 && tried.count(plunge) > 0;
    if (has_line || tried.count(dip) + tried.count(direction) + tried.count(strike) +
                            tried.count(right_strike) + tried.count(pole_trend) +
                            tried.count(pole_plunge) >
                        0) {
      half = k;
      half_layout = std::move(tried);
    }
    skipped.push_back(lines[k]);
  }
  if (!layout.has_header) {
    data = first.value_or(lines.size());
    if (half) check_orientation_columns(half_layout, right_handed, lines[*half], *half + 1, faults);
    if (!first) return layout;
    const std::vector<TraceField> words =
        fields_of(lines[*first], told != 0 ? told : orientation_separator(lines[*first]));
    const bool is_header = std::none_of(words.begin(), words.end(), [](const TraceField& field) {
      return written_number(field.text).fault.empty() || quadrant_text(field.text) ||
             parts_of_pair(field);
    });
    if (is_header) {  // every row would lack its columns
      faults.add(*first + 1, "the header names neither a dip nor a direction", lines[*first],
                 orientation_names);
      faults.finish();
    }
    layout.separator = told != 0 ? told : orientation_separator(lines[*first]);
    layout.columns = {dip, direction};
    return layout;
  }
  if (!skipped.empty())
    layout.notes.push_back(std::to_string(skipped.size()) +
                           " lines before the header are skipped, from \"" +
                           shown(skipped.front()) + "\" on");
  const std::string header = lines[data - 1];
  const std::size_t number = data;
  layout.header = header;
  layout.header_line = number;
  check_orientation_columns(layout, right_handed, header, number, faults);
  std::vector<TraceField> units;
  if (data < lines.size()) units = fields_of(lines[data], layout.separator);
  if (layout.pair && *layout.pair < units.size())  // one unit for both
    units.insert(units.begin() + static_cast<std::ptrdiff_t>(*layout.pair), units[*layout.pair]);
  if (!is_line_of_units(layout, units))
    units.clear();
  else
    ++data;
  read_angle_units(layout, header, units, number, faults);
  faults.finish();
  return layout;
}

#endif

}  // namespace voussoir::detail
