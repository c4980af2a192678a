// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A bar in a hole filled with grout.
struct GroutedBolt {
  double bar_diameter;         ///< d1 [m], > 0
  double hole_diameter;        ///< d2 [m], > d1
  double bar_modulus;          ///< E_b [Pa], > 0
  double grout_modulus;        ///< E_g [Pa], > 0
  double grout_shear_modulus;  ///< G_g [Pa], > 0

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(bar_diameter > 0 && std::isfinite(bar_diameter), "bar diameter d1", bar_diameter,
            "> 0 m");
    require(hole_diameter > bar_diameter && std::isfinite(hole_diameter), "hole diameter d2",
            hole_diameter, "> the bar's");
    require(bar_modulus > 0 && std::isfinite(bar_modulus), "bar modulus E_b", bar_modulus,
            "> 0 Pa");
    require(grout_modulus > 0 && std::isfinite(grout_modulus), "grout modulus E_g", grout_modulus,
            "> 0 Pa");
    require(grout_shear_modulus > 0 && std::isfinite(grout_shear_modulus), "grout modulus G_g",
            grout_shear_modulus, "> 0 Pa");
  }
};

/// What a joint feels of such a bolt that crosses it at a right angle.
///
/// In shear each side is a half-infinite beam on grout of modulus K = 2 E_g / (d2/d1 - 1), without
/// moment at the joint; the two in series:  K_shear = E_b I beta^3,  beta = (K / (4 E_b I))^(1/4).
/// Along the bolt each side is a bar held by k_g = 2 pi G_g / (d2/d1 - 1) per length:
/// sqrt(E_b A k_g), the joint half of it. Elastic; the moduli of the annulus are those of thin
/// ones.
///
/// Source: beam on elastic foundation; Lorig (1985); St. John & Van Dillen (1983).
struct GroutedBoltStiffness {
  double beta;      ///< decay of the bending [1/m]
  double shear;     ///< K_shear across the joint [N/m]
  double pull_out;  ///< axial, of one side [N/m]
  double axial;     ///< K_a across the joint [N/m]
};
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE GroutedBoltStiffness grouted_bolt_stiffness(const GroutedBolt& bolt);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE GroutedBoltStiffness grouted_bolt_stiffness(const GroutedBolt& bolt) {
  bolt.check();
  constexpr double pi = std::numbers::pi;
  const double annulus = bolt.hole_diameter / bolt.bar_diameter - 1, d = bolt.bar_diameter;
  const double bending = bolt.bar_modulus * pi * d * d * d * d / 64;
  const double beta = std::sqrt(std::sqrt(2 * bolt.grout_modulus / annulus / (4 * bending)));
  const double pull_out = std::sqrt(bolt.bar_modulus * (pi * d * d / 4) *
                                    (2 * pi * bolt.grout_shear_modulus / annulus));
  return {beta, bending * beta * beta * beta, pull_out, 0.5 * pull_out};
}

#endif

}  // namespace voussoir
