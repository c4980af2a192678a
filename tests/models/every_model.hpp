// SPDX-License-Identifier: MIT
#pragma once
// Every model of every role in a small tunnel, jointed, bolted and lined: in 2-D and 3-D, at rest
// (`Solver`) and in motion (`Dynamics`). Of each the forces are asked for, its tables and its
// picture.
//
// A row of the table is a list of policies, the other roles at their default. What a policy cannot
// do stands in its row as a sentence.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>
#include <voussoir/io/tunnel_picture.hpp>
#include <voussoir/io/tunnel_tables.hpp>
#include <voussoir/voussoir.hpp>

#include "io/xml_check.hpp"
#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"

namespace every_model {

using namespace voussoir;
using voussoir_test::degree;

// ---- the tunnel
// ----------------------------------------------------------------------------------

constexpr double diameter = 4;
inline const InSitu in_situ{.density = 2700, .k0 = 0.8, .surcharge = 3e5};

template <class Geometry>
[[nodiscard]] RockMass<Geometry> rock();
template <>
inline RockMass<Planar> rock<Planar>() {
  return voussoir_test::jointed_rock(domain_around(circular_opening(diameter, 24), 12, 4, 4), 1,
                                     {0.25, 5});
}
template <>
inline RockMass<Spatial> rock<Spatial>() {
  return voussoir_test::jointed_mass({{-5, 0, -5}, {5, 3, 6}}, 1, 1.9,
                                     {.min_inscribed_radius = 0.25});
}
template <class Geometry>
[[nodiscard]] typename Geometry::Opening opening() {
  if constexpr (Geometry::dim == 2)
    return circular_opening(diameter, 24);
  else
    return PrismaticOpening(circular_opening(diameter, 24));
}
constexpr double smallest_piece = 0.02;

inline const BoltPattern pattern{.length = 2, .angular_spacing = 30 * degree};
[[nodiscard]] inline auto bars(const SimplePolygon& section) { return bolt_bars(pattern, section); }
[[nodiscard]] inline auto bars(const PrismaticOpening& tunnel) {
  return bolt_bars(pattern, tunnel, 1, 0, 3);
}
[[nodiscard]] inline auto frame(const RockMass<Planar>& mass) {
  return lining_frame(mass, {.nodes = 24});
}
[[nodiscard]] inline auto frame(const RockMass<Spatial>& mass) {
  return lining_frame(mass, LiningRibs{.ring = {.nodes = 24}, .spacing = 1});
}
constexpr double thickness = 0.1, shotcrete = 25e9;
template <class Geometry>
[[nodiscard]] std::vector<LiningSection> sections() {
  std::vector<LiningSection> all{LiningSection::rectangular(thickness, shotcrete)};
  if constexpr (Geometry::dim == 3)
    all = {LiningSection::strip(thickness, 1, shotcrete),
           LiningSection::strip(thickness, 0.5, shotcrete)};
  for (LiningSection& section : all) section.mass = 2400 * thickness;
  return all;
}

// ---- the laws
// ------------------------------------------------------------------------------------

template <class Law>
[[nodiscard]] Law law();
template <>
inline CoulombJoint law() {
  return CoulombJoint({5e9, 5e8, 35 * degree});
}
template <>
inline MohrCoulombJoint law() {
  return MohrCoulombJoint({5e9, 5e8, 35 * degree, 5e4, 2e4});
}
template <>
inline BartonBandisJoint law() {
  return BartonBandisJoint({.roughness = 8,
                            .wall_strength = 80e6,
                            .residual_friction_angle = 28 * degree,
                            .initial_stiffness = 5e9,
                            .maximum_closure = 3e-4,
                            .largest_stress = 2e6});
}
template <>
inline BurgersJoint law() {
  return BurgersJoint({5e9, 5e8, 35 * degree, 5e8 * 1e7, 5e8, 5e8 * 1e6});
}
template <class Law>
[[nodiscard]] Law interface_law() {
  return law<Law>();
}
template <>
inline CoulombJoint interface_law() {
  return CoulombJoint({5e9, 5e8, 30 * degree});
}
// A soft layer: on a stiff one a bond would need more nodes than all else here.
template <>
inline MohrCoulombJoint interface_law() {
  return MohrCoulombJoint({1e7, 1e7, 35 * degree, 5e4, 2e4});
}
template <>
inline AxialBolt law() {
  return AxialBolt({.axial_stiffness = 2e8, .yield_force = 1.5e4});
}
template <>
inline AxialShearBolt law() {
  return AxialShearBolt({.axial = {.axial_stiffness = 2e8}, .shear_stiffness = 2e7});
}
// A cable in weak grout.
template <>
inline CurveBolt law() {
  return CurveBolt(BondedBolt{
      .axial_stiffness = 2e7, .bond_stiffness = 2e8, .bond_strength = 1.5e4, .strength = {}});
}
template <>
inline AnyBolt law() {
  return law<AxialShearBolt>();
}

// ---- what is asked of each
// ------------------------------------------------------------------------

/// Forces, tables and pictures; says in a few words what there is.
template <class Geometry>
[[nodiscard]] std::string ask(const TunnelState<Geometry>& state, const RockMass<Geometry>& mass,
                              const std::vector<typename Geometry::Line>& bolts) {
  CHECK(state.blocks.size() == mass.bodies.size());
  double moved = 0, pull = 0, thrust = 0, normal = 0;
  int yielded = 0;
  for (const auto& block : state.blocks) moved = std::max(moved, block.displacement.norm());
  for (const CrossingForce& c : state.bolts) {
    CHECK(std::isfinite(c.report.axial + c.report.shear + c.report.plastic_extension));
    CHECK(!c.report.is_broken);
    pull = std::max(pull, c.report.axial);
    yielded += c.report.has_yielded();
  }
  for (const auto& m : state.members) {
    CHECK(std::isfinite(m.thrust + m.shear + m.moment));
    thrust = std::max(thrust, m.thrust);
  }
  int open = 0, slipping = 0;
  for (const auto& j : state.joints) {
    const ContactReport& r = j.report;
    CHECK(std::isfinite(r.normal + r.shear + r.opening + r.plastic_slip));
    CHECK(r.damage >= 0);
    CHECK(r.damage <= 1);
    normal = std::max(normal, r.normal);
    open += r.is_open;
    slipping += r.is_slipping;
  }
  CHECK(moved > 1e-5);
  CHECK(pull > 10);
  CHECK(thrust > 10);
  CHECK(normal > 1e4);

  const auto lines = [](const std::string& table) {
    return static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n'));
  };
  CHECK(lines(bolt_table(state.bolts, bolts)) == state.bolts.size() + 1);
  CHECK(lines(joint_table(state.joints)) == state.joints.size() + 1);
  std::string svg;
  if constexpr (Geometry::dim == 2) {
    CHECK(lines(lining_table(state.lining)) == 24 + 1);
    svg = draw_blocks_picture(picture_of(state, mass, bolts, thickness));
  } else {
    CHECK(lines(lining_table(state.members)) == state.members.size() + 1);
    TunnelView view = picture_of(state, bolts);
    view.section.offset = 5;
    svg = draw_tunnel_view(mass, view);
  }
  CHECK(xml_fault(svg) == "");
  char words[200];
  std::snprintf(
      words, sizeof words,
      "%zu blocks, up to %.2f mm; %zu crossings, %.1f kN, %d yielded; thrust %.1f kN; %d slip, "
      "%d open",
      mass.bodies.size(), 1e3 * moved, state.bolts.size(), 1e-3 * pull, yielded, 1e-3 * thrust,
      slipping, open);
  return words;
}

/// Excavated, supported, in equilibrium.
template <class Geometry, class... Policies>
[[nodiscard]] std::string at_rest() {
  using Tunnel = Solver<Geometry, Policies...>;
  CAPTURE(Tunnel::composition());
  using Parts = typename Tunnel::Parts;
  Tunnel tunnel(rock<Geometry>(), law<typename Parts::JointLaw>(), in_situ);
  tunnel.excavate(opening<Geometry>(), smallest_piece);
  const auto bolts = bars(opening<Geometry>());
  for (const auto& bar : bolts) tunnel.install_bolt(bar, law<typename Parts::BoltLaw>());
  tunnel.install_lining(frame(tunnel.mass()), sections<Geometry>(),
                        interface_law<typename Parts::Models::InterfaceLaw>());
  const EquilibriumReport report = tunnel.equilibrium();
  CHECK(report.verdict == Verdict::stable);
  return std::string(to_string(report)) + ", " + ask(state_of(tunnel), tunnel.mass(), bolts);
}

/// Half of the load of the excavation taken off, supported, then the rest in some tens of steps.
template <class Geometry, class... Policies>
[[nodiscard]] std::string in_motion() {
  using Parts = Composition<Geometry, Policies...>;
  const auto mass = carve(rock<Geometry>(), opening<Geometry>(), smallest_piece);
  using InterfaceLaw = typename Parts::Models::InterfaceLaw;
  auto run = moving_rock<InterfaceLaw, typename Parts::Detector>(
      mass, law<typename Parts::JointLaw>(), in_situ, {.local_damping = 0.3});
  run.set_held(0.5);
  run.advance_steps(10);
  const auto bolts = bars(opening<Geometry>());
  const auto held =
      add_bolts(run, mass, bolts, law<typename Parts::BoltLaw>(), 1.0, typename Parts::Anchors{});
  const auto lining = add_lining<typename Parts::Lining>(run, frame(mass), sections<Geometry>(),
                                                         interface_law<InterfaceLaw>(), thickness);
  constexpr int stages = 8;
  for (int k = 1; k <= stages; ++k) {
    run.set_held(0.5 * (1 - static_cast<double>(k) / stages));
    run.advance_steps(10);
  }
  char time[40];
  std::snprintf(time, sizeof time, "%.1f ms, ", 1e3 * run.time());
  return time + ask(state_of(run, mass, *held, *lining), mass, bolts);
}

// ---- the table
// -----------------------------------------------------------------------------------

/// A model in the four settings.
struct Row {
  std::string role, model, rest_in_plane, motion_in_plane, rest_in_space, motion_in_space;

  void print() const {
    MESSAGE("\n| " << role << " | " << model << " | " << rest_in_plane << " | " << motion_in_plane
                   << " | " << rest_in_space << " | " << motion_in_space << " |");
  }
};

/// Some bolts of each setting have yielded.
inline void check_yielded(const Row& row) {
  for (const std::string* words :
       {&row.rest_in_plane, &row.motion_in_plane, &row.rest_in_space, &row.motion_in_space})
    CHECK(words->find(", 0 yielded") == std::string::npos);
}

/// Of these policies, the first of which the row is about.
template <class Model, class... Others>
[[nodiscard]] Row in_all_settings() {
  return {Model::role::name,
          static_cast<const char*>(Model::name),
          at_rest<Planar, Model, Others...>(),
          in_motion<Planar, Model, Others...>(),
          at_rest<Spatial, Model, Others...>(),
          in_motion<Spatial, Model, Others...>()};
}
/// Where rock that moves has none to choose.
template <class Model, class... Others>
[[nodiscard]] Row at_rest_only(const char* why) {
  return {Model::role::name,
          static_cast<const char*>(Model::name),
          at_rest<Planar, Model, Others...>(),
          why,
          at_rest<Spatial, Model, Others...>(),
          why};
}

}  // namespace every_model
