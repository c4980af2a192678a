// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// A rotation as an orthogonal matrix of determinant +1.
template <int Dim>
using Rotation = Eigen::Matrix<double, Dim, Dim>;

/// @param spin  angle, anticlockwise [rad]; of any size
[[nodiscard]] inline Rotation<2> rotation_by(const Spin<2>& spin) {
  const auto [s, c] = elementary::sine_cosine(spin[0]);
  return by_rows<2, 2>({c, -s, s, c});
}

/// Rodrigues' formula. @param spin  axis times angle, right-handed [rad]; of any size
[[nodiscard]] inline Rotation<3> rotation_by(const Spin<3>& spin) {
  const double angle = length_of(spin);
  // sin(t)/t and (1 - cos(t))/t^2, the latter as a square of a sine: no cancellation, and 0 is
  // fine.
  const double half = 0.5 * angle;
  const double ratio = angle > 1e-8 ? elementary::sine(angle) / angle : 1.0;
  const double half_ratio = half > 1e-8 ? elementary::sine(half) / half : 1.0;
  const Rotation<3> skew =
      by_rows<3, 3>({0, -spin[2], spin[1], spin[2], 0, -spin[0], -spin[1], spin[0], 0});
  return diagonal_of<3>(1) + ratio * skew + (0.5 * half_ratio * half_ratio * skew) * skew;
}

/// The inverse: -pi < angle <= pi.
[[nodiscard]] inline Spin<2> spin_of(const Rotation<2>& r) {
  return Spin<2>(elementary::angle_of(r(1, 0), r(0, 0)));
}
/// The inverse: axis times angle, 0 <= angle < pi. Within 1e-8 of half a turn the axis is lost.
[[nodiscard]] inline Spin<3> spin_of(const Rotation<3>& r) {
  const Spin<3> twice(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));  // axis 2 sin(t)
  const double sine = 0.5 * length_of(twice), cosine = 0.5 * (r(0, 0) + r(1, 1) + r(2, 2) - 1);
  const double angle = elementary::angle_of(sine, cosine);
  return (sine > 1e-8 ? 0.5 * angle / sine : 0.5) * twice;
}

/// Where a rigid body is: a point p of its own frame lies at position + rotation p.
template <int Dim>
struct Pose {
  Vec<Dim> position = zeros<Vec<Dim>>();  ///< of the origin of the body's frame [m]
  Rotation<Dim> rotation = diagonal_of<Dim>(1);

  [[nodiscard]] Vec<Dim> operator()(const Vec<Dim>& local) const {
    return position + rotation * local;
  }
};

}  // namespace voussoir
