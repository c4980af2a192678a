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
/// The mirror that carries a fixed unit vector s to -normal carries a tangent of s to a tangent of
/// the normal. Near -s the mirror itself is known badly; made perpendicular again, the tangent is
/// exact everywhere.
[[nodiscard]] inline TangentBasis<3> tangent_basis(const Vec<3>& normal) {
  const Vec3 s(2.0 / 7, 3.0 / 7, 6.0 / 7), u(6.0 / 7, 2.0 / 7, -3.0 / 7);  // 4 + 9 + 36 = 49
  const Vec3 h = s + normal;
  const double length_squared = squared_length_of(h);
  Vec3 first = length_squared > 0 ? Vec3(u - (2 * dot_product(h, u) / length_squared) * h) : u;
  first = normalized(first - dot_product(normal, first) * normal);
  TangentBasis<3> basis;
  set_column(basis, 0, first);
  set_column(basis, 1, cross(normal, first));
  return basis;
}

/// Normal and tangents as the columns of a rotation.
template <int Dim>
[[nodiscard]] Fixed<Dim, Dim> contact_frame(const Vec<Dim>& normal,
                                            const TangentBasis<Dim>& tangents) {
  Fixed<Dim, Dim> frame;
  set_column(frame, 0, normal);
  set_block(frame, 0, 1, tangents);
  return frame;
}

}  // namespace voussoir
