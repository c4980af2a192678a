// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <voussoir/core/small_algebra.hpp>

namespace voussoir {

/// A point, displacement or force in the space of the model; world axes x right, y up (z up in
/// 3-D).
template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

/// Number of independent rotations of a rigid body.
template <int Dim>
inline constexpr int spin_count = Dim == 2 ? 1 : 3;

/// A small rotation [rad] or a moment [N m]; one number in 2-D, anticlockwise positive.
template <int Dim>
using Spin = Eigen::Matrix<double, spin_count<Dim>, 1>;

/// A stress tensor [Pa], compression positive (ground).
template <int Dim>
using Stress = Eigen::Matrix<double, Dim, Dim>;

/// v turned by +90 degrees.
[[nodiscard]] inline Vec2 perpendicular(const Vec2& v) { return {-v.y(), v.x()}; }

/// Cross product of two vectors. In 2-D its z component, twice the signed area of the triangle
/// (0, a, b); in 3-D the area vector of the parallelogram.
template <int Dim>
requires(Dim == 2 || Dim == 3)
    [[nodiscard]] inline auto cross(const Fixed<Dim, 1>& a, const Fixed<Dim, 1>& b) {
  if constexpr (Dim == 2) {
    return a.x() * b.y() - a.y() * b.x();
  } else {
    return Vec3(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                a.x() * b.y() - a.y() * b.x());
  }
}

template <class A, class B>
[[nodiscard]] auto cross(const Eigen::MatrixBase<A>& left, const Eigen::MatrixBase<B>& right) {
  constexpr int dim = A::RowsAtCompileTime;
  return cross(Vec<dim>(left), Vec<dim>(right));
}

/// Displacement of a point at `arm` from the centre of a body that turns by the small rotation
/// `spin`.
[[nodiscard]] inline Vec<2> turned(const Spin<2>& spin, const Vec<2>& arm) {
  return {-spin[0] * arm.y(), spin[0] * arm.x()};
}
[[nodiscard]] inline Vec<3> turned(const Spin<3>& spin, const Vec<3>& arm) {
  return cross(spin, arm);
}

/// Moment about the centre of a force that acts at `arm` from it: the transpose of `turned`.
[[nodiscard]] inline Spin<2> moment_of(const Vec<2>& arm, const Vec<2>& force) {
  return Spin<2>(cross(arm, force));
}
[[nodiscard]] inline Spin<3> moment_of(const Vec<3>& arm, const Vec<3>& force) {
  return turned(arm, force);
}

/// A point in metres for a message, "(1.5, 30)"; less than a nanometre is 0.
template <int Dim>
[[nodiscard]] std::string text_of(const Vec<Dim>& point) {
  std::string text;
  for (int k = 0; k < Dim; ++k) {
    char number[32];
    std::snprintf(number, sizeof number, k == 0 ? "(%.6g" : ", %.6g",
                  std::abs(point[k]) < 1e-9 ? 0.0 : point[k]);
    text += number;
  }
  return text + ")";
}

}  // namespace voussoir
