// SPDX-License-Identifier: MIT
// Tunnels from input files whose joints end on corners and lie on planes of symmetry: moved by a
// nanometre, put on another site grid, mirrored, their traces in pieces. What the program writes of
// them must stay: run.json, the tables, the row of a sweep.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis.hpp"
#include "case_work.hpp"
#include "harness.hpp"
#include "outputs.hpp"
#include "support/folder.hpp"
#include "support/same_figures.hpp"
#include "support/tied_tunnels.hpp"

namespace program_ties_test {

namespace {

using namespace voussoir_test;
using namespace voussoir::program;
using voussoir::Vec2;
using Json = nlohmann::json;

/// How the file of a tunnel is given anew.
struct Given {
  tied::Image image;
  Vec2 origin = voussoir::zeros<Vec2>();  ///< `model.origin` [m]

  [[nodiscard]] bool is_mirrored() const { return image.map.turn(0, 0) < 0; }
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string point(const Vec2& p) {
  return "[\"" + number(p.x()) + " m\",\"" + number(p.y()) + " m\"]";
}

std::string traces_text(const tied::Drawn& d, const Given& given) {
  std::string text = "id,x,y,set\n";
  int id = 0;
  for (const auto& trace : tied::traces_of(d, given.image)) {
    ++id;
    for (const Vec2& p : trace.points)
      text += std::to_string(id) + "," + number(p.x() + given.origin.x()) + "," +
              number(p.y() + given.origin.y()) + "," + std::to_string(trace.set) + "\n";
  }
  return text;
}

/// The input beside "traces.csv".
std::string input_text(const tied::Drawn& d, const Given& given) {
  std::string text =
      "[model]\nwidth = \"16 m\"\nbelow_invert = \"4 m\"\norigin = " + point(given.origin) +
      "\n[tunnel]\nshape = \"polygon\"\nvertices = [";
  const voussoir::SimplePolygon opening = moved(d.opening, given.image.map);
  for (const Vec2& v : opening.vertices()) text += (text.ends_with('[') ? "" : ",") + point(v);
  text +=
      "]\ncover = \"5 m\"\n[rock]\ndensity = \"2700 kg/m^3\"\n"
      "[stress]\nK0 = 0.8\nsurcharge = \"300 kPa\"\n[joints]\nfile = \"traces.csv\"\n"
      "[[joint_set]]\nname = \"a\"\n[[joint_set]]\nname = \"b\"\n[[joint_set]]\nname = \"c\"\n"
      "[joint]\nkn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"" +
      number(d.friction) + " deg\"\n[blocks]\nmin_inscribed_radius = \"0.1 m\"\n";
  if (d.is_on_elastic_ground) text += "[boundary]\nsides = \"elastic\"\nbase = \"elastic\"\n";
  if (d.has_bolts)
    text +=
        "[support.bolts]\nlength = \"2 m\"\nspacing = \"25 deg\"\nstiffness = \"0.2 GN/m\"\n"
        "yield_force = \"150 kN\"\n";
  if (d.lining > 0)
    text +=
        "[support.lining]\nthickness = \"10 cm\"\nE = \"25 GPa\"\nnodes = 36\n"
        "interface = { kn = \"10 GPa/m\", friction = \"35 deg\" }\n";
  if (d.lining == 2)  // lopsided, so that it is not its own image
    text += std::string("arc = ") +
            (given.is_mirrored() ? "[\"10 deg\",\"200 deg\"]" : "[\"-20 deg\",\"170 deg\"]") +
            "\n[support.lining.feet]\nwidth = \"30 cm\"\nstiffness = \"1 GPa/m\"\n"
            "strength = \"5 MPa\"\nfriction = \"30 deg\"\n";
  return text + "[run]\ntolerance = 1e-6\n";
}

/// Every table, by its name.
using Tables = std::map<std::string, std::string>;

/// What is no figure of the tunnel: times, how the search went and what it left, where and how
/// traces were read, the number of a block; what was read, by which build, and a hash of all bits;
/// the words for where a support is nearest to its strength, which name a side.
bool is_left_out(const std::string& key) {
  for (const char* name : {"time_s", "force_evaluations", "elastic_solves", "factorisations",
                           "linear_solver", "error_estimate", "out_of_balance_force_ratio",
                           "in_situ_out_of_balance_force_ratio", "joints_read", "block", "input",
                           "build", "result_hash", "bolts_governed_by", "lining_governed_by"})
    if (key == name) return true;
  return false;
}

/// A key of JSON as a column of the tunnel that is not mirrored.
std::string column_of(const std::string& table, const std::string& key, bool is_mirrored) {
  // A foot presses inwards or outwards, on either side: its shear keeps its sign, other than that
  // of a lining.
  if (table.ends_with(".feet") && key.starts_with("shear")) return "foot_" + key;
  if (is_mirrored && key.starts_with("right_")) return "left_" + key.substr(6);
  if (is_mirrored && key.starts_with("left_")) return "right_" + key.substr(5);
  return key;
}

std::string cell_of(const std::string& column, const Json& value) {
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (value.is_number_float()) {
    // Joints are moved by a nanometre: less than a micrometre is none.
    const bool is_none = column == "made_m" && value.get<double>() < 1e-6;
    text = is_none ? "0" : number(value.get<double>());
  }
  for (char& c : text)
    if (c == ',' || c == '\n') c = ';';
  return text;
}

/// JSON as tables: an object is a row, a list of them has several, and a list or a matrix of values
/// has a row for each.
void add_tables(const std::string& name, const Json& json, bool is_mirrored, Tables& tables) {
  const auto add = [&](const std::string& columns, const std::string& cells) {
    std::string& text = tables[name];
    if (text.empty()) text = columns + "\n";
    text += cells + "\n";
  };
  if (json.is_object()) {
    std::map<std::string, std::string> row;
    for (const auto& [key, value] : json.items()) {
      if (is_left_out(key)) continue;
      const std::string column = column_of(name, key, is_mirrored);
      if (value.is_structured())
        add_tables(name + "." + key, value, is_mirrored, tables);
      else
        row[column] = cell_of(column, value);
    }
    std::string columns, cells;
    for (const auto& [column, cell] : row) {
      columns += column + ",";
      cells += cell + ",";
    }
    add(columns, cells);
    return;
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Json& entry = json[i];
    if (entry.is_object()) {
      add_tables(name, entry, is_mirrored, tables);
    } else if (entry.is_array()) {  // moduli of xx, yy, xy: shear is the other way in the mirror
      for (std::size_t j = 0; j < entry.size(); ++j)
        add("value",
            number((is_mirrored && (i == 2) != (j == 2) ? -1 : 1) * entry[j].get<double>()));
    } else if (const std::string cell = cell_of("value", entry); !cell.starts_with("joints.file")) {
      add("value", cell);
    }
  }
}

struct Answer {
  Tables tables;
  bool has_fallen = false;  ///< rock has come off, in motion
};

Answer answer(const tied::Drawn& d, const Given& given) {
  const Folder folder;
  write_file(folder / "traces.csv", traces_text(d, given));
  const Input input = read_input_text(input_text(d, given), "case.toml", folder / ".", {});
  const Report quiet = [](const std::string&, double) { return true; };
  const RunResult run = run_of(input, quiet);
  Answer made{{}, run.last().is_from_motion || run.fallen_measure() > 0};
  Json results = Json::parse(run_json(input, run));
  if (results.contains("bolts") && results["bolts"].is_object())
    results["bolts"].erase("governing");  // which bolt, counted from the right
  add_tables("run.json", results, given.is_mirrored(), made.tables);
  made.tables["bolts.csv"] = bolts_csv(input, run);
  made.tables["lining.csv"] = lining_csv(input, run);
  // With all digits, as the journal of a sweep has it.
  const TunnelResult row =
      tunnel_in(input, rock_in_situ(input, false, quiet), supports_of(input), quiet);
  add_tables("sweep", Json::parse(result_json(row)), given.is_mirrored(), made.tables);
  return made;
}

WorstFigure worst_of(const Tables& one, const Tables& image, const Transform<2>& map,
                     double floor) {
  WorstFigure worst;
  if (one.size() != image.size()) worst.take(INFINITY, "another number of tables");
  for (const auto& [name, text] : one) {
    const auto other = image.find(name);
    worst.take(other == image.end() ? WorstFigure{INFINITY, name + " is missing"}
                                    : worst_figure(name, text, other->second, map, floor));
  }
  return worst;
}

std::vector<Given> givens() {
  const Vec2 site(512300.25, -148000.7);
  return {{{"moved by a nanometre", {}, {}, {0.6e-9, 0.8e-9}}},
          {{"moved by a nanometre the other way", {}, {}, {-0.8e-9, -0.6e-9}}},
          {{"on a site grid"}, site},
          {{"mirrored", mirrored_2d()}},
          {{"mirrored", mirrored_2d()}, site},
          {{"in pieces", {}, {}, voussoir::zeros<Vec2>(), true}}};
}

}  // namespace

TEST_SUITE("program/ties") {
  /// @return  how many images were compared
  int check(std::uint64_t first, std::uint64_t last) {
    int compared = 0;
    for (std::uint64_t seed = first; seed <= last; ++seed) {
      const tied::Drawn d = tied::drawn(seed);
      const Answer one = answer(d, {{"as drawn"}});
      CHECK(one.tables.size() >= 13);
      for (const Given& given : givens()) {
        if (tied::is_known(seed, given.image.name)) continue;
        const Answer made = answer(d, given);
        // Of rock that comes off in motion: docs/decisions.md, "One truth where rock fails".
        if (one.has_fallen || made.has_fallen) continue;
        // A figure may change by a millionth of itself, or by a tenth of that of the largest of its
        // column (tests/solver/ties_test.cpp). In the mirror the search takes blocks in another
        // order, so that what it leaves is another: 1e-6 of the largest displacement, the least
        // that a file may ask for. Forces come of differences of displacements; a hundred times
        // that, of the largest of their column.
        const double within = given.is_mirrored() ? 1e-4 : 1e-6,
                     next_to_nothing = given.is_mirrored() ? 1 : 0.1;
        const WorstFigure worst =
            worst_of(one.tables, made.tables, given.image.map, next_to_nothing);
        CAPTURE(seed);
        CAPTURE(std::string(given.image.name));
        CAPTURE(worst.where);
        CHECK(worst.difference <= within);
        ++compared;
      }
    }
    return compared;
  }

  TEST_CASE("four tunnels and their images: every figure that the program writes stays") {
    CHECK(check(1, 4) == 24);  // all: no rock falls in these
  }
  TEST_CASE("more tunnels and their images: every figure that the program writes stays [long]") {
    CHECK(check(5, 20) > 48);  // of 96
  }
}

}  // namespace program_ties_test
