// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/design/section_capacity.hpp>

/// Steel ribs within shotcrete: one lining, whose thrust and moment the two share.
///
/// Source: Carranza-Torres & Diederichs (2009), Mechanical analysis of circular liners with
/// particular reference to composite supports, Tunn. Undergr. Space Technol. 24(5), 506-532: both
/// have the same strain and the same curvature about the same middle, so thrust goes by E A, moment
/// and shear by E I. Their factors 1 / (1 - nu^2) are left out, as everywhere in the model, whose
/// E is that of a lining as it stands.
namespace voussoir::design {

/// Steel sets or lattice girders, their middle in the middle of the concrete.
struct SteelRibs {
  double area = 0;             ///< A of one [m^2], 1e-5 to 1
  double second_moment = 0;    ///< I of one, for bending around the tunnel [m^4], 1e-10 to 0.1
  double section_modulus = 0;  ///< W of one, elastic [m^3], 1e-8 to 1
  double spacing = 0;          ///< along the tunnel [m], 0.01 to 1000
  double yield_strength = 0;   ///< f_y [Pa], 1e8 to 2e9
  double modulus = 210e9;      ///< E [Pa], 5e10 to 3e11
  double partial_factor = 1;   ///< gamma_M0 [-], 1 to 3

  /// Of a metre of tunnel [N/m], [N m^2/m].
  [[nodiscard]] double axial_stiffness() const { return modulus * area / spacing; }
  [[nodiscard]] double bending_stiffness() const { return modulus * second_moment / spacing; }
};

/// Forces of a lining on its two parts.
struct SharedForces {
  SectionForces on_concrete;  ///< in the width of the forces
  SectionForces on_rib;       ///< of one
};

/// @param forces     of the lining in a width along the tunnel
/// @param modulus    of the concrete [Pa];  @param thickness  of it [m]
[[nodiscard]] inline SharedForces shared_forces(const SteelRibs& ribs, double modulus,
                                                double thickness, const SectionForces& forces,
                                                double width) {
  const double by_area = ribs.axial_stiffness(), by_bending = ribs.bending_stiffness();
  const double axial = by_area / (by_area + modulus * thickness);
  const double bending =
      by_bending / (by_bending + modulus * thickness * thickness * thickness / 12);
  const double each = ribs.spacing / width;
  return {
      {(1 - axial) * forces.thrust, (1 - bending) * forces.moment, (1 - bending) * forces.shear},
      {each * axial * forces.thrust, each * bending * forces.moment,
       each * bending * forces.shear}};
}

/// Of the yield of one rib at its edge, N / (A f_yd) + M / (W f_yd): EN 1993-1-1, 6.2.1(7).
/// Concrete keeps it from buckling; its shear is not asked.
[[nodiscard]] inline SectionUtilisation rib_utilisation(const SteelRibs& ribs,
                                                        const SectionForces& load) {
  const double strength = ribs.yield_strength / ribs.partial_factor;
  return {
      (std::abs(load.thrust) / ribs.area + std::abs(load.moment) / ribs.section_modulus) / strength,
      SectionMode::yield};
}

}  // namespace voussoir::design
