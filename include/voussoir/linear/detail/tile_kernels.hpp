// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

/// The innermost loops of a dense factorisation, on tiles of 8 x 8 numbers: 8 rows are packed as a
/// strip, entry (r, k) at 8 k + r, so that both factors of a product are read from front to back.
///
/// Written with the vector types of g++ and clang++, for -O2 leaves loops as they are. Each number
/// is the same sum in the same order whatever the length of a vector, so the bits are the same on
/// every machine, as long as products and sums are not fused: that is the compiler's to say, by
/// -ffp-contract=off (docs/reproducibility.md).
namespace voussoir::detail {

inline constexpr std::size_t tile = 8;  ///< rows and columns

template <std::size_t Count>
struct Lanes {
  using Type [[gnu::vector_size(8 * Count)]] = double;
};

/// c -= a b^T: a whole tile, its columns `stride` apart, and `depth` columns of two strips.
template <std::size_t Count>
[[gnu::always_inline]] inline void subtract_tile(double* c, std::size_t stride, const double* a,
                                                 const double* b, std::size_t depth) {
  using Vector = typename Lanes<Count>::Type;
  // Two vectors by four columns: eight sums are under way at any time, which hides the time that
  // one addition takes, and with the factors they fit the 16 registers.
  for (std::size_t half = 0; half < tile; half += 4)
    for (std::size_t row = 0; row < tile; row += 2 * Count) {
      Vector a0{}, a1{}, b0{}, b1{}, c0{}, c1{}, d0{}, d1{};
      const double *left = a + row, *right = b + half;
      for (std::size_t k = 0; k < depth; ++k, left += tile, right += tile) {
        Vector x, y;
        std::memcpy(&x, left, sizeof x);
        std::memcpy(&y, left + Count, sizeof y);
        a0 += x * right[0];
        a1 += y * right[0];
        b0 += x * right[1];
        b1 += y * right[1];
        c0 += x * right[2];
        c1 += y * right[2];
        d0 += x * right[3];
        d1 += y * right[3];
      }
      double* to = c + half * stride + row;
      const auto subtract = [](double* from, const Vector& sum) __attribute__((always_inline)) {
        Vector value;
        std::memcpy(&value, from, sizeof value);
        value -= sum;
        std::memcpy(from, &value, sizeof value);
      };
      subtract(to, a0);
      subtract(to + Count, a1);
      subtract(to + stride, b0);
      subtract(to + stride + Count, b1);
      subtract(to + 2 * stride, c0);
      subtract(to + 2 * stride + Count, c1);
      subtract(to + 3 * stride, d0);
      subtract(to + 3 * stride + Count, d1);
    }
}

/// The same with one vector for the eight rows, as long as there are such: by eight columns.
template <>
[[gnu::always_inline]] inline void subtract_tile<tile>(double* c, std::size_t stride,
                                                       const double* a, const double* b,
                                                       std::size_t depth) {
  using Vector = typename Lanes<tile>::Type;
  Vector s0{}, s1{}, s2{}, s3{}, s4{}, s5{}, s6{}, s7{};
  for (std::size_t k = 0; k < depth; ++k, a += tile, b += tile) {
    Vector x;
    std::memcpy(&x, a, sizeof x);
    s0 += x * b[0];
    s1 += x * b[1];
    s2 += x * b[2];
    s3 += x * b[3];
    s4 += x * b[4];
    s5 += x * b[5];
    s6 += x * b[6];
    s7 += x * b[7];
  }
  const auto subtract = [&c, stride ](const Vector& sum) __attribute__((always_inline)) {
    Vector value;
    std::memcpy(&value, c, sizeof value);
    value -= sum;
    std::memcpy(c, &value, sizeof value);
    c += stride;
  };
  subtract(s0);
  subtract(s1);
  subtract(s2);
  subtract(s3);
  subtract(s4);
  subtract(s5);
  subtract(s6);
  subtract(s7);
}

/// x := x L^-T for `columns` (up to 8) columns of a strip; of the strip `lower` the entries below
/// the diagonal are read, `reciprocal` are those of the diagonal of L.
template <std::size_t Count>
[[gnu::always_inline]] inline void solve_tile(double* x, const double* lower,
                                              const double* reciprocal, std::size_t columns) {
  using Vector = typename Lanes<Count>::Type;
  for (std::size_t row = 0; row < tile; row += 2 * Count)
    for (std::size_t c = 0; c < columns; ++c) {
      Vector upper, below, left, right;
      double* const to = x + tile * c + row;
      std::memcpy(&upper, to, sizeof upper);
      std::memcpy(&below, to + Count, sizeof below);
      for (std::size_t k = 0; k < c; ++k) {
        std::memcpy(&left, x + tile * k + row, sizeof left);
        std::memcpy(&right, x + tile * k + row + Count, sizeof right);
        upper -= left * lower[tile * k + c];
        below -= right * lower[tile * k + c];
      }
      upper *= reciprocal[c];
      below *= reciprocal[c];
      std::memcpy(to, &upper, sizeof upper);
      std::memcpy(to + Count, &below, sizeof below);
    }
}

/// The same functions compiled for two and for four numbers in a vector.
struct TileKernels {
  void (*subtract)(double* c, std::size_t stride, const double* a, const double* b,
                   std::size_t depth);
  void (*solve)(double* x, const double* lower, const double* reciprocal, std::size_t columns);
};

inline void subtract_tile_plain(double* c, std::size_t stride, const double* a, const double* b,
                                std::size_t depth) {
  subtract_tile<2>(c, stride, a, b, depth);
}
inline void solve_tile_plain(double* x, const double* lower, const double* reciprocal,
                             std::size_t columns) {
  solve_tile<2>(x, lower, reciprocal, columns);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] inline void subtract_tile_avx2(double* c, std::size_t stride,
                                                       const double* a, const double* b,
                                                       std::size_t depth) {
  subtract_tile<4>(c, stride, a, b, depth);
}
[[gnu::target("avx2")]] inline void solve_tile_avx2(double* x, const double* lower,
                                                    const double* reciprocal, std::size_t columns) {
  solve_tile<4>(x, lower, reciprocal, columns);
}
[[gnu::target("avx512f")]] inline void subtract_tile_avx512(double* c, std::size_t stride,
                                                            const double* a, const double* b,
                                                            std::size_t depth) {
  subtract_tile<tile>(c, stride, a, b, depth);
}
#endif

/// The fastest that this processor has.
[[nodiscard]] inline TileKernels tile_kernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return {subtract_tile_avx512, solve_tile_avx2};
  if (__builtin_cpu_supports("avx2")) return {subtract_tile_avx2, solve_tile_avx2};
#endif
  return {subtract_tile_plain, solve_tile_plain};
}

}  // namespace voussoir::detail
