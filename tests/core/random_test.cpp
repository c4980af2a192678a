// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>
#include <voussoir/core/random.hpp>

namespace random_test {

using namespace voussoir;

// Bounds on sampled quantities are 4 standard errors, or the value a right generator exceeds once
// in a thousand seeds; the seeds are fixed, so a test that passes once passes always.

TEST_SUITE("core/random") {
  TEST_CASE("Philox4x32-10 gives the known answers of its authors") {
    using Block = std::array<std::uint32_t, 4>;
    // Random123, file kat_vectors: counter and key zero, all ones, and the digits of pi.
    CHECK(Random::philox({0, 0, 0, 0}, {0, 0}) ==
          Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    const std::uint32_t ones = 0xffffffff;
    CHECK(Random::philox({ones, ones, ones, ones}, {ones, ones}) ==
          Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(Random::philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                         {0xa4093822, 0x299f31d0}) ==
          Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
  }

  TEST_CASE("seed, stream and counter take their places in the block") {
    const std::uint64_t seed = 0x1122334455667788, stream = 0x99aabbccddeeff00;
    Random random(seed, stream);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto block = Random::philox({k, 0, 0xddeeff00, 0x99aabbcc}, {0x55667788, 0x11223344});
      CHECK(random.bits() == (block[0] | std::uint64_t{block[1]} << 32));
      CHECK(random.bits() == (block[2] | std::uint64_t{block[3]} << 32));
    }
  }

  TEST_CASE("the first numbers of seed 1 are the same on every platform") {
    // bits: from another implementation of Philox (10 lines of Python); the rest follows from them.
    const std::array<std::uint64_t, 4> bits = {0xe50a0ebce3e80670, 0xb615aa2795f222c0,
                                               0xdfc5ccbeac08141b, 0xa7f6609379c07a47};
    Random of_bits(1), of_uniform(1), of_below(1), of_normal(1);
    for (const std::uint64_t expected : bits) {
      CHECK(of_bits.bits() == expected);
      CHECK(of_uniform.uniform() == std::ldexp(static_cast<double>(expected >> 11), -53));
      CHECK(of_below.below(10) == expected % 10);
    }
    for (const double expected :
         {-0x1.d2cd3d7db3e1bp-1, -0x1.0013806de5c4p-5, -0x1.4ddcafed38d3dp+0, -0x1.8348b988e2a1p-2})
      CHECK(of_normal.normal() == expected);
  }

  TEST_CASE("seeds and streams do not repeat each other and are not correlated") {
    const int count = 4000;
    std::vector<std::vector<double>> samples;
    std::set<std::uint64_t> seen;
    for (const auto& [seed, stream] :
         {std::pair{1, 0}, std::pair{1, 1}, std::pair{2, 0}, std::pair{2, 1}, std::pair{1, 2}}) {
      Random bits(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(stream));
      Random values = bits;
      samples.emplace_back();
      for (int k = 0; k < count; ++k) {
        seen.insert(bits.bits());
        samples.back().push_back(values.uniform() - 0.5);
      }
    }
    // 20 000 numbers of 64 bits: two are equal with probability 2e8 / 2^64 = 1e-11.
    CHECK(seen.size() == 5U * count);
    for (std::size_t i = 0; i < samples.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double product = 0;
        for (std::size_t k = 0; k < samples[i].size(); ++k)
          product += samples[i][k] * samples[j][k];
        // The variance of a uniform number is 1/12; the correlation has standard error 1/sqrt(n).
        CHECK(std::abs(12 * product / count) < 4 / std::sqrt(count));
      }
  }

  TEST_CASE("drawing from one stream leaves another where it was") {
    Random alone(7, 3), left(7, 3), right(7, 4);
    for (int k = 0; k < 100; ++k) {
      (void)right.normal();
      CHECK(left.bits() == alone.bits());
    }
  }

  TEST_CASE("below() is unbiased where a plain remainder is not") {
    // A 64-bit number modulo 3 * 2^62 falls below 2^62 with probability 1/2 instead of 1/3.
    const std::uint64_t quarter = std::uint64_t{1} << 62;
    const int count = 20000;
    Random random(3);
    int low = 0;
    for (int k = 0; k < count; ++k) {
      const std::uint64_t value = random.below(3 * quarter);
      REQUIRE(value < 3 * quarter);
      low += value < quarter ? 1 : 0;
    }
    const double share = static_cast<double>(low) / count;
    CHECK(std::abs(share - 1.0 / 3) < 4 * std::sqrt(2.0 / 9 / count));
  }

  TEST_CASE("below(n) takes each of its n values equally often, below(1) is 0") {
    Random random(4);
    const int count = 20000;
    std::array<int, 10> seen{};
    for (int k = 0; k < count; ++k) ++seen[random.below(10)];
    double chi_squared = 0;
    for (const int n : seen) chi_squared += (n - 0.1 * count) * (n - 0.1 * count) / (0.1 * count);
    CHECK(chi_squared < 27.88);  // 9 degrees of freedom, 0.1 %
    CHECK(chi_squared > 1.15);   // the same at 99.9 %: too even is wrong as well
    for (int k = 0; k < 10; ++k) CHECK(random.below(1) == 0);
  }

  TEST_CASE("uniform() stays in [0, 1) and follows the straight line") {
    Random random(5);
    std::vector<double> values(20000);
    for (double& v : values) v = random.uniform();
    std::sort(values.begin(), values.end());
    CHECK(values.front() >= 0);
    CHECK(values.back() < 1);
    const auto n = static_cast<double>(values.size());
    double distance = 0;  // Kolmogorov-Smirnov
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto step = static_cast<double>(k);
      distance = std::max({distance, values[k] - step / n, (step + 1) / n - values[k]});
    }
    CHECK(distance < 1.95 / std::sqrt(n));  // 0.1 %
    CHECK(distance > 0.4 / std::sqrt(n));   // 99.7 %: a lattice would be too even
  }

  TEST_CASE("normal() follows the error function") {
    Random random(6);
    std::vector<double> values(20000);
    for (double& v : values) v = random.normal();
    std::sort(values.begin(), values.end());
    const auto n = static_cast<double>(values.size());
    double distance = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double expected = 0.5 * std::erfc(-values[k] / std::sqrt(2.0));
      const auto step = static_cast<double>(k);
      distance = std::max({distance, expected - step / n, (step + 1) / n - expected});
    }
    CHECK(distance < 1.95 / std::sqrt(n));  // Kolmogorov-Smirnov, 0.1 %

    double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
    for (const double v : values) {
      m1 += v / n;
      m2 += v * v / n;
      m3 += v * v * v / n;
      m4 += v * v * v * v / n;
    }
    // Variances of the sample moments: (mu_2k - mu_k^2) / n with mu_2, 4, 6, 8 = 1, 3, 15, 105.
    CHECK(std::abs(m1) < 4 * std::sqrt(1 / n));
    CHECK(std::abs(m2 - 1) < 4 * std::sqrt(2 / n));
    CHECK(std::abs(m3) < 4 * std::sqrt(15 / n));
    CHECK(std::abs(m4 - 3) < 4 * std::sqrt(96 / n));
  }

