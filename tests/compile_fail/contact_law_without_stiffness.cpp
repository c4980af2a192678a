// expect: contact law: add `double joint_normal_stiffness() const` and `double joint_shear_stiffness() const` [Pa/m]
// SPDX-License-Identifier: MIT
// Time steps and the elastic matrix need the stiffness of the joint.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Law {
  using role = roles::ContactLaw;
  static constexpr const char* name = "Law";
  template <int Dim>
  struct State {
    double slip = 0;
  };
  template <int Dim>
  PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    PointForce<Dim> result = load.initial;
    result.normal -= load.weight * (load.motion.opening + state.slip);
    return result;
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    state.slip = load.motion.slip[0];
    return 0;
  }
  template <int Dim>
  double stored_energy(const PointLoad<Dim>&, const State<Dim>&) const {
    return 0;
  }
};

}  // namespace

template struct voussoir::Composition<Law>;
