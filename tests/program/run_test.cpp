// SPDX-License-Identifier: MIT
// From an input file to results, through the executable.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>
#include <voussoir/voussoir.hpp>

#include "harness.hpp"
#include "run_results.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace program_run_test {

namespace {

/// A table without its last column, which differs between runs of different inputs.
std::string without_run_id(const std::string& table) {
  std::istringstream in(table);
  std::string text;
  for (std::string line; std::getline(in, line);) text += line.substr(0, line.rfind(',')) + "\n";
  return text;
}

using namespace voussoir_test;
using Json = nlohmann::json;

/// Runs `text` into a folder of its own; every run must end well and leave the four files.
Results ended_well(const std::string& text, const std::vector<std::string>& more = {},
                   const std::string& traces = "") {
  std::map<std::string, std::string> beside;
  if (!traces.empty()) beside["traces.csv"] = traces;
  Results results = results_of(text, more, beside);
  REQUIRE((results.outcome.status == 0 || results.outcome.status == 6));
  REQUIRE(results.files.size() == 4);  // and nothing half-written beside them
  const bool fell = results.json.at("detached_area_m2") > 0.0;
  CHECK(results.json.at("verdict") == (fell ? "stable after rockfall" : "stable"));
  CHECK(results.outcome.status == (fell ? 6 : 0));
  return results;
}

/// A table that was written: rows by the names of its columns.
std::vector<std::map<std::string, std::string>> table(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const auto header = csv_fields(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const auto fields = csv_fields(line);
    REQUIRE(fields.size() == header.size());
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < fields.size(); ++k) row[header[k]] = fields[k];
  }
  return rows;
}

std::string header(const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); }

double crown(const Results& r) { return r.json.at("convergence").at("crown_mm"); }
double thrust(const Results& r) { return r.json.at("lining").at("mean_thrust_kN_per_m"); }

const std::string supported = InputText{}.text();

InputText without_support() {
  InputText input;
  input.bolts = input.lining = "";
  return input;
}
const std::string bare = without_support().text();

/// Of `supported` and of `bare`, run once for all test cases that only look at the results.
const Results& supported_results() {
  static const Results results = ended_well(supported);
  return results;
}
const Results& bare_results() {
  static const Results results = ended_well(bare);
  return results;
}

}  // namespace

