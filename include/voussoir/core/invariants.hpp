// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/small_algebra.hpp>

namespace voussoir::detail {

// What assertions ask: invariants that take more than a comparison. Nothing else uses them, so a
// release has none of their work.

/// Every number from 0 to size - 1, once.
[[nodiscard]] inline bool is_permutation(const std::vector<int>& order) {
  std::vector<char> seen(order.size(), 0);
  for (const int k : order) {
    if (k < 0 || static_cast<std::size_t>(k) >= order.size() || seen[static_cast<std::size_t>(k)])
      return false;
    seen[static_cast<std::size_t>(k)] = 1;
  }
  return true;
}

/// No number is below the one before it; NaN is not.
template <class Numbers>
[[nodiscard]] bool never_descends(const Numbers& numbers) {
  for (std::size_t k = 1; k < numbers.size(); ++k)
    if (!(numbers[k - 1] <= numbers[k])) return false;
  return true;
}

/// 0 <= i < size.
[[nodiscard]] inline bool is_index(int i, std::size_t size) {
  return i >= 0 && static_cast<std::size_t>(i) < size;
}
[[nodiscard]] inline bool is_index(int i, int size) { return i >= 0 && i < size; }

/// Of length 1, to a billionth.
template <class Vector>
[[nodiscard]] bool is_unit(const Vector& v) {
  const double off = v.squaredNorm() - 1;
  return off < 2e-9 && off > -2e-9;
}

/// To a billionth of its largest entry.
template <int Size>
[[nodiscard]] bool is_symmetric(const Fixed<Size, Size>& block) {
  double largest = 0, off = 0;
  for (int r = 0; r < Size; ++r)
    for (int c = 0; c < Size; ++c) {
      const double entry = block(r, c) < 0 ? -block(r, c) : block(r, c);
      const double apart = block(r, c) - block(c, r);
      largest = entry > largest ? entry : largest;
      off = apart > off ? apart : off;
    }
  return off <= 1e-9 * largest;
}

/// Every entry > 0, and not infinite.
template <class Vector>
[[nodiscard]] bool is_positive(const Vector& v) {
  for (decltype(v.size()) k = 0; k < v.size(); ++k)
    if (!(v[k] > 0 && v[k] < 1e300)) return false;
  return true;
}

}  // namespace voussoir::detail
