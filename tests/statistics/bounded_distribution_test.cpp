// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/statistics/bounded_distribution.hpp>

#include "support/near.hpp"

namespace bounded_distribution_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

/// Mean and standard deviation, by the midpoints of so many equal parts of probability.
struct Moments {
  double mean = 0, deviation = 0;
};
Moments moments_of(const BoundedDistribution& d, int parts) {
  double sum = 0, squares = 0;
  for (int k = 0; k < parts; ++k) sum += d.quantile((k + 0.5) / parts) / parts;
  for (int k = 0; k < parts; ++k)
    squares += std::pow(d.quantile((k + 0.5) / parts) - sum, 2) / parts;
  return {sum, std::sqrt(squares)};
}

const std::vector<BoundedDistribution> one_of_each{
    BoundedDistribution::normal(35, 3),
    BoundedDistribution::normal(35, 3, 31, 40),
    BoundedDistribution::normal(35, 3, 35),  // all on one side of the mean
    BoundedDistribution::normal(-2, 0.1, {}, -1.9),
    BoundedDistribution::lognormal(5, 1),
    BoundedDistribution::lognormal(5, 4, 0, 9),
    BoundedDistribution::uniform(-1, 3),
    BoundedDistribution::triangular(0, 1, 3),
    BoundedDistribution::triangular(0, 0, 3),
    BoundedDistribution::triangular(0, 3, 3)};

}  // namespace

TEST_SUITE("statistics/bounded_distribution") {
  TEST_CASE("quantiles of normal and lognormal values, cut off, are those of another program") {
    // Python's statistics.NormalDist: inv_cdf(F(low) + p (F(high) - F(low))). It has 15 digits of a
    // standard normal value.
    constexpr double digits = 1e-13;
    const auto whole = BoundedDistribution::normal(0, 1);
    CHECK(whole.quantile(0.025) == near(-1.9594494413593255).epsilon(digits));
    CHECK(whole.quantile(0.975) == near(1.9594494413593255).epsilon(digits));
    CHECK(whole.quantile(0.999) == near(3.0809784513973284).epsilon(digits));
    CHECK(std::abs(whole.median()) <= digits);
    const auto cut = BoundedDistribution::normal(35, 3, 31, 40);
    CHECK(cut.quantile(0.1) == near(32.22301667334149).epsilon(digits));
    CHECK(cut.quantile(0.5) == near(35.163340628082736).epsilon(digits));
    CHECK(cut.quantile(0.9) == near(38.32456568179226).epsilon(digits));
    const auto logs = BoundedDistribution::lognormal(5, 1);
    CHECK(logs.quantile(0.05) == near(3.5400181196163114).epsilon(digits));
    CHECK(logs.quantile(0.5) == near(4.9029033784546).epsilon(digits));
    CHECK(logs.quantile(0.95) == near(6.790491100951475).epsilon(digits));
  }

  TEST_CASE("half a normal distribution has its median at 0.674490 standard deviations") {
    // The upper quartile of the normal distribution, in every table; the far end cuts off 3e-5.
    CHECK(BoundedDistribution::normal(10, 2, 10, 30).median() ==
          near(10 + 2 * 0.674489750196).epsilon(1e-12));
  }

  TEST_CASE("the triangular distribution has its closed forms") {
    const auto d = BoundedDistribution::triangular(0, 1, 3);
    CHECK(d.probability_below(1) == near(1.0 / 3).epsilon(1e-15));
    CHECK(d.median() == near(3 - std::sqrt(3.0)).epsilon(1e-15));
    CHECK(d.quantile(1.0 / 12) == near(0.5).epsilon(1e-15));
    // mean (a + m + b) / 3, variance (a^2 + m^2 + b^2 - a m - a b - m b) / 18
    const Moments m = moments_of(d, 20000);
    CHECK(m.mean == near(4.0 / 3).epsilon(1e-6));
    CHECK(m.deviation == near(std::sqrt(7.0 / 18)).epsilon(1e-4));
  }

  TEST_CASE("mean and deviation come out as they went in where little is cut off") {
    // Beyond 8 standard deviations lies 1e-15; what is left is the error of the midpoint rule in
    // the tails.
    for (const auto& d : {BoundedDistribution::normal(35, 3, 11, 59),
                          BoundedDistribution::lognormal(35, 3, 5, 100)}) {
      const Moments m = moments_of(d, 100000);
      CHECK(m.mean == near(35).epsilon(1e-6));
      CHECK(m.deviation == near(3).epsilon(2e-4));
    }
    const Moments uniform = moments_of(BoundedDistribution::uniform(-1, 3), 10000);
    CHECK(uniform.mean == near(1).epsilon(1e-12));
    CHECK(uniform.deviation == near(4 / std::sqrt(12.0)).epsilon(1e-7));
  }

  TEST_CASE("a probability comes back through its value, and the ends are never passed") {
    for (std::size_t k = 0; k < one_of_each.size(); ++k) {
      CAPTURE(k);
      const BoundedDistribution& d = one_of_each[k];
      CHECK(d.quantile(0) == d.low());
      CHECK(d.quantile(1) == d.high());
      CHECK(d.probability_below(d.low() - 1) == 0);
      CHECK(d.probability_below(d.high() + 1) == 1);
      double before = d.low();
      for (const double p : {1e-9, 1e-3, 0.1, 0.31, 0.5, 0.77, 0.99, 1 - 1e-9}) {
        CAPTURE(p);
        const double x = d.quantile(p);
        // Digits of x over its range, and of 1 - p.
        CHECK(std::abs(d.probability_below(x) - p) <= 1e-13);
        CHECK(x >= before);
        CHECK(x <= d.high());
        before = x;
      }
    }
  }

  TEST_CASE("without ends it is cut off four standard deviations away") {
    const auto d = BoundedDistribution::normal(35, 3);
    CHECK(d.low() == 23);
    CHECK(d.high() == 47);
    const auto logs = BoundedDistribution::lognormal(5, 1);
    const double spread = std::sqrt(std::log(1.04));
    CHECK(std::log(logs.high() / logs.low()) == near(8 * spread).epsilon(1e-14));
    CHECK(std::sqrt(logs.high() * logs.low()) == near(5 / std::sqrt(1.04)).epsilon(1e-14));
  }

  TEST_CASE("what is no distribution is refused by name") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS((void)BoundedDistribution::normal(35, 0),
                         "standard deviation = 0: must be > 0", InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::normal(35, nan), InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::normal(35, 3, 36), InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::normal(35, 3, 40, 30), InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::lognormal(-1, 3), InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::lognormal(1, 3, -1), InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::uniform(3, 3), InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::uniform(nan, 3), InvalidInput);
    CHECK_THROWS_AS((void)BoundedDistribution::triangular(0, 4, 3), InvalidInput);
    CHECK_THROWS_AS((void)one_of_each[0].quantile(1.5), InvalidInput);
    CHECK_THROWS_AS((void)one_of_each[0].quantile(nan), InvalidInput);
  }
}

}  // namespace bounded_distribution_test
