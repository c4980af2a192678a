// expect: contact law: add `using role = voussoir::roles::ContactLaw`
// SPDX-License-Identifier: MIT
// A law for moving blocks alone says what it is for, too.
#include <voussoir/contact/contact_law.hpp>

namespace {

using namespace voussoir;

struct Law {
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
};

}  // namespace

static_assert(voussoir::explain_contact_law<Law, 2>());
