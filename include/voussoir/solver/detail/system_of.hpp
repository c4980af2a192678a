// SPDX-License-Identifier: MIT
#pragma once

namespace voussoir::detail {

/// The system of a solver to be written to: for tests and benchmarks that move its bodies by hand
/// or take an equilibrium method apart. Whoever writes to it keeps no promise of the solver's.
struct SystemOf {
  template <class Solver>
  [[nodiscard]] static typename Solver::SystemType& in(Solver& solver) {
    return solver.system_;
  }
};

}  // namespace voussoir::detail
