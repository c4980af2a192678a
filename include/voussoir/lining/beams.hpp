// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/lining/lining_model.hpp>

namespace voussoir {

namespace detail {

/// The plane frame element; `phi` = 12 E I / (kappa G A l^2), 0 without shear deformation.
[[nodiscard]] VOUSSOIR_INLINE ElementMatrix<3> plane_frame(const LiningSection& section,
                                                           double length, double phi);

/// The frame element in 3-D: the plane one about both axes of the section, and torsion. Axes as
/// in `frame_axes`: bending_stiffness acts in the plane of x and y.
[[nodiscard]] VOUSSOIR_INLINE ElementMatrix<6> space_frame(const LiningSection& section,
                                                           double length, bool shears);

}  // namespace detail

/// Bending without shear deformation; exact for loads at the nodes.
struct EulerBernoulliBeam {
  using role = roles::Lining;
  static constexpr const char* name = "EulerBernoulliBeam";
  /// @param length  of the element [m], > 0
  template <int Dof>
  requires(Dof == 3 || Dof == 6)
      [[nodiscard]] static ElementMatrix<Dof> stiffness(const LiningSection& section,
                                                        double length) {
    if constexpr (Dof == 3)
      return detail::plane_frame(section, length, 0.0);
    else
      return detail::space_frame(section, length, false);
  }
};

/// Bending with shear deformation: matters once the thickness nears the node spacing.
/// Source: Przemieniecki (1968), Theory of matrix structural analysis.
struct TimoshenkoBeam {
  using role = roles::Lining;
  static constexpr const char* name = "TimoshenkoBeam";
  /// @param length  of the element [m], > 0
  template <int Dof>
  requires(Dof == 3 || Dof == 6)
      [[nodiscard]] static ElementMatrix<Dof> stiffness(const LiningSection& section,
                                                        double length) {
    if constexpr (Dof == 3)
      return detail::plane_frame(
          section, length,
          12 * section.bending_stiffness / (section.shear_stiffness * length * length));
    else
      return detail::space_frame(section, length, true);
  }
};

/// Bars pinned at the nodes: thrust and tension, no bending. What a membrane or a cracked shell
/// still does.
///
/// The rock pushes on the pins themselves (`is_pinned`). A pin does not turn: its rotation, which
/// nothing loads, is fixed by a spring to nowhere so that there is an answer for it, zero.
struct PinnedBar {
  using role = roles::Lining;
  static constexpr const char* name = "PinnedBar";
  static constexpr bool is_pinned = true;
  /// @param length  of the element [m], > 0
  template <int Dof>
  requires(Dof == 3 || Dof == 6)
      [[nodiscard]] static ElementMatrix<Dof> stiffness(const LiningSection& section,
                                                        double length) {
    constexpr int dim = Dof == 3 ? 2 : 3;
    ElementMatrix<Dof> k = zeros<ElementMatrix<Dof>>();
    const double axial = section.axial_stiffness / length;
    k(0, 0) = k(Dof, Dof) = axial;
    k(0, Dof) = k(Dof, 0) = -axial;
    for (int r = dim; r < Dof; ++r) k(r, r) = k(Dof + r, Dof + r) = axial * length * length;
    return k;
  }
};

/// Rigid pieces, one around each node, bonded face to face midway between the nodes: shotcrete as a
/// chain of bonded elements. The bond gives in thrust (E A / l), shear (kappa G A / l) and bending
/// (E I / l), and nothing else does; with short elements it is a Timoshenko beam.
///
/// Source: the rigid-body-spring model of Kawai (1978), Nucl. Eng. Des. 48, 207-229; in distinct
/// elements for linings Funatsu et al. (2008), Fig. 5a of Boon et al. (2015).
struct BondedChain {
  using role = roles::Lining;
  static constexpr const char* name = "BondedChain";
  /// @param length  of the element [m], > 0
  template <int Dof>
  requires(Dof == 3 || Dof == 6)
      [[nodiscard]] static ElementMatrix<Dof> stiffness(const LiningSection& section,
                                                        double length) {
    // Jump of the bond: rows; values of the two nodes: columns.
    Fixed<Dof, 2 * Dof> jump = zeros<Fixed<Dof, 2 * Dof>>();
    for (int r = 0; r < Dof; ++r) {
      jump(r, r) = -1;
      jump(r, Dof + r) = 1;
    }
    const double half = 0.5 * length;
    Fixed<Dof, Dof> bond = zeros<Fixed<Dof, Dof>>();
    const auto holds = [&bond](int direction, double stiffness) {
      bond(direction, direction) = stiffness;
    };
    if constexpr (Dof == 3) {
      jump(1, 2) = jump(1, 5) = -half;  // a turn of the node moves its face across
      holds(0, section.axial_stiffness);
      holds(1, section.shear_stiffness);
      holds(2, section.bending_stiffness);
    } else {
      jump(1, 5) = jump(1, 11) = -half;
      jump(2, 4) = jump(2, 10) = half;
      holds(0, section.axial_stiffness);
      holds(1, section.shear_stiffness);
      holds(2, section.shear_stiffness);
      holds(3, section.torsional_stiffness);
      holds(4, section.lateral_bending_stiffness);
      holds(5, section.bending_stiffness);
    }
    return transposed(jump) * (bond / length) * jump;
  }
};

static_assert(LiningModel<EulerBernoulliBeam, 3> && LiningModel<TimoshenkoBeam, 3> &&
              LiningModel<EulerBernoulliBeam, 6> && LiningModel<TimoshenkoBeam, 6>);
static_assert(LiningModel<PinnedBar, 3> && LiningModel<BondedChain, 3> &&
              LiningModel<PinnedBar, 6> && LiningModel<BondedChain, 6>);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE ElementMatrix<3> plane_frame(const LiningSection& section, double length,
                                             double phi) {
  VOUSSOIR_ASSERT(length > 0 && phi >= 0, "a beam has a length, and shear makes it softer");
  const double axial = section.axial_stiffness / length;
  const double b = section.bending_stiffness / (length * length * length * (1 + phi));
  const double v = 12 * b, vt = 6 * length * b, near = (4 + phi) * length * length * b,
               far = (2 - phi) * length * length * b;
  return by_rows<6, 6>({axial,  0,  0,    -axial, 0,   0,    //
                        0,      v,  vt,   0,      -v,  vt,   //
                        0,      vt, near, 0,      -vt, far,  //
                        -axial, 0,  0,    axial,  0,   0,    //
                        0,      -v, -vt,  0,      v,   -vt,  //
                        0,      vt, far,  0,      -vt, near});
}

VOUSSOIR_INLINE ElementMatrix<6> space_frame(const LiningSection& section, double length,
                                             bool shears) {
  const auto phi = [&](double bending) {
    return shears ? 12 * bending / (section.shear_stiffness * length * length) : 0.0;
  };
  const auto about = [&](double bending) {
    LiningSection plane = section;
    plane.bending_stiffness = bending;
    return plane_frame(plane, length, phi(bending));
  };
  // In the plane x, y: displacement 1, rotation 5 (about z). In x, z: displacement 2, rotation 4,
  // which runs the other way round: a slope dz/dx is a negative turn about y.
  const ElementMatrix<3> in_xy = about(section.bending_stiffness),
                         in_xz = about(section.lateral_bending_stiffness);
  constexpr int xy[] = {0, 1, 5, 6, 7, 11}, xz[] = {0, 2, 4, 6, 8, 10};
  constexpr double sign[] = {1, 1, -1, 1, 1, -1};
  ElementMatrix<6> k = zeros<ElementMatrix<6>>();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      k(xy[i], xy[j]) += in_xy(i, j);
      if (i % 3 != 0 && j % 3 != 0) k(xz[i], xz[j]) += sign[i] * sign[j] * in_xz(i, j);
    }
  const double torsion = section.torsional_stiffness / length;
  k(3, 3) = k(9, 9) = torsion;
  k(3, 9) = k(9, 3) = -torsion;
  return k;
}

}  // namespace detail

#endif

}  // namespace voussoir
