// SPDX-License-Identifier: MIT
// Blocks that are laid one by one, from an input file to results, through the executable.
#include "support/blocks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <voussoir/voussoir.hpp>

#include "harness.hpp"
#include "run_results.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace program_blocks_test {

namespace {

using namespace voussoir_test;
using Json = nlohmann::json;

/// Two blocks of 1 m on a base, the upper one loaded, the base moved.
const std::string stack = R"([rock]
density = "2500 kg/m^3"
[joint]
kn = "10 GPa/m"
ks = "4 GPa/m"
friction = "35 deg"
[[block]]
name = "base"
fixed = true
vertices = [["-2 m", "-1 m"], ["2 m", "-1 m"], ["2 m", "0 m"], ["-2 m", "0 m"]]
[[block]]
vertices = [["0.5 m", "0 m"], ["0.5 m", "1 m"], ["-0.5 m", "1 m"], ["-0.5 m", "0 m"]]
[[block]]
name = "top"
vertices = [["-0.5 m", "1 m"], ["-0.5 m", "2 m"], ["0.5 m", "2 m"], ["0.5 m", "1 m"]]
)";
const std::string loaded = stack + R"([[load]]
block = "top"
force = ["2 kN/m", "-5 kN/m"]
at = ["0.25 m", "2 m"]
kind = "dead"
[[load]]
block = 2
moment = "1 kN m/m"
[[displacement]]
block = "base"
by = ["1 mm", "-3 mm"]
[seismic]
kh = "5 %"
[loading]
steps = 4
)";

/// The cells of the row of a table that begins with `first`.
std::vector<std::string> row_of(const std::string& table, const std::string& first) {
  std::istringstream in(table);
  for (std::string line; std::getline(in, line);) {
    auto cells = csv_fields(line);
    if (cells.front() == first) return cells;
  }
  FAIL("no row of " << first);
  return {};
}

}  // namespace

