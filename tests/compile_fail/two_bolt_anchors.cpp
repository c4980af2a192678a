// expect: Solver: two kinds of bolt anchors given
// SPDX-License-Identifier: MIT
// One model a role: the solver must not choose between two.
#include <voussoir/solver/composition.hpp>

template struct voussoir::Composition<voussoir::LorigAnchors, voussoir::GargaWangAnchors>;
