// SPDX-License-Identifier: MIT
// A unit of a program with a contact law of its own: what the law costs to compile, beside what
// voussoir::compiled has (tests/rules/code_size.cmake, bench/compile_table.sh).
#include <utility>
#include <voussoir/voussoir.hpp>

/// As joints of Coulomb are, to the compiler another law.
struct OwnJoint : voussoir::CoulombJoint {
  using CoulombJoint::CoulombJoint;
  static constexpr const char* name = "OwnJoint";
};

using Tunnel = voussoir::Solver<voussoir::Planar, OwnJoint>;

voussoir::EquilibriumReport solve(voussoir::RockMass<voussoir::Planar> rock, const OwnJoint& law,
                                  const voussoir::SimplePolygon& opening,
                                  const voussoir::AxialBolt& bolt, const voussoir::Segment& bar) {
  Tunnel tunnel(std::move(rock), law, {.density = 2700});
  tunnel.excavate(opening);
  tunnel.install_bolt(bar, bolt);
  tunnel.install_lining(voussoir::lining_frame(tunnel.mass(), {}),
                        voussoir::LiningSection::rectangular(0.1, 25e9),
                        voussoir::CoulombJoint({1e9, 1e9, 0.5}));
  return tunnel.equilibrium();
}
