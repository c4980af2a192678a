// SPDX-License-Identifier: MIT
// What is possible and not plausible is named: a slip by a thousand of any key, and stress that
// closes joints by more than blocks are for.
#include "plausibility.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>
#include <voussoir/drawing/number_text.hpp>

#include "harness.hpp"
#include "support/near.hpp"

namespace program_plausibility_test {

using namespace voussoir::program;
using namespace voussoir_test;

namespace {

/// A tunnel with every table, of values that nobody would remark on.
const std::string usual = R"([model]
width = "70 m"
below_invert = "30 m"
gravity = "9.81 m/s^2"
[tunnel]
shape = "horseshoe"
width = "8 m"
wall_height = "3 m"
cover = "20 m"
[rock]
density = "2700 kg/m^3"
[stress]
K0 = 1.2
surcharge = "20 kPa"
[boundary]
sides = "elastic"
base = "elastic"
E = "5 GPa"
nu = 0.25
[[joint_set]]
dip = "75 deg"
dip_direction = "E"
sd = "2 deg"
intensity = "1 /m^2"
extent = "1 m"
kn = "8 GPa/m"
ks = "1 GPa/m"
friction = "30 deg"
[[joint_set]]
dip = "25 deg"
dip_direction = "W"
spacing = "1.2 m"
[joint]
kn = "5 GPa/m"
ks = "0.5 GPa/m"
friction = "35 deg"
[blocks]
min_inscribed_radius = "0.25 m"
max_elongation = 5
min_wall_area = "0.05 m^2"
[support.bolts]
length = "4 m"
spacing = "1.3 m"
arc = ["0 deg", "180 deg"]
out_of_plane = "1.5 m"
diameter = "25 mm"
stiffness = "0.2 GN/m"
law = "axial-shear"
shear_stiffness = "50 MN/m"
pretension = "50 kN"
yield_force = "200 kN"
rupture_force = "250 kN"
anchor_offset = "30 mm"
[support.lining]
thickness = "15 cm"
E = "25 GPa"
nu = 0.2
nodes = 96
arc = ["-20 deg", "200 deg"]
interface = { kn = "1 GPa/m", ks = "0.5 GPa/m", friction = "30 deg", shear_bond = "1 MPa" }
[support.lining.feet]
width = "0.3 m"
stiffness = "2 GPa/m"
strength = "5 MPa"
friction = "30 deg"
beam = { depth = "0.4 m", E = "25 GPa", spacing = "1.5 m" }
[[stage]]
wall_traction = "40 %"
install = ["bolts"]
[[stage]]
wall_traction = "0 %"
install = ["lining"]
[run]
tolerance = 1e-3
displacement_limit = "20 cm"
contact_update_limit = "1 cm"
max_steps = 60000
[diagram]
spacing = ["1.2 m", "none"]
thickness = ["0 cm", "10 cm"]
)";

Input read(const std::vector<std::string>& overrides) {
  return read_input_text(usual, "usual.toml", "/site", overrides);
}

/// A key, its value and the unit that slips.
struct Slip {
  std::string key;
  double value;
  std::string unit;
  std::vector<std::string> with = {};  ///< overrides that the key needs
  /// How the value is written: `#` stands for it.
  std::string form = "#";
};

const std::vector<std::string> of_explicit = {"run.method=explicit", "run.max_steps=200000"};

const std::vector<Slip> slips = {
    {"model.width", 70, "m"},
    {"model.below_invert", 30, "m"},
    {"model.gravity", 9.81, "m/s^2"},
    {"tunnel.width", 8, "m"},
    {"tunnel.diameter", 8, "m", {"tunnel={shape=\"circle\", diameter=\"8 m\", cover=\"20 m\"}"}},
    {"tunnel.wall_height", 3, "m"},
    {"tunnel.cover", 20, "m"},
    {"rock.density", 2700, "kg/m^3"},
    {"stress.K0", 1.2, ""},
    {"stress.surcharge", 20, "kPa"},
    {"stress.surcharge", 5, "MPa", {"boundary.top=elastic"}},
    {"boundary.E", 5, "GPa"},
    {"boundary.nu", 0.25, ""},
    {"joint_set[0].dip", 75, "deg"},
    {"joint_set[0].sd", 2, "deg"},
    {"joint_set[0].intensity", 1, "/m^2"},
    {"joint_set[0].extent", 1, "m"},
    {"joint_set[0].kn", 8, "GPa/m"},
    {"joint_set[0].ks", 1, "GPa/m"},
    {"joint_set[0].friction", 30, "deg"},
    {"joint_set[1].spacing", 1.2, "m"},
    {"joint.kn", 5, "GPa/m"},
    {"joint.ks", 0.5, "GPa/m"},
    {"joint.friction", 35, "deg"},
    {"blocks.min_inscribed_radius", 0.25, "m"},
    {"blocks.max_elongation", 5, ""},
    {"blocks.min_wall_area", 0.05, "m^2"},
    {"support.bolts.length", 4, "m"},
    {"support.bolts.spacing", 1.3, "m"},
    {"support.bolts.spacing", 15, "deg"},
    {"support.bolts.arc", 180, "deg", {}, "[\"0 deg\", \"#\"]"},
    {"support.bolts.out_of_plane", 1.5, "m"},
    {"support.bolts.diameter", 25, "mm"},
    {"support.bolts.stiffness", 0.2, "GN/m"},
    {"support.bolts.shear_stiffness", 50, "MN/m"},
    {"support.bolts.pretension", 50, "kN"},
    {"support.bolts.yield_force", 200, "kN"},
    {"support.bolts.rupture_force", 250, "kN"},
    {"support.bolts.anchor_offset", 30, "mm"},
    {"support.lining.thickness", 15, "cm"},
    {"support.lining.E", 25, "GPa"},
    {"support.lining.nu", 0.2, ""},
    {"support.lining.nodes", 96, ""},
    {"support.lining.interface.kn", 1, "GPa/m"},
    {"support.lining.interface.ks", 0.5, "GPa/m"},
    {"support.lining.interface.friction", 30, "deg"},
    {"support.lining.interface.shear_bond", 1, "MPa"},
    {"support.lining.interface.tensile_bond", 0.5, "MPa"},
    {"support.lining.feet.width", 0.3, "m"},
    {"support.lining.feet.stiffness", 2, "GPa/m"},
    {"support.lining.feet.strength", 5, "MPa"},
    {"support.lining.feet.friction", 30, "deg"},
    {"support.lining.feet.beam.depth", 0.4, "m"},
    {"support.lining.feet.beam.E", 25, "GPa"},
    {"support.lining.feet.beam.spacing", 1.5, "m"},
    {"stage[0].wall_traction", 40, "%"},
    {"run.tolerance", 1e-3, ""},
    {"run.displacement_limit", 20, "cm"},
    {"run.contact_update_limit", 1, "cm"},
    {"run.max_steps", 60000, ""},
    {"run.damping", 0.7, "", of_explicit},
    {"run.ramp_steps", 8000, "", of_explicit},
    {"diagram.spacing", 1.2, "m", {}, "[\"#\", \"none\"]"},
    {"diagram.thickness", 10, "cm", {}, "[\"0 cm\", \"#\"]"},
};

std::string override_of(const Slip& slip, double value) {
  const std::string text =
      voussoir::significant_text(value, 12) + (slip.unit.empty() ? "" : " " + slip.unit);
  return slip.key + "=" + replaced(slip.form, "#", text);
}

/// What is said of an input: errors, or remarks on unusual values.
std::string said_of(const std::vector<std::string>& overrides) {
  std::string text;
  try {
    for (const std::string& line : unusual_values(read(overrides))) text += line + "\n";
  } catch (const InputErrors& errors) {
    for (const InputError& error : errors.errors()) text += error.message + "\n";
  }
  return text;
}

}  // namespace

