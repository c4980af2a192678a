// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/theory/circular_opening.hpp>
#include <voussoir/theory/elastic_ground.hpp>

namespace voussoir {

/// A circular lining as a thin elastic ring that bends; per metre of tunnel.
struct RingLining {
  double radius;             ///< R [m], > 0
  double area;               ///< A_s [m^2/m], > 0
  double inertia;            ///< I_s [m^4/m], > 0
  double elastic_modulus;    ///< E_s [Pa], > 0
  double poisson_ratio = 0;  ///< nu_s [-]; 0: a ring of bars

  /// A full ring of constant thickness t [m].
  [[nodiscard]] static RingLining rectangular(double radius, double thickness,
                                              double elastic_modulus, double poisson_ratio = 0) {
    return {radius, thickness, thickness * thickness * thickness / 12, elastic_modulus,
            poisson_ratio};
  }

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(radius > 0 && std::isfinite(radius), "lining radius R", radius, "> 0 m");
    require(area > 0 && std::isfinite(area), "lining area A_s", area, "> 0 m^2/m");
    require(inertia > 0 && std::isfinite(inertia), "lining inertia I_s", inertia, "> 0 m^4/m");
    require(elastic_modulus > 0 && std::isfinite(elastic_modulus), "lining modulus E_s",
            elastic_modulus, "> 0 Pa");
    require(poisson_ratio > -1 && poisson_ratio < 0.5, "Poisson's ratio of the lining",
            poisson_ratio, "> -1 and < 0.5");
  }
};

/// Between ground and lining.
enum class LiningInterface { no_slip, full_slip };

/// A lining that was in place before the ground moved, as mean and second harmonic:
/// value(theta) = mean + amplitude cos(2 theta); the tangential displacement goes with sin(2
/// theta).
struct LiningResponse {
  double thrust, thrust_amplitude;            ///< N, compression positive [N/m]
  double moment_amplitude;                    ///< M, tension outside positive [N m/m]; mean: 0
  double convergence, convergence_amplitude;  ///< inwards [m]
  double tangential_amplitude;                ///< positive towards growing theta [m]

  /// @param theta  from the horizontal: springing 0, crown pi / 2 [rad]
  [[nodiscard]] double thrust_at(double theta) const {
    return thrust + thrust_amplitude * std::cos(2 * theta);
  }
  [[nodiscard]] double moment_at(double theta) const {
    return moment_amplitude * std::cos(2 * theta);
  }
  [[nodiscard]] double convergence_at(double theta) const {
    return convergence + convergence_amplitude * std::cos(2 * theta);
  }
};

namespace detail {

inline void check_lined_ground(const RingLining& lining, const FarStress& far,
                               const ElasticGround& ground) {
  lining.check();
  far.check();
  ground.check();
  require(std::isfinite(ground.shear_modulus), "shear modulus G", ground.shear_modulus,
          "finite [Pa]");
}

}  // namespace detail

/// Lining in elastic ground under unequal stresses, plane strain.
///
///   C* = E R (1 - nu_s^2) / (E_s A_s (1 - nu^2)),   F* = E R^3 (1 - nu_s^2) / (E_s I_s (1 - nu^2))
///   a0 = C* F* (1 - nu) / (C* + F* + C* F* (1 - nu))
///
///   N = P R [(1 + K)(1 - a0) + (1 - K)(1 + 2 a2) cos 2 theta] / 2                  (no slip)
///   u = P R (1 + nu) / (2 E) [(1 + K) a0 + (1 - K)(4 (1 - nu) b2 - 2 a2) cos 2 theta]
///   full slip: a2 = (F* + 6)(1 - nu) / (2 F* (1 - nu) + 6 (5 - 6 nu)), 1 - 2 a2 in place of 1 + 2
///   a2
///
/// with K = K0, P = sigma_v and the constants b2 and a2 = B b2 of no slip below.
///
/// Source: Einstein & Schwartz (1979), J. Geotech. Eng. Div. 105(4); signs of docs/conventions.md.
/// The same problem solved directly (stress function outside, ring inside) agrees to 1e-8.
///
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE LiningResponse einstein_schwartz(const RingLining& lining,
                                                               const FarStress& far,
                                                               const ElasticGround& ground,
                                                               LiningInterface interface);

/// Amplitudes of an inextensible lining (the mean thrust is that of `thin_lining`).
struct InextensibleLining {
  double thrust_amplitude;  ///< N = mean + this cos(2 theta) [N/m]
  double moment_amplitude;  ///< M = this cos(2 theta), tension outside positive [N m/m]
};

