// expect: bolt law: add `BoltForce<Dim> force(const BoltSpan<Dim>&, const State&) const`
// SPDX-License-Identifier: MIT
// A bolt law that does not say what force an extension causes.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Bolt {
  using role = roles::BoltLaw;
  static constexpr const char* name = "Bolt";
  struct State {
    bool broken = false;
  };
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    state.broken = state.broken || span.motion.norm() > 1;
    return state.broken;
  }
  template <int Dim>
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const {
    return {Stress<Dim>::Identity()};
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State&) const {
    return 0.5 * span.motion.squaredNorm();
  }
};

}  // namespace

template struct voussoir::Composition<Bolt>;
