// SPDX-License-Identifier: MIT
// In-situ stress as it is measured, and spacings as surveys report them, from an input file: two
// ways to say one thing are one answer, in 2-D and 3-D.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include <voussoir/drawing/number_text.hpp>

#include "harness.hpp"
#include "input.hpp"

namespace stress_test {

using namespace voussoir_test;
using namespace voussoir::program;

namespace {

/// A circle of 4 m; the joints strike along the tunnel, whatever its trend.
const std::string circle = R"(
[model]
length = "2 m"
width = "24 m"
below_invert = "10 m"
[tunnel]
shape = "circle"
diameter = "4 m"
cover = "10 m"
facets = 24
trend = "0 deg"
[rock]
density = "2700 kg/m^3"
[stress]
K0 = 1.5
surcharge = "2 MPa"
[[joint_set]]
dip = "70 deg"
dip_direction = "90 deg"
spacing = "1.4 m"
[[joint_set]]
dip = "20 deg"
dip_direction = "270 deg"
spacing = "1.4 m"
[joint]
kn = "5 GPa/m"
ks = "0.5 GPa/m"
friction = "60 deg"
[blocks]
min_inscribed_radius = "0.2 m"
min_wall_area = "0 m^2"
[boundary]
sides = "rollers"
base = "rollers"
)";

struct Wall {
  double crown, right;
};
Wall wall(std::vector<std::string> overrides, const std::string& text = circle) {
  const Folder folder;
  std::vector<std::string> arguments{"run", write_file(folder / "case.toml", text), "--out",
                                     folder / "out"};
  for (const std::string& one : overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(one);
  }
  const Outcome outcome = run_program(arguments);
  INFO(outcome.out);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto json = nlohmann::json::parse(read_file(folder / "out/run.json")).at("convergence");
  return {json.at("crown_mm").get<double>(), json.at("right_springing_mm").get<double>()};
}
void check_same(const Wall& a, const Wall& b, double tolerance) {
  CHECK(std::abs(a.crown - b.crown) <= tolerance * std::abs(b.crown));
  CHECK(std::abs(a.right - b.right) <= tolerance * std::abs(b.right));
}

std::string said_of(const std::vector<std::string>& overrides) {
  try {
    (void)read_input_text(circle, "case.toml", ".", overrides);
  } catch (const InputErrors& errors) {
    return errors.what();
  }
  return "";
}

}  // namespace

