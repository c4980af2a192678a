// expect: bolt law: add `static constexpr const char* name` for the log
// SPDX-License-Identifier: MIT
// The solver prints what it is made of.
#include <voussoir/bolt/bolt_law.hpp>

namespace {

using namespace voussoir;

struct Bolt {
  using role = roles::BoltLaw;
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
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const {
    return {Stress<Dim>::Identity()};
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State&) const {
    return 0.5 * span.motion.squaredNorm();
  }
};

}  // namespace

static_assert(voussoir::explain_bolt_law<Bolt, 2>());
