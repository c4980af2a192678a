// expect: lining: add `static constexpr const char* name` for the log
// SPDX-License-Identifier: MIT
// The solver prints what it is made of.
#include <voussoir/lining/lining_model.hpp>

namespace {

using namespace voussoir;

struct Beam {
  using role = roles::Lining;
  template <int Dof>
  static ElementMatrix<Dof> stiffness(const LiningSection& section, double length) {
    return section.axial_stiffness / length * ElementMatrix<Dof>::Identity();
  }
};

}  // namespace

static_assert(voussoir::explain_lining_model<Beam, 3>());
