// expect: Solver: two contact detectors given
// SPDX-License-Identifier: MIT
// One contact detector a solver.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Other : CutContacts {};

}  // namespace

template struct voussoir::Composition<CutContacts, Other>;
