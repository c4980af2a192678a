// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>
#include <voussoir/theory/elastic_ground.hpp>

namespace voussoir {

/// Elastic, perfectly plastic ground.
struct MohrCoulombGround {
  ElasticGround elastic;
  double cohesion;            ///< c [Pa], >= 0
  double friction_angle;      ///< phi [rad], > 0 and < pi / 2
  double dilation_angle = 0;  ///< psi [rad], 0 to phi

  /// @throws InvalidInput  a value out of range
  void check() const {
    elastic.check();
    require(std::isfinite(elastic.shear_modulus), "shear modulus G", elastic.shear_modulus,
            "finite [Pa]");
    require(cohesion >= 0 && std::isfinite(cohesion), "cohesion c", cohesion, ">= 0 Pa");
    require(friction_angle > 0 && friction_angle < std::acos(0.0), "friction angle phi",
            friction_angle, "> 0 and < pi / 2 rad");
    require(dilation_angle >= 0 && dilation_angle <= friction_angle, "dilation angle psi",
            dilation_angle, "0 to the friction angle");
  }
};

/// Ground reaction curve: how far the wall of a circular opening comes in under a pressure on it.
///
///   p_cr = (2 p0 - sigma_cm) / (1 + k),  k = (1 + sin phi) / (1 - sin phi)
///   p_i >= p_cr:  u = a (p0 - p_i) / (2G)
///   p_i <  p_cr:  r_p = a [(p_cr + A) / (p_i + A)]^(1 / (k - 1)),   A = c cot phi
///   u = a^-K [r_p^(K + 1) (p0 - p_cr) / (2G) - (Q(r_p) - Q(a))],    K = (1 + sin psi) / (1 - sin
///   psi) Q(s) = c0 s^(K + 1) / (K + 1) + c1 s^(K + k) / (K + k) c0 = -(A + p0) (1 - 2 nu) (1 + K)
///   / (2G) c1 = (p_i + A) a^(1 - k) [(1 - nu) - nu k + K ((1 - nu) k - nu)] / (2G)
///
/// Isotropic p0, plane strain with the axial stress between the others; elastic strains in the
/// plastic ring are kept, its weight is not counted. Without dilation: Duncan Fama (1993).
///
/// Source: equilibrium, yield condition and flow rule integrated in closed form; integrated
/// numerically they give the same to 1e-7.
class GroundReactionCurve {
 public:
  /// @throws InvalidInput  a value out of range
  GroundReactionCurve(double radius, double ground_pressure, const MohrCoulombGround& ground)
      : a_(radius), p0_(ground_pressure), ground_(ground) {
    require(radius > 0 && std::isfinite(radius), "radius a", radius, "> 0 m");
    require(ground_pressure > 0 && std::isfinite(ground_pressure), "ground pressure p0",
            ground_pressure, "> 0 Pa");
    ground.check();
    const double sine = std::sin(ground.friction_angle);
    k_ = (1 + sine) / (1 - sine);
    shift_ = ground.cohesion / std::tan(ground.friction_angle);
    const double strength = shift_ * (k_ - 1);
    critical_ = (2 * p0_ - strength) / (1 + k_);
  }

  /// p_cr: below it the ground yields [Pa]; negative: it stays elastic without support.
  [[nodiscard]] double critical_pressure() const { return critical_; }

  /// r_p, of the plastic ring [m]; the radius of the opening where nothing yields. Infinite in
  /// ground without cohesion at no pressure.
  /// @param pressure  p_i on the wall [Pa], 0 to p0
  /// @throws InvalidInput  out of range
  [[nodiscard]] double plastic_radius(double pressure) const {
    check(pressure);
    if (pressure >= critical_) return a_;
    return a_ * std::pow((critical_ + shift_) / (pressure + shift_), 1 / (k_ - 1));
  }

  /// u, of the wall, inwards [m]; infinite in ground without cohesion at no pressure.
  /// @param pressure  p_i on the wall [Pa], 0 to p0
  /// @throws InvalidInput  out of range
  [[nodiscard]] double convergence(double pressure) const {
    check(pressure);
    const double two_g = 2 * ground_.elastic.shear_modulus, nu = ground_.elastic.poisson_ratio;
    if (pressure >= critical_) return a_ * (p0_ - pressure) / two_g;
    const double sine = std::sin(ground_.dilation_angle), K = (1 + sine) / (1 - sine);
    const double rho = plastic_radius(pressure) / a_;  // lengths over a: no powers of metres
    const double c0 = -(shift_ + p0_) * (1 - 2 * nu) * (1 + K) / two_g;
    const double c1 = (pressure + shift_) * ((1 - nu) - nu * k_ + K * ((1 - nu) * k_ - nu)) / two_g;
    const double q =
        c0 * (std::pow(rho, K + 1) - 1) / (K + 1) + c1 * (std::pow(rho, K + k_) - 1) / (K + k_);
    return a_ * (std::pow(rho, K + 1) * (p0_ - critical_) / two_g - q);
  }

  /// The pressure under which the wall has come in by `convergence`: the inverse of the curve, by
  /// bisection to the last digit [Pa].
  /// @throws InvalidInput  negative, or more than the unsupported wall comes in
  [[nodiscard]] double pressure_at(double convergence) const {
    require(convergence >= 0 && convergence <= this->convergence(0), "convergence u", convergence,
            ">= 0 and no more than without support");
    return meeting_point(convergence, 0.0);
  }

  /// Where the curve meets a support of flexibility f that was installed at convergence u0: the
  /// pressure dp with u(dp) = u0 + f dp [Pa]; 0 if the ground never reaches u0.
  /// @param installed_at  u0 [m], >= 0
  /// @param flexibility   f, movement of the support per pressure [m/Pa], >= 0
  /// @throws InvalidInput  out of range
  [[nodiscard]] double support_pressure(double installed_at, double flexibility) const {
    require(installed_at >= 0 && std::isfinite(installed_at), "convergence at installation u0",
            installed_at, ">= 0 m");
    require(flexibility >= 0 && std::isfinite(flexibility), "support flexibility f", flexibility,
            ">= 0 m/Pa");
    return convergence(0) <= installed_at ? 0.0 : meeting_point(installed_at, flexibility);
  }

 private:
  void check(double pressure) const {
    require(pressure >= 0 && pressure <= p0_, "support pressure p_i", pressure,
            ">= 0 and no more than the ground pressure p0");
  }
  [[nodiscard]] double meeting_point(double start, double flexibility) const {
    double low = 0, high = p0_;  // convergence(low) >= start + f low, and the reverse at high
    for (;;) {
      const double middle = 0.5 * (low + high);
      if (!(middle > low && middle < high)) return middle;
      (convergence(middle) >= start + flexibility * middle ? low : high) = middle;
    }
  }

  double a_, p0_;
  MohrCoulombGround ground_;
  double k_ = 1, shift_ = 0, critical_ = 0;
};

}  // namespace voussoir
