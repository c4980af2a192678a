// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

/// What stands in a column of a table of orientations. A `strike` follows no rule that is told, a
/// `trend` and a `plunge` are of a line that is not told to be a pole.
enum class OrientationColumn {
  other,
  dip,
  direction,
  strike,
  right_strike,
  trend,
  plunge,
  pole_trend,
  pole_plunge,
  set,
  weight
};

/// How a table of orientations is written, as its header shows.
struct OrientationLayout {
  char separator = ',';  ///< ' ': any blanks
  bool has_header = false;
  std::vector<OrientationColumn> columns;
  std::vector<std::string> names;  ///< of the columns, as the header has them
  std::string unit = "degrees";    ///< of angles
  double turn = 360;               ///< a full one in that unit
  std::string header;              ///< the line that has it
  std::size_t header_line = 0;     ///< its number, from 1
  /// The column whose fields hold two angles, N45E/60SE: the second is the column after it.
  std::optional<std::size_t> pair;
  std::string pair_name;        ///< of that column, as the header has it
  bool pair_has_order = false;  ///< it says which of two numbers is the dip
  std::vector<std::string> notes;
  [[nodiscard]] std::size_t count(OrientationColumn column) const {
    return static_cast<std::size_t>(std::count(columns.begin(), columns.end(), column));
  }
  [[nodiscard]] std::size_t index(OrientationColumn column) const {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) -
                                    columns.begin());
  }
};

inline constexpr const char* orientation_names =
    "columns dip and dip direction (or strike (RHR), with the dip to its right), or strike and dip "
    "as N45E and 60SE, or both in one as N45E/60SE in a column orientation, or pole trend and pole "
    "plunge, and set and weight if wanted, in any order, with a unit in brackets where it is not "
    "degrees: dip [rad]";

/// What tells, in brackets, that a strike has the dip to its right.
inline constexpr std::string_view right_hand_rules =
    " rhr rh right righthand righthanded righthandrule rhrule dipright diptoright diptotheright ";

/// What tells, in brackets, that a strike has the dip to its left.
inline constexpr std::string_view left_hand_rules =
    " lhr lh left lefthand lefthanded lefthandrule lhrule dipleft diptoleft diptotheleft ";

/// What tells, in brackets, that a trend or a plunge is of a pole.
inline constexpr std::string_view pole_words =
    " pole poles ofpole topole normal ofnormal poletoplane poleofplane normaltoplane ";

#if VOUSSOIR_BODIES

/// Whether a line holds no data: empty or a comment. Dips begins its comments with a star.
[[nodiscard]] VOUSSOIR_INLINE bool is_orientation_comment(std::string_view line) {
  return is_comment(line) || trimmed(line).starts_with("*");
}

/// A full turn in a unit of angles; 0: it is not known. "grad" is not: in German it is a degree, in
/// English a gon.
[[nodiscard]] VOUSSOIR_INLINE std::pair<double, const char*> turn_of(std::string_view unit) {
  const std::string padded = " " + std::string(unit) + " ";
  const auto is_one_of = [&](std::string_view known) {
    return !unit.empty() && known.find(padded) != std::string_view::npos;
  };
  if (is_one_of(" deg degs degree degrees \xC2\xB0 \xBA \xB0 \xC2\xBA altgrad "))
    return {360, "degrees"};
  if (is_one_of(" rad rads radian radians ")) return {2 * std::numbers::pi, "radians"};
  if (is_one_of(" gon gons gradian gradians neugrad ")) return {400, "gon"};
  return {0, ""};
}

[[nodiscard]] VOUSSOIR_INLINE std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) letters.push_back(c);
  return letters;
}

/// The letters of a column's name, and what it has in brackets or as a unit after the last blank:
/// "strike" with "rhr" and "deg" of "Strike (RHR) [deg]" or of "strike_(rhr)_deg".
struct HeaderWord {
  std::string name;
  std::vector<std::string> remarks;
};
[[nodiscard]] VOUSSOIR_INLINE HeaderWord header_word(std::string_view text) {
  HeaderWord word;
  const std::string low = lower(trimmed(text));
  std::string name;
  for (std::size_t k = 0; k < low.size();) {
    const bool opens = low[k] == '(' || low[k] == '[';
    const std::size_t close = opens ? low.find_first_of(")]", k) : std::string::npos;
    if (close == std::string::npos) {
      name.push_back(low[k++]);
      continue;
    }
    word.remarks.emplace_back(trimmed(std::string_view(low).substr(k + 1, close - k - 1)));
    k = close + 1;
  }
  name = trimmed(name);
  if (const std::size_t sign = name.find_last_of("_ /"); sign != std::string::npos)
    if (const std::string last = name.substr(sign + 1); turn_of(last).first != 0) {
      word.remarks.push_back(last);
      name.resize(sign);
    }
  word.name = letters_of(name);
  return word;
}

