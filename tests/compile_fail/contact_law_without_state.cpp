// expect: contact law: add `template <int Dim> struct State`
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Law {
  using role = voussoir::roles::ContactLaw;
  static constexpr const char* name = "Law";
  template <int Dim>
  voussoir::PointForce<Dim> force(const voussoir::PointLoad<Dim>&) const;
  double joint_normal_stiffness() const;
  double joint_shear_stiffness() const;
};
}  // namespace

using Broken = voussoir::Composition<Law>;
static_assert(sizeof(Broken) > 0);
