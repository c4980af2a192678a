// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/statistics/rank_correlation.hpp>

#include "support/near.hpp"

namespace rank_correlation_test {

using namespace voussoir;
using voussoir_test::near;
using Values = std::vector<double>;

TEST_SUITE("statistics/rank_correlation") {
  TEST_CASE("equal values share the mean of their places, and infinity is the last") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK(ranks_of(Values{3, 1, 2}) == Values{3, 1, 2});
    CHECK(ranks_of(Values{7, 5, 7, 5, 7}) == Values{4, 1.5, 4, 1.5, 4});
    CHECK(ranks_of(Values{infinity, 1, infinity, -infinity}) == Values{3.5, 2, 3.5, 1});
    CHECK(ranks_of(Values{}).empty());
  }

  TEST_CASE("Spearman's correlation of worked examples") {
    // Ten pupils, hours of television and intelligence quotient: 1 - 6 x 194 / (10 x 99) = -29/165.
    const Values quotient{106, 100, 86, 101, 99, 103, 97, 113, 112, 110},
        hours{7, 27, 2, 50, 28, 29, 20, 12, 6, 17};
    CHECK(rank_correlation(quotient, hours) == near(-29.0 / 165).epsilon(1e-14));
    // Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: 4.5 / sqrt(4.5 x 5).
    CHECK(rank_correlation(Values{1, 2, 2, 3}, Values{1, 2, 3, 4}) ==
          near(std::sqrt(0.9)).epsilon(1e-14));
    CHECK(rank_correlation(Values{1, 2, 3}, Values{-1, -8, -27}) == -1);
    CHECK(std::isnan(rank_correlation(Values{1, 1, 1}, Values{1, 2, 3})));
    CHECK_THROWS_AS((void)rank_correlation(Values{1, 2}, Values{1, 2, 3}), InvalidInput);
    CHECK_THROWS_AS((void)rank_correlation(Values{1}, Values{1}), InvalidInput);
  }

  TEST_CASE("one in twenty orders without a connection exceeds the limit") {
    // All 40320 orders of eight. The correlation goes in steps; 0.738 is the tabled 5 % value
    // (Zar 1972), and the approximation lies one step below.
    Values x(8), y(8);
    std::iota(x.begin(), x.end(), 1);
    y = x;
    const double limit = rank_correlation_limit(8);
    int beyond = 0, orders = 0, beyond_tabled = 0;
    do {
      const double r = std::abs(rank_correlation(x, y));
      beyond += r > limit;
      beyond_tabled += r > 0.738;
      ++orders;
    } while (std::next_permutation(y.begin(), y.end()));
    CHECK(orders == 40320);
    CHECK(static_cast<double>(beyond_tabled) / orders < 0.05);
    CHECK(static_cast<double>(beyond) / orders == near(0.05).epsilon(0.2));
  }

  TEST_CASE("the limit is that of the tables where there are many values") {
    // Zar (1972), two-sided 5 %: 0.447 for n = 20, 0.362 for 30, 0.279 for 50, 0.197 for 100.
    CHECK(rank_correlation_limit(20) == near(0.447).epsilon(0.01));
    CHECK(rank_correlation_limit(30) == near(0.362).epsilon(0.005));
    CHECK(rank_correlation_limit(50) == near(0.279).epsilon(0.003));
    CHECK(rank_correlation_limit(100) == near(0.197).epsilon(0.003));
    CHECK_THROWS_AS((void)rank_correlation_limit(2), InvalidInput);
  }

  TEST_CASE("ranks that are a sum of others are explained, and those of chance are not") {
    Random random(4);
    const auto drawn = [&](std::size_t n) {
      Values values(n);
      for (double& value : values) value = random.uniform();
      return values;
    };
    const std::vector<Values> x{drawn(40), drawn(40), drawn(40)};
    Values cubes(40), sum(40);
    for (std::size_t k = 0; k < 40; ++k) cubes[k] = std::pow(x[1][k], 3);
    CHECK(rank_variance_explained(x, cubes) == near(1).epsilon(1e-12));
    // Of one quantity: 1 - (1 - r^2) (n - 1) / (n - 2).
    const Values noise = drawn(40);
    const double r = rank_correlation(x[0], noise);
    CHECK(rank_variance_explained(std::vector<Values>{x[0]}, noise) ==
          near(1 - (1 - r * r) * 39 / 38).epsilon(1e-10));
    // On average nothing, corrected for chance; without the correction it would be 3/39 = 0.077.
    // R^2 of chance has a deviation of sqrt(2 p (n-p-1) / ((n-1)^2 (n+1))) = 0.059, of the mean of
    // 400 it is 0.003; within four of these.
    double mean = 0;
    for (int k = 0; k < 400; ++k) mean += rank_variance_explained(x, drawn(40)) / 400;
    CHECK(std::abs(mean) < 0.013);
    CHECK(std::isnan(rank_variance_explained(x, Values(40, 1.0))));
    CHECK(std::isnan(rank_variance_explained(std::vector<Values>{{1, 2}}, Values{1, 2})));
    CHECK(rank_variance_explained(std::vector<Values>{}, noise) == 0);
  }
}

}  // namespace rank_correlation_test
