// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/mobilised_roughness.hpp>
#include <voussoir/contact/shear_spring.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A rough, unfilled joint described by what is logged in the field: JRC and JCS. Its roughness is
/// mobilised as it is sheared, lifts it, and is worn.
///
///   closure    sigma_n = K_ni V / (1 - V / V_m),  V = V(sigma_0) - g + d
///   strength   tau = sigma_n tan( JRC_mob / JRC i + phi_r ),  i = JRC_n log10(JCS_n / sigma_n),
///              no more than leads to 70 degrees at the peak;  JRC_mob / JRC of x / delta_p:
///              `detail::MobilisedRoughness`
///   shear      T = w tau as long as the joint slips, else T = -k_s w (s - q - e0)
///   dilation   dd = tan( JRC_mob / JRC i / M ) dx
///   peak slip  delta_p = (L_n / 500) (JRC_n / L_n)^0.33   [m]
///
/// with the scale corrections JRC_n = JRC (L_n/L_0)^(-0.02 JRC), JCS_n = JCS (L_n/L_0)^(-0.03 JRC).
/// V closure from the stress-free state, found from the in-situ stress sigma_0; g opening and s
/// slip since; e0 the slip at which the spring carries the in-situ shear; q plastic slip; w weight
/// of the point; L_0 length of the sample, L_n of the joint between crossing joints. The closure
/// curve holds up to `largest_stress`; beyond it goes on along its tangent, for a stiffness without
/// bound would have no stable time step.
///
/// x is the displacement on the source's curve: where a spring that does not slip further would
/// exceed the strength at x by k_s dx, x goes on by dx. Under one normal stress dx is the shear
/// displacement, and the shear is that of the curve, elastic part included. Let go and sheared back
/// the joint follows its spring, then the curve from where it had left it: x is the length of the
/// path, and a joint that is sheared back lifts on (in a shear box it would sink first). In situ it
/// stands on the rising branch, where that carries its shear.
///
/// k_s is the steepest rise of the curve at the largest stress that the point has borne; on the way
/// to phi_r, below which nothing slips, mostly that of the curve's beginning, tan(phi_r) sigma_n /
/// (0.3 delta_p). Closure and elastic slip each have a potential of their own, k_s only grows,
/// under an unchanged force, and what dilation lifts, the friction pays: no path of a point gains
/// energy (docs/theory.md, "Rough joints").
/// The source's stiffness follows the stress of the moment; with that a joint sheared under low
/// stress, pressed, sheared back and unloaded gives 271 J/m2 where 109 were stored.
///
/// Source: Barton & Choubey (1977), Rock Mech. 10, 1-54; Barton & Bandis (1982), 23rd US Symp. Rock
/// Mech., 739-760; Bandis, Lumsden & Barton (1983), Int. J. Rock Mech. Min. Sci. 20, 249-268;
/// Barton, Bandis & Bakhtar (1985), Int. J. Rock Mech. Min. Sci. 22, 121-140.
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
    /// M [-], >= 1: the joint dilates by 1/M of the angle of its roughness. The source has 1 to 2,
    /// with the stress; 2 lifts least. Infinity: no dilation.
    double damage_coefficient = 2;
    /// By which tau is divided, whatever the stress: for strength reduction [-], > 0. Stiffness and
    /// dilation stay, the latter as far as what is left of the friction pays for it.
    double strength_divisor = 1;
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
  struct State : ShearSpring<Dim> {
    double displacement = 0;  ///< x, on the curve of mobilised roughness [m]
    double dilation = 0;      ///< d [m]
    double stiffness = 0;     ///< k_s; 0: nothing has happened to the point [Pa/m]
  };

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
    require(p_.damage_coefficient >= 1, "damage_coefficient", p_.damage_coefficient, ">= 1");
    require(p_.strength_divisor > 0 && std::isfinite(p_.strength_divisor), "strength_divisor",
            p_.strength_divisor, "> 0");
    const double scale = p_.joint_length / p_.sample_length;
    roughness_ = p_.roughness * elementary::power(scale, -0.02 * p_.roughness);
    wall_strength_ = p_.wall_strength * elementary::power(scale, -0.03 * p_.roughness);
    peak_slip_ = p_.joint_length / 500 *
                 elementary::power(std::max(roughness_, 1e-3) / p_.joint_length, 0.33);
    residual_angle_ = std::min(p_.residual_friction_angle, steepest_angle);
    tan_residual_ = elementary::tangent(residual_angle_) / p_.strength_divisor;
    largest_closure_ = closure_on_curve(p_.largest_stress);
    const double left = 1 - largest_closure_ / p_.maximum_closure;
    largest_stiffness_ = p_.initial_stiffness / (left * left);
    largest_shear_stiffness_ = steepest_rise(p_.largest_stress);
  }

  [[nodiscard]] const Params& params() const { return p_; }

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
  [[nodiscard]] double peak_strength(double stress) const { return strength(stress, peak_slip_); }
  /// Shear strength where the joint has come to a displacement on the source's curve [Pa].
  /// @param displacement  shear displacement under one normal stress [m], >= 0; below 0.3 delta_p
  ///                      the strength is that of phi_r
  [[nodiscard]] double strength(double stress, double displacement) const {
    return stress > 0 ? stress * friction(roughness_angle(stress), displacement) : 0.0;
  }
  [[nodiscard]] double roughness() const { return roughness_; }          ///< JRC_n [-]
  [[nodiscard]] double wall_strength() const { return wall_strength_; }  ///< JCS_n [Pa]
  [[nodiscard]] double peak_slip() const { return peak_slip_; }          ///< delta_p [m]

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const Response<Dim> now = respond(load, state);
    return {now.stress * load.weight, now.shear};
  }

  /// @return  the friction work less what dilation stores, and what shear loses where the joint has
  ///          opened or closed, or has become stiffer [J]
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    const Response<Dim> now = respond(load, state);
    const double stiffness = shear_stiffness(load, state);
    const Vec<Dim - 1> initial = initial_shear(load);
    double lost = state.commit(load, initial, stiffness, now.shear);
    lost -= now.stress * load.weight * now.lift;
    if (state.stiffness == 0 || now.slips) state.displacement = now.displacement;
    state.dilation += now.lift;
    state.stiffness = std::max(stiffness, shear_stiffness_under(now.stress));
    if (state.stiffness > stiffness) {
      // The force stays; a stiffer spring holds less energy with it.
      const double before = stiffness * load.weight, after = state.stiffness * load.weight;
      lost += 0.5 * now.shear.squaredNorm() * (1 / before - 1 / after);
      state.plastic_slip = load.motion.slip + (now.shear - initial) / after;
    }
    return lost;
  }

  /// Where the curve begins, lifted by the dilation so far.
  template <int Dim>
  [[nodiscard]] double release_opening(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return closure(load.initial.normal / load.weight) + state.dilation;
  }

  [[nodiscard]] bool dilates() const {
    return roughness_ > 0 && !std::isinf(p_.damage_coefficient);
  }
  /// In the mean over a joint each point has the weight of its normal force, which the lift works
  /// against.
  template <int Dim>
  [[nodiscard]] PointLift lift(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double stiffness = shear_stiffness(load, state), from = displacement(load, state),
                 stress = this->stress(elastic_closure(load, state)),
                 tried = state.force(load, initial_shear(load), stiffness).norm() / load.weight;
    if (tried <= stress * tan_residual_ || tried <= strength(stress, from))
      return {stress * load.weight, 0};
    return {stress * load.weight, slip_under(stress, tried, stiffness, from).lift};
  }

  /// The area under the closure curve, and T^2 / (2 k_s w).
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const Response<Dim> now = respond(load, state);
    const double v = std::max(0.0, elastic_closure(load, state) + (load.lift < 0 ? now.lift : 0.0)),
                 on_curve = std::min(v, largest_closure_);
    const double r = on_curve / p_.maximum_closure, beyond = v - on_curve;
    // Integral of K V / (1 - V/Vm): -K Vm^2 (ln(1 - r) + r).
    const double normal =
        -p_.initial_stiffness * p_.maximum_closure * p_.maximum_closure * (std::log1p(-r) + r) +
        beyond * (p_.largest_stress + 0.5 * largest_stiffness_ * beyond);
    return load.weight * normal +
           State<Dim>::stored_energy(load, now.shear, shear_stiffness(load, state));
  }

  /// Damage: the part of its roughness that is worn since the peak.
  template <int Dim>
  [[nodiscard]] ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const Response<Dim> now = respond(load, state);
    const double spring = shear_stiffness(load, state);
    const Vec<Dim - 1> plastic =
        load.motion.slip + (now.shear - initial_shear(load)) / (spring * load.weight);
    const bool is_past_peak = roughness_ > 0 && now.displacement > peak_slip_;
    return {.normal = now.stress * load.weight,
            .shear = now.shear.norm(),
            .opening = load.parted(),
            .plastic_slip = plastic.norm(),
            .damage = is_past_peak
                          ? 1 - detail::MobilisedRoughness::at(now.displacement / peak_slip_)
                          : 0,
            .is_open = now.stress == 0,
            .is_slipping = slips_on(*this, load, state, spring)};
  }

  /// The largest on the curve: at `largest_stress` [Pa/m].
  [[nodiscard]] double joint_normal_stiffness() const { return largest_stiffness_; }
  [[nodiscard]] double joint_shear_stiffness() const { return largest_shear_stiffness_; }

 private:
  [[nodiscard]] double closure_on_curve(double stress) const {
    return stress * p_.maximum_closure / (p_.initial_stiffness * p_.maximum_closure + stress);
  }
  template <int Dim>
  struct Response {
    double stress;        ///< sigma_n [Pa]
    Vec<Dim - 1> shear;   ///< T [N]
    double displacement;  ///< x [m]
    double lift = 0;      ///< new dilation [m]
    bool slips = false;
  };

  /// i [rad]: so much steeper than phi_r is the joint at its peak.
  [[nodiscard]] double roughness_angle(double stress) const {
    const double most = steepest_angle - residual_angle_;
    if (!(stress > 0)) return roughness_ > 0 ? most : 0.0;
    const double angle = roughness_ * (std::numbers::log10e * std::numbers::pi / 180) *
                         elementary::logarithm(wall_strength_ / stress);
    return std::clamp(angle, 0.0, most);
  }
  /// tau / sigma_n at a displacement on the curve [-]. @param angle  i [rad]
  [[nodiscard]] double friction(double angle, double displacement) const {
    const double part = detail::MobilisedRoughness::at(displacement / peak_slip_);
    return part == 0 ? tan_residual_
                     : elementary::tangent(residual_angle_ + part * angle) / p_.strength_divisor;
  }
  /// Of the curve, and of what the spring must be stiffer than that for the slip on it to pay for
  /// its dilation [Pa/m]: on the straight line to 0.3 delta_p, or at 0.6, after which the curve
  /// rises less.
  [[nodiscard]] double steepest_rise(double stress) const {
    constexpr auto from = detail::MobilisedRoughness::knots[0],
                   to = detail::MobilisedRoughness::knots[1];
    const double angle = to.part * roughness_angle(stress);
    const double friction = elementary::tangent(residual_angle_ + angle),
                 lift = elementary::tangent(angle / p_.damage_coefficient);
    const double rise = angle * (1 + friction * friction) / (to.ratio - from.ratio);
    // At most twice: with phi_r next to nothing and M = 1 there is hardly anything to pay with.
    const double paid = std::max(0.5, 1 - lift / friction);
    return stress / peak_slip_ *
           std::max(p_.strength_divisor * tan_residual_ / from.ratio, rise / paid);
  }
  /// k_s of a point that has borne no more than a stress [Pa/m].
  [[nodiscard]] double shear_stiffness_under(double stress) const {
    return std::min(steepest_rise(std::max(stress, 0.01 * p_.largest_stress)),
                    largest_shear_stiffness_);
  }
  template <int Dim>
  [[nodiscard]] double elastic_closure(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return closure(load.initial.normal / load.weight) - load.motion.opening + state.dilation;
  }
  /// k_s [Pa/m].
  template <int Dim>
  [[nodiscard]] double shear_stiffness(const PointLoad<Dim>& load, const State<Dim>& state) const {
    if (state.stiffness > 0) return state.stiffness;
    return shear_stiffness_under(
        std::max(load.initial.normal / load.weight, stress(elastic_closure(load, state))));
  }
  /// x, before the point slips further [m].
  template <int Dim>
  [[nodiscard]] double displacement(const PointLoad<Dim>& load, const State<Dim>& state) const {
    if (state.stiffness > 0) return state.displacement;
    const double stress = load.initial.normal / load.weight,
                 shear = initial_shear(load).norm() / load.weight;
    if (!(shear > stress * tan_residual_)) return 0;
    const double angle =
                     elementary::angle_of(p_.strength_divisor * shear, stress) - residual_angle_,
                 most = roughness_angle(stress);
    return peak_slip_ *
           (angle < most ? detail::MobilisedRoughness::ratio_before_peak(angle / most) : 1.0);
  }
  /// None where nothing presses in situ: there the curve has no shear to begin with.
  template <int Dim>
  [[nodiscard]] static Vec<Dim - 1> initial_shear(const PointLoad<Dim>& load) {
    return load.initial.normal > 0 ? load.initial.tangential : zeros<Vec<Dim - 1>>();
  }
  template <int Dim>
  [[nodiscard]] Response<Dim> respond(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double stiffness = shear_stiffness(load, state), closed = elastic_closure(load, state);
    Response<Dim> r{stress(closed), state.force(load, initial_shear(load), stiffness),
                    displacement(load, state), std::max(0.0, load.lift)};
    const double spring = r.shear.norm(), tried = spring / load.weight;
    // No strength is below that of phi_r: nearly everywhere, and without a logarithm.
    if (tried <= r.stress * tan_residual_ || tried <= strength(r.stress, r.displacement)) return r;
    const Slip slip = load.lift < 0 ? slide(closed, tried, stiffness, r.displacement)
                                    : slip_under(r.stress, tried, stiffness, r.displacement);
    r.stress = slip.stress;
    r.displacement = slip.displacement;
    if (load.lift < 0) r.lift = slip.lift;
    r.slips = r.stress > 0;  // what an open joint slips wears no teeth
    r.shear *= spring > 0 ? std::min(1.0, slip.shear / tried) : 0.0;
    return r;
  }

  struct Slip {
    double stress, shear;  ///< [Pa]
    double displacement, lift;
  };
  /// Slip under a normal stress that is known. @see slide
  [[nodiscard]] Slip slip_under(double stress, double tried, double stiffness, double from) const {
    Slip s{stress, 0, 0, 0};
    const double angle = roughness_angle(stress);
    // A spring stiffer than the curve is at phi_r before its 0.3 of the peak slip.
    const double start =
        std::max(from, std::min(stress * tan_residual_ / stiffness,
                                detail::MobilisedRoughness::knots[0].ratio * peak_slip_));
    const double over = std::max(0.0, tried - stress * friction(angle, start));
    s.displacement = start + over / stiffness;
    const double now = friction(angle, s.displacement);
    s.shear = std::min(stress * now, tried);
    if (std::isinf(p_.damage_coefficient)) return s;
    const double part =
        detail::MobilisedRoughness::mean(start / peak_slip_, s.displacement / peak_slip_);
    if (part == 0) return s;
    const double steepness = elementary::tangent(part * angle / p_.damage_coefficient);
    // No more than its friction pays for.
    s.lift = std::min(over * steepness, now * (tried - s.shear)) / stiffness;
    return s;
  }
  /// Slip of a joint of which a spring tries more than its strength.
  /// @param closed  its closure without further dilation [m], below 0: it would be open
  /// @param tried   shear of the spring without further slip [Pa]
  [[nodiscard]] Slip slide(double closed, double tried, double stiffness, double from) const {
    // The lift presses the joint shut, and the more it does the less it slips and lifts: the root
    // of closure(sigma) - closed - lift(sigma) lies between no lift, or where an open joint begins
    // to close, and what that lift or the friction alone would hold.
    double low = stress(closed);
    Slip s = slip_under(low, tried, stiffness, from);
    double before = std::max(0.0, -closed) - s.lift;
    if (!(before < 0)) return closed > 0 ? s : Slip{0, 0, from, 0};
    double high = std::min(stress(closed + s.lift), tried / tan_residual_);
    s = slip_under(high, tried, stiffness, from);
    double beyond = closure(high) - closed - s.lift;
    bool was_low = false;
    // Illinois' false position. The lift returned is that of the stress returned, to rounding.
    for (int k = 0; k < 100 && beyond > 0 && high - low > 1e-14 * high; ++k) {
      const double next = low - (high - low) * before / (beyond - before);
      s = slip_under(next, tried, stiffness, from);
      const double error = closure(next) - closed - s.lift;
      if (std::abs(error) <= 1e-13 * p_.maximum_closure) break;
      if (error < 0) {
        low = next;
        before = error;
        if (was_low) beyond *= 0.5;
      } else {
        high = next;
        beyond = error;
        if (!was_low && k > 0) before *= 0.5;
      }
      was_low = error < 0;
    }
    s.lift = closure(s.stress) - closed;
    return s;
  }

  static constexpr double steepest_angle = 70 * std::numbers::pi / 180;

  Params p_;
  double roughness_ = 0, wall_strength_ = 0, peak_slip_ = 0;
  double residual_angle_ = 0, tan_residual_ = 0;
  double largest_closure_ = 0, largest_stiffness_ = 0, largest_shear_stiffness_ = 0;
};

static_assert(ContactLaw<BartonBandisJoint, 2> && ContactLaw<BartonBandisJoint, 3>);

}  // namespace voussoir
