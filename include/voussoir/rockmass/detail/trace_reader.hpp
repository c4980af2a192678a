// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <istream>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/bounded_lines.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>
#include <voussoir/rockmass/mapped_trace.hpp>

namespace voussoir {

/// What a file of traces may hold.
struct TraceFileLimits {
  /// Number of joint sets: a trace may name those there are. None: any number below 1e6.
  std::optional<int> sets{};
  std::vector<std::string> set_names{};  ///< by which a trace may name a set, too
  /// Number of the first set, 0 or 1; none: what fits, and where both do it is asked for.
  std::optional<int> first_set{};
  std::string first_set_key = "first_set";  ///< what the user calls that
  std::size_t traces = 1'000'000;           ///< rows of data
  std::size_t line_length = 100'000;        ///< characters of a line
  std::size_t bytes = 256'000'000;          ///< of the whole file, comments included
};

/// What a file of traces holds.
struct TraceFile {
  std::vector<MappedTrace> traces;  ///< relative to the site origin, in the order of the file
  std::string layout;               ///< how it was read, in words: separator, columns, unit
  std::vector<std::string> notes;   ///< what was not taken as it stands
};

namespace detail {

/// Which set numbers a trace may have, for a message.
[[nodiscard]] inline std::string accepted_sets(const TraceFileLimits& limits, int first) {
  if (!limits.sets) return "a whole number from 0 to 999999, or none";
  if (*limits.sets == 0)
    return "none, for the model has no joint sets: define one for each set of the file, by name, or "
           "leave the column out";
  std::string names;
  for (const std::string& name : limits.set_names) names += (names.empty() ? "" : ", ") + name;
  const std::string by_name = names.empty() ? "" : ", a name (" + names + ")";
  if (*limits.sets == 1)
    return std::to_string(first) + " (the only joint set)" + by_name + ", or none";
  return std::to_string(first) + " to " + std::to_string(*limits.sets - 1 + first) +
         " (joint sets, counted from " + std::to_string(first) + ")" + by_name + ", or none";
}

#if VOUSSOIR_BODIES

/// Reads one file of traces: see `read_traces`.
class TraceReader {
 public:
  TraceReader(std::istream& in, const std::string& name, const Vec2& origin,
              const TraceFileLimits& limits, StopCheck& stop)
      : name_(name),
        origin_(origin),
        limits_(limits),
        stop_(stop),
        faults_(name),
        lines_(in, name, {limits.line_length, limits.bytes}, stop) {}

  [[nodiscard]] TraceFile read() {
    std::vector<std::string> first;
    std::string line;
    while (first.size() < looked_at && lines_.next(line)) first.push_back(line);
    std::size_t data = 0;
    layout_ = layout_of(first, faults_, data);
    for (std::size_t k = data; k < first.size(); ++k) row(first[k], k + 1);
    while (lines_.next(line)) row(line, lines_.number());
    end_polyline();
    faults_.finish();
    if (file_.traces.empty())
      throw InvalidInput(name_ + ": holds no trace: " +
                         (lines_.number() == 0 ? std::string("it is empty")
                                               : std::to_string(lines_.number()) +
                                                     " lines, all empty, header or comment") +
                         "; accepted: one trace per line, " + row_form);
    name_sets();
    faults_.finish();
    to_metres();
    say();
    return std::move(file_);
  }

 private:
  static constexpr std::size_t looked_at = 50;  ///< lines among which the header is
  static constexpr const char* row_form =
      "x1,y1,x2,y2[,set] in metres, for example 1.5,-2,4.25,3,0; or a header: ";
  static constexpr double largest = 1e9;  ///< coordinate [m]

  void fail(std::size_t line, const std::string& what, std::string_view text,
            const std::string& accepted = "") {
    faults_.add(line, what, text, accepted.empty() ? form() : accepted);
  }
  [[nodiscard]] std::string form() const {
    if (!layout_.has_header) return row_form + std::string(header_names);
    std::string names;
    for (const std::string& name : layout_.names) names += (names.empty() ? "" : ", ") + name;
    return "a number in each column of coordinates; the header is: " + names;
  }

