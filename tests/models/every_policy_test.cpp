// SPDX-License-Identifier: MIT
// Every policy that is no default in two compositions, one at rest in 2-D, one in motion in 3-D;
// PinnedBar is in solver/lined_rock, Explicit in equilibrium/explicit. Every model by itself, at
// rest and in motion, in 2-D and 3-D: the files *_long.cpp beside this one.
#include "models/every_model.hpp"

namespace every_policy_test {

using namespace every_model;

TEST_SUITE("models/every_policy") {
  TEST_CASE("at rest, 2-D") {
    MESSAGE(at_rest<Planar, MohrCoulombJoint, AxialShearBolt, GargaWangAnchors, TimoshenkoBeam,
                    RockOnLining<BartonBandisJoint>, FaceContacts, Relaxation>());
  }
  TEST_CASE("in motion, 3-D") {
    MESSAGE(in_motion<Spatial, BurgersJoint, AxialShearBolt, JointFaceAnchors, BondedChain,
                      RockOnLining<MohrCoulombJoint>, AnalyticCentre>());
  }
}

}  // namespace every_policy_test
