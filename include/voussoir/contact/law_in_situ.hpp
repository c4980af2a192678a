// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>

/// What a joint does under a normal stress, of any law: for what is asked before anything moves.
namespace voussoir {

/// Normal stiffness: of the tangent to the closure curve [Pa/m].
/// @param stress  at which the joint is at rest [Pa], > 0
template <class Law>
[[nodiscard]] double normal_stiffness_at(const Law& law, double stress) {
  // A hundredth of what it closes by, no less than the digits of a stress bear.
  const double step = 0.01 * stress / law.joint_normal_stiffness();
  PointLoad<2> load{1, {stress, zeros<Vec<1>>()}, {-step, zeros<Vec<1>>()}};
  return (law.force(load, typename Law::template State<2>{}).normal - stress) / step;
}

/// The largest angle of friction, cohesion and roughness included, that a monotonic slip of up to
/// 0.1 m meets [rad].
/// @param stress  as above
/// @cost  7 000 evaluations of the law at most
template <class Law>
[[nodiscard]] double friction_angle_at(const Law& law, double stress) {
  double steepest = 0;
  for (double slip = 1e-6; slip < 0.1; slip *= 1.1) {
    // Free to lift: it opens until the stress is that asked for.
    double low = 0, high = 0.05, ratio = 0;
    for (int k = 0; k < 60; ++k) {
      const double opening = k == 0 ? 0.0 : 0.5 * (low + high);
      const PointLoad<2> load{1, {stress, zeros<Vec<1>>()}, {opening, Vec<1>(-slip)}};
      const PointForce<2> force = law.force(load, typename Law::template State<2>{});
      const bool is_pressed = force.normal > stress * (1 + 1e-9);
      if (is_pressed || k == 0) ratio = force.tangential[0] / force.normal;
      if (k == 0 && !is_pressed) break;
      (is_pressed ? low : high) = opening;
    }
    steepest = std::max(steepest, ratio);
  }
  return elementary::angle_of(steepest, 1.0);
}

}  // namespace voussoir
