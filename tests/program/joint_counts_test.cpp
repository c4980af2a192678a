// SPDX-License-Identifier: MIT
// Joints by their number per volume and by their persistence: the rock is that of the area per
// volume or the spacing which these come to.
#include <doctest/doctest.h>

#include <numbers>
#include <string>
#include <vector>
#include <voussoir/drawing/number_text.hpp>

#include "run_results.hpp"

namespace joint_counts_test {

using namespace voussoir_test;
using voussoir::shortest_text;

namespace {

/// @param counts  how many joints the first set has
std::string tunnel(const std::string& counts) {
  InputText input;
  input.bolts = "";
  input.lining = "";
  input.joints = "[[joint_set]]\ndip = \"60 deg\"\ndip_direction = \"110 deg\"\n" + counts +
                 "[[joint_set]]\ndip = \"30 deg\"\ndip_direction = \"290 deg\"\n"
                 "spacing = \"2 m\"\n";
  return replaced(replaced(input.text(), "facets = 24\n", "facets = 24\ntrend = \"20 deg\"\n"),
                  "[model]\n", "[model]\nlength = \"6 m\"\n");
}

/// What the rock is and does.
nlohmann::json made(const std::string& counts, const char* dimension) {
  const Results run =
      results_of(tunnel(counts), {"--set", std::string("model.dimension=") + dimension});
  const nlohmann::json& rock = run.json.at("rock");
  return {rock.at("bodies"), rock.at("contacts"),
          rock.at("largest_block_" + std::string(dimension[0] == '2' ? "area_m2" : "volume_m3")),
          run.json.at("convergence").at("crown_mm")};
}

}  // namespace

TEST_SUITE("program/joint_counts") {
  TEST_CASE("P30 is P32 over the area of a joint, in 2-D and 3-D") {
    // Discs whose traces are 3 m in the mean: pi/4 (4/pi 3 m)^2.
    const double disc = 4 / std::numbers::pi * 9;
    for (const char* dimension : {"2", "3"}) {
      CAPTURE(dimension);
      const std::string extent = "extent = \"3 m\"\n";
      CHECK(made("P30 = \"0.04 /m^3\"\n" + extent, dimension) ==
            made("P32 = \"" + shortest_text(0.04 * disc) + " m^2/m^3\"\n" + extent, dimension));
    }
    const std::string plate = "extent = \"3 m\"\nstrike_extent = \"5 m\"\n";
    CHECK(made("P30 = \"0.04 /m^3\"\n" + plate, "3") ==
          made("P32 = \"0.6 m^2/m^3\"\n" + plate, "3"));
    CHECK(made("P30 = \"0.04 /m^3\"\n" + plate, "3") != made("P30 = \"0.05 /m^3\"\n" + plate, "3"));
  }

  TEST_CASE("persistence is the part of their planes that joints part") {
    for (const char* dimension : {"2", "3"}) {
      CAPTURE(dimension);
      const std::string extent = "extent = \"3 m\"\n";
      const nlohmann::json half =
          made("spacing = \"1 m\"\npersistence = \"50 %\"\n" + extent, dimension);
      CHECK(half == made("spacing = \"2 m\"\n" + extent, dimension));
      CHECK(half == made("spacing = \"1 m\"\npersistence = 0.5\n" + extent, dimension));
      CHECK(half == made("spacing = \"1 m\"\ngap = \"3 m\"\n" + extent, dimension));
      CHECK(half != made("spacing = \"1 m\"\n" + extent, dimension));
      CHECK(made("spacing = \"2 m\"\npersistence = 1\n" + extent, dimension) ==
            made("spacing = \"2 m\"\n" + extent, dimension));
    }
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::string& counts, const std::vector<const char*>& words) {
      const Folder folder;
      const Outcome outcome =
          run_program({"check", write_file(folder / "case.toml", tunnel(counts))});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      for (const char* word : words) CHECK(outcome.err.find(word) != std::string::npos);
    };
    refused("P30 = \"0.1 /m^3\"\n", {"joint_set[0].P30", "without an extent"});
    refused("P30 = \"0.1 /m^3\"\nP32 = \"1 /m\"\nextent = \"2 m\"\n",
            {"P30", "is given besides P32"});
    refused("P30 = \"0.1 /m^2\"\nextent = \"2 m\"\n", {"not a number per volume"});
    refused("spacing = \"1 m\"\npersistence = 0.5\n", {"persistence", "which have an extent"});
    refused("P32 = \"1 /m\"\nextent = \"2 m\"\ngap = \"1 m\"\n", {"gap", "by their spacing"});
    refused("spacing = \"1 m\"\nextent = \"2 m\"\ngap = \"1 m\"\npersistence = 0.5\n",
            {"gap", "besides persistence"});
    refused("spacing = \"1 m\"\nextent = \"2 m\"\npersistence = 1.2\n",
            {"persistence", "outside the accepted range"});
  }
}

}  // namespace joint_counts_test
