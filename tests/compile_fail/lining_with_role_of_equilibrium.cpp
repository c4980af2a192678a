// expect: Solver: a policy has the parts of a lining and declares another role
// SPDX-License-Identifier: MIT
// The role copied from another type.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Beam {
  using role = roles::Equilibrium;
  static constexpr const char* name = "Beam";
  template <int Dof>
  static ElementMatrix<Dof> stiffness(const LiningSection& section, double length) {
    return section.axial_stiffness / length * ElementMatrix<Dof>::Identity();
  }
};

}  // namespace

template struct voussoir::Composition<Beam>;
