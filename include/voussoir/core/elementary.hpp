// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

/// The elementary functions that mechanics needs, from sums, products, quotients and roots alone:
/// the same bits on every processor and with every mathematical library. The library's own are not:
/// that of Linux takes other instructions, which round otherwise, where the processor has them, and
/// that of Windows is another one altogether. A case that one machine begins and another finishes
/// would show it.
///
/// Correct to an ulp or two, about as fast as the library's. A compiler that may fuse products and
/// sums (-ffp-contract, see docs/reproducibility.md) gives other last digits; `repeatable.hpp` has
/// functions that not even this changes, ten times as slow.
namespace voussoir::elementary {

namespace detail {
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                        infinite = std::numeric_limits<double>::infinity();
}

struct SineCosine {
  double sine, cosine;
};

/// Both of one angle [rad]; not a number where |x| >= 1e5, or where it is none.
[[nodiscard]] inline SineCosine sine_cosine(double x) {
  // Multiples of a right angle are taken off in three parts, of which the first two have so few
  // digits that their products with a small whole number are exact.
  double turns = 0;
  if (std::abs(x) > 0.25 * std::numbers::pi) {
    if (!(std::abs(x) < 1e5)) return {detail::not_a_number, detail::not_a_number};
    turns = std::floor(x * (2 / std::numbers::pi) + 0.5);
    x = ((x - turns * 0x1.921fb544p+0) - turns * 0x1.0b4611a6p-34) - turns * 0x1.3198a2e037073p-69;
  }
  // Taylor's series: the first term left out is below 1e-18 of the sum.
  const double s = x * x;
  const double sine_sum =
      s * (-1.0 / 6 +
           s * (1.0 / 120 +
                s * (-1.0 / 5040 +
                     s * (1.0 / 362880 +
                          s * (-1.0 / 39916800 +
                               s * (1.0 / 6227020800 +
                                    s * (-1.0 / 1307674368000 + s * (1.0 / 355687428096000))))))));
  const double cosine_sum =
      s * s *
      (1.0 / 24 +
       s * (-1.0 / 720 +
            s * (1.0 / 40320 +
                 s * (-1.0 / 3628800 + s * (1.0 / 479001600 + s * (-1.0 / 87178291200 +
                                                                   s * (1.0 / 20922789888000)))))));
  const double sine = x + x * sine_sum, half = 0.5 * s, rest = 1 - half;
  // What the subtraction lost is added again.
  const double cosine = rest + (((1 - rest) - half) + cosine_sum);
  switch (static_cast<long long>(turns) & 3) {
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
/// See `sine_cosine`.
[[nodiscard]] inline double sine(double x) { return sine_cosine(x).sine; }
/// See `sine_cosine`.
[[nodiscard]] inline double cosine(double x) { return sine_cosine(x).cosine; }
/// See `sine_cosine`.
[[nodiscard]] inline double tangent(double x) {
  const SineCosine both = sine_cosine(x);
  return both.sine / both.cosine;
}

/// Of the point (x, y), from the x axis anticlockwise: -pi to pi [rad]; 0 of (0, 0); not a number
/// if one of them is none or infinite.
[[nodiscard]] inline double angle_of(double y, double x) {
  const double a = std::abs(x), b = std::abs(y);
  if (!(a + b < detail::infinite)) return detail::not_a_number;
  const double longer = std::max(a, b), shorter = std::min(a, b);
  if (!(longer > 0)) return std::signbit(x) ? std::copysign(std::numbers::pi, y) : y;
  // Within 0.004 rad of the angle, then what is missing by its tangent.
  const double t = shorter / longer;
  const double near = t * (0.25 * std::numbers::pi + 0.273 * (1 - t));
  const SineCosine at = sine_cosine(near);
  const double d = (t * at.cosine - at.sine) / (at.cosine + t * at.sine), s = d * d;
  double angle = near + (d + d * s * (-1.0 / 3 + s * (1.0 / 5 - s / 7)));
  if (b > a) angle = 0.5 * std::numbers::pi - angle;
  if (std::signbit(x)) angle = std::numbers::pi - angle;
  return std::copysign(angle, y);
}

/// e^x
[[nodiscard]] inline double exponential(double x) {
  if (!(std::abs(x) < 1000)) return x > 0 ? detail::infinite : x < 0 ? 0 : x;
  const double count = std::floor(x * std::numbers::log2e + 0.5);
  const double r = (x - count * 0x1.62e42fee00000p-1) - count * 0x1.a39ef35793c76p-33;
  double sum = 1;
  for (int n = 14; n >= 2; --n) sum = 1 + r * sum / n;
  return std::ldexp(1 + r * sum, static_cast<int>(count));
}

/// Natural; -infinity of 0, not a number below.
[[nodiscard]] inline double logarithm(double x) {
  if (!(x > 0)) return x == 0 ? -detail::infinite : detail::not_a_number;
  if (x == detail::infinite) return x;
  int exponent = 0;
  double part = std::frexp(x, &exponent);  // 0.5 to 1
  if (part < 0.5 * std::numbers::sqrt2) {
    part *= 2;
    --exponent;
  }
  // log(part) = 2 artanh z, |z| < 0.172
  const double z = (part - 1) / (part + 1), s = z * z;
  double sum = 0;
  for (int n = 21; n >= 3; n -= 2) sum = s * (1.0 / n + sum);
  const double log = 2 * (z + z * sum), count = exponent;
  return count * 0x1.62e42fee00000p-1 + (log + count * 0x1.a39ef35793c76p-33);
}

/// x to the power of y, to 1e-15 of it where |y log x| is a few. @pre x > 0, or x = 0 and y > 0
[[nodiscard]] inline double power(double x, double y) { return exponential(y * logarithm(x)); }

/// The cube root; not a number below 0.
[[nodiscard]] inline double cube_root(double x) {
  if (!(x > 0)) return x == 0 ? 0 : detail::not_a_number;
  const double root = power(x, 1.0 / 3);
  return root - (root * root * root - x) / (3 * root * root);
}

/// Length of (x, y), for numbers whose squares neither vanish nor overflow.
[[nodiscard]] inline double length(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace voussoir::elementary
