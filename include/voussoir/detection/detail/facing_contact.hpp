// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <voussoir/detection/contact.hpp>

namespace voussoir::detail {

/// Further than any face reaches above another: nothing of it is cut off for its height [m].
inline constexpr double any_height = 1e6;

/// `facing_contact` (see PairDetector) of a detector by separating axes.
///
/// What is known to be apart is looked at with `reach` first, which one axis settles as a rule. For
/// what touches that would be half of the cost again: it is clipped at once.
template <class Pair>
[[nodiscard]] auto facing_contact(Pair& pair, std::size_t a, std::size_t b,
                                  typename Pair::Memory& memory, double reach)
    -> decltype(pair.contact_near(a, b, memory, reach)) {
  if (memory.apart && !(pair.separation(a, b, memory, reach) <= reach)) return {};
  auto found = pair.contact_near(a, b, memory, any_height);
  if (found.separation <= reach) return found;
  memory.apart = true;  // by the axis that was found
  return {};
}

}  // namespace voussoir::detail
