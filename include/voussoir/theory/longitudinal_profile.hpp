// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Longitudinal displacement profile: how much of its final convergence the wall has had at a
/// distance from the face.
///
///   u0 = exp(-0.15 R) / 3                          at the face
///   x <= 0:  u = u0 exp(x)                         ahead of it
///   x >= 0:  u = 1 - (1 - u0) exp(-1.5 x / R)      behind it, R = r_p / a
///
/// Source: Vlachopoulos & Diederichs (2009), Rock Mech. Rock Eng. 42, a fit to continuum analyses.
/// No more can be claimed for jointed rock: its profile needs runs in 3-D.
///
/// @param distance        X / a from the face, positive towards the excavated side [-]
/// @param plastic_radius  r_p / a of the unsupported opening [-], >= 1
/// @return  u / u_max [-], 0 to 1
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE double longitudinal_profile(double distance, double plastic_radius);

/// The same in elastic ground, where Poisson's ratio shapes it: what the ground ahead of the face
/// holds back.
///
///   u0 = 0.22 nu + 0.19                                         at the face
///   x <= 0:  u = u0 exp((0.73 nu + 0.81) x)                     ahead of it
///   x >= 0:  u = u0 + A (1 - (B / (B + x))^2)                   behind it
///            A = 0.81 - 0.22 nu,   B = 0.39 nu + 0.65           (u0 + A = 1)
///
/// Source: Unlu & Gercek (2003), Tunnelling and Underground Space Technology 18(5), 547-553, a fit
/// to continuum analyses of circular tunnels under hydrostatic stress. Ahead of the face they write
/// u0 + A_a (1 - exp(B_a x)) with A_a = -u0, which is the same. Behind it the profile comes to its
/// end more slowly than `longitudinal_profile`: at 3 radii 3.0 % are missing (nu = 0.25), in that
/// one 0.8 % (r_p = a).
///
/// @param distance       X / a from the face, positive towards the excavated side [-]
/// @param poisson_ratio  nu of the ground [-], 0 to 0.5
/// @return  u / u_max [-], 0 to 1
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE double elastic_longitudinal_profile(double distance,
                                                                  double poisson_ratio);

/// Fictitious support pressure in elastic ground: what must act on the wall of a plane run so that
/// the wall has come in by a part of its convergence. In ground that yields it is
/// `GroundReactionCurve::pressure_at`.
///
///   p_f = p0 (1 - u / u_max)
///
/// Install the support under it, then take it away.
/// @param ground_pressure  p0 [Pa], >= 0
/// @param part             u / u_max when the support is installed [-], 0 to 1
/// @throws InvalidInput  a value out of range
[[nodiscard]] inline double fictitious_pressure(double ground_pressure, double part) {
  require(ground_pressure >= 0 && std::isfinite(ground_pressure), "ground pressure p0",
          ground_pressure, ">= 0 Pa");
  require(part >= 0 && part <= 1, "part of the convergence u / u_max", part, "0 to 1");
  return ground_pressure * (1 - part);
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE double longitudinal_profile(double distance, double plastic_radius) {
  require(!std::isnan(distance), "distance from the face X / a", distance, "a number");
  require(plastic_radius >= 1 && std::isfinite(plastic_radius), "plastic radius r_p / a",
          plastic_radius, ">= 1");
  const double at_face = std::exp(-0.15 * plastic_radius) / 3;
  if (distance <= 0) return at_face * std::exp(distance);
  return 1 - (1 - at_face) * std::exp(-1.5 * distance / plastic_radius);
}

VOUSSOIR_INLINE double elastic_longitudinal_profile(double distance, double poisson_ratio) {
  require(!std::isnan(distance), "distance from the face X / a", distance, "a number");
  require(poisson_ratio >= 0 && poisson_ratio <= 0.5, "Poisson's ratio", poisson_ratio, "0 to 0.5");
  const double at_face = 0.22 * poisson_ratio + 0.19;
  if (distance <= 0) return at_face * std::exp((0.73 * poisson_ratio + 0.81) * distance);
  const double b = 0.39 * poisson_ratio + 0.65, left = b / (b + distance);
  const double u = at_face + (0.81 - 0.22 * poisson_ratio) * (1 - left * left);
  VOUSSOIR_ASSERT(u >= at_face && u <= 1 + 1e-12, "the wall comes in behind the face");
  return u;
}

#endif

}  // namespace voussoir
