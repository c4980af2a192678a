// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/detail/graph_separator.hpp>
#include <voussoir/linear/detail/quotient_graph.hpp>

namespace voussoir::detail {

/// Separates a graph again and again, and orders the parts that remain.
class Dissection {
 public:
  explicit Dissection(const BodyGraph& graph);

  /// The body that is eliminated k-th. Call once. @throws Stopped
  [[nodiscard]] std::vector<int> order(StopCheck& stop);

 private:
  // Minimum degree is tried on parts of up to `large` bodies and kept where it is cheap, which it
  // is in 2-D, or where a part is `small`.
  static constexpr int large = 1000, small = 200;
  static constexpr double few_operations = 200;  ///< on blocks, per body and pair

  [[nodiscard]] bool order_by_degree(int first, int last, StopCheck& stop);
  [[nodiscard]] WeightedGraph part(int first, int last);
  [[nodiscard]] int& at(int k) { return order_[static_cast<std::size_t>(k)]; }

  const BodyGraph& graph_;
  ByIndex<int> local_;      ///< number of a body in the part at hand; -1: not in it
  std::vector<int> order_;  ///< parts one after the other, each before what separates them
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE Dissection::Dissection(const BodyGraph& graph)
    : graph_(graph), local_(graph.size(), -1), order_(static_cast<std::size_t>(graph.size())) {
  for (int i = 0; i < graph.size(); ++i) at(i) = i;
}

VOUSSOIR_INLINE std::vector<int> Dissection::order(StopCheck& stop) {
  std::vector<std::pair<int, int>> parts{{0, graph_.size()}};
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    if (last - first <= large && order_by_degree(first, last, stop)) continue;
    const ByIndex<char> side = separate(part(first, last), stop);
    std::vector<int> members[3];
    for (int k = first; k < last; ++k)
      members[static_cast<unsigned char>(side[k - first])].push_back(at(k));
    auto to = order_.begin() + first;
    for (const auto& some : members) to = std::copy(some.begin(), some.end(), to);
    const int middle = first + static_cast<int>(members[0].size()),
              end = middle + static_cast<int>(members[1].size());
    VOUSSOIR_ASSERT(first <= middle && middle <= end && end <= last,
                    "the parts of a dissection are within what is dissected");
    if (middle > first && end > middle) {
      parts.emplace_back(first, middle);
      parts.emplace_back(middle, end);
    } else {  // each is coupled to nearly all: nothing to separate
      (void)order_by_degree(first, end, stop);
    }
  }
  return std::move(order_);
}

/// The couplings among the bodies of a part.
VOUSSOIR_INLINE WeightedGraph Dissection::part(int first, int last) {
  WeightedGraph some;
  some.total = last - first;
  int room = 0;
  for (int k = first; k < last; ++k) {
    local_[at(k)] = k - first;
    room += graph_.begin[at(k) + 1] - graph_.begin[at(k)];
  }
  some.begin = ByIndex<int>(some.total + 1);
  some.weight = ByIndex<int>(some.total, 1);
  some.next.all().reserve(static_cast<std::size_t>(room));
  for (int k = first; k < last; ++k) {
    for (int p = graph_.begin[at(k)]; p < graph_.begin[at(k) + 1]; ++p)
      if (const int other = local_[graph_.next[p]]; other >= 0) some.next.push_back(other);
    some.begin[k - first + 1] = some.next.size();
  }
  some.ties = ByIndex<int>(some.next.size(), 1);
  for (int k = first; k < last; ++k) local_[at(k)] = -1;
  return some;
}

/// Orders a part, which has neighbours around it that are eliminated later.
/// @return  false: another dissection may do better
VOUSSOIR_INLINE bool Dissection::order_by_degree(int first, int last, StopCheck& stop) {
  const int count = last - first;
  int size = count;
  std::vector<std::pair<int, int>> pairs;
  for (int k = 0; k < count; ++k) local_[at(first + k)] = k;
  std::vector<int> around;
  for (int k = 0; k < count; ++k) {
    const int body = at(first + k);
    for (int p = graph_.begin[body]; p < graph_.begin[body + 1]; ++p) {
      int& other = local_[graph_.next[p]];
      if (other < 0) {
        other = size++;
        around.push_back(graph_.next[p]);
      }
      if (other > k) pairs.emplace_back(k, other);
    }
  }
  for (int k = first; k < last; ++k) local_[at(k)] = -1;
  for (const int body : around) local_[body] = -1;
  QuotientGraph quotient(size, pairs, 0, count);
  const std::vector<int> inner = quotient.order(stop);
  const bool is_cheap =
      count <= small ||
      quotient.operations() <= few_operations * (count + static_cast<double>(pairs.size()));
  if (is_cheap || count > large) {
    const std::vector<int> members(order_.begin() + first, order_.begin() + last);
    for (int k = 0; k < count; ++k)
      at(first + k) = members[static_cast<std::size_t>(inner[static_cast<std::size_t>(k)])];
  }
  return is_cheap;
}

#endif

}  // namespace voussoir::detail
