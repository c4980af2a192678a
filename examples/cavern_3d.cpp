// SPDX-License-Identifier: MIT
// A 10 m tunnel in three dimensions: 12 m of it in rock with three joint sets, 4 m bolts, shotcrete
// with ribs. What is known beforehand: the rock taken out is the section times the length, every
// block is in equilibrium before excavation, and support makes the crown move less. With an
// argument, a picture (.svg) and a file for ParaView (.vtu) of this name are written.
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

// The physics, composed once; roles left out keep their default.
using Cavern = Solver<Spatial, CoulombJoint, LorigAnchors, TimoshenkoBeam>;

namespace {

constexpr double deg = std::numbers::pi / 180;

Cavern rock() {
  SpatialJointSet steep{"J1", 75 * deg, 90 * deg}, flat{"J2", 25 * deg, 90 * deg},
      cross{"J3", 80 * deg, 5 * deg};
  for (SpatialJointSet* set : {&steep, &flat, &cross}) {
    set->fisher_concentration = 2000;  // about 1 degree
    set->spacing = 2;
  }
  const Domain<3> ground{{-16, 0, -14}, {16, 12, 20}};
  return {slice<Spatial>(ground, joint_network({steep, flat, cross}, ground, 1),
                         {.min_inscribed_radius = 0.2}),
          CoulombJoint({.joint_normal_stiffness = 5e9,
                        .joint_shear_stiffness = 5e8,
                        .friction_angle = 35 * deg}),
          {.density = 2700, .surcharge = 1.3e5}};  // 5 m more of it
}

/// The section over the whole length of the rock.
const PrismaticOpening opening(circular_opening(10, 36));

/// Everything in one stage: support is wished in place before the rock moves.
Construction<Cavern> bare_tunnel() {
  Construction<Cavern> plan;
  plan.add_stage("excavation").excavate(opening, 0.05);
  return plan;
}
Construction<Cavern> supported_tunnel() {
  Construction<Cavern> plan = bare_tunnel();
  plan.stages[0]
      .install_bolts({bolt_bars({.length = 4, .angular_spacing = 18 * deg}, opening, 1.5, 0, 12),
                      AxialBolt({.axial_stiffness = 2e8, .yield_force = 5e5})})
      .install_lining(
          {{.ring = {.nodes = 36}, .spacing = 1.5},
           {LiningSection::strip(0.15, 1.5, 25e9), LiningSection::strip(0.15, 0.87, 25e9)},
           CoulombJoint({1e10, 1e10, 35 * deg})});
  return plan;
}

/// Of the blocks in the middle of the roof, the mean [m].
double crown(const Cavern& cavern) {
  double sum = 0, area = 0;
  for (const auto& piece : wall_pieces(cavern.mass())) {
    const Vec3 p = piece.facet.centre();
    if (p.z() < 4.8 || std::abs(p.y() - 6) > 4 || !cavern.system().body(piece.body).movable)
      continue;
    sum -= piece.facet.measure() * cavern.displacement_of(piece.body, p).z();
    area += piece.facet.measure();
  }
  return sum / area;
}

/// Blocks that are not detached; the nodes of the lining move too, but are none.
std::size_t block_count(const Cavern& cavern) {
  std::size_t count = 0;
  for (std::size_t b = 0; b < cavern.mass().bodies.size(); ++b)
    if (cavern.system().body(static_cast<int>(b)).movable) ++count;
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  Cavern bare = rock(), supported = bare;
  const auto without = construct(bare, bare_tunnel());
  const auto with = construct(supported, supported_tunnel());
  const double removed = bare.mass().carving.removed_measure,
               expected = 12 * opening.section().area();
  int crossings = 0;
  for (const auto& one : supported.installed_bolts()) crossings += one.crossings;
  std::printf(
      "%s\n%zu blocks, %zu lining nodes, %d bolt crossings; unsupported: %s, crown %.2f mm; "
      "supported: %s, "
      "crown %.2f mm, error estimate %.2g\n",
      Cavern::composition().c_str(), block_count(supported),
      supported.system().movable_bodies().size() - block_count(supported), crossings,
      to_string(without.last()), 1e3 * crown(bare), to_string(with.last()), 1e3 * crown(supported),
      with.last().error_estimate);
  if (argc > 1) {
    const std::string name = argv[1];
    write_atomically(
        name + ".svg",
        draw_tunnel(supported, with, {.title = "Tunnel in jointed rock, three dimensions"}));
    write_atomically(name + ".vtu", vtu_of(state_of(supported), supported.mass()));
  }
  const bool is_exact = std::abs(removed / expected - 1) < 1e-9;
  const bool helps = with.verdict() == Verdict::stable && crown(supported) < 0.8 * crown(bare);
  return is_exact && helps ? 0 : 1;
}
