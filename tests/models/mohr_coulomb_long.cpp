// SPDX-License-Identifier: MIT
// A tunnel in rock with joints of the law MohrCoulombJoint.
#include "models/every_model.hpp"

namespace mohr_coulomb_long {

using namespace every_model;

TEST_SUITE("models/mohr_coulomb_long") {
  TEST_CASE("MohrCoulombJoint") { in_all_settings<MohrCoulombJoint>().print(); }
}

}  // namespace mohr_coulomb_long
