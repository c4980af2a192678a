// SPDX-License-Identifier: MIT
// Several patterns of bolts in one input file: cut in two, or bar by bar, a pattern is the same
// support; each has its own law, strength and stage.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>

#include "harness.hpp"
#include "input.hpp"
#include "run_results.hpp"

namespace bolt_patterns_test {

using namespace voussoir_test;
using namespace voussoir::program;

namespace {

const std::string rock = CircleInRock{.length = "3 m"}.text();
const std::string law = "stiffness = \"0.2 GN/m\"\nyield_force = \"200 kN\"\n";
const std::string whole =
    "[support.bolts]\nlength = \"2 m\"\nspacing = \"30 deg\"\narc = [\"0 deg\", \"180 deg\"]\n" +
    law;
std::string part(const std::string& name, int from, int to, const std::string& of_law = law) {
  return "[[support.bolts]]\nname = \"" + name + "\"\nlength = \"2 m\"\nspacing = \"30 deg\"\n" +
         "arc = [\"" + std::to_string(from) + " deg\", \"" + std::to_string(to) + " deg\"]\n" +
         of_law;
}

Results standing(const std::string& text, const std::vector<std::string>& more = {}) {
  Results results = results_of(text, more);
  REQUIRE(results.outcome.status == 0);
  return results;
}
void check_same(const Results& a, const Results& b, double tolerance) {
  const auto same = [&](double x, double y) { CHECK(std::abs(x - y) <= tolerance * std::abs(y)); };
  for (const char* key : {"count", "largest_force_kN", "mean_of_largest_forces_kN"})
    same(a.json.at("bolts").at(key).get<double>(), b.json.at("bolts").at(key).get<double>());
  same(a.json.at("convergence").at("crown_mm").get<double>(),
       b.json.at("convergence").at("crown_mm").get<double>());
}

std::string said_of(const std::string& text) {
  try {
    (void)read_input_text(text, "case.toml", ".");
  } catch (const InputErrors& errors) {
    return errors.what();
  }
  return "";
}

}  // namespace

TEST_SUITE("program/bolt_patterns") {
  TEST_CASE("a pattern cut in two is the pattern, in 2-D and 3-D") {
    const std::string two = part("right", 0, 60) + part("left", 90, 180);
    for (const char* dimension : {"model.dimension=2", "model.dimension=3"}) {
      const Results one = standing(rock + whole, {"--set", dimension}),
                    cut = standing(rock + two, {"--set", dimension});
      CHECK(one.json.at("bolts").at("count").get<int>() % 7 == 0);
      // Springs are summed in another order; the search stops at its tolerance.
      check_same(cut, one, 1e-3);
    }
  }

  TEST_CASE("bar by bar it is the same support to the last digit") {
    const voussoir::BoltPattern pattern{2, 30 * std::numbers::pi / 180};
    std::string bars = "[support.bolts]\nbars = [";
    const auto point = [](const voussoir::Vec2& p) {
      return "[\"" + voussoir::shortest_text(p.x()) + " m\", \"" + voussoir::shortest_text(p.y()) +
             " m\"]";
    };
    for (const auto& bar :
         voussoir::bolt_bars(pattern, opening_of(read_input_text(rock + whole, "case.toml", "."))))
      bars += "[" + point(bar.start) + ", " + point(bar.end) + "], ";
    bars += "]\n" + law;
    for (const char* dimension : {"model.dimension=2", "model.dimension=3"})
      check_same(standing(rock + bars, {"--set", dimension}),
                 standing(rock + whole, {"--set", dimension}), 1e-9);
  }

  TEST_CASE("each pattern has its strength, in the table and in the largest part of it") {
    const std::string weak = "stiffness = \"0.2 GN/m\"\nrupture_force = \"60 kN\"\n",
                      none = "stiffness = \"0.2 GN/m\"\n";
    const Results run = standing(rock + part("crown", 60, 120, weak) + part("wall", 0, 30) +
                                 part("left", 150, 180, none));
    std::istringstream table(run.files.at("bolts.csv"));
    std::string line;
    std::getline(table, line);
    double most = 0;
    int of_each[3] = {0, 0, 0};
    while (std::getline(table, line)) {
      std::vector<std::string> fields;
      std::istringstream row(line);
      for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
      REQUIRE(fields.size() >= 10);
      const double angle = std::stod(fields[1]), force = std::stod(fields[6]);
      const double strength = angle > 45 && angle < 135 ? 60 : angle < 45 ? 200 : 0;
      ++of_each[strength == 60 ? 0 : strength == 200 ? 1 : 2];
      if (strength == 0) {
        CHECK(fields[9] == "-");
      } else {
        CHECK(std::abs(std::stod(fields[9]) - force / strength) < 1e-5);
        most = std::max(most, force / strength);
      }
    }
    for (const int count : of_each) CHECK(count > 0);
    CHECK(std::abs(run.json.at("bolts").at("of_its_strength").get<double>() - most) < 1e-5);
    CHECK(run.json.at("bolts").at("strength") == "60 kN");
  }

  TEST_CASE("a stage installs one pattern by its name, or all of them") {
    const std::string patterns = part("crown", 60, 120) + part("walls", 0, 30),
                      first = "[[stage]]\nwall_traction = \"40 %\"\ninstall = [\"crown\"]\n",
                      then = "[[stage]]\nwall_traction = \"0 %\"\ninstall = [\"walls\"]\n",
                      all = "[[stage]]\nwall_traction = \"0 %\"\ninstall = [\"bolts\"]\n";
    const Results staged = standing(rock + patterns + first + then),
                  at_once = standing(rock + patterns + all);
    CHECK(staged.json.at("bolts").at("count") == 5);
    CHECK(at_once.json.at("bolts").at("count") == 5);
    // What comes when most of the wall has moved carries less.
    CHECK(staged.json.at("bolts").at("mean_of_largest_forces_kN").get<double>() <
          at_once.json.at("bolts").at("mean_of_largest_forces_kN").get<double>());
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::string& text, std::initializer_list<const char*> words) {
      const std::string said = said_of(rock + text);
      CAPTURE(said);
      for (const char* word : words) CHECK(said.find(word) != std::string::npos);
    };
    const std::string two = part("a", 0, 60) + part("b", 90, 180);
    CHECK(said_of(rock + two) == "");
    refused(part("a", 0, 60) + part("a", 90, 180), {"support.bolts[1].name", "another pattern"});
    refused(part("lining", 0, 60), {"support.bolts[0].name", "another name"});
    refused(two + "[[stage]]\nwall_traction = 0\ninstall = [\"a\"]\n",
            {"support.bolts[1]", "is in no stage", "\"b\""});
    refused(two +
                "[[stage]]\nwall_traction = 0.2\ninstall = [\"a\", \"b\"]\n"
                "[[stage]]\nwall_traction = 0\ninstall = [\"bolts\"]\n",
            {"stage[1].install", "again"});
    refused(two + "[[stage]]\nwall_traction = 0\ninstall = [\"bolts\", \"b\"]\n",
            {"stage[0].install[1]", "twice"});
    refused(two + "[[stage]]\nwall_traction = 0\ninstall = [\"c\"]\n",
            {"stage[0].install", "\"a\""});
    refused(part("a", 0, 60) + "[[support.bolts]]\nlength = \"2 m\"\n",
            {"support.bolts[1]", "spacing"});
    refused("[support.bolts]\nbars = [[[\"0 m\", \"2 m\"], [\"0 m\", \"2 m\"]]]\n" + law,
            {"support.bolts.bars[0]", "no length"});
    refused(
        "[support.bolts]\nbars = [[[\"0 m\", \"2 m\"], [\"0 m\", \"4 m\"]]]\nlength = \"2 m\"\n" +
            law,
        {"support.bolts.length"});
    refused(part("a", 0, 60,
                 "stiffness = \"0.2 GN/m\"\nyield_force = \"90 kN\"\npretension = \"95 kN\"\n"),
            {"support.bolts[0].pretension", "yield_force"});
    const Folder folder;
    const Outcome outside = run_program(
        {"check",
         write_file(folder / "case.toml",
                    rock + "[support.bolts]\nbars = [[[\"0 m\", \"2 m\"], [\"0 m\", \"40 m\"]]]\n" +
                        law)});
    CHECK(outside.status == 2);
    CHECK(outside.err.find("outside the rock") != std::string::npos);
  }
}

}  // namespace bolt_patterns_test
