// SPDX-License-Identifier: MIT
// Tunnels in 3-D from an input file, and the same files in two dimensions.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>
#include <voussoir/design/joint_sets.hpp>
#include <voussoir/drawing/number_text.hpp>

#include "analysis.hpp"
#include "harness.hpp"
#include "input.hpp"
#include "plausibility.hpp"
#include "run_results.hpp"
#include "support/near.hpp"

namespace program_spatial_test {

namespace {

using namespace voussoir_test;
using namespace voussoir::program;
using Json = nlohmann::json;

/// A circle of 4 m in rock whose joints strike along the tunnel.
const std::string two_sets = R"(
[model]
dimension = 3
length = "3 m"
width = "20 m"
below_invert = "8 m"
[tunnel]
shape = "circle"
diameter = "4 m"
cover = "8 m"
facets = 24
[rock]
density = "2700 kg/m^3"
[stress]
K0 = 1
surcharge = "500 kPa"
[[joint_set]]
dip = "70 deg"
dip_direction = "E"
sd = "3 deg"
spacing = "1.5 m"
[[joint_set]]
dip = "20 deg"
dip_direction = "W"
sd = "3 deg"
spacing = "1.5 m"
[joint]
kn = "5 GPa/m"
ks = "0.5 GPa/m"
friction = "40 deg"
[blocks]
min_inscribed_radius = "0.2 m"
min_wall_area = "0 m^2"
[boundary]
sides = "rollers"
base = "rollers"
)";
const std::string supports = R"(
[support.bolts]
length = "2 m"
spacing = "30 deg"
stiffness = "0.2 GN/m"
[support.lining]
thickness = "10 cm"
E = "25 GPa"
nodes = 24
interface = { kn = "5 GPa/m", friction = "30 deg" }
)";

/// One that stands.
Results standing(const std::string& text, std::vector<std::string> more = {}) {
  Results results = results_of(text, more);
  REQUIRE((results.outcome.status == 0 || results.outcome.status == 6));
  return results;
}

std::string refusal_of(const std::string& text, std::vector<std::string> overrides = {}) {
  try {
    (void)read_input_text(text, "case.toml", ".", overrides);
  } catch (const InputErrors& errors) {
    return errors.what();
  }
  return "";
}
bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::vector<std::string> in_section{"--set", "model.dimension=2"};

double number(const Json& json, const char* table, const char* key) {
  return json.at(table).at(key);
}

}  // namespace

