// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <istream>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/rockmass/detail/bounded_lines.hpp>
#include <voussoir/rockmass/detail/orientation_header.hpp>
#include <voussoir/rockmass/detail/orientation_pair.hpp>
#include <voussoir/rockmass/detail/orientation_plane.hpp>
#include <voussoir/rockmass/detail/orientation_table.hpp>
#include <voussoir/rockmass/detail/quadrant_angle.hpp>
#include <voussoir/rockmass/detail/set_names.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>

namespace voussoir {

/// What a file of orientations may hold.
struct OrientationFileLimits {
  /// A column "strike" that tells no rule has the dip to the right of the strike.
  bool strike_is_right_handed = false;
  std::size_t planes = 1'000'000;     ///< rows of data
  std::size_t sets = 100;             ///< different names in the column of sets
  std::size_t line_length = 100'000;  ///< characters of a line
  std::size_t bytes = 256'000'000;    ///< of the whole file, comments included
};

/// What a file of orientations holds.
struct OrientationFile {
  std::vector<SurveyedPlane> planes;   ///< in the order of the file
  std::vector<std::string> set_names;  ///< as they appear; in order of value if all are numbers
  std::string layout;                  ///< how it was read, in words: separator, columns, unit
  std::vector<std::string> notes;      ///< what was not taken as it stands
};

namespace detail {

#if VOUSSOIR_BODIES

/// Reads one file of orientations: see `read_orientations`.
class OrientationReader {
 public:
  OrientationReader(std::istream& in, const std::string& name, const OrientationFileLimits& limits,
                    StopCheck& stop)
      : name_(name),
        limits_(limits),
        stop_(stop),
        faults_(name),
        lines_(in, name, {limits.line_length, limits.bytes}, stop) {}

  [[nodiscard]] OrientationFile read() {
    std::vector<std::string> first;
    std::string line;
    while (first.size() < looked_at && next(line)) first.push_back(line);
    std::size_t data = 0;
    layout_ = orientation_layout(first, limits_.strike_is_right_handed, faults_, data);
    file_.notes = layout_.notes;
    for (std::size_t k = data; k < first.size(); ++k) row(first[k], k + 1);
    while (next(line)) row(line, lines_.number());
    if (!layout_.has_header && !faults_.any()) place_columns();
    faults_.finish();
    if (file_.planes.empty())
      throw InvalidInput(name_ + ": holds no plane: " +
                         (lines_.number() == 0 ? std::string("it is empty")
                                               : std::to_string(lines_.number()) +
                                                     " lines, all empty, header or comment") +
                         "; accepted: " + orientation_names);
    name_sets();
    say();
    return std::move(file_);
  }

 private:
  static constexpr std::size_t looked_at = 50;  ///< lines among which the header is

  struct Pair {
    double first, second;
    std::size_t line;
  };

  bool next(std::string& line) {
    try {
      return lines_.next(line);
    } catch (const InvalidInput& error) {
      throw InvalidInput(about_orientations(error.what(), name_.size()));
    }
  }

  void row(const std::string& line, std::size_t number) {
    using enum OrientationColumn;
    stop_();
    if (is_orientation_comment(line)) return;
    std::vector<TraceField> fields = fields_of(line, layout_.separator);
    const auto [fault, forms] = divide_pair_field(layout_, fields);
    const std::size_t columns = layout_.columns.size();
    while (fields.size() > columns && fields.back().text.empty()) fields.pop_back();
    if (++rows_ > limits_.planes) {
      faults_.add(number, "plane number " + std::to_string(limits_.planes + 1), line,
                  "at most " + std::to_string(limits_.planes) + " planes");
      faults_.finish();
    }
    if (!fault.empty()) return faults_.add(number, fault, line, forms);
    std::size_t needed = 0;
    for (std::size_t k = 0; k < columns; ++k)
      if (layout_.columns[k] != other && layout_.columns[k] != set) needed = k + 1;
    if (fields.size() < needed || fields.size() > columns) {
      // As the line has them: one that was divided counts once.
      const bool is_divided = layout_.pair && *layout_.pair < fields.size();
      std::string what = std::to_string(fields.size() - (is_divided ? 1 : 0)) +
                         " fields instead of " + std::to_string(columns - (layout_.pair ? 1 : 0));
      if (layout_.separator == ',' && fields.size() == 2 * columns)
        what += ": are these decimal commas? Fields must then be separated by ;";
      else if (fields.size() < needed && separator_of(line) != layout_.separator)
        what += ": this line is separated otherwise than the first";
      else if (layout_.separator == ' ' &&
               std::any_of(fields.begin(), fields.end(),
                           [](const auto& f) { return azimuth_of_letters(f.text).has_value(); }))
        what += ": where blanks separate fields, N 45 E must be written N45E";
      std::string accepted =
          std::string("dip and dip direction, or a header: ") + orientation_names;
      if (layout_.has_header) accepted = "a field for each column of the header, which is: ";
      for (std::size_t k = 0; k < layout_.names.size(); ++k)
        if (!(layout_.pair && k == *layout_.pair + 1))
          accepted +=
              (k == 0 ? "" : ", ") + (layout_.pair == k ? layout_.pair_name : layout_.names[k]);
      return faults_.add(number, what, line, accepted);
    }
    const auto fall = angle(fields, tilt_column(), line, number),
               azimuth = angle(fields, azimuth_column(), line, number);
    SurveyedPlane surveyed;
    if (layout_.count(weight) > 0) {
      const auto read = value(fields, weight, fields[layout_.index(weight)].text, line, number);
      if (read && !(*read > 0))
        return faults_.add(number, "weight = " + shortest_text(*read), line, "a weight > 0");
      if (!read) return;
      surveyed.weight = *read;
    }
    if (layout_.count(set) > 0) surveyed.set = set_of(fields, line, number);
    if (!fall || !azimuth) return;
    if (layout_.has_header)
      add(*fall, *azimuth, surveyed, line, number);
    else
      pairs_.push_back({fall->value, azimuth->value, number});
  }

