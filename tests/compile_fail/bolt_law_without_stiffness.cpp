// expect: bolt law: add `Stress<Dim> stiffness
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Bolt {
  using role = voussoir::roles::BoltLaw;
  static constexpr const char* name = "Bolt";
  struct State {};
  template <int Dim>
  voussoir::BoltForce<Dim> force(const voussoir::BoltSpan<Dim>&, const State&) const;
  template <int Dim>
  bool commit(const voussoir::BoltSpan<Dim>&, State&) const;
};
}  // namespace

using Broken = voussoir::Composition<Bolt>;
static_assert(sizeof(Broken) > 0);
