// expect: bolt law: `describe` must be `BoltReport describe(const BoltSpan<Dim>&, const State&) const`, or be left out
// SPDX-License-Identifier: MIT
// A law that describes itself in words of its own would be passed over by tables and pictures.
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
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const {
    return {Stress<Dim>::Identity()};
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State&) const {
    return 0.5 * span.motion.squaredNorm();
  }
  [[nodiscard]] bool describe(const State& state) const { return state.broken; }
};

}  // namespace

template struct voussoir::Composition<Bolt>;
