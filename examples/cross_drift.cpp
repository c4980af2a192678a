// SPDX-License-Identifier: MIT
// A tunnel in two rounds with ribs, a cross-drift out of its wall that ends in the rock, and a
// shaft from the surface: openings along three axes, each round with its own residual wall
// traction. What is known beforehand: the rock taken out, and that the ribs of the second round
// carry on those of the first.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

using Site = Solver<Spatial, CoulombJoint, LorigAnchors, TimoshenkoBeam>;

namespace {

constexpr double deg = std::numbers::pi / 180;
const Domain<3> ground{{-9, 0, -8}, {9, 8, 8}};

// Places along y for the tunnel; East of the point (0, 4, 0) for the drift; below its collar on the
// surface for the shaft.
const PrismaticOpening first(circular_opening(4, 24), -1, 4), second(circular_opening(4, 24), 4, 9);
const PrismaticOpening drift(horseshoe_opening(2, 0.8, 24), TunnelAxis({0, 4, 0}, 90 * deg), 0, 6);
const PrismaticOpening shaft(circular_opening(2, 12), TunnelAxis({-6, 4, 8}, 0, 90 * deg), 0, 5);

Site rock() {
  SpatialJointSet steep{"J1", 75 * deg, 90 * deg}, flat{"J2", 20 * deg, 90 * deg},
      cross{"J3", 80 * deg, 5 * deg};
  for (SpatialJointSet* set : {&steep, &flat, &cross}) set->spacing = 2.5;
  return {slice<Spatial>(ground, joint_network({steep, flat, cross}, ground, 1),
                         {.min_inscribed_radius = 0.2}),
          CoulombJoint({.joint_normal_stiffness = 5e9,
                        .joint_shear_stiffness = 5e8,
                        .friction_angle = 45 * deg}),
          {.density = 2700, .surcharge = 3e5}};
}

/// Ribs at 1 m over a stretch of the tunnel, places along y [m].
LiningInstallation<Site> ribs(double from, double to) {
  return {{.ring = {.nodes = 24}, .spacing = 1, .from = from, .to = to},
          {LiningSection::strip(0.2, 1, 25e9), LiningSection::strip(0.2, 0.5, 25e9)},
          CoulombJoint({1e10, 1e10, 35 * deg})};
}

}  // namespace

int main() {
  Site site = rock();
  Construction<Site> plan;
  plan.add_stage("first round", 0.4).excavate(first, 0);
  plan.add_stage("its ribs").install_lining(ribs(0, 4));
  plan.add_stage("second round", 0.4).excavate(second, 0);
  plan.add_stage("more ribs").install_lining(ribs(4, 8));
  plan.add_stage("shaft").excavate(shaft, 0);
  const auto built = construct(site, plan);
  for (const auto& stage : built.stages)
    std::printf("%-13s %s, crown %.2f mm\n", stage.name.c_str(), to_string(stage.report),
                1e3 * stage.convergence.crown);
  // 8 ribs of 24 members, tied by 7 x 24.
  const std::size_t members = lining_members(site).size();
  const double taken = site.mass().carving.removed_measure,
               expected = 8 * first.section().area() + 5 * shaft.section().area();

  Site unlined = rock();
  Construction<Site> branch;
  branch.add_stage("tunnel").excavate(first, 0).excavate(second, 0);
  branch.add_stage("drift").excavate(drift, 0);
  const auto branched = construct(unlined, branch);
  std::printf("%-13s %s, crown of the drift %.2f mm\n", "cross-drift", to_string(branched.last()),
              1e3 * convergence(unlined, drift).crown);
  std::printf("%.2f m^3 taken out, %zu members\n", taken, members);
  return std::abs(taken / expected - 1) < 1e-9 && members == 8 * 24 + 7 * 24 &&
                 built.verdict() == Verdict::stable && branched.verdict() == Verdict::stable
             ? 0
             : 1;
}
