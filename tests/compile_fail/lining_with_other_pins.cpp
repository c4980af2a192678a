// expect: lining: `is_pinned` must be `static constexpr bool is_pinned` or `static bool is_pinned(const LiningSection&)`, or be left out
// SPDX-License-Identifier: MIT
// Pins that an object would have to be asked for: of a lining nobody makes one.
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
