// SPDX-License-Identifier: MIT
// Orders against the standard library's stable sort.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/random.hpp>

namespace ordering_test {

using namespace voussoir;

namespace {

template <class Index, class Value>
std::vector<Index> stably_sorted(const std::vector<Value>& values) {
  std::vector<Index> order(values.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index x, Index y) {
    return values[static_cast<std::size_t>(x)] < values[static_cast<std::size_t>(y)];
  });
  return order;
}

}  // namespace

TEST_SUITE("core/ordering") {
  TEST_CASE("pairs by their first number, then their second, equal ones as they were") {
    Random random(1);
    for (int k = 0; k < 200; ++k) {
      // Few numbers for many pairs, and many for few.
      const int limit = 1 + static_cast<int>(random.uniform() * (k % 2 == 0 ? 5 : 500));
      std::vector<std::pair<int, int>> pairs(static_cast<std::size_t>(random.uniform() * 60));
      for (auto& pair : pairs) {
        pair.first = static_cast<int>(random.uniform() * limit);
        pair.second = static_cast<int>(random.uniform() * limit);
      }
      CHECK(order_of_pairs(pairs, limit) == stably_sorted<int>(pairs));
    }
    CHECK(order_of_pairs({}, 0).empty());
  }

  TEST_CASE("values from the least to the largest, equal ones as they were") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Random random(2);
    for (int k = 0; k < 200; ++k) {
      std::vector<double> values(static_cast<std::size_t>(random.uniform() * 60));
      for (double& value : values) {
        value = random.uniform() - 0.5;
        if (k % 2 == 0) value = std::floor(4 * value);
      }
      if (k % 5 == 0) values.insert(values.end(), {infinity, 0.0, -0.0, -infinity});
      CHECK(order_of_values(values) == stably_sorted<std::size_t>(values));
    }
    CHECK(order_of_values({}).empty());
  }
}

}  // namespace ordering_test
