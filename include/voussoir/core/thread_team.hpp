// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace voussoir {

/// Threads that do one job together, again and again, and meet on the way.
///
/// For work of tens of microseconds between two meetings, where starting threads would cost more
/// than the work: a meeting is a short spin on an atomic, a job wakes threads that sleep.
class ThreadTeam {
 public:
  /// @param size  members, the caller included; fewer where the system has no more threads to give
  explicit ThreadTeam(unsigned size = 1) : size_(std::max(size, 1U)) {
    try {
      for (unsigned k = 1; k < size_; ++k) helpers_.emplace_back([this, k] { serve(k); });
    } catch (const std::system_error&) {
      size_ = static_cast<unsigned>(helpers_.size()) + 1;  // nobody reads it before the first job
    }
  }
  ~ThreadTeam() {
    {
      const std::scoped_lock lock(guard_);
      stop_ = true;
      ++job_number_;
    }
    wake_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  [[nodiscard]] unsigned size() const { return size_; }

  /// Runs job(member) on every member, 0 (the caller) to size - 1, and returns when all have ended.
  /// The job must not throw between meetings that others still wait for: an exception that leaves
  /// it ends the program if the team has more than one member.
  void run(const std::function<void(unsigned)>& job) {
    if (size_ == 1) {
      job(0);
      return;
    }
    {
      const std::scoped_lock lock(guard_);
      job_ = &job;
      job_number_.fetch_add(1, std::memory_order_release);
    }
    wake_.notify_all();
    run_noexcept(job, 0);
    meet();
  }

  /// Waits until every member has come here. Only inside a job.
  void meet() {
    if (size_ == 1) return;
    const unsigned round = round_.load(std::memory_order_relaxed);
    if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
      arrived_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
      return;
    }
    // A member that has lost its processor would be waited for in vain: give ours away then.
    for (int spins = 0; round_.load(std::memory_order_acquire) == round; ++spins)
      if (spins > 2000) std::this_thread::yield();
  }

  /// The part of `count` items that falls to a member, [first, last).
  struct Range {
    std::size_t first, last;
  };
  [[nodiscard]] Range share(std::size_t count, unsigned member) const {
    return {count * member / size_, count * (member + std::size_t{1}) / size_};
  }

 private:
  static void run_noexcept(const std::function<void(unsigned)>& job, unsigned member) noexcept {
    job(member);
  }

  void serve(unsigned member) {
    for (unsigned done = 0;;) {
      // Jobs often follow one another within less than it takes to wake a thread that sleeps.
      for (int turns = 0; turns < 4000 && job_number_.load(std::memory_order_acquire) == done;
           ++turns)
        if (turns > 2000) std::this_thread::yield();
      const std::function<void(unsigned)>* job = nullptr;
      {
        std::unique_lock lock(guard_);
        wake_.wait(lock, [&] { return job_number_ != done; });
        if (stop_) return;
        done = job_number_;
        job = job_;
      }
      run_noexcept(*job, member);
      meet();
    }
  }

  unsigned size_;
  std::vector<std::thread> helpers_;
  std::mutex guard_;
  std::condition_variable wake_;
  const std::function<void(unsigned)>* job_ = nullptr;
  std::atomic<unsigned> job_number_{0};  ///< changed under the guard
  bool stop_ = false;
  std::atomic<unsigned> arrived_{0}, round_{0};
};

}  // namespace voussoir
