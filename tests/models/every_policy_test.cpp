// SPDX-License-Identifier: MIT
// Every policy that is no default in two compositions, one at rest in 2-D, one in motion in 3-D;
// PinnedBar is in solver/lined_rock, Explicit in equilibrium/explicit. Every model by itself, at
// rest and in motion, in 2-D and 3-D: the files *_long.cpp beside this one.
#include <voussoir/contact/any_joint.hpp>

#include "models/every_model.hpp"
#include "support/small_tunnel.hpp"

namespace every_policy_test {

using namespace every_model;
using voussoir_test::small_in_situ;
using voussoir_test::small_opening;
using voussoir_test::small_rock;

TEST_SUITE("models/every_policy") {
  TEST_CASE("at rest, 2-D") {
    MESSAGE(at_rest<Planar, MohrCoulombJoint, AxialShearBolt, GargaWangAnchors, TimoshenkoBeam,
                    RockOnLining<BartonBandisJoint>, FaceContacts, Relaxation>());
  }
  TEST_CASE("in motion, 3-D") {
    MESSAGE(in_motion<Spatial, BurgersJoint, AxialShearBolt, JointFaceAnchors, BondedChain,
                      RockOnLining<MohrCoulombJoint>, AnalyticCentre>());
  }

  TEST_CASE("AnyJointOf is the law that it holds, bit for bit") {
    const CoulombJoint joint({5e9, 5e8, 35 * degree});
    Solver<CoulombJoint> typed(small_rock<Planar>(), joint, small_in_situ);
    Solver<AnyJoint> any(small_rock<Planar>(), AnyJoint(joint), small_in_situ);
    typed.excavate(small_opening<Planar>(), 0.02);
    any.excavate(small_opening<Planar>(), 0.02);
    REQUIRE(typed.equilibrium().verdict == Verdict::stable);
    REQUIRE(any.equilibrium().verdict == Verdict::stable);
    CHECK(typed.system().displacement == any.system().displacement);
  }

  TEST_CASE("AnyLaw is the law behind it, bit for bit") {
    const CoulombJoint joint({5e9, 5e8, 35 * degree});
    Solver<CoulombJoint> typed(small_rock<Planar>(), joint, small_in_situ);
    Solver<AnyLaw<2>> any(small_rock<Planar>(), AnyLaw<2>(joint), small_in_situ);
    typed.excavate(small_opening<Planar>(), 0.02);
    any.excavate(small_opening<Planar>(), 0.02);
    REQUIRE(typed.equilibrium().verdict == Verdict::stable);
    REQUIRE(any.equilibrium().verdict == Verdict::stable);
    CHECK(typed.system().displacement == any.system().displacement);
    CHECK(joint_states(typed).front().report.normal == joint_states(any).front().report.normal);
  }
}

}  // namespace every_policy_test
