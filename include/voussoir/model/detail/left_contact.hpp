// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace voussoir::detail {

/// A contact that was, of bodies of several parts: taken up again or dropped.
struct LeftContact {
  std::pair<int, int> bodies;  ///< the lower first
  std::size_t kind;            ///< of the group
  std::int32_t contact;        ///< -1: taken up
  double held;                 ///< energy of its springs [J]
  [[nodiscard]] bool operator<(const LeftContact& other) const {
    return std::tie(bodies, contact) < std::tie(other.bodies, other.contact);
  }
};

/// Energy of the springs of all contacts that two bodies had [J].
/// @param left  in order
[[nodiscard]] inline double energy_left(const std::vector<LeftContact>& left,
                                        const std::pair<int, int>& bodies) {
  auto it = std::lower_bound(left.begin(), left.end(), bodies,
                             [](const auto& x, const auto& value) { return x.bodies < value; });
  double sum = 0;
  for (; it != left.end() && it->bodies == bodies; ++it) sum += it->held;
  return sum;
}

}  // namespace voussoir::detail
