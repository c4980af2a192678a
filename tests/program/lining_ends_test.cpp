// SPDX-License-Identifier: MIT
// Arches on feet whose ends go down to the corner of the floor by a quarter of a degree, from input
// files: what they carry follows, on either side.
#include <doctest/doctest.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "analysis.hpp"
#include "harness.hpp"
#include "support/arch_on_feet.hpp"
#include "support/faults.hpp"
#include "support/folder.hpp"

namespace lining_ends_test {

namespace {

using namespace voussoir_test;
using namespace voussoir::program;

/// 5 m wide, the floor 1.5 m below the centre: its corners are at -30.964 and 210.964 degrees.
struct Section {
  const char *name, *text;
};
constexpr Section horseshoe{"horseshoe",
                            "shape = \"horseshoe\"\nwidth = \"5 m\"\nwall_height = \"1.5 m\"\n"};
constexpr Section box{
    "box",
    "shape = \"polygon\"\nvertices = [[\"-2.5 m\",\"-1.5 m\"],[\"2.5 m\",\"-1.5 m\"],"
    "[\"2.5 m\",\"2 m\"],[\"-2.5 m\",\"2 m\"]]\n"};
constexpr Section with_haunches{
    "haunches",
    "shape = \"polygon\"\nvertices = [[\"-2.5 m\",\"-1.5 m\"],[\"2.5 m\",\"-1.5 m\"],"
    "[\"2.5 m\",\"1 m\"],[\"1.5 m\",\"2 m\"],[\"-1.5 m\",\"2 m\"],[\"-2.5 m\",\"1 m\"]]\n"};

/// Level beds and upright joints 2 m apart, every second course moved by half a block: their own
/// mirror image. None crosses the wall where the feet come down, for there a foot that comes to
/// stand on the next block is a step of its own.
std::string beds() {
  std::string text = "x1,y1,x2,y2\n";
  char line[96];
  const auto add = [&](double x0, double y0, double x1, double y1) {
    std::snprintf(line, sizeof line, "%g,%g,%g,%g\n", x0, y0, x1, y1);
    text += line;
  };
  for (int k = -8; k <= 8; ++k) {
    const double low = 0.3 + 2 * k;
    add(-18, low, 18, low);
    for (double x = k % 2 == 0 ? -17 : -16; x < 18; x += 2) add(x, low, x, low + 2);
  }
  return text;
}

/// @throws std::exception  where the program would refuse the file
ArchOnFeet carried(const Section& section, double from, double to) {
  const Folder folder;
  write_file(folder / "beds.csv", beds());
  char arc[64];
  std::snprintf(arc, sizeof arc, "arc = [\"%g deg\", \"%g deg\"]\n", from, to);
  // Joints that hardly slip.
  const std::string text = std::string("[model]\nwidth = \"32 m\"\nbelow_invert = \"8 m\"\n") +
                           "[tunnel]\n" + section.text +
                           "cover = \"12 m\"\n[rock]\ndensity = \"2700 kg/m^3\"\n"
                           "[stress]\nK0 = 1\nsurcharge = \"1 MPa\"\n"
                           "[joints]\nfile = \"beds.csv\"\n"
                           "[joint]\nkn = \"5 GPa/m\"\nks = \"2 GPa/m\"\nfriction = \"70 deg\"\n"
                           "[blocks]\nmin_inscribed_radius = \"0.1 m\"\n"
                           "[support.lining]\nthickness = \"20 cm\"\nE = \"25 GPa\"\n" +
                           arc +
                           "interface = { kn = \"1 GPa/m\", friction = \"30 deg\" }\n"
                           "[support.lining.feet]\nstiffness = \"5 GPa/m\"\n";
  const Input input = read_input_text(text, "ends", folder / ".", {"run.tolerance=1e-6"});
  const RunResult run = run_of(input, [](const std::string&, double) { return true; });
  REQUIRE(run.verdict() == voussoir::Verdict::stable);
  return arch_on_feet(run.tunnel);
}

}  // namespace

TEST_SUITE("program/lining_ends") {
  TEST_CASE("what an arch carries follows its ends to the corner of the floor, on either side") {
    for (const Section& section : {horseshoe, box, with_haunches}) {
      CAPTURE(std::string(section.name));
      std::vector<ArchOnFeet> rows;
      for (const double end : {29.0, 29.25, 29.5, 29.75, 30.0, 30.25, 30.5, 30.75, 31.0}) {
        CAPTURE(end);
        const ArchOnFeet right = carried(section, -end, 209);
        CAPTURE(right.thrust);
        CAPTURE(right.moment);
        CAPTURE(right.right);
        // What is asked of neighbours; `solver/lining_ends` has 3.1 % in rock without symmetry.
        if (!rows.empty()) CHECK(apart(right, rows.back()) < 0.05);
        rows.push_back(right);
        if (end != 29.5 && end != 31.0) continue;
        // Two searches to an error of 1e-6 of the largest displacement each.
        const ArchOnFeet left = carried(section, -29, 180 + end);
        CHECK(apart(right, left.mirrored()) < 1e-3);
      }
    }
  }

  TEST_CASE("beyond the corner a foot would stand on the floor: refused, with the angles") {
    std::string refusal;
    try {
      (void)carried(horseshoe, -33, 209);
    } catch (const std::exception& refused) {
      refusal = refused.what();
    }
    CAPTURE(refusal);
    CHECK(says(refusal, "would stand on nothing"));
    CHECK(says(refusal, "between its corners at -149.04 and -30.964 deg"));
  }
}

}  // namespace lining_ends_test
