// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/detail/bounded_lines.hpp>

namespace voussoir::detail {

/// What stands in a column of a table of traces.
enum class TraceColumn { other, x1, y1, x2, y2, x, y, z, id, set, wkt };

/// One field of a line, without quotes and blanks around it.
struct TraceField {
  std::string text;
  std::size_t column = 1;  ///< of its first character in the line, from 1
};

/// How a table of traces is written, as its header or its first row shows.
struct TraceLayout {
  char separator = ',';  ///< ' ': any blanks
  bool has_header = false;
  std::vector<TraceColumn> columns;
  std::vector<std::string> names;  ///< of the columns, as the header has them
  std::string unit = "m";          ///< of coordinates
  double metres = 1;               ///< of that unit
  [[nodiscard]] std::size_t count(TraceColumn column) const {
    return static_cast<std::size_t>(std::count(columns.begin(), columns.end(), column));
  }
  /// A row is a trace, from one end to the other.
  [[nodiscard]] bool has_ends() const {
    return count(TraceColumn::x1) == 1 && count(TraceColumn::y1) == 1 &&
           count(TraceColumn::x2) == 1 && count(TraceColumn::y2) == 1;
  }
  [[nodiscard]] std::size_t index(TraceColumn column) const {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) -
                                    columns.begin());
  }
};

/// The faults of a file: the first five, each with its place.
class TraceFaults {
 public:
  explicit TraceFaults(const std::string& name) : name_(name) {}

  /// @throws InvalidInput  with all five, when there are so many
  void add(std::size_t line, const std::string& what, std::string_view text,
           const std::string& accepted) {
    text_ += (text_.empty() ? "" : "\n") + name_ + ":" + std::to_string(line) + ": " + what +
             " in \"" + shown(text) + "\"; accepted: " + accepted;
    if (++count_ == most) throw InvalidInput(text_ + "\n" + name_ + ": reading ended there");
  }
  /// @throws InvalidInput  if there was any
  void finish() const {
    if (count_ > 0) throw InvalidInput(text_);
  }
  [[nodiscard]] bool any() const { return count_ > 0; }

 private:
  static constexpr int most = 5;
  const std::string& name_;
  std::string text_;
  int count_ = 0;
};

/// A number as it was written.
struct WrittenNumber {
  double value = 0;
  int decimals = 0;  ///< digits after the decimal sign; -1: with an exponent
  bool has_comma = false, has_point = false;
  std::string fault;  ///< why it is none: follows "field 3"; empty if it is one
};

[[nodiscard]] VOUSSOIR_INLINE WrittenNumber written_number(std::string_view text);

/// The fields of a line. Quotes and round brackets hold separators.
[[nodiscard]] VOUSSOIR_INLINE std::vector<TraceField> fields_of(std::string_view line,
                                                                char separator);

/// Tab before ; before , before | before blanks: what the line has outside of quotes and brackets.
[[nodiscard]] VOUSSOIR_INLINE char separator_of(std::string_view line);

/// Whether a line is a comment or empty.
[[nodiscard]] VOUSSOIR_INLINE bool is_comment(std::string_view line);

/// The layout of a table by its first lines; those before the header are comments.
/// @param lines  the first ones of the file
/// @param data   gets the index of the first that may be data
[[nodiscard]] VOUSSOIR_INLINE TraceLayout layout_of(const std::vector<std::string>& lines,
                                                    TraceFaults& faults, std::size_t& data);

inline constexpr const char* header_names =
    "columns x1,y1,x2,y2 (or id,x,y, one row for each point of a polyline; or WKT), and set if "
    "wanted, in any order, with a unit in brackets where it is not metres: x1 [mm]";

#if VOUSSOIR_BODIES

/// Without blanks around, those of other alphabets and quotes included.
[[nodiscard]] VOUSSOIR_INLINE std::string_view trimmed(std::string_view text) {
  for (bool again = true; again;) {
    again = false;
    for (const std::string_view blank : {" ", "\t", "\xC2\xA0", "\xE2\x80\xAF"}) {
      if (text.starts_with(blank)) text.remove_prefix(blank.size()), again = true;
      if (text.ends_with(blank)) text.remove_suffix(blank.size()), again = true;
    }
  }
  return text;
}

[[nodiscard]] VOUSSOIR_INLINE std::string lower(std::string_view text) {
  std::string low(text);
  for (char& c : low)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return low;
}

