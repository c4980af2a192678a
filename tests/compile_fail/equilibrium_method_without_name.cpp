// expect: equilibrium method: add `static constexpr const char* name` for the log
// SPDX-License-Identifier: MIT
// The solver prints what it is made of.
#include <voussoir/equilibrium/equilibrium.hpp>

namespace {

using namespace voussoir;

struct Method {
  using role = roles::Equilibrium;
  template <class System>
  EquilibriumReport find(System&, const SearchContext&) const {
    return {};
  }
};

}  // namespace

static_assert(voussoir::explain_equilibrium_method<Method, int>());
