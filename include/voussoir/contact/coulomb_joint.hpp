// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/shear_spring.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/lane_pair.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Linear elastic joint that carries no tension and slides at the Coulomb limit.
///
///   N = max(0, N0 - k_n w g)
///   T = T0 - k_s w (s - q), shortened to |T| <= N tan(phi)
///
/// w weight of the point, g opening, s slip, q plastic slip (the only thing of the past that forces
/// depend on, unless the joint is open from an edge on: see `ShearSpring`).
/// The normal force is in total form, so an opened joint closes again where it opened; the shear
/// spring needs no turning along at the small rotations for which the contact topology is frozen.
///
/// Source: Boon, Houlsby & Utili (2015), section 2.1; k_n, k_s as of Goodman, Taylor & Brekke
/// (1968).
class CoulombJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "CoulombJoint";

  struct Params {
    double joint_normal_stiffness;  ///< k_n [Pa/m], >= 1e3
    double joint_shear_stiffness;   ///< k_s [Pa/m], >= 1e3
    double friction_angle;          ///< phi [rad], 0 <= phi < pi/2
  };

  template <int Dim>
  using State = ShearSpring<Dim>;

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit CoulombJoint(const Params& params) : CoulombJoint(params, any_units) {
    require_plausible(params.joint_normal_stiffness, "joint_normal_stiffness", "Pa/m", 1e3, "GPa/m",
                      1e9);
    require_plausible(params.joint_shear_stiffness, "joint_shear_stiffness", "Pa/m", 1e3, "GPa/m",
                      1e9);
  }
  /// The same for values that are not in SI units: stiffnesses > 0.
  CoulombJoint(const Params& params, AnyUnits)
      : params_(params), friction_coefficient_(elementary::tangent(params.friction_angle)) {
    require(params.joint_normal_stiffness > 0 && std::isfinite(params.joint_normal_stiffness),
            "joint_normal_stiffness", params.joint_normal_stiffness, "> 0 Pa/m");
    require(params.joint_shear_stiffness > 0 && std::isfinite(params.joint_shear_stiffness),
            "joint_shear_stiffness", params.joint_shear_stiffness, "> 0 Pa/m");
    require_angle(params.friction_angle >= 0 && params.friction_angle < 0.5 * std::numbers::pi,
                  "friction_angle", params.friction_angle, ">= 0 and < pi/2 rad");
  }

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double normal =
        std::max(0.0, load.initial.normal -
                          params_.joint_normal_stiffness * load.weight * load.motion.opening);
    return {normal,
            shortened(state.force(load, load.initial.tangential, params_.joint_shear_stiffness),
                      friction_coefficient_ * normal)};
  }

  /// The same of two points, in lanes.
  [[nodiscard]] PairForce pair_force(const PairLoad& load, const State<2>* two) const {
    const LanePair normal =
        larger(LanePair(0.0),
               load.initial_normal - params_.joint_normal_stiffness * load.weight * load.opening);
    const LanePair plastic_slip(two[0].plastic_slip.data()[0], two[1].plastic_slip.data()[0]);
    LanePair elastic = load.initial_shear -
                       params_.joint_shear_stiffness * load.weight * (load.slip - plastic_slip);
    if (two[0].pressed < load.weight[0] || two[1].pressed < load.weight[1])
      elastic = LanePair(elastic_in_lane(load, two, 0), elastic_in_lane(load, two, 1));
    const LanePair limit = friction_coefficient_ * normal;
    return {normal, smaller(larger(elastic, -limit), limit)};
  }

  /// @return  the friction work T . dq, T the mean of now and the last commit, and what shear loses
  ///          where the joint has opened or closed [J]
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    return state.commit(load, load.initial.tangential, params_.joint_shear_stiffness,
                        force(load, state).tangential);
  }

  /// N^2 / (2 k_n w) + T^2 / (2 k_s w)
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    return 0.5 / load.weight *
           (now.normal * now.normal / params_.joint_normal_stiffness +
            now.tangential.squaredNorm() / params_.joint_shear_stiffness);
  }

  [[nodiscard]] double joint_normal_stiffness() const { return params_.joint_normal_stiffness; }
  [[nodiscard]] double joint_shear_stiffness() const { return params_.joint_shear_stiffness; }
  [[nodiscard]] double friction_coefficient() const { return friction_coefficient_; }

 private:
  /// Shear of one of two points before it is shortened, where part of the joint has closed.
  [[nodiscard]] double elastic_in_lane(const PairLoad& load, const State<2>* two, int k) const {
    PointLoad<2> one;
    one.weight = load.weight[k];
    one.initial.tangential.data()[0] = load.initial_shear[k];
    one.motion.slip.data()[0] = load.slip[k];
    return two[k].force(one, one.initial.tangential, params_.joint_shear_stiffness)[0];
  }
  [[nodiscard]] static Vec<1> shortened(const Vec<1>& shear, double limit) {
    return Vec<1>(std::clamp(shear[0], -limit, limit));
  }
  [[nodiscard]] static Vec<2> shortened(const Vec<2>& shear, double limit) {
    const double s = shear.data()[0], t = shear.data()[1], squared = s * s + t * t;
    if (!(squared > limit * limit)) return shear;
    const double part = limit / std::sqrt(squared);
    return Vec<2>(part * s, part * t);
  }

  Params params_;
  double friction_coefficient_;
};

static_assert(ContactLaw<CoulombJoint, 2> && ContactLaw<CoulombJoint, 3> &&
              HasPairForce<CoulombJoint>);

}  // namespace voussoir
