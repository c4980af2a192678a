// SPDX-License-Identifier: MIT
// Templates of `voussoir init`, and `voussoir check`: what is written runs as it is, and what is
// said before a run is what the run then has.
#include "templates.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "check.hpp"
#include "harness.hpp"
#include "input.hpp"
#include "plausibility.hpp"

namespace templates_test {

using namespace voussoir_test;
using namespace voussoir::program;

namespace {

std::string number_after(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  REQUIRE(at != std::string::npos);
  const auto from = at + words.size();
  return text.substr(from, text.find_first_not_of("0123456789", from) - from);
}

}  // namespace

TEST_SUITE("program/templates") {
  TEST_CASE("every template is written by init, read without a remark, and checked") {
    const Folder folder;
    const Outcome list = run_program({"init", "--list"});
    CHECK(list.status == 0);
    for (const Template& one : templates()) {
      const std::string name(one.name), file = folder / (name + ".toml");
      CAPTURE(name);
      CHECK(list.out.find(name + " ") != std::string::npos);
      CHECK(run_program({"init", name}).out == template_text(name));
      REQUIRE(run_program({"init", name, file}).status == 0);
      CHECK(read_file(file) == template_text(name));
      const Input input = read_input(file);
      CHECK(unusual_values(input).empty());
      CHECK(input.unused.empty());
      const Outcome checked = run_program({"check", file});
      INFO(checked.out);
      CHECK(checked.status == 0);
      CHECK(checked.out.find("warning") == std::string::npos);
      CHECK(checked.out.find("checked  the file can be run\n") != std::string::npos);
      const auto json = nlohmann::json::parse(run_program({"check", file, "--json"}).out);
      CHECK(json.at("dimension") == input.model.dimension);
      CHECK(json.at("stages").size() == input.stages.size());
      CHECK(json.at("warnings").empty());
      CHECK(json.at("expected").at("memory_MB").get<double>() > 10);
      CHECK(checked.out.find("expected some ") != std::string::npos);
      // As in words.
      CHECK(checked.out.find("rock     " + json.at("rock").at("blocks").dump() + " blocks") !=
            std::string::npos);
    }
    CHECK(contents(folder / "").size() == templates().size());
  }

  TEST_CASE("what a run is expected to take is near what runs took (docs/performance.md)") {
    const auto is_near = [](double expected, double took, double times) {
      return expected < times * took && took < times * expected;
    };
    // Bodies, peak memory and seconds to equilibrium, "now" of its first table.
    const struct {
      int dimension;
      std::size_t blocks;
      double memory, seconds;
    } rows[] = {{2, 5660, 27e6, 0.03},    {2, 26339, 124e6, 0.2}, {2, 105130, 331e6, 0.65},
                {2, 860619, 2602e6, 8.6}, {3, 1848, 31e6, 0.11},  {3, 10472, 108e6, 0.32},
                {3, 28000, 266e6, 1.08},  {3, 85967, 787e6, 4.93}};
    for (const auto& row : rows) {
      CAPTURE(row.blocks);
      const ExpectedCost cost = expected_cost(row.dimension, row.blocks);
      CHECK(is_near(cost.memory, row.memory, 1.5));
      CHECK(is_near(cost.standing_stage, row.seconds, 2));
    }
    // Seconds of rock that fails, second and third table.
    CHECK(is_near(expected_cost(2, 5587).falling_stage, 7.5, 2));
    CHECK(is_near(expected_cost(3, 610).falling_stage, 7.6, 2));
    CHECK(is_near(expected_cost(3, 2370).falling_stage, 40, 2));
  }

  TEST_CASE("what check says is what the run has") {
    const Folder folder;
    for (const char* name : {"circle", "staged"}) {
      const std::string file = folder / (std::string(name) + ".toml");
      REQUIRE(run_program({"init", name, file}).status == 0);
      const Outcome checked = run_program({"check", file, "--out", folder / "checked"});
      const Outcome run = run_program({"run", file, "--out", folder / "run"});
      INFO(run.err);
      CHECK((run.status == 0 || run.status == 6));
      const auto json = nlohmann::json::parse(read_file(folder / "run/run.json"));
      // A run in rounds has parts of the blocks that check has whole.
      if (name == std::string("circle")) {
        CHECK(number_after(checked.out, "rock     ") ==
              std::to_string(json.at("rock").at("bodies").get<int>()));
        CHECK(number_after(checked.out, "bolts    ") ==
              std::to_string(json.at("bolts").at("count").get<int>()));
      }
      CHECK(read_file(folder / "checked/check.svg").starts_with("<?xml"));
    }
  }

  TEST_CASE("diff says what a change of the input has changed") {
    const Folder folder;
    const std::string file = folder / "case.toml";
    REQUIRE(run_program({"init", "d-shape", file}).status == 0);
    write_file(file, replaced(read_file(file), "friction = \"38 deg\"", "friction = \"65 deg\""));
    REQUIRE(run_program({"run", file, "--out", folder / "a"}).status == 0);
    REQUIRE(run_program({"run", file, "--out", folder / "b"}).status == 0);
    REQUIRE(
        run_program({"run", file, "--out", folder / "c", "--set", "joint.kn=10 GPa/m"}).status ==
        0);
    CHECK(run_program({"diff", folder / "a", folder / "b"}).out == "the runs are the same\n");
    const Outcome differ = run_program({"diff", folder / "a", folder / "c/run.json"});
    CHECK(differ.status == 0);
    INFO(differ.out);
    const auto crown = [&](const char* run) {
      return nlohmann::json::parse(read_file(folder / (std::string(run) + "/run.json")))
          .at("convergence")
          .at("crown_mm")
          .get<double>();
    };
    const auto at = differ.out.find("convergence.crown_mm");
    REQUIRE(at != std::string::npos);
    const std::string line = differ.out.substr(at, differ.out.find('\n', at) - at);
    // Three digits are printed.
    const double percent = 100 * (crown("c") / crown("a") - 1);
    CHECK(std::abs(std::stod(line.substr(line.rfind("  ") + 2)) - percent) <
          0.01 * std::abs(percent));
    CHECK(differ.out.find("time_s") == std::string::npos);
    CHECK(run_program({"diff", folder / "a", folder / "none"}).status == 2);
    CHECK(run_program({"diff", folder / "a", file}).status == 2);
  }

  TEST_CASE("bad input") {
    const Folder folder;
    const std::string there = write_file(folder / "there.toml", "mine");
    const Outcome overwrites = run_program({"init", "circle", there});
    CHECK(overwrites.status == 2);
    CHECK(overwrites.err.find("is there already") != std::string::npos);
    CHECK(read_file(there) == "mine");
    CHECK(run_program({"init"}).status == 2);
    CHECK(run_program({"init", "square"}).status == 2);
    const Outcome wrong = run_program({"check", write_file(folder / "wrong.toml", "[model]\n")});
    CHECK(wrong.status == 2);
    CHECK(wrong.err.find("model.width") != std::string::npos);
  }
}

}  // namespace templates_test
