// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/cholesky_pattern.hpp>

namespace voussoir {

/// The last few factor patterns, for those who factor matrices of the same coupled pairs again and
/// again: the tunnels of a diagram share the rock, and often the supports. Safe to use from several
/// threads; whether a pattern was kept or made changes no answer.
class PatternStore {
 public:
  /// The pattern of these pairs, kept or made. See `CholeskyPattern`. @throws Stopped
  [[nodiscard]] VOUSSOIR_INLINE std::shared_ptr<const CholeskyPattern> pattern(
      int dof, int size, const std::vector<std::pair<int, int>>& pairs,
      const Progress& progress = {});

 private:
  /// With and without lining, and some of the tunnels from which blocks have detached.
  static constexpr std::size_t kept = 4;
  std::mutex guard_;
  std::array<std::shared_ptr<const CholeskyPattern>, kept> patterns_;
  std::size_t oldest_ = 0;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::shared_ptr<const CholeskyPattern> PatternStore::pattern(
    int dof, int size, const std::vector<std::pair<int, int>>& pairs, const Progress& progress) {
  {
    const std::scoped_lock lock(guard_);
    for (const auto& known : patterns_)
      if (known && known->dof() == dof && known->is_for(size, pairs)) return known;
  }
  auto made = std::make_shared<const CholeskyPattern>(dof, size, pairs, progress);
  VOUSSOIR_ASSERT(made->size() == size && made->dof() == dof, "a pattern is of the matrix");
  const std::scoped_lock lock(guard_);
  patterns_[oldest_] = made;
  oldest_ = (oldest_ + 1) % kept;
  return made;
}

#endif

}  // namespace voussoir
