// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Stiffness of the joints of a mass, per area [Pa/m].
struct JointStiffness {
  double normal;  ///< k_n, > 0
  double shear;   ///< k_s, > 0

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(normal > 0 && std::isfinite(normal), "joint stiffness k_n", normal, "> 0 Pa/m");
    require(shear > 0 && std::isfinite(shear), "joint stiffness k_s", shear, "> 0 Pa/m");
  }
};

/// One set of parallel joints across or along the load, in rock of its own moduli.
///
///   1 / E = 1 / E_i + 1 / (k_n s),   1 / G = 1 / G_i + 1 / (k_s s)
struct JointedModuli {
  double youngs_modulus;  ///< E across the joints [Pa]
  double shear_modulus;   ///< G along them [Pa]: the estimate G1 of the paper, slip of one set
};
/// @param spacing  s [m], > 0
/// @param youngs_modulus, shear_modulus  E_i, G_i of the rock between joints [Pa]; infinite: rigid
/// @throws InvalidInput  a value out of range
/// Source: Goodman, Taylor & Brekke (1968); Boon, Houlsby & Utili (2015), eqs (4)-(6).
[[nodiscard]] VOUSSOIR_INLINE JointedModuli
goodman_moduli(const JointStiffness& joints, double spacing,
               double youngs_modulus = std::numeric_limits<double>::infinity(),
               double shear_modulus = std::numeric_limits<double>::infinity());

/// G = E / (2 (1 + nu)): with E of `goodman_moduli` the estimate G2 of the paper, the stiffest
/// mechanism [Pa].
/// @throws InvalidInput  a value out of range
[[nodiscard]] inline double shear_modulus_from(double youngs_modulus, double poisson_ratio) {
  require(youngs_modulus > 0, "Young's modulus E", youngs_modulus, "> 0 Pa");
  require(poisson_ratio > -1 && poisson_ratio < 0.5, "Poisson's ratio nu", poisson_ratio,
          "> -1 and < 0.5");
  return youngs_modulus / (2 * (1 + poisson_ratio));
}

/// Elastic constants read from one-dimensional compression.
struct OedometerModuli {
  double shear_modulus;        ///< G = (sigma_1 - sigma_3) / (2 eps_1) [Pa]
  double poisson_ratio;        ///< nu = sigma_3 / (sigma_1 + sigma_3) [-]
  double constrained_modulus;  ///< M = sigma_1 / eps_1 [Pa]
};
/// @throws InvalidInput  a value out of range
/// Source: Boon, Houlsby & Utili (2015), eqs (10)-(12).
[[nodiscard]] VOUSSOIR_INLINE OedometerModuli oedometer_moduli(double axial_stress,
                                                               double lateral_stress,
                                                               double axial_strain);

/// A set of parallel fully persistent joints in the plane of the section.
struct PersistentSet {
  double dip;      ///< from the horizontal, positive towards +x (East), negative towards -x [rad]
  double spacing;  ///< [m], > 0

  /// Unit normal; upwards.
  [[nodiscard]] Vec2 normal() const { return {std::sin(dip), std::cos(dip)}; }
};

/// Compliance of rigid blocks between persistent joints, in the order xx, yy, xy with engineering
/// shear strain: the sum over sets of g g^T / (k_n s) + h h^T / (k_s s) [1/Pa].
///
/// Blocks do not turn against each other and no joint slips. One set alone leaves it singular:
/// there is no strain along its joints.
/// @throws InvalidInput  no set, or a value out of range
/// Source: Amadei & Goodman (1981); Gerrard (1982).
[[nodiscard]] VOUSSOIR_INLINE Eigen::Matrix3d joint_compliance(
    const std::vector<PersistentSet>& sets, const JointStiffness& joints);

/// Compression of an anisotropic mass along x or y without strain across it.
enum class CompressedAlong { horizontal, vertical };
/// The shear that goes with it where the sets are not symmetric.
enum class ShearCondition {
  free,      ///< no shear stress: the sample may become a parallelogram
  prevented  ///< no shear strain: a fixed base and smooth vertical sides
};
/// What an oedometer would read on a mass of this compliance.
/// @param compliance  of `joint_compliance` [1/Pa]; regular (two sets at least, not parallel)
/// @throws InvalidInput  singular
[[nodiscard]] VOUSSOIR_INLINE OedometerModuli oedometer_of(const Eigen::Matrix3d& compliance,
                                                           CompressedAlong along,
                                                           ShearCondition shear);

