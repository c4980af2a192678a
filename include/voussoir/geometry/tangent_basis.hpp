// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/vec.hpp>

namespace voussoir {

/// The unit tangents of a contact whose normal is given: columns.
template <int Dim>
using TangentBasis = Eigen::Matrix<double, Dim, Dim - 1>;

[[nodiscard]] inline TangentBasis<2> tangent_basis(const Vec<2>& normal) {
  return perpendicular(normal);
}

/// Right-handed with the normal, and continuous in it but for one direction, as there must be one
/// (a sphere cannot be combed). That direction lies in no plane of the axes, where joints and
/// domain sides like to be.
///
/// @param normal  of unit length
///
/// A mirror carries a fixed unit vector s to -normal, hence the two tangents of s to tangents of
/// the normal; a mirror is orthogonal to rounding whatever the normal.
[[nodiscard]] inline TangentBasis<3> tangent_basis(const Vec<3>& normal) {
  const Vec3 s(2.0 / 7, 3.0 / 7, 6.0 / 7);                                   // exact unit vector:
  const Vec3 u(6.0 / 7, 2.0 / 7, -3.0 / 7), v(-3.0 / 7, 6.0 / 7, -2.0 / 7);  // 4 + 9 + 36 = 49
  const Vec3 h = s + normal;
  const double length_squared = h.squaredNorm();
  TangentBasis<3> basis;
  if (!(length_squared > 0)) {
    basis << v, u;
    return basis;
  }
  const double scale = 2 / length_squared;
  basis << u - (scale * h.dot(u)) * h, v - (scale * h.dot(v)) * h;
  return basis;
}

}  // namespace voussoir
