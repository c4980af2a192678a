// expect: Solver: two contact laws given
// SPDX-License-Identifier: MIT
// One model a role: the solver must not choose between two.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Other : CoulombJoint {
  using CoulombJoint::CoulombJoint;
};

}  // namespace

template struct voussoir::Composition<CoulombJoint, Other>;