/// The closed form in use before Einstein and Schwartz: bending only.
///
///   Q2 = E R^3 / (12 E_s I_s (1 + nu)),   p = sigma_v - sigma_h
///   full slip:  S_n = 3 (3 - 4 nu) p / (2 [5 - 6 nu + 4 Q2]),   M = R^2 S_n / 3,   N = R S_n / 3
///   no slip:    S_n = (1 - Q2) p / d,  S_t = (1 + 2 Q2) p / d,
///               d = 2 [1 + Q2 (3 - 2 nu) / (3 - 4 nu)],
///               M = R^2 (2 S_n + S_t) / 6,   N = R (S_n + 2 S_t) / 3
///
/// Full slip is `einstein_schwartz` to the last digit; no slip its limit for an area without end.
/// Source: Muir Wood (1975) with the correction of Curtis (1976), Geotechnique 25 and 26. The
/// lining's Poisson ratio is left out, as there.
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE InextensibleLining curtis(const RingLining& lining,
                                                        const FarStress& far,
                                                        const ElasticGround& ground,
                                                        LiningInterface interface);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE LiningResponse einstein_schwartz(const RingLining& lining, const FarStress& far,
                                                 const ElasticGround& ground,
                                                 LiningInterface interface) {
  detail::check_lined_ground(lining, far, ground);
  const double nu = ground.poisson_ratio, R = lining.radius, K = far.k0;
  const double ratio = ground.youngs_modulus() * R *
                       (1 - lining.poisson_ratio * lining.poisson_ratio) /
                       (lining.elastic_modulus * (1 - nu * nu));
  const double C = ratio / lining.area, F = ratio * R * R / lining.inertia;
  const double PR = far.vertical * R, half = 0.5 * (1 - K);
  const double length = PR * (1 + nu) / ground.youngs_modulus();
  // 1 - a0 without its cancellation in stiff ground.
  const double a0 = C * F * (1 - nu) / (C + F + C * F * (1 - nu));
  const double rest = (C + F) / (C + F + C * F * (1 - nu));
  LiningResponse r{};
  r.thrust = 0.5 * PR * (1 + K) * rest;
  r.convergence = 0.5 * length * (1 + K) * a0;
  // Where the source takes the difference of large numbers it is taken here by hand: the moment of
  // a thin lining is 1e-5 of P R^2, so it comes from the bending of the ring, 3 E_s I_s w / R^2.
  const double stiff = lining.elastic_modulus / (1 - lining.poisson_ratio * lining.poisson_ratio);
  if (interface == LiningInterface::full_slip) {
    const double below = 2 * F * (1 - nu) + 6 * (5 - 6 * nu);
    r.thrust_amplitude = PR * half * 6 * (3 - 4 * nu) / below;  // 1 - 2 a2
    r.convergence_amplitude = -2 * length * half * (1 - nu) * (3 - 4 * nu) * F / below;
    // The ring's own, from N = -(D (v' + w) + K (w + w'') / R^2) / R with w, v outward and
    // anticlockwise: the ground slides past it.
    const double w = -r.convergence_amplitude;
    const double stretch = -r.thrust_amplitude * R / (stiff * lining.area) +
                           3 * w * lining.inertia / (lining.area * R * R);
    r.tangential_amplitude = 0.5 * (stretch - w);
  } else {
    const double d = 3 * F + 3 * C + 2 * C * F * (1 - nu);
    const double B = ((6 + F) * C * (1 - nu) + 2 * F * nu) / d;
    // C* (1 - nu) / (2 [C* (1 - nu)(1 - 3 B) + 4 nu - 6 B]) with C* cancelled
    const double rest_of_b2 = (12 * nu + (1 - nu) * (8 * nu * F - 36 - 6 * F)) / d;
    const double b2 = (1 - nu) / (2 * ((1 - nu) * (1 - 3 * B) + rest_of_b2));
    const double a2 = B * b2;
    r.thrust_amplitude = PR * half * (1 + 2 * a2);
    r.convergence_amplitude = length * half * (4 * (1 - nu) * b2 - 2 * a2);
    r.tangential_amplitude = 2 * length * half * (a2 + (1 - 2 * nu) * b2);
  }
  r.moment_amplitude = -3 * stiff * lining.inertia * r.convergence_amplitude / (R * R);
  return r;
}

VOUSSOIR_INLINE InextensibleLining curtis(const RingLining& lining, const FarStress& far,
                                          const ElasticGround& ground, LiningInterface interface) {
  detail::check_lined_ground(lining, far, ground);
  const double nu = ground.poisson_ratio, R = lining.radius;
  const double q = ground.youngs_modulus() * R * R * R /
                   (12 * lining.elastic_modulus * lining.inertia * (1 + nu));
  const double p = far.vertical - far.horizontal();
  if (interface == LiningInterface::full_slip) {
    const double normal = 3 * (3 - 4 * nu) * p / (2 * (5 - 6 * nu + 4 * q));
    return {R * normal / 3, R * R * normal / 3};
  }
  const double d = 2 * (1 + q * (3 - 2 * nu) / (3 - 4 * nu));
  const double normal = (1 - q) * p / d, shear = (1 + 2 * q) * p / d;
  return {R * (normal + 2 * shear) / 3, R * R * (2 * normal + shear) / 6};
}

#endif

}  // namespace voussoir
