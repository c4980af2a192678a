// SPDX-License-Identifier: MIT
// Steel ribs in shotcrete against the transformed section and its stresses.
#include <doctest/doctest.h>

#include <cmath>
#include <voussoir/design/composite_support.hpp>
#include <voussoir/design/models.hpp>

#include "support/near.hpp"

namespace composite_support_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;
using voussoir_test::near;

/// HEB 120 (34.0 cm2, 864 cm4, 144 cm3) every metre.
SteelRibs heb120() {
  return {.area = 34e-4,
          .second_moment = 864e-8,
          .section_modulus = 144e-6,
          .spacing = 1,
          .yield_strength = 235e6};
}

}  // namespace

TEST_SUITE("design/composite_support") {
  TEST_CASE("thrust by E A, moment and shear by E I, by hand") {
    // 20 cm of E = 21 GPa: E A = 4.2 GN, E I = 21e9 x 0.2^3 / 12 = 14.0 MN m2; the ribs 0.714 GN
    // and 1.8144 MN m2: 14.5299 % and 11.4732 %.
    const SharedForces shared = shared_forces(heb120(), 21e9, 0.2, {1e6, 40e3, 60e3}, 1);
    CHECK(shared.on_rib.thrust == near(0.145299e6).epsilon(1e-5));
    CHECK(shared.on_rib.moment == near(0.114732 * 40e3).epsilon(1e-5));
    CHECK(shared.on_concrete.thrust == near(0.854701e6).epsilon(1e-5));
    CHECK(shared.on_concrete.moment == near(0.885268 * 40e3).epsilon(1e-5));
    CHECK(shared.on_concrete.shear == near(0.885268 * 60e3).epsilon(1e-5));
    // 145 299 N / 34 cm2 = 42.735 MPa and 4 589 N m / 144 cm3 = 31.870 MPa of 235.
    CHECK(rib_utilisation(heb120(), shared.on_rib).value ==
          near((42.735 + 31.870) / 235).epsilon(1e-4));
    SteelRibs safer = heb120();
    safer.partial_factor = 1.1;
    CHECK(rib_utilisation(safer, shared.on_rib).value ==
          near(1.1 * (42.735 + 31.870) / 235).epsilon(1e-4));
  }

  TEST_CASE("the parts add up, and strain and curvature are those of the transformed section") {
    for (const double spacing : {0.75, 1.0, 1.5})
      for (const double width : {1.0, 0.8})
        for (const double thickness : {0.15, 0.35}) {
          SteelRibs ribs = heb120();
          ribs.spacing = spacing;
          const double modulus = 15e9, steel = 210e9 / modulus;
          const SectionForces load{0.7e6, -25e3, 30e3};
          const SharedForces shared = shared_forces(ribs, modulus, thickness, load, width);
          const double count = width / spacing;
          CHECK(shared.on_concrete.thrust + count * shared.on_rib.thrust ==
                near(load.thrust).epsilon(1e-12));
          CHECK(shared.on_concrete.moment + count * shared.on_rib.moment ==
                near(load.moment).epsilon(1e-12));
          // Steel as so many times as much concrete.
          const double area = width * thickness + count * steel * ribs.area,
                       second = width * thickness * thickness * thickness / 12 +
                                count * steel * ribs.second_moment;
          const double mean = load.thrust / area, edge = load.moment / second * thickness / 2;
          CHECK(shared.on_concrete.thrust / (width * thickness) == near(mean).epsilon(1e-12));
          CHECK(6 * shared.on_concrete.moment / (width * thickness * thickness) ==
                near(edge).epsilon(1e-12));
          CHECK(shared.on_rib.thrust / ribs.area == near(steel * mean).epsilon(1e-12));
        }
  }

  TEST_CASE("the model has the stiffness of both") {
    LiningInput lining;
    lining.young_modulus = 21e9;
    const LiningSection alone = section_of(lining, 0.2);
    lining.ribs = heb120();
    lining.ribs->spacing = 0.5;
    const LiningSection both = section_of(lining, 0.2), strip = rib_strip_of(lining, 0.2, 1.5);
    CHECK(both.axial_stiffness == near(alone.axial_stiffness + 2 * 0.714e9).epsilon(1e-12));
    CHECK(both.bending_stiffness == near(alone.bending_stiffness + 2 * 1.8144e6).epsilon(1e-12));
    CHECK(strip.axial_stiffness == near(1.5 * both.axial_stiffness).epsilon(1e-12));
    CHECK(strip.bending_stiffness == near(1.5 * both.bending_stiffness).epsilon(1e-12));
    // Along the tunnel there are none.
    CHECK(strip_of(lining, 0.2, 1.5).axial_stiffness ==
          near(1.5 * alone.axial_stiffness).epsilon(1e-12));
  }
}

}  // namespace composite_support_test
