// SPDX-License-Identifier: MIT
// What a file describes is the analysis that C++ fills in (design/), to the last bit.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/design/analysis.hpp>

#include "analysis.hpp"
#include "harness.hpp"
#include "input.hpp"

namespace analysis_data_test {
namespace {

using namespace voussoir;
using program::read_input;

constexpr double degree = std::numbers::pi / 180;

bool quiet(const std::string&, double) { return true; }

/// examples/paper/tunnel.toml
design::AnalysisInput design_case() {
  design::AnalysisInput input;
  input.model.width = 70;
  input.model.below_invert = 30;
  input.tunnel.diameter = 10;
  input.tunnel.cover = 20;
  input.rock.density = 2700;
  input.stress.K0 = 1;
  input.boundary.sides = input.boundary.base = Boundary::rollers;
  const double dips[] = {75, 25, 25}, towards[] = {90, 90, 270};
  for (int k = 0; k < 3; ++k) {
    design::JointSetInput& set = input.joint_sets.emplace_back();
    set.name = "J" + std::to_string(k + 1);
    set.plane = {dips[k] * degree, towards[k] * degree};
    set.sd = degree;
    set.intensity = 1;
    set.extent = 1;
  }
  input.joint = CoulombJoint({5e9, 0.5e9, 35 * degree});
  input.blocks = {.min_inscribed_radius = 0.25, .max_elongation = 5};
  design::BoltsInput& bolts = input.bolts.emplace_back();
  bolts.length = 4;
  bolts.spacing = {15 * degree, true};
  bolts.arc = {0, 180 * degree};
  bolts.stiffness = 0.2e9;
  bolts.rupture_force = 500e3;
  bolts.anchor_offset = 1.2 * bolts.diameter;
  design::LiningInput& lining = input.linings.emplace_back();
  lining.thickness = 0.1;
  lining.young_modulus = 25e9;
  lining.interface_normal_stiffness = lining.interface_shear_stiffness = 1e9;
  lining.interface_friction_angle = 30 * degree;
  input.stages.push_back({.name = "all", .part = SectionPart{}, .bolts = {0}, .linings = {0}});
  return input;
}

/// examples/rounds/horseshoe.toml, two rounds of it.
design::AnalysisInput horseshoe() {
  design::AnalysisInput input;
  input.model = {.dimension = 3, .length = 8, .width = 28, .below_invert = 8};
  input.tunnel.shape = design::TunnelShape::horseshoe;
  input.tunnel.width = 8;
  input.tunnel.wall_height = 4;
  input.tunnel.facets = 36;
  input.tunnel.cover = 10;
  input.tunnel.trend = 40 * degree;
  input.tunnel.round_length = 2;
  input.tunnel.rounds = 2;
  input.rock.density = 2700;
  input.stress.K0 = 0.8;
  input.stress.surcharge = 660e3;
  const double dips[] = {25, 75, 80}, towards[] = {130, 300, 40}, K[] = {300, 200, 200},
               spacings[] = {3, 3.2, 3};
  for (int k = 0; k < 3; ++k) {
    design::JointSetInput& set = input.joint_sets.emplace_back();
    set.name = k == 0 ? "bedding" : "J" + std::to_string(k);
    set.plane = {dips[k] * degree, towards[k] * degree};
    set.is_azimuth = true;
    set.fisher = K[k];
    set.spacing = spacings[k];
  }
  input.joint = CoulombJoint({5e9, 0.5e9, 35 * degree});
  input.blocks = {.min_inscribed_radius = 0.5, .min_wall_area = 0.05};
  design::BoltsInput& bolts = input.bolts.emplace_back();
  bolts.length = 4;
  bolts.spacing = {1.5, false};
  bolts.arc = {10 * degree, 170 * degree};
  bolts.stiffness = 0.2e9;
  bolts.yield_force = 250e3;
  bolts.anchor_offset = 1.2 * bolts.diameter;
  design::LiningInput& lining = input.linings.emplace_back();
  lining.thickness = 0.15;
  lining.young_modulus = 25e9;
  lining.interface_normal_stiffness = lining.interface_shear_stiffness = 5e9;
  lining.interface_friction_angle = 35 * degree;
  input.has_rounds = true;
  SectionPart heading, bench;
  heading.bottom = bench.top = -1;
  input.stages.push_back({.name = "heading", .part = heading});
  input.stages.push_back({.name = "bolts", .behind = 1, .bolts = {0}});
  input.stages.push_back({.name = "bench", .part = bench, .behind = 4});
  input.stages.push_back({.name = "shotcrete", .behind = 5, .linings = {0}});
  return input;
}

template <class FromFile, class FromData>
void check_same(const FromFile& file, const FromData& data) {
  CHECK(file.tunnel.mass().bodies.size() == data.tunnel.mass().bodies.size());
  CHECK(file.verdict() == data.verdict());
  CHECK(file.fallen_measure() == data.fallen_measure());
  CHECK(file.convergence().crown == data.convergence().crown);
  CHECK(std::isfinite(file.convergence().crown));
  const SupportDemand one = support_demand(file.tunnel), other = support_demand(data.tunnel);
  CHECK(one.largest_bolt_force == other.largest_bolt_force);
  CHECK(one.largest_thrust == other.largest_thrust);
  CHECK(one.largest_moment == other.largest_moment);
  REQUIRE(file.built.stages.size() == data.built.stages.size());
  for (std::size_t k = 0; k < file.built.stages.size(); ++k)
    CHECK(file.built.stages[k].convergence.crown == data.built.stages[k].convergence.crown);
}

}  // namespace

TEST_SUITE("program/analysis_data") {
  TEST_CASE("the design case") {
    const auto input =
        read_input(std::filesystem::path(VOUSSOIR_TEST_EXAMPLES) / "paper/tunnel.toml");
    check_same(program::run_of(input, quiet), design::run_tunnel(design_case()));
  }

  TEST_CASE("a horseshoe in heading and bench, two rounds of it in 3-D") {
    const auto input =
        read_input(std::filesystem::path(VOUSSOIR_TEST_EXAMPLES) / "rounds/horseshoe.toml",
                   {"model.length=8 m", "tunnel.rounds=2"});
    check_same(program::spatial_run_of(input, quiet), design::run_spatial_tunnel(horseshoe()));
  }
}

}  // namespace analysis_data_test
