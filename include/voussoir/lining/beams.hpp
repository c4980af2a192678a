// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/lining/lining_model.hpp>

namespace voussoir {

namespace detail {

/// The plane frame element; `phi` = 12 E I / (kappa G A l^2), 0 without shear deformation.
[[nodiscard]] inline ElementMatrix<3> plane_frame(const LiningSection& section, double length,
                                                  double phi) {
  const double axial = section.axial_stiffness / length;
  const double b = section.bending_stiffness / (length * length * length * (1 + phi));
  const double v = 12 * b, vt = 6 * length * b, near = (4 + phi) * length * length * b,
               far = (2 - phi) * length * length * b;
  ElementMatrix<3> k;
  k << axial, 0, 0, -axial, 0, 0,  //
      0, v, vt, 0, -v, vt,         //
      0, vt, near, 0, -vt, far,    //
      -axial, 0, 0, axial, 0, 0,   //
      0, -v, -vt, 0, v, -vt,       //
      0, vt, far, 0, -vt, near;
  return k;
}

}  // namespace detail

/// Bending without shear deformation; exact for loads at the nodes.
struct EulerBernoulliBeam {
  using role = roles::Lining;
  static constexpr const char* name = "EulerBernoulliBeam";
  /// @param length  of the element [m], > 0
  template <int Dof>
  requires(Dof == 3) [[nodiscard]] static ElementMatrix<Dof> stiffness(const LiningSection& section,
                                                                       double length) {
    return detail::plane_frame(section, length, 0.0);
  }
};

/// Bending with shear deformation: matters once the thickness nears the node spacing.
/// Source: Przemieniecki (1968), Theory of matrix structural analysis.
struct TimoshenkoBeam {
  using role = roles::Lining;
  static constexpr const char* name = "TimoshenkoBeam";
  /// @param length  of the element [m], > 0
  template <int Dof>
  requires(Dof == 3) [[nodiscard]] static ElementMatrix<Dof> stiffness(const LiningSection& section,
                                                                       double length) {
    return detail::plane_frame(
        section, length,
        12 * section.bending_stiffness / (section.shear_stiffness * length * length));
  }
};

static_assert(LiningModel<EulerBernoulliBeam, 3> && LiningModel<TimoshenkoBeam, 3>);

}  // namespace voussoir
