// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace voussoir {

/// How equations of the elastic stiffness are solved.
enum class LinearMethod {
  automatic,  ///< whichever of the others is expected to take less time and fits into memory
  direct,     ///< a sparse factor
  iterative,  ///< conjugate gradients with multigrid
};

[[nodiscard]] constexpr const char* to_string(LinearMethod method) {
  switch (method) {
    case LinearMethod::automatic:
      return "automatic";
    case LinearMethod::direct:
      return "direct";
    case LinearMethod::iterative:
      return "iterative";
  }
  return "automatic";
}

/// Settings of an elastic solver.
struct LinearSettings {
  LinearMethod method = LinearMethod::automatic;
  double memory_limit = 0;   ///< [bytes]; 0: what the operating system says is available
  int max_iterations = 150;  ///< of one solve; beyond, a factor is made
  unsigned threads = 1;      ///< that make a factor; the answer does not depend on it
};

/// How linear equations were solved, and what that took.
struct LinearReport {
  LinearMethod method = LinearMethod::automatic;  ///< of the last solve; automatic: there was none
  std::string reason;                             ///< why this one
  int bodies = 0;
  double memory = 0;   ///< of the factor or the preconditioner, the matrix not included [bytes]
  int iterations = 0;  ///< of all solves
};

/// Adds a report to what came before: iterations are summed, the rest is of the last.
inline void add_report(LinearReport& before, const LinearReport& next) {
  const int iterations = before.iterations + next.iterations;
  before = next;
  before.iterations = iterations;
}

}  // namespace voussoir
