// expect: bolt law: add `bool commit(const BoltSpan<Dim>&, State&) const` (true: it broke)
// SPDX-License-Identifier: MIT
// A bolt law that cannot yield or break.
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
  BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    if (state.broken) return {};
    return {span.motion, span.motion.norm()};
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
