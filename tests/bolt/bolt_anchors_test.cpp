// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <limits>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/core/random.hpp>

#include "support/near.hpp"

namespace bolt_anchors_test {

using namespace voussoir;

TEST_SUITE("bolt/bolt_anchors") {
  TEST_CASE("Lorig's anchors sit 1.2 diameters of a 28 mm bar from the joint") {
    const AnchorDistances d = LorigAnchors{}.distances({0.8, 0.3});
    CHECK(d.before == 1.2 * 0.028);
    CHECK(d.after == 1.2 * 0.028);
    CHECK(d.before + d.after == voussoir_test::near(0.0672).epsilon(1e-15));  // d_init of the paper
  }

  TEST_CASE("Lorig's anchors sit in the middle of a block thinner than twice their distance") {
    const AnchorDistances d = LorigAnchors{0.05}.distances({0.04, 0.1});
    CHECK(d.before == 0.02);
    CHECK(d.after == 0.05);  // 0.1 m is just thick enough
  }

  TEST_CASE("Garga and Wang's anchors are midway in the blocks") {
    const AnchorDistances d = GargaWangAnchors{}.distances({0.8, 0.3});
    CHECK(d.before == 0.4);
    CHECK(d.after == 0.15);
  }

  TEST_CASE("anchors on the joint have no distance from it") {
    const AnchorDistances d = JointFaceAnchors{}.distances({0.8, 0.3});
    CHECK(d.before == 0);
    CHECK(d.after == 0);
  }

  TEST_CASE_TEMPLATE("anchors of a block crossed by two joints do not pass each other", Anchors,
                     LorigAnchors, GargaWangAnchors, JointFaceAnchors) {
    Random random(1);
    for (int k = 0; k < 1000; ++k) {
      const double thickness = random.uniform();
      const Anchors anchors{};
      // The block lies after the joint nearer to the head and before the next one.
      const double first = anchors.distances({1.0, thickness}).after;
      const double second = anchors.distances({thickness, 1.0}).before;
      REQUIRE(first >= 0);
      REQUIRE(second >= 0);
      REQUIRE(first + second <= thickness);
    }
  }

  TEST_CASE("a distance that is not positive and finite is refused") {
    for (const double bad : {0.0, -0.01, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()})
      CHECK_THROWS_AS((void)LorigAnchors{bad}.distances({1, 1}), InvalidInput);
  }
}

}  // namespace bolt_anchors_test
