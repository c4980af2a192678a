// expect: lining: `is_pinned` must be `static constexpr bool is_pinned`, or be left out
// SPDX-License-Identifier: MIT
// Pins that are asked for at run time: the shape of the contacts is chosen at compile time.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Beam {
  using role = roles::Lining;
  static constexpr const char* name = "Beam";
  bool is_pinned = true;
  template <int Dof>
  static ElementMatrix<Dof> stiffness(const LiningSection& section, double length) {
    return section.axial_stiffness / length * ElementMatrix<Dof>::Identity();
  }
};

}  // namespace

template struct voussoir::Composition<Beam>;
