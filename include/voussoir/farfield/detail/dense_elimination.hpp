// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <voussoir/core/errors.hpp>

namespace voussoir::detail {

/// target[i] -= sum over k of factor[k] * from[k][i], four columns at a time: each number of the
/// target is then read and written a quarter as often.
/// @param from    first of the columns;  @param stride  from one to the next, of both
inline void subtract_columns(double* target, Eigen::Index size, const double* from,
                             const double* factor, Eigen::Index stride, Eigen::Index count) {
  Eigen::Index k = 0;
  for (; k + 4 <= count; k += 4) {
    const double* const columns = from + k * stride;
    const double f0 = factor[k * stride], f1 = factor[(k + 1) * stride],
                 f2 = factor[(k + 2) * stride], f3 = factor[(k + 3) * stride];
    for (Eigen::Index i = 0; i < size; ++i)
      target[i] -= f0 * columns[i] + f1 * columns[stride + i] + f2 * columns[2 * stride + i] +
                   f3 * columns[3 * stride + i];
  }
  for (; k < count; ++k)
    for (Eigen::Index i = 0; i < size; ++i) target[i] -= factor[k * stride] * from[k * stride + i];
}

/// sum -= C A^-1 C^T with A symmetric and positive definite: what is left of a stiffness when some
/// of its rows are eliminated. All are square, of one size; A and C are overwritten.
/// @cost  7 / 6 n^3 multiplications
inline void eliminate(Eigen::MatrixXd& a, Eigen::MatrixXd& c, Eigen::MatrixXd& sum) {
  const Eigen::Index n = a.rows();
  double *const l = a.data(), *const x = c.data(), *const s = sum.data();
  // A = L L^T, below the diagonal, and C := C L^-T, both column by column.
  for (Eigen::Index k = 0; k < n; ++k) {
    double *const column = l + k * n, *const of_c = x + k * n;
    subtract_columns(column + k, n - k, l + k, l + k, n, k);
    VOUSSOIR_ASSERT(column[k] > 0, "a stiffness is positive definite");
    const double scale = 1 / std::sqrt(column[k]);
    for (Eigen::Index i = k; i < n; ++i) column[i] *= scale;
    subtract_columns(of_c, n, x, l + k, n, k);
    for (Eigen::Index i = 0; i < n; ++i) of_c[i] *= scale;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    subtract_columns(s + k * n + k, n - k, x + k, x + k, n, n);
    for (Eigen::Index i = k + 1; i < n; ++i) s[i * n + k] = s[k * n + i];
  }
}

}  // namespace voussoir::detail
