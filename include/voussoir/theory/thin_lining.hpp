// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A thin closed ring of lining in a circular tunnel, joined to the ground by normal springs.
/// Plane problem, per metre of tunnel; no bending, no self weight.
struct ThinLining {
  double radius;           ///< a, of the tunnel [m], > 0
  double thickness;        ///< t [m], > 0
  double elastic_modulus;  ///< E_L [Pa], > 0
  /// K_L, pressure per displacement [Pa/m], > 0; infinite: the ring is glued to the wall. A node of
  /// a discrete ring carries K_L times its tributary arc.
  double interface_stiffness = std::numeric_limits<double>::infinity();
  /// Equal chords with their vertices on the radius, loaded at the vertices; 0: a circle. Second
  /// order: 32 chords carry 0.06 % more thrust than the circle of the paper's 10 cm lining.
  int chords = 0;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(radius > 0 && std::isfinite(radius), "lining radius", radius, "> 0 m");
    require(thickness > 0, "lining thickness", thickness, "> 0 m");
    require(elastic_modulus > 0, "lining elastic_modulus", elastic_modulus, "> 0 Pa");
    require(interface_stiffness > 0, "lining interface_stiffness", interface_stiffness, "> 0 Pa/m");
    require(chords == 0 || chords >= 3, "lining chords", chords, "0 or >= 3");
  }

  /// Thrust / (a dp): 1 for a circle, phi / sin(phi) for chords that span 2 phi.
  [[nodiscard]] double chord_factor() const {
    if (chords == 0) return 1.0;
    const double phi = std::numbers::pi / chords;
    return phi / std::sin(phi);
  }
  /// Inward movement of the ring per pressure on it, a^2 / (E_L t) of a circle [m/Pa].
  [[nodiscard]] double ring_flexibility() const {
    return chord_factor() * radius * (radius / (elastic_modulus * thickness));
  }
  /// The same of the wall behind it: ring and interface in series [m/Pa].
  [[nodiscard]] double flexibility() const { return ring_flexibility() + 1 / interface_stiffness; }
};

/// How ground and lining share the in-situ pressure.
struct ThinLiningResponse {
  double pressure;           ///< dp, between ground and lining [Pa]
  double thrust;             ///< N, compression positive [N/m]
  double convergence;        ///< of the tunnel wall after the lining was installed, inwards [m]
  double lining_shortening;  ///< inward movement of the ring itself [m]
};

/// Elastic ground under an isotropic pressure pushes a lining that was installed before the ground
/// moved. Three flexibilities in series carry the same pressure dp:
///
///   u_ground = a (p0 - dp) / (2 G),  u_lining = a^2 dp / (E_L t),  u_interface = dp / K_L
///   u_ground = u_lining + u_interface
///
///   dp = (p0 a / 2G) / (a / 2G + a^2 / (E_L t) + 1 / K_L),   N = a dp
///
/// Source: Boon, Houlsby & Utili (2015), eq. (13) and Appendix B, eqs (B.1)-(B.6); written here as
/// flexibilities, so that a glued ring (K_L infinite) and a rigid one (t or E_L infinite) need no
/// case of their own. With `chords` the lining flexibility and N are multiplied by phi / sin(phi).
///
/// Thin wall: the wall of a ring of outer radius a is 1 % (t = a/50) to 5 % (t = a/10) less
/// flexible than a^2 / (E_L t).
///
/// @param ground_pressure       p0 that is released after the lining is in place [Pa]
/// @param ground_shear_modulus  G [Pa], > 0
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE ThinLiningResponse thin_lining(const ThinLining& lining,
                                                             double ground_pressure,
                                                             double ground_shear_modulus);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE ThinLiningResponse thin_lining(const ThinLining& lining, double ground_pressure,
                                               double ground_shear_modulus) {
  lining.check();
  require(std::isfinite(ground_pressure), "ground_pressure", ground_pressure, "finite [Pa]");
  require(ground_shear_modulus > 0, "ground_shear_modulus", ground_shear_modulus, "> 0 Pa");
  const double a = lining.radius;
  const double ground = a / (2 * ground_shear_modulus);
  const double support = lining.flexibility();
  ThinLiningResponse response{};
  response.pressure = ground_pressure * (ground / (ground + support));
  response.thrust = lining.chord_factor() * a * response.pressure;
  response.convergence =
      support * response.pressure;  // = a (p0 - dp) / 2G without its cancellation
  response.lining_shortening = lining.ring_flexibility() * response.pressure;
  return response;
}

#endif

}  // namespace voussoir
