// expect: Solver: two bolt laws given
// SPDX-License-Identifier: MIT
// One model a role: the solver must not choose between two.
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/solver/composition.hpp>

template struct voussoir::Composition<voussoir::AxialBolt, voussoir::AxialShearBolt>;
