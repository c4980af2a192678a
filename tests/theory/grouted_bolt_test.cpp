// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <limits>
#include <voussoir/theory/grouted_bolt.hpp>

#include "support/reference.hpp"

namespace grouted_bolt_test {

using namespace voussoir;
using voussoir_test::reference;
using voussoir_test::relative;

TEST_SUITE("theory/grouted_bolt") {
  TEST_CASE("shear and axial stiffness, against finite elements on springs") {
    const auto k = grouted_bolt_stiffness({0.028, 0.042, 200e9, 10e9, 4e9});
    CHECK(relative(k.beta, reference("F.lorig.beta")) <= 6e-12);  // 12 digits
    CHECK(relative(k.shear, reference("F.lorig.Ks")) <= 6e-12);
    CHECK(relative(k.pull_out, reference("F.lorig.Ka_half")) <= 6e-12);
    CHECK(relative(k.pull_out, reference("F.lorig.Ka_pi")) <= 6e-12);
    CHECK(relative(k.axial, reference("F.lorig.Ka_joint")) <= 6e-12);
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan}) {
      CHECK_THROWS_AS(grouted_bolt_stiffness({bad, 0.042, 1, 1, 1}), InvalidInput);
      CHECK_THROWS_AS(grouted_bolt_stiffness({0.028, bad, 1, 1, 1}), InvalidInput);
      CHECK_THROWS_AS(grouted_bolt_stiffness({0.028, 0.042, bad, 1, 1}), InvalidInput);
      CHECK_THROWS_AS(grouted_bolt_stiffness({0.028, 0.042, 1, bad, 1}), InvalidInput);
      CHECK_THROWS_AS(grouted_bolt_stiffness({0.028, 0.042, 1, 1, bad}), InvalidInput);
    }
    CHECK_THROWS_AS(grouted_bolt_stiffness({0.028, 0.028, 1, 1, 1}), InvalidInput);
  }
}

}  // namespace grouted_bolt_test
