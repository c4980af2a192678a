// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// The bearing of a foot of a lining on rock: elastic up to the bearing strength, then it settles
/// without more; no tension; friction along its base, an elastic shear spring up to it.
///
/// Per area of the foot, as a contact law is, though no policy to compose with: a width times a
/// metre of tunnel (2-D), or times the stretch of the tunnel that a rib stands for.
class FootBearing {
 public:
  struct Params {
    double width;      ///< of the foot, across the lining [m], > 0
    double stiffness;  ///< pressure over settlement [Pa/m], > 0
    double strength = std::numeric_limits<double>::infinity();  ///< bearing [Pa], > 0
    double friction_angle;                                      ///< [rad], >= 0 and < pi/2
  };
  template <int Dim>
  struct State {
    double settlement = 0;                              ///< that stays [m]
    Vec<Dim - 1> plastic_slip = zeros<Vec<Dim - 1>>();  ///< [m]
    PointForce<Dim> last;                               ///< then, for the work alone [N]
  };

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit FootBearing(const Params& params)
      : params_(params), friction_coefficient_(elementary::tangent(params.friction_angle)) {
    require(params.width > 0 && std::isfinite(params.width), "width of a foot", params.width,
            "> 0 m");
    require(params.stiffness > 0 && std::isfinite(params.stiffness), "bearing stiffness of a foot",
            params.stiffness, "> 0 Pa/m");
    require(params.strength > 0, "bearing strength of a foot", params.strength, "> 0 Pa");
    require_angle(params.friction_angle >= 0 && params.friction_angle < 0.5 * std::numbers::pi,
                  "friction angle of a foot", params.friction_angle, ">= 0 and < pi/2 rad");
  }

  [[nodiscard]] const Params& params() const { return params_; }

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double area = load.weight;
    const double normal = std::clamp(
        load.initial.normal - params_.stiffness * area * (load.motion.opening + state.settlement),
        0.0, params_.strength * area);
    Vec<Dim - 1> shear = load.initial.tangential -
                         params_.stiffness * area * (load.motion.slip - state.plastic_slip);
    const double size = shear.norm(), limit = friction_coefficient_ * normal;
    if (size > limit) shear *= limit / size;
    return {normal, shear};
  }

  /// @return  lost to settling and slip [J], with the mean of the force now and at the last commit
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    const PointForce<Dim> before = std::exchange(state.last, now);
    const double spring = params_.stiffness * load.weight;
    double lost = 0;
    if (now.normal >= params_.strength * load.weight) {
      const double settlement = (load.initial.normal - now.normal) / spring - load.motion.opening;
      lost += 0.5 * (before.normal + now.normal) *
              (settlement - std::exchange(state.settlement, settlement));
    }
    const Vec<Dim - 1> slip =
        load.motion.slip + (now.tangential - load.initial.tangential) / spring;
    if ((slip - state.plastic_slip).norm() > 1e-15) {
      lost -= 0.5 * (before.tangential + now.tangential).dot(slip - state.plastic_slip);
      state.plastic_slip = slip;
    }
    return lost;
  }

  /// N^2 / (2 k w) + T^2 / (2 k w)
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    return 0.5 * (now.normal * now.normal + now.tangential.squaredNorm()) /
           (params_.stiffness * load.weight);
  }

 private:
  Params params_;
  double friction_coefficient_;
};

}  // namespace voussoir