  void row(std::string& line, std::size_t number) {
    stop_();
    if (is_comment(line)) return;
    if (const std::size_t at = lower(line.substr(0, 12)).find("srid="); at != std::string::npos)
      if (const std::size_t end = line.find(';', at); end != std::string::npos)
        line.erase(at, end + 1 - at);
    std::vector<TraceField> fields = fields_of(line, layout_.separator);
    const std::size_t columns = layout_.columns.size();
    while (fields.size() > (layout_.has_header ? columns : 4) && fields.back().text.empty())
      fields.pop_back();
    if (++rows_ > limits_.traces) {
      fail(number, "trace number " + std::to_string(limits_.traces + 1), line,
           "at most " + std::to_string(limits_.traces) + " traces");
      faults_.finish();
    }
    if (layout_.count(TraceColumn::wkt) == 1) return wkt_row(fields, line, number);
    const bool is_short = fields.size()<needed(), is_long = fields.size()> columns;
    if (is_short || is_long) {
      std::string what = std::to_string(fields.size()) + " fields instead of " +
                         (layout_.has_header ? std::to_string(columns) : "4 or 5");
      if (layout_.separator == ',' && fields.size() == 8)
        what += ": are these decimal commas? Fields must then be separated by ;";
      else if (is_short && separator_of(line) != layout_.separator)
        what += ": this line is separated otherwise than the first";
      return fail(number, what, line);
    }
    if (layout_.has_ends())
      segment_row(fields, line, number);
    else
      point_row(fields, line, number);
  }

  /// Columns that a row must have: the last one with coordinates, or the id.
  [[nodiscard]] std::size_t needed() const {
    std::size_t last = 0;
    for (std::size_t k = 0; k < layout_.columns.size(); ++k)
      if (layout_.columns[k] != TraceColumn::other && layout_.columns[k] != TraceColumn::set)
        last = k + 1;
    return last;
  }

  /// A coordinate of a row; nothing after a fault.
  [[nodiscard]] std::optional<double> coordinate(const std::vector<TraceField>& fields,
                                                 TraceColumn column, const std::string& line,
                                                 std::size_t number) {
    const std::size_t k = layout_.index(column);
    return coordinate(fields[k].text, k, fields[k].column, line, number);
  }
  [[nodiscard]] std::optional<double> coordinate(std::string_view text, std::size_t k,
                                                 std::size_t column, const std::string& line,
                                                 std::size_t number) {
    const WrittenNumber read = written_number(text);
    const auto field = [&] {
      return "field " + std::to_string(k + 1) + " (column " + std::to_string(column) + ", \"" +
             shown(text) + "\") ";
    };
    if (!read.fault.empty()) {
      fail(number, field() + read.fault, line);
      return std::nullopt;
    }
    for (auto [is_so, own, other] : {std::tuple(read.has_comma, &comma_line_, &point_line_),
                                     std::tuple(read.has_point, &point_line_, &comma_line_)}) {
      if (!is_so) continue;
      if (*own == 0) *own = number;
      if (*other != 0) {
        fail(number,
             field() + "has a decimal " + (read.has_comma ? "comma" : "point") + ", line " +
                 std::to_string(*other) + " a decimal " + (read.has_comma ? "point" : "comma"),
             line, "one decimal sign in all of the file");
        return std::nullopt;
      }
    }
    if (!(std::abs(read.value * layout_.metres) <= largest)) {
      fail(number, field() + "is out of range", line, "-1e9 to 1e9 m");
      return std::nullopt;
    }
    decimals_ = read.decimals < 0 || decimals_ < 0 ? -1 : std::max(decimals_, read.decimals);
    return read.value;
  }

  void segment_row(const std::vector<TraceField>& fields, const std::string& line,
                   std::size_t number) {
    std::vector<double> at;
    for (const TraceColumn column :
         {TraceColumn::x1, TraceColumn::y1, TraceColumn::x2, TraceColumn::y2})
      if (const auto value = coordinate(fields, column, line, number)) at.push_back(*value);
    const auto set = set_of(fields, line, number);
    if (at.size() < 4 || !set) return;
    const Vec2 start(at[0], at[1]), end(at[2], at[3]);
    if (start == end) return fail(number, "a trace of zero length", line);
    // Consecutive rows of one id that touch are one polyline.
    if (layout_.count(TraceColumn::id) == 1) {
      const std::string& id = fields[layout_.index(TraceColumn::id)].text;
      const bool goes_on = !file_.traces.empty() && !id.empty() && id == id_ &&
                           file_.traces.back().set == *set &&
                           file_.traces.back().points.back() == start;
      id_ = id;
      if (goes_on) {
        file_.traces.back().points.push_back(end);
        return;
      }
    }
    add({{start, end}, *set}, number);
  }

