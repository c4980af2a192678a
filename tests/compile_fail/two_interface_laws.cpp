// expect: Solver: two interface laws given
// SPDX-License-Identifier: MIT
// One model a role: the solver must not choose between two.
#include <voussoir/solver/composition.hpp>

template struct voussoir::Composition<voussoir::RockOnLining<voussoir::CoulombJoint>,
                                      voussoir::RockOnLining<voussoir::SmoothWall>>;
