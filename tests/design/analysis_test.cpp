// SPDX-License-Identifier: MIT
// An analysis that is data is the one that is composed by hand, in 2-D and 3-D; and what does not
// fit together is refused before anything is computed.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/literals.hpp>
#include <voussoir/design/analysis.hpp>
#include <voussoir/voussoir.hpp>

#include "support/near.hpp"

namespace design_analysis_test {
namespace {

using namespace voussoir;
using namespace voussoir::literals;
using voussoir_test::near;

constexpr double degree = std::numbers::pi / 180;

/// A circle of 6 m in three sets of joints, bolted and lined.
design::AnalysisInput circle(int dimension, std::uint64_t seed) {
  design::AnalysisInput input;
  input.model = {.dimension = dimension,
                 .length = dimension == 3 ? 3.0 : 0.0,
                 .width = 26,
                 .below_invert = 8,
                 .seed = seed};
  input.tunnel.diameter = 6;
  input.tunnel.facets = 36;
  input.tunnel.cover = 12;
  if (dimension == 3) input.tunnel.trend = 0;
  input.rock.density = 2700;
  input.stress.K0 = 0.8;
  input.boundary.sides = input.boundary.base = Boundary::rollers;
  const double dips[] = {72, 28, 31}, towards[] = {90, 90, 270};
  for (int k = 0; k < 3; ++k) {
    auto& set = input.joint_sets.emplace_back();
    set.name = "J" + std::to_string(k);
    set.plane = {dips[k] * degree, towards[k] * degree};
    set.sd = 2 * degree;
    set.is_azimuth = dimension == 3;
    set.spacing = dimension == 3 ? 2.4 : 1.4;
  }
  input.joint = CoulombJoint({5_GPa_per_m, 0.5_GPa_per_m, 35_deg});
  input.blocks.min_inscribed_radius = 0.2;
  input.blocks.min_wall_area = 0.05;
  auto& bolts = input.bolts.emplace_back();
  bolts.name = "bolts";
  bolts.length = 3;
  bolts.spacing = {20 * degree, true};
  bolts.arc = {0, std::numbers::pi};
  bolts.stiffness = 0.2e9;
  bolts.yield_force = 300e3;
  bolts.anchor_offset = 0.0336;
  auto& lining = input.linings.emplace_back();
  lining.name = "lining";
  lining.thickness = 0.1;
  lining.young_modulus = 25e9;
  lining.interface_normal_stiffness = lining.interface_shear_stiffness = 1e9;
  lining.interface_friction_angle = 30 * degree;
  lining.nodes = 36;
  input.stages.push_back({.name = "all", .part = SectionPart{}, .bolts = {0}, .linings = {0}});
  return input;
}

/// What of a tunnel is compared.
struct Answer {
  std::size_t blocks;
  Verdict verdict;
  double fallen, crown, thrust, bolt;
};

template <class Solver>
Answer answer_of(const Solver& tunnel, Verdict verdict, double fallen, const Convergence& moved) {
  const SupportDemand demand = support_demand(tunnel);
  return {tunnel.mass().bodies.size(), verdict, fallen, moved.crown, demand.largest_thrust,
          demand.largest_bolt_force};
}

void check_same(const Answer& data, const Answer& composed) {
  CHECK(data.blocks == composed.blocks);
  CHECK(data.verdict == composed.verdict);
  // One arithmetic, in one order: to the last bit.
  CHECK(data.fallen == composed.fallen);
  CHECK(data.crown == composed.crown);
  CHECK(data.thrust == composed.thrust);
  CHECK(data.bolt == composed.bolt);
  CHECK(data.crown > 0);
  CHECK(data.thrust > 0);
  CHECK(data.bolt > 0);
}

const AxialBolt bolt({.axial_stiffness = 0.2_GN_per_m, .yield_force = 300_kN});
// Of this law friction alone is another order of the same arithmetic than of CoulombJoint.
const MohrCoulombJoint on_lining({1_GPa_per_m, 1_GPa_per_m, 30_deg});
using OnLining = RockOnLining<MohrCoulombJoint>;
const BoltPattern pattern{.length = 3, .angular_spacing = 20 * degree, .to = std::numbers::pi};

/// As `circle`, by the solver of its models and nothing of design/.
Answer composed_section(std::uint64_t seed) {
  using Tunnel =
      Solver<Planar, CoulombJoint, OnLining, LorigAnchors, AxialBolt, EulerBernoulliBeam>;
  const SimplePolygon opening = circular_opening(6, 36);
  const Domain<2> ground = domain_around(opening, 26, 12, 8);
  std::vector<JointSet> sets;
  const double dips[] = {72, 28, 31};
  for (int k = 0; k < 3; ++k) {
    JointSet set{"J" + std::to_string(k), dips[k] * degree,
                 k == 2 ? DipDirection::west : DipDirection::east, 2 * degree};
    set.spacing = 1.4;
    set.extent = std::numeric_limits<double>::infinity();
    sets.push_back(set);
  }
  Tunnel tunnel(slice(ground, joint_network(sets, ground, seed), {0.2}),
                CoulombJoint({5_GPa_per_m, 0.5_GPa_per_m, 35_deg}), {.density = 2700, .k0 = 0.8});
  tunnel.excavate(opening, 0.05);
  for (const Segment& bar : bolt_bars(pattern, opening))
    tunnel.install_bolt(bar, bolt, 1, LorigAnchors{0.0336});
  tunnel.install_lining(lining_frame(tunnel.mass(), {.nodes = 36}),
                        LiningSection::rectangular(0.1, 25e9, 0.2), on_lining);
  Acceptance acceptance;
  acceptance.collapse_measure = 0.25 * opening.area();
  const auto report = tunnel.equilibrium(0.0, Tunnel::Method(), acceptance);
  return answer_of(tunnel, report.verdict, report.fallen_measure, convergence(tunnel));
}

Answer composed_space(std::uint64_t seed) {
  using Tunnel =
      Solver<Spatial, CoulombJoint, OnLining, LorigAnchors, AxialBolt, EulerBernoulliBeam>;
  const SimplePolygon section = circular_opening(6, 36);
  const Domain<2> across = domain_around(section, 26, 12, 8);
  const Domain<3> ground{{across.low.x(), 0, across.low.y()},
                         {across.high.x(), 3, across.high.y()}};
  std::vector<SpatialJoint> joints;
  const double dips[] = {72, 28, 31}, towards[] = {90, 90, 270};
  for (int k = 0; k < 3; ++k) {
    SpatialJointSet set{"J", dips[k] * degree, towards[k] * degree};
    set.dip_deviation = 2 * degree;
    set.spacing = 2.4;
    for (const SpatialJoint& joint : generate(set, k, ground, seed))
      joints.push_back({joint.trace, k});
  }
  Random(seed, 0).shuffle(joints);
  Tunnel tunnel(slice<Spatial>(ground, joints, {0.2}),
                CoulombJoint({5_GPa_per_m, 0.5_GPa_per_m, 35_deg}), {.density = 2700, .k0 = 0.8});
  const PrismaticOpening opening(section, TunnelAxis(Vec3::Zero(), 0));
  tunnel.excavate(opening, 0.05 * std::sqrt(0.05));
  for (const SpatialLine& bar : bolt_bars(pattern, opening, 1, 0, 3))
    tunnel.install_bolt(bar, bolt, 1, LorigAnchors{0.0336});
  const LiningRibs ribs{.ring = {.nodes = 36}, .spacing = 1, .from = 0, .to = 3};
  tunnel.install_lining(lining_frame(tunnel.mass(), ribs),
                        {LiningSection::strip(0.1, 1, 25e9, 0.2),
                         LiningSection::strip(0.1, section.perimeter() / 36, 25e9, 0.2)},
                        on_lining);
  Acceptance acceptance;
  acceptance.collapse_measure = 0.25 * section.area();
  const auto report = tunnel.equilibrium(0.0, Tunnel::Method(), acceptance);
  return answer_of(tunnel, report.verdict, report.fallen_measure, convergence(tunnel));
}

/// The message with which an input is refused; empty: it is not.
std::string refusal(const std::function<void(design::AnalysisInput&)>& spoil, int dimension = 2) {
  design::AnalysisInput input = circle(dimension, 1);
  spoil(input);
  try {
    design::check_input(input, dimension);
    design::check_bolts(input, design::supports_of(input));
  } catch (const InvalidInput& fault) {
    return fault.what();
  }
  return "";
}

bool names(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos) {
      MESSAGE("\"" << text << "\" does not have \"" << part << "\"");
      return false;
    }
  return true;
}

}  // namespace

