// expect: contact law: add `double stored_energy(const PointLoad<Dim>&, const State<Dim>&) const` [J]
// SPDX-License-Identifier: MIT
// A contact law that does not say what energy it holds.
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
  [[nodiscard]] double joint_normal_stiffness() const { return 1; }
  [[nodiscard]] double joint_shear_stiffness() const { return 1; }
};

}  // namespace

template struct voussoir::Composition<Law>;