  /// The column of the dip, or of the plunge of the pole.
  [[nodiscard]] OrientationColumn tilt_column() const {
    using enum OrientationColumn;
    return layout_.count(dip) > 0 ? dip : pole_plunge;
  }

  [[nodiscard]] OrientationColumn azimuth_column() const {
    using enum OrientationColumn;
    for (const OrientationColumn column : {direction, right_strike, strike})
      if (layout_.count(column) > 0) return column;
    return pole_trend;
  }

  /// A number of degrees or in quadrant notation; nothing after a fault.
  [[nodiscard]] std::optional<WrittenAngle> angle(const std::vector<TraceField>& fields,
                                                  OrientationColumn column, const std::string& line,
                                                  std::size_t number) {
    using enum OrientationColumn;
    const TraceField& field = fields[layout_.index(column)];
    const auto parts = quadrant_text(field.text);
    const bool is_tilt = column == dip || column == pole_plunge;
    if (!parts || column == pole_plunge ||
        (column == dip && !parts->before.empty() && !parts->number.empty() && layout_.has_header)) {
      std::string_view text = field.text;
      if (layout_.turn == 360 && text.ends_with("\xC2\xB0")) text.remove_suffix(2);
      const auto read = value(fields, column, text, line, number);
      return read ? std::optional<WrittenAngle>({*read, false, ""}) : std::nullopt;
    }
    const std::string name = field_name(fields, column);
    const auto refuse = [&](const std::string& what, const std::string& accepted) {
      faults_.add(number, name + what, line, accepted);
      return std::nullopt;
    };
    if (!layout_.has_header)
      return refuse("is in quadrant notation, and there is no header",
                    std::string("a header: ") + orientation_names);
    if (layout_.turn != 360)
      return refuse("is in quadrant notation, which is in degrees; the header says " + layout_.unit,
                    "quadrant notation in a file of degrees");
    WrittenAngle read;
    if (is_tilt) {
      const auto side = azimuth_of_letters(parts->after);
      if (parts->number.empty()) return refuse("has no angle before its letters", forms_of(column));
      if (!side) return refuse("ends with no point of the compass", forms_of(column));
      read.side = parts->after;
    } else {
      const std::string fault =
          fault_of_bearing(*parts, column == strike || column == right_strike);
      if (!fault.empty()) return refuse(fault, forms_of(column));
      read.is_bearing = true;
    }
    if (parts->number.empty()) {
      read.value = azimuth_of_letters(parts->before.substr(0, 1)).value_or(0);
    } else {
      const auto written = value(fields, column, parts->number, line, number);
      if (!written) return std::nullopt;
      if (!is_tilt && *written > 90) return refuse("has an angle above 90", forms_of(column));
      read.value =
          is_tilt ? *written : azimuth_of_bearing(parts->before[0], *written, parts->after[0]);
    }
    return read;
  }

  [[nodiscard]] std::string field_name(const std::vector<TraceField>& fields,
                                       OrientationColumn column) const {
    const std::size_t k = layout_.index(column);
    const std::size_t divided = layout_.pair && k > *layout_.pair ? 1 : 0;
    return "field " + std::to_string(k + 1 - divided) + " (column " +
           std::to_string(fields[k].column) + ", \"" + shown(fields[k].text) + "\") ";
  }

