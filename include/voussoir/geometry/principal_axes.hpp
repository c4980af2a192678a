// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// The axes about which a symmetric 3 x 3 tensor is diagonal.
struct PrincipalAxes {
  Vec3 moments;            ///< eigenvalues, rising
  Fixed<3, 3> directions;  ///< unit eigenvectors in columns, right-handed
};

/// Cyclic Jacobi rotations; exact to rounding, and each small moment to its own size where the
/// tensor is scaled like that of a needle.
///
/// @param tensor  symmetric; the lower triangle is read
/// @cost  some 5 sweeps of 3 rotations
/// Source: Golub & Van Loan (2013), Matrix computations, 8.5.
[[nodiscard]] VOUSSOIR_INLINE PrincipalAxes principal_axes(const Fixed<3, 3>& tensor);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE PrincipalAxes principal_axes(const Fixed<3, 3>& tensor) {
  double a[3][3];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) a[r][c] = tensor(std::max(r, c), std::min(r, c));
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    bool rotated = false;
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      if (std::abs(a[p][q]) <= 1e-17 * std::sqrt(std::abs(a[p][p] * a[q][q]))) continue;
      rotated = true;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(1 + theta * theta));
      const double c = 1 / std::sqrt(1 + t * t), s = t * c;
      const double off = a[p][q];
      a[p][p] -= t * off;
      a[q][q] += t * off;
      a[p][q] = a[q][p] = 0;
      const int k = 3 - p - q;
      const double kp = a[k][p], kq = a[k][q];
      a[k][p] = a[p][k] = c * kp - s * kq;
      a[k][q] = a[q][k] = s * kp + c * kq;
      for (auto& row : v) {
        const double vp = row[p], vq = row[q];
        row[p] = c * vp - s * vq;
        row[q] = s * vp + c * vq;
      }
    }
    if (!rotated) break;
  }
  const auto order = order_of_values({a[0][0], a[1][1], a[2][2]});
  PrincipalAxes axes;
  for (int k = 0; k < 3; ++k) {
    const std::size_t from = order[static_cast<std::size_t>(k)];
    axes.moments[k] = a[from][from];
    set_column(axes.directions, k, Vec3(v[0][from], v[1][from], v[2][from]));
  }
  const Vec3 first = column(axes.directions, 0);
  if (dot_product(first, cross(column(axes.directions, 1), column(axes.directions, 2))) < 0)
    set_column(axes.directions, 0, Vec3(-first));
  VOUSSOIR_ASSERT(!(axes.moments[0] > axes.moments[1]) && !(axes.moments[1] > axes.moments[2]),
                  "principal values rise");
  return axes;
}

#endif

}  // namespace voussoir
