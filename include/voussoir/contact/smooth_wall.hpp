// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// The fixed, frictionless edge of the domain: N = max(0, N0 - k_n w g), no shear.
///
/// Source: Boon, Houlsby & Utili (2015), section 2.1: side segments are fixed before excavation.
class SmoothWall {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "SmoothWall";
  template <int Dim>
  struct State {};

  /// @param joint_normal_stiffness  k_n [Pa/m], > 0
  /// @throws InvalidInput
  explicit SmoothWall(double joint_normal_stiffness) : stiffness_(joint_normal_stiffness) {
    require(stiffness_ > 0 && std::isfinite(stiffness_), "joint_normal_stiffness", stiffness_,
            "> 0 Pa/m");
  }

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>&) const {
    return {std::max(0.0, load.initial.normal - stiffness_ * load.weight * load.motion.opening),
            zeros<Vec<Dim - 1>>()};
  }
  template <int Dim>
  double commit(const PointLoad<Dim>&, State<Dim>&) const {
    return 0;
  }
  /// N^2 / (2 k_n w)
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double normal = force(load, state).normal;
    return 0.5 * normal * normal / (stiffness_ * load.weight);
  }

  [[nodiscard]] double joint_normal_stiffness() const { return stiffness_; }
  [[nodiscard]] double joint_shear_stiffness() const { return 0.0; }

 private:
  double stiffness_;
};

static_assert(ContactLaw<SmoothWall, 2> && ContactLaw<SmoothWall, 3>);

}  // namespace voussoir
