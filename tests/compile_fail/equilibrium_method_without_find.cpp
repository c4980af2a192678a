// expect: equilibrium method: add `template <class System> EquilibriumReport find
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Method {
  using role = voussoir::roles::Equilibrium;
  static constexpr const char* name = "Method";
};
}  // namespace

static_assert(sizeof(voussoir::Solver<Method>) > 0);
