// expect: contact law: `describe` must be `ContactReport describe(const PointLoad<Dim>&, const State<Dim>&) const`, or be left out
// SPDX-License-Identifier: MIT
// A law that describes itself in words of its own would be passed over by tables and pictures.
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
  [[nodiscard]] double joint_normal_stiffness() const { return 1; }
  [[nodiscard]] double joint_shear_stiffness() const { return 1; }
  template <int Dim>
  double describe(const State<Dim>& state) const {
    return state.slip;
  }
};

}  // namespace

template struct voussoir::Composition<Law>;