/// Trends and plunges, as "Trend of pole", "Pole plunge", "trend (pole)"; or `other`.
[[nodiscard]] VOUSSOIR_INLINE OrientationColumn column_of_line(const HeaderWord& word) {
  std::string name = word.name;
  bool is_pole = false;
  for (const std::string& remark : word.remarks) {
    const std::string letters = " " + letters_of(remark) + " ";
    is_pole = is_pole || (letters.size() > 2 && pole_words.find(letters) != std::string_view::npos);
  }
  for (const std::string_view pole : {"poles", "pole", "normals", "normal"})
    if (const std::size_t at = name.find(pole); at != std::string::npos) {
      name.erase(at, pole.size());
      is_pole = true;
    }
  if (is_pole)
    for (const std::string_view between :
         {"totheplane", "toplane", "oftheplane", "ofplane", "ofthe", "of"})
      if (const std::size_t at = name.find(between); at != std::string::npos)
        name.erase(at, between.size());
  if (name == "plunge" || name == "plungeangle")
    return is_pole ? OrientationColumn::pole_plunge : OrientationColumn::plunge;
  if (name == "trend" || name == "trendazimuth" || name == "trendangle" || name == "plungetrend" ||
      name == "plungeazimuth" || name == "plungedirection")
    return is_pole ? OrientationColumn::pole_trend : OrientationColumn::trend;
  constexpr std::string_view azimuths = " azimuth azimut az azi bearing direction ";
  if (is_pole && azimuths.find(" " + name + " ") != std::string_view::npos && !name.empty())
    return OrientationColumn::pole_trend;
  return OrientationColumn::other;
}

/// @param weak  gets whether the name may mean something else where a clearer one stands beside it
[[nodiscard]] VOUSSOIR_INLINE OrientationColumn orientation_column(const HeaderWord& word,
                                                                   bool& weak) {
  const auto is_one_of = [](std::string_view name, std::string_view known) {
    return !name.empty() && known.find(" " + std::string(name) + " ") != std::string_view::npos;
  };
  weak = false;
  if (const OrientationColumn line = column_of_line(word); line != OrientationColumn::other)
    return line;
  weak = is_one_of(word.name, " azimuth azimut az azi bearing direction n ");
  if (is_one_of(word.name,
                " dip dipangle dipamount dipmag dipmagnitude truedip inclination incl dipvalue "
                "fallen einfallen fallwinkel einfallwinkel einfallswinkel pendage buzamiento "))
    return OrientationColumn::dip;
  if (is_one_of(word.name,
                " dipdirection dipdir dipdirn ddir ddr dd dipazimuth dipaz dipazi dipazimut "
                "azimuthofdip directionofdip dipbearing fallrichtung einfallrichtung "
                "einfallsrichtung azimuth azimut az azi bearing direction "))
    return OrientationColumn::direction;
  if (is_one_of(word.name,
                " strikerhr rhrstrike strikerh strikeright strikerighthand strikerighthandrule "
                "righthandstrike rightstrike "))
    return OrientationColumn::right_strike;
  if (is_one_of(word.name, " strike strikeazimuth strikeangle strikedirection streichen rumbo ")) {
    for (const std::string& remark : word.remarks)
      if (is_one_of(letters_of(remark), right_hand_rules)) return OrientationColumn::right_strike;
    return OrientationColumn::strike;
  }
  if (column_named(word.name) == TraceColumn::set ||
      is_one_of(word.name, " discontinuityset setlabel famille familia "))
    return OrientationColumn::set;
  if (is_one_of(word.name,
                " weight weights weighting quantity qty count counts n terzaghi terzaghiweight "
                "terzaghiweights terzaghiweighting multiplicity frequency gewicht anzahl "))
    return OrientationColumn::weight;
  return OrientationColumn::other;
}

/// The separator of a line; also of two numbers with a decimal comma each and a blank between.
[[nodiscard]] VOUSSOIR_INLINE char orientation_separator(const std::string& line) {
  const char separator = separator_of(line);
  const std::vector<TraceField> fields = fields_of(line, ' ');
  if (separator != ',' || fields.size() != 2) return separator;
  for (const TraceField& field : fields) {
    const WrittenNumber number = written_number(field.text);
    if (!number.fault.empty() || !number.has_comma) return separator;
  }
  return ' ';
}

/// A message about the lines of a file of traces, for one of orientations.
[[nodiscard]] VOUSSOIR_INLINE std::string about_orientations(std::string text, std::size_t from) {
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"export the lines as CSV with WKT, or as x1,y1,x2,y2", "export dip and direction as CSV"},
      {"export the lines as CSV with WKT", "export dip and direction as CSV"},
      {"export its lines as CSV, x1,y1,x2,y2, or with WKT", "export dip and direction as CSV"},
      {"export its lines as CSV, x1,y1,x2,y2", "export dip and direction as CSV"},
      {"export its lines as CSV", "export dip and direction as CSV"},
      {"digitise the traces and save them as CSV", "type dip and direction, save them as CSV"},
      {"of traces", "of orientations"}};
  for (const auto& [trace, orientation] : words)
    for (std::size_t at; (at = text.find(trace, from)) != std::string::npos;)
      text.replace(at, trace.size(), orientation);
  return text;
}

#endif

}  // namespace voussoir::detail
