// expect: contact law: add `template <int Dim> struct State` for what a point remembers
// SPDX-License-Identifier: MIT
// What a point remembers between two states must have a type.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Law {
  using role = roles::ContactLaw;
  static constexpr const char* name = "Law";
  template <int Dim>
  PointForce<Dim> force(const PointLoad<Dim>& load, const double& state) const {
    PointForce<Dim> result = load.initial;
    result.normal -= load.weight * (load.motion.opening + state);
    return result;
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, double& state) const {
    state = load.motion.slip[0];
    return 0;
  }
  template <int Dim>
  double stored_energy(const PointLoad<Dim>&, double) const {
    return 0;
  }
  [[nodiscard]] double joint_normal_stiffness() const { return 1; }
  [[nodiscard]] double joint_shear_stiffness() const { return 1; }
};

}  // namespace

template struct voussoir::Composition<Law>;
