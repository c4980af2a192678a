// SPDX-License-Identifier: MIT
// `voussoir blocks`: the rock alone, against a grid whose blocks are known, in 2-D and 3-D.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "run_results.hpp"

namespace rock_blocks_test {

using namespace voussoir_test;

namespace {

struct Looked {
  Outcome outcome;
  std::map<std::string, std::string> files;
  nlohmann::json json;
};

Looked blocks(const std::string& text, const std::vector<std::string>& more = {}) {
  const Folder folder;
  std::vector<std::string> arguments{"blocks", write_file(folder / "case.toml", text), "--out",
                                     folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Looked looked;
  looked.outcome = run_program(arguments);
  for (const auto& [path, content] : contents(folder / "out"))
    looked.files[std::filesystem::path(path).filename().string()] = content;
  if (looked.files.contains("blocks.json"))
    looked.json = nlohmann::json::parse(looked.files.at("blocks.json"));
  return looked;
}

/// Upright joints 1 m apart and level ones 2 m apart, in 3-D others 1.5 m apart across the tunnel.
std::string grid(bool is_spatial) {
  InputText input;
  input.bolts = "";
  input.lining = "";
  const auto set = [](const char* dip, const char* towards, const char* spacing) {
    return std::string("[[joint_set]]\ndip = \"") + dip + " deg\"\ndip_direction = \"" + towards +
           "\"\nspacing = \"" + spacing + " m\"\n";
  };
  input.joints = set("90", "90 deg", "1") + set("0", "90 deg", "2");
  if (is_spatial) input.joints += set("90", "0 deg", "1.5");
  std::string text = replaced(input.text(), "facets = 24\n", "facets = 24\ntrend = \"0 deg\"\n");
  text = replaced(text, "max_elongation = 5\n", "");  // strips are cut before they are blocks
  if (is_spatial) text = replaced(text, "[model]\n", "[model]\ndimension = 3\nlength = \"12 m\"\n");
  return text;
}

bool is_near(double a, double b, double part) { return std::abs(a - b) <= part * std::abs(b); }

}  // namespace

TEST_SUITE("program/rock_blocks") {
  TEST_CASE("a grid: sizes, frequencies and RQD are those of its spacings") {
    const Looked section = blocks(grid(false));
    CAPTURE(section.outcome.err);
    REQUIRE(section.outcome.status == 0);
    const nlohmann::json& sizes = section.json.at("sizes");
    // All whole blocks are alike; corners are welded to 1e-10 of the model.
    for (const char* key : {"mean_area_m2", "median_area_m2"})
      CHECK(is_near(sizes.at(key).get<double>(), 2, 1e-9));
    for (const char* key : {"D10_m2", "D50_m2", "D90_m2"})
      CHECK(is_near(sizes.at("by_area").at(key).get<double>(), 2, 1e-9));
    const nlohmann::json& across = section.json.at("scan_lines")[0];
    CHECK(across.at("direction") == "across");
    CHECK(is_near(across.at("mean_spacing_m").get<double>(), 1, 1e-9));
    CHECK(is_near(section.json.at("scan_lines")[1].at("mean_spacing_m").get<double>(), 2, 1e-9));
    CHECK(across.at("RQD_counted_percent").get<double>() > 99);
    // 100 exp(-0.1) 1.1 at one joint a metre, give or take one in 24 m.
    CHECK(is_near(across.at("RQD_Priest_Hudson_percent").get<double>(), 99.53, 1e-3));
    CHECK(section.json.at("Jv_per_m").is_null());

    const Looked spatial = blocks(grid(true));
    CAPTURE(spatial.outcome.err);
    REQUIRE(spatial.outcome.status == 0);
    CHECK(is_near(spatial.json.at("sizes").at("median_volume_m3").get<double>(), 3, 1e-9));
    // 1 + 1/2 + 2/3 a metre, give or take a joint in each direction: 1/24 + 1/20 + 1/12.
    CHECK(is_near(spatial.json.at("Jv_per_m").get<double>(), 1 + 0.5 + 2.0 / 3, 0.09));
    CHECK(spatial.files.contains("wall.svg"));
    for (const Looked* looked : {&section, &spatial})
      for (const char* file : {"block_sizes.csv", "block_sizes.svg", "removable.csv", "rock.svg"})
        CHECK(looked->files.contains(file));
  }

  TEST_CASE("of a grid the blocks over the roof fall and those under the floor rest") {
    const Looked looked = blocks(grid(false));
    REQUIRE(looked.json.contains("removable"));
    int above = 0, below = 0;
    for (const nlohmann::json& block : looked.json.at("removable")) {
      const double angle = block.at("angle_deg").get<double>();
      const std::string mode = block.at("mode").get<std::string>();
      CAPTURE(angle);
      if (mode == "falls") {
        ++above;
        CHECK(angle > 0);
        CHECK(angle < 180);
        CHECK(block.at("needed_friction_deg").is_null());
      }
      if (angle > 225 && angle < 315) {
        ++below;
        CHECK(mode == "rests");
      }
    }
    CHECK(above > 0);
    CHECK(below > 0);
    // Weights are density, gravity and area.
    const nlohmann::json& first = looked.json.at("removable")[0];
    CHECK(is_near(first.at("weight_kN_per_m").get<double>(),
                  2.7 * 9.81 * first.at("area_m2").get<double>(), 1e-12));
  }

  TEST_CASE("what shotcrete holds of them, once its adhesion is given") {
    const auto lined = [](bool is_spatial, const std::string& adhesion) {
      return grid(is_spatial) +
             "[support.lining]\nthickness = \"8 cm\"\nE = \"25 GPa\"\narc = [\"0 deg\", \"90 "
             "deg\"]\ninterface = { kn = \"1 GPa/m\", friction = \"30 deg\" }\n"
             "concrete = { fck = \"30 MPa\"" +
             adhesion + " }\n";
    };
    // Of 8 cm of C30, f_ctd = 1.081348 MPa: 20 kN/m of adhesion, 115.3 of shear, 9.2 / span of
    // bending, which is more for less than 46 cm.
    for (const auto& [adhesion, capacity, mode] :
         {std::tuple("0.5", 20.0, "adhesion"), std::tuple("10", 115.3438, "direct shear")}) {
      const Looked looked =
          blocks(lined(false, std::string(", adhesion = \"") + adhesion + " MPa\""));
      CAPTURE(looked.outcome.err);
      REQUIRE(looked.outcome.status == 0);
      int held = 0;
      for (const nlohmann::json& block : looked.json.at("removable")) {
        const double angle = block.at("angle_deg").get<double>();
        const bool is_covered = angle <= 90 && block.at("mode") != "rests";
        CHECK(block.contains("of_shotcrete") == is_covered);
        if (!is_covered || block.at("mode") != "falls" || block.at("shotcrete_mode") == "flexure")
          continue;
        ++held;
        CHECK(block.at("shotcrete_mode") == mode);
        CHECK(is_near(block.at("of_shotcrete").get<double>() * capacity,
                      block.at("weight_kN_per_m").get<double>(), 1e-5));
      }
      CHECK(held > 0);
      CHECK(looked.outcome.out.find(std::string(" % of what the shotcrete holds, ") + mode) !=
            std::string::npos);
      CHECK(looked.files.at("removable.csv").find(std::string(",") + mode) != std::string::npos);
    }
    const Looked spatial = blocks(lined(true, ", adhesion = \"0.5 MPa\""));
    CHECK(spatial.outcome.out.find(" % of what the shotcrete holds, ") != std::string::npos);
    const Looked unasked = blocks(lined(false, ""));
    CHECK(unasked.outcome.out.find("shotcrete") == std::string::npos);
    CHECK_FALSE(unasked.json.at("removable")[0].contains("of_shotcrete"));
  }

  TEST_CASE("it is the rock that run has") {
    const InputText input;
    const Looked looked = blocks(input.text());
    const Results run = results_of(input.text());
    REQUIRE(looked.outcome.status == 0);
    // In situ there are fewer: the opening cuts blocks in two.
    CHECK(looked.json.at("sizes").at("blocks").get<int>() > 0);
    CHECK(looked.json.at("seed") == run.json.at("seed"));
    const std::string& sizes = looked.files.at("block_sizes.csv");
    CHECK(std::count(sizes.begin(), sizes.end(), '\n') ==
          1 + looked.json.at("sizes").at("blocks").get<int>() -
              looked.json.at("sizes").at("left_out_at_sides").get<int>());
    CHECK(blocks(input.text(), {"--set", "model.seed=4"}).json.at("sizes") !=
          looked.json.at("sizes"));
    CHECK(blocks(input.text()).files == looked.files);
  }

  TEST_CASE("blocks that are laid are refused") {
    const Looked looked = blocks(
        "[rock]\ndensity = \"2500 kg/m^3\"\n[joint]\nkn = \"5 GPa/m\"\nks = \"1 GPa/m\"\n"
        "friction = \"30 deg\"\n[[block]]\nfixed = true\nvertices = [[\"0 m\", \"0 m\"], "
        "[\"1 m\", \"0 m\"], [\"0 m\", \"1 m\"]]\n");
    CHECK(looked.outcome.status == 2);
    CHECK(looked.outcome.err.find("here blocks are laid") != std::string::npos);
    CHECK(looked.files.empty());
  }
}

}  // namespace rock_blocks_test
