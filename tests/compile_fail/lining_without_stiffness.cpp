// expect: lining: add `template <int Dof> static ElementMatrix<Dof> stiffness
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Lining {
  using role = voussoir::roles::Lining;
  static constexpr const char* name = "Lining";
};
}  // namespace

using Broken = voussoir::Composition<Lining>;
static_assert(sizeof(Broken) > 0);
