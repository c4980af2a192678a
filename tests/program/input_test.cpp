// SPDX-License-Identifier: MIT
#include "input.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <regex>
#include <string>
#include <vector>
#include <voussoir/design/size_estimate.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>

#include "plausibility.hpp"
#include "support/near.hpp"

namespace program_input_test {

using namespace voussoir::program;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double degrees(double angle) { return angle * std::numbers::pi / 180; }

// A file with every table; the lines are numbered because the messages below name them.
const std::string good =
    /*  1 */
    "title = \"Prüfung\"\n"
    /*  2 */
    "[model]\n"
    /*  3 */
    "width = \"70 m\"\n"
    /*  4 */
    "below_invert = \"30 m\"\n"
    /*  5 */
    "[tunnel]\n"
    /*  6 */
    "shape = \"circle\"\n"
    /*  7 */
    "diameter = \"10 m\"\n"
    /*  8 */
    "cover = \"20 m\"\n"
    /*  9 */
    "[rock]\n"
    /* 10 */
    "density = \"2700 kg/m^3\"\n"
    /* 11 */
    "[stress]\n"
    /* 12 */
    "K0 = 1\n"
    /* 13 */
    "[[joint_set]]\n"
    /* 14 */
    "dip = \"75 deg\"\n"
    /* 15 */
    "dip_direction = \"E\"\n"
    /* 16 */
    "intensity = \"1 /m^2\"\n"
    /* 17 */
    "extent = \"1 m\"\n"
    /* 18 */
    "[joint]\n"
    /* 19 */
    "kn = \"5 GPa/m\"\n"
    /* 20 */
    "ks = \"0.5 GPa/m\"\n"
    /* 21 */
    "friction = \"35 deg\"\n"
    /* 22 */
    "[blocks]\n"
    /* 23 */
    "min_inscribed_radius = \"0.25 m\"\n"
    /* 24 */
    "[support.bolts]\n"
    /* 25 */
    "length = \"4 m\"\n"
    /* 26 */
    "spacing = \"15 deg\"\n"
    /* 27 */
    "stiffness = \"0.2 GN/m\"\n"
    /* 28 */
    "[support.lining]\n"
    /* 29 */
    "thickness = \"10 cm\"\n"
    /* 30 */
    "E = \"25 GPa\"\n"
    /* 31 */
    "interface = { kn = \"1 GPa/m\", friction = \"30 deg\" }\n"
    /* 32 */
    "[[stage]]\n"
    /* 33 */
    "wall_traction = \"40 %\"\n"
    /* 34 */
    "install = [\"bolts\"]\n"
    /* 35 */
    "[[stage]]\n"
    /* 36 */
    "wall_traction = \"0 %\"\n"
    /* 37 */
    "install = [\"lining\"]\n"
    /* 38 */
    "[run]\n"
    /* 39 */
    "method = \"two-level\"\n"
    /* 40 */
    "[diagram]\n"
    /* 41 */
    "spacing = [\"9 deg\", \"none\"]\n"
    /* 42 */ "thickness = [\"0 cm\", \"10 cm\"]\n";

Input read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_input_text(text, "test.toml", "/site", overrides);
}

/// The errors of a text that is not accepted; none if it is.
std::vector<InputError> errors_of(const std::string& text,
                                  const std::vector<std::string>& overrides = {}) {
  try {
    (void)read(text, overrides);
  } catch (const InputErrors& errors) {
    return errors.errors();
  }
  return {};
}

/// `good` with its one occurrence of `from` replaced; every test that changes nothing would lie.
std::string with(const std::string& from, const std::string& to) {
  std::string text = good;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  REQUIRE(text.find(from, at + 1) == std::string::npos);
  return text.replace(at, from.size(), to);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string all(const std::vector<InputError>& errors) {
  std::string text;
  for (const InputError& error : errors) text += error.text();
  return text;
}

struct Bad {
  std::string from, to;
  int line;  ///< that the message names; 0: none
  std::string message;
  std::string accepted;
};

/// Each gives exactly one error, that one.
void check_refused(const std::vector<Bad>& cases) {
  for (const Bad& bad : cases) {
    CAPTURE(bad.from);
    CAPTURE(bad.to);
    const std::vector<InputError> errors = errors_of(with(bad.from, bad.to));
    const std::string shown = all(errors);
    CAPTURE(shown);
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].file == "test.toml");
    CHECK(errors[0].line == bad.line);
    CHECK(contains(errors[0].message, bad.message));
    CHECK(contains(errors[0].accepted, bad.accepted));
  }
}

}  // namespace

