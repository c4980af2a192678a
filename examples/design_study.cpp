// SPDX-License-Identifier: MIT
// A tunnel as plain data: three bolt lengths, in the same three realisations of the rock, side by
// side. What an input file describes is this (docs/input.md); here a program fills it in.
#include <array>
#include <cstdio>
#include <numbers>
#include <vector>
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/realisations.hpp>
using namespace voussoir;

constexpr double degree = std::numbers::pi / 180;

design::AnalysisInput tunnel_of_6_m() {
  design::AnalysisInput input;
  input.model = {.width = 32, .below_invert = 8};
  input.tunnel.diameter = 6;
  input.tunnel.cover = 15;
  input.rock.density = 2650;
  input.stress.K0 = 0.7;
  for (const auto& [dip, towards] : {std::array{70.0, 90.0}, {30.0, 90.0}, {25.0, 270.0}}) {
    auto& set = input.joint_sets.emplace_back();
    set.name = "set " + std::to_string(input.joint_sets.size());
    set.plane = {dip * degree, towards * degree};
    set.sd = 3 * degree;
    set.spacing = 1.1;
  }
  input.joint = CoulombJoint({5e9, 0.5e9, 38 * degree});
  input.blocks.min_inscribed_radius = 0.2;
  auto& bolts = input.bolts.emplace_back();
  bolts.name = "roof";
  bolts.length = 3;
  bolts.spacing = {1.2, false};  // m
  bolts.arc = {0, std::numbers::pi};
  bolts.stiffness = 0.2e9;
  bolts.yield_force = 250e3;
  bolts.anchor_offset = 0.03;
  input.stages.push_back({.name = "excavated and bolted", .part = SectionPart{}, .bolts = {0}});
  return input;
}

int main() {
  const std::vector<double> lengths{1.5, 3, 4.5};
  using Results = std::vector<design::TunnelResult>;
  // The rock of a seed is made once, and every design is built in it.
  const std::vector<Results> found =
      realise({.count = 3, .first_seed = 1, .threads = 2}, [&](std::uint64_t seed) {
        design::AnalysisInput input = tunnel_of_6_m();
        input.model.seed = seed;
        const auto rock = design::excavated_rock(input, design::rock_of(input), false);
        Results results;
        for (const double length : lengths) {
          input.bolts[0].length = length;
          results.push_back(design::supported_tunnel(input, rock, design::supports_of(input)));
        }
        return results;
      });
  bool all_decided = true;
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    RealisedQuantity crown, share;
    for (const Results& of_seed : found) {
      const design::TunnelResult& one = of_seed[k];
      crown.add(one.verdict, one.fallen, one.convergence.crown);
      share.add(one.verdict, one.fallen, one.of_bolt_strength);
      all_decided = all_decided && one.is_decided();
    }
    std::printf("bolts of %.1f m: crown %s; largest bolt force over its strength %s\n", lengths[k],
                crown.text(1e3, "mm").c_str(), share.text(1, "").c_str());
  }
  return all_decided ? 0 : 1;
}
