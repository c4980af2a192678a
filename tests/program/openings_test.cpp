// SPDX-License-Identifier: MIT
// Several openings in one file: twin tunnels, a cross-drift, a shaft; outlines of their own for
// rounds; a tunnel that plunges.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/openings.hpp>

#include "input.hpp"
#include "run_results.hpp"

namespace openings_test {

using namespace voussoir_test;

namespace {

/// A square tunnel of 4 m in rock of 40 m x 24 m that is cut by two sets of endless joints, on the
/// boundary that 2-D and 3-D have in common.
std::string rock(const std::string& model, const std::string& openings) {
  return "[model]\nwidth = \"40 m\"\nbelow_invert = \"10 m\"\n" + model +
         "[tunnel]\nshape = \"polygon\"\n"
         "vertices = [[\"-2 m\", \"-2 m\"], [\"2 m\", \"-2 m\"], [\"2 m\", \"2 m\"], [\"-2 m\", "
         "\"2 m\"]]\ncover = \"10 m\"\n" +
         openings +
         "[rock]\ndensity = \"2700 kg/m^3\"\n[stress]\nK0 = 1.0\n"
         "[boundary]\nsides = \"rollers\"\nbase = \"rollers\"\n"
         "[[joint_set]]\ndip = \"70 deg\"\ndip_direction = \"E\"\nspacing = \"2 m\"\n"
         "[[joint_set]]\ndip = \"20 deg\"\ndip_direction = \"W\"\nspacing = \"2 m\"\n"
         "[joint]\nkn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"70 deg\"\n"
         "[blocks]\nmin_inscribed_radius = \"0.2 m\"\nmin_wall_area = \"0 m^2\"\n";
}

std::string square(const std::string& half) {
  const std::string a = "\"" + half + " m\"", b = "\"-" + half + " m\"";
  return "shape = \"polygon\"\nvertices = [[" + b + ", " + b + "], [" + a + ", " + b + "], [" + a +
         ", " + a + "], [" + b + ", " + a + "]]\n";
}

std::string opening(const std::string& name, const std::string& at, const std::string& rest) {
  return "[[opening]]\nname = \"" + name + "\"\nat = " + at + "\n" + rest;
}
std::string round_of(const std::string& name, const std::string& rest = "") {
  return "[[round]]\nopening = \"" + name + "\"\n" + rest;
}

double crown(const nlohmann::json& convergence) { return convergence.at("crown_mm").get<double>(); }

/// Rock that is there at the end [m^2], [m^3].
double rock_left(const Results& run) {
  const auto& rock = run.json.at("rock");
  const char* const mean =
      rock.contains("mean_block_volume_m3") ? "mean_block_volume_m3" : "mean_block_area_m2";
  return rock.at("bodies").get<double>() * rock.at(mean).get<double>();
}

const std::string flat = "", deep = "dimension = 3\nlength = \"10 m\"\n";
const std::string twin = opening("twin", "[\"11 m\", \"0 m\"]", square("2"));

}  // namespace

TEST_SUITE("program/openings") {
  TEST_CASE("twin tunnels, in 2-D and 3-D the same") {
    const std::string rounds = round_of("tunnel") + round_of("twin");
    const Results section = results_of(rock(flat, twin) + rounds),
                  space = results_of(rock(deep, twin) + rounds);
    for (const Results* run : {&section, &space}) {
      CHECK(run->json.at("verdict") == "stable");
      REQUIRE(run->json.at("openings").size() == 1);
      CHECK(run->json.at("openings")[0].at("name") == "twin");
      CHECK(run->outcome.out.find("of the twin: crown") != std::string::npos);
    }
    // Joints go on along the tunnel: plane strain, to the 1e-3 of searches.
    const auto twin_of = [](const Results& run) {
      return crown(run.json.at("openings")[0].at("convergence"));
    };
    CHECK(std::abs(crown(space.json.at("convergence")) / crown(section.json.at("convergence")) -
                   1) < 5e-3);
    CHECK(std::abs(twin_of(space) / twin_of(section) - 1) < 5e-3);
    CHECK(std::abs(rock_left(section) - (40 * 24 - 2 * 16)) < 1e-6);
    CHECK(std::abs(rock_left(space) - 10 * (40 * 24 - 2 * 16)) < 1e-5);
  }

  TEST_CASE("what is printed as the tunnel's does not turn into that of the opening driven last") {
    const std::string alone = rock(flat, "") + "[[round]]\n";
    const std::string far = opening("far", "[\"14 m\", \"-4 m\"]", square("1"));
    const Results one = results_of(alone),
                  other = results_of(rock(flat, far) + round_of("tunnel") + round_of("far"));
    // A drift of a quarter of the section, two and a half widths away.
    CHECK(std::abs(crown(other.json.at("convergence")) / crown(one.json.at("convergence")) - 1) <
          0.15);
    CHECK(crown(other.json.at("openings")[0].at("convergence")) <
          0.7 * crown(other.json.at("convergence")));
  }

  TEST_CASE("bolts and linings are of the opening that they name") {
    const std::string supports =
        "[[support.bolts]]\nname = \"b0\"\nlength = \"2 m\"\nspacing = \"30 deg\"\n"
        "stiffness = \"0.2 GN/m\"\n"
        "[[support.bolts]]\nname = \"b1\"\nopening = \"twin\"\nlength = \"2 m\"\n"
        "spacing = \"30 deg\"\nstiffness = \"0.2 GN/m\"\n"
        "[[support.lining]]\nname = \"l1\"\nopening = \"twin\"\nthickness = \"10 cm\"\n"
        "E = \"25 GPa\"\ninterface = { kn = \"5 GPa/m\", friction = \"35 deg\" }\n";
    const auto rounds = [](const char* first, const char* second) {
      return round_of("tunnel", std::string("wall_traction = 0.4\ninstall = [") + first + "]\n") +
             round_of("twin", std::string("install = [") + second + "]\n");
    };
    for (const std::string& model : {flat, deep}) {
      const Results run =
          results_of(rock(model, twin) + supports + rounds("\"bolts\"", "\"bolts\", \"lining\""));
      CHECK(run.json.at("verdict") == "stable");
      const bool is_flat = model.empty();
      CHECK(run.json.at("bolts").at("count") == (is_flat ? 14 : 140));
      // Every node of the lining lies around the twin.
      const std::string& table = run.files.at("lining.csv");
      CHECK(table.find("\n") != std::string::npos);
      if (is_flat) {
        const Results named =
            results_of(rock(model, twin) + supports + rounds("\"b0\"", "\"b1\", \"l1\""));
        CHECK(named.json.at("convergence") == run.json.at("convergence"));
      }
    }
    // The diagrams of the picture are of the tunnel: of bolts in the twin alone there are none.
    const std::string twins =
        "[support.bolts]\nopening = \"twin\"\nlength = \"2 m\"\n"
        "spacing = \"30 deg\"\nstiffness = \"0.2 GN/m\"\n";
    const auto chart_of = [&](const std::string& bolts, const std::string& rounds_of_it) {
      const Results run = results_of(rock(flat, twin) + bolts + rounds_of_it);
      CHECK(run.json.at("bolts").at("count") == 7);
      return run.files.at("blocks.svg").find("Greatest force in each bolt") != std::string::npos;
    };
    CHECK_FALSE(chart_of(twins, round_of("tunnel") + round_of("twin", "install = [\"bolts\"]\n")));
    CHECK(chart_of(replaced(twins, "opening = \"twin\"\n", ""),
                   round_of("tunnel", "install = [\"bolts\"]\n") + round_of("twin")));
    const Folder folder;
    const Outcome refused =
        run_program({"check", write_file(folder / "case.toml",
                                         rock(flat, twin) + supports + rounds("\"b1\"", ""))});
    CHECK(refused.status == 2);
    CHECK(refused.err.find("is of the twin, and the round works in the tunnel") !=
          std::string::npos);
  }

  TEST_CASE("a cross-drift and a shaft take out what geometry says, and a section names them") {
    // From the axis of the tunnel to 6 m: 4 m beyond its wall. From the surface, 12 m above the
    // centre, down to 4 m above the roof of the tunnel, 5 m beside it.
    const std::string openings =
        opening("drift", "[\"0 m\", \"0 m\"]",
                "place = \"5 m\"\nturn = \"90 deg\"\nto = \"6 m\"\n" + square("1")) +
        opening("shaft", "[\"-9 m\", \"12 m\"]",
                "place = \"5 m\"\nplunge = \"90 deg\"\nto = \"6 m\"\n" + square("1"));
    const std::string text =
        rock(deep, openings) + round_of("tunnel") + round_of("drift") + round_of("shaft");
    const Results space = results_of(text);
    CHECK(space.json.at("verdict") == "stable");
    CHECK(std::abs(rock_left(space) - (10 * (40 * 24 - 16) - 4 * 4 - 4 * 6)) < 1e-5);
    const Results section = results_of(text, {"--set", "model.dimension=2"});
    CHECK(std::abs(rock_left(section) - (40 * 24 - 16)) < 1e-6);
    CHECK(section.outcome.out.find("not used in a section") != std::string::npos);
    CHECK(section.outcome.out.find("opening[0], opening[1]") != std::string::npos);
    const Results alone = results_of(rock(flat, "") + "[[round]]\n");
    CHECK(section.json.at("convergence") == alone.json.at("convergence"));
  }

  TEST_CASE("another opening is driven in rounds of its own behind the tunnel's face") {
    const std::string drift = opening(
        "drift", "[\"0 m\", \"0 m\"]",
        "place = \"5 m\"\nturn = \"-90 deg\"\nfrom = \"2 m\"\nto = \"7 m\"\nround_length = \"2 m\"\n" +
            square("1"));
    const std::string text = replaced(rock(deep, drift), "cover = \"10 m\"\n",
                                      "cover = \"10 m\"\nround_length = \"2.5 m\"\nrounds = 3\n") +
                             round_of("tunnel") + round_of("drift", "behind = 2\n");
    const Results run = results_of(text);
    // Three rounds of the tunnel; the drift's three of 2, 2 and 1 m begin with the third.
    REQUIRE(run.json.at("stages").size() == 5);
    CHECK(run.json.at("stages")[2].at("name") == "round 3");
    CHECK(run.json.at("stages")[4].at("name") == "behind the face 2");
    CHECK(std::abs(rock_left(run) - (10 * 40 * 24 - 7.5 * 16 - 5 * 4)) < 1e-5);
    const Folder folder;
    const Outcome check = run_program({"check", write_file(folder / "case.toml", text)});
    CHECK(check.out.find("drift: outline 2 m wide") != std::string::npos);
    CHECK(check.out.find("in 3 rounds") != std::string::npos);
  }

  TEST_CASE(
      "bolts through the mouth of an opening to come are refused before anything is computed") {
    const std::string text =
        rock(deep, opening("drift", "[\"0 m\", \"0 m\"]",
                           "place = \"5 m\"\nturn = \"90 deg\"\nto = \"6 m\"\n" + square("1"))) +
        "[support.bolts]\nlength = \"2 m\"\nspacing = \"20 deg\"\narc = [\"0 deg\", \"20 deg\"]\n"
        "stiffness = \"0.2 GN/m\"\n" +
        round_of("tunnel", "install = [\"bolts\"]\n") + round_of("drift");
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", text);
    for (const char* verb : {"check", "run"}) {
      const Outcome outcome = run_program({verb, file, "--out", folder / "out"});
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("through rock that stage \"round 2\" takes out") != std::string::npos);
      CHECK(contents(folder / "out").empty());
    }
  }

