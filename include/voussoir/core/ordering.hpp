// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/invariants.hpp>

namespace voussoir {

// What is to be put in order is told by numbers alone: `std::sort` of every other type is code that
// whoever includes a header compiles.

/// The order of pairs by their first number, then by their second; equal ones stay as they are.
/// Counted, not compared.
///
/// @param limit  every number is at least 0 and less than this
/// @return  indices into `pairs`
/// @cost    O(pairs + limit)
[[nodiscard]] VOUSSOIR_INLINE std::vector<int> order_of_pairs(
    const std::vector<std::pair<int, int>>& pairs, int limit);

/// The order of values from the least to the largest; equal ones stay as they are.
/// @return  indices into `values`
/// @pre     none is a NaN
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::size_t> order_of_values(
    const std::vector<double>& values);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<int> order_of_pairs(const std::vector<std::pair<int, int>>& pairs,
                                                int limit) {
  // From the lesser number to the greater, each pass keeping the order of the one before.
  std::vector<int> order(pairs.size()), before(pairs.size()), start;
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  for (const bool by_first : {false, true}) {
    const auto number = [&](int k) {
      const auto& pair = pairs[static_cast<std::size_t>(k)];
      VOUSSOIR_ASSERT(detail::is_index(pair.first, limit) && detail::is_index(pair.second, limit),
                      "numbers to be put in order are below their limit");
      return static_cast<std::size_t>(by_first ? pair.first : pair.second);
    };
    start.assign(static_cast<std::size_t>(limit) + 1, 0);
    before.swap(order);
    for (const int k : before) ++start[number(k) + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    for (const int k : before) order[static_cast<std::size_t>(start[number(k)]++)] = k;
  }
  VOUSSOIR_ASSERT(detail::is_permutation(order), "an order has every place once");
  return order;
}

VOUSSOIR_INLINE std::vector<std::size_t> order_of_values(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return values[x] != values[y] ? values[x] < values[y] : x < y;
  });
  return order;
}

#endif

}  // namespace voussoir
