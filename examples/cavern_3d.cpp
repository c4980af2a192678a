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
#include <voussoir/io/tunnel_picture.hpp>
#include <voussoir/io/vtu.hpp>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

// The physics, composed once; roles left out keep their default.
using Cavern = Solver<Spatial, CoulombJoint, LorigAnchors, TimoshenkoBeam>;

namespace {

constexpr double deg = std::numbers::pi / 180;

Cavern excavated() {
  SpatialJointSet steep{"J1", 75 * deg, 90 * deg}, flat{"J2", 25 * deg, 90 * deg},
      cross{"J3", 80 * deg, 5 * deg};
  for (SpatialJointSet* set : {&steep, &flat, &cross}) {
    set->fisher_concentration = 2000;  // about 1 degree
    set->spacing = 2;
  }
  const Domain<3> ground{{-16, 0, -14}, {16, 12, 20}};
  Cavern cavern(slice<Spatial>(ground, joint_network({steep, flat, cross}, ground, 1),
                               {.min_inscribed_radius = 0.2}),
                CoulombJoint({.joint_normal_stiffness = 5e9,
                              .joint_shear_stiffness = 5e8,
                              .friction_angle = 35 * deg}),
                {.density = 2700, .surcharge = 1.3e5});  // 5 m more of it
  cavern.excavate(PrismaticOpening(circular_opening(10, 36)), 0.05);
  return cavern;
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

void write_pictures(const Cavern& cavern, const std::vector<SpatialLine>& bars,
                    const std::string& name, const EquilibriumReport& report) {
  const TunnelState<Spatial> state = state_of(cavern);
  TunnelView view = picture_of(state, bars);
  view.header.title = "Tunnel in jointed rock, three dimensions";
  view.header.key_numbers = {
      {"blocks", std::to_string(block_count(cavern))},
      {"verdict", to_string(report)},
      {"error estimate", readable_text(100 * report.error_estimate, 2) + " %"},
      {"crown", readable_text(1e3 * crown(cavern)) + " mm"}};
  VtuGrid grid;
  std::vector<double> moved, number;
  for (std::size_t b = 0; b < cavern.mass().bodies.size(); ++b) {
    const auto& body = cavern.mass().bodies[b];
    if (state.blocks[b].is_gone) continue;
    const Vec3& u = state.blocks[b].displacement;
    for (const auto& part : body.parts) {
      grid.add(part);
      moved.insert(moved.end(), u.data(), u.data() + 3);
      number.push_back(static_cast<double>(b));
    }
  }
  grid.add_values("displacement [m]", 3, moved);
  grid.add_values("block", 1, number);
  write_atomically(name + ".svg", draw_tunnel_view(cavern.mass(), view));
  write_atomically(name + ".vtu", grid.document());
}

}  // namespace

int main(int argc, char** argv) {
  Cavern bare = excavated();
  const double removed = bare.mass().carving.removed_measure,
               expected = 12 * circular_opening(10, 36).area();
  Cavern supported = bare;
  const EquilibriumReport without = bare.equilibrium();

  const PrismaticOpening& opening = supported.mass().openings.back();
  const AxialBolt bolt({.axial_stiffness = 2e8, .yield_force = 5e5});
  int crossings = 0;
  const std::vector<SpatialLine> bars =
      bolt_bars({.length = 4, .angular_spacing = 18 * deg}, opening, 1.5, 0, 12);
  for (const SpatialLine& bar : bars) crossings += supported.install_bolt(bar, bolt);
  const LiningRibs ribs{.ring = {.nodes = 36}, .spacing = 1.5};
  supported.install_lining(
      lining_frame(supported.mass(), ribs),
      {LiningSection::strip(0.15, 1.5, 25e9), LiningSection::strip(0.15, 0.87, 25e9)},
      CoulombJoint({1e10, 1e10, 35 * deg}));
  const EquilibriumReport with = supported.equilibrium();
  std::printf(
      "%s\n%zu blocks, %zu lining nodes, %d bolt crossings; unsupported: %s, crown %.2f mm; "
      "supported: %s, "
      "crown %.2f mm, error estimate %.2g\n",
      Cavern::composition().c_str(), block_count(supported),
      supported.system().movable_bodies().size() - block_count(supported), crossings,
      to_string(without), 1e3 * crown(bare), to_string(with), 1e3 * crown(supported),
      with.error_estimate);
  if (argc > 1) write_pictures(supported, bars, argv[1], with);
  const bool is_exact = std::abs(removed / expected - 1) < 1e-9;
  const bool helps = with.verdict == Verdict::stable && crown(supported) < 0.8 * crown(bare);
  return is_exact && helps ? 0 : 1;
}
