// SPDX-License-Identifier: MIT
#include "design_case.hpp"

#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace voussoir_bench {

using namespace voussoir;

namespace {

SimplePolygon opening() { return circular_opening(paper::diameter); }

}  // namespace

RockMass<Planar> generate(const paper::RockReading& rock, double scale) {
  return paper::sliced_rock(rock, 1, {Vec2(-35, -35) * scale, Vec2(35, 25) * scale});
}

namespace {

template <class T>
T excavated_as(const paper::Extent& extent) {
  return {paper::sliced_rock(paper::mass_a, 1, paper::domain(extent)),
          typename T::JointLaw(
              CoulombJoint({paper::normal_stiffness, paper::shear_stiffness, paper::friction})),
          {.density = paper::density, .k0 = 1},
          opening()};
}

template <class T>
void support_as(T& tunnel, double bolt_spacing, double lining_thickness) {
  if (bolt_spacing > 0) {
    const AxialBolt bolt({.axial_stiffness = 2e8, .rupture_force = 5e5});
    for (const auto& bar : bolt_bars({.length = 4, .angular_spacing = bolt_spacing}, opening()))
      tunnel.install_bolt(bar, bolt);
  }
  if (lining_thickness > 0)
    tunnel.install_lining(lining_frame(tunnel.mass(), {}),
                          LiningSection::rectangular(lining_thickness, 25e9),
                          typename T::InterfaceLaw({.joint_normal_stiffness = 1e9,
                                                    .joint_shear_stiffness = 1e9,
                                                    .friction_angle = 30 * degree}));
}

}  // namespace

Tunnel excavated(double scale) { return excavated_as<Tunnel>({.width = paper::width * scale}); }
AnyTunnel excavated_of_variants(double scale) {
  return excavated_as<AnyTunnel>({.width = paper::width * scale});
}

Tunnel excavated_square(double width) {
  const double above = paper::cover + paper::diameter;
  return excavated_as<Tunnel>({.width = width, .below = 6 * width / 7 - above});
}

void support(Tunnel& tunnel, double bolt_spacing, double lining_thickness) {
  support_as(tunnel, bolt_spacing, lining_thickness);
}
void support(AnyTunnel& tunnel, double bolt_spacing, double lining_thickness) {
  support_as(tunnel, bolt_spacing, lining_thickness);
}

EquilibriumReport equilibrium(Tunnel& tunnel) { return tunnel.equilibrium(); }
EquilibriumReport equilibrium(AnyTunnel& tunnel) { return tunnel.equilibrium(); }

double crown(const Tunnel& tunnel) { return convergence(tunnel).crown; }
double crown(const AnyTunnel& tunnel) { return convergence(tunnel).crown; }

}  // namespace voussoir_bench