/// Rigid blocks between joints of all orientations alike, `spacing` apart on a scanline:
/// G = (4 / pi) s / (1 / k_n + 1 / k_s), lambda + G = (2 / pi) k_n s.
struct IsotropicModuli {
  double shear_modulus;  ///< G [Pa]
  double bulk_modulus;   ///< lambda + G, of the plane [Pa]
  double poisson_ratio;  ///< nu [-]
};
/// @param spacing  mean joint spacing on scanlines [m], > 0
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE IsotropicModuli isotropic_joint_moduli(const JointStiffness& joints,
                                                                     double spacing);

/// The same in 3-D, as an oedometer would read it: each joint deforms under the mean stress.
///
///   1 / E = P32 (1 / (5 k_n) + 2 / (15 k_s)),   nu / E = P32 (1 / k_s - 1 / k_n) / 15
///
/// That is what the energies of the joints amount to if the stress is the same everywhere, so no
/// mass is softer; one whose blocks hinder each other is stiffer, and its nu is less.
/// @param area_per_volume  P32, joints of all orientations alike [m^2/m^3], > 0
/// @throws InvalidInput  a value out of range; k_s > k_n, which has nu < 0
/// Source: the sum over sets of Amadei & Goodman (1981), its mean over the sphere.
[[nodiscard]] VOUSSOIR_INLINE OedometerModuli
isotropic_joint_oedometer(const JointStiffness& joints, double area_per_volume);

/// Joints per metre on a straight line across persistent sets: sum of |n . d| / s [1/m].
/// @param direction  of the line, from the horizontal, anticlockwise [rad]
/// @throws InvalidInput  a spacing out of range
/// Source: Priest & Hudson (1976).
[[nodiscard]] VOUSSOIR_INLINE double scanline_frequency(const std::vector<PersistentSet>& sets,
                                                        double direction);