  void point_row(const std::vector<TraceField>& fields, const std::string& line,
                 std::size_t number) {
    const std::string& id = fields[layout_.index(TraceColumn::id)].text;
    const auto x = coordinate(fields, TraceColumn::x, line, number),
               y = coordinate(fields, TraceColumn::y, line, number);
    const auto set = set_of(fields, line, number);
    if (!open_ || id != id_) {
      end_polyline();
      if (!ids_.insert(id).second)
        return fail(number, "id " + shown(id) + " came before, with others in between", line,
                    "the points of an id one after the other, and another id for another trace");
      open_ = true;
      open_line_ = number;
      id_ = id;
      open_text_ = line;
      polyline_ = {{}, set.value_or(-1)};
    }
    if (!x || !y || !set) return;
    if (*set != polyline_.set)
      return fail(number, "another set than that of the points before of id " + shown(id), line,
                  "one set for all points of an id");
    const Vec2 point(*x, *y);
    if (!polyline_.points.empty() && polyline_.points.back() == point)
      ++repeated_;
    else
      polyline_.points.push_back(point);
  }

  void end_polyline() {
    if (!open_) return;
    open_ = false;
    if (polyline_.points.size() >= 2)
      add(std::move(polyline_), open_line_);
    else if (!faults_.any())
      fail(open_line_, "id " + shown(id_) + " has one point: a trace of zero length", open_text_,
           "two points or more for an id");
  }

  void wkt_row(const std::vector<TraceField>& fields, const std::string& line, std::size_t number) {
    const std::size_t k = layout_.index(TraceColumn::wkt);
    if (fields.size() <= k) return fail(number, "no WKT", line, "LINESTRING (1 2, 3 4)");
    std::string_view text = trimmed(fields[k].text);
    const std::string kind = lower(text.substr(0, text.find('(')));
    const std::string_view plain = trimmed(kind);
    const auto set = set_of(fields, line, number);
    if (!set) return;
    if (plain != "linestring" && plain != "multilinestring")
      return fail(number,
                  plain.ends_with(" z") || plain.ends_with(" m") || plain.ends_with("zm")
                      ? "WKT of more than two coordinates"
                      : "no line in WKT",
                  line, "LINESTRING (1 2, 3 4) or MULTILINESTRING, x and y of the section");
    // Points are between commas, lines between brackets.
    std::vector<Vec2> points;
    const auto end_line = [&] {
      if (points.size() >= 2)
        add({std::move(points), *set}, number);
      else if (!points.empty())
        fail(number, "a line of zero length", line, "two points or more");
      points.clear();
    };
    std::string point;
    for (const char c : text.substr(std::min(text.size(), text.find('(')))) {
      if (c == '(') continue;
      if (c != ',' && c != ')') {
        point.push_back(c);
        continue;
      }
      const std::vector<TraceField> numbers = fields_of(point, ' ');
      point.clear();
      if (numbers.size() == 2) {
        const auto x = coordinate(numbers[0].text, k, fields[k].column, line, number),
                   y = coordinate(numbers[1].text, k, fields[k].column, line, number);
        if (!x || !y) return;
        if (!points.empty() && points.back() == Vec2(*x, *y))
          ++repeated_;
        else
          points.emplace_back(*x, *y);
      } else if (!numbers.empty()) {
        return fail(number, std::to_string(numbers.size()) + " coordinates of a point in WKT", line,
                    "two: x and y of the section");
      }
      if (c == ')') end_line();
    }
  }

  /// Number of a set as it is written; -1: none, below: a name that was seen. Nothing after a
  /// fault.
  [[nodiscard]] std::optional<int> set_of(const std::vector<TraceField>& fields,
                                          const std::string& line, std::size_t number) {
    const std::size_t k = layout_.index(TraceColumn::set);
    if (k >= fields.size() || fields[k].text.empty()) return -1;
    const std::string& text = fields[k].text;
    const auto named = std::find_if(
        limits_.set_names.begin(), limits_.set_names.end(),
        [&](const std::string& known) { return lower(trimmed(known)) == lower(text); });
    if (named != limits_.set_names.end())
      return first_name - static_cast<int>(named - limits_.set_names.begin());
    const WrittenNumber read = written_number(text);
    if (!read.fault.empty() ||
        !(read.value >= 0 && read.value < 1e6 && read.value == std::floor(read.value))) {
      const bool is_name = !read.fault.empty() && limits_.sets;
      fail(number,
           is_name ? "there is no joint set \"" + shown(text) + "\""
                   : "the set is not a whole number >= 0",
           line, "as set " + accepted_sets(limits_, limits_.first_set.value_or(0)));
      return std::nullopt;
    }
    return static_cast<int>(read.value);
  }

  void add(MappedTrace trace, std::size_t line) {
    file_.traces.push_back(std::move(trace));
    trace_lines_.push_back(line);
  }