  TEST_CASE("a drift through the wall of a lined tunnel opens the lining") {
    // From 1 m on, within the tunnel: what of it lies beyond the wall is rock.
    const std::string drift =
        opening("drift", "[\"0 m\", \"0 m\"]",
                "place = \"5 m\"\nturn = \"90 deg\"\nfrom = \"2 m\"\nto = \"6 m\"\n" + square("1"));
    const std::string lining =
        "[support.lining]\nthickness = \"10 cm\"\nE = \"25 GPa\"\nnodes = 32\n"
        "interface = { kn = \"5 GPa/m\", friction = \"35 deg\" }\n";
    const std::string lined = "install = [\"lining\"]\n";
    const auto members = [](const Results& run) {
      const std::string& table = run.files.at("lining.csv");
      return std::count(table.begin(), table.end(), '\n') - 1;
    };
    const Results whole = results_of(rock(deep, "") + lining + "[[round]]\n" + lined),
                  before = results_of(rock(deep, drift) + lining + round_of("tunnel", lined) +
                                      round_of("drift")),
                  after =
                      results_of(rock(deep, drift) + lining + round_of("tunnel") +
                                 round_of("drift") + "[[round]]\nexcavate = \"nothing\"\n" + lined);
    for (const Results* run : {&whole, &before, &after}) CHECK(run->json.at("verdict") == "stable");
    CHECK(members(before) < members(whole));
    // One that comes afterwards goes on across the mouth, and that is said.
    CHECK(members(after) == members(whole));
    CHECK(after.outcome.out.find("or another opening is there") != std::string::npos);
    // A lining that bears the excavation of the drift alone carries less than one from the start.
    const auto thrust = [](const Results& run) {
      return run.json.at("lining").at("largest_thrust_kN_per_m").get<double>();
    };
    CHECK(thrust(after) < thrust(before));
  }

