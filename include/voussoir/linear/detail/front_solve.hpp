// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <voussoir/core/bodies.hpp>
#include <voussoir/linear/detail/tile_kernels.hpp>

namespace voussoir::detail {

/// y := L^-1 y for the columns of a panel, and y -= L y for the rows below. The diagonal of the
/// panel holds reciprocals.
VOUSSOIR_INLINE void solve_forward(const double* panel, std::size_t height, std::size_t width,
                                   double* y);
/// The same with L^T: y of the columns, from what is known of the rows below.
VOUSSOIR_INLINE void solve_backward(const double* panel, std::size_t height, std::size_t width,
                                    double* y);

#if VOUSSOIR_BODIES

/// Four columns at a time, so that y is read and written a quarter as often; rows by two.
VOUSSOIR_INLINE void solve_forward(const double* panel, std::size_t height, std::size_t width,
                                   double* y) {
  using Two = Lanes<2>::Type;
  std::size_t c = 0;
  for (; c + 4 <= width; c += 4) {
    const double* const l = panel + c * height;
    for (std::size_t k = 0; k < 4; ++k) {
      y[c + k] *= l[k * height + c + k];
      for (std::size_t r = k + 1; r < 4; ++r) y[c + r] -= l[k * height + c + r] * y[c + k];
    }
    const double a = y[c], b = y[c + 1], d = y[c + 2], e = y[c + 3];
    std::size_t r = c + 4;
    for (; r + 2 <= height; r += 2) {
      Two la, lb, ld, le, to;
      std::memcpy(&la, l + r, sizeof la);
      std::memcpy(&lb, l + height + r, sizeof lb);
      std::memcpy(&ld, l + 2 * height + r, sizeof ld);
      std::memcpy(&le, l + 3 * height + r, sizeof le);
      std::memcpy(&to, y + r, sizeof to);
      to -= (la * a + lb * b) + (ld * d + le * e);
      std::memcpy(y + r, &to, sizeof to);
    }
    if (r < height)
      y[r] -= (l[r] * a + l[height + r] * b) + (l[2 * height + r] * d + l[3 * height + r] * e);
  }
  for (; c < width; ++c) {
    const double* const l = panel + c * height;
    const double a = y[c] *= l[c];
    for (std::size_t r = c + 1; r < height; ++r) y[r] -= l[r] * a;
  }
}

VOUSSOIR_INLINE void solve_backward(const double* panel, std::size_t height, std::size_t width,
                                    double* y) {
  using Two = Lanes<2>::Type;
  std::size_t c = width;
  for (; c % 4 != 0; --c) {
    const double* const l = panel + (c - 1) * height;
    double sum = 0;
    for (std::size_t r = c; r < height; ++r) sum += l[r] * y[r];
    y[c - 1] = (y[c - 1] - sum) * l[c - 1];
  }
  for (; c > 0; c -= 4) {
    const double* const l = panel + (c - 4) * height;
    Two sum[4] = {};
    Two a{}, b{}, d{}, e{};
    std::size_t r = c;
    for (; r + 2 <= height; r += 2) {
      Two la, lb, ld, le, x;
      std::memcpy(&la, l + r, sizeof la);
      std::memcpy(&lb, l + height + r, sizeof lb);
      std::memcpy(&ld, l + 2 * height + r, sizeof ld);
      std::memcpy(&le, l + 3 * height + r, sizeof le);
      std::memcpy(&x, y + r, sizeof x);
      a += la * x;
      b += lb * x;
      d += ld * x;
      e += le * x;
    }
    sum[0] = a, sum[1] = b, sum[2] = d, sum[3] = e;
    for (std::size_t k = 4; k-- > 0;) {
      double& to = y[c - 4 + k];
      double total = sum[k][0] + sum[k][1];
      if (r < height) total += l[k * height + r] * y[r];
      for (std::size_t m = k + 1; m < 4; ++m) total += l[k * height + c - 4 + m] * y[c - 4 + m];
      to = (to - total) * l[k * height + c - 4 + k];
    }
  }
}

#endif

}  // namespace voussoir::detail