TEST_SUITE("program/spatial") {
  TEST_CASE("joints along the tunnel: the same file in 3-D and as a section") {
    // Pieces at the wall are kept: they are left out by their area here and by their volume there.
    // One rock in both: prisms through the whole length. What is left is that in 3-D blocks may
    // turn about axes in the section; by symmetry they do not.
    for (const char* const seed : {"1", "2", "3"}) {
      CAPTURE(seed);
      const std::vector<std::string> of_seed{"--set", std::string("model.seed=") + seed};
      std::vector<std::string> flat = in_section;
      flat.insert(flat.end(), of_seed.begin(), of_seed.end());
      const Results space = standing(two_sets + supports, of_seed),
                    section = standing(two_sets + supports, flat);
      CHECK(space.json.at("dimension") == 3);
      CHECK(space.json.at("verdict") == section.json.at("verdict"));
      CHECK(space.json.at("rock").at("bodies") == section.json.at("rock").at("bodies"));
      const auto agree = [&](const char* table, const char* key, double within) {
        CAPTURE(key);
        const double there = number(space.json, table, key),
                     here = number(section.json, table, key);
        CHECK(std::abs(there / here - 1) < within);
      };
      for (const char* const key : {"crown_mm", "invert_mm", "left_springing_mm"})
        agree("convergence", key, 0.03);
      for (const char* const key :
           {"mean_thrust_kN_per_m", "largest_thrust_kN_per_m", "largest_moment_kNm_per_m"})
        agree("lining", key, 0.03);
      // Rows of bolts are points along the tunnel, and load blocks of finite length off their
      // middle.
      agree("bolts", "mean_of_largest_forces_kN", 0.03);
      CHECK(space.json.at("bolts").at("count") == 21);  // three rows of the seven in the section
    }
  }

  TEST_CASE(
      "what has a meaning in one dimension alone is named in the other, and computed without") {
    const std::string text =
        replaced(two_sets, "facets = 24\n", "facets = 24\nround_length = \"1 m\"\nrounds = 2\n") +
        "[[round]]\nwall_traction = \"50 %\"\n"
        "[[round]]\nexcavate = \"nothing\"\nwall_traction = \"0 %\"\nbehind = 1\n";
    const Input space = read_input_text(text, "case.toml", ".");
    CHECK(space.round_count() == 2);
    CHECK(space.unused ==
          std::vector<std::string>{"round[0].wall_traction", "round[1].wall_traction"});
    const Input section = read_input_text(text, "case.toml", ".", {"model.dimension=2"});
    CHECK(section.unused == std::vector<std::string>{"model.length", "tunnel.round_length",
                                                     "tunnel.rounds", "round[1].behind"});
    const Results run = standing(text, in_section);
    CHECK(contains(
        run.outcome.out,
        "warning  not used in a section (model.dimension = 2): model.length, tunnel.round_length, "));
  }

  TEST_CASE("driven in rounds: the stages, what stands behind the face, and rock ahead of it") {
    const std::string text =
        replaced(replaced(two_sets, "length = \"3 m\"", "length = \"8 m\""), "facets = 24\n",
                 "facets = 24\nround_length = \"1.5 m\"\nrounds = 4\n") +
        supports +
        "[[round]]\nname = \"face\"\n"
        "[[round]]\nexcavate = \"nothing\"\ninstall = [\"bolts\", \"lining\"]\nbehind = 1\n";
    const Results run = standing(text);
    const Json& stages = run.json.at("stages");
    REQUIRE(stages.size() == 5);
    CHECK(stages[0].at("name") == "round 1");
    CHECK(stages[4].at("name") == "behind the face 1");
    CHECK(run.json.at("tunnel").at("driven_m") == 6.0);
    // The section times the length driven, from the picture of the blocks: rock taken out.
    CHECK(run.json.at("bolts").at("count") == 6 * 7);
    // The same tunnel in which all support is there before the rock moves carries more.
    const Results wished =
        standing(replaced(text, "behind = 1", "behind = 0"), {"--set", "round[1].name=support"});
    CHECK(number(wished.json, "lining", "mean_thrust_kN_per_m") >
          1.3 * number(run.json, "lining", "mean_thrust_kN_per_m"));
    for (const char* const file : {"bolts.csv", "lining.csv", "blocks.svg", "blocks.vtu",
                                   "joints.vtu", "bolts.vtu", "lining.vtu", "tunnel.vtm"})
      CHECK(run.files.count(file) == 1);
    CHECK(contains(run.files.at("blocks.vtu"), "Name=\"displacement_m\""));
    for (const char* const file : {"blocks.vtu", "joints.vtu", "bolts.vtu", "lining.vtu"})
      CHECK(contains(run.files.at("tunnel.vtm"), std::string("file=\"") + file + "\""));
    // One answer on screen, in run.json and in the picture.
    const std::string crown =
        voussoir::fixed_text(number(run.json, "convergence", "crown_mm"), 2) + " mm";
    CHECK(contains(run.outcome.out, "of the middle third: crown " + crown));
    CHECK(contains(run.files.at("blocks.svg"), crown));
    CHECK(contains(run.files.at("blocks.svg"), "crown, middle third"));
    for (const char* const panel : {"thrust", "moment"})
      CHECK(contains(run.files.at("blocks.svg"), panel));
  }

  TEST_CASE(
      "heading and bench end as the section that is taken out at once, where rock is elastic") {
    // Joints that neither slip nor open: the order of excavation leaves no trace.
    const std::string elastic =
        replaced(two_sets, "friction = \"40 deg\"", "friction = \"80 deg\"");
    const std::string parts =
        "[[round]]\nabove = \"0.3 m\"\nwall_traction = \"40 %\"\n"
        "[[round]]\nbelow = \"0.3 m\"\nright_of = \"0.2 m\"\n"
        "[[round]]\nbelow = \"0.3 m\"\nleft_of = \"0.2 m\"\n";
    for (const bool flat : {true, false}) {
      CAPTURE(flat);
      const std::vector<std::string> how = flat ? in_section : std::vector<std::string>{};
      const Results once = standing(elastic, how), in_parts = standing(elastic + parts, how);
      for (const char* const key : {"crown_mm", "invert_mm", "left_springing_mm"}) {
        CAPTURE(key);
        const double a = number(once.json, "convergence", key),
                     b = number(in_parts.json, "convergence", key);
        CHECK(std::abs(b / a - 1) < 0.02);
      }
    }
  }

  TEST_CASE("joints by azimuth: the section has their traces, and says so") {
    const std::string text =
        replaced(replaced(two_sets, "dip_direction = \"E\"", "dip_direction = \"75 deg\""),
                 "facets = 24\n", "facets = 24\ntrend = \"30 deg\"\n");
    const Input input = read_input_text(text, "case.toml", ".");
    const auto shown = section_set(input.joint_sets[0], input.tunnel);
    REQUIRE(shown);
    // tan = tan 70 sin 45; sine^2 = 1 - (sin 70 cos 45)^2
    const double degree = 0.017453292519943295, s70 = std::sin(70 * degree);
    CHECK(std::tan(shown->dip) == near(std::tan(70 * degree) * std::sqrt(0.5)));
    CHECK(shown->spacing == near(1.5 / std::sqrt(1 - 0.5 * s70 * s70)));
    CHECK(shown->dip_direction == voussoir::DipDirection::east);
    const Results run = standing(text, in_section);
    CHECK(contains(run.outcome.out, "set 1: dip 70 deg towards 75 deg is an apparent dip of 62.8"));
    // A set along the section is left out and named.
    const std::string along = replaced(text, "dip = \"20 deg\"\ndip_direction = \"W\"",
                                       "dip = \"88 deg\"\ndip_direction = \"32 deg\"");
    const Results without = standing(along, in_section);
    CHECK(contains(without.outcome.out, "set 2: runs along the section, within 5 deg"));
    CHECK(without.json.at("rock").at("joints_by_source").size() == 1);
  }

  TEST_CASE("the example is a tunnel in rounds and a section") {
    const std::string file = VOUSSOIR_TEST_EXAMPLES "/rounds/horseshoe.toml";
    const Input space = read_input(file);
    CHECK(space.is_spatial());
    CHECK(space.round_count() == 6);
    CHECK(unusual_values(space).empty());
    const Results section = standing(read_file(file), in_section);
    CHECK(section.json.at("stages").size() == 4);
    // Bedding strikes along the tunnel, J1 nearly, J2 across: traces of it are far apart.
    CHECK(section.json.at("rock").at("joints_in_section").size() == 2);
  }

  TEST_CASE("turned with its joints a tunnel is the same, in 3-D") {
    // Compass readings and trend turned by the same angle are one rock.
    const auto at = [](double trend) {
      const auto deg = [](double angle) {
        return "\"" + std::to_string(angle >= 360 ? angle - 360 : angle) + " deg\"";
      };
      return replaced(replaced(replaced(two_sets, "dip_direction = \"E\"",
                                        "dip_direction = " + deg(trend + 50)),
                               "dip_direction = \"W\"", "dip_direction = " + deg(trend + 250)),
                      "facets = 24\n", "facets = 24\ntrend = " + deg(trend) + "\n");
    };
    const Results north = standing(at(0)), turned = standing(at(211));
    CHECK(north.json.at("rock").at("bodies") == turned.json.at("rock").at("bodies"));
    CHECK(number(turned.json, "convergence", "crown_mm") ==
          near(number(north.json, "convergence", "crown_mm")).epsilon(1e-5));
  }

  TEST_CASE("a unit that slipped by a thousand is refused or named, of keys in 3-D too") {
    const std::string text =
        replaced(replaced(two_sets, "dip_direction = \"E\"\nsd = \"3 deg\"\nspacing = \"1.5 m\"",
                          "dip_direction = \"75 deg\"\nK = 200\nP32 = \"0.6 m^2/m^3\"\n"
                          "extent = \"4 m\"\nstrike_extent = \"6 m\""),
                 "facets = 24\n", "facets = 24\ntrend = \"30 deg\"\nround_length = \"1 m\"\n") +
        replaced(supports, "nodes = 24\n", "nodes = 24\nrib_spacing = \"0.5 m\"\n");
    CHECK(unusual_values(read_input_text(text, "case.toml", ".")).empty());
    struct Key {
      const char* name;
      double value;
      const char* unit;
    };
    for (const Key& key :
         {Key{"model.length", 3, " m"}, Key{"tunnel.round_length", 1, " m"},
          Key{"joint_set[0].K", 200, ""}, Key{"joint_set[0].P32", 0.6, " /m"},
          Key{"joint_set[0].strike_extent", 6, " m"}, Key{"support.lining.rib_spacing", 0.5, " m"}})
      for (const double slip : {1e3, 1e-3}) {
        const std::string given =
            std::string(key.name) + "=" + std::to_string(slip * key.value) + key.unit;
        CAPTURE(given);
        std::string said = refusal_of(text, {given});
        if (said.empty())
          for (const std::string& line :
               unusual_values(read_input_text(text, "case.toml", ".", {given})))
            said += line + "\n";
        CHECK(contains(said, key.name));
      }
  }

  TEST_CASE("what cannot be is refused by key, with what is accepted") {
    const std::string rounds = "[[round]]\nabove = \"0 m\"\n[[round]]\nbelow = \"0 m\"\n";
    struct Bad {
      std::string text, message, accepted;
    };
    const auto without = [](const std::string& line) { return replaced(two_sets, line, ""); };
    const auto tunnel = [](const std::string& lines) {
      return replaced(two_sets, "facets = 24\n", "facets = 24\n" + lines);
    };
    const auto set = [](const std::string& lines) {
      return replaced(two_sets, "spacing = \"1.5 m\"\n[[joint_set]]",
                      "spacing = \"1.5 m\"\n" + lines + "[[joint_set]]");
    };
    const std::vector<Bad> cases{
        {without("length = \"3 m\"\n"), "model.length is missing", "a length"},
        {replaced(two_sets, "dimension = 3", "dimension = 4"), "model.dimension = 4", "2 to 3"},
        {replaced(two_sets, "dip_direction = \"E\"", "dip_direction = \"90 deg\""),
         "is an azimuth, and the file does not say where the tunnel goes", "tunnel.trend"},
        {tunnel("round_length = \"4 m\"\n"), "is longer than the tunnel of 3 m", "at most 3 m"},
        {tunnel("round_length = \"1 m\"\nrounds = 4\n"), "rounds of 1 m are longer", "1 to 3"},
        {tunnel("rounds = 4\n"), "tunnel.rounds", "round_length"},
        {set("K = 200\n"), "joint_set[0].K = 200 is given besides sd", "one of the two"},
        {set("P32 = \"1 /m\"\n"), "is given besides", "one of intensity, spacing, P32 and P30"},
        {set("strike_extent = \"1 m\"\n"), "is of a set of the section", "by azimuth"},
        {replaced(two_sets, "sides = \"rollers\"\nbase = \"rollers\"",
                  "sides = \"rollers\"\nbase = \"elastic\""),
         "is of a section", "\"rollers\""},
        {two_sets + "[joints]\nfile = \"t.csv\"\n", "has traces of a section", "joint sets"},
        {two_sets + replaced(supports, "nodes = 24\n", "nodes = 24\nrib_spacing = \"4 m\"\n"),
         "support.lining.rib_spacing = \"4 m\" is longer than what is lined", "at most 3 m"},
        {two_sets + "[[round]]\nbelow = \"0 m\"\n[[round]]\nabove = \"0 m\"\n",
         "round[0] leaves rock of the section hanging above it", "a heading before its bench"},
        {two_sets + rounds + "[[round]]\n", "round[2] excavates once more", "\"nothing\""},
        {two_sets + "[[round]]\nabove = \"0 m\"\n", "round leaves rock in the section",
         "all of it"},
        {two_sets + "[[round]]\nabove = \"9 m\"\n", "round[0] excavates nothing",
         "cross the section"},
        {two_sets + "[[round]]\nabove = \"1 m\"\nbelow = \"0 m\"\n", "leaves nothing",
         "under below"},
        {two_sets + "[[round]]\nexcavate = \"nothing\"\n", "there is no opening yet",
         "an excavation first"},
        {two_sets + rounds + "[[stage]]\nwall_traction = 0\n", "stage is given besides round",
         "[[round]] alone"},
        {two_sets + rounds + "[[round]]\nexcavate = \"nothing\"\nbehind = 1\n", "round[2].behind",
         "round_length"},
        {two_sets +
             replaced(supports, "length = \"2 m\"", "length = \"2 m\"\nout_of_plane = \"4 m\""),
         "support.bolts.out_of_plane = \"4 m\" leaves no row", "at most 3 m"},
        {two_sets + supports.substr(0, supports.find("[support.lining]")) + rounds,
         "support.bolts is in no stage", "in one [[round]]"},
    };
    for (const Bad& bad : cases) {
      CAPTURE(bad.message);
      const std::string said = refusal_of(bad.text);
      CAPTURE(said);
      CHECK(contains(said, bad.message));
      CHECK(contains(said, bad.accepted));
      CHECK_FALSE(contains(said, "2 errors"));
    }
    // A bench that is nearer to the face than its heading comes first, along the tunnel.
    CHECK(
        contains(refusal_of(tunnel("round_length = \"1 m\"\n") +
                            "[[round]]\nabove = \"0 m\"\nbehind = 2\n[[round]]\nbelow = \"0 m\"\n"),
                 "round[1] leaves rock of the section hanging above it"));
  }
}

}  // namespace program_spatial_test