TEST_SUITE("program/stress") {
  TEST_CASE("two horizontal stresses: across the tunnel acts what lies across it") {
    // Along the tunnel the major one: the minor acts across. Across: the major one.
    const Wall minor = wall({"stress.K0=0.6"}), major = wall({"stress.K0=1.5"});
    CHECK(std::abs(minor.right - major.right) > 0.2 * major.right);
    check_same(wall({"stress.K0_minor=0.6", "stress.K0_trend=0 deg"}), minor, 1e-9);
    check_same(wall({"stress.K0_minor=0.6", "stress.K0_trend=90 deg"}), major, 1e-9);
    check_same(wall({"stress.K0_minor=1.5", "stress.K0_trend=33 deg"}), major, 1e-9);
    // At 45 degrees the mean of both.
    check_same(wall({"stress.K0_minor=0.6", "stress.K0_trend=45 deg"}), wall({"stress.K0=1.05"}),
               1e-6);
  }

  TEST_CASE("in 3-D, too; and turned with the tunnel and its joints it is the same") {
    const std::string spatial = "model.dimension=3";
    // Joints that strike along the tunnel: what acts along it does nothing to the section.
    const Wall minor = wall({spatial, "stress.K0=0.6"});
    check_same(wall({spatial, "stress.K0_minor=0.6", "stress.K0_trend=180 deg"}), minor, 2e-3);
    const Wall oblique = wall({spatial, "stress.K0_minor=0.6", "stress.K0_trend=30 deg"});
    const Wall turned =
        wall({spatial, "stress.K0_minor=0.6", "stress.K0_trend=70 deg", "tunnel.trend=40 deg",
              "joint_set[0].dip_direction=130 deg", "joint_set[1].dip_direction=310 deg"});
    check_same(turned, oblique, 1e-6);
  }

  TEST_CASE("a horizontal stress that does not grow with depth") {
    // Weightless to a hundredth: 0.5 sigma_v + a constant of 0.5 sigma_v is sigma_v.
    const std::vector<std::string> light{"rock.density=1 kg/m^3", "stress.surcharge=2 MPa"};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.end(), light.begin(), light.end());
      return wall(more);
    };
    const Wall by_ratio = with({"stress.K0=1"});
    check_same(with({"stress.K0=0.5", "stress.horizontal=1 MPa"}), by_ratio, 1e-3);
    check_same(with({"stress.K0=0", "stress.horizontal=2 MPa"}), by_ratio, 1e-3);
    // The same prism of rock in 3-D; the section's joints go on along it.
    const std::string section =
        replaced(replaced(replaced(circle, "trend = \"0 deg\"\n", ""), "\"90 deg\"", "\"E\""),
                 "\"270 deg\"", "\"W\"");
    check_same(wall({"model.dimension=3", "stress.K0=0.5", "stress.horizontal=1 MPa"}, section),
               wall({"stress.K0=0.5", "stress.horizontal=1 MPa"}, section), 5e-3);
  }

  TEST_CASE("spacings as a law: another rock, as many blocks in the mean") {
    const auto blocks = [](std::vector<std::string> overrides, int seed) {
      overrides.push_back("model.seed=" + std::to_string(seed));
      const Folder folder;
      std::vector<std::string> arguments{"check", write_file(folder / "case.toml", circle)};
      for (const std::string& one : overrides) {
        arguments.emplace_back("--set");
        arguments.push_back(one);
      }
      const Outcome outcome = run_program(arguments);
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
      return std::stod(outcome.out.substr(outcome.out.find("rock     ") + 9));
    };
    const std::vector<std::string> lognormal{
        "joint_set[0].spacing_law=lognormal", "joint_set[0].spacing_sd=0.7 m",
        "joint_set[1].spacing_law=lognormal", "joint_set[1].spacing_sd=0.7 m"};
    double fixed_sum = 0, sum = 0;
    for (int seed = 1; seed <= 10; ++seed) {
      const double fixed = blocks({}, seed), drawn = blocks(lognormal, seed);
      fixed_sum += fixed;
      sum += drawn;
    }
    // Half of the spacing as its deviation: counts of 17 joints spread by a tenth, of two sets and
    // ten seeds by 5 %; small blocks are refused.
    CHECK(std::abs(sum - fixed_sum) < 0.2 * fixed_sum);
    CHECK(sum != fixed_sum);
    (void)blocks({"model.dimension=3", "joint_set[0].spacing_law=exponential"}, 1);
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::vector<std::string>& overrides,
                            std::initializer_list<const char*> words) {
      const std::string said = said_of(overrides);
      CAPTURE(said);
      for (const char* word : words) CHECK(said.find(word) != std::string::npos);
    };
    refused({"stress.K0_minor=0.6"}, {"stress.K0_minor", "K0_trend"});
    refused({"stress.K0_trend=30 deg"}, {"stress.K0_trend", "K0_minor"});
    refused({"stress.K0_minor=1.6", "stress.K0_trend=30 deg"}, {"stress.K0_minor", "0 to 1.5"});
    refused({"stress.K0_minor=0.6", "stress.K0_trend=400 deg"}, {"stress.K0_trend", "360 deg"});
    refused({"stress.horizontal=-1 MPa"}, {"stress.horizontal", "from 0"});
    refused({"stress.horizontal=3"}, {"stress.horizontal", "unit"});
    refused({"joint_set[0].spacing_law=lognormal"}, {"joint_set[0].spacing_law", "spacing_sd"});
    refused({"joint_set[0].spacing_sd=0.4 m"}, {"joint_set[0].spacing_sd", "lognormal"});
    refused({"joint_set[0].spacing_law=lognormal", "joint_set[0].spacing_sd=5 m"},
            {"joint_set[0].spacing_sd", "4.2 m"});
    refused({"joint_set[0].spacing_law=exponential", "joint_set[0].extent=3 m"},
            {"joint_set[0].spacing_law", "extent"});
    refused({"joint_set[0].spacing_law=uniform"}, {"joint_set[0].spacing_law", "\"lognormal\""});
  }
}

}  // namespace stress_test
