// SPDX-License-Identifier: MIT
// What a report says of supports: what bolts and linings carry of what they bear.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "output_parts.hpp"
#include "report_pictures.hpp"
#include "report_sections.hpp"

namespace voussoir::program {

namespace {

using html::Column;
using html::Kind;
using html::Section;
using html::Table;
using html::Tone;

constexpr std::size_t listed = 10;  ///< of bolts and of nodes

std::string use_text(std::string_view cell) {
  if (cell == "-" || cell.empty()) return "not checked";
  return std::string(cell);
}

/// The crossing of each bolt that pulls most, the strongest first, by its row in bolts.csv.
std::vector<std::size_t> strongest_crossings(const ReportTable& bolts) {
  std::map<std::string, std::size_t, std::less<>> most;
  for (std::size_t k = 0; k < bolts.size(); ++k) {
    const auto [at, is_new] = most.emplace(std::string(bolts.cell(k, "bolt")), k);
    if (!is_new && bolts.number(k, "axial_force_kN") > bolts.number(at->second, "axial_force_kN"))
      at->second = k;
  }
  std::vector<std::size_t> rows;
  for (const auto& [bolt, row] : most) rows.push_back(row);
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
    return bolts.number(a, "axial_force_kN") > bolts.number(b, "axial_force_kN");
  });
  return rows;
}

std::string bolts_table(const RunResults& r) {
  const ReportTable bolts = r.files.table("bolts.csv");
  const std::vector<std::size_t> rows = strongest_crossings(bolts);
  std::vector<Column> columns{{"bolt"}};
  if (r.is_spatial())
    for (const char* axis : {"x", "y", "z"}) columns.push_back({axis, "m"});
  else
    columns.push_back({"angle", "°"});
  columns.insert(columns.end(), {{"largest force", "kN"},
                                 {"at, from its head", "m"},
                                 {"extension", "mm"},
                                 {"state", "", Kind::text},
                                 {"utilisation", "%"}});
  Table table("Bolts with the largest forces, where they cross joints", columns);
  for (std::size_t k = 0; k < std::min(rows.size(), listed); ++k) {
    const std::size_t row = rows[k];
    std::vector<std::string> cells{std::string(bolts.cell(row, "bolt"))};
    if (r.is_spatial())
      for (const char* axis : {"x_m", "y_m", "z_m"})
        cells.push_back(shown_fixed(bolts.number(row, axis), 2));
    else
      cells.push_back(shown_fixed(bolts.number(row, "angle_deg"), 1));
    const double use = bolts.number(row, "of_its_strength");
    cells.insert(cells.end(), {shown_fixed(bolts.number(row, "axial_force_kN"), 1),
                               shown_fixed(bolts.number(row, "distance_from_head_m"), 2),
                               shown_fixed(bolts.number(row, "extension_mm"), 2),
                               std::string(bolts.cell(row, "state")),
                               std::isfinite(use) ? shown_fixed(100 * use, 1)
                                                  : use_text(bolts.cell(row, "of_its_strength"))});
    table.add(cells, bolts.cell(row, "state") == "elastic" ? Tone::plain : Tone::doubtful);
  }
  return table.text() + left_out(rows.size(), listed, "bolts.csv");
}

/// Whether linings have a strength, and rows of their table by what they have of it, else by
/// thrust; the most first.
struct RankedRows {
  std::vector<std::size_t> rows = {};
  bool by_strength = false;
};
/// Of its strength; beyond all where no section of it bears that, -1 where it has none.
double use_of(const ReportTable& lining, std::size_t row) {
  if (lining.cell(row, "of_its_strength") == "beyond") return INFINITY;
  const double use = lining.number(row, "of_its_strength");
  return std::isfinite(use) ? use : -1;
}
RankedRows ranked_rows(const ReportTable& lining, const char* thrust) {
  RankedRows ranked;
  std::vector<double> ranks(lining.size());
  for (std::size_t k = 0; k < lining.size(); ++k) {
    ranked.rows.push_back(k);
    ranks[k] = use_of(lining, k);
    ranked.by_strength = ranked.by_strength || ranks[k] >= 0;
  }
  if (!ranked.by_strength)
    for (std::size_t k = 0; k < lining.size(); ++k) ranks[k] = std::abs(lining.number(k, thrust));
  std::stable_sort(ranked.rows.begin(), ranked.rows.end(),
                   [&](std::size_t a, std::size_t b) { return ranks[a] > ranks[b]; });
  return ranked;
}

