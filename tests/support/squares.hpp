// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/rockmass/slicing.hpp>

#include "support/degree.hpp"

/// Rock of squares that do not slip: with k_n = k_s = E / s elastic and isotropic, G = E / 2, nu =
/// 0, but for the size of its blocks.
namespace voussoir_test {

[[nodiscard]] inline voussoir::RockMass<voussoir::Planar> squares(const voussoir::Domain<2>& domain,
                                                                  double side, double turn) {
  using voussoir::Vec2;
  std::vector<voussoir::Joint> joints;
  for (int set = 0; set < 2; ++set) {
    const double angle = turn + set * 90 * degree;
    const Vec2 normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
    const double far = domain.diameter();
    const int count = static_cast<int>(far / side) + 1;
    for (int k = -count; k <= count; ++k) {
      const Vec2 middle = (k + 0.5) * side * normal;
      joints.push_back({voussoir::Segment{middle - far * along, middle + far * along}, set});
    }
  }
  return voussoir::slice(domain, joints, {.min_inscribed_radius = 1e-3});
}

[[nodiscard]] inline voussoir::MohrCoulombJoint glued(double k_n, double k_s) {
  return voussoir::MohrCoulombJoint({.joint_normal_stiffness = k_n,
                                     .joint_shear_stiffness = k_s,
                                     .friction_angle = 60 * degree,
                                     .cohesion = 2e9,
                                     .tensile_strength = 1e9},
                                    voussoir::any_units);
}

/// Their ground on all sides, no surface near.
[[nodiscard]] inline voussoir::FarField<2> ground_of_squares(double young) {
  using namespace voussoir;
  return FarField<2>::elastic(elastic_matrix<2>({0.5 * young, 0}))
      .with(Side::top, Boundary::elastic);
}

}  // namespace voussoir_test
