// SPDX-License-Identifier: MIT
// What has no strength is not checked, and says so; what has reached its strength is said by every
// verb, not by the run alone.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "harness.hpp"
#include "support/near.hpp"
#include "table_rows.hpp"

namespace program_strength_test {

#ifdef VOUSSOIR_TEST_PROGRAM

using namespace voussoir_test;
using Json = nlohmann::json;

namespace {

const std::string words = "no strength was given: not checked";

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A tunnel with bolts that have no strength and an arch on feet that have none.
std::string unchecked() {
  InputText input;
  input.bolts = replaced(input.bolts, "rupture_force = \"200 kN\"\n", "");
  input.lining +=
      "arc = [\"0 deg\", \"180 deg\"]\n[support.lining.feet]\nstiffness = \"2 GPa/m\"\n"
      "width = \"0.2 m\"\n";
  return input.text();
}

struct Run {
  Outcome outcome;
  Json json;
  std::string folder;
};

Run run(const Folder& folder, const std::string& file, const std::vector<std::string>& sets,
        const std::string& name) {
  std::vector<std::string> arguments = {"run", file, "--out", folder / name};
  for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
  const Outcome outcome = run_program(arguments);
  return {outcome, Json::parse(read_file(folder / (name + "/run.json"))), folder / name};
}

std::string with_unit(double newton) { return std::to_string(newton) + " N"; }

}  // namespace

TEST_SUITE("program/strength") {
  TEST_CASE("without a strength: said on screen, in run.json and in tables, and no figure of it") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", unchecked());
    const Run plain = run(folder, file, {}, "plain");
    CAPTURE(plain.outcome.out);
    REQUIRE(plain.outcome.status == 0);
    const Json &bolts = plain.json["bolts"], &lining = plain.json["lining"];
    CHECK(bolts["strength"] == words);
    CHECK(bolts["of_its_strength"].is_null());
    CHECK(lining["strength"] == words);
    CHECK(lining["of_its_strength"].is_null());
    REQUIRE(lining["feet"].size() == 2);
    for (const Json& foot : lining["feet"]) {
      CHECK(foot["of_its_strength"].is_null());
      CHECK(foot["strength"] == words);
      // Elastic: the bearing over stiffness and width.
      const double bearing = foot["bearing_kN_per_m"];
      REQUIRE(bearing > 0);
      CHECK(foot["settlement_mm"].get<double>() == near(1e6 * bearing / (2e9 * 0.2)).epsilon(1e-9));
      CHECK(foot["settlement_that_stays_mm"] == 0);
    }
    // The stress in a bar of 28 mm, and in a section 8 cm thick of thrust and moment at one node.
    const double force = bolts["largest_force_kN"], stress = bolts["largest_stress_in_bar_MPa"];
    CHECK(stress == near(1e-3 * force / (std::numbers::pi * 0.014 * 0.014)).epsilon(1e-9));
    CHECK(lining["largest_stress_MPa"].get<double>() <=
          1e-3 * lining["largest_thrust_kN_per_m"].get<double>() / 0.08 +
              6e-3 * lining["largest_moment_kNm_per_m"].get<double>() / (0.08 * 0.08) + 1e-9);
    CHECK(says(plain.outcome.out, "strength bolts (up to "));
    CHECK(says(plain.outcome.out, " MPa in a bar of 28 mm), lining (up to "));
    CHECK(says(plain.outcome.out, "feet of the lining: " + words));
    CHECK(cell(read_file(plain.folder + "/bolts.csv"), 1, "of_its_strength") == "-");
    CHECK(cell(read_file(plain.folder + "/lining.csv"), 1, "of_its_strength") == "-");

    const Run given = run(folder, file,
                          {"support.bolts.yield_force=500 kN", "support.bolts.rupture_force=600 kN",
                           "support.lining.feet.strength=50 MPa"},
                          "given");
    CAPTURE(given.outcome.out);
    CHECK(given.json["bolts"]["strength"] == "500 kN");
    CHECK(given.json["bolts"]["of_its_strength"].get<double>() == near(force / 500).epsilon(1e-6));
    CHECK(!says(given.outcome.out, "strength bolts"));
    CHECK(says(given.outcome.out, "strength lining (up to "));
    CHECK(!says(given.outcome.out, "feet of the lining: "));
    const std::string table = read_file(given.folder + "/bolts.csv");
    CHECK(std::stod(cell(table, 1, "of_its_strength")) ==
          near(std::stod(cell(table, 1, "axial_force_kN")) / 500).epsilon(1e-6));
    for (const Json& foot : given.json["lining"]["feet"])
      CHECK(foot["of_its_strength"].get<double>() ==
            near(1e3 * foot["bearing_kN_per_m"].get<double>() / (50e6 * 0.2)).epsilon(1e-9));
    const Run bare = run(folder, file, {}, "bare");
    CHECK(bare.outcome.status == 0);
  }

