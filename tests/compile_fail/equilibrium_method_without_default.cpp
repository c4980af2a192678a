// expect: equilibrium method: add a default constructor (documented default settings)
// SPDX-License-Identifier: MIT
// A solver starts with the default settings of its method.
#include <voussoir/solver/solver.hpp>

namespace {

using namespace voussoir;

struct Method {
  using role = roles::Equilibrium;
  static constexpr const char* name = "Method";
  template <class System>
  EquilibriumReport find(System&, const SearchContext&) const {
    return {};
  }
  explicit Method(double) {}
};

}  // namespace

const auto text = voussoir::Solver<Method>::composition();
