// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/invariants.hpp>

namespace voussoir::detail {

/// A vector whose index is an int, as the numbers of bodies are.
template <class T>
class ByIndex {
 public:
  ByIndex() = default;
  explicit ByIndex(int size, T value = T()) : values_(static_cast<std::size_t>(size), value) {}
  T& operator[](int i) {
    VOUSSOIR_ASSERT(is_index(i, values_.size()), "an index is below the size");
    return values_[static_cast<std::size_t>(i)];
  }
  const T& operator[](int i) const {
    VOUSSOIR_ASSERT(is_index(i, values_.size()), "an index is below the size");
    return values_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] int size() const { return static_cast<int>(values_.size()); }
  void push_back(T value) { values_.push_back(value); }
  std::vector<T>& all() { return values_; }
  [[nodiscard]] const std::vector<T>& all() const { return values_; }

 private:
  std::vector<T> values_;
};

/// Which bodies are coupled: the neighbours of body i are next[k], begin[i] <= k < begin[i + 1].
struct BodyGraph {
  ByIndex<int> begin, next;
  ByIndex<int> pair;  ///< that couples them, of those given; ~pair where the body is its column

  BodyGraph() = default;
  BodyGraph(int size, const std::vector<std::pair<int, int>>& pairs) : begin(size + 1) {
    for (const auto& [i, j] : pairs) {
      ++begin[i + 1];
      ++begin[j + 1];
    }
    for (int i = 0; i < size; ++i) begin[i + 1] += begin[i];
    next = pair = ByIndex<int>(begin[size]);
    ByIndex<int> end = begin;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto& [i, j] = pairs[k];
      VOUSSOIR_ASSERT(i != j, "a body is not coupled to itself");
      pair[end[i]] = static_cast<int>(k);
      next[end[i]++] = j;
      pair[end[j]] = ~static_cast<int>(k);
      next[end[j]++] = i;
    }
    VOUSSOIR_ASSERT(next.all().size() == 2 * pairs.size(), "a coupling is in two lists");
  }
  [[nodiscard]] int size() const { return begin.size() - 1; }
};

}  // namespace voussoir::detail
