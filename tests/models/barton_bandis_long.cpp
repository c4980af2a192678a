// SPDX-License-Identifier: MIT
// A tunnel in rock with joints of the law BartonBandisJoint.
#include "models/every_model.hpp"

namespace barton_bandis_long {

using namespace every_model;

TEST_SUITE("models/barton_bandis_long") {
  TEST_CASE("BartonBandisJoint") { in_all_settings<BartonBandisJoint>().print(); }
}

}  // namespace barton_bandis_long
