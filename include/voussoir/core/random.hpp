// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>

namespace voussoir {

/// Random numbers that are the same on every platform, compiler and standard library.
///
/// Philox4x32-10, a counter-based generator: the k-th number of a stream is a function of (seed,
/// stream, k) alone, so streams (one per joint set) never disturb each other. The distributions use
/// integer operations, comparisons and single correctly rounded operations only - no libm, nothing
/// that a fused multiply-add could change.
///
/// Source: Salmon et al. (2011), Parallel random numbers: as easy as 1, 2, 3, SC11.
class Random {
 public:
  /// @param seed    chosen by the user
  /// @param stream  independent sequence under the same seed
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : seed_(seed), stream_(stream) {}

  /// One block of the generator: ten rounds on a 128-bit counter with a 64-bit key.
  [[nodiscard]] static std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                                           std::array<std::uint32_t, 2> key);

  /// 64 random bits.
  std::uint64_t bits();

  /// Uniform on [0, 1): a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform on {0, ..., count - 1}; unbiased by rejection. @pre count > 0
  std::uint64_t below(std::uint64_t count) {
    const std::uint64_t limit = UINT64_MAX - UINT64_MAX % count;
    std::uint64_t value = bits();
    while (value >= limit) value = bits();
    return value % count;
  }

  /// Standard normal deviate, sampled exactly up to the 53 bits of its uniform part.
  ///
  /// Source: Karney (2016), Sampling exactly from the normal distribution, ACM TOMS 42(1), 3,
  /// algorithm N: comparisons of uniform deviates only, hence the same bits everywhere, which an
  /// inverse distribution function or Box-Muller (logarithm, cosine) does not give.
  double normal();

  /// Fisher-Yates shuffle.
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t left = items.size(); left > 1; --left) {
      std::swap(items[left - 1], items[static_cast<std::size_t>(below(left))]);
    }
  }

 private:
  /// True with probability exp(-1/2) (Karney's algorithm H).
  bool accept_half() {
    double previous = uniform();
    if (previous >= 0.5) return true;
    for (;;) {
      const double next = uniform();
      if (next >= previous) return false;
      previous = uniform();
      if (previous >= next) return true;
    }
  }

  /// True with probability exp(-x (2k + x) / (2k + 2)) (Karney's algorithm B).
  bool accept_tail(int k, double x) {
    const double threshold = (2.0 * k + x) / (2.0 * k + 2.0);
    double previous = x;
    for (int steps = 0;; ++steps) {
      const double next = uniform();
      if (next >= previous || uniform() >= threshold) return steps % 2 == 0;
      previous = next;
    }
  }

  std::uint64_t seed_;
  std::uint64_t stream_;
  std::uint64_t counter_ = 0;
  std::array<std::uint32_t, 4> block_{};
  std::size_t used_ = 2;  ///< halves of the block already handed out
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::array<std::uint32_t, 4> Random::philox(std::array<std::uint32_t, 4> counter,
                                                            std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t left = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t right = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(right >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(right),
               static_cast<std::uint32_t>(left >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(left)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

VOUSSOIR_INLINE std::uint64_t Random::bits() {
  if (used_ == 2) {
    const auto lower = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
    const auto upper = [](std::uint64_t v) { return static_cast<std::uint32_t>(v >> 32); };
    block_ = philox({lower(counter_), upper(counter_), lower(stream_), upper(stream_)},
                    {lower(seed_), upper(seed_)});
    ++counter_;
    used_ = 0;
  }
  const std::size_t first = 2 * used_++;
  return block_[first] | (std::uint64_t{block_[first + 1]} << 32);
}

VOUSSOIR_INLINE double Random::normal() {
  for (;;) {
    int k = 0;
    while (accept_half()) ++k;
    bool accepted = true;
    for (int trial = 0; accepted && trial < k * (k - 1); ++trial) accepted = accept_half();
    if (!accepted) continue;
    const double x = uniform();
    for (int trial = 0; accepted && trial <= k; ++trial) accepted = accept_tail(k, x);
    if (!accepted) continue;
    const double magnitude = k + x;
    return (bits() & 1U) != 0U ? -magnitude : magnitude;
  }
}

#endif

}  // namespace voussoir
