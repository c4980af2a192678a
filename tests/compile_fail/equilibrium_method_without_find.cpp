// expect: equilibrium method: add `template <class System> EquilibriumReport find(System&, const SearchContext&) const`
// SPDX-License-Identifier: MIT
// An equilibrium method that does not search.
#include <voussoir/solver/solver.hpp>

namespace {

using namespace voussoir;

struct Method {
  using role = roles::Equilibrium;
  static constexpr const char* name = "Method";
};

}  // namespace

const auto text = voussoir::Solver<Method>::composition();
