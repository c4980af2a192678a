// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstring>
#include <system_error>

namespace voussoir_bench {

/// -1 for what is no whole number.
[[nodiscard]] inline int number_of(const char* word) {
  int number = -1;
  const char* const end = word + std::strlen(word);
  const auto [last, error] = std::from_chars(word, end, number);
  return error == std::errc() && last == end ? number : -1;
}

}  // namespace voussoir_bench
