// SPDX-License-Identifier: MIT
#include "cavern_case.hpp"

#include <numbers>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace voussoir_bench {

using namespace voussoir;

Cavern excavated_cavern(double spacing) {
  constexpr double degree = std::numbers::pi / 180;
  SpatialJointSet a{"J1", 75 * degree, 90 * degree}, b{"J2", 25 * degree, 90 * degree},
      c{"J3", 80 * degree, 5 * degree};
  for (SpatialJointSet* set : {&a, &b, &c}) {
    set->fisher_concentration = 2000;
    set->spacing = spacing;
  }
  const Domain<3> ground{{-16, 0, -14}, {16, 12, 20}};
  return {slice<Spatial>(ground, joint_network({a, b, c}, ground, 1),
                         {.min_inscribed_radius = 0.1 * spacing}),
          CoulombJoint({5e9, 5e8, 35 * degree}),
          {.density = 2700, .surcharge = 1.3e5},
          PrismaticOpening(circular_opening(10, 36)),
          0.05};
}

Cavern cavern(double spacing) {
  constexpr double degree = std::numbers::pi / 180;
  Cavern made = excavated_cavern(spacing);
  for (const auto& bar : bolt_bars({.length = 4, .angular_spacing = 18 * degree},
                                   made.mass().openings.back(), 1.5, 0, 12))
    made.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8, .yield_force = 5e5}));
  made.install_lining(
      lining_frame(made.mass(), LiningRibs{.ring = {.nodes = 36}, .spacing = 1.5}),
      {LiningSection::strip(0.15, 1.5, 25e9), LiningSection::strip(0.15, 0.87, 25e9)},
      CoulombJoint({1e10, 1e10, 35 * degree}));
  return made;
}

}  // namespace voussoir_bench