/// A column of lining.csv as the page shows it.
struct LiningColumn {
  const char *key, *name, *unit;
  int decimals;  ///< below 0: as it is
};

/// Nodes of a section, members of linings in 3-D.
std::string lining_table(const RunResults& r) {
  const ReportTable lining = r.files.table("lining.csv");
  if (lining.size() == 0) return "";
  const std::vector<LiningColumn> columns =
      r.is_spatial() ? std::vector<LiningColumn>{{"lining", "lining", "", -1},
                                                 {"member", "member", "", -1},
                                                 {"x_m", "x", "m", 2},
                                                 {"y_m", "y", "m", 2},
                                                 {"z_m", "z", "m", 2},
                                                 {"thrust_kN", "thrust", "kN", 0},
                                                 {"shear_kN", "shear", "kN", 1},
                                                 {"moment_kNm", "moment", "kN m", 2}}
                     : std::vector<LiningColumn>{{"lining", "lining", "", -1},
                                                 {"node", "node", "", -1},
                                                 {"angle_deg", "angle", "°", 1},
                                                 {"thrust_kN_per_m", "thrust", "kN/m", 0},
                                                 {"shear_kN_per_m", "shear", "kN/m", 1},
                                                 {"moment_kNm_per_m", "moment", "kN m/m", 2},
                                                 {"convergence_mm", "convergence", "mm", 2}};
  const RankedRows ranked = ranked_rows(lining, r.is_spatial() ? "thrust_kN" : "thrust_kN_per_m");
  std::vector<Column> heads;
  for (const LiningColumn& column : columns) heads.push_back({column.name, column.unit});
  heads.push_back({"utilisation", "%"});
  Table table(std::string(r.is_spatial() ? "Members" : "Nodes") +
                  " of the lining with the largest " +
                  (ranked.by_strength ? "utilisation" : "thrust"),
              heads);
  for (std::size_t k = 0; k < std::min(ranked.rows.size(), listed); ++k) {
    const std::size_t row = ranked.rows[k];
    std::vector<std::string> cells;
    for (const LiningColumn& column : columns)
      cells.push_back(column.decimals < 0
                          ? std::string(lining.cell(row, column.key))
                          : shown_fixed(lining.number(row, column.key), column.decimals));
    const double use = lining.number(row, "of_its_strength");
    cells.push_back(std::isfinite(use) ? shown_fixed(100 * use, 1)
                                       : use_text(lining.cell(row, "of_its_strength")));
    table.add(cells, use_of(lining, row) > 1 ? Tone::bad : Tone::plain);
  }
  return table.text() + left_out(ranked.rows.size(), listed, "lining.csv");
}

struct Judged {
  std::string word;
  Tone tone;
};
Judged judged(double use) {
  if (!std::isfinite(use)) return {"not checked", Tone::doubtful};
  return use > 1 ? Judged{"exceeded", Tone::bad} : Judged{"within", Tone::good};
}

/// In which stage, of concrete that ages; empty: at the end.
std::string governing_stage(const Json& run) {
  const std::string stage = words_at(run, "/lining/governing/stage");
  const double age = number_at(run, "/lining/governing/age_d");
  return stage.empty() ? ""
                       : ", in " + stage +
                             (std::isfinite(age) ? " (" + shown(age) + " d old)" : std::string());
}

