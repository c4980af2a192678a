// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/theory/elastic_ground.hpp>

namespace voussoir {

/// Stress far from an opening: vertical and horizontal, principal, compression positive.
struct FarStress {
  double vertical;  ///< sigma_v [Pa]
  double k0 = 1;    ///< sigma_h / sigma_v [-], >= 0

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(std::isfinite(vertical), "vertical stress sigma_v", vertical, "finite [Pa]");
    require(k0 >= 0 && std::isfinite(k0), "K0", k0, ">= 0");
  }
  [[nodiscard]] double horizontal() const { return k0 * vertical; }
  /// p_m = (sigma_v + sigma_h) / 2 [Pa]
  [[nodiscard]] double mean() const { return 0.5 * vertical * (1 + k0); }
  /// s = (sigma_h - sigma_v) / 2 [Pa]
  [[nodiscard]] double deviator() const { return 0.5 * vertical * (k0 - 1); }
};

/// Stress and induced displacement at a point beside a circular opening, in polar components.
struct OpeningField {
  double radial_stress;  ///< sigma_r, compression positive [Pa]
  double hoop_stress;    ///< sigma_theta, compression positive [Pa]
  double shear_stress;   ///< tau_rtheta, in the convention of compression positive [Pa]
  double inward;         ///< displacement towards the centre, caused by the excavation [m]
  double tangential;     ///< the same in the direction of growing theta [m]
};

/// Elastic field around an unsupported circular opening in plane strain, without gravity gradient.
///
///   sigma_r     = p_m (1 - q) + s (1 - 4 q + 3 q^2) cos 2 theta,               q = (a / r)^2
///   sigma_theta = p_m (1 + q) - s (1 + 3 q^2) cos 2 theta
///   tau         = -s (1 + 2 q - 3 q^2) sin 2 theta
///   u_r         = -(1 / 2G) [p_m a^2 / r + s cos 2 theta (4 (1 - nu) a^2 / r - a^4 / r^3)]
///   u_theta     = (1 / 2G) s sin 2 theta [2 (1 - 2 nu) a^2 / r + a^4 / r^3]
///
/// K0 = 1 is Lame's solution.
///
/// @param radius   a [m], > 0
/// @param distance r from the centre [m], >= a
/// @param theta    from the horizontal, springing 0, crown pi / 2 [rad]
/// @throws InvalidInput  a value out of range
/// Source: Kirsch (1898); signs as in docs/conventions.md.
[[nodiscard]] VOUSSOIR_INLINE OpeningField kirsch(double radius, const FarStress& far,
                                                  const ElasticGround& ground, double distance,
                                                  double theta);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE OpeningField kirsch(double radius, const FarStress& far,
                                    const ElasticGround& ground, double distance, double theta) {
  require(radius > 0 && std::isfinite(radius), "radius a", radius, "> 0 m");
  require(distance >= radius && std::isfinite(distance), "distance r", distance,
          ">= the radius of the opening");
  require(std::isfinite(theta), "angle theta", theta, "finite [rad]");
  far.check();
  ground.check();
  const double q = (radius / distance) * (radius / distance);
  const double p = far.mean(), s = far.deviator(), nu = ground.poisson_ratio;
  const double even = s * std::cos(2 * theta), odd = s * std::sin(2 * theta);
  const double length = radius * (radius / distance) / (2 * ground.shear_modulus);  // a^2 / (2 G r)
  return {.radial_stress = p * (1 - q) + even * (1 - 4 * q + 3 * q * q),
          .hoop_stress = p * (1 + q) - even * (1 + 3 * q * q),
          .shear_stress = -odd * (1 + 2 * q - 3 * q * q),
          .inward = length * (p + even * (4 * (1 - nu) - q)),
          .tangential = length * odd * (2 * (1 - 2 * nu) + q)};
}

#endif

}  // namespace voussoir