VOUSSOIR_INLINE WrittenNumber written_number(std::string_view text) {
  WrittenNumber number;
  text = trimmed(text);
  std::string plain(text);
  if (plain.starts_with("\xE2\x88\x92")) plain.replace(0, 3, "-");  // the typographic minus
  if (plain.starts_with("+")) plain.erase(0, 1);
  const std::string low = lower(plain);
  for (const char* word : {"", "nan", "-nan", "na", "n/a", "#n/a", "null", "none", "nil", "-", "--",
                           "inf", "-inf", "infinity", "-infinity", "1.#qnan", "1.#ind", "#value!"})
    if (low == word) {
      number.fault = low.empty() ? "is empty: is not a finite number"
                                 : "is not a finite number but a word for none: leave the row out";
      return number;
    }
  const auto commas = std::count(plain.begin(), plain.end(), ','),
             points = std::count(plain.begin(), plain.end(), '.');
  const bool is_grouped = commas + points > 1 || plain.find('\'') != std::string::npos ||
                          (plain.find(' ') != std::string::npos &&
                           plain.find_first_not_of("0123456789 .,-") == std::string::npos);
  if (is_grouped && plain.find_first_not_of("0123456789., '-") == std::string::npos) {
    number.fault =
        "is not a finite number: thousands are grouped; write 512291.5 without a sign between them";
    return number;
  }
  number.has_comma = commas == 1;
  number.has_point = points == 1;
  std::replace(plain.begin(), plain.end(), ',', '.');
  const auto [end, error] =
      std::from_chars(plain.data(), plain.data() + plain.size(), number.value);
  if (error != std::errc() || end != plain.data() + plain.size() || !std::isfinite(number.value)) {
    const bool has_unit =
        error == std::errc() && end != plain.data() &&
        std::string_view(end, plain.data() + plain.size())
                .find_first_not_of(" abcdefghijklmnopqrstuvwxyz") == std::string_view::npos;
    number.fault = has_unit ? "is not a finite number: a unit belongs into the header, x1 [m]"
                            : "is not a finite number";
    return number;
  }
  const std::size_t sign = plain.find('.');
  const bool has_exponent = plain.find_first_of("eE") != std::string::npos;
  number.decimals = has_exponent                ? -1
                    : sign == std::string::npos ? 0
                                                : static_cast<int>(plain.size() - sign - 1);
  return number;
}

VOUSSOIR_INLINE std::vector<TraceField> fields_of(std::string_view line, char separator) {
  std::vector<TraceField> fields;
  std::string text;
  std::size_t begin = 0;
  bool quoted = false, is_begun = false;
  int depth = 0;
  const auto end_field = [&] {
    const std::string_view whole = trimmed(text);
    fields.push_back({std::string(whole), begin + 1});
    text.clear();
    is_begun = false;
  };
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (!is_begun && c != ' ') {
      begin = k;
      is_begun = true;
    }
    if (c == '"') {
      if (quoted && k + 1 < line.size() && line[k + 1] == '"')
        text.push_back(line[k++]);
      else
        quoted = !quoted;
      continue;
    }
    if (!quoted) {
      if (c == '(') ++depth;
      if (c == ')') --depth;
      const bool is_blank = separator == ' ' && (c == ' ' || c == '\t');
      if (depth <= 0 && (c == separator || is_blank)) {
        if (!is_blank || !trimmed(text).empty()) end_field();
        begin = k + 1;
        continue;
      }
    }
    text.push_back(c);
  }
  if (separator != ' ' || !trimmed(text).empty()) end_field();
  return fields;
}

VOUSSOIR_INLINE char separator_of(std::string_view line) {
  bool quoted = false;
  int depth = 0;
  std::array<std::size_t, 4> seen{};  // tab, ;, comma, |
  constexpr std::string_view signs = "\t;,|";
  bool has_comma_in_numbers_only = true;
  std::string outside;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (depth > 0) continue;
    outside.push_back(c);
    const std::size_t at = signs.find(c);
    if (at != std::string_view::npos) ++seen[at];
    const auto is_digit = [&](std::size_t i) {
      return i < line.size() && line[i] >= '0' && line[i] <= '9';
    };
    if (c == ',' && !(k > 0 && is_digit(k - 1) && is_digit(k + 1)))
      has_comma_in_numbers_only = false;
  }
  if (seen[0] > 0) return '\t';
  if (seen[1] > 0) return ';';
  if (seen[2] > 0) {
    // 1,5 2 3,25 4: blanks between numbers with a decimal comma.
    if (has_comma_in_numbers_only && fields_of(outside, ' ').size() >= 3) return ' ';
    return ',';
  }
  return seen[3] > 0 ? '|' : fields_of(outside, ' ').size() > 1 ? ' ' : ',';
}

