// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Section of a lining, per metre of tunnel in 2-D.
struct LiningSection {
  double axial_stiffness;    ///< E A [N]
  double bending_stiffness;  ///< E I [N m^2]
  double shear_stiffness;    ///< kappa G A [N]
  double mass = 0;           ///< per length of lining [kg/m]; 0: weightless, as in the paper

  /// A rectangular section: shotcrete or concrete of thickness t, one metre wide, kappa = 5/6.
  /// @param young_modulus  E [Pa], > 0;  @param poisson_ratio  -1 < nu < 0.5
  /// @throws InvalidInput  a value out of range
  [[nodiscard]] static LiningSection rectangular(double thickness, double young_modulus,
                                                 double poisson_ratio = 0.2) {
    require(thickness > 0 && std::isfinite(thickness), "lining thickness", thickness, "> 0 m");
    require(young_modulus > 0 && std::isfinite(young_modulus), "lining modulus", young_modulus,
            "> 0 Pa");
    require(poisson_ratio > -1 && poisson_ratio < 0.5, "lining Poisson ratio", poisson_ratio,
            "> -1 and < 0.5");
    return {young_modulus * thickness, young_modulus * thickness * thickness * thickness / 12,
            5.0 / 6.0 * young_modulus / (2 * (1 + poisson_ratio)) * thickness};
  }
};

/// Stiffness of one straight element in its own axes: first node, then second; translations, then
/// rotations; x along the element.
template <int Dof>
using ElementMatrix = Eigen::Matrix<double, 2 * Dof, 2 * Dof>;

template <class Lining, int Dof>
concept HasElementStiffness = requires(const LiningSection& section, double length) {
  { Lining::template stiffness<Dof>(section, length) } -> std::same_as<ElementMatrix<Dof>>;
};

/// The straight elements that a lining is made of, between nodes that move and turn.
///
/// What the compiler cannot check: the matrix is symmetric and does not resist rigid motion.
///
/// Models: EulerBernoulliBeam, TimoshenkoBeam.
template <class Lining, int Dof>
concept LiningModel = Fills<Lining, roles::Lining> && HasElementStiffness<Lining, Dof>;

template <class Lining, int Dof>
consteval bool explain_lining_model() {
  static_assert(HasElementStiffness<Lining, Dof>,
                "lining: add `template <int Dof> static ElementMatrix<Dof> stiffness(const "
                "LiningSection&, double length)`");
  return true;
}

}  // namespace voussoir
