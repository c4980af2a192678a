// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <voussoir/core/random.hpp>
#include <voussoir/core/repeatable.hpp>

namespace repeatable_test {

using namespace voussoir;

namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;

/// The double nearest to the exact value, which is what the functions promise to all intents.
double nearest(const Exact& value) { return static_cast<double>(value); }

}  // namespace

TEST_SUITE("core/repeatable") {
  TEST_CASE("sine and cosine are the doubles nearest to the exact values") {
    Random random(1);
    int wrong = 0, checked = 0;
    const auto check = [&](double x) {
      wrong += repeatable::sine(x) != nearest(sin(Exact(x)));
      wrong += repeatable::cosine(x) != nearest(cos(Exact(x)));
      checked += 2;
    };
    for (int k = 0; k < 2000; ++k) check(8 * (random.uniform() - 0.5));
    for (int k = 0; k < 100; ++k) check(1e4 * (random.uniform() - 0.5));
    for (int k = -12; k <= 12; ++k)
      check(k * std::numbers::pi / 12);  // beside zeros: 6e-17 is right
    for (double x = 1; x > 1e-300; x *= 1e-7) check(x);
    CHECK(checked > 4000);
    CHECK(wrong == 0);
    CHECK(repeatable::sine(0) == 0);
    CHECK(repeatable::cosine(0) == 1);
  }

  TEST_CASE("expm1 and log1p are the doubles nearest to the exact values, down to tiny arguments") {
    Random random(2);
    int wrong = 0;
    const auto check = [&](double x) {
      wrong += repeatable::expm1(x) != nearest(boost::math::expm1(Exact(x)));
      if (x > -1) wrong += repeatable::log1p(x) != nearest(boost::math::log1p(Exact(x)));
    };
    for (int k = 0; k < 1000; ++k) check(-random.uniform());
    for (int k = 0; k < 200; ++k) check(-60 * random.uniform());
    for (double x = -1; x < -1e-290; x *= 1e-5) check(x);
    check(-1 + 0x1p-53);
    CHECK(wrong == 0);
    CHECK(repeatable::expm1(-1e6) == -1);
    CHECK(repeatable::expm1(0) == 0);
    CHECK(repeatable::log1p(0) == 0);
  }

  TEST_CASE("a product is rounded before it is added to") {
    // (1 + e)^2 = 1 + 2 e + e^2: rounded, the last term is lost, and is left by a fused operation.
    const double x = 1 + 0x1p-30;
    CHECK(repeatable::product(x, x) - (1 + 0x1p-29) == 0);
    CHECK(std::fma(x, x, -(1 + 0x1p-29)) == 0x1p-60);
    CHECK(repeatable::dot<3>({x, 0, 0}, {x, 0, 0}) == 1 + 0x1p-29);
    CHECK(repeatable::along<2>({1, 2}, 3, {4, 5}) == Vec2(13, 17));
    CHECK(repeatable::cross({1, 2, 3}, {4, 5, 6}) == Vec3(-3, 6, -3));
    CHECK(repeatable::norm<2>({3, 4}) == 5);
  }
}

}  // namespace repeatable_test
