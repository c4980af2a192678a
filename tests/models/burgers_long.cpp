// SPDX-License-Identifier: MIT
// A tunnel in rock with joints of the law BurgersJoint.
#include "models/every_model.hpp"

namespace burgers_long {

using namespace every_model;

TEST_SUITE("models/burgers_long") {
  TEST_CASE("BurgersJoint") { in_all_settings<BurgersJoint>().print(); }
}

}  // namespace burgers_long