  TEST_CASE("the bond of bolts is checked at every joint, and no force changes by it") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", unchecked());
    const Run plain = run(folder, file, {}, "plain");
    const std::string before = read_file(plain.folder + "/bolts.csv");
    REQUIRE(plain.outcome.status == 0);
    const auto value = [](const std::string& table, std::size_t row, const char* column) {
      return std::stod(cell(table, row, column));
    };
    for (const double plate : {0.0, 40e3}) {
      CAPTURE(plate);
      const double bond = 50e3;
      const Run held = run(
          folder, file,
          {"support.bolts.bond_strength=" + std::to_string(bond) + " N/m",
           "support.bolts.plate_strength=" + with_unit(plate), "support.bolts.rupture_force=60 MN"},
          "held");
      CAPTURE(held.outcome.out);
      REQUIRE(held.outcome.status == 0);
      const std::string table = read_file(held.folder + "/bolts.csv");
      const Json& bolts = held.json["bolts"];
      double most = 0;
      std::size_t rows = 0;
      for (const char c : table) rows += c == '\n';
      for (std::size_t row = 1; row < rows; ++row) {
        CHECK(cell(table, row, "axial_force_kN") == cell(before, row, "axial_force_kN"));
        const double at = value(table, row, "distance_from_head_m");
        const double length = 2;  // of InputText
        const double strength = 1e-3 * std::min(bond * (length - at), bond * at + plate);
        CHECK(value(table, row, "strength_kN") == near(strength).epsilon(1e-6));
        const double part = std::max(0.0, value(table, row, "axial_force_kN") / strength);
        CHECK(std::max(0.0, value(table, row, "of_its_strength")) == near(part).epsilon(1e-6));
        if (part > most) {
          most = part;
          CHECK(cell(table, row, "mode") != "-");
        }
      }
      CHECK(bolts["of_its_strength"].get<double>() == near(most).epsilon(1e-6));
      const Json& at = bolts["governing"];
      CHECK(at["axial_force_kN"].get<double>() / at["strength_kN"].get<double>() ==
            near(most).epsilon(1e-6));
      CHECK(says(held.outcome.out,
                 "% of the strength of bolt " + std::to_string(at["bolt"].get<int>()) + ": "));
      CHECK(says(held.outcome.out, "warning  bolts carry more than their bond bears") ==
            (most > 1));
      CHECK(!says(held.outcome.out, "strength bolts"));
    }
    const Outcome refused =
        run_program({"check", file, "--set", "support.bolts.plate_strength=40 kN"});
    CHECK(refused.status == 2);
    CHECK(says(refused.err, "plate_strength"));
    CHECK(says(refused.err, "bond_strength"));
  }

  TEST_CASE("a plate on shotcrete bears no more than that does before it is punched") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", InputText{}.text());
    // 8 cm; f_ctk = 0.7 x 0.3 MPa of 1 MPa; 4 (c + t) t f_ctd / 1.5 = 6.69 kN.
    const double punching = 4 * 0.28 * 0.08 * (0.21e6 * 0.8 / 1.5) / 1.5, bond = 10e3;
    const std::vector<std::string> sets{
        "support.bolts.bond_strength=10 kN/m", "support.bolts.plate_strength=40 kN",
        "support.bolts.rupture_force=60 MN", "support.lining.concrete={fck=\"1 MPa\"}"};
    std::vector<std::string> with_width = sets;
    with_width.emplace_back("support.bolts.plate_width=20 cm");
    const Run wide = run(folder, file, sets, "wide"), held = run(folder, file, with_width, "held");
    const std::string table = read_file(held.folder + "/bolts.csv"),
                      before = read_file(wide.folder + "/bolts.csv");
    const auto rows = static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n'));
    REQUIRE(rows > 2);
    std::size_t punched = 0;
    for (std::size_t row = 1; row < rows; ++row) {
      CHECK(cell(table, row, "axial_force_kN") == cell(before, row, "axial_force_kN"));
      const double at = std::stod(cell(table, row, "distance_from_head_m")), length = 2;
      CHECK(std::stod(cell(table, row, "strength_kN")) ==
            near(1e-3 * std::min(bond * (length - at), bond * at + punching)).epsilon(1e-6));
      CHECK(std::stod(cell(before, row, "strength_kN")) ==
            near(1e-3 * std::min(bond * (length - at), bond * at + 40e3)).epsilon(1e-6));
      if (cell(table, row, "mode") == "punching") {
        CHECK(bond * at < punching);
        ++punched;
      }
    }
    CHECK(punched > 0);
    const Outcome refused =
        run_program({"check", file, "--set", "support.bolts.bond_strength=50 kN/m", "--set",
                     "support.bolts.plate_width=20 cm"});
    CHECK(refused.status == 2);
    CHECK(says(refused.err, "plate_strength"));
  }

  TEST_CASE("bolts that have yielded and feet at their strength are in every table and verdict") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", unchecked());
    const Run plain = run(folder, file, {}, "plain");
    const double force = plain.json["bolts"]["largest_force_kN"],
                 bearing = plain.json["lining"]["feet"][0]["bearing_kN_per_m"];
    const std::string weak_bolts = "support.bolts.yield_force=" + with_unit(0.5e3 * force),
                      weak_feet =
                          "support.lining.feet.strength=" + std::to_string(0.5e3 * bearing / 0.2) +
                          " Pa";

    const Run weak = run(folder, file, {weak_bolts, weak_feet}, "weak");
    CAPTURE(weak.outcome.out);
    REQUIRE(weak.outcome.status == 0);
    CHECK(says(weak.outcome.out, "warning  bolts yielded at "));
    CHECK(says(weak.outcome.out,
               "warning  a foot of the lining has reached its bearing strength at ("));
    CHECK(weak.json["lining"]["feet"][0]["of_its_strength"].get<double>() == near(1).epsilon(1e-9));
    CHECK(weak.json["lining"]["feet"][0]["settlement_that_stays_mm"] > 0);

    const auto many = [&](std::vector<std::string> arguments, const std::string& name,
                          const std::vector<std::string>& sets) {
      arguments.insert(arguments.begin() + 1, {file, "--out", folder / name});
      for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
      const Outcome outcome = run_program(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 0);
      return outcome.out;
    };
    const std::string sweep =
        many({"sweep", "--vary", "support.bolts.yield_force=500 kN, " + with_unit(0.5e3 * force)},
             "sweep", {});
    CAPTURE(sweep);
    CHECK(says(sweep, "2 stable; 1 of those that stand with supports at their strength"));
    CHECK(says(sweep, "strength lining, feet of the lining: " + words));
    const std::string rows = read_file(folder / "sweep/sweep.csv");
    CHECK(cell(rows, 1, "verdict") == "stable");
    CHECK(cell(rows, 1, "bolt_joints_yielded") == "0");
    CHECK(std::stod(cell(rows, 1, "largest_bolt_force_of_its_strength")) ==
          near(force / 500).epsilon(1e-5));  // six digits are written
    CHECK(cell(rows, 2, "verdict") == "stable, bolts yielded");
    CHECK(std::stoi(cell(rows, 2, "bolt_joints_yielded")) > 0);
    CHECK(cell(rows, 2, "bolt_joints_ruptured") == "0");
    CHECK(cell(rows, 2, "feet_yielded") == "0");

    const std::string realised = many({"realisations", "-n", "1"}, "realisations", {weak_feet});
    CAPTURE(realised);
    CHECK(says(realised, "1 stable; 1 of those that stand with supports at their strength"));
    CHECK(says(realised, "strength bolts, lining: " + words));
    const std::string row = read_file(folder / "realisations/realisations.csv");
    CHECK(cell(row, 1, "verdict") == "stable, feet at their strength");
    CHECK(cell(row, 1, "largest_bolt_force_of_its_strength") == "-");
    const Json json = Json::parse(read_file(folder / "realisations/realisations.json"));
    CHECK(json["supports_yielded"] == 1);
    CHECK(json["not_checked"] == Json({"bolts", "lining"}));

    const std::string diagram = many(
        {"diagram", "--set", R"(diagram={spacing=["30 deg", "none"], thickness=["0 cm", "8 cm"]})"},
        "diagram", {weak_bolts});
    CAPTURE(diagram);
    CHECK(says(diagram, "y: supports have reached their strength"));
    const std::string cells = read_file(folder / "diagram/interaction.csv");
    CHECK(cell(cells, 2, "verdict") == "stable, bolts yielded");
    CHECK(cell(cells, 4, "bolt_joints_yielded") == "0");  // of no bolts
    CHECK(says(read_file(folder / "diagram/interaction.svg"),
               "stable with supports at their strength"));
  }
}

#endif

}  // namespace program_strength_test
