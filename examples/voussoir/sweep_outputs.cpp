// SPDX-License-Identifier: MIT
#include "sweep_outputs.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/curve_picture.hpp>

namespace voussoir::program {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string number(double value) { return significant_text(value, 6); }

std::string means_csv(const CasePlan& plan, const std::vector<KeyColumn>& columns,
                      const std::vector<TunnelResult>& results) {
  const std::string quantile = "_quantile_" + fixed_text(100 * reported_quantile, 0) + "_percent";
  std::vector<std::string> header;
  for (const KeyColumn& column : columns) header.push_back(column.name);
  for (const char* const name :
       {"realisations", "stable", "stable_after_rockfall", "stable_without_lining", "collapse",
        "undecided", "failed", "marginal", "supports_yielded", "rockfall_share",
        "rockfall_share_low_95", "rockfall_share_high_95"})
    header.emplace_back(name);
  for (const std::string quantity :
       {"crown_convergence_mm", "largest_bolt_force_kN", "mean_bolt_force_kN",
        "largest_thrust_kN_per_m", "largest_moment_kNm_per_m", "lining_of_its_strength"})
    for (const std::string& what :
         {std::string("_mean"), std::string("_deviation"), std::string("_mean_low_95"),
          std::string("_mean_high_95"), quantile})
      header.push_back(quantity + what);
  CsvTable table(header);
  const auto seeds = static_cast<std::size_t>(plan.parts().realisations);
  for (std::size_t k = 0; k * seeds < results.size(); ++k) {
    const Realised r = realised_in(plan, results, k);
    std::vector<std::string> cells = key_cells(columns, k);
    for (const int count : {r.count, r.whole, r.shedding, r.without_lining, r.collapsed,
                            r.undecided, r.failed, r.marginal, r.yielded})
      cells.push_back(std::to_string(count));
    const Share share = r.rockfall();
    const Interval shares = share.trials > 0 ? share.interval() : Interval{none, none};
    cells.push_back(number(share.trials > 0 ? share.value() : none));
    cells.push_back(number(shares.low));
    cells.push_back(number(shares.high));
    const auto add = [&](const Quantity& q, double scale) {
      const Interval between = q.mean_between().value_or(Interval{none, none});
      for (const double value : {q.mean(), q.deviation(), between.low, between.high, q.quantile()})
        cells.push_back(number(scale * value));
    };
    add(r.crown, 1e3);
    add(r.largest_bolt_force, 1e-3);
    add(r.mean_bolt_force, 1e-3);
    add(r.largest_thrust, 1e-3);
    add(r.largest_moment, 1e-3);
    add(r.of_lining_strength, 1);
    table.add_cells(cells);
  }
  return table.text();
}

/// Columns side by side, as wide as their cells.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) {
      widths.resize(std::max(widths.size(), row.size()), 0);
      widths[k] = std::max(widths[k], row[k].size());
    }
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      std::string cell = row[k];
      if (k + 1 < row.size()) cell.resize(widths[k] + 2, ' ');
      line += cell;
    }
    out += line + "\n";
  }
  return out;
}

/// A row for every combination of the varied keys, for a terminal; empty: there are too many.
std::string sweep_table(const CasePlan& plan, const std::vector<KeyColumn>& columns,
                        const std::vector<TunnelResult>& results) {
  constexpr std::size_t most = 40;
  const auto seeds = static_cast<std::size_t>(plan.parts().realisations);
  const std::size_t count = results.size() / seeds;
  if (count > most) return "";
  const bool has_bolts = !plan.input().bolts.empty(), has_lining = !plan.input().linings.empty();
  const std::string mean = seeds > 1 ? "mean " : "";
  std::vector<std::vector<std::string>> rows(1);
  for (const VariedKey& varied : plan.parts().varied) rows[0].push_back(varied.key);
  rows[0].push_back(mean + "crown mm");
  if (has_bolts) rows[0].push_back(mean + "bolt kN");
  if (has_lining) rows[0].push_back(mean + "thrust kN/m");
  if (has_lining) rows[0].push_back("lining %");
  rows[0].emplace_back("verdict");
  for (std::size_t k = 0; k < count; ++k) {
    const Realised r = realised_in(plan, results, k);
    std::vector<std::string>& row = rows.emplace_back(key_cells(columns, k));
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].is_number && !columns[c].unit.empty()) row[c] += " " + columns[c].unit;
    const auto add = [&](const Quantity& q, double scale) {
      row.push_back(q.values.empty() ? "-" : readable_text(scale * q.mean()));
    };
    add(r.crown, 1e3);
    if (has_bolts) add(r.largest_bolt_force, 1e-3);
    if (has_lining) add(r.largest_thrust, 1e-3);
    if (has_lining) add(r.of_lining_strength, 100);
    row.push_back(seeds > 1 ? r.verdicts() : results[k].word());
  }
  return aligned(rows);
}