TEST_SUITE("program/input") {
  TEST_CASE("the design case of the paper reads to its numbers in SI") {
    const std::filesystem::path file =
        std::filesystem::path(VOUSSOIR_TEST_EXAMPLES) / "paper" / "tunnel.toml";
    const Input input = read_input(file);
    CHECK(contains(input.title, "Boon"));
    CHECK(input.model.width == 70);
    CHECK(input.model.below_invert == 30);
    CHECK(input.model.seed == 1);
    CHECK(input.model.gravity == 9.81);
    CHECK(input.model.origin == Point{0, 0});
    CHECK(input.tunnel.shape == TunnelShape::circle);
    CHECK(input.tunnel.diameter == 10);
    CHECK(input.tunnel.cover == 20);
    CHECK(input.tunnel.facets == 72);
    CHECK(input.domain_top() == 25);
    CHECK(input.domain_bottom() == -35);
    CHECK(input.rock.density == 2700);
    // The paper prints 662 kPa at the centre.
    CHECK(std::lround(input.rock.density * input.model.gravity * input.domain_top() / 1000) == 662);
    CHECK(input.stress.K0 == 1);
    CHECK(input.stress.surcharge == 0);

    REQUIRE(input.joint_sets.size() == 3);
    const double dips[] = {75, 25, 25};
    for (std::size_t i = 0; i < 3; ++i) {
      const JointSetInput& set = input.joint_sets[i];
      CHECK(set.plane.dip == degrees(dips[i]));
      CHECK(set.plane.dip_direction == degrees(i < 2 ? 90 : 270));
      CHECK(set.sd == degrees(1));
      CHECK(set.intensity == 1.0);
      CHECK_FALSE(set.spacing.has_value());
      CHECK(set.extent == 1);
    }
    CHECK(input.joint_sets[2].name == "J3");
    CHECK(input.joints_file.empty());
    CHECK(input.joint_law.at("kn") == 5e9);
    CHECK(input.joint_law.at("ks") == 5e8);
    CHECK(input.joint_law.at("friction") == degrees(35));
    CHECK(input.blocks.min_inscribed_radius == 0.25);
    CHECK(input.blocks.max_elongation == 5);
    CHECK(input.blocks.min_wall_area == 0.074);

    REQUIRE(input.bolts.size() == 1);
    const BoltsInput& bolts = input.bolts.front();
    CHECK(bolts.length == 4);
    CHECK(bolts.spacing.is_angle);
    CHECK(bolts.spacing.value == degrees(15));
    CHECK(bolts.arc.from == 0);
    CHECK(bolts.arc.to == degrees(180));
    CHECK(bolts.out_of_plane == 1);
    CHECK(bolts.diameter == 0.028);
    CHECK(bolts.stiffness == 2e8);
    CHECK(bolts.pretension == 0);
    CHECK_FALSE(bolts.yield_force.has_value());
    CHECK(bolts.rupture_force == 5e5);
    CHECK(bolts.anchors == AnchorKind::lorig);
    CHECK(bolts.anchor_offset == voussoir_test::near(0.0336));
    CHECK(bolts.law == BoltKind::axial);

    REQUIRE(input.linings.size() == 1);
    const LiningInput& lining = input.linings.front();
    CHECK(lining.thickness == 0.1);
    CHECK(lining.young_modulus == 25e9);
    CHECK(lining.poisson_ratio == 0.2);
    CHECK(lining.beam == voussoir::LiningElement::euler_bernoulli);
    CHECK(lining.interface_normal_stiffness == 1e9);
    CHECK(lining.interface_shear_stiffness == 1e9);
    CHECK(lining.interface_friction_angle == degrees(30));
    CHECK_FALSE(lining.nodes.has_value());
    CHECK_FALSE(lining.feet.has_value());
    CHECK_FALSE(lining.arc.has_value());

    REQUIRE(input.stages.size() == 1);
    CHECK(input.stages[0].name == "excavation and support");
    CHECK(input.stages[0].wall_traction == 0);
    CHECK(input.stages[0].bolts.size() == 1);
    CHECK(input.stages[0].linings.size() == 1);
    CHECK(input.run.method == MethodKind::two_level);
    CHECK(input.run.tolerance == 1e-3);
    CHECK(input.run.displacement_limit == voussoir::Acceptance{}.displacement_limit);
    CHECK(input.run.contact_update_limit == voussoir::Acceptance{}.contact_update_limit);

    REQUIRE(input.diagram.has_value());
    const double spacings[] = {9, 11.25, 15, 18, 22.5};
    REQUIRE(input.diagram->spacing.size() == 6);
    for (std::size_t i = 0; i < 5; ++i) {
      REQUIRE(input.diagram->spacing[i].has_value());
      CHECK(input.diagram->spacing[i]->is_angle);
      CHECK(input.diagram->spacing[i]->value == degrees(spacings[i]));
    }
    CHECK_FALSE(input.diagram->spacing[5].has_value());
    CHECK(input.diagram->thickness == std::vector<double>{0, 0.05, 0.1, 0.15, 0.2, 0.3});

    const SizeEstimate size = estimate_size(input);
    CHECK(size.joints == 12600);  // 3 sets x 1 /m^2 x 70 m x 60 m
    // Generated masses of this case hold about 5 800 blocks.
    CHECK(size.blocks > 4000);
    CHECK(size.blocks < 12000);
  }

  TEST_CASE("what is left out has its default") {
    const Input input = read(good);
    CHECK(input.title == "Prüfung");
    CHECK(input.model.seed == 1);
    CHECK(input.joint_sets.at(0).name == "set 1");
    CHECK(input.joint_sets.at(0).sd == 0);
    CHECK(input.joint_sets.at(0).extent == 1);
    CHECK(input.blocks.max_elongation == infinity);
    CHECK(input.bolts.at(0).arc.to == degrees(180));
    CHECK_FALSE(input.bolts.at(0).rupture_force.has_value());
    CHECK_FALSE(input.linings.at(0).nodes.has_value());
    REQUIRE(input.stages.size() == 2);
    CHECK(input.stages[0].name == "stage 1");
    CHECK(input.stages[0].wall_traction == 0.4);
    CHECK(input.stages[0].bolts.size() == 1);
    CHECK(input.stages[0].linings.empty());
    CHECK(input.stages[1].linings.size() == 1);
    CHECK_FALSE(input.run.max_steps.has_value());
  }

  TEST_CASE("every optional key arrives where it belongs") {
    CHECK(read(good, {"model.seed=7", "model.gravity=1.62 m/s^2"}).model.seed == 7);
    CHECK(read(good, {"model.gravity=1.62 m/s^2"}).model.gravity == 1.62);
    CHECK(read(good, {R"(model.origin=["1000000 m", "-2.5 m"])"}).model.origin == Point{1e6, -2.5});
    CHECK(read(good, {"stress.surcharge=20 kPa"}).stress.surcharge == 20e3);
    CHECK(read(good, {"blocks.min_wall_area=100 cm^2"}).blocks.min_wall_area == 0.01);
    const Input sets = read(good, {"joint_set[0].name=bedding", "joint_set[0].sd=2 deg",
                                   "joint_set[1].dip=10 deg", "joint_set[1].dip_direction=W",
                                   "joint_set[1].spacing=2 m", "joint_set[1].extent=inf"});
    CHECK(sets.joint_sets.at(0).name == "bedding");
    CHECK(sets.joint_sets.at(0).sd == degrees(2));
    CHECK(sets.joint_sets.at(1).extent == infinity);
    CHECK(read(with("intensity = \"1 /m^2\"", "spacing = \"1.2 m\"")).joint_sets.at(0).spacing ==
          1.2);
    const BoltsInput bolts =
        read(good, {"support.bolts.spacing=1.3 m", "support.bolts.arc=[\"-180 deg\", \"180 deg\"]",
                    "support.bolts.out_of_plane=1.5 m", "support.bolts.diameter=25 mm",
                    "support.bolts.pretension=50 kN", "support.bolts.yield_force=200 kN",
                    "support.bolts.rupture_force=300 kN", "support.bolts.anchor_offset=4 cm",
                    "support.bolts.law=axial-shear", "support.bolts.shear_stiffness=20 MN/m"})
            .bolts.at(0);
    CHECK_FALSE(bolts.spacing.is_angle);
    CHECK(bolts.spacing.value == 1.3);
    CHECK(bolts.arc.from == degrees(-180));
    CHECK(bolts.out_of_plane == 1.5);
    CHECK(bolts.diameter == 0.025);
    CHECK(bolts.pretension == 5e4);
    CHECK(bolts.yield_force == 2e5);
    CHECK(bolts.rupture_force == 3e5);
    CHECK(bolts.anchor_offset == 0.04);
    CHECK(bolts.law == BoltKind::axial_shear);
    CHECK(bolts.shear_stiffness == 2e7);
    CHECK(read(good, {"support.bolts.anchors=garga-wang"}).bolts.at(0).anchors ==
          AnchorKind::garga_wang);
    CHECK(read(good, {"support.bolts.anchors=joint-face"}).bolts.at(0).anchors ==
          AnchorKind::joint_face);
    const LiningInput lining =
        read(good, {"support.lining.nu=0.25", "support.lining.beam=timoshenko",
                    "support.lining.nodes=90", "support.lining.interface.ks=0.3 GPa/m",
                    "support.lining.arc=[\"-30 deg\", \"210 deg\"]",
                    "support.lining.interface.shear_bond=0.8 MPa",
                    "support.lining.interface.tensile_bond=0.5 MPa",
                    "support.lining.feet.stiffness=2 GPa/m", "support.lining.feet.strength=5 MPa"})
            .linings.at(0);
    const FeetInput feet = lining.feet.value();
    CHECK(lining.shear_bond == 0.8e6);
    CHECK(lining.tensile_bond == 0.5e6);
    CHECK(feet.width == lining.thickness);
    CHECK(feet.stiffness == 2e9);
    CHECK(feet.strength.value() == 5e6);
    CHECK(feet.friction_angle == lining.interface_friction_angle);
    CHECK(feet.on_beam().settlement == 1);
    const FeetInput on_beam =
        read(
            good,
            {"support.lining.arc=[\"-30 deg\", \"210 deg\"]",
             "support.lining.feet.stiffness=2 GPa/m",
             "support.lining.feet.beam={ depth = \"40 cm\", E = \"25 GPa\", spacing = \"1.5 m\" }"})
            .linings.at(0)
            .feet.value();
    CHECK(on_beam.beam.value().depth == 0.4);
    CHECK(on_beam.beam.value().modulus == 25e9);
    CHECK(on_beam.beam.value().spacing == 1.5);
    CHECK(on_beam.on_beam().settlement == voussoir::feet_on_beam(2e9, {0.4, 25e9, 1.5}).settlement);
    // The arc in words, on a circle and on a horseshoe with floor corners at -atan(3/5).
    const std::vector<std::string> horseshoe = {"tunnel.shape=horseshoe", "tunnel.width=5 m",
                                                "tunnel.wall_height=1.5 m",
                                                "support.lining.feet.stiffness=2 GPa/m"};
    const auto arc_of = [&](const std::string& word, bool on_horseshoe) {
      std::vector<std::string> keys{"support.lining.arc=" + word};
      std::string text = good;
      if (on_horseshoe) {
        keys.insert(keys.end(), horseshoe.begin(), horseshoe.end());
        text = std::regex_replace(text, std::regex("diameter = [^\n]*\n"), "");
      }
      return read(text, keys).linings.at(0).arc.value();
    };
    CHECK(arc_of("roof", false).from == voussoir_test::near(0).scale(1));
    CHECK(arc_of("roof", true).to == voussoir_test::near(degrees(180)));
    CHECK(arc_of("roof and walls", false).from == voussoir_test::near(degrees(-45)));
    CHECK(arc_of("roof and walls", true).from == voussoir_test::near(-std::atan(0.6)));
    CHECK(arc_of("roof and walls", true).to == voussoir_test::near(degrees(180) + std::atan(0.6)));
    CHECK_FALSE(read(good, {"support.lining.arc=all"}).linings.at(0).arc.has_value());
    for (const char* arc : {"[\"-33 deg\", \"210 deg\"]", "[\"-30 deg\", \"213 deg\"]"}) {
      std::vector<std::string> keys = horseshoe;
      keys.push_back(std::string("support.lining.arc=") + arc);
      const auto errors =
          errors_of(std::regex_replace(good, std::regex("diameter = [^\n]*\n"), ""), keys);
      const std::string shown = all(errors);
      CAPTURE(shown);
      REQUIRE(errors.size() == 1);
      CHECK(errors[0].key == "support.lining.arc");
      CHECK(contains(errors[0].message, "on the flat floor between its corners at"));
      CHECK(contains(errors[0].accepted, "within 0.5 deg"));
    }
    CHECK(lining.poisson_ratio == 0.25);
    CHECK(lining.beam == voussoir::LiningElement::timoshenko);
    CHECK(lining.nodes == 90);
    CHECK(lining.interface_shear_stiffness == 0.3e9);
    CHECK(lining.interface_normal_stiffness == 1e9);
    CHECK(lining.arc.value().to == degrees(210));
    const RunInput run =
        read(good, {"run.method=explicit", "run.damping=0.5", "run.ramp_steps=0",
                    "run.max_steps=100000", "run.tolerance=1e-4", "run.displacement_limit=10 cm",
                    "run.contact_update_limit=5 mm"})
            .run;
    CHECK(run.method == MethodKind::explicit_);
    CHECK(run.damping == 0.5);
    CHECK(run.ramp_steps == 0);
    CHECK(run.linear_solver == voussoir::LinearMethod::automatic);
    CHECK(read(good, {"run.linear_solver=iterative"}).run.linear_solver ==
          voussoir::LinearMethod::iterative);
    CHECK(run.max_steps == 100000);
    CHECK(run.tolerance == 1e-4);
    CHECK(run.displacement_limit == 0.1);
    CHECK(run.contact_update_limit == 0.005);
    CHECK(read(good, {"run.method=relaxation"}).run.method == MethodKind::relaxation);
    CHECK(read(good, {"stage[0].name=top heading"}).stages.at(0).name == "top heading");
    const DiagramInput diagram =
        read(good, {R"(diagram.spacing=["1 m", "1.5 m"])"}).diagram.value();
    CHECK_FALSE(diagram.spacing.at(1).value().is_angle);
    CHECK(diagram.spacing.at(1).value().value == 1.5);
  }

  TEST_CASE("the file of joints is looked for beside the input file") {
    CHECK(read(with("[joint]\n", "[joints]\nfile = \"traces.csv\"\n[joint]\n")).joints_file ==
          std::filesystem::path("/site/traces.csv"));
    CHECK(read(with("[joint]\n", "[joints]\nfile = \"/data/Klüfte.csv\"\n[joint]\n")).joints_file ==
          std::filesystem::path(u8"/data/Klüfte.csv"));
  }

  TEST_CASE("a horseshoe and a polygon have their extents; a clockwise polygon is turned round") {
    const Input horseshoe =
        read(with("shape = \"circle\"\ndiameter = \"10 m\"",
                  "shape = \"horseshoe\"\nwidth = \"8 m\"\nwall_height = \"3 m\""));
    CHECK(horseshoe.tunnel.half_width() == 4);
    CHECK(horseshoe.tunnel.crown() == 4);
    CHECK(horseshoe.tunnel.invert() == -3);
    CHECK(horseshoe.domain_top() == 24);
    CHECK(horseshoe.domain_bottom() == -33);

    const std::string clockwise =
        R"(vertices = [["-2 m", "-2 m"], ["-2 m", "2 m"], ["0 m", "4 m"], ["2 m", "2 m"], ["2 m", "-2 m"]])";
    const Input polygon =
        read(with("shape = \"circle\"\ndiameter = \"10 m\"", "shape = \"polygon\"\n" + clockwise));
    CHECK(polygon.tunnel.vertices ==
          std::vector<Point>{{2, -2}, {2, 2}, {0, 4}, {-2, 2}, {-2, -2}});
    CHECK(polygon.tunnel.half_width() == 2);
    CHECK(polygon.tunnel.crown() == 4);
    CHECK(polygon.tunnel.invert() == -2);
  }

  TEST_CASE("a value of the wrong form or range is refused with its line and what is accepted") {
    check_refused({
        {"title = \"Prüfung\"", "title = 5", 1, "title = 5 is a bare number, not a text", "a text"},
        {"title = \"Prüfung\"", "schema = 2", 1, "schema = 2 is outside", "a whole number, 1"},
        {"width = \"70 m\"", "width = 70", 3, "model.width = 70 has no unit", "above 0; a length"},
        {"width = \"70 m\"", "width = \"70\"", 3, "model.width = \"70\" has no unit", "\"4 m\""},
        {"width = \"70 m\"", "width = \"70 kg\"", 3, "is a mass, not a length", "a length"},
        {"width = \"70 m\"", "width = \"-70 m\"", 3, "outside the accepted range", "above 0"},
        {"width = \"70 m\"", "width = \"0 m\"", 3, "outside the accepted range", "above 0"},
        {"width = \"70 m\"", "width = nan", 3, "model.width = nan is not finite", "a length"},
        {"width = \"70 m\"", "width = inf", 3, "is not finite", "a length"},
        {"width = \"70 m\"", "width = \"nan m\"", 3, "is not a number", "a length"},
        {"width = \"70 m\"", "width = \"inf m\"", 3, "is not finite", "a length"},
        {"width = \"70 m\"", "width = true", 3, "is true or false", "a length"},
        {"width = \"70 m\"", "width = 2015-01-01", 3, "is a date", "a length"},
        {"width = \"70 m\"", "width = [\"70 m\"]", 3, "is a list", "a length"},
        {"width = \"70 m\"", "width.m = 70", 3, "model.width is a table", "a length"},
        {"width = \"70 m\"", "width = \"70 m\"\nseed = -1", 4, "model.seed = -1", "0 or more"},
        {"width = \"70 m\"", "width = \"70 m\"\nseed = 1.5", 4, "is not a whole number",
         "0 or more"},
        {"width = \"70 m\"", "width = \"70 m\"\nseed = \"1\"", 4, "is a text", "a whole number"},
        {"width = \"70 m\"", "width = \"70 m\"\ngravity = \"0 m/s^2\"", 4, "model.gravity",
         "from 1 m/s^2 to 1000 m/s^2"},
        {"width = \"70 m\"", "width = \"70 m\"\norigin = [\"1 m\"]", 4, "has 1 entry",
         "two lengths"},
        {"width = \"70 m\"", "width = \"70 m\"\norigin = [\"1 m\", 2]", 4, "model.origin[1] = 2",
         "a length"},
        {"shape = \"circle\"", "shape = \"cirlce\"", 6, "did you mean \"circle\"?",
         "\"horseshoe\""},
        {"cover = \"20 m\"", "cover = \"0 m\"", 8, "tunnel.cover", "above 0"},
        {"cover = \"20 m\"", "cover = \"20 m\"\nfacets = 11", 9, "tunnel.facets", "from 12 to 720"},
        {"cover = \"20 m\"", "cover = \"20 m\"\nfacets = 721", 9, "tunnel.facets",
         "from 12 to 720"},
        {"density = \"2700 kg/m^3\"", "density = \"2700 kg\"", 10, "is a mass, not a density",
         "2700 kg/m^3"},
        {"density = \"2700 kg/m^3\"", "density = \"0.9 kg/m^3\"", 10, "rock.density",
         "from 1 kg/m^3 to 100000 kg/m^3"},
        {"K0 = 1", "K0 = -0.1", 12, "stress.K0 = -0.1 is outside", "a bare number from 0 to 10"},
        {"K0 = 1", "K0 = 10.5", 12, "stress.K0", "from 0 to 10"},
        {"K0 = 1", "K0 = \"1\"", 12, "is a text, not a bare number", "without quotes"},
        {"K0 = 1", "K0 = nan", 12, "is not finite", "a bare number"},
        {"K0 = 1", "K0 = 1\nsurcharge = \"-1 kPa\"", 13, "stress.surcharge", "from 0 to 1 GPa"},
        {"K0 = 1", "K0 = 1\nsurcharge = \"1e300 Pa\"", 13, "stress.surcharge", "from 0 to 1 GPa"},
        {"dip = \"75 deg\"", "dip = \"91 deg\"", 14, "joint_set[0].dip", "from 0 to 90 deg"},
        {"dip = \"75 deg\"", "dip = 75", 14, "joint_set[0].dip = 75 has no unit", "35 deg"},
        {"dip_direction = \"E\"", "dip_direction = \"up\"", 15, "joint_set[0].dip_direction",
         "an azimuth"},
        {"intensity = \"1 /m^2\"", "intensity = \"0 /m^2\"", 16, "joint_set[0].intensity",
         "above 0 and at most"},
        {"intensity = \"1 /m^2\"", "intensity = \"1e5 /m^2\"", 16, "joint_set[0].intensity",
         "10000 /m^2"},
        {"intensity = \"1 /m^2\"", "intensity = \"1 /m\"", 16, "is an area per volume, not a",
         "a number per area"},
        {"intensity = \"1 /m^2\"", "spacing = \"0 m\"", 16, "joint_set[0].spacing", "above 0"},
        {"extent = \"1 m\"", "extent = \"0 m\"", 17, "extent", "or \"inf\""},
        {"extent = \"1 m\"", "extent = \"-inf\"", 17, "extent", "inf"},
        {"intensity = \"1 /m^2\"", "intensity = \"1 /m^2\"\nsd = \"46 deg\"", 17, "sd", "45 deg"},
        {"kn = \"5 GPa/m\"", "kn = 5e9", 19, "joint.kn = 5e9 has no unit", "\"5 GPa/m\""},
        {"kn = \"5 GPa/m\"", "kn = \"5 GPA/m\"", 19, "unknown unit `GPA`, did you mean `GPa`?",
         "\"5 GPa/m\""},
        {"kn = \"5 GPa/m\"", "kn = \"5 GPa\"", 19, "is a stress, not a stiffness per area",
         "GPa/m"},
        {"ks = \"0.5 GPa/m\"", "ks = \"0 GPa/m\"", 20, "joint.ks", "from 1 kPa/m to 1000 GPa/m"},
        {"ks = \"0.5 GPa/m\"", "ks = \"1e300 Pa/m\"", 20, "joint.ks", "from 1 kPa/m to 1000 GPa/m"},
        {"intensity = \"1 /m^2\"", "intensity = \"1 /m^2\"\nkn = \"0.9 kPa/m\"", 17,
         "joint_set[0].kn", "from 1 kPa/m"},
        {"friction = \"35 deg\"", "friction = \"90 deg\"", 21, "joint.friction",
         "from 0 to below 90 deg"},
        {"friction = \"35 deg\"", "friction = \"35 %\"", 21, "is a fraction, not an angle", "deg"},
        {"min_inscribed_radius = \"0.25 m\"", "min_inscribed_radius = \"0 m\"", 23, "blocks.min",
         "above 0"},
        {"[blocks]\n", "[blocks]\nmax_elongation = 1.5\n", 23, "max_elongation", "2 or more"},
        {"[blocks]\n", "[blocks]\nmin_wall_area = \"-1 m^2\"\n", 23, "min_wall_area", "0 or more"},
        {"spacing = \"15 deg\"", "spacing = 15", 26, "support.bolts.spacing = 15 has no unit",
         "\"1.3 m\""},
        {"spacing = \"15 deg\"", "spacing = \"15 kN\"", 26, "is neither an angle nor a length",
         "\"15 deg\""},
        {"spacing = \"15 deg\"", "spacing = \"0.05 deg\"", 26, "outside the accepted range",
         "from 0.1 deg"},
        {"spacing = \"15 deg\"", "spacing = \"15 degs\"", 26, "unknown unit `degs`", "\"15 deg\""},
        {"length = \"4 m\"", "length = \"4 m\"\narc = [\"180 deg\", \"0 deg\"]", 26,
         "does not rise", "two angles"},
        {"length = \"4 m\"", "length = \"4 m\"\narc = [\"-90 deg\", \"300 deg\"]", 26,
         "spans more than 360 deg", "at most 360 deg apart"},
        {"length = \"4 m\"", "length = \"4 m\"\narc = [\"0 deg\", \"361 deg\"]", 26,
         "support.bolts.arc[1] = \"361 deg\"", "360 deg"},
        {"length = \"4 m\"", "length = \"4 m\"\nout_of_plane = \"0 m\"", 26, "out_of_plane",
         "from 10 mm to 1000 m"},
        {"length = \"4 m\"", "length = \"4 m\"\ndiameter = \"0 mm\"", 26, "diameter", "above 0"},
        {"length = \"4 m\"", "length = \"4 m\"\npretension = \"-1 kN\"", 26, "pretension",
         "from 0 to 1 GN"},
        {"length = \"4 m\"", "length = \"4 m\"\nyield_force = \"0 kN\"", 26, "yield_force",
         "above 0 and at most 1 GN"},
        {"length = \"4 m\"", "length = \"4 m\"\nrupture_force = \"0 kN\"", 26, "rupture_force",
         "above 0 and at most 1 GN"},
        {"length = \"4 m\"", "length = \"4 m\"\nanchors = \"lorigs\"", 26,
         "did you mean \"lorig\"?", "\"garga-wang\""},
        {"length = \"4 m\"", "length = \"4 m\"\nlaw = \"shear\"", 26, "support.bolts.law",
         "\"axial-shear\""},
        {"length = \"4 m\"", "length = \"4 m\"\nanchor_offset = \"0 m\"", 26, "anchor_offset",
         "above 0"},
        {"stiffness = \"0.2 GN/m\"", "stiffness = \"0 GN/m\"", 27, "support.bolts.stiffness",
         "from 1 kN/m to 1000 GN/m"},
        {"stiffness = \"0.2 GN/m\"", "stiffness = \"1e300 N/m\"", 27, "support.bolts.stiffness",
         "from 1 kN/m to 1000 GN/m"},
        {"thickness = \"10 cm\"", "thickness = \"0 cm\"", 29, "support.lining.thickness",
         "from 1 mm to 10 m"},
        {"E = \"25 GPa\"", "E = \"25 GN\"", 30, "is a force, not a stress", "25 GPa"},
        {"E = \"25 GPa\"", "E = \"1e-300 Pa\"", 30, "support.lining.E", "from 1 MPa to 1000 GPa"},
        {"kn = \"1 GPa/m\"", "kn = \"1e300 Pa/m\"", 31, "support.lining.interface.kn",
         "from 1 kPa/m to 1000 GPa/m"},
        {"E = \"25 GPa\"", "E = \"25 GPa\"\nnu = 0.5", 31, "support.lining.nu",
         "above -1 and below 0.5"},
        {"E = \"25 GPa\"", "E = \"25 GPa\"\nnodes = 7", 31, "nodes", "from 8 to 2000"},
        {"E = \"25 GPa\"", "E = \"25 GPa\"\nbeam = \"euler\"", 31, "beam", "\"euler-bernoulli\""},
        {"kn = \"1 GPa/m\"", "kn = 1e9", 31, "support.lining.interface.kn = 1e9 has no unit",
         "GPa/m"},
        {"wall_traction = \"40 %\"", "wall_traction = \"0.4\"", 33,
         "stage[0].wall_traction = \"0.4\" has no unit", "or the bare number 0.4"},
        {"wall_traction = \"40 %\"", "wall_traction = 1.01", 33, "stage[0].wall_traction = 1.01",
         "from 0 to 100 %"},
        {"wall_traction = \"40 %\"", "wall_traction = nan", 33, "is not finite", "from 0 to 100 %"},
        {"wall_traction = \"40 %\"", "wall_traction = \"101 %\"", 33, "stage[0].wall_traction",
         "from 0 to 100 %"},
        {"install = [\"bolts\"]", "install = \"bolts\"", 34, "is a text, not a list", "\"lining\""},
        {"install = [\"bolts\"]", "install = [\"bolt\"]", 34, "did you mean \"bolts\"?",
         "\"bolts\", \"lining\""},
        {"install = [\"bolts\"]", "install = [\"bolts\", \"bolts\"]", 34, "in the list twice",
         "once"},
        {"method = \"two-level\"", "method = \"newton\"", 39, "run.method", "\"relaxation\""},
        {"method = \"two-level\"", "linear_solver = \"cholesky\"", 39, "run.linear_solver",
         "\"iterative\""},
        {"method = \"two-level\"", "tolerance = 0.2", 39, "run.tolerance", "from 1e-06 to 0.1"},
        {"method = \"two-level\"", "displacement_limit = \"0 m\"", 39, "displacement_limit",
         "above 0"},
        {"method = \"two-level\"",
         "displacement_limit = \"20 mm\"\ncontact_update_limit = \"20 mm\"", 40, "is never reached",
         "below displacement_limit"},
        {"method = \"two-level\"", "contact_update_limit = \"0 mm\"", 39,
         "run.contact_update_limit", "above 0"},
        {"method = \"two-level\"", "method = \"explicit\"\nmax_steps = 2000", 40,
         "leaves no step after the ramp", "max_steps above ramp_steps"},
        {"method = \"two-level\"", "max_steps = 0", 39, "run.max_steps", "from 1 to 2000000000"},
        {"method = \"two-level\"", "method = \"explicit\"\ndamping = 1", 40, "run.damping",
         "from 0 to 0.95"},
        {"method = \"two-level\"", "method = \"explicit\"\nramp_steps = -1", 40, "ramp_steps",
         "from 0"},
        {"spacing = [\"9 deg\", \"none\"]", "spacing = [\"9 deg\"]", 41, "has 1 entry", "2 to 100"},
        {"spacing = [\"9 deg\", \"none\"]", "spacing = [\"none\", \"9 deg\"]", 41,
         "diagram.spacing[0] = \"none\" is not the last", "\"none\" last"},
        {"spacing = [\"9 deg\", \"none\"]", "spacing = [\"9 deg\", \"9 deg\"]", 41,
         "is not above the entry before it", "a rising list"},
        {"spacing = [\"9 deg\", \"none\"]", "spacing = [\"9 deg\", \"1 m\"]", 41,
         "mixes angles and lengths", "all lengths"},
        {"thickness = [\"0 cm\", \"10 cm\"]", "thickness = [\"10 cm\", \"5 cm\"]", 42,
         "diagram.thickness[1] = \"5 cm\" is not above", "a rising list"},
        {"thickness = [\"0 cm\", \"10 cm\"]", "thickness = [\"-5 cm\", \"5 cm\"]", 42,
         "diagram.thickness[0]", "0 or more"},
        {"thickness = [\"0 cm\", \"10 cm\"]", "thickness = [\"0 cm\", \"0.1 mm\", \"5 cm\"]", 42,
         "diagram.thickness[1]", "from 1 mm to 10 m"},
    });
  }

  TEST_CASE("how a joint lies in other conventions is refused with what it is in the section") {
    const auto dips = [](const char* text) { return std::string("dip = \"") + text + "\""; };
    const auto faces = [](const std::string& text) { return "dip_direction = " + text; };
    check_refused({
        {dips("75 deg"), dips("105 deg"), 14, "is the same plane as 75 deg to the other side",
         "dip = \"75 deg\", dip_direction = \"W\""},
        {dips("75 deg"), dips("-30 deg"), 14, "is the same plane as 30 deg to the other side",
         "dip = \"30 deg\", dip_direction = \"W\""},
        {dips("75 deg"), dips("181 deg"), 14, "is outside the accepted range", "0 to 90 deg"},
        {dips("75 deg"), dips("100 gon"), 14, "is 90 deg", "35 deg"},
        {dips("75 deg"), dips("75/270"), 14, "is dip and dip direction in one",
         "dip = \"75 deg\" and dip_direction = \"270 deg\""},
        {dips("75 deg"), "dip = 75", 14, "has no unit", "35 deg"},
        {faces("\"E\""), faces("\"O\""), 15, "west in French, Spanish and Italian",
         "\"W\", down to the left"},
        {faces("\"E\""), faces("\"west\""), 15, "is \"W\"", "\"W\""},
        {faces("\"E\""), faces("\"Ost\""), 15, "is \"E\"", "\"E\""},
        {faces("\"E\""), faces("\"ne\""), 15, "is \"NE\"", "\"NE\""},
        {faces("\"E\""), faces("90"), 15, "has no unit", "\"90 deg\" if degrees are meant"},
        {faces("\"E\""), faces("\"90\""), 15, "has no unit", "35 deg"},
        {faces("\"E\""), faces("\"361 deg\""), 15, "is outside the accepted range", "0 to 360 deg"},
        {faces("\"E\""), faces("\"N45E\""), 15, "joint_set[0].dip_direction", "35 deg"},
        {faces("\"E\""), faces("\"240 deg\""), 15,
         "is an azimuth, and the file does not say where the tunnel goes", "tunnel.trend"},
        {faces("\"E\""), faces("\"up\""), 15, "is no direction", "\"E\", down to the right"},
        {faces("\"E\""), faces("[1]"), 15, "is no direction", "an azimuth"},
        {"density = \"2700 kg/m^3\"", "density = \"26 kN/m^3\"", 10,
         "is a unit weight: density 2651 kg/m^3", "2700 kg/m^3"},
        {"extent = \"1 m\"", "extent = \"inf\"", 16,
         "counts centres per area, and of joints without extent", "spacing = \"1.2 m\""},
    });
  }

  TEST_CASE("a fraction is a percentage or a bare number") {
    for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
             {"0", 0}, {"0.0", 0}, {"0.3", 0.3}, {"1", 1}, {"1e-1", 0.1}, {"\"30 %\"", 0.3}}) {
      const std::string written = text;
      CAPTURE(written);
      CHECK(read(with("wall_traction = \"40 %\"", "wall_traction = " + written))
                .stages.at(0)
                .wall_traction == value);
      CHECK(read(good, {"stage[0].wall_traction=" + written}).stages.at(0).wall_traction == value);
    }
  }

  TEST_CASE("keys and brackets nested without end are refused with their place, not parsed") {
    const auto repeated = [](const std::string& part, int count) {
      std::string text;
      for (int k = 0; k < count; ++k) text += part;
      return text;
    };
    struct Deep {
      std::string line;
      int column;  ///< of the first name or bracket too many
    };
    for (const int depth : {16, 60000}) {
      const std::vector<Deep> cases = {
          {repeated("a.", depth) + "a = 1", 32},
          {repeated("a . ", depth) + "a = 1", 63},
          {"[" + repeated("a.", depth) + "a]", 33},
          {"x = " + repeated("[", depth + 1) + repeated("]", depth + 1), 21},
          {"x = " + repeated("[ ", depth + 1) + repeated("]", depth + 1), 37},
          {"x = " + repeated("{ a = ", depth + 1) + "1" + repeated(" }", depth + 1), 101},
          {"x = { " + repeated("a.", depth) + "a = 1 }", 38}};
      for (const Deep& deep : cases) {
        CAPTURE(deep.line.substr(0, 40));
        const auto errors = errors_of("title = \"a.b.c\"\n" + deep.line + "\n" + good);
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].line == 2);
        CHECK(errors[0].column == deep.column);
        CHECK(contains(errors[0].message, "more than 16"));
        CHECK(contains(errors[0].accepted, "at most 16 names"));
        CHECK(all(errors).size() < 2000);
      }
      for (const std::string& deep :
           {repeated("a.", depth) + "a=1", "a" + repeated("[0]", depth) + "=1",
            "title=" + repeated("[", depth + 1), "title=" + repeated("{a=", depth + 1)}) {
        CAPTURE(deep.substr(0, 40));
        const auto errors = errors_of(good, {deep});
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].override_text == deep);
        CHECK(contains(errors[0].accepted, "at most 16 names"));
        CHECK(all(errors).size() < 2000);
      }
    }
    // What is as deep as the limit is TOML and judged as such; dots in texts count for nothing.
    CHECK(contains(all(errors_of(repeated("a.", 15) + "a = 1\n" + good)), "unknown key `a`"));
    CHECK(contains(all(errors_of("x = " + repeated("[", 16) + repeated("]", 16) + "\n" + good)),
                   "unknown key `x`"));
    const std::string dots = repeated("1.", 40) + " [[[[[[[[[[[[[[[[[[[[";
    CHECK(read(with("title = \"Prüfung\"", "title = \"" + dots + "\" # " + dots)).title == dots);
    CHECK(read(good, {"title=" + dots}).title == dots);
  }

  TEST_CASE("the content of an input is that of its keys, however they are written") {
    const std::vector<std::string> content = read(good).content;
    CHECK(read("# a comment\n\n" + good).content == content);
    CHECK(read(with("K0 = 1\n", "K0   =  1  # hydrostatic\r\n")).content == content);
    CHECK(read(with("K0 = 1", "K0 = 2"), {"stress.K0=1"}).content == content);
    CHECK(read(with("width = \"70 m\"\nbelow_invert = \"30 m\"",
                    "below_invert = \"30 m\"\nwidth = \"70 m\""))
              .content == content);
    CHECK(read(with("K0 = 1", "K0 = 2")).content != content);
    CHECK(read(good, {"model.seed=2"}).content != content);
    CHECK(read(good, {"title=another"}).content != content);
  }

  TEST_CASE("unusual values are named with what is common") {
    CHECK(unusual_values(read(good)).empty());
    const auto unusual =
        unusual_values(read(good, {"model.gravity=1.62 m/s^2", "joint.kn=500 GPa/m",
                                   "joint.ks=50 GPa/m", "run.tolerance=1e-6"}));
    REQUIRE(unusual.size() == 3);
    CHECK(contains(unusual[0], "model.gravity = 1.62 m/s^2 is unusual (common: 5 m/s^2 to"));
    CHECK(contains(unusual[1], "joint.kn = 500 GPa/m is unusual (common: 250 MPa/m to"));
    CHECK(contains(unusual[2], "run.tolerance"));
  }

  TEST_CASE("a missing key is reported at its table, a missing table at the file") {
    check_refused({
        {"width = \"70 m\"\n", "", 2, "model.width is missing", "above 0; a length"},
        {"below_invert = \"30 m\"\n", "", 2, "model.below_invert is missing", "a length"},
        {"shape = \"circle\"\ndiameter = \"10 m\"\n", "", 5, "tunnel.shape is missing",
         "\"circle\""},
        {"diameter = \"10 m\"\n", "", 5, "tunnel.diameter is missing", "a length"},
        {"cover = \"20 m\"\n", "", 5, "tunnel.cover is missing", "a length"},
        {"shape = \"circle\"\ndiameter = \"10 m\"\n", "shape = \"horseshoe\"\nwidth = \"8 m\"\n", 5,
         "tunnel.wall_height is missing", "a length"},
        {"shape = \"circle\"\ndiameter = \"10 m\"\n", "shape = \"polygon\"\n", 5,
         "tunnel.vertices is missing", "3 to 2000 points"},
        {"[rock]\ndensity = \"2700 kg/m^3\"\n", "", 0, "[rock] is missing",
         "a table [rock] with density"},
        {"K0 = 1\n", "", 11, "stress.K0 is missing", "a bare number"},
        {"dip = \"75 deg\"\n", "", 13, "joint_set[0].dip is missing", "an angle"},
        {"dip_direction = \"E\"\n", "", 13, "joint_set[0].dip_direction is missing", "an azimuth"},
        {"intensity = \"1 /m^2\"\n", "", 13,
         "joint_set[0].intensity is missing, and so are spacing", "one of intensity"},
        {"kn = \"5 GPa/m\"\n", "", 18, "joint.kn is missing", "GPa/m"},
        {"min_inscribed_radius = \"0.25 m\"\n", "", 22, "blocks.min_inscribed_radius is missing",
         "a length"},
        {"length = \"4 m\"\n", "", 24, "support.bolts.length is missing", "a length"},
        {"spacing = \"15 deg\"\n", "", 24, "support.bolts.spacing is missing",
         "an angle from 0.1 deg or a length"},
        {"stiffness = \"0.2 GN/m\"\n", "law = \"axial-shear\"\nstiffness = \"0.2 GN/m\"\n", 24,
         "support.bolts.shear_stiffness is missing", "GN/m"},
        {"E = \"25 GPa\"\n", "", 28, "support.lining.E is missing", "25 GPa"},
        {"interface = { kn = \"1 GPa/m\", friction = \"30 deg\" }\n", "", 0,
         "[support.lining.interface] is missing", "with kn, friction"},
        {", friction = \"30 deg\" }", " }", 31, "support.lining.interface.friction is missing",
         "deg"},
        {"wall_traction = \"40 %\"\n", "", 32, "stage[0].wall_traction is missing", "40 %"},
        {"spacing = [\"9 deg\", \"none\"]\n", "", 40, "diagram.spacing is missing",
         "bolt spacings"},
        {"[joint]\n", "[joints]\n[joint]\n", 18, "joints.file is missing", "relative to the input"},
        {"[joint]\n", "[joints]\nfile = \"\"\n[joint]\n", 19, "is empty", "a file name"},
    });
  }

  TEST_CASE("an unknown key is refused, with the key that was probably meant") {
    check_refused({
        {"[rock]\n", "[rock]\ndensty = \"2700 kg/m^3\"\n", 10,
         "unknown key `densty` in [rock], did you mean `density`?", "density"},
        {"dip_direction = ", "direction = \"E\"\ndip_direction = ", 15,
         "unknown key `direction` in [joint_set[0]], did you mean `dip_direction`?", "intensity"},
        {"[rock]\n", "[rock]\nK0 = 1\n", 10, "did you mean `stress.K0`?", "density"},
        {"[rock]\n", "[rock]\nzzz = 1\n", 10, "unknown key `zzz` in [rock]", "density"},
        {"[rock]\n", "[rock]\n\"a b.c\" = 1\n", 10, "unknown key `\"a b.c\"`", "density"},
        {"[run]\n", "[rum]\n", 38, "unknown key `rum`, did you mean `run`?", "stress"},
        {"dip = \"75 deg\"\n", "dip = \"75 deg\"\ntrace_length = \"1 m\"\n", 15,
         "unknown key `trace_length` in [joint_set[0]]", "extent"},
        {"friction = \"30 deg\" }", "friction = \"30 deg\", cohesion = \"1 kPa\" }", 31,
         "unknown key `cohesion` in [support.lining.interface]", "ks"},
        {"[run]\n", "[support.cable]\n[run]\n", 38, "unknown key `cable` in [support]", "bolts"},
    });
  }

  TEST_CASE("a key that belongs to another choice is refused") {
    check_refused({
        {"cover = \"20 m\"\n", "cover = \"20 m\"\nwall_height = \"3 m\"\n", 9,
         "tunnel.wall_height belongs to shape = \"horseshoe\" only", "leave it out"},
        {"method = \"two-level\"", "method = \"two-level\"\ndamping = 0.5", 40,
         "run.damping belongs to method = \"explicit\" only", "leave it out"},
        {"length = \"4 m\"", "length = \"4 m\"\nshear_stiffness = \"1 MN/m\"", 26,
         "belongs to law = \"axial-shear\" only", "leave it out"},
        {"length = \"4 m\"", "length = \"4 m\"\nanchors = \"garga-wang\"\nanchor_offset = \"3 cm\"",
         27, "belongs to anchors = \"lorig\" only", "leave it out"},
        {"intensity = \"1 /m^2\"", "intensity = \"1 /m^2\"\nspacing = \"2 m\"", 17,
         "joint_set[0].spacing = \"2 m\" is given besides intensity", "one of"},
    });
  }

  TEST_CASE("tables and lists of tables are told apart") {
    check_refused({
        {"[rock]\n", "[[rock]]\n", 9, "rock is a list, not one table", "one table [rock]"},
        {"[rock]\ndensity = \"2700 kg/m^3\"\n", "", 0, "[rock] is missing", ""},
        {"[[joint_set]]\n", "[joint_set]\n", 13, "joint_set is one table", "[[joint_set]]"},
        {"title = \"Prüfung\"\n", "title = \"Prüfung\"\njoints = 5\n", 2,
         "joints = 5, not one table", "[joints]"},
    });
  }

  TEST_CASE("parts that do not fit together are refused") {
    const std::string circle = "shape = \"circle\"\ndiameter = \"10 m\"";
    const auto polygon = [](const std::string& points) {
      return "shape = \"polygon\"\nvertices = " + points;
    };
    check_refused({
        {"width = \"70 m\"", "width = \"10 m\"", 3, "leaves no ground beside the opening",
         "above 10 m"},
        {circle, polygon(R"([["-3 m","-3 m"], ["35 m","-3 m"], ["0 m","3 m"]])"), 3,
         "leaves no ground beside the opening", "above 70 m"},
        {"min_inscribed_radius = \"0.25 m\"", "min_inscribed_radius = \"5 m\"", 23,
         "larger than the opening", "below 5 m"},
        {"thickness = \"10 cm\"", "thickness = \"5 m\"", 29, "fills the opening", "below 5 m"},
        {"thickness = [\"0 cm\", \"10 cm\"]", "thickness = [\"0 cm\", \"6 m\"]", 42,
         "fills the opening", "below 5 m"},
        // 1000 /m^2 x 70 m x 60 m
        {"intensity = \"1 /m^2\"", "intensity = \"1000 /m^2\"", 13, "about 4200000 joints",
         "at most 1000000"},
        {"length = \"4 m\"", "length = \"4 m\"\npretension = \"3 kN\"\nrupture_force = \"2 kN\"",
         26, "pretension = \"3 kN\" is not below rupture_force", "below 2 kN"},
        {"length = \"4 m\"", "length = \"4 m\"\nyield_force = \"3 kN\"\nrupture_force = \"2 kN\"",
         26, "is not below rupture_force", "below 2 kN"},
        {"wall_traction = \"0 %\"", "wall_traction = \"10 %\"", 36,
         "leaves traction on the wall at the end", "\"0 %\""},
        {"[[stage]]\nwall_traction = \"0 %\"",
         "[[stage]]\nwall_traction = \"50 %\"\n[[stage]]\nwall_traction = \"0 %\"", 36,
         "is above that of the stage before", "at most 40 %"},
        {"install = [\"lining\"]", "install = [\"lining\", \"bolts\"]", 37, "names bolts again",
         "once"},
        {"install = [\"bolts\"]\n", "", 24, "support.bolts is in no stage",
         "install = [\"bolts\"]"},
        {"install = [\"lining\"]\n", "", 28, "support.lining is in no stage", "install"},
        {circle, polygon(R"([["-3 m","-3 m"], ["3 m","-3 m"]])"), 7, "has 2 entries", "points"},
        {circle, polygon(R"([["-3 m","-3 m"], ["3 m","-3 m"], ["0 m"]])"), 7, "tunnel.vertices[2]",
         "two lengths"},
        {circle, polygon(R"([["-3 m","-3 m"], ["3 m","3 m"], ["3 m","-3 m"], ["-3 m","3 m"]])"), 7,
         "crosses itself", "do not cross"},
        {circle, polygon(R"([["-3 m","-3 m"], ["3 m","-3 m"], ["1 m","-3 m"], ["0 m","3 m"]])"), 7,
         "folds back on itself at (", "points"},
        {circle, polygon(R"([["-3 m","0 m"], ["0 m","0 m"], ["3 m","0 m"]])"), 7,
         "folds back on itself", "points"},
        {circle, polygon(R"([["7 m","-3 m"], ["13 m","-3 m"], ["10 m","3 m"]])"), 7,
         "does not contain its centre", "around the tunnel centre"},
    });
    // Long joints cross: 100 /m^2 of 40 m would leave nothing but crumbs.
    const auto many =
        errors_of(with("min_inscribed_radius = \"0.25 m\"", "min_inscribed_radius = \"1 mm\""),
                  {"joint_set[0].intensity=50 /m^2", "joint_set[0].extent=40 m",
                   "joint_set[1].dip=10 deg", "joint_set[1].dip_direction=W",
                   "joint_set[1].intensity=50 /m^2", "joint_set[1].extent=40 m"});
    REQUIRE(many.size() == 1);
    CHECK(contains(many[0].message, "blocks"));
    CHECK(contains(many[0].accepted, "min_inscribed_radius"));
  }

  TEST_CASE("support that no table describes is neither installed nor varied") {
    std::string text = good;
    text.erase(text.find("[support.bolts]"),
               text.find("[support.lining]") - text.find("[support.bolts]"));
    const auto errors = errors_of(text);
    REQUIRE(errors.size() == 2);
    CHECK(contains(errors[0].message, "names bolts, which the file does not describe"));
    CHECK(errors[0].line == 30);
    CHECK(contains(errors[1].message, "varies bolts, which the file does not describe"));
    CHECK(errors[1].line == 37);
  }

  TEST_CASE("what is no TOML is refused in the same form") {
    check_refused({
        {"kn = \"5 GPa/m\"\n", "kn = \"5 GPa/m\"\nkn = \"6 GPa/m\"\n", 20, "'kn'", "once"},
        {"[rock]\n", "[model]\n", 9, "'model'", "[[round]]"},
        {"width = \"70 m\"", "width = 70 m", 3, "saw 'm'", "stand in quotes"},
        {"K0 = 1", "K0 = 1,5", 12, "saw ','", "a decimal point"},
        {"K0 = 1", "K0 =", 12, "expected value", ""},
        {"[stress]", "[stress", 11, "expected ']'", ""},
        {"width = \"70 m\"", "width = \"70 m", 3, "no closing quote", "a pair of quotes"},
        {"K0 = 1", "K0 = \u201c1\u201d", 12, "`\u201c` outside of quotes", "plain quotes"},
        {"K0 = 1", "K0 = 9\"1\"", 12, "a quote where none can be", "key ="},
        {"[stress]", "[=]", 11, "saw '='", ""},
        {"[stress]", "[[.a]]", 11, "saw '.'", ""},
        {"title = \"Prüfung\"", "title = \"\"\"a\nb\"\"\"", 1, "several lines", "one line"},
        {"title = \"Prüfung\"",
         "title = \"Pr\xfc"
         "fung\"",
         1, "utf-8", ""},  // Latin-1
    });
  }

  TEST_CASE("a file that holds no input says so") {
    const auto only = [](const std::string& text) {
      const auto errors = errors_of(text);
      REQUIRE(errors.size() == 1);
      return errors[0].message;
    };
    CHECK(contains(only(""), "test.toml is empty"));
    CHECK(contains(only("# nothing yet\n\n"), "holds no keys"));
    CHECK(contains(only("\xef\xbb\xbf"), "is empty"));
    CHECK(contains(only(std::string("\x7f"
                                    "ELF\0\0",
                                    6)),
                   "is not a text file"));
    CHECK(contains(only(std::string("\xff\xfe"
                                    "a\0",
                                    4)),
                   "UTF-16"));
    for (const auto& file :
         {std::filesystem::path("no such file.toml"), std::filesystem::temp_directory_path()}) {
      CHECK_THROWS_AS((void)read_input(file), InputErrors);
    }
  }

  TEST_CASE("all errors of a file are reported at once, in the order of its lines") {
    std::string text = with("kn = \"5 GPa/m\"", "kn = 5e9");
    const auto change = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    change("density", "densty");
    change("K0 = 1", "K0 = 11");
    change("width = \"70 m\"\n", "");
    change("wall_traction = \"0 %\"", "wall_traction = \"200 %\"");
    const auto errors = errors_of(text);
    const std::string shown = all(errors);
    CAPTURE(shown);
    REQUIRE(errors.size() == 6);
    CHECK(errors[0].key == "model.width");
    CHECK(errors[1].key == "rock.density");  // missing
    CHECK(errors[2].key == "rock.densty");   // unknown
    CHECK(errors[3].key == "stress.K0");
    CHECK(errors[4].key == "joint.kn");
    CHECK(errors[5].key == "stage[1].wall_traction");
    CHECK(std::is_sorted(errors.begin(), errors.end(),
                         [](const auto& a, const auto& b) { return a.line < b.line; }));
    try {
      (void)read(text);
    } catch (const InputErrors& all_errors) {
      CHECK(contains(all_errors.what(), "6 errors in the input"));
    }
  }

  TEST_CASE("of many errors the first are shown, and all are counted") {
    std::string text = good;
    for (int k = 0; k < 20000; ++k) text += "zz" + std::to_string(k) + " = 1\n";
    try {
      (void)read(text, {"stress.K0=20"});
      FAIL("unknown keys are refused");
    } catch (const InputErrors& errors) {
      // 50 with their place, line and list of keys: a page or two.
      CHECK(std::string(errors.what()).size() < 30000);
      CHECK(contains(errors.what(), "20001 errors in the input, of which the first 50 are shown"));
      CHECK(contains(errors.what(), "`zz0`"));
      CHECK(contains(errors.what(), "`zz49`"));
      CHECK(!contains(errors.what(), "`zz50`"));
      CHECK(errors.errors().front().line == 43);  // the first behind the good ones
      CHECK(errors.errors().back().key == "stress.K0");
    }
  }

  TEST_CASE("a message shows the line and puts the caret under the value") {
    const auto errors = errors_of(with("kn = \"5 GPa/m\"", "\tkn = 5e9  # ä"));
    REQUIRE(errors.size() == 1);
    CHECK(
        errors[0].text() ==
        "error: joint.kn = 5e9 has no unit\n"
        "   --> test.toml:19:7\n"
        "   |\n"
        "19 | \tkn = 5e9  # ä\n"
        "   | \t     ^^^\n"
        "   = accepted: from 1 kPa/m to 1000 GPa/m; a stiffness per area, such as \"5 GPa/m\", \"5000 MPa/m\" or "
        "\"5e9 Pa/m\"\n");
    // Columns count characters, not bytes.
    const auto wide = errors_of(
        with("kn = \"1 GPa/m\", friction = \"30 deg\"", "kn = \"1 GPä/m\", friction = 30"));
    REQUIRE(wide.size() == 2);
    CHECK(wide[0].column == 20);
    CHECK(wide[0].width == 9);
    CHECK(wide[1].column == 42);
    // An escape in the file must not reach the terminal.
    const auto escape = errors_of("a = \x1b[31m\n");
    REQUIRE(escape.size() == 1);
    CHECK(escape[0].text().find('\x1b') == std::string::npos);
  }

  TEST_CASE("quotes, brackets and letters in comments and texts are no fault") {
    CHECK(read(with("K0 = 1", "K0 = 1  # \u201c1\u201d, 'it's [=")).stress.K0 == 1);
    CHECK(read(with("\"Prüfung\"", R"("a \"ü\" [= # \\")")).title == R"(a "ü" [= # \)");
    CHECK(read(with("\"Prüfung\"", R"('a "ü" [= \')")).title == R"(a "ü" [= \)");
    CHECK(read(with("[stress]", " [ \"stress\" ] # ä")).stress.K0 == 1);
    CHECK(read(with("[\"0 cm\", \"10 cm\"]", "[ # ä\n\"0 cm\",\n\"10 cm\"\n]"))
              .diagram.value()
              .thickness.size() == 2);
    // A line that starts with a bracket inside a list is no table header.
    CHECK(read(with("shape = \"circle\"\ndiameter = \"10 m\"",
                    "shape = \"polygon\"\nvertices = [\n[\"-2 m\", \"-2 m\"],\n[# foot\n\"2 m\", "
                    "\"-2 m\"],\n[\"0 m\", \"3 m\"]\n]"))
              .tunnel.vertices.size() == 3);
  }

  TEST_CASE("line ends of Windows and a byte order mark change nothing") {
    std::string windows = "\xef\xbb\xbf";
    for (const char c : with("kn = \"5 GPa/m\"", "kn = 5e9")) {
      if (c == '\n') windows += '\r';
      windows += c;
    }
    const auto errors = errors_of(windows);
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].line == 19);
    CHECK(errors[0].column == 6);
    CHECK(errors[0].source_line == "kn = 5e9");
    windows.replace(windows.find("5e9"), 3, "\"5 GPa/m\"");
    CHECK(read(windows).title == "Prüfung");
    CHECK(errors_of("\xef\xbb\xbfx = 1\n").back().column == 1);
  }

  TEST_CASE("overrides replace, add and count from the last") {
    CHECK(read(good, {"joint.kn=6 GPa/m"}).joint_law.at("kn") == 6e9);
    CHECK(read(good, {"joint.kn=\"6 GPa/m\""}).joint_law.at("kn") == 6e9);
    CHECK(read(good, {" joint.kn = 6 GPa/m "}).joint_law.at("kn") == 6e9);
    CHECK(read(good, {"joint.kn=6 GPa/m", "joint.kn=7 GPa/m"}).joint_law.at("kn") == 7e9);
    CHECK(read(good, {"stress.K0=0.5"}).stress.K0 == 0.5);
    CHECK(read(good, {"title=a = b # c"}).title == "a = b # c");
    CHECK(read(good, {"title=Stüble"}).title == "Stüble");
    CHECK(read(good, {"title=\"Stüble\" (süd)"}).title == "\"Stüble\" (süd)");
    CHECK(read(good, {"joint_set[0].dip=60 deg"}).joint_sets.at(0).plane.dip == degrees(60));
    CHECK(read(good, {"joint_set[1].dip=60 deg", "joint_set[1].dip_direction=W",
                      "joint_set[1].spacing=2 m"})
              .joint_sets.size() == 2);
    CHECK(read(good, {"diagram.thickness[1]=20 cm"}).diagram.value().thickness.at(1) == 0.2);
    CHECK(read(good, {"support.lining.interface={ kn = \"2 GPa/m\", friction = \"30 deg\" }"})
              .linings.at(0)
              .interface_normal_stiffness == 2e9);

    // A table that the file does not have.
    std::string bare = good.substr(0, good.find("[support.bolts]"));
    CHECK(read(bare).bolts.empty());
    const Input added = read(bare, {"support.bolts.length=3 m", "support.bolts.spacing=1 m",
                                    "support.bolts.stiffness=0.1 GN/m"});
    CHECK(added.bolts.at(0).length == 3);
    CHECK(added.stages.at(0).bolts.size() == 1);
    CHECK(added.stages.at(0).linings.empty());
  }

  TEST_CASE("overrides take keys, tables and list entries away") {
    CHECK(read(good, {"!support.bolts", "!diagram", "!stage"}).bolts.empty());
    CHECK(read(good, {"!title"}).title.empty());
    CHECK(read(good, {"!diagram.thickness[0]", "diagram.thickness[1]=30 cm"})
              .diagram.value()
              .thickness.size() == 2);
    // Another shape, without what the one before had.
    const Input circle =
        read(good, {"!tunnel", "tunnel.shape=circle", "tunnel.diameter=3 m", "tunnel.cover=9 m"});
    CHECK(circle.tunnel.diameter == 3);
    CHECK(contains(errors_of(good, {"!stress.K0"})[0].message, "stress.K0 is missing"));
    for (const char* key : {"!support.anchors", "!joint_set[9]", "!title.x", "!nothing"}) {
      const auto errors = errors_of(good, {key});
      REQUIRE(errors.size() == 1);
      CHECK(contains(errors[0].message, "is not there"));
    }
  }

  TEST_CASE("errors of overrides name the override") {
    struct Case {
      std::string text, message;
    };
    for (const Case& c :
         std::vector<Case>{{"joint.kn=5e9", "joint.kn = 5e9 has no unit"},
                           {"joint.kn=", "joint.kn = \"\" is empty"},
                           {"joint.nk=5 GPa/m", "unknown key `nk` in [joint]"},
                           {"joints_set[0].dip=5 deg", "did you mean `joint_set`?"},
                           {"joint_set[0].dip=195 deg",
                            "joint_set[0].dip = 195 deg is outside the accepted range"},
                           {"joint_set[2].dip=5 deg", "joint_set has 1 entry"},
                           {"joint_set[x].dip=5 deg", "is not a key"},
                           {"joint_set.dip=5 deg", "joint_set is no table"},
                           {"title.x=5", "title is no table"},
                           {"model[0]=5", "model is no array"},
                           {"model", "override without `=`"},
                           {"=5", "is not a key"},
                           {"a..b=5", "is not a key"},
                           {"run.method=fast", "run.method = fast is not one of its words"},
                           {"support.lining.interface={ kn = 1 }", "interface.kn = 1 has no unit"},
                           {"model.seed=1\nx = 2", "model.seed = 1?x = 2 is a text"}}) {
      CAPTURE(c.text);
      const auto errors = errors_of(good, {"run.tolerance=1e-2", c.text});
      const std::string shown = all(errors);
      CAPTURE(shown);
      REQUIRE_FALSE(errors.empty());
      CHECK(contains(errors[0].message, c.message));
      CHECK(errors[0].override_text == c.text);
      CHECK(errors[0].line == 0);
      CHECK(contains(shown, "--> --set "));
    }
    // What is missing in a table that an override began is that override's fault.
    const auto begun =
        errors_of(good.substr(0, good.find("[support.bolts]")), {"support.lining.thickness=10 cm"});
    REQUIRE(begun.size() == 2);
    CHECK(contains(begun[1].message + begun[0].message, "support.lining.E is missing"));
  }

  TEST_CASE("a damaged file is read or refused, never anything else") {
    int read_well = 0, refused = 0;
    const auto attempt = [&](const std::string& text) {
      try {
        (void)read(text);
        ++read_well;
      } catch (const InputErrors&) {
        ++refused;
      }
    };
    for (std::size_t i = 0; i < good.size(); ++i) {
      attempt(good.substr(0, i));
      for (const char c :
           {'"', '\'', '\\', '[', ']', '{', '=', '.', '#', '9', '-', ' ', '\n', '\xc3', '\x01'}) {
        std::string text = good;
        text[i] = c;
        attempt(text);
      }
      attempt(std::string(good).erase(i, 1));
    }
    CHECK(read_well > 0);
    CHECK(refused > 0);
  }
}

}  // namespace program_input_test
