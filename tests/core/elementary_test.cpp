// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/random.hpp>

#include "support/near.hpp"

namespace elementary_test {

using namespace voussoir;

namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;

/// Distance from the exact value in units in the last place of the nearest double.
double ulps(double value, const Exact& exact) {
  const double nearest = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return static_cast<double>(abs(Exact(value) - exact) / unit);
}

}  // namespace

TEST_SUITE("core/elementary") {
  // Bounds: two to three roundings of half an ulp and what an argument's own rounding becomes.
  void compare(int samples) {
    Random random(1);
    double worst = 0;
    const auto check = [&](double value, const Exact& exact) {
      worst = std::max(worst, ulps(value, exact));
    };
    for (int k = 0; k < samples; ++k) {
      const double x = (k % 3 == 0 ? 0.8 : 40) * (2 * random.uniform() - 1);
      const double y = 2 * random.uniform() - 1, scale = 1e6 * random.uniform() + 1e-6;
      check(elementary::sine(x), sin(Exact(x)));
      check(elementary::cosine(x), cos(Exact(x)));
      check(elementary::tangent(x), tan(Exact(x)));
      check(elementary::angle_of(y, x), atan2(Exact(y), Exact(x)));
      check(elementary::angle_of(x, y), atan2(Exact(x), Exact(y)));
      check(elementary::logarithm(scale), log(Exact(scale)));
      check(elementary::exponential(y), exp(Exact(y)));
      check(elementary::cube_root(scale), cbrt(Exact(scale)));
    }
    for (double x = 1; x > 1e-300; x *= 1e-7) {
      check(elementary::sine(x), sin(Exact(x)));
      check(elementary::angle_of(x, 1), atan2(Exact(x), Exact(1)));
    }
    CHECK(worst > 0.5);  // or nothing was compared
    CHECK(worst < 3);
    // A power multiplies the error of a logarithm: the bound is that of its description.
    for (int k = 0; k < samples / 4; ++k) {
      const double x = std::exp(6 * random.uniform() - 3), y = 2 * random.uniform() - 1;
      CHECK(elementary::power(x, y) ==
            voussoir_test::near(static_cast<double>(pow(Exact(x), Exact(y)))).epsilon(1e-15));
    }
  }
  TEST_CASE("the elementary functions are right to three units in the last place") { compare(400); }
  TEST_CASE("the elementary functions at 4 000 places [long]") { compare(4000); }

  // A number that is none must stay none: it would otherwise pass for an angle.
  TEST_CASE("beyond their arguments elementary functions are infinite or not a number") {
    const double inf = std::numeric_limits<double>::infinity(),
                 none = std::numeric_limits<double>::quiet_NaN();
    for (const double x : {inf, -inf, none}) {
      CAPTURE(x);
      CHECK(std::isnan(elementary::sine(x)));
      CHECK(std::isnan(elementary::cosine(x)));
      CHECK(std::isnan(elementary::tangent(x)));
      CHECK(std::isnan(elementary::angle_of(x, 1)));
      CHECK(std::isnan(elementary::angle_of(-1, x)));
      CHECK(std::isnan(elementary::angle_of(x, x)));
    }
    for (const double x : {1e5, -1e5, 1e300}) CHECK(std::isnan(elementary::sine(x)));
    CHECK(elementary::sine(99999.0) == voussoir_test::near(std::sin(99999.0)).epsilon(1e-10));
    for (const double x : {inf, 1e300, 1001.0, 710.0, -750.0, -1001.0, -1e300, -inf}) {
      CAPTURE(x);
      CHECK(elementary::exponential(x) == std::exp(x));
    }
    CHECK(elementary::exponential(709.5) == voussoir_test::near(std::exp(709.5)).epsilon(1e-14));
    CHECK(std::isnan(elementary::exponential(none)));
    CHECK(elementary::logarithm(0) == -inf);
    CHECK(elementary::logarithm(inf) == inf);
    for (const double x : {-1.0, -inf, none}) {
      CAPTURE(x);
      CHECK(std::isnan(elementary::logarithm(x)));
      CHECK(std::isnan(elementary::cube_root(x)));
    }
    CHECK(elementary::power(0, 0.5) == 0);
    CHECK(elementary::cube_root(0) == 0);
  }

  TEST_CASE("beside multiples of a right angle little is left of a sine, and that is right") {
    for (int k = -40; k <= 40; ++k) {
      const double x = k * (std::numbers::pi / 2);
      if (k % 2 == 0 && k != 0) {
        const double exact = static_cast<double>(sin(Exact(x)));
        // Three parts of pi / 2 have 53 digits behind the ones that cancel: 2^-116 of a turn.
        CHECK(std::abs(elementary::sine(x) - exact) < 1e-30);
      }
      CHECK(std::abs(elementary::cosine(x) - static_cast<double>(cos(Exact(x)))) < 0x1p-52);
    }
  }

  TEST_CASE("angles go all the way round, as those of the library do") {
    const double zero = 0, pi = std::numbers::pi;
    for (const double y : {-2.0, -zero, zero, 1e-300, 3.0})
      for (const double x : {-2.0, -zero, zero, 5.0}) {
        CAPTURE(x);
        CAPTURE(y);
        CHECK(elementary::angle_of(y, x) == voussoir_test::near(std::atan2(y, x)).epsilon(1e-15));
        CHECK(std::signbit(elementary::angle_of(y, x)) == std::signbit(std::atan2(y, x)));
      }
    CHECK(elementary::angle_of(1, 1) == voussoir_test::near(0.25 * pi).epsilon(1e-15));
  }

  // The bits of ten thousand values, hashed: recorded on one machine, the same on every other.
  TEST_CASE("no bit depends on the processor") {
    Random random(7);
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&](double value) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x100000001b3U;
    };
    for (int k = 0; k < 2000; ++k) {
      const double x = 6 * random.uniform() - 3, y = 2 * random.uniform() - 1;
      add(elementary::sine(x));
      add(elementary::tangent(y));
      add(elementary::angle_of(y, x));
      add(elementary::exponential(x));
      add(elementary::power(std::abs(x), y));
    }
    CHECK(hash == 6485181826491479062U);
  }
}

}  // namespace elementary_test
