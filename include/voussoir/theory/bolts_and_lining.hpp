// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/theory/elastic_ground.hpp>
#include <voussoir/theory/smeared_bolts.hpp>
#include <voussoir/theory/thin_lining.hpp>

namespace voussoir {

/// Elastic ground that bolts and a ring of lining hold together.
struct ElasticSupport {
  double convergence;  ///< of the wall, inwards [m]
  double pressure;     ///< dp, between ground and lining [Pa]
  double thrust;       ///< of the lining, compression positive [N/m]; 0 without one
  double bolt_force;   ///< of one bolt at the wall [N]; 0 without bolts
};

/// An elastic point of the interaction diagram: bolts and lining are both in place before the
/// ground moves. The bolted ground is linear in p0 - dp, so with U its convergence per pressure and
/// f = a^2 / (E_L t) + 1 / K_L the flexibility of ring and interface
///
///   dp = p0 U / (U + f),   u = f dp,   N = a dp,   F = F(no lining) (p0 - dp) / p0
///
/// @param radius           a, of the opening [m]; that of `bolts` and `lining` if they are given
/// @param ground_pressure  p0 [Pa], > 0
/// @throws InvalidInput    a value out of range, or radii that differ
[[nodiscard]] VOUSSOIR_INLINE ElasticSupport elastic_support(
    double radius, const std::optional<SmearedBoltPattern>& bolts,
    const std::optional<ThinLining>& lining, const ElasticGround& ground, double ground_pressure);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE ElasticSupport elastic_support(double radius,
                                               const std::optional<SmearedBoltPattern>& bolts,
                                               const std::optional<ThinLining>& lining,
                                               const ElasticGround& ground,
                                               double ground_pressure) {
  require(radius > 0 && std::isfinite(radius), "radius a", radius, "> 0 m");
  require(!bolts || bolts->radius == radius, "radius of the bolts", bolts ? bolts->radius : 0,
          "that of the opening");
  require(!lining || lining->radius == radius, "radius of the lining", lining ? lining->radius : 0,
          "that of the opening");
  require(ground_pressure > 0 && std::isfinite(ground_pressure), "ground pressure p0",
          ground_pressure, "> 0 Pa");
  ground.check();
  double give = radius / (2 * ground.shear_modulus), force = 0;  // U, and F per pressure
  if (bolts) {
    const SmearedBolts bolted(*bolts, ground, 1.0);
    give = bolted.convergence();
    force = bolted.bolt_force(radius);
  }
  if (!lining) return {give * ground_pressure, 0, 0, force * ground_pressure};
  lining->check();
  const double flexibility = lining->flexibility();
  const double pressure = ground_pressure * (give / (give + flexibility));
  return {.convergence = flexibility * pressure,
          .pressure = pressure,
          .thrust = lining->chord_factor() * radius * pressure,
          .bolt_force = force * (ground_pressure * (flexibility / (give + flexibility)))};
}

#endif

}  // namespace voussoir
