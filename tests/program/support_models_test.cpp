// SPDX-License-Identifier: MIT
// Every word by which an input file says what bolts and linings are made of, in 2-D and 3-D.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "run_results.hpp"
#include "support/near.hpp"

namespace support_models_test {

using namespace voussoir_test;

namespace {

/// Joints that hardly slip: an answer hangs on no path.
const std::string rock = CircleInRock{.K0 = "0.8"}.text();
std::string bolts(const std::string& more) {
  return "[[support.bolts]]\nlength = \"2 m\"\nspacing = \"30 deg\"\nstiffness = \"0.2 GN/m\"\n" +
         more;
}
/// A thick one of short pieces: what shears differs from what does not.
std::string lining(const std::string& more) {
  return "[[support.lining]]\nthickness = \"30 cm\"\nE = \"25 GPa\"\nnodes = 48\n"
         "interface = { kn = \"5 GPa/m\", friction = \"35 deg\" }\n" +
         more;
}
std::string made_of(const std::string& word) { return lining("beam = \"" + word + "\"\n"); }

const std::vector<std::string> section{}, spatial{"--set", "model.dimension=3"};

Results standing(const std::string& supports, const std::vector<std::string>& set) {
  Results results = results_of(rock + supports, set);
  REQUIRE(results.outcome.status == 0);
  REQUIRE(results.json.at("verdict") == "stable");
  return results;
}
std::string models(const Results& run) { return run.json.at("models").get<std::string>(); }
bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
double of(const Results& run, const char* table, const char* key) {
  return run.json.at(table).at(key).get<double>();
}
double moment(const Results& run) { return of(run, "lining", "largest_moment_kNm_per_m"); }
double thrust(const Results& run) { return of(run, "lining", "mean_thrust_kN_per_m"); }

/// A table without the number of the run in its last column, which is that of the file.
std::string figures(const Results& run, const char* name) {
  std::istringstream lines(run.files.at(name));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += line.substr(0, line.rfind(',')) + "\n";
  return text;
}

/// Rows of a table by lining, a column of it.
std::map<std::string, std::vector<double>> by_lining(const Results& run, const std::string& name) {
  std::map<std::string, std::vector<double>> values;
  std::istringstream lines(run.files.at("lining.csv"));
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream fields(line);
    for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> head = cells_of(line);
  const auto column = static_cast<std::size_t>(
      std::find_if(head.begin(), head.end(), [&](const auto& h) { return h.starts_with(name); }) -
      head.begin());
  REQUIRE(column < head.size());
  REQUIRE(head[0] == "lining");
  while (std::getline(lines, line)) {
    const auto cells = cells_of(line);
    values[cells[0]].push_back(std::stod(cells[column]));
  }
  return values;
}
double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

TEST_SUITE("program/support_models") {
  TEST_CASE("every word of a lining's beam, in 2-D and 3-D") {
    const std::map<std::string, std::string> words{{"euler-bernoulli", "EulerBernoulliBeam"},
                                                   {"timoshenko", "TimoshenkoBeam"},
                                                   {"pinned", "PinnedBar"},
                                                   {"bonded-chain", "BondedChain"}};
    for (const std::vector<std::string>& set : {section, spatial}) {
      CAPTURE(set.size());
      std::map<std::string, Results> runs;
      for (const auto& entry : words) {
        const auto& word = entry.first;
        const auto& model = entry.second;
        CAPTURE(word);
        Results run = standing(made_of(word), set);
        CHECK(has(models(run), ", " + model + " on CoulombJoint"));
        CHECK(thrust(run) > 100);
        CHECK(run.files.contains("blocks.svg"));
        runs.emplace(word, std::move(run));
      }
      // By default Euler and Bernoulli's.
      const Results unsaid = standing(lining(""), set);
      CHECK(unsaid.json.at("lining") == runs.at("euler-bernoulli").json.at("lining"));
      CHECK(figures(unsaid, "lining.csv") == figures(runs.at("euler-bernoulli"), "lining.csv"));
      // Shear makes a lining of 30 cm softer on stretches of 26 cm: it moves other figures.
      const double beam = moment(runs.at("euler-bernoulli")),
                   shears = moment(runs.at("timoshenko")), chain = moment(runs.at("bonded-chain"));
      CHECK(beam > 1);
      CHECK(std::abs(shears - beam) > 1e-3 * beam);
      // A chain is a Timoshenko beam but for the pieces, as short as the lining is thick.
      CHECK(std::abs(chain - shears) < 0.1 * shears);
      CHECK(chain != shears);
      CHECK(thrust(runs.at("bonded-chain")) == near(thrust(runs.at("timoshenko"))).epsilon(0.01));
      // A pinned one has thrust and nothing else.
      const Results& pinned = runs.at("pinned");
      CHECK(moment(pinned) == 0);
      CHECK(thrust(pinned) == near(thrust(runs.at("timoshenko"))).epsilon(0.1));
      for (const char* column : {"moment", "shear"})
        CHECK(largest(by_lining(pinned, column).at("1")) == 0);
      CHECK(largest(by_lining(pinned, "thrust").at("1")) > 100);
      CHECK(!has(pinned.files.at("blocks.svg"), "00000000"));  // a scale of next to nothing
      // Nothing bends, and nothing is said of nodes too far apart for that.
      CHECK(!has(pinned.outcome.out + pinned.outcome.err, "moments under a block"));
    }
  }

  TEST_CASE("a pinned lining and one that bends, in one model and end to end, in 2-D and 3-D") {
    for (const std::vector<std::string>& set : {section, spatial}) {
      CAPTURE(set.size());
      const Results run =
          standing(lining("beam = \"pinned\"\narc = [\"0 deg\", \"180 deg\"]\n") +
                       lining("beam = \"timoshenko\"\narc = [\"180 deg\", \"360 deg\"]\n"),
                   set);
      CHECK(has(models(run), "PinnedBar on CoulombJoint, TimoshenkoBeam on CoulombJoint"));
      const auto moments = by_lining(run, "moment"), thrusts = by_lining(run, "thrust");
      REQUIRE(moments.size() == 2);
      CHECK(largest(moments.at("2")) > 1);
      // In 2-D a node; in 3-D a member, of which those between the two are of the later one.
      CHECK(largest(moments.at("1")) == 0);
      for (const char* number : {"1", "2"}) CHECK(largest(thrusts.at(number)) > 100);
      const Results ring = standing(made_of("timoshenko"), set);
      CHECK(thrust(run) == near(thrust(ring)).epsilon(0.1));
    }
  }

  TEST_CASE("a tensile bond asks nothing of the nodes of a pinned lining") {
    const auto bonded = [](const std::string& word) {
      return rock + replaced(replaced(made_of(word), "nodes = 48", "nodes = 16"), "\"35 deg\" }",
                             "\"35 deg\", shear_bond = \"0.5 MPa\", tensile_bond = \"0.2 MPa\" }");
    };
    CHECK(results_of(bonded("pinned")).json.at("verdict") == "stable");
    const Folder folder;
    const Outcome refused = run_program(
        {"run", write_file(folder / "case.toml", bonded("timoshenko")), "--out", folder / "out"});
    CHECK(refused.status == 2);
    CHECK(has(refused.err, "too far to see the bond fail"));
  }

  TEST_CASE("every word of a bolt's law and anchors, in 2-D and 3-D") {
    const std::string axial = "law = \"axial\"\n",
                      dowelled = "law = \"axial-shear\"\nshear_stiffness = \"0.2 GN/m\"\n";
    const std::map<std::string, std::string> words{{"lorig", "LorigAnchors"},
                                                   {"garga-wang", "GargaWangAnchors"},
                                                   {"joint-face", "JointFaceAnchors"}};
    for (const std::vector<std::string>& set : {section, spatial}) {
      CAPTURE(set.size());
      std::vector<std::string> tables;
      for (const auto& entry : words)
        for (const std::string& law : {axial, dowelled}) {
          const auto& word = entry.first;
          const auto& model = entry.second;
          CAPTURE(word);
          const Results run = standing(bolts(law + "anchors = \"" + word + "\"\n"), set);
          CHECK(has(models(run),
                    ", " + model + ", " + (law == axial ? "AxialBolt" : "AxialShearBolt") + ","));
          CHECK(of(run, "bolts", "largest_force_kN") > 1);
          tables.push_back(figures(run, "bolts.csv"));
        }
      std::sort(tables.begin(), tables.end());
      CHECK(std::adjacent_find(tables.begin(), tables.end()) == tables.end());
      const Results unsaid = standing(bolts(""), set),
                    said = standing(bolts(axial + "anchors = \"lorig\"\n"), set);
      CHECK(figures(unsaid, "bolts.csv") == figures(said, "bolts.csv"));
    }
  }
  TEST_CASE("two patterns of a model each have their own law") {
    const std::string right = "arc = [\"0 deg\", \"90 deg\"]\n",
                      left = "arc = [\"100 deg\", \"180 deg\"]\n",
                      dowelled =
                          "law = \"axial-shear\"\nshear_stiffness = \"0.2 GN/m\"\n"
                          "anchors = \"joint-face\"\n";
    const Results run = standing(bolts(right) + bolts(left + dowelled), section);
    CHECK(has(models(run), "LorigAnchors, AxialBolt, JointFaceAnchors, AxialShearBolt"));
  }
}

}  // namespace support_models_test