VOUSSOIR_INLINE bool is_comment(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with("\"")) line.remove_prefix(1);
  for (const std::string_view mark : {"#", "//", "%", "!", "--"})
    if (line.starts_with(mark)) return true;
  return line.find_first_not_of(" \t,;|\"") == std::string_view::npos;
}

[[nodiscard]] VOUSSOIR_INLINE TraceColumn column_named(const std::string& key) {
  struct Names {
    TraceColumn column;
    std::string_view names;
  };
  for (const Names& known : {
           Names{TraceColumn::x1,
                 " x1 xa ax xstart startx xbegin beginx xfrom fromx x0 x1start e1 east1 easting1 "
                 "eaststart eastingstart starteast starteasting xanfang rechtswert1 "},
           Names{TraceColumn::y1,
                 " y1 ya ay ystart starty ybegin beginy yfrom fromy y0 n1 north1 northing1 "
                 "northstart northingstart startnorth startnorthing yanfang hochwert1 z1 zstart "
                 "startz zfrom "},
           Names{TraceColumn::x2,
                 " x2 xb bx xend endx xto tox e2 east2 easting2 eastend eastingend endeast "
                 "endeasting xende rechtswert2 "},
           Names{TraceColumn::y2,
                 " y2 yb by yend endy yto toy n2 north2 northing2 northend northingend endnorth "
                 "endnorthing yende hochwert2 z2 zend endz zto "},
           Names{TraceColumn::x, " x e east easting xcoord xcoordinate coordx rechtswert pointx "},
           Names{TraceColumn::y, " y n north northing ycoord ycoordinate coordy hochwert pointy "},
           Names{TraceColumn::z, " z elevation height level zcoord zcoordinate coordz "},
           Names{TraceColumn::id,
                 " id fid oid objectid trace traceid traceno tracenumber line lineid lineno joint "
                 "jointid jointno polyline polylineid nr no number shape shapeid partid "},
           Names{TraceColumn::set,
                 " set jointset setid setno setnr setnumber setname jset family group schar "
                 "kluftschar familie "},
           Names{TraceColumn::wkt, " wkt geometry geom thegeom wktgeom wktgeometry linestring "},
       })
    if (known.names.find(" " + key + " ") != std::string_view::npos) return known.column;
  return TraceColumn::other;
}

/// A name of a column and its unit, "x1" and "mm" of "X1 [mm]", "x1_mm" or "x1 (mm)".
VOUSSOIR_INLINE std::pair<std::string, std::string> name_and_unit(std::string_view text) {
  std::string low = lower(trimmed(text)), unit;
  if (const std::size_t open = low.find_first_of("[("); open != std::string::npos) {
    const std::size_t close = low.find_first_of("])", open);
    if (close != std::string::npos)
      unit = trimmed(std::string_view(low).substr(open + 1, close - open - 1));
    low.resize(open);
  } else if (const std::size_t sign = low.find_last_of("_ /"); sign != std::string::npos) {
    const std::string last = low.substr(sign + 1);
    for (const char* known : {"m", "mm", "cm", "km", "ft", "in", "metres", "meters", "feet"})
      if (last == known) {
        unit = last;
        low.resize(sign);
        break;
      }
  }
  std::string name;
  for (const char c : low)
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) name.push_back(c);
  return {name, unit};
}

/// Metres of a unit; 0: it is not known.
[[nodiscard]] VOUSSOIR_INLINE double metres_of(const std::string& unit) {
  struct Known {
    std::string_view names;
    double metres;
  };
  for (const Known& known : {Known{" m metre metres meter meters mtr ", 1},
                             Known{" mm millimetre millimetres millimeter millimeters ", 1e-3},
                             Known{" cm centimetre centimetres centimeter centimeters ", 1e-2},
                             Known{" dm ", 0.1}, Known{" km kilometre kilometres kilometer ", 1e3},
                             Known{" ft foot feet ", 0.3048}, Known{" in inch inches ", 0.0254}})
    if (known.names.find(" " + unit + " ") != std::string_view::npos) return known.metres;
  return 0;
}

/// What columns of these names are. Beside x0, y0 the other end is x1, y1.
[[nodiscard]] VOUSSOIR_INLINE std::vector<TraceColumn> columns_named(
    const std::vector<std::string>& names) {
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool from_zero = has("x0") && has("x1") && !has("x2");
  std::vector<TraceColumn> columns;
  for (const std::string& name : names) {
    columns.push_back(column_named(name));
    if (from_zero && name == "x1") columns.back() = TraceColumn::x2;
    if (from_zero && name == "y1") columns.back() = TraceColumn::y2;
  }
  return columns;
}

