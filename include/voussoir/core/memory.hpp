// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <voussoir/core/bodies.hpp>
#if VOUSSOIR_BODIES
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#endif

namespace voussoir {

/// Memory that this process can still take without harm to the machine [bytes]: what Linux calls
/// available, or what is left of the limit of a container (control groups, version 2) if that is
/// less. Infinite where the operating system does not say.
[[nodiscard]] VOUSSOIR_INLINE double available_memory();

/// Lets this process keep the memory that it frees, for what it takes next, instead of handing it
/// back to the operating system each time: a search takes and frees factors of some megabytes again
/// and again, and every page of a new one is a fault. Saves a fifth of the time of a stage in which
/// rock fails; the process then stays as large as it has ever been. Once, at the start of a
/// program; does nothing where the C library is another than GNU's.
VOUSSOIR_INLINE void keep_freed_memory();

namespace detail {

/// What is left of the limit of the control group in this folder [bytes]; infinite without a limit.
[[nodiscard]] VOUSSOIR_INLINE double left_of_container(const std::string& folder);

}  // namespace detail

#if VOUSSOIR_BODIES

namespace detail {

/// The first whole number in a file, after `key` at the start of a line if there is one; -1: none.
inline double number_in_file(const std::string& path, const char* key = "") {
  std::FILE* const file = std::fopen(path.c_str(), "r");
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

VOUSSOIR_INLINE double left_of_container(const std::string& folder) {
  const double limit = number_in_file(folder + "/memory.max"),
               taken = number_in_file(folder + "/memory.current");
  if (limit < 0 || taken < 0) return std::numeric_limits<double>::infinity();
  // Files that were read count as taken, but make room when memory is asked for.
  double files = 0;
  for (const char* kind : {"active_file ", "inactive_file "})
    files += std::max(number_in_file(folder + "/memory.stat", kind), 0.0);
  return std::max(limit - std::max(taken - files, 0.0), 0.0);
}

}  // namespace detail

VOUSSOIR_INLINE double available_memory() {
  double most = detail::left_of_container("/sys/fs/cgroup");
  if (const double kib = detail::number_in_file("/proc/meminfo", "MemAvailable:"); kib >= 0)
    most = std::min(most, 1024 * kib);
  return most;
}

VOUSSOIR_INLINE void keep_freed_memory() {
#ifdef __GLIBC__
  (void)mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest that is allowed
  (void)mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

#endif

}  // namespace voussoir
