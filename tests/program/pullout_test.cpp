// SPDX-License-Identifier: MIT
// Bolts by their bar from an input file: the pull-out test by hand, in a tunnel what they carry of
// which strength, and what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "run_results.hpp"
#include "support/near.hpp"
#include "table_rows.hpp"

namespace pullout_test {

using namespace voussoir_test;

namespace {

constexpr const char* stiffness = "stiffness = \"0.2 GN/m\"\nrupture_force = \"200 kN\"\n";
/// A strand of 15.2 mm.
const std::string strand =
    "area = \"181 mm^2\"\nE = \"98.6 GPa\"\nbond_stiffness = \"112 MN/m/m\"\n"
    "bond_strength = \"0.175 MN/m\"\n";

/// The small input with bolts that are these.
std::string with_bolts(const std::string& keys, const std::string& length = "2 m") {
  InputText input;
  input.bolts = replaced(replaced(input.bolts, stiffness, keys), "\"2 m\"", "\"" + length + "\"");
  return input.text();
}

struct PulledOut {
  Outcome outcome;
  std::map<std::string, std::string> files;
};
PulledOut pull_out(const std::string& text, const std::vector<std::string>& more = {}) {
  const Folder folder;
  std::vector<std::string> arguments{"pullout", write_file(folder / "cables.toml", text), "--out",
                                     folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  PulledOut made{run_program(arguments), {}};
  for (const auto& [path, content] : contents(folder / "out"))
    made.files[std::filesystem::path(path).filename().string()] = content;
  return made;
}
bool says(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}
double event(const nlohmann::json& test, const std::string& what, const char* value) {
  for (const nlohmann::json& at : test.at("events"))
    if (at.at("what") == what) return at.at(value).get<double>();
  return -1;
}

}  // namespace

TEST_SUITE("program/pullout") {
  TEST_CASE("a strand in a long hole: 44.7 MN/m, first slip at 1.56 mm and 69.9 kN") {
    const PulledOut made = pull_out(with_bolts("name = \"cables\"\n" + strand, "5 m"));
    CAPTURE(made.outcome.err);
    REQUIRE(made.outcome.status == 0);
    CHECK(says(made.outcome.out, "cables, bonded over 5 m: head stiffness 44.7 MN/m\n"));
    CHECK(says(made.outcome.out, "bond begins to slip at 1.56 mm and 69.9 kN\n"));
    const auto test = nlohmann::json::parse(made.files.at("pullout.json")).at("tests").at(0);
    // sqrt(112 x 17.8466) and, all slipped, u_s + s L^2 / 2 E A = 1.5625 + 122.57 mm at 875 kN.
    CHECK(test.at("head_stiffness_MN_per_m").get<double>() ==
          near(std::sqrt(112 * 17.8466)).epsilon(1e-9));
    CHECK(event(test, "bond begins to slip", "displacement_mm") == near(1.5625).epsilon(1e-9));
    CHECK(event(test, "all of the bond slips", "force_kN") == near(875).epsilon(1e-9));
    CHECK(event(test, "all of the bond slips", "displacement_mm") ==
          near(1.5625 + 175 * 25 / (2 * 17.8466)).epsilon(1e-6));
    // The table is the curve: up to its first row that slips a straight line.
    const auto rows = rows_of(made.files.at("pullout.csv"));
    REQUIRE(rows.size() > 10);
    CHECK(rows.front().at("force_kN") == "0");
    CHECK(std::stod(rows[1].at("force_kN")) / std::stod(rows[1].at("displacement_mm")) ==
          near(44.708).epsilon(1e-4));
    CHECK(says(made.files.at("pullout.svg"), "displacement of the head [mm]"));
  }

  TEST_CASE("docs/input.md prints what the program says") {
    const PulledOut made =
        pull_out(with_bolts("name = \"cables\"\nyield_force = \"250 kN\"\n" + strand),
                 {"--length", "1 m", "--length", "3 m"});
    REQUIRE(made.outcome.status == 0);
    const std::string page = read_file(std::string(VOUSSOIR_TEST_EXAMPLES) + "/../docs/input.md");
    std::size_t lines = 0;
    for (std::size_t at = 0, end; (end = made.outcome.out.find('\n', at)) != std::string::npos;
         at = end + 1) {
      const std::string line = made.outcome.out.substr(at, end - at);
      if (line.starts_with("written")) continue;
      CAPTURE(line);
      CHECK(says(page, "    " + line + "\n"));
      ++lines;
    }
    CHECK(lines == 8);
  }

  TEST_CASE("end-anchored: bar and anchor in series, and what gives first") {
    // 2 m of 300 mm2 x 200 GPa: 30 MN/m, on an anchor of 20 MN/m: 12 MN/m.
    const std::string bolt =
        "type = \"end-anchored\"\narea = \"300 mm^2\"\nanchor_stiffness = \"20 MN/m\"\n";
    const PulledOut slips = pull_out(with_bolts(bolt + "anchor_strength = \"90 kN\"\n"));
    REQUIRE(slips.outcome.status == 0);
    CHECK(says(slips.outcome.out, "anchored at 2 m: head stiffness 12 MN/m\n"));
    CHECK(says(slips.outcome.out, "the anchor slips at 7.5 mm and 90 kN\n"));
    const PulledOut lost = pull_out(with_bolts(bolt + "plate_strength = \"60 kN\"\n"));
    CHECK(says(lost.outcome.out, "the bolt is lost at 5 mm and 60 kN\n"));
    const PulledOut yields =
        pull_out(with_bolts(bolt + "yield_force = \"120 kN\"\nrupture_elongation = \"40 mm\"\n"));
    CHECK(says(yields.outcome.out, "the bar yields at 10 mm and 120 kN\n"));
    CHECK(says(yields.outcome.out, "the bolt is lost at 50 mm and 120 kN\n"));
  }

  TEST_CASE("in a tunnel cables carry no more than their bond, which slips") {
    // Of 2 m with 1 kN/m no joint has more than 1 kN; what the model holds is what is checked.
    const std::string weak = replaced(strand, "0.175 MN/m", "1 kN/m");
    const Results run = results_of(with_bolts(weak));
    const auto rows = rows_of(run.files.at("bolts.csv"));
    REQUIRE(rows.size() > 3);
    bool slips = false;
    for (const auto& row : rows) {
      const double at = std::stod(row.at("distance_from_head_m")), strength = std::min(at, 2 - at);
      CHECK(std::stod(row.at("strength_kN")) == near(strength).epsilon(1e-6));
      CHECK(std::stod(row.at("axial_force_kN")) <= strength * (1 + 1e-6));
      slips = slips || row.at("state") == "yielded";
    }
    CHECK(slips);
    CHECK(run.json.at("bolts").at("of_its_strength").get<double>() <= 1);
    CHECK(!says(run.outcome.out, "more than their bond"));
  }

  TEST_CASE("in a tunnel an end-anchored bolt has one force, along all of it") {
    const Results run = results_of(with_bolts(
        "type = \"end-anchored\"\npretension = \"20 kN\"\nanchor_strength = \"80 kN\"\n"));
    const auto rows = rows_of(run.files.at("bolts.csv"));
    REQUIRE(!rows.empty());
    std::vector<std::string> bolts;
    for (const auto& row : rows) {
      bolts.push_back(row.at("bolt"));
      CHECK(row.at("mode") == "anchor");
      CHECK(std::stod(row.at("strength_kN")) == 80);
      CHECK(std::stod(row.at("axial_force_kN")) > 0);
    }
    CHECK(std::adjacent_find(bolts.begin(), bolts.end()) == bolts.end());
    CHECK(says(run.outcome.out, "of the strength of bolt "));
    CHECK(says(run.outcome.out, ": anchor\n"));
  }

  TEST_CASE("bad input") {
    struct Row {
      std::string keys, key, words;
    };
    const std::string ends = "type = \"end-anchored\"\n", old = stiffness;
    for (const Row& row :
         {Row{"bond_stiffness = \"112 MPa\"\n" + old, "bond_stiffness", "bond_strength"},
          Row{strand + "stiffness = \"0.2 GN/m\"\n", "stiffness", "without bond_stiffness"},
          Row{strand + "law = \"axial-shear\"\nshear_stiffness = \"1 MN/m\"\n", "law",
              "without bond_stiffness"},
          Row{old + "area = \"181 mm^2\"\n", "area", "bond_stiffness"},
          Row{old + "rupture_elongation = \"5 cm\"\n", "rupture_elongation", "yield_force"},
          Row{old + "anchor_strength = \"90 kN\"\n", "anchor_strength", "end-anchored"},
          Row{ends + "stiffness = \"0.2 GN/m\"\n", "stiffness", "grouted"},
          Row{ends + "anchors = \"lorig\"\n", "anchors", "grouted"},
          Row{ends + "bond_strength = \"100 kN/m\"\n", "bond_strength", "grouted"},
          Row{ends + "plate_strength = \"0 kN\"\n", "plate_strength", "without a plate"},
          Row{ends + "pretension = \"90 kN\"\nplate_strength = \"80 kN\"\n", "pretension",
              "not below plate_strength"},
          Row{ends + "pretension = \"90 kN\"\nanchor_strength = \"90 kN\"\n", "pretension",
              "not below anchor_strength"},
          Row{"yield_force = \"90 kN\"\nrupture_elongation = \"5 cm\"\n", "stiffness",
              "is missing"},
          Row{replaced(strand, "112 MN/m/m", "112 MN/m"), "bond_stiffness", "stress"},
          Row{"type = \"swellex\"\n" + strand, "type", "not one of its words"}}) {
      CAPTURE(row.keys);
      const PulledOut made = pull_out(with_bolts(row.keys));
      CAPTURE(made.outcome.err);
      CHECK(made.outcome.status == 2);
      CHECK(says(made.outcome.err, row.key));
      CHECK(says(made.outcome.err, row.words));
      CHECK(made.files.empty());
    }
    const PulledOut none = pull_out(with_bolts(old));
    CHECK(none.outcome.status == 2);
    CHECK(says(none.outcome.err, "support.bolts: says of no bolt how the rock holds its bar"));
    CHECK(none.files.empty());
    for (const std::string length : {"3", "0 m", "2 kN", "2 km", "nan"}) {
      CAPTURE(length);
      const PulledOut made = pull_out(with_bolts(strand), {"--length", length});
      CHECK(made.outcome.status == 2);
      CHECK(says(made.outcome.err, "--length " + length));
      CHECK(says(made.outcome.err, "accepted: from 1 cm to 1000 m"));
      CHECK(made.files.empty());
    }
  }
}

}  // namespace pullout_test
