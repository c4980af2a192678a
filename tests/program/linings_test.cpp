// SPDX-License-Identifier: MIT
// Several linings from an input file: a ring in two parts, an arch and then walls, two layers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "run_results.hpp"

namespace linings_test {

using namespace voussoir_test;

namespace {

const std::string concrete =
    "thickness = \"20 cm\"\nE = \"25 GPa\"\n"
    "interface = { kn = \"5 GPa/m\", friction = \"35 deg\" }\nnodes = 36\n";

std::string lining(const std::string& rest) { return "[[support.lining]]\n" + concrete + rest; }

/// Without bolts, in joints that do not slip.
std::string tunnel(const std::string& supports) {
  InputText input;
  input.bolts = "";
  input.lining = supports;
  return replaced(input.text(), "friction = \"35 deg\"\n[blocks]",
                  "friction = \"70 deg\"\n[blocks]");
}

double of_lining(const Results& run, const char* key) {
  return run.json.at("lining").at(key).get<double>();
}
double crown(const Results& run) { return run.json.at("convergence").at("crown_mm").get<double>(); }
bool is_near(double a, double b, double part) { return std::abs(a - b) <= part * std::abs(b); }

const std::vector<std::string> section{},
    spatial{"--set", "model.dimension=3", "--set", "model.length=2 m"};

}  // namespace

TEST_SUITE("program/linings") {
  TEST_CASE("one of a list is the table") {
    const Results list = results_of(tunnel(lining(""))),
                  table = results_of(tunnel("[support.lining]\n" + concrete));
    CHECK(list.json.at("convergence") == table.json.at("convergence"));
    CHECK(list.json.at("lining") == table.json.at("lining"));
  }

  TEST_CASE("a ring in two parts is the ring, whichever comes first, in 2-D and 3-D") {
    const std::string roof = lining("arc = [\"0 deg\", \"180 deg\"]\n"),
                      floor = lining("arc = [\"180 deg\", \"360 deg\"]\n");
    for (const std::vector<std::string>& set : {section, spatial}) {
      CAPTURE(set.size());
      const Results ring = results_of(tunnel(lining("")), set);
      for (const std::string& parts : {roof + floor, floor + roof}) {
        const Results two = results_of(tunnel(parts), set);
        CHECK(two.json.at("verdict") == "stable");
        // The nodes are those of the ring; searches end at 1e-3.
        CHECK(is_near(crown(two), crown(ring), 2e-3));
        CHECK(is_near(of_lining(two, "mean_thrust_kN_per_m"),
                      of_lining(ring, "mean_thrust_kN_per_m"), 2e-2));
        CHECK(is_near(of_lining(two, "largest_moment_kNm_per_m"),
                      of_lining(ring, "largest_moment_kNm_per_m"), 2e-2));
      }
    }
  }

  TEST_CASE("an arch in one stage and walls in the next, each with its own thickness") {
    const auto text = [&](const char* walls) {
      return tunnel(
          lining("name = \"arch\"\narc = [\"0 deg\", \"180 deg\"]\n") +
          replaced(lining("name = \"walls\"\narc = [\"180 deg\", \"360 deg\"]\n"), "20 cm", walls) +
          "[[stage]]\nwall_traction = 0.5\n[[stage]]\nwall_traction = 0.2\n"
          "install = [\"arch\"]\n[[stage]]\nwall_traction = 0\ninstall = [\"walls\"]\n");
    };
    const Results alike = results_of(text("20 cm")), thin = results_of(text("5 cm"));
    const auto rows = [](const Results& run) {
      const std::string& table = run.files.at("lining.csv");
      return std::count(table.begin(), table.end(), '\n');
    };
    CHECK(rows(alike) == rows(thin));
    // Walls of a quarter of the thickness carry less, and bear more stress.
    CHECK(of_lining(thin, "mean_thrust_kN_per_m") < of_lining(alike, "mean_thrust_kN_per_m"));
    CHECK(of_lining(thin, "largest_stress_MPa") > of_lining(alike, "largest_stress_MPa"));
    const Folder folder;
    const Outcome check = run_program({"check", write_file(folder / "case.toml", text("20 cm"))});
    CHECK(check.status == 0);
    for (const char* word : {"installs arch", "installs walls"})
      CHECK(check.out.find(word) != std::string::npos);
  }

  TEST_CASE("two layers carry what one twice as thick does, where nothing bends") {
    // In compression: E t adds up; the rock on the layers by two interfaces of half the stiffness.
    const Results one = results_of(tunnel(replaced(lining(""), "20 cm", "10 cm"))),
                  two = results_of(tunnel(replaced(lining(""), "20 cm", "10 cm") +
                                          replaced(lining(""), "20 cm", "10 cm")));
    CHECK(two.json.at("verdict") == "stable");
    CHECK(crown(two) < crown(one));
    CHECK(of_lining(two, "mean_thrust_kN_per_m") < of_lining(one, "mean_thrust_kN_per_m"));
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::string& text, const std::vector<const char*>& words) {
      const Folder folder;
      const Outcome outcome =
          run_program({"run", write_file(folder / "case.toml", text), "--out", folder / "out"});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      for (const char* word : words) CHECK(outcome.err.find(word) != std::string::npos);
    };
    refused(tunnel(lining("name = \"roof\"\n") + lining("name = \"roof\"\n")),
            {"support.lining[1].name", "another support"});
    refused(tunnel(lining("name = \"bolts\"\n")), {"support.lining[0].name", "stands for all"});
    refused(tunnel(lining("") + replaced(lining(""), "20 cm", "9 m")),
            {"support.lining[1].thickness", "fills the opening"});
    refused(tunnel(lining("name = \"roof\"\n") + lining("") +
                   "[[stage]]\nwall_traction = 0\ninstall = [\"roof\"]\n"),
            {"support.lining[1]", "is in no stage", "lining 2"});
    refused(tunnel(lining("name = \"roof\"\n") +
                   "[[stage]]\nwall_traction = 0\ninstall = [\"rood\"]\n"),
            {"stage[0].install[0]", "did you mean \"roof\"?"});
    const std::string feet =
        "feet = { stiffness = \"2 GPa/m\", beam = { depth = \"30 cm\", E = \"30 GPa\", "
        "spacing = \"1 m\" } }\n";
    refused(tunnel(lining("arc = [\"0 deg\", \"180 deg\"]\n" + feet) + lining("")),
            {"support.lining[0].feet.beam", "only lining"});
  }
}

}  // namespace linings_test
