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

/// A joint with cohesion and tensile strength that opens as it slips, and weakens when it fails.
///
///   N = N0 - k_n w (g - d),   N >= -sigma_t w, else it breaks there and N = 0
///   |T| <= c w + N tan(phi),  T = T0 - k_s w (s - q)
///   d = tan(psi) min(Q, Q_max), Q the length of the path of q
///
/// Symbols as in CoulombJoint; d dilation, psi its angle. While a point slips, dilation presses the
/// joint shut, which raises the strength in the same step, and may keep it from opening: force is a
/// continuous function of motion until cohesion or tensile strength is lost. A point that has
/// reached its strength has failed: from the next commit on cohesion and friction are the residual
/// ones, and there is no tensile strength. With c = sigma_t = psi = 0 it is a CoulombJoint.
///
/// All points of a joint lift it by one way, d (`PointLoad::lift`); one that is alone as above.
///
/// Tension breaks a joint from where it opens most: what has opened by more than the bond stretches
/// (sigma_t / k_n) has lost tensile strength and cohesion, the rest still bears (`bonded_part`).
/// What fails in shear lets all of the joint go in tension.
///
/// Weakening changes the force at a commit: a search for equilibrium goes on after it
/// (`System::commit` counts such points).
///
/// Source: Goodman (1976), Methods of geological engineering; non-associated flow with a limited
/// dilation as in Itasca's joint models.
class MohrCoulombJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "MohrCoulombJoint";

  struct Params {
    double joint_normal_stiffness;        ///< k_n [Pa/m], >= 1e3
    double joint_shear_stiffness;         ///< k_s [Pa/m], >= 1e3
    double friction_angle;                ///< phi [rad], 0 <= phi < pi/2
    double cohesion = 0;                  ///< c [Pa], 0 or >= 100
    double tensile_strength = 0;          ///< sigma_t [Pa], 0 or >= 100, <= c / tan(phi)
    double dilation_angle = 0;            ///< psi [rad], 0 <= psi <= phi, and <= the residual phi
    double dilation_limit = 0;            ///< Q_max, slip after which it ends [m]; 0: no dilation
    double residual_friction_angle = -1;  ///< after failure [rad], 0 to phi; -1: phi
    double residual_cohesion = 0;         ///< after failure [Pa], 0 to c
  };

  template <int Dim>
  struct State : ShearSpring<Dim> {
    double path = 0;      ///< Q [m]
    double dilation = 0;  ///< d [m]
    double bond = 1;      ///< what is left of it, over the whole joint [-]
    BondFront<Dim> front;
    bool failed = false;
  };

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit MohrCoulombJoint(const Params& params) : MohrCoulombJoint(params, any_units) {
    require_plausible(p_.joint_normal_stiffness, "joint_normal_stiffness", "Pa/m", 1e3, "GPa/m",
                      1e9);
    require_plausible(p_.joint_shear_stiffness, "joint_shear_stiffness", "Pa/m", 1e3, "GPa/m", 1e9);
    if (p_.cohesion > 0) require_plausible(p_.cohesion, "cohesion", "Pa", 100, "MPa", 1e6);
    if (p_.tensile_strength > 0)
      require_plausible(p_.tensile_strength, "tensile_strength", "Pa", 100, "MPa", 1e6);
  }
  /// The same for values that are not in SI units: stiffnesses > 0, strengths >= 0.
  MohrCoulombJoint(const Params& params, AnyUnits) : p_(params) {
    if (p_.residual_friction_angle == -1) p_.residual_friction_angle = p_.friction_angle;
    constexpr double right = 0.5 * std::numbers::pi;
    require(p_.joint_normal_stiffness > 0 && std::isfinite(p_.joint_normal_stiffness),
            "joint_normal_stiffness", p_.joint_normal_stiffness, "> 0 Pa/m");
    require(p_.joint_shear_stiffness > 0 && std::isfinite(p_.joint_shear_stiffness),
            "joint_shear_stiffness", p_.joint_shear_stiffness, "> 0 Pa/m");
    require_angle(p_.friction_angle >= 0 && p_.friction_angle < right, "friction_angle",
                  p_.friction_angle, ">= 0 and < pi/2 rad");
    require(p_.cohesion >= 0 && std::isfinite(p_.cohesion), "cohesion", p_.cohesion, ">= 0 Pa");
    require(
        p_.tensile_strength >= 0 && p_.tensile_strength * elementary::tangent(p_.friction_angle) <=
                                        p_.cohesion * (1 + 1e-12),
        "tensile_strength", p_.tensile_strength, ">= 0 Pa and <= cohesion / tan(phi)");
    require_angle(p_.dilation_angle >= 0 && p_.dilation_angle <= p_.friction_angle,
                  "dilation_angle", p_.dilation_angle, ">= 0 and <= friction_angle");
    if (p_.dilation_angle > 0)
      require(
          p_.dilation_limit > 0 && p_.dilation_limit <= 1, "dilation_limit", p_.dilation_limit,
          "> 0 and <= 1 m where there is a dilation_angle: the teeth of a joint are sheared off "
          "after millimetres to centimetres, and one that lifts without end carries any load");
    require(p_.dilation_limit >= 0 && std::isfinite(p_.dilation_limit), "dilation_limit",
            p_.dilation_limit, ">= 0 m");
    require_angle(
        p_.residual_friction_angle >= 0 && p_.residual_friction_angle <= p_.friction_angle,
        "residual_friction_angle", p_.residual_friction_angle, ">= 0 and <= friction_angle");
    require_angle(p_.dilation_angle <= p_.residual_friction_angle, "dilation_angle",
                  p_.dilation_angle,
                  "<= residual_friction_angle: a joint that lifts more steeply than it rubs makes "
                  "energy as it slips");
    require(p_.residual_cohesion >= 0 && p_.residual_cohesion <= p_.cohesion, "residual_cohesion",
            p_.residual_cohesion, ">= 0 and <= cohesion");
    friction_coefficient_ = elementary::tangent(p_.friction_angle);
    residual_friction_coefficient_ = elementary::tangent(p_.residual_friction_angle);
    tan_dilation_ = p_.dilation_limit > 0 ? elementary::tangent(p_.dilation_angle) : 0;
  }

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> trial = elastic_force(load, state);
    return holds(trial, load, state) ? trial : respond(load, state).force;
  }

  /// @return  work of slip less what dilation stores, and what breaking in tension or in shear sets
  ///          free [J]
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    const Response<Dim> now = respond(load, state);
    double lost =
        state.commit(load, load.initial.tangential, p_.joint_shear_stiffness, now.force.tangential);
    lost -= now.force.normal * now.lift;
    state.path += now.slip;  // what an open joint slips wears no teeth
    state.dilation += now.lift;
    if (std::isfinite(load.bond.stretch)) {
      const double torn =
          load.weight * load.whole_over_part * std::max(0.0, state.bond - load.bond.area);
      lost += 0.5 * p_.joint_normal_stiffness * load.bond.stretch * load.bond.stretch * torn;
      state.bond = std::min(state.bond, load.bond.area);
      state.front = load.bond.front;
    } else if (now.opens && !state.failed) {
      lost +=
          0.5 * load.weight * p_.tensile_strength * p_.tensile_strength / p_.joint_normal_stiffness;
    }
    if (state.failed || !(now.opens || now.slip > 0)) return lost;
    // It slips on at once to what it still carries: a spring left at the peak would come back to it
    // as soon as the joint is pressed, with energy from nowhere. What it held in shear and in
    // tension beyond that is lost: nothing moves meanwhile.
    const PointLoad<Dim> there = load.committed();
    const double held = stored_energy(there, state);
    state.failed = true;
    (void)commit(there, state);
    return lost + held - stored_energy(there, state);
  }

  /// Where the normal spring, lifted by the dilation so far, carries nothing, and how far its bond
  /// stretches beyond that.
  template <int Dim>
  [[nodiscard]] BondRelease<Dim> release_opening(const PointLoad<Dim>& load,
                                                 const State<Dim>& state) const {
    const double opening =
        load.initial.normal / (p_.joint_normal_stiffness * load.weight) + state.dilation;
    if (state.failed) return {opening, 0, state.bond, state.front};
    return {opening, p_.tensile_strength / p_.joint_normal_stiffness, state.bond, state.front};
  }

  [[nodiscard]] bool dilates() const { return tan_dilation_ > 0; }
  /// In the mean over a joint each point has the weight of its strength: the work of friction,
  /// which is no less than that times the slip, pays for the lift of all, tan(psi) being no more
  /// than tan(phi).
  template <int Dim>
  [[nodiscard]] PointLift lift(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> trial = elastic_force(load, state);
    const double strength =
        std::max(0.0, cohesion(load, state) + friction_coefficient(state.failed) * trial.normal);
    const double shear = trial.tangential.norm();
    const bool opens = trial.normal < -tensile_strength(load, state);
    if (!(shear > strength)) return {opens ? 0.0 : strength, 0};
    const double slip = (shear - strength) / (p_.joint_shear_stiffness * load.weight);
    return {opens ? 0.0 : strength, dilation(state.path + slip) - dilation(state.path)};
  }

  /// N^2 / (2 k_n w) + T^2 / (2 k_s w)
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    return 0.5 / load.weight *
           (now.normal * now.normal / p_.joint_normal_stiffness +
            now.tangential.squaredNorm() / p_.joint_shear_stiffness);
  }

  /// Damage: 1 once it has failed, if it had more than its residual strength; before, the part of
  /// its dilation that is used up.
  template <int Dim>
  [[nodiscard]] ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    ContactReport report = report_from_force(*this, load, state);
    if (tan_dilation_ > 0) report.damage = std::min(1.0, state.path / p_.dilation_limit);
    const bool weakens = p_.tensile_strength > 0 || p_.residual_cohesion < p_.cohesion ||
                         p_.residual_friction_angle < p_.friction_angle;
    if (weakens) report.damage = std::max(report.damage, state.failed ? 1.0 : 1 - state.bond);
    return report;
  }

  [[nodiscard]] double joint_normal_stiffness() const { return p_.joint_normal_stiffness; }
  [[nodiscard]] double joint_shear_stiffness() const { return p_.joint_shear_stiffness; }
  [[nodiscard]] const Params& params() const { return p_; }

 private:
  template <int Dim>
  struct Response {
    PointForce<Dim> force;
    double slip = 0;     ///< new plastic slip [m]
    double lift = 0;     ///< new dilation [m]
    bool opens = false;  ///< tensile strength reached, or open
  };

  /// Of a point that lifts by itself [m].
  [[nodiscard]] double dilation(double path) const {
    return tan_dilation_ * std::min(path, p_.dilation_limit);
  }

  /// Without new slip and opening.
  template <int Dim>
  [[nodiscard]] PointForce<Dim> elastic_force(const PointLoad<Dim>& load,
                                              const State<Dim>& state) const {
    const double w = load.weight;
    return {load.initial.normal -
                p_.joint_normal_stiffness * w * (load.motion.opening - state.dilation),
            state.force(load, load.initial.tangential, p_.joint_shear_stiffness)};
  }
  /// Part of what carries the point's load that is bonded, 0 to 1.
  template <int Dim>
  [[nodiscard]] static double bonded(const PointLoad<Dim>& load, const State<Dim>& state) {
    if (state.failed) return 0;
    return std::min(1.0, std::min(load.bond.area, state.bond) * load.whole_over_part);
  }
  /// Of a point [N].
  template <int Dim>
  [[nodiscard]] double tensile_strength(const PointLoad<Dim>& load, const State<Dim>& state) const {
    if (!(bonded(load, state) > 0)) return 0;
    return load.weight *
           std::min(p_.tensile_strength, p_.joint_normal_stiffness * load.bond.stretch);
  }
  [[nodiscard]] double friction_coefficient(bool failed) const {
    return failed ? residual_friction_coefficient_ : friction_coefficient_;
  }
  /// Of the bond, as far as it holds, and of what is left of it elsewhere [N].
  template <int Dim>
  [[nodiscard]] double cohesion(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double part = bonded(load, state);
    return load.weight * (part * p_.cohesion + (1 - part) * p_.residual_cohesion);
  }
  /// True where a force is within both strengths: nearly everywhere, and without a root.
  template <int Dim>
  [[nodiscard]] bool holds(const PointForce<Dim>& force, const PointLoad<Dim>& load,
                           const State<Dim>& state) const {
    const double strength =
        std::max(0.0, cohesion(load, state) + friction_coefficient(state.failed) * force.normal);
    return force.normal >= -tensile_strength(load, state) &&
           force.tangential.squaredNorm() <= strength * strength;
  }

  template <int Dim>
  [[nodiscard]] Response<Dim> respond(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double w = load.weight, kn = p_.joint_normal_stiffness * w,
                 ks = p_.joint_shear_stiffness * w, mu = friction_coefficient(state.failed),
                 cohesion = this->cohesion(load, state),
                 least_normal = -tensile_strength(load, state);
    Response<Dim> r;
    r.force = elastic_force(load, state);
    const double shear = r.force.tangential.norm();
    // |T| - k_s dq = c + mu (N + k_n tan(psi) dq), as long as there is dilation left; then without.
    // Below zero too: slip on the way to an opening may hold the joint shut.
    const double over = shear - (cohesion + mu * r.force.normal);
    if (over > 0) {
      const bool by_itself = tan_dilation_ > 0 && load.lift < 0;
      const double left = by_itself ? std::max(0.0, p_.dilation_limit - state.path) : 0.0;
      const double steep = by_itself ? tan_dilation_ : 0.0;
      r.slip = over / (ks + mu * kn * steep);
      if (r.slip > left) r.slip = (over - mu * kn * steep * left) / ks;
      r.lift = steep * std::min(r.slip, left);
      r.force.normal += kn * r.lift;
      r.force.tangential *= shear > 0 ? std::max(0.0, shear - ks * r.slip) / shear : 0.0;
    }
    if (r.force.normal < least_normal) {
      r = {};
      r.opens = true;
    }
    if (load.lift > 0) r.lift = load.lift;
    return r;
  }
  Params p_;
  double friction_coefficient_ = 0, residual_friction_coefficient_ = 0;
  double tan_dilation_ = 0;
};

static_assert(ContactLaw<MohrCoulombJoint, 2> && ContactLaw<MohrCoulombJoint, 3>);

}  // namespace voussoir