  TEST_CASE("normal() reaches the tails as often as it should") {
    Random random(8);
    const int count = 100000;
    int beyond_two = 0, beyond_three = 0;
    for (int k = 0; k < count; ++k) {
      const double v = std::abs(random.normal());
      beyond_two += v > 2 ? 1 : 0;
      beyond_three += v > 3 ? 1 : 0;
    }
    const auto expected = [](double z) { return count * std::erfc(z / std::sqrt(2.0)); };
    CHECK(std::abs(beyond_two - expected(2)) < 4 * std::sqrt(expected(2)));    // 4550 +- 270
    CHECK(std::abs(beyond_three - expected(3)) < 4 * std::sqrt(expected(3)));  // 270 +- 66
  }

  TEST_CASE("shuffle gives every order equally often and loses nothing") {
    Random random(9);
    std::map<std::vector<int>, int> orders;
    const int count = 6000;
    for (int k = 0; k < count; ++k) {
      std::vector<int> items = {0, 1, 2};
      random.shuffle(items);
      ++orders[items];
    }
    REQUIRE(orders.size() == 6);
    double chi_squared = 0;
    for (const auto& [order, n] : orders) {
      CHECK(std::is_permutation(order.begin(), order.end(), std::array{0, 1, 2}.begin()));
      chi_squared += (n - count / 6.0) * (n - count / 6.0) / (count / 6.0);
    }
    // 5 degrees of freedom, 0.1 %. Swapping every item with any other (a known mistake) has the
    // odds 4:5 of 27 and gives (1/9)^2 * 6000 = 74.
    CHECK(chi_squared < 20.52);
  }
}

}  // namespace random_test
