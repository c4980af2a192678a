// expect: bolt law: add `struct State` for what a bolt remembers at a joint
// SPDX-License-Identifier: MIT
// What a bolt remembers at a joint must have a type.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Bolt {
  using role = roles::BoltLaw;
  static constexpr const char* name = "Bolt";
  template <int Dim>
  BoltForce<Dim> force(const BoltSpan<Dim>& span, const double& state) const {
    if (state > 1) return {};
    return {span.motion, span.motion.norm()};
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, double& state) const {
    state = span.motion.norm();
    return state > 1;
  }
  template <int Dim>
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>&) const {
    return {Stress<Dim>::Identity()};
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const double&) const {
    return 0.5 * span.motion.squaredNorm();
  }
};

}  // namespace

template struct voussoir::Composition<Bolt>;
