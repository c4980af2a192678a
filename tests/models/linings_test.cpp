// SPDX-License-Identifier: MIT
// Every lining.
#include "models/every_model.hpp"

namespace linings_test {

using namespace every_model;

TEST_SUITE("models/linings") {
  TEST_CASE("EulerBernoulliBeam") { in_all_settings<EulerBernoulliBeam>().print(); }
  TEST_CASE("TimoshenkoBeam") { in_all_settings<TimoshenkoBeam>().print(); }
  TEST_CASE("PinnedBar") { in_all_settings<PinnedBar>().print(); }
  TEST_CASE("BondedChain") { in_all_settings<BondedChain>().print(); }
}

}  // namespace linings_test
