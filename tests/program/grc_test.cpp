// SPDX-License-Identifier: MIT
// Ground reaction by `voussoir grc`: against the elastic law, against `run`, and along a tunnel.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "run_results.hpp"
#include "table_rows.hpp"

namespace grc_test {

using namespace voussoir_test;

namespace {

using Row = std::map<std::string, std::string>;

double number(const Row& row, const char* column) { return std::stod(row.at(column)); }

/// Joints that do not slip, under a stress that keeps them closed: it is elastic.
InputText elastic() {
  InputText input;
  input.joints = replaced(
      replaced(input.joints, "intensity = \"1 /m^2\"\nextent = \"2 m\"\n", "spacing = \"1.5 m\"\n"),
      "intensity = \"1 /m^2\"\nextent = \"2 m\"\n", "spacing = \"1.5 m\"\n");
  return input;
}
std::string text_of(const InputText& input) {
  return replaced(
      replaced(input.text(), "friction = \"35 deg\"\n[blocks]", "friction = \"85 deg\"\n[blocks]"),
      "K0 = 1.0\n", "K0 = 1.0\nsurcharge = \"800 kPa\"\n");
}

std::map<std::string, std::string> grc(const std::string& text,
                                       const std::vector<std::string>& more, Outcome& outcome) {
  const Folder folder;
  std::vector<std::string> arguments{"grc", write_file(folder / "case.toml", text), "--out",
                                     folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  outcome = run_program(arguments);
  std::map<std::string, std::string> files;
  for (const auto& [path, content] : contents(folder / "out"))
    files[std::filesystem::path(path).filename().string()] = content;
  return files;
}

}  // namespace

TEST_SUITE("program/grc") {
  TEST_CASE("rock that stays elastic moves as far as traction is taken off it") {
    InputText input = elastic();
    input.bolts = "";
    input.lining = "";
    Outcome outcome;
    const auto files = grc(text_of(input), {"--steps", "4"}, outcome);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto rows = rows_of(files.at("grc.csv"));
    REQUIRE(rows.size() == 4);
    const double whole = number(rows[3], "crown_mm");
    CHECK(whole > 0);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(number(rows[k], "wall_traction_percent") == 75 - 25.0 * static_cast<double>(k));
      CHECK(rows[k].at("verdict") == "stable");
      // Joints open somewhat at the wall towards the end: 3 % of all of it.
      CHECK(std::abs(number(rows[k], "crown_mm") - 0.25 * static_cast<double>(k + 1) * whole) <
            0.03 * whole);
    }
    // In one step it ends in the same place: searches end at 1e-3.
    const double at_once =
        results_of(text_of(input)).json.at("convergence").at("crown_mm").get<double>();
    CHECK(std::abs(whole - at_once) < 5e-3 * at_once);
    CHECK(files.at("grc.svg").find("rock without support") != std::string::npos);
    CHECK(outcome.out.find("support ") == std::string::npos);
  }

  TEST_CASE("what supports do is read off the bare rock's curve") {
    InputText input = elastic();
    input.rest =
        "[[stage]]\nwall_traction = 0.6\n[[stage]]\nwall_traction = 0\n"
        "install = [\"bolts\", \"lining\"]\n";
    Outcome outcome;
    const auto files = grc(text_of(input), {"--steps", "20"}, outcome);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto rows = rows_of(files.at("grc.csv"));
    REQUIRE(rows.size() == 22);
    const double bare = number(rows[19], "crown_mm"), first = number(rows[20], "crown_mm"),
                 last = number(rows[21], "crown_mm");
    CHECK(last < bare);
    CHECK(last > first);
    // Until supports are there it is the bare rock at 60 %.
    CHECK(std::abs(first - number(rows[7], "crown_mm")) < 5e-3 * first);
    const double run =
        results_of(text_of(input)).json.at("convergence").at("crown_mm").get<double>();
    CHECK(std::abs(last - run) < 1e-5 * run);  // six digits are written
    // The share that is said lies on the bare curve at that crown.
    const auto at = outcome.out.find("far under ");
    REQUIRE(at != std::string::npos);
    const double share = std::stod(outcome.out.substr(at + 10));
    for (std::size_t k = 1; k < 20; ++k) {
      const double low = number(rows[k - 1], "crown_mm"), high = number(rows[k], "crown_mm");
      if (last < low || last > high) continue;
      CHECK(share <= number(rows[k - 1], "wall_traction_percent") + 0.05);
      CHECK(share >= number(rows[k], "wall_traction_percent") - 0.05);
    }
    CHECK(share > 0);
    CHECK(share < 60);
    const auto json = nlohmann::json::parse(files.at("grc.json"));
    CHECK(json.at("ground").size() == 20);
    CHECK(json.at("supported").size() == 2);
    // One decimal is said.
    CHECK(std::abs(100 * json.at("equivalent_wall_traction").get<double>() - share) <= 0.051);
  }

  TEST_CASE("along a tunnel in 3-D the wall has moved less the nearer the face") {
    InputText input = elastic();
    input.bolts = "";
    input.lining = "";
    const std::string text = replaced(
        replaced(text_of(input), "[model]\n", "[model]\ndimension = 3\nlength = \"14 m\"\n"),
        "cover = \"8 m\"\n", "cover = \"8 m\"\nround_length = \"2 m\"\nrounds = 5\n");
    Outcome outcome;
    const auto files = grc(text, {}, outcome);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto rows = rows_of(files.at("profile.csv"));
    REQUIRE(rows.size() >= 10);
    CHECK(nlohmann::json::parse(files.at("profile.json")).at("profile").size() == rows.size());
    const double near_face = number(rows.front(), "crown_mm"),
                 far = number(rows.back(), "crown_mm");
    CHECK(near_face > 0);
    CHECK(near_face < 0.8 * far);
    // Of the middle third as `run` says it.
    const double middle = results_of(text).json.at("convergence").at("crown_mm").get<double>();
    double most = 0, least = 1e9;
    for (const Row& row : rows) {
      const double behind = number(row, "behind_face_m");
      if (behind < 10.0 / 3 || behind > 20.0 / 3) continue;
      most = std::max(most, number(row, "crown_mm"));
      least = std::min(least, number(row, "crown_mm"));
    }
    CHECK(middle >= least);
    CHECK(middle <= most);
    CHECK(files.at("profile.svg").find("behind the face [m]") != std::string::npos);
  }

  TEST_CASE("bad input") {
    Outcome outcome;
    CHECK(grc("[rock]\ndensity = \"2500 kg/m^3\"\n[joint]\nkn = \"5 GPa/m\"\nks = \"1 GPa/m\"\n"
              "friction = \"30 deg\"\n[[block]]\nfixed = true\nvertices = [[\"0 m\", \"0 m\"], "
              "[\"1 m\", \"0 m\"], [\"0 m\", \"1 m\"]]\n",
              {}, outcome)
              .empty());
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("grc is of tunnels") != std::string::npos);
    CHECK(grc(elastic().text(), {"--steps", "1"}, outcome).empty());
    CHECK(outcome.status == 2);
  }
}

}  // namespace grc_test