TEST_SUITE("program/run") {
  TEST_CASE("a run writes numbers, tables and a picture that agree with each other") {
    const Results& r = supported_results();
    CHECK(
        header(r.files.at("bolts.csv")) ==
        "bolt,angle_deg,joint,distance_from_head_m,x_m,y_m,axial_force_kN,extension_mm,state,of_its_strength,strength_kN,mode,run_id");
    CHECK(
        header(r.files.at("lining.csv")) ==
        "lining,node,angle_deg,x_m,y_m,thrust_kN_per_m,shear_kN_per_m,moment_kNm_per_m,convergence_mm,lost,of_its_strength,largest_shear_kN_per_m,run_id");
    CHECK(r.files.at("blocks.svg").starts_with("<"));
    CHECK(r.files.at("blocks.svg").find("</svg>") != std::string::npos);

    // The tables are written with 8 digits, run.json with all.
    double force = 0, thrust_sum = 0, moment = 0;
    std::map<std::string, double> largest;
    for (const auto& row : table(r.files.at("bolts.csv"))) {
      const double f = std::stod(row.at("axial_force_kN"));
      force = std::max(force, f);
      largest[row.at("bolt")] = std::max(largest[row.at("bolt")], f);
      CHECK(f >= 0);  // carries no compression
      CHECK(f <= 200);
      // 0.2 GN/m is 200 kN/mm.
      if (f > 0) CHECK(std::abs(f - 200 * std::stod(row.at("extension_mm"))) < 1e-6 * f);
      CHECK(row.at("state") == "elastic");
    }
    const auto nodes = table(r.files.at("lining.csv"));
    for (const auto& row : nodes) {
      thrust_sum += std::stod(row.at("thrust_kN_per_m"));
      moment = std::max(moment, std::abs(std::stod(row.at("moment_kNm_per_m"))));
      const double x = std::stod(row.at("x_m")), y = std::stod(row.at("y_m"));
      // Nodes are the middles of the 24 chords of a circle of 2 m radius.
      CHECK(std::abs(std::hypot(x, y) - 2 * std::cos(std::numbers::pi / 24)) < 1e-7);
    }
    const Json& bolts = r.json.at("bolts");
    CHECK(bolts.at("count") == 7);  // 0, 30, ... 180 degrees
    CHECK(std::abs(force - bolts.at("largest_force_kN").get<double>()) < 1e-6 * force);
    double mean = 0;
    for (const auto& [bolt, f] : largest) mean += f / 7;
    CHECK(std::abs(mean - bolts.at("mean_of_largest_forces_kN").get<double>()) < 1e-6 * mean);
    REQUIRE(nodes.size() == 24);
    CHECK(std::abs(thrust_sum / 24 - thrust(r)) < 1e-6 * thrust(r));
    CHECK(std::abs(moment - r.json.at("lining").at("largest_moment_kNm_per_m").get<double>()) <
          1e-6 * moment);
    // rho g (cover + D / 2) = 2700 * 9.81 * 10 Pa
    CHECK(std::abs(r.json.at("rock").at("vertical_stress_at_centre_kPa").get<double>() - 264.87) <
          1e-9);
    CHECK(r.json.at("rock").at("in_situ_out_of_balance_force_ratio") < 1e-9);
    CHECK(r.json.at("error_estimate") < 1e-3);
  }

  TEST_CASE("a small force with its unit is not taken for one in another unit") {
    CHECK(crown(ended_well(supported, {"--set", "support.bolts.pretension=500 N"})) > 0);
  }

  TEST_CASE("the program computes what the same calls in C++ compute") {
    using namespace voussoir;
    constexpr double deg = std::numbers::pi / 180;
    using Twin = Solver<Planar, CoulombJoint, LorigAnchors, EulerBernoulliBeam>;
    const SimplePolygon opening = circular_opening(4, 24);
    const Domain<2> ground = domain_around(opening, 24, 8, 8);
    const std::vector sets = {JointSet{"a", 70 * deg, DipDirection::east, 1 * deg, 1, 0, 2},
                              JointSet{"b", 20 * deg, DipDirection::west, 0, 1, 0, 2}};
    const auto rock = slice(ground, joint_network(sets, ground, 3), {0.2, 5});
    const CoulombJoint joint({5e9, 5e8, 35 * deg});
    const InSitu in_situ{.density = 2700, .k0 = 1};
    // Of its own accord the program takes what the elastic closure asks for.
    Twin held(rock, joint, in_situ), free = held;
    const FarField<2> elastic = FarField<2>::elastic(elastic_moduli(rock, joint));
    free = Twin(rock, joint, in_situ, {}, elastic);
    held.excavate(opening, 0.02);
    free.excavate(opening, 0.02);
    const BoundaryBias bias = boundary_bias(elastic_wall_motion(held), elastic_wall_motion(free));
    REQUIRE(bias.largest() > 0.02);
    for (const bool automatic : {false, true}) {
      CAPTURE(automatic);
      Twin& tunnel = automatic ? free : held;
      const AxialBolt bolt({.axial_stiffness = 2e8, .rupture_force = 2e5});
      for (const Segment& bar : bolt_bars({.length = 2, .angular_spacing = 30 * deg}, opening))
        tunnel.install_bolt(bar, bolt);
      tunnel.install_lining(lining_frame(tunnel.mass(), {.nodes = 24}),
                            LiningSection::rectangular(0.08, 25e9),
                            CoulombJoint({1e9, 1e9, 30 * deg}));
      REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);

      const Results r = automatic ? supported_results()
                                  : ended_well(supported, {"--set", "boundary.sides=rollers",
                                                           "--set", "boundary.base=rollers"});
      CHECK(r.json.at("rock").at("bodies") == tunnel.mass().bodies.size());
      const Convergence c = convergence(tunnel);
      // The program's interface is a MohrCoulombJoint without cohesion: equal but for roundings,
      // which the search amplifies less than its tolerance.
      CHECK(std::abs(crown(r) - 1e3 * c.crown) < 1e-6 * crown(r));
      CHECK(std::abs(r.json.at("convergence").at("invert_mm").get<double>() - 1e3 * c.invert) <
            1e-6 * crown(r));
      const Json& boundary = r.json.at("boundary");
      CHECK(boundary.at("chosen_by_the_program") == automatic);
      CHECK(boundary.at("base") == (automatic ? "elastic" : "rollers"));
      // Elastic solves of two models to 1e-6 each.
      CHECK(std::abs(boundary.at("bias_of_closure").at("across").get<double>() - bias.across) <
            1e-5);
      CHECK(r.outcome.out.find(automatic ? "against the opening as a whole"
                                         : "rollers at sides and base: against ground") !=
            std::string::npos);
    }
  }

  TEST_CASE("rock whose moduli cannot be measured keeps its rollers, and it is said") {
    InputText input;
    input.joints = "";
    const Results r = ended_well(input.text());
    CHECK(r.json.at("boundary").at("base") == "rollers");
    CHECK(r.outcome.out.find("moduli of the rock cannot be measured") != std::string::npos);
    const Results given = ended_well(
        input.text(), {"--set", "boundary.sides=elastic", "--set", "boundary.base=elastic", "--set",
                       "boundary.E=5 GPa", "--set", "boundary.nu=0.25"});
    CHECK(given.json.at("boundary").at("sides") == "elastic");
  }

  TEST_CASE("the same seed gives the same bytes, another seed another rock") {
    Results a = supported_results(), b = ended_well(supported);
    a.json.erase("time_s");
    b.json.erase("time_s");
    CHECK(a.json == b.json);
    for (const char* name : {"bolts.csv", "lining.csv", "blocks.svg"})
      CHECK_MESSAGE(a.files.at(name) == b.files.at(name), name);
    const Results other = ended_well(supported, {"--set", "model.seed=4"});
    CHECK(other.json.at("seed") == 4);
    CHECK(other.files.at("bolts.csv") != a.files.at("bolts.csv"));
  }

  TEST_CASE("--set changes the result") {
    const Results& stiff = supported_results();
    const Results soft = ended_well(
        supported, {"--set", "joint.kn=2.5 GPa/m", "--set", "joint.ks = \"0.25 GPa/m\""});
    CHECK(crown(soft) > crown(stiff));
    CHECK(thrust(soft) > thrust(stiff));
  }

  TEST_CASE("quiet prints nothing; a pipe gets no control characters") {
    const Results quiet = ended_well(supported, {"--quiet"});
    CHECK(quiet.outcome.out.empty());
    CHECK(quiet.outcome.err.empty());
    const Results& spoken = supported_results();
    CHECK(spoken.outcome.err.empty());
    CHECK(spoken.outcome.out.find("verdict  stable") != std::string::npos);
    CHECK(std::none_of(spoken.outcome.out.begin(), spoken.outcome.out.end(), [](char c) {
      return std::iscntrl(static_cast<unsigned char>(c)) != 0 && c != '\n';
    }));
  }

  TEST_CASE("a diagram of two spacings and two thicknesses is a table and a picture") {
    const Folder folder;
    InputText input;
    input.rest = "[diagram]\nspacing = [\"30 deg\", \"none\"]\nthickness = [\"4 cm\", \"8 cm\"]\n";
    const std::string file = write_file(folder / "case.toml", input.text());
    const Outcome two = run_program({"diagram", file, "--out", folder / "two", "--threads", "2"});
    INFO(two.err);
    REQUIRE(two.status == 0);
    // Two files of results; the plan and the journal of its cases lie beside them.
    std::set<std::string> files;
    for (const auto& [path, content] : contents(folder / "two"))
      if (std::filesystem::path(path).parent_path() == std::filesystem::path(folder / "two"))
        files.insert(std::filesystem::path(path).filename().string());
    CHECK(files == std::set<std::string>{"diagram.journal", "diagram.plan.json", "interaction.csv",
                                         "interaction.svg"});
    CHECK(read_file(folder / "two/interaction.svg").find("</svg>") != std::string::npos);
    const auto rows = table(read_file(folder / "two/interaction.csv"));
    REQUIRE(rows.size() == 4);
    CHECK(rows[0].at("bolt_spacing_deg") == "30");
    CHECK(rows[3].at("bolt_spacing_deg") == "none");
    for (const auto& row : rows) CHECK(row.at("verdict") == "stable");
    // A thicker lining and bolts both hold the crown back.
    const auto crown_at = [&](std::size_t k) {
      return std::stod(rows[k].at("crown_convergence_mm"));
    };
    CHECK(crown_at(1) < crown_at(0));
    CHECK(crown_at(3) < crown_at(2));
    CHECK(crown_at(0) <= crown_at(2));
    // The tunnel of the file is one of the four; the table has 6 digits.
    const Results& single = supported_results();
    CHECK(std::abs(crown_at(1) - crown(single)) < 1e-5 * crown(single));

    const Outcome one =
        run_program({"diagram", file, "--out", folder / "one", "--threads", "1", "-q"});
    REQUIRE(one.status == 0);
    CHECK(one.out.empty());
    CHECK(read_file(folder / "one/interaction.csv") == read_file(folder / "two/interaction.csv"));
    CHECK(read_file(folder / "one/interaction.svg") == read_file(folder / "two/interaction.svg"));
  }

  TEST_CASE(
      "support installed after 40 % of the relaxation carries less and lets the wall in further") {
    InputText staged;
    staged.rest =
        "[[stage]]\nname = \"excavation\"\nwall_traction = \"60 %\"\n"
        "[[stage]]\nname = \"support\"\nwall_traction = \"0 %\"\ninstall = [\"bolts\", \"lining\"]\n";
    const Results &wished = supported_results(), relaxed = ended_well(staged.text());
    REQUIRE(relaxed.json.at("stages").size() == 2);
    CHECK(relaxed.json.at("stages")[0].at("name") == "excavation");
    CHECK(relaxed.json.at("stages")[0].at("residual_wall_traction") == 0.6);
    CHECK(relaxed.json.at("stages")[0].at("convergence").at("crown_mm") > 0.0);
    CHECK(relaxed.json.at("stages")[0].at("convergence").at("crown_mm") < crown(relaxed));
    CHECK(crown(relaxed) > crown(wished));
    CHECK(thrust(relaxed) < thrust(wished));
    // Elastic rock would leave the lining 60 % of its load exactly; slip takes some more.
    CHECK(thrust(relaxed) > 0.5 * thrust(wished));
    CHECK(thrust(relaxed) < 0.7 * thrust(wished));
  }

  // 24 chords of a circle 4 m wide; 8 cm of 25 GPa on 1 GPa/m.
  TEST_CASE("a bonded lining has the nodes that its bond needs, and the run says how many") {
    const double perimeter = 24 * 4 * std::sin(std::numbers::pi / 24),
                 length = std::pow(4 * 25e9 * 0.08 * 0.08 * 0.08 / 12 / 1e9, 0.25);
    const int chosen = static_cast<int>(std::ceil(perimeter / (0.4 * length)));
    REQUIRE(chosen == 123);
    InputText input;
    input.lining = replaced(input.lining, "\"30 deg\" }",
                            "\"30 deg\", shear_bond = \"0.5 MPa\", tensile_bond = \"0.2 MPa\" }");
    const Results r = ended_well(input.text());
    CHECK(r.json.at("lining").at("nodes_chosen_for_the_bond") == chosen);
    CHECK(table(r.files.at("lining.csv")).size() == static_cast<std::size_t>(chosen));
    CHECK(r.outcome.out.find("123 nodes on the full ring, 0.102 m apart, chosen for the bond") !=
          std::string::npos);
    // Given, or without a bond, it says nothing of them.
    CHECK_FALSE(supported_results().json.at("lining").contains("nodes_chosen_for_the_bond"));
    const Results given = ended_well(input.text(), {"--set", "support.lining.nodes=60"});
    CHECK(table(given.files.at("lining.csv")).size() == 60);
    CHECK_FALSE(given.json.at("lining").contains("nodes_chosen_for_the_bond"));
  }

  TEST_CASE("a horseshoe, a polygon and a partial lining run") {
    InputText horseshoe, polygon, arch;
    horseshoe.shape = "shape = \"horseshoe\"\nwidth = \"4 m\"\nwall_height = \"2 m\"\n";
    const Results h = ended_well(horseshoe.text());
    CHECK(crown(h) > 0);
    CHECK(h.json.at("lining").at("mean_thrust_kN_per_m") > 0);

    polygon.shape =
        "shape = \"polygon\"\nvertices = [[\"-2 m\", \"1 m\"], [\"0 m\", \"2.2 m\"], "
        "[\"2 m\", \"1 m\"], [\"2 m\", \"-1.5 m\"], [\"-2 m\", \"-1.5 m\"]]\n";  // clockwise
    const Results p = ended_well(polygon.text(), {"--set", "support.bolts.spacing=1 m"});
    CHECK(crown(p) > 0);
    CHECK(p.json.at("bolts").at("count") >= 5);

    arch.lining += "arc = [\"0 deg\", \"180 deg\"]\n";
    const Results a = ended_well(arch.text());
    CHECK(table(a.files.at("lining.csv")).size() == 12);  // half of 24 nodes
  }

  TEST_CASE("without support there is neither a bolts nor a lining entry") {
    const Results& r = bare_results();
    CHECK_FALSE(r.json.contains("bolts"));
    CHECK_FALSE(r.json.contains("lining"));
    CHECK(table(r.files.at("bolts.csv")).empty());
    CHECK(table(r.files.at("lining.csv")).empty());
    CHECK(crown(r) > crown(supported_results()));
  }

  TEST_CASE(
      "rock without joints is one block: it rises by the weight taken out, its bolts hold nothing") {
    InputText massive;
    massive.joints = "";
    const Results r = ended_well(massive.text());
    CHECK(r.json.at("rock").at("bodies") == 1);
    CHECK(r.json.at("rock").at("contacts") == 0);
    // A 24-gon of 2 m radius, on 24 m of base springs; the crown is read within 12 degrees, on the
    // parts of the two facets beside it that rays every 6 degrees cut: the middle fifth of their
    // length. On a facet, whose middle is 7.5 degrees off, they lie between 7.5 and 1.5 degrees on
    // the one side of it and between 1.5 and 4.5 degrees on both.
    constexpr double deg = std::numbers::pi / 180;
    const double removed = 12 * 2 * 2 * std::sin(15 * deg);
    const double rise = 2700 * 9.81 * removed / (5e9 * 24);
    const double far = std::tan(7.5 * deg), near = std::tan(1.5 * deg),
                 beyond = std::tan(4.5 * deg);
    const double first = std::cos(7.5 * deg - std::atan(0.5 * (far + near))),
                 second = std::cos(7.5 * deg + std::atan(0.5 * (beyond - near)));
    const double of_first = (far - near) / (far + beyond);  // of the length
    const double mean = ((of_first - 0.4) * first + (0.6 - of_first) * second) / 0.2;
    CHECK(std::abs(crown(r) + 1e3 * rise * mean) < 1e-6 * 1e3 * rise);
    CHECK(table(r.files.at("bolts.csv")).empty());
    CHECK(r.files.at("run.json").find("7 of 7 bolts cross no joint") != std::string::npos);
  }

  TEST_CASE("endless horizontal and vertical sets make a wall of rectangles") {
    InputText masonry;
    masonry.joints =
        "[[joint_set]]\ndip = \"0 deg\"\ndip_direction = \"E\"\nspacing = \"1 m\"\n"
        "[[joint_set]]\ndip = \"90 deg\"\ndip_direction = \"W\"\nspacing = \"1 m\"\n";
    masonry.bolts = masonry.lining = "";
    const Results r = ended_well(masonry.text(), {"--set", "joint.friction=60 deg"});
    // 24 m x 20 m cut at every metre, from a random first joint on.
    CHECK(r.json.at("rock").at("median_block_area_m2") == near(1.0));
    CHECK(r.json.at("rock").at("joints") >= 43);
    CHECK(crown(r) > 0);
  }

  // Joints in a file: the tunnel is |z| < 2 m, the bolt runs from (0, 2) to (0, 4).
  TEST_CASE("a bolt along a joint, through a crossing of joints and inside one block is ordinary") {
    InputText mapped;
    mapped.joints = "[joints]\nfile = \"traces.csv\"\n";
    mapped.bolts =
        replaced(mapped.bolts, "\"30 deg\"", "\"90 deg\"") + "arc = [\"80 deg\", \"100 deg\"]\n";
    struct Case {
      std::string traces;
      std::size_t crossings;
    };
    for (const Case& given : {
             Case{"x1,y1,x2,y2\n0,1,0,9\n-5,3,5,3\n", 1},        // along x = 0, past (0, 3)
             Case{"-3,0,3,6\r\n\r\n3,0,-3,6\r\n", 1},            // from one wedge into the opposite
             Case{"# one joint\n-5,-5,5,-5\n", 0},               // far below
             Case{"-5,2.5,5,2.5\n-5,3,5,3\n-5,3.5,5,3.5\n", 3},  // three beds
         }) {
      CAPTURE(given.traces);
      // Slabs right across the domain are longer than the limit of the other tests.
      const Results r =
          ended_well(mapped.text(), {"--set", "blocks.max_elongation=1000"}, given.traces);
      CHECK(table(r.files.at("bolts.csv")).size() == given.crossings);
      for (const auto& row : table(r.files.at("bolts.csv")))
        CHECK(std::abs(std::stod(row.at("x_m"))) < 1e-9);
    }
  }

  TEST_CASE("joints that coincide cut once, and those that cut nothing are counted") {
    InputText mapped;
    mapped.joints = "[joints]\nfile = \"traces.csv\"\n";
    const Results once = ended_well(mapped.text(), {}, "-9,4,9,4\n");
    const Results twice = ended_well(mapped.text(), {}, "-9,4,9,4\n-9,4,9,4\n9,4,-5,4\n");
    CHECK(once.json.at("rock").at("bodies") == 2);
    CHECK(twice.json.at("rock").at("bodies") == 2);
    CHECK(once.json.at("rock").at("joints_that_cut_nothing") == 0);
    CHECK(twice.json.at("rock").at("joints_that_cut_nothing") == 2);
    CHECK(crown(once) == crown(twice));
  }

  TEST_CASE("a joint set can have mechanics of its own") {
    const auto with = [](const char* lines) {
      InputText given;
      given.joints += lines;
      return ended_well(given.text());
    };
    const Results &plain = supported_results(), same = with("friction = \"35 deg\"\n"),
                  soft = with("kn = \"1 GPa/m\"\nks = \"0.1 GPa/m\"\n");
    CHECK(without_run_id(plain.files.at("lining.csv")) ==
          without_run_id(same.files.at("lining.csv")));
    CHECK(std::abs(crown(soft)) > 1.2 * std::abs(crown(plain)));
  }

  TEST_CASE("mapped joints are moved by the site coordinates of the tunnel") {
    InputText mapped;
    mapped.joints = "[joints]\nfile = \"traces.csv\"\n";
    const Results local = ended_well(mapped.text(), {}, "-9,4,9,4\n-5,-6,7,6\n");
    const Results site = ended_well(
        replaced(mapped.text(), "seed = 3", "seed = 3\norigin = [\"500000 m\", \"1200 m\"]"), {},
        "499991,1204,500009,1204\n499995,1194,500007,1206\n");
    CHECK(without_run_id(local.files.at("lining.csv")) ==
          without_run_id(site.files.at("lining.csv")));
  }

  TEST_CASE("the other methods find the same tunnel") {
    const std::vector<std::string> coarse = {"--set", "blocks.min_inscribed_radius=0.35 m"};
    const auto with = [&](const std::string& method) {
      auto arguments = coarse;
      arguments.insert(arguments.end(), {"--set", "run.method=" + method});
      return ended_well(supported, arguments);
    };
    const Results two_level = ended_well(supported, coarse);
    const Results relaxation = with("relaxation"), explicit_ = with("explicit");
    CHECK(relaxation.json.at("models").get<std::string>().ends_with("Relaxation"));
    CHECK(explicit_.json.at("models").get<std::string>().ends_with("Explicit"));
    // Slip made on the way stays, so both overshoot a little.
    CHECK(std::abs(crown(relaxation) - crown(two_level)) < 0.05 * crown(two_level));
    CHECK(std::abs(crown(explicit_) - crown(two_level)) < 0.05 * crown(two_level));
    CHECK(std::abs(thrust(explicit_) - thrust(two_level)) < 0.05 * thrust(two_level));
  }

  TEST_CASE("an interrupted run ends with status 130 and writes nothing") {
    const Folder folder;
    const std::string pipe_name = folder / "case.toml", out = folder / "out";
    REQUIRE(mkfifo(pipe_name.c_str(), 0600) == 0);
    // Explicit stepping without damping never comes to rest.
    Running running({"run", pipe_name, "--out", out, "--set", "run.method=explicit", "--set",
                     "run.damping=0", "--set", "run.max_steps=2000000000"});
    // Opening waits until the program reads its input: from then on it listens to signals.
    write_file(pipe_name, supported);
    running.signal(SIGINT);
    const Outcome outcome = running.wait();
    CHECK(outcome.status == 130);
    CHECK(outcome.out.empty());
    CHECK_FALSE(std::filesystem::exists(out));
  }

  TEST_CASE("what finds no answer is reported as undecided, status 3, with its reason") {
    const Folder folder;
    const Outcome outcome =
        run_program({"run", write_file(folder / "case.toml", supported), "--out", folder / "out",
                     "--set", "run.displacement_limit=0.001 mm"});
    CHECK(outcome.status == 3);
    const Json json = Json::parse(read_file(folder / "out/run.json"));
    CHECK(json.at("verdict") == "undecided");
    CHECK(json.at("stages")
              .back()
              .at("equilibrium")
              .at("reason")
              .get<std::string>()
              .find("raise displacement_limit") != std::string::npos);
  }

  TEST_CASE("joints a thousandfold too soft are undecided, and named") {
    // It was "stable", the crown 0.8 m down, status 0.
    const Folder folder;
    const Outcome outcome =
        run_program({"run", write_file(folder / "case.toml", bare), "--out", folder / "out",
                     "--set", "joint.kn=5 MPa/m", "--set", "tunnel.cover=100 m"});
    CHECK(outcome.status == 3);
    const Json json = Json::parse(read_file(folder / "out/run.json"));
    CHECK(json.at("verdict") == "undecided");
    const auto reason = json.at("stages").back().at("equilibrium").at("reason").get<std::string>();
    CAPTURE(reason);
    CHECK(reason.find("a joint closes by p0/k_n = ") != std::string::npos);
    CHECK(reason.find("the joint stiffness (k_n = 5 MPa/m") != std::string::npos);
    CHECK((outcome.out + outcome.err).find("k_n = 5 MPa/m") != std::string::npos);
  }

  TEST_CASE("rock that detached from a tunnel that stands is in every word about it [long]") {
    const Results& r = bare_results();
    const double area = r.json.at("detached_area_m2");
    REQUIRE(area > 0.1);  // a block of 0.2 m2 falls from the roof
    CHECK(r.json.at("verdict") == "stable after rockfall");
    CHECK(r.json.at("stages")[0].at("equilibrium").at("verdict") == "stable after rockfall");
    char fallen[32];
    std::snprintf(fallen, sizeof fallen, "%.2f m", area);
    CHECK(r.outcome.out.find("stable after rockfall of " + std::string(fallen) + "2: ") !=
          std::string::npos);
    const std::string& picture = r.files.at("blocks.svg");
    CHECK(picture.find("STABLE AFTER ROCKFALL") != std::string::npos);
    CHECK(picture.find("Verdict: stable after rockfall of " + std::string(fallen)) !=
          std::string::npos);
    // Which blocks, from where, how much to scale; and what other limits and rates say.
    double listed = 0;
    for (const Json& block : r.json.at("detached_blocks")) {
      listed += block.at("area_m2").get<double>();
      CHECK(block.at("from") == "crown");
      CHECK(block.at("y_m") > 0.0);
    }
    CHECK(listed == near(area));
    char tonnes[64];
    std::snprintf(tonnes, sizeof tonnes, "scale %.1f t per metre down", 2.7 * area);
    CHECK(r.outcome.out.find(tonnes) != std::string::npos);
    // Its lines are broken anywhere.
    const std::string words =
        std::regex_replace(picture, std::regex("</text>\\s*<text[^>]*>"), " ");
    CHECK(words.find(tonnes) != std::string::npos);
    const Json& range = r.json.at("rockfall");
    CHECK(range.at("least_detached_area_m2") <= area);
    CHECK(range.at("most_detached_area_m2") >= area);

    // The same when it detached in an earlier stage than the last.
    InputText in_stages = without_support();
    in_stages.rest =
        "[[stage]]\nwall_traction = 0.01\n[[stage]]\nwall_traction = \"0 %\"\nname = \"end\"\n";
    const Results staged = ended_well(in_stages.text());
    REQUIRE(staged.json.at("stages")[1].at("equilibrium").at("detached_area_m2") == 0.0);
    CHECK(staged.json.at("stages")[1].at("equilibrium").at("verdict") == "stable");
    CHECK(staged.json.at("verdict") == "stable after rockfall");

    const Results& stands = supported_results();
    CHECK(stands.json.at("verdict") == "stable");
    CHECK(stands.files.at("blocks.svg").find("ROCKFALL") == std::string::npos);
    CHECK(stands.files.at("blocks.svg").find("banner") == std::string::npos);
  }

  TEST_CASE("a diagram calls a tunnel that stands after rock has detached so") {
    const Folder folder;
    InputText input;
    input.rest = "[diagram]\nspacing = [\"30 deg\", \"none\"]\nthickness = [\"0 cm\", \"8 cm\"]\n";
    const Outcome outcome = run_program(
        {"diagram", write_file(folder / "case.toml", input.text()), "--out", folder / "out"});
    REQUIRE(outcome.status == 0);
    const auto rows = table(read_file(folder / "out/interaction.csv"));
    REQUIRE(rows.size() == 4);
    CHECK(rows[1].at("verdict") == "stable");
    CHECK(rows[2].at("verdict") == "stable after rockfall");
    CHECK(rows[2].at("failed") == "1");
    // `run` and `diagram` have one answer to whether it is marginal.
    const bool is_marginal = bare_results().json.at("rockfall").at("marginal");
    CHECK(rows[2].at("marginal") == (is_marginal ? "1" : "0"));
    CHECK((outcome.out.find("R~") != std::string::npos) == is_marginal);
    CHECK((outcome.out.find("\n~: marginal, ") != std::string::npos) == is_marginal);
    CHECK(outcome.out.find("R: stable after rockfall, C: collapse, ?: undecided\n") !=
          std::string::npos);
    CHECK(read_file(folder / "out/interaction.svg").find("UNDECIDED") == std::string::npos);
  }

  TEST_CASE(
      "a stage that ends before it is unloaded says what was reached and what was asked for") {
    const Folder folder;
    const Outcome outcome =
        run_program({"run", write_file(folder / "case.toml", bare), "--out", folder / "out",
                     "--set", "run.displacement_limit=0.001 mm"});
    CAPTURE(outcome.out);
    const Json stage = Json::parse(read_file(folder / "out/run.json")).at("stages").back();
    const double reached = stage.at("residual_wall_traction");
    CHECK(stage.at("residual_wall_traction_asked") == 0.0);
    REQUIRE(reached > 0.0);  // the limit is below the elastic movement: nothing is begun
    char words[160];
    std::snprintf(words, sizeof words,
                  "undecided at a residual wall traction of %.3g %%, ended on the way to the 0 %% "
                  "asked for",
                  100 * reached);
    CHECK(outcome.out.find(words) != std::string::npos);
    const Results& stands = supported_results();
    CHECK(stands.outcome.out.find("stable at a residual wall traction of 0 %;") !=
          std::string::npos);
    CHECK(stands.outcome.out.find("asked for") == std::string::npos);
  }

  TEST_CASE(
      "values at the ends of their ranges give a verdict, or are named where there is none [long]") {
    for (const char* set : {"model.gravity=1 m/s^2",
                            "run.tolerance=1e-6",
                            "run.tolerance=0.1",
                            "rock.density=1 kg/m^3",
                            "rock.density=100000 kg/m^3",
                            "joint.kn=1000 GPa/m",
                            "joint.ks=1 kPa/m",
                            "joint.ks=1000 GPa/m",
                            "support.bolts.stiffness=1 kN/m",
                            "support.bolts.stiffness=1000 GN/m",
                            "support.bolts.out_of_plane=1 cm",
                            "support.bolts.out_of_plane=1000 m",
                            "support.bolts.pretension=500 N",
                            "support.lining.E=1 MPa",
                            "support.lining.E=1000 GPa",
                            "support.lining.thickness=1 mm",
                            "support.lining.interface.kn=1 kPa/m",
                            "support.lining.interface.kn=1000 GPa/m",
                            "support.lining.interface.ks=1 kPa/m",
                            "support.lining.interface.ks=1000 GPa/m"}) {
      CAPTURE(set);
      (void)ended_well(supported, {"--set", set});
    }
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", supported);
    const Outcome soft =
        run_program({"run", file, "--out", folder / "out", "--set", "joint.kn=1 kPa/m"});
    CHECK(soft.status == 3);
    CHECK(soft.out.find("joint.kn = 1 kPa/m is unusual") != std::string::npos);
    // A hundred times the weight moves the rock a hundred times as far: the limits follow it.
    const Outcome heavy =
        run_program({"run", file, "--out", folder / "out", "--set", "model.gravity=1000 m/s^2"});
    CHECK((heavy.status == 0 || heavy.status == 6));
  }

  TEST_CASE("undecided is written across the pictures") {
    const Folder folder;
    InputText input;
    input.rest = "[diagram]\nspacing = [\"30 deg\", \"none\"]\nthickness = [\"0 cm\", \"8 cm\"]\n";
    const std::string file = write_file(folder / "case.toml", input.text());
    for (const std::string& verb : {std::string("run"), std::string("diagram")}) {
      const Outcome outcome =
          run_program({verb, file, "--out", folder / "out", "--set",
                       "run.displacement_limit=0.00001 mm", "--set", "joint.kn=500 GPa/m"});
      CHECK(outcome.status == 3);
      // And the value to look at is named.
      CHECK(outcome.out.find("joint.kn = 500 GPa/m is unusual") != std::string::npos);
    }
    const std::string blocks = read_file(folder / "out/blocks.svg");
    CHECK(blocks.find("id=\"banner\"") != std::string::npos);
    CHECK(blocks.find(">UNDECIDED<") != std::string::npos);
    const std::string diagram = read_file(folder / "out/interaction.svg");
    CHECK(diagram.find(">4 OF 4 TUNNELS UNDECIDED<") != std::string::npos);
    CHECK(diagram.find("undecided: no result") != std::string::npos);
    CHECK(diagram.find("blocks detach") == std::string::npos);  // nobody knows
  }

  TEST_CASE("a tunnel that collapses has a status of its own, verdict and reason") {
    const Folder folder;
    const Outcome outcome =
        run_program({"run", write_file(folder / "case.toml", bare), "--out", folder / "out",
                     "--set", "joint.friction=2 deg", "--set", "run.displacement_limit=5 cm"});
    INFO(outcome.out);
    CHECK(outcome.status == 7);
    const Json json = Json::parse(read_file(folder / "out/run.json"));
    CHECK(json.at("verdict") == "collapse");
    CHECK(json.at("detached_area_m2") > 0.0);
    CHECK(read_file(folder / "out/blocks.svg").find(">COLLAPSE<") != std::string::npos);
  }
}

}  // namespace program_run_test
