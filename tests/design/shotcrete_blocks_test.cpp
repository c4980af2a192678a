// SPDX-License-Identifier: MIT
// Shotcrete over single blocks, by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <voussoir/design/shotcrete_blocks.hpp>

#include "support/near.hpp"

namespace shotcrete_blocks_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;
using voussoir_test::near;

/// 10 cm of C30, f_ctd = 1.081348 MPa; 0.5 MPa of adhesion.
ShotcreteLayer layer() { return {{.thickness = 0.1, .strength = 30e6}, 0.5e6, 0.03}; }

AnalysisInput lined(double thickness) {
  AnalysisInput input;
  LiningInput lining;
  lining.thickness = thickness;
  lining.concrete = ConcreteSection{.strength = 30e6};
  lining.adhesion = 0.5e6;
  lining.arc = ArcInput{-0.5, 3.5};
  input.linings.push_back(lining);
  return input;
}

}  // namespace

TEST_SUITE("design/shotcrete_blocks") {
  TEST_CASE("a strip of 1.5 m by hand") {
    const ShotcreteCapacity found = shotcrete_over_strip(layer(), 1.5);
    CHECK(found.adhesion == near(2 * 0.03 * 0.5e6 / 1.5).epsilon(1e-12));         // 20 kN/m
    CHECK(found.direct_shear == near(2 * 1.081348e6 * 0.1 / 1.5).epsilon(1e-5));  // 144.2 kN/m
    CHECK(found.flexure == near(8 * 1.081348e6 * 0.01 / 6 / 1.5).epsilon(1e-5));  // 9.61 kN/m
    CHECK(std::isinf(found.punching));
    CHECK(found.value() == found.adhesion);
    CHECK(found.mode() == ShotcreteMode::adhesion);
    CHECK(shotcrete_over_strip(layer(), 3).flexure == near(0.5 * found.flexure).epsilon(1e-12));
    CHECK(shotcrete_over_strip(layer(), 3).adhesion == found.adhesion);
  }

  TEST_CASE("a face of 2 m2 by hand: the edge of a circle, and what a plate bears") {
    const ShotcreteCapacity found = shotcrete_over_face(layer(), 2);
    const double radius = std::sqrt(2 / std::numbers::pi);
    CHECK(found.adhesion ==
          near(2 * std::numbers::pi * radius * 0.03 * 0.5e6 / 1.5).epsilon(1e-12));
    CHECK(found.direct_shear / found.adhesion == near(144.18 / 20).epsilon(1e-4));
    // The moment in the middle of that plate, (3 + nu) q R^2 / 16, is what cracks it.
    const double pressure = found.flexure / 2;
    CHECK(3.2 * pressure * radius * radius / 16 == near(1.081348e6 * 0.01 / 6).epsilon(1e-5));
  }

  TEST_CASE("what fibres and bars bear once it has cracked is flexure, the inner face in tension") {
    ShotcreteLayer fibres = layer();
    fibres.section.fibre_strength = 3e6;
    // 2 MPa over all but the pressed edge: a little less than f t^2 / 2.
    const double moment = bending_resistance(fibres.section);
    CHECK(moment < 2e6 * 0.01 / 2);
    CHECK(moment > 0.85 * 2e6 * 0.01 / 2);
    ShotcreteLayer mesh = layer();
    mesh.section.bars = {{.area = 5e-4, .depth = 0.03}};
    // 217 kN on a lever of nearly 6 cm; near the outer face it has half that.
    CHECK(bending_resistance(mesh.section) == near(217.4e3 * 0.061).epsilon(0.05));
    mesh.section.bars = {{.area = 5e-4, .depth = 0.07}};
    CHECK(bending_resistance(mesh.section) < 0.5 * 217.4e3 * 0.061);
    const ShotcreteCapacity found = shotcrete_over_strip(fibres, 1.5);
    CHECK(found.flexure == near(8 * moment / 1.5).epsilon(1e-12));
    CHECK(found.mode() == ShotcreteMode::flexure);  // it peels and holds on
    CHECK(found.value() == found.flexure);
  }

  TEST_CASE("the order in which a layer fails") {
    struct Row {
      double adhesion, shear, flexure, punching, value;
      ShotcreteMode mode;
    };
    for (const Row& row : {Row{20, 100, 10, 50, 20, ShotcreteMode::adhesion},
                           Row{20, 15, 10, 50, 15, ShotcreteMode::direct_shear},
                           Row{20, 100, 40, 50, 40, ShotcreteMode::flexure},
                           Row{20, 100, 40, 30, 30, ShotcreteMode::punching},
                           Row{20, 25, 40, 30, 25, ShotcreteMode::direct_shear}}) {
      const ShotcreteCapacity found{row.adhesion, row.shear, row.flexure, row.punching};
      CHECK(found.value() == row.value);
      CHECK(found.mode() == row.mode);
    }
    // 4 x (0.15 + 0.1) m of 72.09 kN/m.
    CHECK(punching_resistance(layer().section, 0.15) == near(72.0899e3).epsilon(1e-5));
  }

  TEST_CASE("a block takes the lining over it, if its adhesion is given") {
    AnalysisInput input = lined(0.1);
    const auto at = [&](double angle) { return shotcrete_use(input, angle, 15e3, 1.5); };
    REQUIRE(at(1.5).has_value());
    CHECK(at(1.5)->value == near(15.0 / 20).epsilon(1e-12));
    CHECK(at(0).has_value());
    CHECK(at(3.4).has_value());
    CHECK_FALSE(at(3.6).has_value());
    CHECK_FALSE(at(5.7).has_value());
    CHECK(at(5.9).has_value());  // the arc begins at -0.5 rad
    input.linings.front().arc.reset();
    CHECK(at(4.5).has_value());
    input.linings.front().opening = 1;
    CHECK_FALSE(at(1.5).has_value());
    input.linings.front().opening = 0;
    input.linings.front().adhesion.reset();
    CHECK_FALSE(at(1.5).has_value());
    input = lined(0.1);
    input.model.dimension = 3;
    CHECK(shotcrete_use(input, 1.5, 15e3, 2)->value ==
          near(15e3 / shotcrete_over_face(layer(), 2).value()).epsilon(1e-12));
  }

  TEST_CASE("what cannot hold anything is refused by name") {
    ShotcreteLayer none = layer();
    none.adhesion = 0;
    CHECK_THROWS_WITH_AS((void)shotcrete_over_strip(none, 1), doctest::Contains("adhesion"),
                         InvalidInput);
    CHECK_THROWS_WITH_AS((void)shotcrete_over_strip(layer(), 0), doctest::Contains("span"),
                         InvalidInput);
    CHECK_THROWS_WITH_AS((void)shotcrete_over_face(layer(), std::nan("")),
                         doctest::Contains("face of a block"), InvalidInput);
  }
}

}  // namespace shotcrete_blocks_test
