// SPDX-License-Identifier: MIT
// Every lining, and every law of its interface with the rock.
#include "models/every_model.hpp"

namespace linings_long {

using namespace every_model;

TEST_SUITE("models/linings_long") {
  TEST_CASE("EulerBernoulliBeam") { in_all_settings<EulerBernoulliBeam>().print(); }
  TEST_CASE("TimoshenkoBeam") { in_all_settings<TimoshenkoBeam>().print(); }
  TEST_CASE("PinnedBar") { in_all_settings<PinnedBar>().print(); }
  TEST_CASE("BondedChain") { in_all_settings<BondedChain>().print(); }
  TEST_CASE("AnyLining") { in_all_settings<AnyLining>().print(); }
  TEST_CASE("rock on lining") {
    in_all_settings<RockOnLining<MohrCoulombJoint>>().print();
    in_all_settings<RockOnLining<BartonBandisJoint>>().print();
    in_all_settings<RockOnLining<BurgersJoint>>().print();
  }
}

}  // namespace linings_long