  TEST_CASE("forepoles lie over the rock ahead, and a section has none") {
    const std::string poles =
        "[support.bolts]\nname = \"poles\"\nlength = \"5 m\"\nspacing = \"0.5 m\"\n"
        "arc = [\"45 deg\", \"135 deg\"]\nout_of_plane = \"2.5 m\"\nahead = \"12 deg\"\n"
        "stiffness = \"0.2 GN/m\"\n";
    const std::string text = replaced(rock(deep, ""), "cover = \"10 m\"\n",
                                      "cover = \"10 m\"\nround_length = \"2.5 m\"\nrounds = 3\n") +
                             poles + "[[round]]\ninstall = [\"bolts\"]\n";
    const voussoir::program::Input input =
        voussoir::program::read_input_text(text, "case.toml", ".");
    const auto bars =
        voussoir::design::rows_of_pattern(input, input.bolts.front(), input.bolts.front().spacing);
    CHECK(bars.size() % 3 == 0);
    CHECK(bars.size() >= 3 * 6);
    for (const auto& bar : bars) {
      const voussoir::Vec3 way = bar.end - bar.start;
      CHECK(std::abs(bar.start.z() - 2) < 1e-9);  // on the flat roof
      CHECK(std::abs(way.y() / way.norm() - std::cos(12 * 3.14159265358979323846 / 180)) < 1e-9);
      CHECK(way.z() > 0);
      // 10 m of model: those from 0 and 2.5 m on are whole, of 5 m from 5 m, too.
      CHECK(std::abs(way.norm() - 5) < 1e-9);
      CHECK(bar.end.y() < 10);
    }
    const Results run = results_of(text);
    CHECK(run.json.at("verdict") == "stable");
    CHECK(run.json.at("bolts").at("count") == bars.size());
    const Results section = results_of(text, {"--set", "model.dimension=2"});
    CHECK_FALSE(section.json.contains("bolts"));
    CHECK(section.outcome.out.find("support.bolts.ahead") != std::string::npos);
    // Bolts that stand where forepoles would in a section have their own strength.
    const auto list = [&](const std::string& table, const char* strength) {
      return replaced(table, "[support.bolts]\n", "[[support.bolts]]\n") + "yield_force = \"" +
             strength + "\"\n";
    };
    const std::string across = replaced(
        replaced(poles, "name = \"poles\"\n", "name = \"across\"\n"), "ahead = \"12 deg\"\n", "");
    const Results both = results_of(rock(flat, "") + list(poles, "100 kN") +
                                    list(across, "300 kN") + "[[round]]\ninstall = [\"bolts\"]\n");
    CHECK(both.json.at("bolts").at("count") == bars.size() / 3);
    CHECK(both.json.at("bolts").at("strength") == "300 kN");
  }

