// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>
#include <voussoir/theory/elastic_ground.hpp>

namespace voussoir {

/// Radial bolts all around a circular opening, installed before the ground moves and tied to it
/// along their whole length.
struct SmearedBoltPattern {
  double radius;           ///< a, of the opening [m], > 0
  double length;           ///< L [m], > 0
  double angular_spacing;  ///< theta_b, on the full circle [rad], > 0
  /// K_a s_mean = E_b A_b: force over strain of one bolt, axial stiffness across a joint times the
  /// mean joint spacing [N], > 0
  double axial_rigidity;
  double out_of_plane = 1;  ///< s_l, spacing along the tunnel [m], > 0

  /// s_theta = a theta_b, along the wall [m]
  [[nodiscard]] double wall_spacing() const { return radius * angular_spacing; }

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(radius > 0 && std::isfinite(radius), "radius a", radius, "> 0 m");
    require(length > 0 && std::isfinite(length), "bolt length L", length, "> 0 m");
    require(angular_spacing > 0 && std::isfinite(angular_spacing), "bolt spacing theta_b",
            angular_spacing, "> 0 rad");
    require(axial_rigidity > 0 && std::isfinite(axial_rigidity), "bolt rigidity K_a s_mean",
            axial_rigidity, "> 0 N");
    require(out_of_plane > 0 && std::isfinite(out_of_plane), "bolt spacing s_l", out_of_plane,
            "> 0 m");
  }
};

/// What the stress at the wall of a bolted opening is made of.
enum class BoltHead {
  /// Ground and bolts together carry the wall pressure: in equilibrium. The default.
  total_stress,
  /// The ground alone does, and the force at the bolt heads has no reaction: not in equilibrium
  /// (the wall can move further than without bolts). To recognise implementations that do this.
  rock_only,
};

/// Elastic ground around a circular opening, stiffened by smeared radial bolts; plane strain.
///
///   (r + kappa a) u'' + u' - u / r = 0       in the bolted ring  a <= r <= b = a + L
///   u = -C r J(r),  J(r) = 1 / (b (2 b + c)) + I(b) - I(r),  c = kappa a
///   I(r) = [ln(1 + c / r) - c / r] / c^2
///
/// and u = const / r beyond. beta = K_a s_mean / (s_theta s_l 2 G) is the stiffness of the bolts
/// over that of the ground (eq. (3) of the paper) and kappa = beta (1 - 2 nu) / (1 - nu). The force
/// left in the bolts at their end goes into the ground there as a line load.
///
/// Source: derived from equilibrium, Hooke's law and bolts that follow the ground; the equation is
/// that of Carranza-Torres (2009), Rock Mech. Rock Eng. 42, as used by Boon, Houlsby & Utili
/// (2015), Appendix A. Elastic bolts hold the wall back by 1 to 6 %: what they hold in jointed rock
/// is what came loose.
class SmearedBolts {
 public:
  /// @param release  p0 - p_i, the part of the isotropic ground pressure that is taken off the wall
  ///                 after the bolts are in place [Pa], >= 0
  /// @throws InvalidInput  a value out of range
  SmearedBolts(const SmearedBoltPattern& bolts, const ElasticGround& ground, double release,
               BoltHead head = BoltHead::total_stress)
      : bolts_(bolts) {
    bolts.check();
    ground.check();
    require(std::isfinite(ground.shear_modulus), "shear modulus G", ground.shear_modulus,
            "finite [Pa]");
    require(release >= 0 && std::isfinite(release), "pressure taken off the wall, p0 - p_i",
            release, ">= 0 Pa (the support pressure p_i is not above p0)");
    const double nu = ground.poisson_ratio, a = bolts.radius, b = a + bolts.length;
    beta_ = bolts.axial_rigidity /
            (bolts.wall_spacing() * bolts.out_of_plane * 2 * ground.shear_modulus);
    kappa_ = beta_ * (1 - 2 * nu) / (1 - nu);
    c_ = kappa_ * a;
    end_ = 1 / (b * (2 * b + c_)) + integral(b);
    const double lambda = ground.lame_constant(), m = ground.constrained_modulus();
    factor_ =
        head == BoltHead::total_stress
            ? release /
                  (m / (a * a) - (2 * lambda + 2 * ground.shear_modulus + m * kappa_) * ratio(a))
            : release / (m / (a * (a + c_)) - (2 * lambda + 2 * ground.shear_modulus) * ratio(a));
  }

  /// Bolt stiffness over ground stiffness [-].
  [[nodiscard]] double beta() const { return beta_; }
  [[nodiscard]] double kappa() const { return kappa_; }

  /// Displacement towards the centre [m].
  /// @param distance  r [m], >= a
  /// @throws InvalidInput  inside the opening
  [[nodiscard]] double inward(double distance) const {
    check(distance);
    const double b = bolts_.radius + bolts_.length;
    return distance <= b ? factor_ * distance * ratio(distance)
                         : factor_ * ratio(b) * b * (b / distance);
  }
  /// Of the wall [m].
  [[nodiscard]] double convergence() const { return inward(bolts_.radius); }

  /// Strain of ground and bolt along the radius, tension positive [-]; beyond the bolts that of the
  /// ground.
  [[nodiscard]] double radial_strain(double distance) const {
    check(distance);
    const double b = bolts_.radius + bolts_.length;
    if (distance > b) return factor_ * ratio(b) * (b / distance) * (b / distance);
    return factor_ * (1 / (distance * (distance + c_)) - ratio(distance));
  }
  /// Tension of one bolt [N]; 0 beyond its end.
  [[nodiscard]] double bolt_force(double distance) const {
    check(distance);
    if (distance > bolts_.radius + bolts_.length) return 0;
    return bolts_.axial_rigidity * radial_strain(distance);
  }

 private:
  void check(double distance) const {
    require(distance >= bolts_.radius && std::isfinite(distance), "distance r", distance,
            ">= the radius of the opening");
  }
  /// I(r) [1/m^2].
  [[nodiscard]] double integral(double r) const {
    const double x = c_ / r;
    // For weak bolts the two terms cancel; the series of ln(1 + x) to x^9 is exact to rounding.
    if (x < 0.02) {
      double sum = 0, power = 1;
      for (int n = 2; n < 11; ++n, power *= -x) sum -= power / n;
      return sum / (r * r);
    }
    return (std::log1p(x) - x) / (c_ * c_);
  }
  /// J(r) [1/m^2].
  [[nodiscard]] double ratio(double r) const { return end_ - integral(r); }

  SmearedBoltPattern bolts_;
  double beta_ = 0, kappa_ = 0, c_ = 0, end_ = 0;
  double factor_ = 0;  ///< C in u = -C r J(r) [m^2]
};

}  // namespace voussoir