  /// From set numbers as they are written to indices.
  void name_sets() {
    int least = -1, most = -1;
    for (const MappedTrace& trace : file_.traces)
      if (trace.set >= 0) {
        least = least < 0 ? trace.set : std::min(least, trace.set);
        most = std::max(most, trace.set);
      }
    int first = limits_.first_set.value_or(0);
    if (limits_.sets && !limits_.first_set && least > 0) {
      if (most == *limits_.sets) first = 1;
      if (most < *limits_.sets)
        throw InvalidInput(
            name_ + ": sets are numbered " + std::to_string(least) + " to " + std::to_string(most) +
            ", and there are " + std::to_string(*limits_.sets) +
            ": it is not clear whether the first is number 0 or 1; accepted: " +
            limits_.first_set_key + " = 0 or 1, or names of sets in place of numbers");
    }
    if (limits_.sets && least >= 0) file_.layout = ", sets counted from " + std::to_string(first);
    for (std::size_t k = 0; k < file_.traces.size(); ++k) {
      int& set = file_.traces[k].set;
      if (set == -1) continue;
      if (set <= first_name) {
        set = first_name - set;
        continue;
      }
      if (limits_.sets && !(set >= first && set < *limits_.sets + first)) {
        const Vec2& p = file_.traces[k].points.front();
        fail(trace_lines_[k], "there is no joint set " + std::to_string(set),
             "trace from " + text_of<2>(p), "as set number " + accepted_sets(limits_, first));
        continue;
      }
      if (limits_.sets || limits_.first_set) set -= first;
    }
  }

  /// Relative to the origin, to the digits that were written.
  void to_metres() {
    const double metres = layout_.metres;
    // Decimals of a metre: of a millimetre three more.
    const int shift = metres == 1      ? 0
                      : metres == 1e-3 ? 3
                      : metres == 1e-2 ? 2
                      : metres == 0.1  ? 1
                      : metres == 1e3  ? -3
                                       : 99;
    const int digits = decimals_ < 0 ? 99 : std::max(0, decimals_ + shift);
    double scale = 1;
    for (int k = 0; k < std::min(digits, 10); ++k) scale *= 10;
    const auto is_whole = [&](double x) {
      return std::abs(x * scale - std::round(x * scale)) < 1e-3;
    };
    // One ulp of 1e9 m is a tenth of a micrometre: what is beyond cannot be told apart.
    const bool is_rounded = digits <= 9 && is_whole(origin_.x()) && is_whole(origin_.y());
    const auto local = [&](double x, double origin) {
      const double away = x * metres - origin;
      return is_rounded && std::abs(away * scale) < 1e15 ? std::round(away * scale) / scale : away;
    };
    for (MappedTrace& trace : file_.traces)
      for (Vec2& p : trace.points) p = Vec2(local(p.x(), origin_.x()), local(p.y(), origin_.y()));
  }

  void say() {
    const char s = layout_.separator;
    std::string text = std::string("fields separated by ") + (s == '\t'  ? "tabs"
                                                              : s == ' ' ? "blanks"
                                                                         : std::string(1, s));
    if (comma_line_ != 0) text += ", decimal comma";
    if (std::string_view(lines_.encoding()) != "UTF-8")
      text += ", " + std::string(lines_.encoding());
    text += layout_.has_header ? ", columns by the header" : ", columns x1, y1, x2, y2, set";
    if (layout_.count(TraceColumn::wkt) == 1) text += ", lines in WKT";
    text += ", coordinates in " + layout_.unit;
    file_.layout = text + file_.layout;
    std::string ignored;
    for (std::size_t k = 0; k < layout_.names.size(); ++k)
      if (layout_.columns[k] == TraceColumn::other && !layout_.names[k].empty())
        ignored += (ignored.empty() ? "" : ", ") + shown(layout_.names[k]);
    if (!ignored.empty()) file_.notes.push_back("columns that are not read: " + ignored);
    if (repeated_ > 0)
      file_.notes.push_back(std::to_string(repeated_) + " points that repeat the one before");
  }

  static constexpr int first_name = -2;  ///< sets by name count down from here

  const std::string& name_;
  Vec2 origin_;
  const TraceFileLimits& limits_;
  StopCheck& stop_;
  TraceFaults faults_;
  BoundedLines lines_;
  TraceLayout layout_;
  TraceFile file_;
  std::vector<std::size_t> trace_lines_;
  std::size_t rows_ = 0, repeated_ = 0;
  std::size_t comma_line_ = 0, point_line_ = 0;  ///< where a decimal sign was seen first
  int decimals_ = 0;                             ///< most of any coordinate; -1: an exponent
  // The polyline that is being read.
  bool open_ = false;
  std::string id_, open_text_;
  std::size_t open_line_ = 0;
  MappedTrace polyline_;
  std::set<std::string> ids_;
};

#endif

}  // namespace detail

}  // namespace voussoir
