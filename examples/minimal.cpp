// SPDX-License-Identifier: MIT
// A 10 m tunnel in jointed rock, bolted and lined: how far does the crown come in, and does it
// stand? The elastic crown of the unsupported hole in a medium of these moduli moves about 3 mm.
#include <cstdio>
#include <voussoir/voussoir.hpp>
using namespace voussoir;
using namespace voussoir::literals;  // 75_deg, 5_GPa_per_m: SI units and radians inside

// The physics, chosen once; roles left out keep their default.
using Tunnel = Solver<Planar, CoulombJoint, LorigAnchors, EulerBernoulliBeam>;

int main() {
  const auto opening = circular_opening(10_m);
  const auto ground = domain_around(opening, 70_m, 20_m, 30_m);  // width, cover, below [m]
  const std::vector sets = {JointSet{"J1", 75_deg, DipDirection::east, 1_deg, 1_per_m2, 0, 1_m},
                            JointSet{"J2", 25_deg, DipDirection::east, 1_deg, 1_per_m2, 0, 1_m},
                            JointSet{"J3", 25_deg, DipDirection::west, 1_deg, 1_per_m2, 0, 1_m}};
  const auto rock = slice(ground, joint_network(sets, ground, 1), {25_cm, 5});

  Tunnel tunnel(rock, CoulombJoint({5_GPa_per_m, 0.5_GPa_per_m, 35_deg}),
                {.density = 2700_kg_per_m3, .k0 = 1});
  tunnel.excavate(opening);
  const AxialBolt bolt({.axial_stiffness = 0.2_GN_per_m, .rupture_force = 500_kN});
  for (const auto& bar : bolt_bars({.length = 4_m, .angular_spacing = 15_deg}, opening))
    tunnel.install_bolt(bar, bolt);
  tunnel.install_lining(lining_frame(tunnel.mass(), {}), LiningSection::rectangular(10_cm, 25_GPa),
                        CoulombJoint({1_GPa_per_m, 1_GPa_per_m, 30_deg}));
  const auto result = tunnel.equilibrium();

  const double crown = 1e3 * convergence(tunnel).crown;
  std::printf("%s\n%zu blocks, %s: crown %.2f mm, error estimate %.1e\n",
              Tunnel::composition().c_str(), tunnel.mass().bodies.size(), to_string(result), crown,
              result.error_estimate);
  return result.verdict == Verdict::stable && crown > 1 && crown < 4 ? 0 : 1;
}
