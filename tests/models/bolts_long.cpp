// SPDX-License-Identifier: MIT
// Every bolt law and every way of anchoring.
#include "models/every_model.hpp"

namespace bolts_long {

using namespace every_model;

TEST_SUITE("models/bolts_long") {
  TEST_CASE("AxialBolt") {
    const Row row = in_all_settings<AxialBolt>();
    check_yielded(row);
    row.print();
  }
  TEST_CASE("AxialShearBolt") { in_all_settings<AxialShearBolt>().print(); }
  TEST_CASE("CurveBolt") {
    const Row row = in_all_settings<CurveBolt>();
    check_yielded(row);
    row.print();
  }
  TEST_CASE("AnyBoltOf") {
    in_all_settings<AnyBoltOf<AxialBolt, AxialShearBolt, CurveBolt>>().print();
  }
  TEST_CASE("AnyAnchorsOf") {
    in_all_settings<AnyAnchorsOf<LorigAnchors, GargaWangAnchors, JointFaceAnchors, EndAnchors>>()
        .print();
  }
  TEST_CASE("LorigAnchors") { in_all_settings<LorigAnchors>().print(); }
  TEST_CASE("GargaWangAnchors") { in_all_settings<GargaWangAnchors>().print(); }
  TEST_CASE("EndAnchors") { in_all_settings<EndAnchors>().print(); }
  TEST_CASE("JointFaceAnchors") { in_all_settings<JointFaceAnchors>().print(); }
}

}  // namespace bolts_long
