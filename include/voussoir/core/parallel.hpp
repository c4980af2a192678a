// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace voussoir {

/// Runs job(0), ..., job(count - 1) on up to `threads` threads, each index once, in any order.
///
/// Jobs must not share mutable state; results written to slot i then do not depend on the number of
/// threads. The first exception stops further jobs from starting and is rethrown here.
template <class Job>
void parallel_for(std::size_t count, unsigned threads, Job&& job) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        job(i);
      } catch (...) {
        const std::scoped_lock lock(guard);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  const auto helpers = std::min<std::size_t>(std::max(threads, 1U), count);
  {
    std::vector<std::jthread> pool;
    try {
      for (std::size_t i = 1; i < helpers; ++i) pool.emplace_back(work);
    } catch (const std::system_error&) {
      // The system has no more threads to give: those there are do it all.
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace voussoir