  /// What a column may have, for messages.
  [[nodiscard]] std::string forms_of(OrientationColumn column) const {
    using enum OrientationColumn;
    std::string forms = "a number in each column of angles or weights";
    if (!layout_.has_header || layout_.turn != 360) return forms;
    if (column == dip) forms += ", a dip also with the side to which it is, as 60SE";
    if (column == strike || column == right_strike)
      forms += ", a strike also as N45E, S30W, N, E, NS or EW";
    if (column == direction || column == pole_trend) forms += ", a direction also as S45E";
    if (column == direction) forms += "; a side alone, SE, stands behind a dip beside its strike";
    return forms;
  }

  /// A number of a row; nothing after a fault.
  /// @param text  of the field, or of the number in it
  [[nodiscard]] std::optional<double> value(const std::vector<TraceField>& fields,
                                            OrientationColumn column, std::string_view text,
                                            const std::string& line, std::size_t number) {
    WrittenNumber read = written_number(text);
    const std::string field = field_name(fields, column);
    for (const auto& [trace, angle] : {std::pair("x1 [m]", "dip [deg]"), {"512291.5", "45.5"}})
      if (const std::size_t at = read.fault.find(trace); at != std::string::npos)
        read.fault.replace(at, std::string_view(trace).size(), angle);
    if (!read.fault.empty()) {
      faults_.add(number, field + read.fault, line, forms_of(column));
      return std::nullopt;
    }
    if (read.has_comma && comma_line_ == 0) comma_line_ = number;
    if (read.has_point && point_line_ == 0) point_line_ = number;
    if ((read.has_comma || read.has_point) && comma_line_ != 0 && point_line_ != 0) {
      faults_.add(number,
                  field + "has a decimal " + (read.has_comma ? "comma" : "point") + ", line " +
                      std::to_string(read.has_comma ? point_line_ : comma_line_) + " a decimal " +
                      (read.has_comma ? "point" : "comma"),
                  line, "one decimal sign in all of the file");
      return std::nullopt;
    }
    return read.value;
  }

  /// A plane of these angles, in the unit of the file.
  void add(const WrittenAngle& tilt, const WrittenAngle& azimuth, SurveyedPlane surveyed,
           const std::string& line, std::size_t number) {
    const WrittenPlane plane = plane_of(tilt, azimuth, azimuth_column(), layout_);
    if (plane.lacks_rule && quadrants_ == 0) {  // that is the fault of the header
      faults_.add(layout_.header_line, "strike without rule", layout_.header,
                  "a column named strike (RHR), with the dip to the right of the strike, or a dip "
                  "direction, or dips with the letters of their side, as 60SE");
      faults_.finish();
    }
    if (!plane.fault.empty()) return faults_.add(number, plane.fault, line, plane.accepted);
    quadrants_ += azimuth.is_bearing || !tilt.side.empty() ? 1u : 0u;
    sided_ += tilt.side.empty() ? 0u : 1u;
    const double radians = 2 * std::numbers::pi / layout_.turn;
    surveyed.plane = {std::min(plane.dip * radians, 0.5 * std::numbers::pi),
                      plane.direction * radians};
    steepest_ = std::max(steepest_, tilt.value);
    farthest_ = std::max(farthest_, azimuth.value);
    file_.planes.push_back(surveyed);
  }

  /// Which of two columns is the dip, by the values: only a direction is above 90.
  void place_columns() {
    const Pair* large[2] = {nullptr, nullptr};
    for (const Pair& pair : pairs_) {
      if (pair.first > 90 && large[0] == nullptr) large[0] = &pair;
      if (pair.second > 90 && large[1] == nullptr) large[1] = &pair;
    }
    const auto text = [](const Pair& pair) {
      return shortest_text(pair.first) + ", " + shortest_text(pair.second);
    };
    const std::string accepted = std::string("a header: ") + orientation_names;
    if (pairs_.empty()) return;
    const std::string what = "which column is the dip? There is no header, and ";
    if (large[0] == nullptr && large[1] == nullptr)
      return faults_.add(pairs_[0].line, what + "no value above 90", text(pairs_[0]), accepted);
    if (large[0] != nullptr && large[1] != nullptr) {
      const Pair& later = large[0]->line > large[1]->line ? *large[0] : *large[1];
      return faults_.add(later.line, what + "values are above 90 in both columns", text(later),
                         accepted);
    }
    const bool is_second = large[1] != nullptr;
    for (const Pair& pair : pairs_)
      add({is_second ? pair.first : pair.second, false, ""},
          {is_second ? pair.second : pair.first, false, ""}, {}, text(pair), pair.line);
    file_.notes.push_back(std::string("without a header, the ") + (is_second ? "second" : "first") +
                          " column is taken for the dip direction: only there are values above 90");
  }