/// Rock quality designation for exponential spacings: RQD = 100 (1 + t f) exp(-t f) [%], t the
/// shortest piece that counts, 0.1 m.
/// @param frequency  f, joints per metre [1/m], >= 0
/// @throws InvalidInput  a value out of range
/// Source: Priest & Hudson (1976).
[[nodiscard]] inline double rock_quality_designation(double frequency, double shortest = 0.1) {
  require(frequency >= 0 && std::isfinite(frequency), "joint frequency", frequency, ">= 0 1/m");
  require(shortest > 0 && std::isfinite(shortest), "shortest piece", shortest, "> 0 m");
  return 100 * (1 + shortest * frequency) * std::exp(-shortest * frequency);
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE OedometerModuli isotropic_joint_oedometer(const JointStiffness& joints,
                                                          double area_per_volume) {
  joints.check();
  require(joints.shear <= joints.normal, "joint stiffness k_s", joints.shear, "<= k_n");
  require(area_per_volume > 0 && std::isfinite(area_per_volume), "joint area per volume P32",
          area_per_volume, "> 0 1/m");
  const double along = area_per_volume * (0.2 / joints.normal + 2 / (15 * joints.shear)),
               across = area_per_volume * (1 / joints.shear - 1 / joints.normal) / 15;
  const double nu = across / along, e = 1 / along;
  VOUSSOIR_ASSERT(nu >= 0 && nu < 0.5, "a stable material");
  return {shear_modulus_from(e, nu), nu, e * (1 - nu) / ((1 + nu) * (1 - 2 * nu))};
}

VOUSSOIR_INLINE JointedModuli goodman_moduli(const JointStiffness& joints, double spacing,
                                             double youngs_modulus, double shear_modulus) {
  joints.check();
  require(spacing > 0 && std::isfinite(spacing), "joint spacing s", spacing, "> 0 m");
  require(youngs_modulus > 0, "modulus of the rock E_i", youngs_modulus, "> 0 Pa");
  require(shear_modulus > 0, "modulus of the rock G_i", shear_modulus, "> 0 Pa");
  return {1 / (1 / youngs_modulus + 1 / (joints.normal * spacing)),
          1 / (1 / shear_modulus + 1 / (joints.shear * spacing))};
}

VOUSSOIR_INLINE OedometerModuli oedometer_moduli(double axial_stress, double lateral_stress,
                                                 double axial_strain) {
  require(axial_stress > 0 && std::isfinite(axial_stress), "axial stress sigma_1", axial_stress,
          "> 0 Pa");
  require(lateral_stress >= 0 && lateral_stress <= axial_stress, "lateral stress sigma_3",
          lateral_stress, "0 to the axial stress");
  require(axial_strain > 0 && std::isfinite(axial_strain), "axial strain eps_1", axial_strain,
          "> 0");
  return {(axial_stress - lateral_stress) / (2 * axial_strain),
          lateral_stress / (axial_stress + lateral_stress), axial_stress / axial_strain};
}

VOUSSOIR_INLINE Eigen::Matrix3d joint_compliance(const std::vector<PersistentSet>& sets,
                                                 const JointStiffness& joints) {
  joints.check();
  if (sets.empty()) throw InvalidInput("joint compliance: needs at least one joint set");
  Eigen::Matrix3d compliance = zeros<Eigen::Matrix3d>();
  for (const PersistentSet& set : sets) {
    require(set.spacing > 0 && std::isfinite(set.spacing), "joint spacing s", set.spacing, "> 0 m");
    require(std::isfinite(set.dip), "dip", set.dip, "finite [rad]");
    const Vec2 n = set.normal(), t(n.y(), -n.x());
    const Vec3 g(n.x() * n.x(), n.y() * n.y(), 2 * n.x() * n.y());
    const Vec3 h(n.x() * t.x(), n.y() * t.y(), n.x() * t.y() + n.y() * t.x());
    compliance +=
        outer(g, g) / (joints.normal * set.spacing) + outer(h, h) / (joints.shear * set.spacing);
  }
  return compliance;
}

VOUSSOIR_INLINE OedometerModuli oedometer_of(const Eigen::Matrix3d& compliance,
                                             CompressedAlong along, ShearCondition shear) {
  // Cofactors: Eigen/Core has no solver, and three unknowns need none.
  const Vec3 c0 = column(compliance, 0), c1 = column(compliance, 1), c2 = column(compliance, 2);
  const double determinant = dot_product(c0, cross(c1, c2));
  if (!(std::abs(determinant) > 1e-12 * length_of(c0) * length_of(c1) * length_of(c2)))
    throw InvalidInput("oedometer of a compliance: singular; needs two joint sets that cross");
  Eigen::Matrix3d stiffness;
  set_row(stiffness, 0, cross(c1, c2) / determinant);
  set_row(stiffness, 1, cross(c2, c0) / determinant);
  set_row(stiffness, 2, cross(c0, c1) / determinant);
  const int axial = along == CompressedAlong::horizontal ? 0 : 1, lateral = 1 - axial;
  // gamma such that the shear stress is zero, or zero.
  const double gamma = shear == ShearCondition::free ? -stiffness(2, axial) / stiffness(2, 2) : 0.0;
  return oedometer_moduli(stiffness(axial, axial) + stiffness(axial, 2) * gamma,
                          stiffness(lateral, axial) + stiffness(lateral, 2) * gamma, 1.0);
}

VOUSSOIR_INLINE IsotropicModuli isotropic_joint_moduli(const JointStiffness& joints,
                                                       double spacing) {
  joints.check();
  require(spacing > 0 && std::isfinite(spacing), "joint spacing s", spacing, "> 0 m");
  constexpr double pi = std::numbers::pi;
  const double g = 4 / pi * spacing / (1 / joints.normal + 1 / joints.shear);
  const double bulk = 2 / pi * joints.normal * spacing;
  return {g, bulk, (bulk - g) / (2 * bulk)};
}

VOUSSOIR_INLINE double scanline_frequency(const std::vector<PersistentSet>& sets,
                                          double direction) {
  double frequency = 0;
  for (const PersistentSet& set : sets) {
    require(set.spacing > 0 && std::isfinite(set.spacing), "joint spacing s", set.spacing, "> 0 m");
    frequency +=
        std::abs(dot_product(set.normal(), Vec2(std::cos(direction), std::sin(direction)))) /
        set.spacing;
  }
  return frequency;
}

#endif

}  // namespace voussoir
