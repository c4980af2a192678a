// expect: lining: add `template <int Dof> static ElementMatrix<Dof> stiffness(const LiningSection&, double length)`
// SPDX-License-Identifier: MIT
// A lining whose elements have no stiffness matrix.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Beam {
  using role = roles::Lining;
  static constexpr const char* name = "Beam";
};

}  // namespace

template struct voussoir::Composition<Beam>;
