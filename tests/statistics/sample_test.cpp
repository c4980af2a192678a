// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>
#include <voussoir/statistics/histogram.hpp>
#include <voussoir/statistics/sample.hpp>

#include "support/reference.hpp"

namespace sample_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::relative;

namespace {

/// 12 digits are printed.
constexpr double printed = 6e-12;
const std::vector<double> ten{0.021, 0.034, 0.028, 0.041, 0.019, 0.033, 0.030, 0.025, 0.037, 0.032};

}  // namespace

TEST_SUITE("statistics/sample") {
  TEST_CASE("mean and the two standard deviations of ten values") {
    const Sample s(ten);
    CHECK(relative(s.mean(), reference("G.x.mean")) <= printed);
    CHECK(relative(s.deviation(), reference("G.x.sd_unbiased")) <= printed);
    CHECK(relative(s.population_deviation(), reference("G.x.sd_ml")) <= printed);
    CHECK(s.smallest() == 0.019);
    CHECK(s.largest() == 0.041);
    CHECK(s.median() == 0.5 * (0.030 + 0.032));
    CHECK(Sample({3, 1, 2}).median() == 2);
    // 0, 0, 1: mean 1/3, variance 2/9; third moment (2 (-1/27) + 8/27) / 3 = 2/27; over (2/9)^1.5
    CHECK(relative(Sample({0, 0, 1}).skewness(), 2.0 / 27 / std::pow(2.0 / 9, 1.5)) <= 1e-14);
    CHECK(Sample({5, 5}).skewness() == 0);
  }

  TEST_CASE("a large mean costs no digits of the deviation") {
    std::vector<double> far;
    for (const double x : ten) far.push_back(1e6 + x);
    // The values themselves are rounded to 1e-10 of the deviation's 7e-3: 2e-8.
    CHECK(relative(Sample(far).deviation(), reference("G.x.sd_unbiased")) <= 2e-8);
  }

  TEST_CASE("the paper's three samples as one") {
    const SampleSummary all = merged({{21, 0.030, 0.008}, {21, 0.032, 0.012}, {21, 0.028, 0.007}});
    CHECK(relative(all.mean, reference("G.merged.mean")) <= printed);
    CHECK(relative(all.deviation, reference("G.merged.sd_pop")) <= printed);
    // With sds from n - 1: population form of each, and n - 1 of the whole again.
    const double less = std::sqrt(20.0 / 21);
    const SampleSummary n21 =
        merged({{21, 0.030, 0.008 * less}, {21, 0.032, 0.012 * less}, {21, 0.028, 0.007 * less}});
    CHECK(relative(n21.deviation * std::sqrt(63.0 / 62), reference("G.merged.sd_n21")) <= printed);
  }

  TEST_CASE("merging summaries is merging the data") {
    const std::vector<double> first(ten.begin(), ten.begin() + 3), rest(ten.begin() + 3, ten.end());
    const Sample a(first), b(rest), all(ten);
    const SampleSummary m =
        merged({{3, a.mean(), a.population_deviation()}, {7, b.mean(), b.population_deviation()}});
    CHECK(relative(m.mean, all.mean()) <= 1e-14);
    CHECK(relative(m.deviation, all.population_deviation()) <= 1e-13);
    CHECK(m.size == 10);
  }

  TEST_CASE("histogram: every value in one class, the last class closed, densities sum to one") {
    const Histogram h(Sample(ten), 0.0145, 0.0445, 3);
    CHECK(h.counts() == std::vector<std::size_t>{2, 6, 2});
    CHECK(relative(h.middle(1), 0.0295) <= 1e-14);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += h.density(k) * h.width();
    CHECK(relative(sum, 1) <= 1e-14);
    CHECK(Histogram(Sample({0, 1, 2}), 0, 2, 2).counts() == std::vector<std::size_t>{1, 2});
    const Histogram own = Histogram::of(Sample(ten));
    std::size_t all = 0;
    for (const std::size_t n : own.counts()) all += n;
    CHECK(all == 10);
    // 3.49 s / 10^(1/3) = 0.01120 in a range of 0.022
    CHECK(own.counts().size() == 2);
  }

  TEST_CASE("data that say nothing are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Sample({}), InvalidInput);
    CHECK_THROWS_WITH_AS(Sample({1, 2, nan}), doctest::Contains("value 2"), InvalidInput);
    CHECK_THROWS_AS(Sample({1}).deviation(), InvalidInput);
    CHECK_THROWS_AS(merged({}), InvalidInput);
    CHECK_THROWS_AS(merged({{0, 1, 1}}), InvalidInput);
    CHECK_THROWS_AS(merged({{2, nan, 1}}), InvalidInput);
    CHECK_THROWS_AS(merged({{2, 1, -1}}), InvalidInput);
    const Sample s(ten);
    CHECK_THROWS_AS(Histogram(s, 0.02, 0.05, 3), InvalidInput);  // 0.019 would be lost
    CHECK_THROWS_AS(Histogram(s, 0.01, 0.04, 3), InvalidInput);  // 0.041
    CHECK_THROWS_AS(Histogram(s, 0.05, 0.01, 3), InvalidInput);
    CHECK_THROWS_AS(Histogram(s, 0.01, 0.05, 0), InvalidInput);
    CHECK_THROWS_AS(Histogram::of(Sample({1, 1})), InvalidInput);
  }
}

}  // namespace sample_test
