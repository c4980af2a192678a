// SPDX-License-Identifier: MIT
// A horseshoe in heading and bench: bolts and an arch on feet in the heading, two legs that carry
// the arch down to the floor when the bench is out. What is seen: each stage with what has come in
// at the crown, what the feet bear, and the lining as one, arch and legs. The feet of the arch are
// gone when the legs stand, and the legs bear what they bore.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

using Tunnel = Solver<>;

namespace {

constexpr double deg = std::numbers::pi / 180, floor_of_heading = -1.5;

const SimplePolygon section = horseshoe_opening(8, 3);
const SimplePolygon bench({{-4, -3}, {4, -3}, {4, floor_of_heading}, {-4, floor_of_heading}});

/// What of the section lies above the bench.
SimplePolygon heading() {
  std::vector<Vec2> corners = section.vertices();
  for (Vec2& v : corners) v.y() = std::max(v.y(), floor_of_heading);
  return SimplePolygon(corners);
}

/// 20 cm of shotcrete on the wall of the section, about its centre; its ends stand on feet.
LiningInstallation<Tunnel> shotcrete(double from, double to) {
  return {{.from = from, .to = to},
          {LiningSection::rectangular(0.2, 25e9)},
          CoulombJoint({5e9, 5e9, 20 * deg}),
          section,
          FootBearing({.width = 0.3, .stiffness = 2e9, .friction_angle = 30 * deg})};
}

double borne(const Tunnel& tunnel) {
  double sum = 0;
  for (const auto& foot : foot_forces(tunnel)) sum += 1e-3 * foot.bearing;
  return sum;
}

void print(const ConstructionResult<Planar>& built) {
  for (const auto& stage : built.stages)
    std::printf("%-15s %s, crown %.2f mm\n", stage.name.c_str(), to_string(stage.report),
                1e3 * stage.convergence.crown);
}

}  // namespace

int main(int argc, char** argv) {
  const auto ground = domain_around(section, 40, 15, 12);
  const JointSet steep{"J1", 75 * deg, DipDirection::east, 2 * deg, 1, 0, 2},
      flat{"J2", 25 * deg, DipDirection::west, 2 * deg, 1, 0, 2};
  Tunnel tunnel(slice(ground, joint_network({steep, flat}, ground, 1), {0.25, 5}),
                CoulombJoint({5e9, 5e8, 40 * deg}), {.density = 2700, .surcharge = 5e5});

  const auto bars = bolt_bars(
      {.length = 3, .angular_spacing = 30 * deg, .from = 30 * deg, .to = 150 * deg}, section);
  // The legs stand on the corners of the floor.
  const double shoulder = 10 * deg, toe = std::atan2(3.0, 4.0);
  Construction<Tunnel> upper, lower;
  upper.add_stage("heading", 0.5).excavate(heading());
  upper.add_stage("bolts and arch", 0.2)
      .install_bolts({bars, AxialBolt({.axial_stiffness = 2e8})})
      .install_lining(shotcrete(-shoulder, 180 * deg + shoulder));
  lower.add_stage("bench and legs")
      .excavate(bench)
      .install_lining(shotcrete(180 * deg + shoulder, 180 * deg + toe))
      .install_lining(shotcrete(-toe, -shoulder));

  print(construct(tunnel, upper));
  const double on_arch = borne(tunnel);
  const auto built = construct(tunnel, lower);
  print(built);
  const double on_legs = borne(tunnel);
  double highest_foot = -1e9;
  for (const auto& foot : foot_forces(tunnel))
    highest_foot = std::max(highest_foot, foot.place.y());
  const SupportDemand demand = support_demand(tunnel);
  std::printf("feet bear %.0f kN/m under the arch, %.0f kN/m under the legs\n", on_arch, on_legs);
  std::printf("%zu linings, %zu nodes: thrust up to %.0f kN/m, moment up to %.1f kN m/m\n",
              tunnel.linings().size(), lining_forces(tunnel).size(), 1e-3 * demand.largest_thrust,
              1e-3 * demand.largest_moment);
  if (argc > 1)
    write_atomically(argv[1], draw_tunnel(tunnel, built, {.title = "Heading and bench"}));
  return built.verdict() == Verdict::stable && on_legs > on_arch &&
                 highest_foot < floor_of_heading && std::isfinite(convergence(tunnel).crown)
             ? 0
             : 1;
}
