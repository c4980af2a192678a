// SPDX-License-Identifier: MIT
#include "design_case.hpp"

#include <string>
#include <utility>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace voussoir_bench {

using namespace voussoir;

namespace {

SimplePolygon opening() { return circular_opening(10); }

RockMass<Planar> rock_in(const Domain<2>& ground, const Rock& rock, std::uint64_t seed) {
  const auto set = [&](const char* name, double dip, DipDirection direction) {
    return JointSet{name, dip * degree, direction, 1 * degree, 1, 0, rock.extent};
  };
  return slice(ground,
               joint_network({set("J1", 75, DipDirection::east), set("J2", 25, DipDirection::east),
                              set("J3", 25, DipDirection::west)},
                             ground, seed),
               rock.limits);
}

}  // namespace

RockMass<Planar> generate(const Rock& rock, double scale, std::uint64_t seed) {
  return rock_in({Vec2(-35, -35) * scale, Vec2(35, 25) * scale}, rock, seed);
}

Tunnel excavated(double scale, std::uint64_t seed) {
  const Domain<2> ground = domain_around(opening(), 70 * scale, 20, 30);
  Tunnel tunnel(rock_in(ground, mass_a, seed), CoulombJoint({5e9, 5e8, 35 * degree}),
                {.density = 2700, .k0 = 1});
  tunnel.excavate(opening());
  return tunnel;
}

void support(Tunnel& tunnel, double bolt_spacing, double lining_thickness) {
  if (bolt_spacing > 0) {
    const AxialBolt bolt({.axial_stiffness = 2e8, .rupture_force = 5e5});
    for (const auto& bar : bolt_bars({.length = 4, .angular_spacing = bolt_spacing}, opening()))
      tunnel.install_bolt(bar, bolt);
  }
  if (lining_thickness > 0)
    tunnel.install_lining(lining_frame(tunnel.mass(), {}),
                          LiningSection::rectangular(lining_thickness, 25e9),
                          CoulombJoint({1e9, 1e9, 30 * degree}));
}

EquilibriumReport equilibrium(Tunnel& tunnel) { return tunnel.equilibrium(); }

double crown(const Tunnel& tunnel) { return convergence(tunnel).crown; }

}  // namespace voussoir_bench
