// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Processes that `mpirun` has started together, to share the cases of one plan. A program built
/// without MPI (CMake option VOUSSOIR_MPI) is always one process alone.
namespace voussoir::program {

/// One for a program, from its start to its end.
class Ranks {
 public:
  Ranks(int& argc, char**& argv);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const { return rank_; }  ///< of this process, 0 to size - 1
  [[nodiscard]] int size() const { return size_; }
  /// Waits for all.
  /// @return  the largest of what each of them gave
  [[nodiscard]] int largest(int value) const;

 private:
  int rank_ = 0, size_ = 1;
};

/// Why several processes that were started together cannot share their work; empty: they can, or
/// there is one alone.
[[nodiscard]] std::string why_ranks_are_apart();

}  // namespace voussoir::program
