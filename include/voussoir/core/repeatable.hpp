// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>

/// Arithmetic of which every bit is the same whatever compiler, flags and mathematical library a
/// program is built with. What is drawn at random is computed with it: the rock of a seed is that
/// rock everywhere. IEEE double precision, rounding to nearest, no -ffast-math.
///
/// Two things spoil that in plain code. A compiler may fuse a product and a sum into one operation
/// that rounds once (-march=native with GCC's default -ffp-contract=fast); here a product has a
/// zero added, with which it may be fused, and with nothing else. And the last digit of sin or log
/// is the library's choice, or the compiler's where it knows the argument; here they are sums of
/// IEEE operations in twice the digits (pairs of doubles), rounded at the end. Nothing of it is the
/// library's, not even `std::fma`: that of mingw-w64 rounds twice.
namespace voussoir::repeatable {

/// a b, rounded. (-0 becomes +0.)
[[nodiscard]] inline double product(double a, double b) { return a * b + 0.0; }

template <int Dim>
[[nodiscard]] Vec<Dim> scaled(double factor, const Vec<Dim>& v) {
  Vec<Dim> result;
  for (int k = 0; k < Dim; ++k) result[k] = product(factor, v[k]);
  return result;
}
template <int Dim>
[[nodiscard]] Vec<Dim> sum(const Vec<Dim>& a, const Vec<Dim>& b) {
  Vec<Dim> result;
  for (int k = 0; k < Dim; ++k) result[k] = a[k] + b[k];
  return result;
}
/// origin + factor * v
template <int Dim>
[[nodiscard]] Vec<Dim> along(const Vec<Dim>& origin, double factor, const Vec<Dim>& v) {
  return sum<Dim>(origin, scaled<Dim>(factor, v));
}
/// Added up from the last component on.
template <int Dim>
[[nodiscard]] double dot(const Vec<Dim>& a, const Vec<Dim>& b) {
  double result = product(a[Dim - 1], b[Dim - 1]);
  for (int k = Dim - 2; k >= 0; --k) result = product(a[k], b[k]) + result;
  return result;
}
template <int Dim>
[[nodiscard]] double norm(const Vec<Dim>& v) {
  return std::sqrt(dot<Dim>(v, v));
}
[[nodiscard]] inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {product(a.y(), b.z()) - product(a.z(), b.y()),
          product(a.z(), b.x()) - product(a.x(), b.z()),
          product(a.x(), b.y()) - product(a.y(), b.x())};
}

namespace detail {

/// high + low, |low| at most half a unit in the last place of high: 106 digits.
/// Source: Dekker (1971), A floating-point technique for extending the available precision.
struct Pair {
  double high, low;
};

[[nodiscard]] inline Pair exact_sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}
/// In two parts of 26 digits, whose products with such parts are exact.
[[nodiscard]] inline Pair halves(double a) {
  const double shifted = product(0x1p27 + 1, a), high = shifted - (shifted - a);
  return {high, a - high};
}
[[nodiscard]] inline Pair exact_product(double a, double b) {
  const double p = product(a, b);
#ifdef __FP_FAST_FMA  // an operation of the processor
  return {p, std::fma(a, b, -p)};
#else  // the same
  const Pair x = halves(a), y = halves(b);
  return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
#endif
}
[[nodiscard]] inline Pair operator+(const Pair& a, const Pair& b) {
  const Pair high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
  const Pair first = exact_sum(high.high, high.low + low.high);
  return exact_sum(first.high, first.low + low.low);
}
[[nodiscard]] inline Pair operator-(const Pair& a) { return {-a.high, -a.low}; }
[[nodiscard]] inline Pair operator*(const Pair& a, const Pair& b) {
  const Pair p = exact_product(a.high, b.high);
  return exact_sum(p.high, p.low + (product(a.high, b.low) + product(a.low, b.high)));
}
[[nodiscard]] inline Pair operator+(double a, const Pair& b) {
  const Pair high = exact_sum(a, b.high);
  return exact_sum(high.high, high.low + b.low);
}
[[nodiscard]] inline Pair operator/(const Pair& a, const Pair& b) {
  const double q = a.high / b.high;
  const Pair rest = a + -(b * Pair{q, 0});
  return exact_sum(q, rest.high / b.high);
}

[[nodiscard]] inline Pair operator/(const Pair& a, double b) {
  const double q = a.high / b;
  const Pair whole = exact_product(q, b);
  return exact_sum(q, (((a.high - whole.high) - whole.low) + a.low) / b);
}

