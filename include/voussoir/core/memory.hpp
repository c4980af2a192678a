// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/bodies.hpp>
#if VOUSSOIR_BODIES
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>
#endif

namespace voussoir {

/// Memory that this process can still take without harm to the machine [bytes]: what Linux calls
/// available, or what is left of the limit of a container if that is less. Infinite where the
/// operating system does not say.
[[nodiscard]] VOUSSOIR_INLINE double available_memory();

#if VOUSSOIR_BODIES

namespace detail {

/// The first whole number in a file, after `key` at the start of a line if there is one; -1: none.
inline double number_in_file(const char* path, const char* key = "") {
  std::FILE* const file = std::fopen(path, "r");
  if (file == nullptr) return -1;
  double number = -1;
  char line[256];
  while (number < 0 && std::fgets(line, sizeof line, file) != nullptr) {
    const std::size_t length = std::strlen(key);
    if (std::strncmp(line, key, length) == 0 && std::sscanf(line + length, "%lf", &number) != 1)
      number = -1;
  }
  std::fclose(file);
  return number;
}

}  // namespace detail

VOUSSOIR_INLINE double available_memory() {
  double most = std::numeric_limits<double>::infinity();
  if (const double kib = detail::number_in_file("/proc/meminfo", "MemAvailable:"); kib >= 0)
    most = std::min(most, 1024 * kib);
  const double limit = detail::number_in_file("/sys/fs/cgroup/memory.max");
  const double taken = detail::number_in_file("/sys/fs/cgroup/memory.current");
  if (limit >= 0 && taken >= 0) most = std::min(most, std::max(limit - taken, 0.0));
  return most;
}

#endif

}  // namespace voussoir