TEST_SUITE("design/analysis") {
  TEST_CASE("a section that is data is the one that is composed by hand") {
    for (const std::uint64_t seed : {3U, 17U, 404U}) {
      CAPTURE(seed);
      const auto run = design::run_tunnel(circle(2, seed));
      check_same(answer_of(run.tunnel, run.verdict(), run.fallen_measure(), run.convergence()),
                 composed_section(seed));
      CHECK(run.in_situ_out_of_balance < 1e-9);
    }
  }

  TEST_CASE("a tunnel in 3-D that is data is the one that is composed by hand") {
    for (const std::uint64_t seed : {5U, 29U}) {
      CAPTURE(seed);
      const auto run = design::run_spatial_tunnel(circle(3, seed));
      check_same(answer_of(run.tunnel, run.verdict(), run.fallen_measure(), run.convergence()),
                 composed_space(seed));
    }
  }

  TEST_CASE("one tunnel among many is the run by itself") {
    const design::AnalysisInput input = circle(2, 17);
    const auto run = design::run_tunnel(input);
    const design::ExcavatedRock rock = design::excavated_rock(input, design::rock_of(input), false);
    // The rock is as it was after one has been built in it.
    for (int k = 0; k < 2; ++k) {
      const design::TunnelResult result =
          design::supported_tunnel(input, rock, design::supports_of(input));
      CHECK_FALSE(result.failed);
      CHECK(result.verdict == run.verdict());
      CHECK(result.convergence.crown == run.convergence().crown);
      CHECK(result.demand.largest_thrust == support_demand(run.tunnel).largest_thrust);
      CHECK(result.of_bolt_strength ==
            near(support_demand(run.tunnel).largest_bolt_force / 300e3).epsilon(1e-12));
    }
    const design::TunnelResult bare = design::supported_tunnel(input, rock, {});
    CHECK(bare.demand.largest_thrust == 0);
    CHECK(bare.convergence.crown > run.convergence().crown);
  }

  TEST_CASE("what does not fit together is named with its value and what is accepted") {
    CHECK(refusal([](auto&) {}).empty());
    CHECK(refusal([](auto&) {}, 3).empty());
    CHECK(names(refusal([](auto& in) { in.model.dimension = 3; }), {"dimension", "3", "2"}));
    CHECK(names(refusal([](auto& in) { in.model.width = 0; }), {"width of the model", "0", "> 0"}));
    CHECK(names(refusal([](auto& in) { in.model.length = -2; }, 3), {"length of the model", "-2"}));
    CHECK(
        names(refusal([](auto& in) { in.tunnel.cover = std::nan(""); }), {"cover of the tunnel"}));
    CHECK(names(refusal([](auto& in) { in.rock.density = -1; }), {"density", "-1"}));
    CHECK(names(refusal([](auto& in) { in.run.out_of_balance = 0.2; }),
                {"out-of-balance", "0.2", "<= 0.1"}));
    CHECK(names(refusal([](auto& in) { in.boundary.base.reset(); }), {"boundary", "together"}));
    CHECK(names(refusal([](auto& in) { in.joint_sets[1].spacing.reset(); }),
                {"joint set 1", "J1", "must be one"}));
    CHECK(names(refusal([](auto& in) { in.joint_sets[2].p32 = 1; }), {"joint set 2", "2 of"}));
    CHECK(names(refusal([](auto& in) {
                  in.joint_sets[0].spacing.reset();
                  in.joint_sets[0].intensity = 1;
                }),
                {"joint set 0", "extent"}));
    CHECK(names(refusal([](auto& in) { in.stages.clear(); }), {"stages", "one or more"}));
    CHECK(names(refusal([](auto& in) {
                  in.stages[0].bolts = {0, 1};
                }),
                {"all, number of a pattern of bolts", "1", "below 1"}));
    CHECK(
        names(refusal([](auto& in) { in.stages[0].linings = {7}; }), {"number of a lining", "7"}));
    CHECK(names(refusal([](auto& in) { in.stages[0].wall_traction = 0.5; }),
                {"all", "0.5", "must be 0"}));
    CHECK(names(refusal([](auto& in) { in.stages[0].wall_traction = 1.5; }), {"1.5", "0 to 1"}));
    CHECK(names(refusal([](auto& in) { in.stages[0].part.reset(); }), {"excavates"}));
    CHECK(names(refusal([](auto& in) { in.stages[0].opening = 1; }), {"opening", "below 1"}));
    CHECK(names(refusal([](auto& in) {
                  in.openings.emplace_back().name = "drift";
                  in.openings.back().diameter = 3;
                  in.openings.back().at = Vec2(4, 0);
                }),
                {"drift", "rock of the tunnel"}));
    CHECK(names(refusal([](auto& in) { in.bolts[0].length = 40; }),
                {"bolts: a bolt would end at", "could be 10 m long", "must end within"}));
    design::AnalysisInput without_law = circle(2, 1);
    without_law.joint.reset();
    CHECK_THROWS_WITH_AS((void)design::laws_of(without_law),
                         doctest::Contains("its joints have no law"), InvalidInput);
  }
}

}  // namespace design_analysis_test
