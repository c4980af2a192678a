// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>

/// Joints and supports whose strength is divided by a factor; their stiffness stays.
namespace voussoir::design {

/// tan(phi), c and sigma_t over the factor, at the peak and what is left of them, of Barton and
/// Bandis' joints the strength at every stress; dilation stays where it is not more than the
/// friction that is left.
/// @param factor  > 0
[[nodiscard]] VOUSSOIR_DESIGN_INLINE AnyJoint weakened(const AnyJoint& joint, double factor);

/// All joints of an input so.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE AnalysisInput with_weaker_joints(AnalysisInput input,
                                                                      double factor);
/// Forces at which bolts yield and rupture, what their bond, plate and anchor hold, what feet bear
/// and what bonds a lining to the rock over the factor, wherever they are given. What is found of
/// utilisations then is of no use.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE AnalysisInput with_weaker_supports(AnalysisInput input,
                                                                        double factor);

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

[[nodiscard]] inline double weaker_angle(double angle, double factor) {
  return elementary::angle_of(elementary::tangent(angle), factor);
}

inline void require_factor(double factor) {
  require(factor > 0 && std::isfinite(factor), "factor of strength", factor, "> 0");
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE AnyJoint weakened(const AnyJoint& joint, double factor) {
  detail::require_factor(factor);
  return joint.visit([&](const auto& law) -> AnyJoint {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (std::is_same_v<Law, CoulombJoint>) {
      return CoulombJoint({law.joint_normal_stiffness(), law.joint_shear_stiffness(),
                           elementary::angle_of(law.friction_coefficient(), factor)},
                          any_units);
    } else if constexpr (std::is_same_v<Law, MohrCoulombJoint>) {
      MohrCoulombJoint::Params weaker = law.params();
      weaker.friction_angle = detail::weaker_angle(weaker.friction_angle, factor);
      weaker.residual_friction_angle = std::min(
          detail::weaker_angle(weaker.residual_friction_angle, factor), weaker.friction_angle);
      weaker.cohesion /= factor;
      weaker.residual_cohesion = std::min(weaker.residual_cohesion / factor, weaker.cohesion);
      weaker.tensile_strength /= factor;
      if (weaker.friction_angle > 0)  // c / tan(phi) is what it was, but for a rounding
        weaker.tensile_strength = std::min(
            weaker.tensile_strength, weaker.cohesion / elementary::tangent(weaker.friction_angle));
      weaker.dilation_angle = std::min(weaker.dilation_angle, weaker.residual_friction_angle);
      return MohrCoulombJoint(weaker, any_units);
    } else if constexpr (std::is_same_v<Law, BurgersJoint>) {
      BurgersJoint::Params weaker = law.params();
      weaker.friction_angle = detail::weaker_angle(weaker.friction_angle, factor);
      return BurgersJoint(weaker, any_units);
    } else {
      static_assert(std::is_same_v<Law, BartonBandisJoint>, "one law of AnyJoint has no branch");
      BartonBandisJoint::Params weaker = law.params();
      weaker.strength_divisor *= factor;
      return BartonBandisJoint(weaker, any_units);
    }
  });
}

VOUSSOIR_DESIGN_INLINE AnalysisInput with_weaker_joints(AnalysisInput input, double factor) {
  input.joint = weakened(*input.joint, factor);
  for (JointSetInput& set : input.joint_sets)
    if (set.law) set.law = weakened(*set.law, factor);
  return input;
}

VOUSSOIR_DESIGN_INLINE AnalysisInput with_weaker_supports(AnalysisInput input, double factor) {
  detail::require_factor(factor);
  const auto divide = [&](std::optional<double>& strength) {
    if (strength) *strength /= factor;
  };
  for (BoltsInput& bolts : input.bolts) {
    divide(bolts.yield_force);
    divide(bolts.rupture_force);
    divide(bolts.bond_strength);
    divide(bolts.plate_strength);
    divide(bolts.anchor_strength);
  }
  for (LiningInput& lining : input.linings) {
    lining.shear_bond /= factor;
    lining.tensile_bond /= factor;
    if (lining.feet) divide(lining.feet->strength);
  }
  return input;
}

#endif

}  // namespace voussoir::design