TEST_SUITE("program/plausibility") {
  TEST_CASE("usual values are not remarked on, and a slip by a thousand of any of them is named") {
    CHECK(said_of({}) == "");
    CHECK(slips.size() >= 60);
    for (const Slip& slip : slips) {
      CAPTURE(slip.key);
      std::vector<std::string> overrides = slip.with;
      overrides.push_back(override_of(slip, slip.value));
      CHECK(said_of(overrides) == "");
      for (const double factor : {1e3, 1e-3}) {
        CAPTURE(factor);
        overrides.back() = override_of(slip, factor * slip.value);
        const std::string said = said_of(overrides);
        CAPTURE(said);
        // Where two keys do not fit together, it is the other that is refused, and names this.
        CHECK(said.find(slip.key.substr(slip.key.rfind('.') + 1)) != std::string::npos);
      }
    }
  }

  TEST_CASE("what is common is said beside the value") {
    const auto says = [](const std::string& override_text, const std::string& words) {
      const std::string said = said_of({override_text});
      CAPTURE(said);
      CHECK(said.find(words) != std::string::npos);
    };
    says("joint.kn=5 MPa/m", "joint.kn = 5 MPa/m is unusual (common: 250 MPa/m to 200 GPa/m)");
    says("rock.density=26 kg/m^3",
         "rock.density = 26 kg/m^3 is unusual (common: 1500 kg/m^3 to 4500 kg/m^3)");
    says("support.lining.E=20 MPa", "support.lining.E = 20 MPa is unusual (common: 500 MPa to");
    says("support.bolts.stiffness=0.1 MN/m", "support.bolts.stiffness = 100 kN/m is unusual");
    says("joint.ks=6 MPa/m",
         "(common: 50 MPa/m to 7.5 GPa/m, 0.01 to 1.5 of the normal stiffness)");
    says("tunnel.cover=20 km",
         "(common: 3.2 m to 2800 m, 0.4 to 350 times the width of the opening)");
    // Traces as long as a domain of 70 m lie to a good part outside of it.
    says("joint_set[0].extent=60 m", "joint_set[0].extent = 60 m is long beside the domain");
    CHECK(said_of({"joint_set[0].extent=inf", "joint_set[0].intensity=1 /m^2"})
              .find("more reach into a large domain than into a small one") != std::string::npos);
  }

  TEST_CASE("in-situ stress beside blocks and opening, by hand") {
    // 1 MPa on 5 GPa/m is 0.2 mm; with joints 0.5 m apart an opening of 8 m closes by 16 of them.
    const InSituClosure usual_one = in_situ_closure(read({}), 1e6, 0.8, 0.5);
    CHECK(usual_one.of_joints == near(0.2e-3));
    CHECK(usual_one.of_opening == near(16 * 0.2e-3));
    CHECK(remarks_on(usual_one).empty());
    // The softest set counts: 81 mm are more than a tenth of 0.8 m, 79 mm are not.
    for (const auto& [kn, count] : {std::pair{"12.3 MPa/m", 1}, std::pair{"12.7 MPa/m", 0}}) {
      const auto remarks =
          remarks_on(in_situ_closure(read({std::string("joint_set[1].kn=") + kn}), 1e6, 0.8, 1e6));
      REQUIRE(static_cast<int>(remarks.size()) == count);
      if (count > 0)
        CHECK(remarks.front().find("small displacements no longer hold") != std::string::npos);
    }
    // 2 % of 8 m: 16 joints of 10 mm each. Blocks of 1 m are no matter.
    CHECK(remarks_on(in_situ_closure(read({"joint.kn=101 MPa/m"}), 1e6, 1, 0.5)).empty());
    const auto opening = remarks_on(in_situ_closure(read({"joint.kn=99 MPa/m"}), 1e6, 1, 0.5));
    REQUIRE(opening.size() == 1);
    CHECK(opening.front().find("p0 D/E = 161.616 mm, 2 % of its width D") != std::string::npos);
  }

#ifdef VOUSSOIR_TEST_PROGRAM
  TEST_CASE("every run names what is unusual, stable or not, on screen and in its file") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", InputText{}.text());
    const auto run = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments = {"run", file, "--out", folder / "out"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return run_program(arguments);
    };
    const Outcome plain = run({});
    CHECK(plain.out.find("unusual") == std::string::npos);
    CHECK(plain.out.find("small displacements") == std::string::npos);
    const Outcome light = run({"--set", "rock.density=27 kg/m^3"});
    CAPTURE(light.out);
    CHECK(light.out.find("verdict  stable") != std::string::npos);
    CHECK(light.out.find("warning  rock.density = 27 kg/m^3 is unusual (common: 1500") !=
          std::string::npos);
    CHECK(read_file(folder / "out/run.json").find("rock.density = 27 kg/m^3 is unusual") !=
          std::string::npos);
    // 2700 kg/m^3 x 9.81 m/s^2 x 10 m = 265 kPa on 3 MPa/m: 88 mm, of blocks of 0.78 m.
    const Outcome soft = run({"--set", "joint.kn=3 MPa/m", "--set", "joint.ks=1.5 MPa/m"});
    CAPTURE(soft.out);
    CHECK(soft.out.find("closes joints by p0/kn = 88.29 mm") != std::string::npos);
    CHECK(soft.out.find("small displacements no longer hold") != std::string::npos);
    for (const std::string verb : {"sweep", "realisations", "diagram"}) {
      std::vector<std::string> arguments = {verb,          file,    "--out",
                                            folder / verb, "--set", "rock.density=27 kg/m^3"};
      if (verb == "sweep") arguments.insert(arguments.end(), {"--vary", "stress.K0=1"});
      if (verb == "realisations") arguments.insert(arguments.end(), {"-n", "1"});
      if (verb == "diagram")
        arguments.insert(arguments.end(),
                         {"--set",
                          "diagram={spacing=[\"30 deg\", \"none\"], thickness=[\"0 cm\", "
                          "\"8 cm\"]}"});
      const Outcome many = run_program(arguments);
      CAPTURE(many.err);
      CHECK(many.out.find("warning  rock.density = 27 kg/m^3 is unusual") != std::string::npos);
      const std::string table = verb == "diagram" ? "interaction" : verb;
      CHECK(read_file(folder / (verb + "/" + table + ".csv"))
                .find("rock.density = 27 kg/m^3 is unusual") != std::string::npos);
    }
  }
#endif
}

}  // namespace program_plausibility_test
