// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <ctime>
#include <functional>
#include <stdexcept>

namespace voussoir {

/// Called now and then during long work: a fraction between 0 and 1 of the work done, or a negative
/// number where it cannot be known; returns false to stop. Work that has a result to show for
/// itself ends early and says so (equilibrium: verdict undecided); work of which a part is useless,
/// as the making of rock is, throws `Stopped`.
using Progress = std::function<bool(double fraction)>;

/// Work was given up because its Progress said so. Nothing of it is left.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped on request") {}
};

/// Asks a Progress whether to go on, from a loop of many short turns: every few milliseconds,
/// whatever a turn costs (up to some tenths of a millisecond), and never if there is none to ask.
class StopCheck {
 public:
  StopCheck() = default;  ///< asks nobody
  /// @param progress        must outlive this; none: nothing is ever asked
  /// @param turns_per_look  1: turns are long, the clock is looked at in each
  explicit StopCheck(const Progress& progress, unsigned turns_per_look = 32)
      : progress_(progress ? &progress : nullptr), turns_per_look_(turns_per_look) {}
  explicit StopCheck(const Progress&&, unsigned = 32) = delete;  ///< gone before the first turn

  /// One turn of the loop. @throws Stopped
  void operator()(double fraction = -1) {
    if (progress_ == nullptr || ++turns_ % turns_per_look_ != 0) return;
    const double now = milliseconds();
    if (std::abs(now - last_) < pause) return;  // a clock that is put back costs one early look
    last_ = now;
    if (!(*progress_)(fraction)) throw Stopped();
  }

 private:
  /// By the clock of C: <chrono> has calendars and time zones, which every file that includes the
  /// headers would pay for.
  [[nodiscard]] static double milliseconds() {
#ifdef TIME_UTC
    std::timespec now{};
    std::timespec_get(&now, TIME_UTC);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
#else  // mingw-w64: C's older clock, which there counts what passes on the wall
    return 1e3 / CLOCKS_PER_SEC * static_cast<double>(std::clock());
#endif
  }

  static constexpr double pause = 10;  ///< [ms]
  const Progress* progress_ = nullptr;
  unsigned turns_per_look_ = 32;
  unsigned turns_ = 0;
  double last_ = milliseconds();  ///< of the last look
};

}  // namespace voussoir
