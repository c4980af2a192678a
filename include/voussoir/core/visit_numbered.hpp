// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <variant>

namespace voussoir::detail {

/// Calls visit.operator()<number>(value) for the value that a variant holds. Where two of its types
/// are one the number tells them apart.
template <std::size_t Number = 0, class Variant, class Visit>
decltype(auto) visit_numbered(const Variant& values, Visit&& visit) {
  if constexpr (Number + 1 < std::variant_size_v<Variant>)
    if (values.index() != Number)
      return visit_numbered<Number + 1>(values, std::forward<Visit>(visit));
  return visit.template operator()<Number>(*std::get_if<Number>(&values));
}

}  // namespace voussoir::detail