  /// Index of the set that a row names, in the order of appearance; -1: none.
  [[nodiscard]] int set_of(const std::vector<TraceField>& fields, const std::string& line,
                           std::size_t number) {
    const std::size_t k = layout_.index(OrientationColumn::set);
    const int index = k < fields.size() ? sets_.index_of(fields[k].text) : -1;
    if (sets_.size() > limits_.sets) {
      faults_.add(number, "set number " + std::to_string(limits_.sets + 1), line,
                  "at most " + std::to_string(limits_.sets) +
                      " sets: is this a column of sets, or a number for each plane?");
      faults_.finish();
    }
    return index;
  }

  void name_sets() {
    const std::vector<int> place = sets_.sort();
    for (SurveyedPlane& surveyed : file_.planes)
      if (surveyed.set >= 0) surveyed.set = place[static_cast<std::size_t>(surveyed.set)];
    file_.set_names = sets_.names();
  }

  void say() {
    const char s = layout_.separator;
    const OrientationColumn column = azimuth_column();
    const char* planes = ", dip direction";
    if (column == OrientationColumn::pole_trend) planes = ", poles by trend and plunge";
    if (column == OrientationColumn::right_strike) planes = ", strike with the dip to its right";
    if (column == OrientationColumn::strike) planes = ", strike with the side of the dip";
    file_.layout = std::string("fields separated by ") +
                   (s == '\t'  ? "tabs"
                    : s == ' ' ? "blanks"
                               : std::string(1, s)) +
                   (comma_line_ != 0 ? ", decimal comma" : "") +
                   (std::string_view(lines_.encoding()) == "UTF-8" ? "" : ", UTF-16") +
                   (layout_.has_header ? ", columns by the header" : ", two columns, no header") +
                   planes + (layout_.pair ? ", both in one column" : "") +
                   (quadrants_ > 0 ? ", quadrant notation" : "") + ", angles in " + layout_.unit;
    const bool by_pole = column == OrientationColumn::pole_trend;
    if (by_pole)
      file_.notes.push_back(
          "poles by trend and plunge: each plane dips 90 degrees less the plunge, opposite to the "
          "trend");
    if (quadrants_ > 0)
      file_.notes.push_back("quadrant notation in " + std::to_string(quadrants_) + " of " +
                            std::to_string(file_.planes.size()) + " planes" +
                            (sided_ > 0 && column != OrientationColumn::direction
                                 ? ": the letters of a dip tell its side of the strike, "
                                   "across which it is taken"
                                 : ""));
    std::string ignored;
    for (std::size_t k = 0; k < layout_.names.size(); ++k)
      if (layout_.columns[k] == OrientationColumn::other && !layout_.names[k].empty())
        ignored += (ignored.empty() ? "" : ", ") + shown(layout_.names[k]);
    if (!ignored.empty()) file_.notes.push_back("columns that are not read: " + ignored);
    const auto none = std::count_if(file_.planes.begin(), file_.planes.end(),
                                    [](const auto& surveyed) { return surveyed.set < 0; });
    if (!file_.set_names.empty() && none > 0)
      file_.notes.push_back(std::to_string(none) + " planes of no set");
    const char* small =
        "no dip is above 1.58, no direction above 6.29: if these are radians, "
        "the header must say so: dip [rad]";
    if (by_pole)
      small =
          "no plunge is above 1.58, no trend above 6.29: if these are radians, the header must "
          "say so: pole plunge [rad]";
    if (quadrants_ == 0 && layout_.turn > 10 && file_.planes.size() > 2 && steepest_ < 1.58 &&
        farthest_ < 6.29)
      file_.notes.emplace_back(small);
  }

  const std::string& name_;
  const OrientationFileLimits& limits_;
  StopCheck& stop_;
  TraceFaults faults_;
  BoundedLines lines_;
  OrientationLayout layout_;
  OrientationFile file_;
  std::vector<Pair> pairs_;  ///< without a header
  SetNames sets_;
  std::size_t rows_ = 0;
  std::size_t quadrants_ = 0;                    ///< planes with letters in the azimuth or the dip
  std::size_t sided_ = 0;                        ///< planes with letters in the dip
  std::size_t comma_line_ = 0, point_line_ = 0;  ///< where a decimal sign was seen first
  double steepest_ = 0, farthest_ = 0;           ///< largest dip and direction, as written
};

#endif

}  // namespace detail

}  // namespace voussoir
