// SPDX-License-Identifier: MIT
// Loads on blocks of the rock around a tunnel, from an input file to results, in 2-D and 3-D.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>
#include <voussoir/core/vec.hpp>

#include "analysis.hpp"
#include "harness.hpp"
#include "input.hpp"
#include "run_results.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace rock_loads_test {

namespace {

using namespace voussoir_test;
using Json = nlohmann::json;
using voussoir::program::Input;
using voussoir::program::read_input_text;

/// Closer than what a search is content with: results are held against closed forms.
const std::string exact = "[run]\ntolerance = 1e-6\nout_of_balance = 1e-6\n";

/// Stages that excavate and then load.
const std::string in_turn =
    "[[stage]]\nname = \"excavation\"\nwall_traction = 0\n[[stage]]\nname = \"load\"\n"
    "wall_traction = 0\n";

std::string load(const std::string& at, const std::string& force, const std::string& more = "") {
  return "[[load]]\nat = [" + at + "]\nforce = [" + force + "]\n" + more;
}

/// Level layers that go through from side to side, 20 m wide and 2 m long, over a tunnel whose
/// crown is 8 m below the surface, y = 10 m.
std::string layers(bool spatial) {
  std::string text = CircleInRock{.joint =
                                      "kn = \"5 GPa/m\"\nks = \"5 GPa/m\"\nfriction = "
                                      "\"60 deg\"\n"}
                         .text();
  text = replaced(text, "dip = \"70 deg\"", "dip = \"0 deg\"");
  text.erase(text.find("[[joint_set]]\ndip = \"20 deg\""),
             text.find("[blocks]") - text.find("[[joint_set]]\ndip = \"20 deg\""));
  return spatial ? replaced(text, "[model]\n", "[model]\ndimension = 3\n") : text;
}

voussoir::Vec3 moved(const Results& r, std::size_t load) {
  const Json& at = r.json.at("loads").at(load).at("displacement_mm");
  voussoir::Vec3 mm = voussoir::Vec3::Zero();
  for (std::size_t k = 0; k < at.size(); ++k)
    mm[static_cast<Eigen::Index>(k)] = at[k].get<double>();
  return 1e-3 * mm;
}

}  // namespace

