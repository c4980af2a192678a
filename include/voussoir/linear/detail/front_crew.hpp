// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/thread_team.hpp>

namespace voussoir::detail {

/// What those who factor a matrix together know of each other: whether to go on.
///
/// Nobody leaves early: once it has failed or is stopped all go on without doing work, so that all
/// come to every meeting.
class FactorState {
 public:
  explicit FactorState(const Progress& progress) : stop_(progress) {}

  /// Asks the Progress; one thread only, so that what is called need not know of threads.
  void ask() noexcept {
    if (is_stopped()) return;
    try {
      stop_();
    } catch (...) {
      give_up();
    }
  }
  /// Ends the work with the exception that is being handled.
  void give_up() noexcept {
    if (!thrown_.test_and_set()) exception_ = std::current_exception();
    is_stopped_ = true;
  }
  /// A pivot of this front, counted in the order of elimination, is not positive.
  void fail(int front, std::size_t column) noexcept {
    const std::scoped_lock lock(guard_);
    if (front >= failed_front_) return;
    failed_front_ = front;
    failed_column_ = column;
  }
  [[nodiscard]] bool is_stopped() const noexcept { return is_stopped_; }
  /// Fronts before the first that failed go on: which it is must not depend on the threads.
  [[nodiscard]] bool is_over(int front) const noexcept {
    return is_stopped_ || front >= failed_front_;
  }
  [[nodiscard]] bool has_failed() const noexcept { return failed_front_ < nothing; }
  /// Of the whole factor. @pre has_failed()
  [[nodiscard]] std::size_t failed_column() const { return failed_column_; }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  static constexpr int nothing = 0x7fffffff;
  StopCheck stop_;
  std::atomic_flag thrown_;
  std::exception_ptr exception_;
  std::atomic<bool> is_stopped_{false};
  std::mutex guard_;
  std::atomic<int> failed_front_{nothing};
  std::size_t failed_column_ = 0;
};

/// One of those who work on a front, alone or with others. Work is dealt out in turn; what each
/// number is the sum of, and in which order, is the same for any number of members.
struct FrontMember {
  FactorState& state;
  ThreadTeam* team;  ///< none: alone
  unsigned number;   ///< in the team

  [[nodiscard]] bool takes(std::size_t turn) const {
    return team == nullptr || turn % team->size() == number;
  }
  [[nodiscard]] bool leads() const { return team == nullptr || number == 0; }
  void meet() const {
    if (team != nullptr) team->meet();
  }
  void ask() const {
    if (number == 0) state.ask();
  }
};

}  // namespace voussoir::detail
