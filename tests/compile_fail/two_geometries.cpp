// expect: Solver: two geometries given
// SPDX-License-Identifier: MIT
// One geometry a solver.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Other : Planar {};

}  // namespace

template struct voussoir::Composition<Planar, Other>;
