// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/place_order.hpp>
#include <voussoir/rockmass/detail/segment_grid.hpp>
#include <voussoir/rockmass/mapped_trace.hpp>

namespace voussoir::detail {

#if VOUSSOIR_BODIES

[[nodiscard]] inline double length_of_trace(const std::vector<Vec2>& points) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += length_of(points[k] - points[k - 1]);
  return length;
}

/// Drawn from that of its ends which comes first in `order`; one that is closed, from that of its
/// points, towards that of the two beside it.
VOUSSOIR_INLINE void direct(std::vector<Vec2>& points, const PlaceOrder& order) {
  const auto reverse_if = [&](bool is_backwards) {
    if (is_backwards) std::reverse(points.begin(), points.end());
  };
  if (place_of(points.front()) != place_of(points.back()))
    return reverse_if(order(points.back()) < order(points.front()));
  points.pop_back();
  const auto first =
      std::min_element(points.begin(), points.end(),
                       [&](const Vec2& a, const Vec2& b) { return order(a) < order(b); });
  std::rotate(points.begin(), first, points.end());
  points.push_back(points.front());
  reverse_if(order(points[points.size() - 2]) < order(points[1]));
}

/// Leaves out points that lie within `tolerance` of the line without them.
/// Source: Douglas & Peucker (1973), The Canadian Cartographer 10(2), 112-122.
VOUSSOIR_INLINE void simplify(std::vector<Vec2>& points, double tolerance) {
  std::vector<char> is_kept(points.size(), 0);
  is_kept.front() = is_kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double largest = tolerance;
    std::size_t at = from;
    for (std::size_t k = from + 1; k < to; ++k) {
      const double away = length_of(points[k] - nearest_on({points[from], points[to]}, points[k]));
      // Of two as far away the first along the trace, beyond roundings.
      if (away > largest * (1 + 1e-9)) {
        largest = away;
        at = k;
      }
    }
    if (at == from) continue;
    is_kept[at] = 1;
    open.emplace_back(from, at);
    open.emplace_back(at, to);
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (is_kept[k]) points[kept++] = points[k];
  points.resize(kept);
}

/// Joins traces of one set that touch end to end where they go on in nearly the same direction.
class ChainOfTraces {
 public:
  /// @param straight  a point so close to a line is on it [m]
  ChainOfTraces(std::vector<MappedTrace>& traces, double straight)
      : traces_(traces), straight_(straight) {}

  [[nodiscard]] std::vector<MappedTrace> joined() {
    pair_ends();
    std::vector<MappedTrace> chains;
    std::vector<char> is_used(traces_.size(), 0);
    // From ends that are free; what then is left are closed chains.
    for (const bool from_free_ends : {true, false})
      for (std::size_t t = 0; t < traces_.size(); ++t)
        for (std::size_t side = 0; side < 2; ++side) {
          if (is_used[t] || (from_free_ends && next_[2 * t + side] != none)) continue;
          chains.push_back(chain_from(2 * t + side, is_used));
        }
    return chains;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static constexpr double least_cosine = 0.866;  ///< of the turn: 30 degrees

  [[nodiscard]] const Vec2& end(std::size_t e) const {
    const auto& points = traces_[e / 2].points;
    return e % 2 == 0 ? points.front() : points.back();
  }
  /// Out of the trace.
  [[nodiscard]] Vec2 direction(std::size_t e) const {
    const auto& points = traces_[e / 2].points;
    return e % 2 == 0 ? normalized(Vec2(points[0] - points[1]))
                      : normalized(Vec2(points.back() - points[points.size() - 2]));
  }

  /// At every place the two ends that are straightest on, then the next two.
  void pair_ends() {
    next_.assign(2 * traces_.size(), none);
    std::map<std::tuple<int, Place>, std::vector<std::size_t>> at;
    for (std::size_t e = 0; e < next_.size(); ++e)
      at[{traces_[e / 2].set, place_of(end(e))}].push_back(e);
    for (const auto& [key, ends] : at) {
      std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
      for (std::size_t i = 0; i < ends.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const double cosine = -dot_product(direction(ends[i]), direction(ends[j]));
          if (cosine > least_cosine && ends[i] / 2 != ends[j] / 2)
            pairs.emplace_back(-cosine, ends[j], ends[i]);
        }
      std::sort(pairs.begin(), pairs.end());
      for (const auto& [cosine, a, b] : pairs)
        if (next_[a] == none && next_[b] == none) {
          next_[a] = b;
          next_[b] = a;
        }
    }
  }

  [[nodiscard]] MappedTrace chain_from(std::size_t entry, std::vector<char>& is_used) const {
    MappedTrace chain{{}, traces_[entry / 2].set};
    std::vector<char> is_joined;  // of every point: whether two traces touch there
    while (entry != none && !is_used[entry / 2]) {
      is_used[entry / 2] = 1;
      std::vector<Vec2> points = traces_[entry / 2].points;
      if (entry % 2 == 1) std::reverse(points.begin(), points.end());
      if (!is_joined.empty()) is_joined.back() = 1;
      for (std::size_t k = chain.points.empty() ? 0 : 1; k < points.size(); ++k) {
        chain.points.push_back(points[k]);
        is_joined.push_back(0);
      }
      entry = next_[entry ^ 1];
    }
    leave_out_straight(chain.points, is_joined);
    return chain;
  }

  /// A trace that was split is as it was before: of points between two traces those on the line
  /// through the points around them go, before `simplify` chooses among what is left.
  void leave_out_straight(std::vector<Vec2>& points, const std::vector<char>& is_joined) const {
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < points.size();) {
      std::size_t end = k;  // of the points between two traces that follow one another
      while (end < points.size() && is_joined[end]) ++end;
      const bool has_sides = end > k && !kept.empty() && end < points.size();
      const bool is_straight =
          has_sides &&
          std::all_of(
              points.begin() + static_cast<std::ptrdiff_t>(k),
              points.begin() + static_cast<std::ptrdiff_t>(end), [&](const Vec2& p) {
                return length_of(p - nearest_on({kept.back(), points[end]}, p)) <= straight_;
              });
      if (!is_straight)
        for (std::size_t i = k; i < end; ++i) kept.push_back(points[i]);
      if (end == k) kept.push_back(points[end++]);
      k = end;
    }
    points = std::move(kept);
  }

  std::vector<MappedTrace>& traces_;
  double straight_;
  std::vector<std::size_t> next_;  ///< of every end (two a trace) the one that goes on
};

#endif

}  // namespace voussoir::detail
