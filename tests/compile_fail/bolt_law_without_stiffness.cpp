// expect: bolt law: add `BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const` [N/m], of the pull and of the dowel
// SPDX-License-Identifier: MIT
// Time steps and the elastic matrix need the stiffness of the bolt, its dowel included.
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
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    state.broken = state.broken || span.motion.norm() > 1;
    return state.broken;
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State&) const {
    return 0.5 * span.motion.squaredNorm();
  }
};

}  // namespace

template struct voussoir::Composition<Bolt>;