TEST_SUITE("program/rock_loads") {
  TEST_CASE("layers under a load close by force over stiffness and area, 2-D and 3-D") {
    for (const bool spatial : {false, true}) {
      CAPTURE(spatial);
      const std::string nothing = spatial ? R"("0 kN", "0 kN", "0 kN")" : R"("0 kN/m", "0 kN/m")",
                        pressed =
                            spatial ? R"("0 kN", "0 kN", "-20 MN")" : R"("0 kN/m", "-10 MN/m")",
                        place = spatial ? "place = \"1 m\"\n" : "";
      const std::string upper = R"("0 m", "9.7 m")", lower = R"("0 m", "5 m")";
      const auto text = [&](const std::string& force) {
        return layers(spatial) + in_turn + load(upper, force, place) + load(lower, nothing, place) +
               exact;
      };
      const Results before = results_of(text(nothing)), after = results_of(text(pressed));
      REQUIRE(before.outcome.status == 0);
      REQUIRE(after.outcome.status == 0);
      // How many joints lie between the two.
      const Input input = read_input_text(text(pressed), "case.toml", ".", {});
      int between = 0;
      const auto count = [&](const auto& bodies, auto top, auto bottom) {
        const auto height_at = [&](const auto& point) {
          for (const auto& body : bodies)
            for (const auto& part : body.parts)
              if (part.contains(point)) return body.properties.centroid[point.size() - 1];
          FAIL("no block");
          return 0.0;
        };
        const double above = height_at(top), below = height_at(bottom);
        for (const auto& body : bodies) {
          const double height = body.properties.centroid[top.size() - 1];
          if (height > below && height <= above) ++between;
        }
      };
      using namespace voussoir;
      if (spatial)
        count(program::described_spatial_rock(input).mass.bodies, Vec3(0, 1, 9.7), Vec3(0, 1, 5));
      else
        count(program::described_rock(input).mass.bodies, Vec2(0, 9.7), Vec2(0, 5));
      REQUIRE(between > 1);
      const voussoir::Vec3 nearer =
          (moved(after, 0) - moved(before, 0)) - (moved(after, 1) - moved(before, 1));
      const double expected = between * 10e6 / (5e9 * 20);
      CHECK(-nearer[spatial ? 2 : 1] == near(expected).epsilon(1e-6));
    }
  }

  TEST_CASE("what a load at one block does to another, the other's does to it, 2-D and 3-D") {
    // Maxwell and Betti: joints that neither slip nor open are springs.
    for (const bool spatial : {false, true}) {
      CAPTURE(spatial);
      CircleInRock rock;
      rock.joint = "kn = \"5 GPa/m\"\nks = \"2 GPa/m\"\nfriction = \"89 deg\"\n";
      const std::string text =
          (spatial ? replaced(rock.text(), "[model]\n", "[model]\ndimension = 3\n") : rock.text()) +
          in_turn;
      const auto with = [&](const std::string& first, const std::string& second) {
        const std::string place = spatial ? "place = \"1 m\"\n" : "";
        return results_of(text + load(R"("1.3 m", "4.1 m")", first, place) +
                          load(R"("-3.6 m", "1.7 m")", second, place) + exact);
      };
      const std::string none = spatial ? R"("0 N", "0 N", "0 N")" : R"("0 N/m", "0 N/m")",
                        right = spatial ? R"("30 kN", "0 kN", "0 kN")" : R"("30 kN/m", "0 kN/m")",
                        up = spatial ? R"("0 kN", "0 kN", "30 kN")" : R"("0 kN/m", "30 kN/m")";
      const Results rest = with(none, none), first = with(right, none), second = with(none, up);
      for (const Results* r : {&rest, &first, &second}) REQUIRE(r->outcome.status == 0);
      CHECK(rest.json.at("loads")[0].at("block") != rest.json.at("loads")[1].at("block"));
      const double at_second = (moved(first, 1) - moved(rest, 1))[spatial ? 2 : 1],
                   at_first = (moved(second, 0) - moved(rest, 0))[0],
                   own = (moved(first, 0) - moved(rest, 0))[0];
      CHECK(own > 0);
      CHECK(std::abs(at_second) > 1e-3 * own);
      CHECK(std::abs(at_second - at_first) < 1e-4 * own);
    }
  }

  TEST_CASE("a moment, and a force beside the centre, are what they are to a block") {
    const std::string text = CircleInRock{}.text() + in_turn;
    const auto run_with = [&](const std::string& loads) {
      return results_of(text + loads + exact);
    };
    const Results r = run_with(load(R"("1.3 m", "4.1 m")", R"("0 N/m", "0 N/m")"));
    // Two forces that make a couple: one at each of two points of the block, 5 cm apart.
    const Results couple = run_with(load(R"("1.3 m", "4.1 m")", R"("0 kN/m", "40 kN/m")") +
                                    load(R"("1.25 m", "4.1 m")", R"("0 kN/m", "-40 kN/m")"));
    const Results moment =
        run_with("[[load]]\nat = [\"1.3 m\", \"4.1 m\"]\nmoment = \"2 kN m/m\"\n");
    REQUIRE(couple.json.at("loads")[0].at("block") == couple.json.at("loads")[1].at("block"));
    const voussoir::Vec3 by_couple = moved(couple, 0) - moved(r, 0),
                         by_moment = moved(moment, 0) - moved(r, 0);
    CHECK(by_moment.norm() > 1e-9);
    CHECK((by_couple - by_moment).norm() < 1e-5 * by_moment.norm());
    CHECK(moment.outcome.out.find("a moment of 2 kN m/m at (1.3, 4.1) m, on block") !=
          std::string::npos);
  }

  TEST_CASE("a roof block that stands comes off under a load; screen, picture and report say so") {
    const std::string text = CircleInRock{}.text() + in_turn;
    const auto pulled = [&](const std::string& force) {
      return results_of(text + load(R"("0.1 m", "2.3 m")", force));
    };
    const Results stands = pulled(R"("0 kN/m", "-1 kN/m")"),
                  falls = pulled(R"("0 kN/m", "-30 MN/m")");
    REQUIRE(stands.json.at("stages").size() == 2);
    CHECK_FALSE(stands.json.at("loads")[0].at("came_off").get<bool>());
    CHECK(falls.json.at("loads")[0].at("came_off").get<bool>());
    CHECK(falls.outcome.status != 0);
    CHECK(falls.outcome.out.find("load     (0, -3e+04) kN/m at (0.1, 2.3) m, on block ") !=
          std::string::npos);
    CHECK(stands.files.at("blocks.svg").find("Load: (0, -1) kN/m at") != std::string::npos);
    // Drawn where the block stands, not where it was when it has come off.
    CHECK(stands.files.at("blocks.svg").find("<g id=\"loads\"") != std::string::npos);
    CHECK(stands.files.at("blocks.svg").find("load, 1.00 kN/m") != std::string::npos);
    CHECK(falls.files.at("blocks.svg").find("<g id=\"loads\"") == std::string::npos);
    CHECK(stands.files.at("report.html").find("Load on a block: (0, -1) kN/m at") !=
          std::string::npos);
  }

  TEST_CASE("a ground reaction, and single blocks, are without loads, and say so") {
    // A load of the second stage would otherwise come on in the second step of the bare rock.
    const std::string text = CircleInRock{}.text() + in_turn;
    const std::string loaded =
        text + load(R"("0.1 m", "2.3 m")", R"("0 kN/m", "-300 kN/m")", "stage = \"load\"\n");
    for (const std::string verb : {"grc", "blocks"}) {
      CAPTURE(verb);
      const Folder folder;
      const auto printed = [&](const std::string& input) {
        const Outcome outcome =
            run_program({verb, write_file(folder / "case.toml", input), "--out", folder / "out"});
        CHECK(outcome.status == 0);
        return outcome.out;
      };
      const std::string said = printed(loaded);
      const std::size_t at = said.find("warning  [[load]] is left out");
      REQUIRE(at != std::string::npos);
      CHECK(said.substr(0, at) + said.substr(said.find('\n', at) + 1) == printed(text));
    }
  }

  TEST_CASE("a bolt across joints that slip carries the load by its dowels, as its law says") {
    // A block of 2 m x 1 m in the wall of a square tunnel, on joints without friction; the joint
    // behind it opens. All that holds it against a pull of 500 kN/m is a bolt through its middle:
    //   F = sum of K_s s + T s / l,  T = K_a (l - l0),  l^2 = l0^2 + s^2 between anchors
    const double pull = 500e3, shear_stiffness = 50e6, axial_stiffness = 1e6, apart = 2 * 0.0336;
    const std::string none = R"("0 N/m", "0 N/m")";
    const std::string text =
        "[model]\nwidth = \"20 m\"\nbelow_invert = \"8 m\"\n[tunnel]\nshape = \"polygon\"\n"
        "vertices = [[\"-2 m\", \"-2 m\"], [\"2 m\", \"-2 m\"], [\"2 m\", \"2 m\"], [\"-2 m\", \"2 "
        "m\"]]\ncover = \"8 m\"\n[rock]\ndensity = \"2700 kg/m^3\"\n[stress]\nK0 = 0.5\n[joint]\n"
        "kn = \"5 GPa/m\"\nks = \"5 GPa/m\"\nfriction = \"30 deg\"\n[[joint_set]]\nlaw = "
        "\"coulomb\"\nkn = \"5 GPa/m\"\nks = \"5 GPa/m\"\nfriction = \"0 deg\"\n[[joint_set]]\n"
        "[joints]\nfile = \"traces.csv\"\nfirst_set = 0\n[blocks]\nmin_inscribed_radius = \"0.2 "
        "m\"\n[boundary]\nsides = \"rollers\"\nbase = \"rollers\"\n[support.bolts]\nbars = "
        "[[[\"3 m\", \"1.5 m\"], [\"3 m\", \"-1.5 m\"]]]\nstiffness = \"1 MN/m\"\nlaw = "
        "\"axial-shear\"\nshear_stiffness = \"50 MN/m\"\n[[stage]]\nname = \"excavation\"\n"
        "wall_traction = 0\ninstall = [\"bolts\"]\n[[stage]]\nname = \"load\"\nwall_traction = 0\n" +
        load(R"("3 m", "0.01 m")", R"("-500 kN/m", "0 kN/m")") +
        // Nothing acts at these: they tell how the joints have slipped.
        load(R"("3 m", "0.499 m")", none) + load(R"("3 m", "0.501 m")", none) +
        load(R"("3 m", "-0.499 m")", none) + load(R"("3 m", "-0.501 m")", none) + exact;
    const Results r = results_of(text, {},
                                 {{"traces.csv",
                                   "1.5,0.5,4,0.5,0\n1.5,-0.5,4,-0.5,0\n"
                                   "4,-0.5,4,0.5,1\n"}});
    REQUIRE(r.outcome.status == 0);
    std::vector<double> axial;  // of the two crossings
    std::istringstream rows(r.files.at("bolts.csv"));
    for (std::string line; std::getline(rows, line);)
      if (const auto cells = csv_fields(line); cells.front() == "1")
        axial.push_back(1e3 * std::stod(cells.at(6)));
    REQUIRE(axial.size() == 2);
    double borne = 0;
    for (const std::size_t upper : {std::size_t{0}, std::size_t{1}}) {
      const double slip = (moved(r, 2 + 2 * upper) - moved(r, 1 + 2 * upper)).x(),
                   length = std::hypot(apart, slip);
      CAPTURE(slip);
      CHECK(slip > 3e-3);
      CHECK(axial[upper] == near(axial_stiffness * (length - apart)).epsilon(0.03));
      borne += shear_stiffness * slip + axial[upper] * slip / length;
    }
    CHECK(borne == near(pull).epsilon(1e-4));
  }

  TEST_CASE("what cannot be loaded is refused with place and remedy before anything is computed") {
    const std::string at = R"("1.3 m", "4.1 m")", force = R"("0 kN/m", "-1 kN/m")";
    const std::string text = CircleInRock{}.text(),
                      spatial = replaced(text, "[model]\n", "[model]\ndimension = 3\n");
    const std::string rounds =
        "[[round]]\nname = \"heading\"\nabove = \"0 m\"\n[[round]]\nname = \"bench\"\nbelow = "
        "\"0 m\"\n";
    struct Fault {
      std::string text;
      std::vector<std::string> named;
    };
    const std::vector<Fault> faults = {
        {text + load(R"("11 m", "4 m")", force),
         {"load[0].at", "outside the rock", "(-10, -10) and (10, 10) m"}},
        {text + load(R"("0 m", "1 m")", force), {"load[0].at", "in an opening", "rock that stays"}},
        {text + load(R"("1 m")", force), {"load[0].at", "two lengths"}},
        {text + load(R"("1 m", "nan m")", force), {"load[0].at"}},
        {text + load(at, R"("0 kN", "-1 kN")"), {"load[0].force[0]", "not a force per metre"}},
        {text + load(at, R"("0 kN/m", "-1e10 kN/m")"), {"load[0].force[1]", "up to 1e12 N"}},
        {text + "[[load]]\nat = [" + at + "]\n", {"load[0].force is missing, and so is moment"}},
        {text + load(at, force, "block = 2\n"), {"load[0].block", "blocks that are laid"}},
        {text + load(at, force, "kind = \"dead\"\n"), {"load[0].kind", "blocks that are laid"}},
        {text + load(at, force, "stage = \"load\"\n"), {"load[0].stage", "the file has none"}},
        {text + in_turn + load(at, force, "stage = \"lod\"\n"),
         {"load[0].stage", "\"excavation\", \"load\""}},
        {text + rounds + load(at, force, "stage = \"heading\"\n"),
         {"load[0].stage", "\"bench\" excavates after \"heading\"", "after the last excavation"}},
        // Rock of the bench, which is taken out.
        {text + rounds + load(R"("0 m", "-1 m")", force), {"load[0].at", "in an opening"}},
        {spatial + load(at, R"("0 kN", "0 kN", "-1 kN")"), {"load[0].place"}},
        {spatial + load(at, R"("0 kN", "0 kN", "-1 kN")", "place = \"3 m\"\n"),
         {"load[0].at", "outside the rock"}},
        {spatial + load(at, force, "place = \"1 m\"\n"), {"load[0].force", "three forces"}},
    };
    for (const Fault& fault : faults) {
      const Folder folder;
      const std::string file = write_file(folder / "case.toml", fault.text);
      const Outcome outcome = run_program({"run", file, "--out", folder / "out"});
      CAPTURE(fault.text.substr(text.size()));
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(!std::filesystem::exists(folder / "out"));
      for (const std::string& words : fault.named) {
        CAPTURE(words);
        CHECK(outcome.err.find(words) != std::string::npos);
      }
    }
  }
}

}  // namespace rock_loads_test
