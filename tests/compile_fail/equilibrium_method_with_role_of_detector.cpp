// expect: Solver: a policy has the parts of an equilibrium method and declares another role
// SPDX-License-Identifier: MIT
// Both have a `find`.
#include <voussoir/solver/solver.hpp>

namespace {

using namespace voussoir;

struct Method {
  using role = roles::ContactDetector;
  static constexpr const char* name = "Method";
  template <class System>
  EquilibriumReport find(System&, const SearchContext&) const {
    return {};
  }
};

}  // namespace

using Wrong = voussoir::Solver<Method>;
const auto text = Wrong::composition();
