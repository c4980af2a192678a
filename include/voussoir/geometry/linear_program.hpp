// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/small_algebra.hpp>

namespace voussoir {

/// normal . x <= offset, in N unknowns.
template <int N>
struct LinearConstraint {
  Fixed<N, 1> normal;
  double offset;
};

/// Maximises objective . x under linear constraints, in few unknowns.
///
/// @param constraints  should include bounds that keep the solution finite
/// @return  a maximiser, or nothing if the constraints contradict each other
/// @cost    O(N! n) expected for n constraints in random order; n is about 6 for a block face list
///
/// Source: Seidel (1991), Small-dimensional linear programming and convex hulls made easy.
/// Constraints are added one by one; one that the optimum so far violates must be active in the
/// new optimum, so one unknown is eliminated through it and the smaller problem solved.
template <int N>
[[nodiscard]] std::optional<Fixed<N, 1>> maximise(
    const Fixed<N, 1>& objective, const std::vector<LinearConstraint<N>>& constraints,
    double bound) {
  using Point = Fixed<N, 1>;
  VOUSSOIR_ASSERT(bound > 0, "the box that is searched has a size");
  if constexpr (N == 1) {
    double low = -bound, high = bound;
    for (const auto& [normal, offset] : constraints) {
      if (normal[0] > 0) {
        high = std::fmin(high, offset / normal[0]);
      } else if (normal[0] < 0) {
        low = std::fmax(low, offset / normal[0]);
      } else if (offset < -1e-12 * bound) {
        return std::nullopt;
      }
    }
    if (low > high + 1e-12 * bound) return std::nullopt;
    return Point(objective[0] >= 0 ? high : low);
  } else {
    Point best;
    for (int k = 0; k < N; ++k) best[k] = objective[k] >= 0 ? bound : -bound;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const Point& a = constraints[i].normal;
      const double b = constraints[i].offset;
      if (a.dot(best) <= b + 1e-14 * bound) continue;
      int pivot = 0;
      for (int k = 1; k < N; ++k)
        if (std::abs(a[k]) > std::abs(a[pivot])) pivot = k;
      if (!(std::abs(a[pivot]) > 0)) return std::nullopt;
      // x[pivot] = b / a[pivot] - sum of the others * ratio
      const auto drop = [pivot](const Point& full) {
        Fixed<N - 1, 1> rest;
        for (int k = 0, to = 0; k < N; ++k)
          if (k != pivot) rest[to++] = full[k];
        return rest;
      };
      const Fixed<N - 1, 1> ratio = drop(a) / a[pivot];
      const double shift = b / a[pivot];
      std::vector<LinearConstraint<N - 1>> smaller;
      smaller.reserve(i + 2);
      smaller.push_back({-ratio, bound - shift});
      smaller.push_back({ratio, bound + shift});
      for (std::size_t j = 0; j < i; ++j) {
        const Point& c = constraints[j].normal;
        smaller.push_back({drop(c) - c[pivot] * ratio, constraints[j].offset - c[pivot] * shift});
      }
      const auto reduced =
          maximise<N - 1>(drop(objective) - objective[pivot] * ratio, smaller, bound);
      if (!reduced) return std::nullopt;
      for (int k = 0, from = 0; k < N; ++k)
        if (k != pivot) best[k] = (*reduced)[from++];
      best[pivot] = shift - ratio.dot(*reduced);
    }
    return best;
  }
}

}  // namespace voussoir
