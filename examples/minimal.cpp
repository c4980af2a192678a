// SPDX-License-Identifier: MIT
// A 10 m tunnel in jointed rock, bolted and lined: how far does the crown come in, and does it
// stand? The elastic crown of the unsupported hole in a medium of these moduli moves about 3 mm.
#include <cstdio>
#include <numbers>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

// The physics, chosen once; roles left out keep their default.
using Tunnel = Solver<Planar, CoulombJoint, LorigAnchors, EulerBernoulliBeam>;

int main() {
  constexpr double deg = std::numbers::pi / 180;
  const auto opening = circular_opening(10);
  const auto ground = domain_around(opening, 70, 20, 30);  // width, cover, below [m]
  const std::vector sets = {JointSet{"J1", 75 * deg, DipDirection::east, 1 * deg, 1, 0, 1},
                            JointSet{"J2", 25 * deg, DipDirection::east, 1 * deg, 1, 0, 1},
                            JointSet{"J3", 25 * deg, DipDirection::west, 1 * deg, 1, 0, 1}};
  const auto rock = slice(ground, joint_network(sets, ground, 1), {0.25, 5});

  Tunnel tunnel(rock, CoulombJoint({5e9, 5e8, 35 * deg}), {.density = 2700, .k0 = 1});
  tunnel.excavate(opening);
  const AxialBolt bolt({.axial_stiffness = 2e8, .rupture_force = 5e5});
  for (const auto& bar : bolt_bars({.length = 4, .angular_spacing = 15 * deg}, opening))
    tunnel.install_bolt(bar, bolt);
  tunnel.install_lining(lining_frame(tunnel.mass(), {}), LiningSection::rectangular(0.1, 25e9),
                        CoulombJoint({1e9, 1e9, 30 * deg}));
  const auto result = tunnel.equilibrium();

  const double crown = 1e3 * convergence(tunnel).crown;
  std::printf("%s\n%zu blocks, %s: crown %.2f mm, error estimate %.1e\n",
              Tunnel::composition().c_str(), tunnel.mass().bodies.size(), to_string(result),
              crown, result.error_estimate);
  return result.verdict == Verdict::stable && crown > 1 && crown < 4 ? 0 : 1;
}