/// Whether the columns are enough to make traces of.
[[nodiscard]] VOUSSOIR_INLINE bool is_table_of_traces(const TraceLayout& layout) {
  const auto has = [&](TraceColumn column) { return layout.count(column) == 1; };
  return layout.has_ends() ||
         (has(TraceColumn::x) && (has(TraceColumn::y) || has(TraceColumn::z)) &&
          has(TraceColumn::id)) ||
         has(TraceColumn::wkt);
}

VOUSSOIR_INLINE TraceLayout layout_of(const std::vector<std::string>& lines, TraceFaults& faults,
                                      std::size_t& data) {
  TraceLayout layout;
  char told = 0;  // "sep=;", as spreadsheets write and read it
  std::optional<std::size_t> first, half;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::string line = lines[k];
    const std::string low = lower(trimmed(line));
    if (low.starts_with("sep=") && low.size() == 5) {
      told = low[4];
      continue;
    }
    if (is_comment(line)) continue;
    if (!first) first = k;
    TraceLayout tried;
    for (std::size_t at; (at = line.find(" [")) != std::string::npos;) line.erase(at, 1);
    tried.separator = told != 0 ? told : separator_of(line);
    const std::vector<TraceField> fields = fields_of(line, tried.separator);
    std::vector<std::string> names;
    for (const TraceField& field : fields) {
      names.push_back(name_and_unit(field.text).first);
      tried.names.push_back(field.text);
    }
    tried.columns = columns_named(names);
    const std::size_t coordinates = fields.size() - tried.count(TraceColumn::other) -
                                    tried.count(TraceColumn::id) - tried.count(TraceColumn::set);
    const bool is_data = fields.empty() || written_number(fields[0].text).fault.empty() ||
                         low.find("linestring") != std::string::npos;
    if (is_table_of_traces(tried) && !is_data) {
      tried.has_header = true;
      layout = tried;
      data = k + 1;
      break;
    }
    if (is_data) break;
    if (coordinates >= 2 && !half) half = k;
  }
  if (!layout.has_header) {
    if (half)
      faults.add(*half + 1, "the header does not name what makes a trace", lines[*half],
                 header_names);
    data = first.value_or(lines.size());
    if (!first) return layout;
    const std::string& line = lines[*first];
    layout.separator = told != 0 ? told : separator_of(line);
    std::vector<TraceField> fields = fields_of(line, layout.separator);
    while (fields.size() > 4 && fields.back().text.empty()) fields.pop_back();
    for (const TraceField& field : fields)
      if (lower(field.text).find("linestring") != std::string::npos)
        layout.columns.assign(1, TraceColumn::wkt);
    if (layout.columns.empty())
      layout.columns = {TraceColumn::x1, TraceColumn::y1, TraceColumn::x2, TraceColumn::y2,
                        TraceColumn::set};
    else if (fields.size() > 1)
      layout.columns.push_back(TraceColumn::set);
    if (half) faults.finish();
    return layout;
  }
  // One unit for all coordinates.
  std::string unit_of;
  for (std::size_t k = 0; k < layout.columns.size(); ++k) {
    const TraceColumn column = layout.columns[k];
    const std::string& header = lines[data - 1];
    if (column != TraceColumn::other && layout.count(column) > 1)
      faults.add(data, "two columns mean the same, \"" + layout.names[k] + "\"", header,
                 header_names);
    if (column == TraceColumn::other || column == TraceColumn::id || column == TraceColumn::set)
      continue;
    const std::string unit = name_and_unit(layout.names[k]).second;
    if (unit.empty()) continue;
    const double metres = metres_of(unit);
    if (metres == 0)
      faults.add(data, "the unit \"" + unit + "\" is not known", header,
                 "m, mm, cm, km, ft (0.3048 m) or in, in brackets");
    else if (!unit_of.empty() && metres != layout.metres)
      faults.add(data, "units are mixed, " + unit_of + " and " + unit, header,
                 "one unit for all coordinates of a file");
    unit_of = unit;
    layout.unit = unit;
    layout.metres = metres;
  }
  if (layout.count(TraceColumn::z) == 1 && layout.count(TraceColumn::x) == 1) {
    const std::size_t z = layout.index(TraceColumn::z);
    if (layout.count(TraceColumn::y) == 1)
      faults.add(data, "three coordinates, x, y and z", lines[data - 1],
                 "traces of the section: x to the right and y (or z) up");
    else
      layout.columns[z] = TraceColumn::y;
  }
  faults.finish();
  return layout;
}

#endif

}  // namespace voussoir::detail