TEST_SUITE("program/blocks") {
  TEST_CASE("the numbers of a run are those of the C++ interface, and balance") {
    const Results r = results_of(loaded);
    CHECK(r.outcome.status == 0);
    CHECK(r.json.at("verdict") == "stands");
    CHECK(r.json.at("stages").size() == 5);
    CHECK(r.json.at("stands_up_to_part_of_loading") == 1.0);

    using namespace voussoir;
    Solver<> solver(laid_blocks<Planar>({rectangle({0, -0.5}, 4, 1), rectangle({0, 0.5}, 1, 1),
                                         rectangle({0, 1.5}, 1, 1)}),
                    CoulombJoint({1e10, 4e9, 35 * degree}), {.density = 2500, .is_laid = true});
    solver.fix(0);
    // Its arm is 0.25 m to the right and 0.5 m up.
    solver.add_load(2, {Vec2(2e3, -5e3), Spin<2>(0.25 * -5e3 - 0.5 * 2e3)});
    (void)solver.equilibrium();
    solver.add_load(1, {zeros<Vec2>(), Spin<2>(1e3)});
    solver.add_body_force(Vec2(0.05, 0));
    const auto reports = load_in_steps(solver, {{0, Vec2(0.001, -0.003)}}, 4);
    REQUIRE(reports.back().verdict == Verdict::stable);
    for (const auto& [name, block] : {std::pair{"base", 0}, {"2", 1}, {"top", 2}}) {
      const auto cells = row_of(r.files.at("blocks.csv"), name);
      const Vec2 moved = 1e3 * solver.displacement_of(block, solver.system().body(block).centre);
      // The table has 8 digits of millimetres.
      CHECK(std::stod(cells[5]) == near(moved.x()).epsilon(1e-7));
      CHECK(std::stod(cells[6]) == near(moved.y()).epsilon(1e-7));
    }
    // Onto the base: the weight of 2 m2, the dead load, and 5 % of the weight sideways. A state
    // counts as balanced up to 1 % of a block's weight.
    const Json& base = r.json.at("loads_on_fixed_blocks").at(0);
    const double weight = 2 * 2.5 * 9.81;
    CHECK(base.at("force_y_kN_per_m").get<double>() == near(-weight - 5).epsilon(0.005));
    CHECK(base.at("force_x_kN_per_m").get<double>() == near(0.05 * weight + 2).epsilon(0.05));
    const std::string& picture = r.files.at("blocks.svg");
    CHECK(picture.find("</svg>") != std::string::npos);
    CHECK(picture.find("load, 5.39 kN/m") != std::string::npos);  // of 2 and -5
    CHECK(picture.find("<title>load\n1.00 kN m/m\ncomes on with the loading") != std::string::npos);
  }

  TEST_CASE("a block on an incline slides at its friction angle, by every procedure") {
    const double s = std::sin(std::numbers::pi / 6), c = std::cos(std::numbers::pi / 6);
    const auto corner = [&](double x, double y) {
      std::ostringstream text;
      text.precision(17);
      text << "[\"" << x * c - y * s << " m\", \"" << x * s + y * c << " m\"]";
      return text.str();
    };
    const std::string incline =
        "[rock]\ndensity = \"2500 kg/m^3\"\n[joint]\nkn = \"10 GPa/m\"\nks = \"10 GPa/m\"\n"
        "friction = \"31 deg\"\n[[block]]\nfixed = true\nvertices = [" +
        corner(-1, -1) + ", " + corner(5, -1) + ", " + corner(5, 0) + ", " + corner(-1, 0) +
        "]\n[[block]]\nname = \"slab\"\nvertices = [" + corner(2, 0) + ", " + corner(4, 0) + ", " +
        corner(4, 1) + ", " + corner(2, 1) + "]\n";
    for (const char* method : {"two-level", "relaxation", "explicit"}) {
      CAPTURE(method);
      const std::string by = std::string("run.method=") + method;
      CHECK(results_of(incline, {"--set", by}).outcome.status == 0);
      const Results falls = results_of(incline, {"--set", by, "--set", "joint.friction=29 deg"});
      CHECK(falls.outcome.status == 7);
      CHECK(falls.json.at("verdict") == "falls");
      CHECK(falls.json.at("fallen_blocks") == Json::array({"slab"}));
    }
  }

  TEST_CASE("pushed in steps: the part of the loading up to which it stands") {
    // A column of 1 m x 2 m topples about its edge at kh = 1 / 2; it slides at 0.7.
    const Results r = results_of(stack, {"--set", "seismic.kh=1", "--set", "loading.steps=50"});
    // The upper block comes off; without it the lower one stands up to kh = 0.7.
    CHECK(r.outcome.status == 6);
    CHECK(r.json.at("stands_up_to_part_of_loading").get<double>() ==
          near(0.49).epsilon(0.03));  // a step is 0.02
  }

  TEST_CASE("an arch stands up to its limit, and falls beyond it") {
    // The joints of examples/blocks/arch.csv bear kh = 0.1446 by limit analysis; k_n of 1e12 Pa/m.
    // In ten steps: all of it at once would swing the arch over at 0.98.
    for (const double part : {0.98, 1.02}) {
      CAPTURE(part);
      const Folder folder;
      const Outcome outcome =
          run_program({"run", VOUSSOIR_TEST_EXAMPLES "/blocks/arch.toml", "--set",
                       "seismic.kh=" + std::to_string(part * 0.1446), "--out", folder / "out"});
      INFO(outcome.err);
      const Json json = Json::parse(read_file(folder / "out/run.json"));
      CHECK(json.at("verdict") == (part < 1 ? "stands" : "falls"));
    }
  }

  TEST_CASE("what makes no sense is refused with place and remedy, all at once") {
    struct Fault {
      std::string from, to;
      std::vector<std::string> named;
    };
    const std::vector<Fault> faults = {
        {R"(["0.5 m", "1 m"], ["-0.5 m", "1 m"])",
         R"(["-0.4 m", "0.1 m"], ["-0.5 m", "1 m"])",
         {"block[1].vertices is no block", "non-convex", "convex polygon"}},
        {R"(["0.5 m", "1 m"], ["-0.5 m", "1 m"])",
         R"(["-0.5 m", "1 m"], ["0.5 m", "1 m"])",
         {"block[1].vertices is no block"}},
        {R"(, ["2 m", "0 m"], ["-2 m", "0 m"]])", "]", {"block[0].vertices", "2 entries"}},
        {R"(["-0.5 m", "1 m"], ["-0.5 m", "2 m"])",
         R"(["-0.5 m", "0.99 m"], ["-0.5 m", "2 m"])",
         {"overlaps: blocks \"2\" and \"top\" by"}},
        {"fixed = true", "fixed = false", {"no fixed block", "is free", "fixed = true"}},
        {"fixed = true", "fixed = 1", {"block[0].fixed = 1", "true or false"}},
        {"block = \"top\"", "block = \"topp\"", {"load[0].block", "did you mean \"top\""}},
        {"block = \"top\"", "block = \"base\"", {"load[0].block", "is fixed"}},
        {"block = \"base\"", "block = 2", {"displacement[0].block = 2", "is free"}},
        {"name = \"top\"", "name = \"base\"", {"block[2].name", "another block"}},
        {"\"2 kN/m\"", "\"2 kN\"", {"load[0].force[0]", "not a force per metre", "kN/m"}},
        {"moment = \"1 kN m/m\"", "kind = \"dead\"", {"load[1].force is missing"}},
        {"[rock]", "[tunnel]\nshape = \"circle\"\n[rock]", {"tunnel stands beside blocks"}},
        {"kh = \"5 %\"", "kh = 20", {"seismic.kh = 20", "from -1000 % to 1000 %"}},
        {"steps = 4", "steps = 0", {"loading.steps = 0"}},
        {"[[load]]\nblock = 2", "[[load]]\nblock = 9", {"load[1].block = 9", "names no block"}},
    };
    for (const Fault& fault : faults) {
      CAPTURE(fault.to);
      const Folder folder;
      const std::string file =
          write_file(folder / "case.toml", replaced(loaded, fault.from, fault.to));
      const Outcome outcome = run_program({"run", file, "--out", folder / "out"});
      CHECK(outcome.status == 2);
      CHECK(!std::filesystem::exists(folder / "out"));
      for (const std::string& text : fault.named) {
        CAPTURE(outcome.err);
        CHECK(outcome.err.find(text) != std::string::npos);
      }
    }
    const Folder folder;
    const std::string tunnel =
        write_file(folder / "tunnel.toml", InputText{}.text() + "[[load]]\nblock = 1\n");
    const Outcome refused = run_program({"run", tunnel, "--out", folder / "out"});
    CHECK(refused.status == 2);
    CHECK(refused.err.find("load[0].block belongs to blocks that are laid only") !=
          std::string::npos);
    CHECK(refused.err.find("load[0].at is missing") != std::string::npos);
    const Outcome swept = run_program({"sweep", write_file(folder / "stack.toml", loaded), "--vary",
                                       "seismic.kh=0.1, 0.2", "--out", folder / "out"});
    CHECK(swept.status == 2);
    CHECK(swept.err.find("blocks that are laid") != std::string::npos);
  }

  TEST_CASE("a block that touches at a corner alone, or lies apart, is named") {
    const std::vector<std::string> loose = {
        R"([["0 m", "0 m"], ["1 m", "1 m"], ["0 m", "2 m"], ["-1 m", "1 m"]])",
        R"([["0 m", "1 mm"], ["1 m", "1 mm"], ["1 m", "1 m"]])",
        R"([["2 m", "0 m"], ["3 m", "0 m"], ["3 m", "1 m"], ["2 m", "1 m"]])"};
    const std::string base = stack.substr(0, stack.find("[[block]]\nvertices"));
    REQUIRE(base.size() < stack.size());
    for (const std::string& vertices : loose) {
      CAPTURE(vertices);
      const Folder folder;
      const Outcome outcome = run_program(
          {"run",
           write_file(folder / "case.toml",
                      base + "[[block]]\nname = \"stone\"\nvertices = " + vertices + "\n"),
           "--out", folder / "out"});
      CHECK(outcome.status == 7);
      CHECK(outcome.out.find("nothing holds block \"stone\": ") != std::string::npos);
    }
    const Folder folder;
    CHECK(run_program({"run", write_file(folder / "case.toml", stack), "--out", folder / "out"})
              .out.find("nothing holds") == std::string::npos);
  }

  TEST_CASE("a file of blocks: rows of corners, refused with the number of the line") {
    const Folder folder;
    const std::string head =
        "[rock]\ndensity = \"2500 kg/m^3\"\n[joint]\nkn = \"10 GPa/m\"\nks = \"10 GPa/m\"\n"
        "friction = \"35 deg\"\n[blocks]\nfile = \"rows.csv\"\nfixed = [1]\n";
    const std::string rows =
        "id,x,y\n# base\n1,-2,-1\n1,2,-1\n1,2,0\n1,-2,0\n\n2,-0.5,0\n2,0.5,0\n2,0.5,1\n2,-0.5,1\n";
    const std::string file = write_file(folder / "case.toml", head);
    const auto run_with = [&](const std::string& text) {
      write_file(folder / "rows.csv", text);
      return run_program({"run", file, "--out", folder / "out"});
    };
    CHECK(run_with(rows).status == 0);
    const auto refused = [&](const std::string& text, const std::string& part) {
      const Outcome outcome = run_with(text);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find(part) != std::string::npos);
    };
    refused(replaced(rows, "2,0.5,0\n", "2;0.5;0\n"), "line 9");
    refused(replaced(rows, "2,0.5,1\n", "2,0.5,one\n"), "line 10");
    refused(rows + "1,9,9\n1,10,9\n1,9,10\n", "\"1\" twice");
    refused("id,x,y\n", "no block in it");
    std::filesystem::remove(folder / "rows.csv");
    CHECK(run_program({"run", file, "--out", folder / "out"}).err.find("no regular file") !=
          std::string::npos);
  }
}

}  // namespace program_blocks_test
