// expect: Solver: a policy fills no role; give it `using role = voussoir::roles::...`
// SPDX-License-Identifier: MIT
// A type given to the solver that does not say what it is for.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct NoPolicy {
  static constexpr const char* name = "NoPolicy";
};

}  // namespace

template struct voussoir::Composition<NoPolicy>;
