// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/core/parallel.hpp>
#include <voussoir/core/random.hpp>

namespace parallel_test {

using namespace voussoir;

TEST_SUITE("core/parallel") {
  TEST_CASE("every index is run exactly once, whatever the number of threads") {
    for (const unsigned threads : {0U, 1U, 2U, 3U, 8U, 1000U}) {
      for (const std::size_t count : {0UL, 1UL, 2UL, 7UL, 500UL}) {
        CAPTURE(threads);
        CAPTURE(count);
        std::vector<std::atomic<int>> runs(count);
        parallel_for(count, threads, [&](std::size_t i) { ++runs.at(i); });
        for (const auto& n : runs) CHECK(n == 1);
      }
    }
  }

  TEST_CASE("no more threads run than asked for, and with one thread it is the caller") {
    for (const unsigned threads : {1U, 3U}) {
      std::mutex guard;
      std::set<std::thread::id> ids;
      parallel_for(200, threads, [&](std::size_t) {
        const std::scoped_lock lock(guard);
        ids.insert(std::this_thread::get_id());
      });
      CHECK(ids.size() <= threads);
      if (threads == 1) CHECK(ids == std::set{std::this_thread::get_id()});
    }
  }

  TEST_CASE("two threads work at the same time") {
    // Each job waits for the other: one thread alone would never meet it. 30 s is for a busy
    // machine.
    std::atomic<int> arrived{0};
    std::atomic<bool> met{true};
    parallel_for(2, 2, [&](std::size_t) {
      ++arrived;
      const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
      while (arrived < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
      if (arrived < 2) met = false;
    });
    CHECK(met);
  }

  TEST_CASE("results in slots do not depend on the number of threads") {
    const auto run = [](unsigned threads) {
      std::vector<double> slots(300);
      parallel_for(slots.size(), threads, [&](std::size_t i) {
        Random random(1, i);
        for (int k = 0; k < 50; ++k) slots[i] += random.normal();
      });
      return slots;
    };
    const std::vector<double> serial = run(1);
    CHECK(serial[0] != serial[1]);
    CHECK(run(2) == serial);  // == is meant: the same operations in the same order
    CHECK(run(7) == serial);
  }

  TEST_CASE("an exception reaches the caller, and no further jobs start after it") {
    for (const unsigned threads : {1U, 4U}) {
      CAPTURE(threads);
      std::atomic<std::size_t> started{0};
      std::string message;
      try {
        parallel_for(1000000, threads, [&](std::size_t i) {
          ++started;
          if (i == 10) throw std::runtime_error("job 10");
          // Others linger, or they might finish all jobs before the throwing one is scheduled.
          if (i > 10) std::this_thread::sleep_for(std::chrono::microseconds(100));
        });
      } catch (const std::runtime_error& error) {
        message = error.what();
      }
      CHECK(message == "job 10");
      CHECK(started >= 11);
      CHECK(started < 900000);
      if (threads == 1) CHECK(started == 11);
    }
  }

  TEST_CASE("of several exceptions one is thrown, and all threads have ended by then") {
    std::atomic<int> running{0};
    CHECK_THROWS_AS(parallel_for(100, 4,
                                 [&](std::size_t) {
                                   ++running;
                                   std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                   --running;
                                   throw std::logic_error("every job fails");
                                 }),
                    std::logic_error);
    CHECK(running == 0);
  }
}

}  // namespace parallel_test
