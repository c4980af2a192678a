// expect: contact law: add `double joint_normal_stiffness() const`
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Law {
  using role = voussoir::roles::ContactLaw;
  static constexpr const char* name = "Law";
  template <int Dim>
  struct State {};
  template <int Dim>
  voussoir::PointForce<Dim> force(const voussoir::PointLoad<Dim>&, const State<Dim>&) const;
  template <int Dim>
  void commit(const voussoir::PointLoad<Dim>&, State<Dim>&) const;
};
}  // namespace

using Broken = voussoir::Composition<Law>;
static_assert(sizeof(Broken) > 0);
