// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/shear_spring.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A rough, unfilled joint described by what is logged in the field: JRC and JCS.
///
///   closure   sigma_n = K_ni V / (1 - V / V_m)
///   strength  tau_p = sigma_n tan( JRC_n log10(JCS_n / sigma_n) + phi_r ), at most 70 degrees
///   shear     T = -k_s w (s - q - e0), k_s = tau_p(sigma_0) / delta_p,
///             delta_p = (L_n / 500) (JRC_n / L_n)^0.33   [m]
///
/// with the scale corrections JRC_n = JRC (L_n/L_0)^(-0.02 JRC), JCS_n = JCS (L_n/L_0)^(-0.03 JRC).
/// V closure from the stress-free state, found from the in-situ stress; e0 the slip at which the
/// spring carries the in-situ shear; q plastic slip; w weight of the point; L_0 length of the
/// sample, L_n of the joint between crossing joints; sigma_0 the point's in-situ normal stress, at
/// least a hundredth of `largest_stress` (a contact made later has none). The closure curve holds
/// up to `largest_stress`; beyond it goes on along its tangent, for a stiffness without bound would
/// have no stable time step.
///
/// Closure and elastic slip have each a potential of their own and slip only dissipates: no path
/// gains energy. The source's k_s follows the stress of the moment; with that a joint sheared under
/// low stress, pressed, sheared back and unloaded gives 271 J/m2 where 109 were stored, for no
/// potential of closure and slip has such a spring unless shear also opens the joint. Peak strength
/// stays peak: wear of the roughness is not modelled.
///
/// Source: Barton & Choubey (1977), Rock Mech. 10, 1-54; Barton & Bandis (1982), 23rd US Symp. Rock
/// Mech., 739-760; Bandis, Lumsden & Barton (1983), Int. J. Rock Mech. Min. Sci. 20, 249-268.
class BartonBandisJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "BartonBandisJoint";

  struct Params {
    double roughness;                ///< JRC of the sample [-], 0 to 20
    double wall_strength;            ///< JCS of the sample [Pa], >= 1e4
    double residual_friction_angle;  ///< phi_r [rad], > 0 and < pi/2
    double initial_stiffness;        ///< K_ni [Pa/m], >= 1e3
    double maximum_closure;          ///< V_m [m], > 0
    double sample_length = 0.1;      ///< L_0 [m], > 0
    double joint_length = 0.1;       ///< L_n [m], >= L_0
    double largest_stress = 5e6;     ///< up to which the closure curve is followed [Pa], >= 1e3
  };

  /// K_ni and V_m of a joint under its first loads, from JRC, JCS and the strength of the rock.
  ///
  ///   a_j = (JRC/5) (0.2 sigma_c/JCS - 0.1) mm
  ///   K_ni = -7.15 + 1.75 JRC + 0.02 JCS/a_j  MPa/mm,  V_m = -0.296 - 0.0056 JRC + 2.241
  ///   (JCS/a_j)^-0.245  mm,  JCS in MPa
  ///
  /// Source: Bandis et al. (1983), first cycle.
  /// @param uniaxial_strength  sigma_c of the rock [Pa], >= JCS
  /// @throws InvalidInput  out of range, or the formulas give no positive stiffness or closure
  [[nodiscard]] static Params from_index_tests(double roughness, double wall_strength,
                                               double residual_friction_angle,
                                               double uniaxial_strength) {
    require(roughness > 0 && roughness <= 20, "JRC", roughness, "> 0 and <= 20");
    require(wall_strength > 0 && wall_strength <= uniaxial_strength, "JCS", wall_strength,
            "> 0 Pa and <= sigma_c");
    const double jcs = 1e-6 * wall_strength;
    const double aperture = roughness / 5 * (0.2 * uniaxial_strength / wall_strength - 0.1);
    const double stiffness = -7.15 + 1.75 * roughness + 0.02 * jcs / aperture;
    const double closure =
        -0.296 - 0.0056 * roughness + 2.241 * elementary::power(jcs / aperture, -0.245);
    require(stiffness > 0, "K_ni from JRC and JCS", stiffness, "> 0 MPa/mm");
    require(closure > 0, "V_m from JRC and JCS", closure, "> 0 mm");
    return {roughness, wall_strength, residual_friction_angle, 1e9 * stiffness, 1e-3 * closure};
  }

  template <int Dim>
  using State = ShearSpring<Dim>;

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit BartonBandisJoint(const Params& params) : BartonBandisJoint(params, any_units) {
    require_plausible(p_.wall_strength, "JCS", "Pa", 1e4, "MPa", 1e6);
    require_plausible(p_.initial_stiffness, "K_ni", "Pa/m", 1e3, "GPa/m", 1e9);
    require_plausible(p_.largest_stress, "largest_stress", "Pa", 1e3, "MPa", 1e6);
  }
  /// The same for values that are not in SI units: all > 0.
  BartonBandisJoint(const Params& params, AnyUnits) : p_(params) {
    require(p_.roughness >= 0 && p_.roughness <= 20, "JRC", p_.roughness, ">= 0 and <= 20");
    require(p_.wall_strength > 0 && std::isfinite(p_.wall_strength), "JCS", p_.wall_strength,
            "> 0 Pa");
    require_angle(
        p_.residual_friction_angle > 0 && p_.residual_friction_angle < 0.5 * std::numbers::pi,
        "residual_friction_angle", p_.residual_friction_angle, "> 0 and < pi/2 rad");
    require(p_.initial_stiffness > 0 && std::isfinite(p_.initial_stiffness), "K_ni",
            p_.initial_stiffness, "> 0 Pa/m");
    require(p_.maximum_closure > 0 && std::isfinite(p_.maximum_closure), "V_m", p_.maximum_closure,
            "> 0 m");
    require(p_.sample_length > 0 && std::isfinite(p_.sample_length), "sample_length",
            p_.sample_length, "> 0 m");
    require(p_.joint_length >= p_.sample_length && std::isfinite(p_.joint_length), "joint_length",
            p_.joint_length, ">= sample_length");
    require(p_.largest_stress > 0 && std::isfinite(p_.largest_stress), "largest_stress",
            p_.largest_stress, "> 0 Pa");
    const double scale = p_.joint_length / p_.sample_length;
    roughness_ = p_.roughness * elementary::power(scale, -0.02 * p_.roughness);
    wall_strength_ = p_.wall_strength * elementary::power(scale, -0.03 * p_.roughness);
    peak_slip_ = p_.joint_length / 500 *
                 elementary::power(std::max(roughness_, 1e-3) / p_.joint_length, 0.33);
    largest_closure_ = closure_on_curve(p_.largest_stress);
    const double left = 1 - largest_closure_ / p_.maximum_closure;
    largest_stiffness_ = p_.initial_stiffness / (left * left);
  }

  /// Normal stress at a closure [Pa]; 0 where the joint is open (V <= 0).
  [[nodiscard]] double stress(double closure) const {
    if (closure <= 0) return 0;
    if (closure > largest_closure_)
      return p_.largest_stress + largest_stiffness_ * (closure - largest_closure_);
    return p_.initial_stiffness * closure / (1 - closure / p_.maximum_closure);
  }
  /// Closure at a normal stress [m].
  [[nodiscard]] double closure(double stress) const {
    if (stress > p_.largest_stress)
      return largest_closure_ + (stress - p_.largest_stress) / largest_stiffness_;
    return closure_on_curve(std::max(stress, 0.0));
  }
  /// Peak shear strength at a normal stress [Pa].
  [[nodiscard]] double peak_strength(double stress) const {
    if (stress <= 0) return 0;
    constexpr double degree = std::numbers::pi / 180, steepest = 70 * degree;
    const double angle = p_.residual_friction_angle +
                         std::max(0.0, roughness_ * std::numbers::log10e *
                                           elementary::logarithm(wall_strength_ / stress)) *
                             degree;
    return stress * elementary::tangent(std::min(angle, steepest));
  }
  [[nodiscard]] double roughness() const { return roughness_; }          ///< JRC_n [-]
  [[nodiscard]] double wall_strength() const { return wall_strength_; }  ///< JCS_n [Pa]
  [[nodiscard]] double peak_slip() const { return peak_slip_; }          ///< delta_p [m]

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double sigma = normal_stress(load);
    return {sigma * load.weight, shear(load, state, sigma)};
  }

  /// @return  the friction work, and what shear loses where the joint has opened or closed [J]
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    return state.commit(load, initial_shear(load), shear_stiffness(load),
                        shear(load, state, normal_stress(load)));
  }

  /// Where the curve begins.
  template <int Dim>
  [[nodiscard]] double release_opening(const PointLoad<Dim>& load, const State<Dim>&) const {
    return closure(load.initial.normal / load.weight);
  }

  /// The area under the closure curve, and T^2 / (2 k_s w), k_s a number of the point.
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    const double v = std::max(0.0, present_closure(load)), on_curve = std::min(v, largest_closure_);
    const double r = on_curve / p_.maximum_closure, beyond = v - on_curve;
    // Integral of K V / (1 - V/Vm): -K Vm^2 (ln(1 - r) + r).
    const double normal =
        -p_.initial_stiffness * p_.maximum_closure * p_.maximum_closure * (std::log1p(-r) + r) +
        beyond * (p_.largest_stress + 0.5 * largest_stiffness_ * beyond);
    const double shear = now.tangential.squaredNorm();
    return load.weight * normal + 0.5 * shear / (shear_stiffness(load) * load.weight);
  }

  /// Its shear spring is as stiff as the in-situ stress has made it. No wear: no damage.
  template <int Dim>
  [[nodiscard]] ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    const double spring = shear_stiffness(load) * load.weight;
    const Vec<Dim - 1> sliding =
        load.motion.slip - state.plastic_slip + (now.tangential - initial_shear(load)) / spring;
    return {.normal = now.normal,
            .shear = now.tangential.norm(),
            .opening = load.motion.opening,
            .plastic_slip = (state.plastic_slip + sliding).norm(),
            .is_open = now.normal == 0,
            .is_slipping = slips_on(*this, load, state, shear_stiffness(load))};
  }

  /// The largest on the curve: at `largest_stress` [Pa/m].
  [[nodiscard]] double joint_normal_stiffness() const { return largest_stiffness_; }
  [[nodiscard]] double joint_shear_stiffness() const {
    return peak_strength(p_.largest_stress) / peak_slip_;
  }

 private:
  [[nodiscard]] double closure_on_curve(double stress) const {
    return stress * p_.maximum_closure / (p_.initial_stiffness * p_.maximum_closure + stress);
  }
  template <int Dim>
  [[nodiscard]] double present_closure(const PointLoad<Dim>& load) const {
    return closure(load.initial.normal / load.weight) - load.motion.opening;
  }
  template <int Dim>
  [[nodiscard]] double normal_stress(const PointLoad<Dim>& load) const {
    return stress(present_closure(load));
  }
  /// Of a point, whatever its stress is now [Pa/m].
  template <int Dim>
  [[nodiscard]] double shear_stiffness(const PointLoad<Dim>& load) const {
    const double in_situ = std::max(load.initial.normal / load.weight, 0.01 * p_.largest_stress);
    return std::min(peak_strength(in_situ) / peak_slip_, joint_shear_stiffness());
  }
  /// None where nothing presses in situ: there the curve has no shear to begin with.
  template <int Dim>
  [[nodiscard]] static Vec<Dim - 1> initial_shear(const PointLoad<Dim>& load) {
    return load.initial.normal > 0 ? load.initial.tangential : zeros<Vec<Dim - 1>>();
  }
  /// Of the spring, shortened to what the strength allows [N].
  template <int Dim>
  [[nodiscard]] Vec<Dim - 1> shear(const PointLoad<Dim>& load, const State<Dim>& state,
                                   double sigma) const {
    const Vec<Dim - 1> elastic = state.force(load, initial_shear(load), shear_stiffness(load));
    const double most = sigma > 0 ? peak_strength(sigma) * load.weight : 0.0;
    if (const double size = elastic.norm(); size > most)
      return Vec<Dim - 1>(elastic * (most / size));
    return elastic;
  }

  Params p_;
  double roughness_ = 0, wall_strength_ = 0, peak_slip_ = 0;
  double largest_closure_ = 0, largest_stiffness_ = 0;
};

static_assert(ContactLaw<BartonBandisJoint, 2> && ContactLaw<BartonBandisJoint, 3>);

}  // namespace voussoir
