// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <voussoir/core/small_algebra.hpp>

/// Inverses of the small blocks on the diagonal of a sparse factor. Plain loops: the decompositions
/// of a linear algebra library would cost every user a second of compile time.
namespace voussoir {

/// L^-1 of the Cholesky factor A = L L^T of a small symmetric matrix; its lower triangle is read.
/// @param smallest  a squared pivot of L that is not above `smallest[k]` ends it
/// @return  nothing if A is not positive definite to that measure
template <int Size>
[[nodiscard]] std::optional<Fixed<Size, Size>> inverse_cholesky_factor(
    const Fixed<Size, Size>& a, const Fixed<Size, 1>& smallest) {
  double lower[Size][Size];
  for (int c = 0; c < Size; ++c) {
    double square = a(c, c);
    for (int k = 0; k < c; ++k) square -= lower[c][k] * lower[c][k];
    if (!(square > smallest[c])) return std::nullopt;  // so that NaN is refused too
    lower[c][c] = std::sqrt(square);
    for (int r = c + 1; r < Size; ++r) {
      double sum = a(r, c);
      for (int k = 0; k < c; ++k) sum -= lower[r][k] * lower[c][k];
      lower[r][c] = sum / lower[c][c];
    }
  }
  Fixed<Size, Size> inverse = zeros<Fixed<Size, Size>>();
  for (int c = 0; c < Size; ++c) {
    inverse(c, c) = 1 / lower[c][c];
    for (int r = c + 1; r < Size; ++r) {
      double sum = 0;
      for (int k = c; k < r; ++k) sum -= lower[r][k] * inverse(k, c);
      inverse(r, c) = sum / lower[r][r];
    }
  }
  return inverse;
}

/// The inverse of a small matrix, by Gauss-Jordan elimination with row pivoting; not finite if it
/// is singular.
template <int Size>
[[nodiscard]] Fixed<Size, Size> inverse_of(Fixed<Size, Size> a) {
  Fixed<Size, Size> inverse = diagonal_of<Size>(1);
  for (int c = 0; c < Size; ++c) {
    int pivot = c;
    for (int r = c + 1; r < Size; ++r)
      if (std::abs(a(r, c)) > std::abs(a(pivot, c))) pivot = r;
    if (pivot != c)
      for (int k = 0; k < Size; ++k) {
        std::swap(a(c, k), a(pivot, k));
        std::swap(inverse(c, k), inverse(pivot, k));
      }
    const double scale = 1 / a(c, c);
    for (int k = 0; k < Size; ++k) {
      a(c, k) *= scale;
      inverse(c, k) *= scale;
    }
    for (int r = 0; r < Size; ++r) {
      if (r == c) continue;
      const double factor = a(r, c);
      for (int k = 0; k < Size; ++k) {
        a(r, k) -= factor * a(c, k);
        inverse(r, k) -= factor * inverse(c, k);
      }
    }
  }
  return inverse;
}

}  // namespace voussoir
