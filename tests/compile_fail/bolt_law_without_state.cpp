// expect: bolt law: add `struct State`
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Bolt {
  using role = voussoir::roles::BoltLaw;
  static constexpr const char* name = "Bolt";
  template <int Dim>
  voussoir::Stress<Dim> stiffness(const voussoir::BoltSpan<Dim>&) const;
};
}  // namespace

using Broken = voussoir::Composition<Bolt>;
static_assert(sizeof(Broken) > 0);
