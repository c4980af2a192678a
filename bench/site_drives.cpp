// SPDX-License-Identifier: MIT
// A site in 3-D: about 2 000 blocks of three random joint sets, a tunnel with bolts and ribs, then
// a cross-drift through its wall and its ribs. For every seed the verdict of every stage, what has
// come off and the wall time; fails where a seed is left undecided.
//   site_drives [first seed] [last seed] [fisher concentration] [friction angle in degrees]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/voussoir.hpp>

namespace {

using namespace voussoir;
using Site = Solver<Spatial, CoulombJoint, LorigAnchors, TimoshenkoBeam>;

constexpr double deg = std::numbers::pi / 180;

const Domain<3> ground{{-16, 0, -14}, {16, 14, 16}};
const PrismaticOpening tunnel(circular_opening(6, 24));
const PrismaticOpening drift(horseshoe_opening(3.5, 1.5, 24), TunnelAxis({0, 7, 0}, 90 * deg), 0,
                             11);

RockMass<Spatial> rock(std::uint64_t seed, double concentration) {
  SpatialJointSet steep{"J1", 75 * deg, 85 * deg}, flat{"J2", 25 * deg, 110 * deg},
      cross{"J3", 80 * deg, 5 * deg};
  for (SpatialJointSet* set : {&steep, &flat, &cross}) {
    set->fisher_concentration = concentration;
    set->spacing = 1.9;
  }
  return slice<Spatial>(ground, joint_network({steep, flat, cross}, ground, seed),
                        {.min_inscribed_radius = 0.2});
}

Construction<Site> plan() {
  Construction<Site> plan;
  plan.add_stage("tunnel", 0.5).excavate(tunnel);
  plan.add_stage("support")
      .install_bolts(
          {bolt_bars({.length = 3, .angular_spacing = 20 * deg, .from = 40 * deg, .to = 140 * deg},
                     tunnel, 1.5, 0, 14),
           AxialBolt({.axial_stiffness = 2e8, .yield_force = 2.5e5})})
      .install_lining({{.ring = {.nodes = 24}, .spacing = 1},
                       {LiningSection::strip(0.15, 1, 25e9), LiningSection::strip(0.15, 0.8, 25e9)},
                       CoulombJoint({1e10, 1e10, 35 * deg})});
  plan.add_stage("cross-drift").excavate(drift);
  return plan;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int k, double otherwise) {
    return argc > k ? std::atof(argv[k]) : otherwise;
  };
  int undecided = 0;
  for (int seed = static_cast<int>(number(1, 1)); seed <= static_cast<int>(number(2, 4)); ++seed) {
    const auto begin = std::chrono::steady_clock::now();
    Site site(rock(static_cast<std::uint64_t>(seed), number(3, 200)),
              CoulombJoint({.joint_normal_stiffness = 5e9,
                            .joint_shear_stiffness = 5e8,
                            .friction_angle = number(4, 35) * deg}),
              {.density = 2700, .surcharge = 1.3e5});
    const auto built = construct(site, plan());
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("seed %d, %zu bodies, %.1f s\n", seed, site.mass().bodies.size(), seconds);
    for (const auto& stage : built.stages)
      std::printf("  %-11s %s, crown %.2f mm, %.3g m3 came off: %s\n", stage.name.c_str(),
                  to_string(stage.report), 1e3 * stage.convergence.crown,
                  stage.report.fallen_measure, stage.report.reason.c_str());
    for (const auto& opened : site.opened_linings())
      std::printf("  lining %d opened: %d nodes and %d members out, %zu nodes at the cut\n",
                  opened.lining, opened.nodes, opened.members, opened.ends.size());
    std::vector<char> at_edge(site.mass().bodies.size(), 0);
    for (const auto& facet : boundary_facets(site.mass()))
      at_edge[static_cast<std::size_t>(facet.body)] = 1;
    for (const int b : site.fallen()) {
      const auto& p = site.mass().bodies[static_cast<std::size_t>(b)].properties;
      std::printf("  came off: %.3g m3 at (%.2f, %.2f, %.2f) m%s\n", p.measure, p.centroid.x(),
                  p.centroid.y(), p.centroid.z(),
                  at_edge[static_cast<std::size_t>(b)] != 0 ? ", at the edge of the domain" : "");
    }
    std::fflush(stdout);
    if (built.verdict() == Verdict::undecided) ++undecided;
  }
  return undecided;
}
