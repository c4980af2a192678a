// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/elementary.hpp>

namespace voussoir {

/// A Coulomb joint that creeps in shear: weathered or clay-coated joints under long loads.
///
///   T = T0 - k_s w (s - q - v),  shortened to |T| <= N tan(phi)
///   dq/dt = -T / (eta_M w)                  Maxwell: goes on as long as there is shear
///   dv/dt = -(T/w + k_K v) / eta_K          Kelvin: comes to rest at v = -T / (k_K w)
///
/// q plastic and viscous slip, v delayed elastic slip. Under a constant shear -T = tau w it moves
/// by tau (1/k_s + t/eta_M + (1 - exp(-t k_K/eta_K)) / k_K): Burgers' body. With kelvin_stiffness =
/// infinity it is Maxwell's. Nothing creeps in a dynamic run, whose time is seconds:
/// `Solver::creep` goes through the time of a tunnel's life.
///
/// Source: Burgers (1935); for joints e.g. Malan, Drescher & Vogler (1998), Int. J. Rock Mech. Min.
/// Sci. 35.
class BurgersJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "BurgersJoint";

  struct Params {
    double joint_normal_stiffness;  ///< k_n [Pa/m], >= 1e3
    double joint_shear_stiffness;   ///< k_s [Pa/m], >= 1e3
    double friction_angle;          ///< phi [rad], 0 <= phi < pi/2
    double maxwell_viscosity;       ///< eta_M [Pa s/m], > 0; infinity: no steady creep
    double kelvin_stiffness = std::numeric_limits<double>::infinity();  ///< k_K [Pa/m], >= 1e3
    double kelvin_viscosity = std::numeric_limits<double>::infinity();  ///< eta_K [Pa s/m], > 0
  };

  template <int Dim>
  struct State {
    CoulombJoint::State<Dim> joint;                     ///< its plastic slip is q + v
    Vec<Dim - 1> delayed_slip = zeros<Vec<Dim - 1>>();  ///< v [m]
  };

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit BurgersJoint(const Params& params)
      : BurgersJoint(params, CoulombJoint({params.joint_normal_stiffness,
                                           params.joint_shear_stiffness, params.friction_angle})) {
    require_plausible(p_.kelvin_stiffness, "kelvin_stiffness", "Pa/m", 1e3, "GPa/m", 1e9);
  }
  /// The same for values that are not in SI units: stiffnesses > 0.
  BurgersJoint(const Params& params, AnyUnits)
      : BurgersJoint(params, CoulombJoint({params.joint_normal_stiffness,
                                           params.joint_shear_stiffness, params.friction_angle},
                                          any_units)) {}

  [[nodiscard]] const Params& params() const { return p_; }

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return joint_.force(load, state.joint);
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    return joint_.commit(load, state.joint);
  }
  /// That of the joint, and of Kelvin's spring: delayed slip comes back, and works as it does.
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double delayed =
        std::isfinite(p_.kelvin_stiffness)
            ? 0.5 * load.weight * p_.kelvin_stiffness * state.delayed_slip.squaredNorm()
            : 0.0;
    return joint_.stored_energy(load, state.joint) + delayed;
  }

  /// Lets the point creep for a time under its present force, which stays as it is meanwhile.
  /// @param time  [s]; well below `creep_time`, or it overshoots where the blocks do not follow
  template <int Dim>
  void creep(const PointLoad<Dim>& load, State<Dim>& state, double time) const {
    const Vec<Dim - 1> stress = joint_.force(load, state.joint).tangential / load.weight;
    Vec<Dim - 1> slip = -time / p_.maxwell_viscosity * stress;
    if (std::isfinite(p_.kelvin_stiffness)) {
      const double fades =
          elementary::exponential(-time * p_.kelvin_stiffness / p_.kelvin_viscosity);
      const Vec<Dim - 1> at_rest = -stress / p_.kelvin_stiffness;
      const Vec<Dim - 1> delayed = at_rest + fades * (state.delayed_slip - at_rest);
      slip += delayed - state.delayed_slip;
      state.delayed_slip = delayed;
    }
    state.joint.plastic_slip += slip;
    // Where it is open, or delayed slip comes back against friction, the spring is not left wound.
    (void)joint_.commit(load, state.joint);
  }
  /// The time in which shear would relax if the blocks did not move [s].
  [[nodiscard]] double creep_time() const {
    double rate = p_.joint_shear_stiffness / p_.maxwell_viscosity;
    if (std::isfinite(p_.kelvin_stiffness)) rate += p_.joint_shear_stiffness / p_.kelvin_viscosity;
    return 1 / rate;
  }

  /// What is delayed comes back: it is no plastic slip.
  template <int Dim>
  [[nodiscard]] ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    PointLoad<Dim> without = load;
    without.motion.slip -= state.delayed_slip;
    State<Dim> joint = state;
    joint.joint.plastic_slip -= state.delayed_slip;
    return report_from_force(joint_, without, joint.joint);
  }

  [[nodiscard]] double joint_normal_stiffness() const { return p_.joint_normal_stiffness; }
  [[nodiscard]] double joint_shear_stiffness() const { return p_.joint_shear_stiffness; }

 private:
  BurgersJoint(const Params& params, const CoulombJoint& joint) : p_(params), joint_(joint) {
    require(p_.maxwell_viscosity > 0, "maxwell_viscosity", p_.maxwell_viscosity, "> 0 Pa s/m");
    require(p_.kelvin_stiffness > 0, "kelvin_stiffness", p_.kelvin_stiffness, "> 0 Pa/m");
    require(p_.kelvin_viscosity > 0, "kelvin_viscosity", p_.kelvin_viscosity, "> 0 Pa s/m");
  }

  Params p_;
  CoulombJoint joint_;
};

static_assert(ContactLaw<BurgersJoint, 2> && ContactLaw<BurgersJoint, 3>);
static_assert(CreepingLaw<BurgersJoint, 2> && CreepingLaw<BurgersJoint, 3>);

}  // namespace voussoir