  TEST_CASE("a round by its outline is that by limits, and the rest is what is left") {
    const std::string box =
        "vertices = [[\"-9 m\", \"-0.5 m\"], [\"9 m\", \"-0.5 m\"], [\"9 m\", \"9 m\"], [\"-9 m\", "
        "\"9 m\"]]\n";
    for (const std::string& model : {flat, deep}) {
      const auto run = [&](const std::string& heading, const std::string& bench) {
        return results_of(rock(model, "") + "[[round]]\nwall_traction = 0.3\n" + heading +
                          "[[round]]\n" + bench);
      };
      const Results limits = run("above = \"-0.5 m\"\n", "below = \"-0.5 m\"\n"),
                    outline = run(box, "excavate = \"rest\"\n");
      CHECK(limits.json.at("verdict") == "stable");
      // The rest is taken out with the heading's outline within it: another cut of the same rock.
      CHECK(std::abs(crown(outline.json.at("convergence")) / crown(limits.json.at("convergence")) -
                     1) < 5e-3);
      CHECK(std::abs(rock_left(outline) - rock_left(limits)) < 1e-6);
    }
    // A pilot that touches no wall, in a drawn outline of eight corners, then the rest.
    const Results pilot = results_of(
        rock(flat, "") +
        "[[round]]\nwall_traction = 0.3\nvertices = [[\"-1 m\", \"-0.5 m\"], [\"-0.5 m\", \"-1 m\"], "
        "[\"0.5 m\", \"-1 m\"], [\"1 m\", \"-0.5 m\"], [\"1 m\", \"0.5 m\"], [\"0.5 m\", \"1 m\"], "
        "[\"-0.5 m\", \"1 m\"], [\"-1 m\", \"0.5 m\"]]\n[[round]]\nexcavate = \"rest\"\n");
    CHECK(pilot.json.at("verdict") == "stable");
    CHECK(std::abs(rock_left(pilot) - (40 * 24 - 16)) < 1e-6);
  }