/// Crown convergence over the key that has most numbers, a curve for every combination of the
/// others; empty: there is no such key, too many curves, or no tunnel that stands.
std::string sweep_picture(const CasePlan& plan, const std::vector<KeyColumn>& columns,
                          const std::vector<TunnelResult>& results) {
  const char* const colours[] = {"#1f4e79", "#b3541e", "#5b8c3e", "#7a4f9a", "#8a6d00", "#00707a"};
  std::size_t across = columns.size();
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].is_number && columns[c].cells.size() > 1 &&
        (across == columns.size() || columns[c].cells.size() >= columns[across].cells.size()))
      across = c;
  if (across == columns.size()) return "";
  const auto seeds = static_cast<std::size_t>(plan.parts().realisations);
  std::map<std::string, std::vector<Vec2>> points;
  std::vector<std::string> names;
  std::size_t without = 0;
  for (std::size_t k = 0; k < results.size() / seeds; ++k) {
    const std::vector<std::string> cells = key_cells(columns, k);
    std::string name;
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (c != across)
        name += (name.empty() ? "" : ", ") + plan.parts().varied[c].key + " = " + cells[c] +
                (columns[c].unit.empty() ? "" : " " + columns[c].unit);
    if (name.empty()) name = "crown";
    if (!points.contains(name)) names.push_back(name);
    std::vector<Vec2>& curve = points[name];
    const Realised r = realised_in(plan, results, k);
    if (r.crown.values.empty())
      ++without;
    else
      curve.emplace_back(std::stod(cells[across]), 1e3 * r.crown.mean());
  }
  if (names.size() > std::size(colours)) return "";
  CurvePicture picture;
  const std::string& title = plan.input().title;
  picture.header.title = "Sweep" + (title.empty() ? "" : ": " + title);
  const KeyColumn& column = columns[across];
  picture.across =
      plan.parts().varied[across].key + (column.unit.empty() ? "" : " [" + column.unit + "]");
  picture.up = seeds > 1 ? "mean crown convergence [mm]" : "crown convergence [mm]";
  bool is_any = false;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::vector<Vec2>& curve = points[names[k]];
    std::sort(curve.begin(), curve.end(),
              [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    is_any = is_any || !curve.empty();
    if (!curve.empty())
      picture.curves.push_back({.name = names[k], .points = curve, .colour = colours[k]});
  }
  if (!is_any) return "";
  picture.header.lines = {
      std::to_string(results.size()) + " tunnels, " + seeds_text(plan) + "." +
      (without > 0 ? " No point where no tunnel stands (" + std::to_string(without) + ")." : "")};
  return draw_curve_picture(picture);
}

}  // namespace

/// "_GPa_per_m" of "GPa/m".
std::string unit_suffix(const std::string& unit) {
  std::string words;
  for (const char c : unit) {
    if (c == '/')
      words += words.empty() ? "per_" : "_per_";
    else if (c == '%')
      words += "percent";
    else if (c != '^' && c != ' ')
      words += c;
  }
  return words.empty() ? "" : "_" + words;
}

KeyColumn column_of(const VariedKey& varied) {
  KeyColumn column{.name = varied.key, .cells = varied.values};
  std::string unit;
  std::vector<std::string> numbers;
  for (const std::string& text : varied.values) {
    std::string value = text;
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{}) return column;
    const std::string digits(value.data(), static_cast<std::size_t>(end - value.data()));
    std::string rest = value.substr(digits.size());
    rest.erase(0, std::min(rest.find_first_not_of(' '), rest.size()));
    if (!numbers.empty() && rest != unit) return column;
    unit = rest;
    numbers.push_back(digits);
  }
  column.cells = numbers;
  column.unit = unit;
  column.is_number = true;
  column.name += unit_suffix(unit);
  return column;
}

std::vector<std::string> key_cells(const std::vector<KeyColumn>& columns, std::size_t combination) {
  std::vector<std::string> cells(columns.size());
  for (std::size_t k = columns.size(); k-- > 0;) {
    cells[k] = columns[k].cells[combination % columns[k].cells.size()];
    combination /= columns[k].cells.size();
  }
  return cells;
}

CaseOutputs sweep_outputs(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  std::vector<KeyColumn> columns;
  for (const VariedKey& varied : plan.parts().varied) columns.push_back(column_of(varied));
  CaseOutputs outputs;
  outputs.files["sweep.csv"] = tunnels_csv(plan, results);
  if (plan.parts().realisations > 1)
    outputs.files["sweep_means.csv"] = means_csv(plan, columns, results);
  const Realised all(results);
  outputs.summary = "sweep    " + std::to_string(results.size()) + " tunnels over";
  for (const VariedKey& varied : plan.parts().varied)
    outputs.summary += (&varied == &plan.parts().varied.front() ? " " : ", ") + varied.key + " (" +
                       std::to_string(varied.values.size()) + ")";
  outputs.summary += ", " + seeds_text(plan) + "\nverdicts " + all.verdicts() + "\n";
  if (const std::string picture = sweep_picture(plan, columns, results); !picture.empty())
    outputs.files["sweep.svg"] = picture;
  outputs.summary += sweep_table(plan, columns, results);
  outputs.summary += strength_text(plan) + warnings_text(results);
  return outputs;
}

}  // namespace voussoir::program
