// expect: bolt law: `State` must be no template: `struct State`
// SPDX-License-Identifier: MIT
// The state of a contact law, on a bolt law.
#include <voussoir/bolt/bolt_law.hpp>

namespace {

using namespace voussoir;

struct Bolt {
  using role = roles::BoltLaw;
  static constexpr const char* name = "Bolt";
  template <int Dim>
  struct State {
    bool broken = false;
  };
  template <int Dim>
  BoltForce<Dim> force(const BoltSpan<Dim>& span, const State<Dim>& state) const {
    if (state.broken) return {};
    return {span.motion, span.motion.norm()};
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State<Dim>& state) const {
    state.broken = state.broken || span.motion.norm() > 1;
    return state.broken;
  }
  template <int Dim>
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const {
    return {Stress<Dim>::Identity()};
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State<Dim>&) const {
    return 0.5 * span.motion.squaredNorm();
  }
};

}  // namespace

static_assert(voussoir::explain_bolt_law<Bolt, 2>());