/// pi / 2 and ln 2 in three doubles.
inline constexpr double quarter_turn[3] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54,
                                           -0x1.f1976b7ed8fbcp-110};
inline constexpr double log_of_2[3] = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56,
                                       0x1.7b57a079a1934p-111};

/// x - count * (a constant in three doubles). @pre |count| < 2^20
[[nodiscard]] inline Pair reduced(double x, double count, const double (&constant)[3]) {
  const Pair first = exact_product(-count, constant[0]);
  const Pair second = exact_product(-count, constant[1]);
  Pair rest = exact_sum(x, first.high) + Pair{first.low, 0};
  rest = rest + second;
  return rest + Pair{product(-count, constant[2]), 0};
}

/// 1 - r^2 / (m (m + 1)) (1 - r^2 / ((m + 2) (m + 3)) (1 - ...)), |r| <= pi / 4: Taylor's series of
/// cos r for m = 1, of sin(r) / r for m = 2. The last terms are plain doubles, which loses less
/// than 1e-21 of the sum.
/// @param minus_square  -r^2
[[nodiscard]] inline Pair alternating_series(const Pair& minus_square, int m) {
  double end = 1;
  for (int n = m + 20; n >= m + 8; n -= 2)
    end = product(minus_square.high, end / (n * (n + 1))) + 1;
  Pair sum{end, 0};
  for (int n = m + 6; n >= m; n -= 2) sum = 1 + minus_square * sum / (n * (n + 1));
  return sum;
}

}  // namespace detail

struct SineCosine {
  double sine, cosine;
};
/// Both of one angle [rad], the doubles nearest to them. @pre |x| < 1e5
[[nodiscard]] VOUSSOIR_INLINE SineCosine sine_cosine(double x);
/// @pre |x| < 1e5
[[nodiscard]] inline double sine(double x) { return sine_cosine(x).sine; }
/// @pre |x| < 1e5
[[nodiscard]] inline double cosine(double x) { return sine_cosine(x).cosine; }

/// e^x - 1 for x <= 0, exact where x is small.
[[nodiscard]] VOUSSOIR_INLINE double expm1(double x);

/// log(1 + x) for -1 < x <= 0, exact where x is small.
[[nodiscard]] VOUSSOIR_INLINE double log1p(double x);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE SineCosine sine_cosine(double x) {
  using detail::Pair;
  const double count = std::floor(product(x, 2 / std::numbers::pi) + 0.5);
  const Pair rest = detail::reduced(x, count, detail::quarter_turn), minus_square = -(rest * rest);
  const double sine = (rest * detail::alternating_series(minus_square, 2)).high;
  const double cosine = detail::alternating_series(minus_square, 1).high;
  switch (static_cast<long long>(count) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

VOUSSOIR_INLINE double expm1(double x) {
  using detail::Pair;
  if (x < -100) return -1;  // to rounding
  const double count = std::floor(product(x, 1 / detail::log_of_2[0]) + 0.5);
  const Pair rest = detail::reduced(x, count, detail::log_of_2);
  Pair sum{1, 0};
  for (int n = 22; n >= 2; --n) sum = 1 + rest * sum / n;
  sum = rest * sum;
  const double scale = std::ldexp(1.0, static_cast<int>(count));
  return (detail::exact_sum(scale, -1) + Pair{product(scale, sum.high), product(scale, sum.low)})
      .high;
}

VOUSSOIR_INLINE double log1p(double x) {
  using detail::Pair;
  Pair argument = detail::exact_sum(1, x), beyond{x, 0};  // 1 + x, and what it has beyond 1
  int count = 0;
  while (product(argument.high, std::ldexp(1.0, -count)) < 0.70710678) --count;
  if (count != 0) {
    const double scale = std::ldexp(1.0, -count);
    beyond = detail::exact_sum(product(scale, argument.high), -1) +
             Pair{product(scale, argument.low), 0};
  }
  // log(1 + y) = 2 artanh z, z = y / (2 + y), |z| < 0.18
  const Pair z = beyond / (2 + beyond), square = z * z;
  Pair sum{0, 0};
  for (int n = 45; n >= 1; n -= 2) sum = Pair{1, 0} / n + square * sum;
  const Pair log = Pair{2, 0} * z * sum;
  const double k = count;
  return (log + detail::exact_product(k, detail::log_of_2[0]) +
          detail::exact_product(k, detail::log_of_2[1]))
      .high;
}

#endif

}  // namespace voussoir::repeatable
