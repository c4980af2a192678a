// SPDX-License-Identifier: MIT
// `voussoir design` against the whole diagram, its folder shared with one; bad input.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "run_results.hpp"
#include "support/near.hpp"
#include "table_rows.hpp"

namespace design_test {

using namespace voussoir_test;
using Json = nlohmann::json;

namespace {

const std::string axes =
    "[diagram]\nspacing = [\"30 deg\", \"60 deg\", \"none\"]\n"
    "thickness = [\"0 cm\", \"4 cm\", \"8 cm\", \"16 cm\"]\n";
const std::string prices =
    "[costs]\ncurrency = \"CHF\"\nbolt_per_metre = 30\nbolt_per_hole = 40\nconcrete_per_m3 = 500\n"
    "rebound = \"20 %\"\n";

std::string tunnel(const std::string& more) {
  return CircleInRock{.length = "2 m"}.text() +
         "[support.bolts]\nlength = \"2 m\"\nspacing = \"30 deg\"\nstiffness = \"0.2 GN/m\"\n"
         "yield_force = \"400 kN\"\n"
         "[support.lining]\nthickness = \"8 cm\"\nE = \"25 GPa\"\nnodes = 24\n"
         "interface = { kn = \"5 GPa/m\", friction = \"35 deg\" }\n"
         "[support.lining.concrete]\nfck = \"30 MPa\"\n" +
         axes + more;
}

Outcome run_verb(const Folder& folder, const std::string& verb, const std::string& text,
                 const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{verb, write_file(folder / "case.toml", text), "--out",
                                     folder / out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments);
}

}  // namespace

TEST_SUITE("program/design") {
  TEST_CASE("the cheapest that holds is that of the whole diagram, in a part of its tunnels") {
    const Folder folder;
    const Outcome whole = run_verb(folder, "diagram", tunnel(""), "whole");
    CAPTURE(whole.err);
    REQUIRE(whole.status == 0);
    const auto rows = rows_of(read_file(folder / "whole/interaction.csv"));
    REQUIRE(rows.size() == 12);
    std::vector<double> crowns;
    for (const auto& row : rows)
      if (row.at("verdict").rfind("stable", 0) == 0)
        crowns.push_back(std::stod(row.at("crown_convergence_mm")));
    std::sort(crowns.begin(), crowns.end());
    REQUIRE(crowns.size() > 8);
    int found = 0;
    for (const std::size_t kept : {std::size_t{1}, std::size_t{4}, std::size_t{7}}) {
      const double limit = 0.5 * (crowns[kept] + crowns[kept + 1]);
      CAPTURE(limit);
      const std::string text =
          tunnel(prices + "[criteria]\nconvergence = \"" + std::to_string(limit) + " mm\"\n");
      const std::string out = "part" + std::to_string(kept);
      const Outcome part = run_verb(folder, "design", text, out);
      CAPTURE(part.out);
      CAPTURE(part.err);
      const Json json = Json::parse(read_file(folder / (out + "/design.json")));
      const std::vector<Json> places = json.at("supports");
      REQUIRE(places.size() == rows.size());
      const auto within = [](const std::string& cell) {  // "-": nothing is there to bear it
        return cell == "-" || std::stod(cell) <= 1;
      };
      double least = std::numeric_limits<double>::infinity();
      int computed = 0;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto& row = rows[k];
        const bool holds = row.at("verdict").rfind("stable", 0) == 0 &&
                           std::stod(row.at("detached_area_m2")) == 0 &&
                           std::stod(row.at("crown_convergence_mm")) <= limit &&
                           within(row.at("largest_bolt_force_of_its_strength")) &&
                           within(row.at("lining_of_its_strength"));
        const double cost = places[k].at("cost_per_m").get<double>();
        if (holds) least = std::min(least, cost);
        if (!places[k].at("computed").get<bool>()) continue;
        ++computed;
        CHECK(places[k].at("holds").get<bool>() == holds);
      }
      CHECK(computed < 10);
      REQUIRE(part.status == (std::isinf(least) ? 9 : 0));
      if (std::isinf(least)) continue;
      ++found;
      CHECK(json.at("design").at("cost_per_m").get<double>() == near(least).epsilon(1e-12));
      CHECK(json.at("currency") == "CHF");
      CHECK(part.out.find("CHF/m, the cheapest that holds") != std::string::npos);
      const std::string picture = read_file(folder / (out + "/design.svg"));
      CHECK(picture.find("recommended") != std::string::npos);
      // The diagram goes on in its folder with what is missing.
      const Outcome rest = run_verb(folder, "diagram", text, out);
      CHECK(rest.status == 0);
      CHECK(rows_of(read_file(folder / (out + "/interaction.csv"))).size() == 12);
    }
    CHECK(found > 0);
  }

  TEST_CASE("bolts of which the bond alone is given are held to a criterion, too") {
    const Folder folder;
    const std::string text = tunnel(prices);
    for (const bool is_weak : {true, false}) {
      const std::string bond = is_weak ? "1 kN/m" : "1 GN/m";
      const std::string bonded =
          replaced(text, "yield_force = \"400 kN\"\n", "bond_strength = \"" + bond + "\"\n");
      const Outcome outcome =
          run_verb(folder, "realisations", bonded, is_weak ? "weak" : "strong", {"-n", "1"});
      CAPTURE(outcome.out);
      CHECK(outcome.out.find(std::string("bolt utilisation above 1 in ") +
                             (is_weak ? "100 %" : "0 %")) != std::string::npos);
    }
  }

  TEST_CASE("where nothing holds it is said by how much") {
    const Folder folder;
    const Outcome outcome = run_verb(
        folder, "design", tunnel(prices + "[criteria]\nconvergence = \"0.001 mm\"\n"), "out");
    CAPTURE(outcome.out);
    CHECK(outcome.status == 9);
    CHECK(outcome.out.find("none on the axes of [diagram] holds") != std::string::npos);
    CHECK(outcome.out.find("bolts every 30 deg, lining 160 mm") != std::string::npos);
    CHECK(outcome.out.find(" % of the limit") != std::string::npos);
    CHECK(read_file(folder / "out/design.svg").find("NO SUPPORT") != std::string::npos);
    // One realisation in which nothing breaks leaves up to 97.5 %.
    const std::string likely =
        tunnel(prices + "[criteria]\nconvergence = \"1 m\"\nprobability = \"50 %\"\n");
    CHECK(run_verb(folder, "design", likely, "likely").status == 0);
    const Outcome sure = run_verb(folder, "design", likely, "likely", {"--sure"});
    CHECK(sure.status == 9);
    CHECK(sure.out.find("not sure enough") != std::string::npos);
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::string& text, const std::vector<std::string>& more,
                            const std::vector<std::string>& parts) {
      const Folder folder;
      const Outcome outcome = run_verb(folder, "design", text, "out", more);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      for (const std::string& part : parts) CHECK(outcome.err.find(part) != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(folder / "out/design.json"));
    };
    refused(tunnel(""), {}, {"no [costs]", "bolt_per_metre"});
    refused(tunnel("[costs]\nbolt_per_metre = -3\n"), {}, {"costs.bolt_per_metre", "-3"});
    refused(tunnel("[costs]\nbolt_per_metre = 0\n"), {}, {"costs", "no price above 0"});
    refused(tunnel("[costs]\nbolt_per_metre = 3\nrebound = 0.95\n"), {}, {"costs.rebound", "0.9"});
    refused(tunnel(prices), {"--sure"}, {"--sure", "criteria.probability"});
    refused(CircleInRock{}.text() + prices, {}, {"[diagram]"});
  }
}

}  // namespace design_test
