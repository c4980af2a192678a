// SPDX-License-Identifier: MIT
// What a bolt bears at a joint, by hand: its bar, its bond on either side, its plate.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>
#include <voussoir/design/bolt_strength.hpp>

#include "support/near.hpp"

namespace bolt_strength_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;
using voussoir_test::near;

BoltsInput grouted() {
  BoltsInput bolts;
  bolts.length = 4;
  bolts.yield_force = 150e3;
  bolts.rupture_force = 200e3;
  bolts.bond_strength = 100e3;
  return bolts;
}

}  // namespace

TEST_SUITE("design/bolt_strength") {
  TEST_CASE("the shorter of the lengths to the tip and to the head governs, or the bar") {
    const BoltsInput bolts = grouted();
    struct Row {
      double position, strength;
      BoltMode mode;
    };
    // 100 kN/m of 4 m; the bar yields at 150 kN.
    for (const Row& row :
         {Row{0, 0, BoltMode::bond_at_head}, Row{0.4, 40e3, BoltMode::bond_at_head},
          Row{1.6, 150e3, BoltMode::yield}, Row{2, 150e3, BoltMode::yield},
          Row{2.9, 110e3, BoltMode::bond_at_tip}, Row{4, 0, BoltMode::bond_at_tip}}) {
      CAPTURE(row.position);
      const BoltLimit found = bolt_limit(bolts, 4, row.position);
      CHECK(std::abs(found.strength - row.strength) < 1e-6);
      CHECK(found.mode == row.mode);
    }
    // Turned end for end the other side governs, as strong.
    for (const double position : {0.3, 1.1, 1.9})
      CHECK(bolt_limit(bolts, 4, position).strength ==
            near(bolt_limit(bolts, 4, 4 - position).strength).epsilon(1e-12));
  }

  TEST_CASE("a plate adds to the head alone") {
    BoltsInput bolts = grouted();
    bolts.plate_strength = 60e3;
    CHECK(bolt_limit(bolts, 4, 0.4).strength == near(100e3));
    CHECK(bolt_limit(bolts, 4, 0.4).mode == BoltMode::plate);
    CHECK(bolt_limit(bolts, 4, 0.8).strength == near(140e3));
    CHECK(bolt_limit(bolts, 4, 0.8).mode == BoltMode::bond_at_head);  // 80 of 140 kN
    CHECK(bolt_limit(bolts, 4, 3.6).strength == near(40e3));
    CHECK(bolt_limit(bolts, 4, 3.6).mode == BoltMode::bond_at_tip);
    bolts.plate_strength = 200e3;  // 240 kN with the grout before it: more than the bar
    CHECK(bolt_limit(bolts, 4, 0.4).strength == 150e3);
    CHECK(bolt_limit(bolts, 4, 0.4).mode == BoltMode::yield);
  }

  TEST_CASE("held by its ends: bar, anchor and plate, wherever its joints are") {
    BoltsInput bolts = grouted();
    bolts.type = BoltType::end_anchored;
    bolts.bond_strength.reset();
    for (const double position : {0.1, 2.0, 3.9}) {
      BoltsInput held = bolts;
      CHECK(bolt_limit(held, 4, position).strength == 150e3);
      CHECK(bolt_limit(held, 4, position).mode == BoltMode::yield);
      held.anchor_strength = 120e3;
      CHECK(bolt_limit(held, 4, position).strength == 120e3);
      CHECK(bolt_limit(held, 4, position).mode == BoltMode::anchor);
      held.plate_strength = 80e3;
      CHECK(bolt_limit(held, 4, position).strength == 80e3);
      CHECK(governed_by({2, 1, position, 40e3, bolt_limit(held, 4, position)}) == "bolt 3: plate");
      // A plate of 15 cm on 10 cm of shotcrete that bears 72 kN: that, and no bond beside it.
      CHECK(bolt_limit(held, 4, position, 72e3).strength == 72e3);
      CHECK(bolt_limit(held, 4, position, 72e3).mode == BoltMode::punching);
      CHECK(bolt_limit(held, 4, position, 90e3).mode == BoltMode::plate);
    }
    // Nothing but a plate says what it bears.
    bolts.yield_force.reset();
    bolts.rupture_force.reset();
    CHECK(!is_checked(bolts));
    bolts.plate_strength = 80e3;
    CHECK(is_checked(bolts));
    bolts.type = BoltType::grouted;  // of which it is a part of the bond
    CHECK(!is_checked(bolts));
  }

  TEST_CASE("without a bond the bar alone, without that nothing") {
    BoltsInput bolts = grouted();
    bolts.bond_strength.reset();
    CHECK(bolt_limit(bolts, 4, 0.01).strength == 150e3);
    bolts.yield_force.reset();
    CHECK(bolt_limit(bolts, 4, 3.99).strength == 200e3);
    CHECK(bolt_limit(bolts, 4, 3.99).mode == BoltMode::rupture);
    bolts.rupture_force.reset();
    CHECK(std::isinf(bolt_limit(bolts, 4, 1).strength));
    bolts.bond_strength = 100e3;
    CHECK(bolt_limit(bolts, 4, 1).strength == near(100e3));
  }

  TEST_CASE("the joint that takes most of its strength governs, not the largest force") {
    const BoltsInput bolts = grouted();
    std::vector<BoltUtilisation> joints{{2, 1, 2.0, 120e3, bolt_limit(bolts, 4, 2.0)},
                                        {6, 2, 2.9, 99e3, bolt_limit(bolts, 4, 2.9)},
                                        {7, 1, 0.5, -80e3, bolt_limit(bolts, 4, 0.5)}};
    const BoltUtilisation* const most = governing(joints);
    REQUIRE(most != nullptr);
    CHECK(most->value() == near(0.9).epsilon(1e-12));  // 120 of 150 kN is less
    CHECK(governed_by(*most) == "bolt 7: bond beyond its joint at 2.9 m");
    CHECK(joints[2].value() == 0);  // pressed
    joints[1].force = 0;
    CHECK(governed_by(*governing(joints)) == "bolt 3: yield at its joint at 2 m");
    joints = {{0, 1, 0, 1e3, bolt_limit(bolts, 4, 0)}};
    CHECK(std::isinf(governing(joints)->value()));
    joints = {{0, 1, 1, 1e3, {}}};
    CHECK(governing(joints) == nullptr);
    CHECK(joints.front().value() == 0);
    CHECK(governing(std::vector<BoltUtilisation>()) == nullptr);
  }

  TEST_CASE("a plate on shotcrete bears no more than that bears of punching") {
    BoltsInput bolts = grouted();
    bolts.plate_strength = 80e3;
    CHECK(bolt_limit(bolts, 4, 0.2, 100e3).strength == near(100e3));
    CHECK(bolt_limit(bolts, 4, 0.2, 100e3).mode == BoltMode::plate);
    CHECK(bolt_limit(bolts, 4, 0.2, 50e3).strength == near(70e3));
    CHECK(bolt_limit(bolts, 4, 0.2, 50e3).mode == BoltMode::punching);
    CHECK(bolt_limit(bolts, 4, 0.6, 50e3).mode == BoltMode::bond_at_head);  // 60 of 110 kN
    CHECK(governed_by(BoltUtilisation{0, 1, 0.2, 60e3, bolt_limit(bolts, 4, 0.2, 50e3)}) ==
          "bolt 1: punching of the shotcrete by its plate, and bond before its joint at 0.2 m");
  }

  TEST_CASE("which shotcrete is under a plate") {
    AnalysisInput input;
    input.bolts = {grouted()};
    input.bolts[0].plate_width = 0.15;
    input.linings.resize(1);
    LiningInput& lining = input.linings[0];
    lining.thickness = 0.1;
    lining.concrete = ConcreteSection{.strength = 30e6};
    lining.arc = ArcInput{0.5, 2.5};
    input.stages = {{.name = "shotcrete", .linings = {0}}, {.name = "bolts", .bolts = {0}}};
    const auto at = [&](double angle) { return punching_under(input, input.bolts[0], {}, angle); };
    // 4 (0.15 + 0.10) x 0.10 x 1.081348 MPa / 1.5 = 72.09 kN; 5 cm: 4 x 0.20 x 0.05 x 0.7209.
    CHECK(at(1.5) == near(72.0899e3).epsilon(1e-5));
    CHECK(punching_under(input, input.bolts[0], 0.05, 1.5) == near(28.8360e3).epsilon(1e-5));
    CHECK(std::isinf(punching_under(input, input.bolts[0], 0.0, 1.5)));  // left out
    CHECK(std::isinf(at(3)));                                            // beside it
    lining.age = ConcreteAge{.when_loaded = one_day};
    CHECK(at(1.5) == near(0.5256316 * 72.0899e3).epsilon(1e-4));
    lining.age.reset();
    input.stages[0].behind = 1;  // sprayed behind the bolts
    CHECK(std::isinf(at(1.5)));
    input.stages[0].behind = 0;
    std::swap(input.stages[0], input.stages[1]);
    CHECK(std::isinf(at(1.5)));
    input.stages = {{.name = "both", .bolts = {0}, .linings = {0}}};
    CHECK(std::isfinite(at(1.5)));
    lining.opening = 1;
    CHECK(std::isinf(at(1.5)));
    lining.opening = 0;
    lining.concrete.reset();
    CHECK(std::isinf(at(1.5)));
    lining.concrete = ConcreteSection{.strength = 30e6};
    input.bolts[0].plate_width.reset();
    CHECK(std::isinf(at(1.5)));
    // Heads are looked at about the centre of their opening.
    CHECK(angle_of_head(input, input.bolts[0], Segment{{0, 3}, {0, 6}}) ==
          near(0.5 * 3.14159265358979).epsilon(1e-12));
    CHECK(angle_of_head(input, input.bolts[0], Segment{{-3, -3}, {-6, -6}}) ==
          near(1.25 * 3.14159265358979).epsilon(1e-12));
  }
}

}  // namespace bolt_strength_test
