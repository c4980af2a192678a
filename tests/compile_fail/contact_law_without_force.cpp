// expect: contact law: add `PointForce<Dim> force
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Law {
  using role = voussoir::roles::ContactLaw;
  static constexpr const char* name = "Law";
  template <int Dim>
  struct State {};
  template <int Dim>
  void commit(const voussoir::PointLoad<Dim>&, State<Dim>&) const;
  double joint_normal_stiffness() const;
  double joint_shear_stiffness() const;
};
}  // namespace

using Broken = voussoir::Composition<Law>;
static_assert(sizeof(Broken) > 0);