/// Bolts, linings and feet against their strength, a row each.
Table utilisation_table(const RunResults& r) {
  Table table("What supports carry of what they bear", {{"support", "", Kind::text},
                                                        {"where", "", Kind::text},
                                                        {"what acts", "", Kind::text},
                                                        {"strength", "", Kind::text},
                                                        {"utilisation"},
                                                        {"result", "", Kind::text}});
  const Json& run = r.run;
  if (run.contains("bolts")) {
    const ReportTable bolts = r.files.table("bolts.csv");
    const std::vector<std::size_t> rows = strongest_crossings(bolts);
    const double use = number_at(run, "/bolts/of_its_strength");
    std::string where = "–";
    if (!rows.empty()) {
      where = "bolt " + std::string(bolts.cell(rows[0], "bolt"));
      if (!r.is_spatial())
        where += ", at " + shown_fixed(bolts.number(rows[0], "angle_deg"), 1) + "°";
    }
    const bool has_strength = std::isfinite(use);
    table.add({shown(number_at(run, "/bolts/count")) + " bolts", where,
               "tension " + shown(number_at(run, "/bolts/largest_force_kN")) + " kN",
               has_strength ? words_at(run, "/bolts/strength") : "not given", shown_percent(use),
               judged(use).word},
              judged(use).tone);
  }
  if (run.contains("lining")) {
    const double use = number_at(run, "/lining/of_its_strength");
    const std::string place = words_at(run, "/lining/governing/place");
    if (place.empty()) {
      table.add({"lining", "–",
                 "thrust up to " + shown(number_at(run, "/lining/largest_thrust_kN_per_m")) +
                     " kN/m, moment up to " +
                     shown(number_at(run, "/lining/largest_moment_kNm_per_m")) + " kN m/m",
                 "not given", "–", "not checked"},
                Tone::doubtful);
    } else {
      const double angle = number_at(run, "/lining/governing/angle_deg"),
                   along = number_at(run, "/lining/governing/along_m");
      const bool is_borne = holds_at(run, "/lining/bears_it");
      table.add(
          {"lining",
           place + ", " + shown_fixed(angle, 0) + "°" +
               (std::isfinite(along) ? ", " + shown_fixed(along, 2) + " m along" : "") +
               governing_stage(run),
           "thrust " + shown(number_at(run, "/lining/governing/thrust_kN_per_m")) +
               " kN/m, moment " + shown(number_at(run, "/lining/governing/moment_kNm_per_m")) +
               " kN m/m",
           words_at(run, "/lining/strength") +
               "; governs: " + words_at(run, "/lining/governing/mode"),
           std::isfinite(use) ? shown_percent(use) : "beyond", is_borne ? "within" : "exceeded"},
          is_borne ? Tone::good : Tone::bad);
    }
    for (const Json& foot : list_at(run, "/lining/feet")) {
      const double use_of_foot = number_at(foot, "/of_its_strength");
      table.add(
          {"foot of the lining",
           "x " + shown_fixed(number_at(foot, "/x_m"), 2) + " m, y " +
               shown_fixed(number_at(foot, "/y_m"), 2) + " m",
           "bearing " + (r.is_spatial() ? shown(number_at(foot, "/bearing_kN")) + " kN"
                                        : shown(number_at(foot, "/bearing_kN_per_m")) + " kN/m"),
           std::isfinite(use_of_foot) ? "of the rock under it" : "not given",
           shown_percent(use_of_foot), judged(use_of_foot).word},
          judged(use_of_foot).tone);
    }
  }
  return table;
}

/// Which support has the most of its strength, in words.
std::string governing_sentence(const RunResults& r) {
  const double bolts = number_at(r.run, "/bolts/of_its_strength"),
               lining = number_at(r.run, "/lining/of_its_strength");
  const std::string place = words_at(r.run, "/lining/governing/place");
  const bool is_beyond = !place.empty() && !std::isfinite(lining);
  if (is_beyond || (std::isfinite(lining) && !(bolts > lining)))
    return "The lining governs: " + place + ", " +
           shown_fixed(number_at(r.run, "/lining/governing/angle_deg"), 0) +
           "° from the right-hand springing anticlockwise, in " +
           words_at(r.run, "/lining/governing/mode") + governing_stage(r.run) + ", " +
           (is_beyond ? "beyond its strength" : shown_percent(lining) + " of its strength") + ".";
  if (std::isfinite(bolts))
    return "The bolts govern, in tension: " + shown_percent(bolts) + " of their strength.";
  return "No strength was given for any support: what they carry is not checked.";
}

}  // namespace

Section strength_section(const RunResults& r) {
  Section section{"strength", "Strength of the supports", ""};
  if (r.is_laid()) return section;
  const Table uses = utilisation_table(r);
  if (uses.empty()) {
    section.body = html::paragraph("The tunnel has no supports.");
    return section;
  }
  section.body = html::paragraph(governing_sentence(r)) + uses.text();
  if (r.files.has("lining_strength.svg"))
    section.body += html::figure(
        r.files.text("lining_strength.svg"), "lining-strength-figure",
        "Thrust and moment at every node of the lining, and the envelope of what its section bears "
        "of both together (EN 1992-1-1, 6.1). Inside the envelope is within its strength.");
  section.body += bolts_table(r) + lining_table(r);
  return section;
}

}  // namespace voussoir::program