  TEST_CASE("a tunnel that plunges") {
    // Its plane at right angles is 16 m^2; along the model it is 1 / cos(plunge) longer.
    const double cosine = std::cos(10 * 3.14159265358979323846 / 180);
    for (const char* plunge : {"10 deg", "-10 deg"}) {
      const std::string text =
          replaced(rock(deep, ""), "cover = \"10 m\"\n",
                   std::string("cover = \"10 m\"\nplunge = \"") + plunge + "\"\n");
      const Results run = results_of(text + "[[round]]\n");
      CHECK(run.json.at("verdict") == "stable");
      const double fall = plunge[0] == '1' ? 10 * std::tan(std::acos(cosine)) : 0;
      CHECK(std::abs(rock_left(run) - (10 * 40 * (24 + fall) - 10 * 16 / cosine)) < 1e-5);
    }
  }

  TEST_CASE("the example is checked in 3-D and computed as a section") {
    const std::string file = std::string(VOUSSOIR_TEST_EXAMPLES) + "/rounds/cross_passage.toml";
    const Outcome check = run_program({"check", file});
    CHECK(check.status == 0);
    for (const char* words :
         {"opening  second tube: circle 6 m wide", "in 4 rounds",
          "passage: horseshoe 3 m wide, 3 m high, at (0, 0) m, turned by 90 deg",
          "8 rounds behind the face", "9 stages"})
      CHECK(check.out.find(words) != std::string::npos);
    const Results section = results_of(read_file(file), {"--set", "model.dimension=2"});
    CHECK(section.json.at("verdict") == "stable");
    CHECK(section.json.at("openings").size() == 1);
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::string& text, const std::vector<const char*>& words) {
      const Folder folder;
      const Outcome outcome =
          run_program({"run", write_file(folder / "case.toml", text), "--out", folder / "out"});
      CAPTURE(outcome.out);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      for (const char* word : words) CHECK(outcome.err.find(word) != std::string::npos);
      CHECK(contents(folder / "out").empty());
    };
    const std::string both = round_of("tunnel") + round_of("twin");
    refused(rock(flat, twin), {"opening[0]", "is excavated by no round", "opening = \"twin\""});
    refused(rock(flat, replaced(twin, "11 m", "3 m")) + both,
            {"opening[0]", "takes out rock of the tunnel, at "});
    refused(rock(flat, replaced(twin, "11 m", "19 m")) + both,
            {"opening[0]", "touches or leaves the domain"});
    refused(rock(flat, twin) + round_of("twins"), {"twins", "tunnel", "twin"});
    refused(rock(flat, twin) + round_of("twin"), {"round", "and not the tunnel"});
    refused(rock(flat, twin + replaced(twin, "11 m", "-11 m")) + both,
            {"opening[1].name", "is that of another opening"});
    refused(
        rock(deep, opening("drift", "[\"0 m\", \"0 m\"]", "turn = \"90 deg\"\n" + square("1"))) +
            round_of("tunnel") + round_of("drift"),
        {"opening[0]", "does not say where it ends", "to = "});
    refused(rock(deep, replaced(twin, "shape", "from = \"6 m\"\nto = \"5 m\"\nshape")) + both,
            {"opening[0]", "has no length"});
    refused(rock(deep, replaced(twin, "shape", "place = \"30 m\"\nshape")) + both,
            {"opening[0].place", "is beyond the end of the model", "0 to 10 m"});
    refused(rock(deep, replaced(twin, "shape", "round_length = \"2 m\"\nshape")) + both,
            {"opening[0].round_length", "tunnel.round_length"});
    refused(rock(flat, replaced(twin, "at = [\"11 m\", \"0 m\"]\n", "")) + both,
            {"opening[0]", "at"});
    refused(rock(flat, twin) + both + round_of("twin"),
            {"round[2]", "excavates once more what a round before it has taken out"});
    refused(rock(flat, twin) +
                "[[round]]\nabove = \"0 m\"\nvertices = [[\"0 m\", \"0 m\"], "
                "[\"1 m\", \"0 m\"], [\"0 m\", \"1 m\"]]\n" +
                both,
            {"round[0].above", "is given besides an outline"});
    refused(rock(flat, "") +
                "[[round]]\nvertices = [[\"5 m\", \"0 m\"], [\"6 m\", \"0 m\"], "
                "[\"5 m\", \"1 m\"]]\n",
            {"round[0]", "no part of the section lies in it"});
    refused(rock(flat, "") +
                "[[round]]\nvertices = [[\"0 m\", \"0 m\"], [\"1 m\", \"1 m\"], "
                "[\"1 m\", \"0 m\"], [\"0 m\", \"1 m\"]]\n",
            {"round[0].vertices", "crosses itself"});
    refused(rock(flat, "") + "[[round]]\n[[round]]\nexcavate = \"rest\"\n",
            {"round[1]", "finds nothing left to excavate"});
    refused(replaced(rock(deep, ""), "cover", "plunge = \"60 deg\"\ncover"),
            {"tunnel.plunge", "from -45 deg to 45 deg"});
    refused(replaced(rock("dimension = 3\nlength = \"60 m\"\n", ""), "cover",
                     "plunge = \"-30 deg\"\ncover"),
            {"tunnel.plunge", "comes out of the ground"});
  }
}

}  // namespace openings_test
