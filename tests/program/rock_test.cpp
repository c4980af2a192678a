// SPDX-License-Identifier: MIT
// From an input to rock, without the executable.
#include <doctest/doctest.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "analysis.hpp"
#include "harness.hpp"
#include "support/near.hpp"

namespace rock_test {

namespace {

using namespace voussoir_test;
using namespace voussoir::program;
using voussoir::InvalidInput;
using voussoir::Progress;

std::string design_case() { return read_file(VOUSSOIR_TEST_EXAMPLES "/paper/tunnel.toml"); }

RockIn<voussoir::Planar> rock(const std::string& text,
                              const std::vector<std::string>& overrides = {},
                              const std::string& directory = ".", const Progress& progress = {}) {
  return described_rock(read_input_text(text, "case.toml", directory, overrides), progress);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What is said of a small model with a file of traces, as a warning or as a refusal.
std::string said(const std::string& traces, const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  write_file(folder / "traces.csv", traces);
  InputText mapped;
  mapped.joints = "[joints]\nfile = \"traces.csv\"\n";
  std::vector<std::string> all = {"blocks.max_elongation=1000"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  try {
    const RockIn<voussoir::Planar> found = rock(mapped.text(), all, folder / "");
    return found.warnings.empty() ? "" : "warning: " + found.warnings.front();
  } catch (const InvalidInput& error) {
    return std::string("refused: ") + error.what();
  }
}

}  // namespace

TEST_SUITE("program/rock") {
  TEST_CASE("a wide or flat model is as jointed as the design case, and nothing is to be said") {
    const auto density = [](const std::vector<std::string>& overrides) {
      const RockIn<voussoir::Planar> found = rock(design_case(), overrides);
      CHECK(found.warnings.empty());
      return static_cast<double>(found.mass.bodies.size()) / found.mass.domain.measure();
    };
    const double usual = density({});
    CHECK(usual == near(5682 / 4200.0));
    for (const double other :
         {density({"model.width=300 m", "model.below_invert=10 m", "tunnel.cover=8 m"}),
          density({"model.width=320 m"})}) {
      CHECK(other > 0.97 * usual);
      CHECK(other < 1.03 * usual);
    }
  }

  TEST_CASE("joints asked for and not used are said, with the counts and the key") {
    const RockIn<voussoir::Planar> few = rock(design_case(), {"blocks.max_elongation=2"});
    REQUIRE(few.warnings.size() == 1);
    CHECK(contains(few.warnings[0], "most joints leave no trace in the rock: 12600 joints"));
    CHECK(contains(few.warnings[0], " cuts made, "));
    CHECK(contains(few.warnings[0], " for a part longer than blocks.max_elongation = 2"));
    CHECK_THROWS_WITH_AS(
        (void)rock(design_case(), {"blocks.min_inscribed_radius=4.9 m", "model.width=12 m",
                                   "tunnel.cover=1 m", "model.below_invert=1 m"}),
        doctest::Contains("no joint cuts the rock, which stays one block: 432 "
                          "joints"),
        InvalidInput);
    const RockIn<voussoir::Planar> none =
        rock(InputText{}.text(),
             {"joint_set[0].intensity=1e-9 /m^2", "joint_set[1].intensity=1e-9 /m^2"});
    REQUIRE(none.warnings.size() == 1);
    CHECK(contains(none.warnings[0], "one block without joints, though there are joint sets: 0"));
  }

  TEST_CASE("traces that miss the model, all or most of them, are refused or said") {
    const std::string beds = "-12,4,12,4\n-12,5,12,5\n-12,6,12,6\n";
    CHECK(said(beds).empty());
    const std::string millimetres = said("-9000,4000,-5000,4500\n-9000,5000,-5000,6000\n");
    CHECK(contains(millimetres, "refused: joints.file: "));
    CHECK(contains(millimetres, "0 of 2 traces reach into the domain"));
    CHECK(contains(millimetres, "coordinates in millimetres"));
    const std::string site = said("512291,152,512309,152\n");
    CHECK(contains(site, "0 of 1 trace reaches into the domain"));
    CHECK(contains(site, "model.origin, the place of the model on the site grid, which is (0, 0)"));
    CHECK(said("512288,152,512312,152\n", {"model.origin=[\"512300 m\", \"148 m\"]"}).empty());
    const std::string most = said("-9,4,9,4\n100,0,120,0\n100,1,120,1\n");
    CHECK(contains(most, "warning: joints.file: "));
    CHECK(contains(most, "1 of 3 traces reach into the domain"));
    CHECK(contains(said(""), "holds no trace: it is empty"));
    CHECK(contains(said("-9,4,9,4,1\n"), "traces.csv:1: there is no joint set 1"));
  }

  TEST_CASE(
      "traces are counted before they cut: too many blocks are refused, an endless file too") {
    std::string grid;
    for (int k = 0; k < 1300; ++k) {
      const std::string x = std::to_string(-12 + 0.018 * k), y = std::to_string(-11 + 0.015 * k);
      grid += x + ",-20," + x + ",20\n-20," + y + ",20," + y + "\n";
    }
    const std::clock_t start = std::clock();
    const std::string many = said(grid, {"blocks.min_inscribed_radius=1 mm"});
    CHECK(contains(many, "refused: joints.file: "));
    CHECK(contains(many, "has 2600 joints and would come to about 1"));
    CHECK(contains(many, "accepted: at most 1000000"));
    CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 10);
    InputText endless;
    endless.joints = "[joints]\nfile = \"/dev/zero\"\n";
    CHECK_THROWS_WITH_AS((void)rock(endless.text()), doctest::Contains("not a regular file"),
                         InvalidInput);
  }

  TEST_CASE("the making of rock asks often whether to go on, and stops when told to") {
    std::clock_t last = std::clock();  // of the processor: another's work does not count
    double longest = 0;
    int asked = 0;
    const Progress ask = [&](double) {
      longest = std::max(longest, static_cast<double>(std::clock() - last) / CLOCKS_PER_SEC);
      last = std::clock();
      ++asked;
      return true;
    };
    // Six times the joints of the design case: a second on a slow machine.
    const std::vector<std::string> large = {"model.width=200 m", "model.below_invert=100 m"};
    const std::clock_t start = std::clock();
    (void)rock(design_case(), large, ".", ask);
    const double took = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    CHECK(asked > 3);
    CHECK(asked > 10 * took);  // meant to be every hundredth of a second
    CHECK(longest < 1);
    int left = 3;
    CHECK_THROWS_AS((void)rock(design_case(), large, ".", [&](double) { return --left > 0; }),
                    voussoir::Stopped);
    CHECK(left == 0);
  }
}

}  // namespace rock_test
