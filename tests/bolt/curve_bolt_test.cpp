// SPDX-License-Identifier: MIT
// Bolts by a curve: bonded cables at a joint, bolts held by their ends, bolts that yield until they
// are used up; by hand, against the pull-out test, and every law through its check.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/bolt/any_bolt.hpp>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/check_bolt_law.hpp>
#include <voussoir/bolt/curve_bolt.hpp>
#include <voussoir/theory/pull_out.hpp>

#include "support/near.hpp"

namespace curve_bolt_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

/// A strand of 15.2 mm, and what it bears.
constexpr double rigidity = 181e-6 * 98.6e9, bond = 0.175e6;
const BondedBolt strand{rigidity, 112e6, bond};

template <class Law>
double pulled(const Law& law, double extension, const typename Law::State& state = {}) {
  return law.force(BoltSpan<2>{{0.5, 0}, {1, 0}, {extension, 0}}, state).axial;
}
template <class Law>
bool reach(const Law& law, double extension, typename Law::State& state) {
  return law.commit(BoltSpan<2>{{0.5, 0}, {1, 0}, {extension, 0}}, state);
}

}  // namespace

TEST_SUITE("bolt/curve_bolt") {
  TEST_CASE("a cable opens a joint by what it slips out of both sides") {
    // Each side alone is a pull-out test; the bolt carries what the weaker bears: 175 kN over 1 m.
    const auto law = CurveBolt(strand).at_joint({1.0, 2.5});
    REQUIRE(law);
    const PullOut head({rigidity, 112e6, bond, 1.0}), tip({rigidity, 112e6, bond, 2.5});
    CHECK(law->curve().stiffness() ==
          near(1 / (1 / head.head_stiffness() + 1 / tip.head_stiffness())).epsilon(1e-12));
    CHECK(law->curve().strength() == near(bond * 1.0).epsilon(1e-12));
    for (const double force : {20e3, 68e3, 80e3, 120e3, 160e3, 174.9e3}) {
      const double opening = head.at_force(force).displacement + tip.at_force(force).displacement;
      CHECK(pulled(*law, opening) == near(force).epsilon(1e-3));  // chords of the curve
    }
    // Beyond that it slips through and holds.
    CHECK(pulled(*law, 0.3) == near(bond).epsilon(1e-12));
    // In the middle of a long cable: half of sqrt(k_b E A), 22.35 MN/m.
    CHECK(CurveBolt(strand).curve().stiffness() ==
          near(0.5 * std::sqrt(112e6 * rigidity)).epsilon(1e-6));
    // A plate at the head: bond and plate hold that side, 175 + 60 kN.
    BondedBolt plated = strand;
    plated.plate_strength = 60e3;
    CHECK(CurveBolt(plated).at_joint({1.0, 2.5})->curve().strength() ==
          near(bond + 60e3).epsilon(1e-12));
  }

  TEST_CASE("the strength of a joint is that of the bond, to the last digit, wherever it is") {
    // What is checked is worked out apart, and nothing may be above it.
    for (int k = 1; k < 400; ++k) {
      const double before = 0.01 * k, after = 4 - before;
      CHECK(CurveBolt(strand).at_joint({before, after})->curve().strength() ==
            std::min(bond * before, bond * after));
    }
    // Next to nothing is bonded: it holds next to nothing.
    CHECK(CurveBolt(strand).at_joint({1e-9, 4})->curve().strength() == bond * 1e-9);
  }

  TEST_CASE("let go a cable that has slipped keeps its slip") {
    const CurveBolt law = *CurveBolt(strand).at_joint({1.0, 2.5});
    const double stiffness = law.curve().stiffness(), far = 8e-3;
    const double force = pulled(law, far), slip = far - force / stiffness;
    CurveBolt::State state;
    CHECK(!reach(law, far, state));
    CHECK(pulled(law, far, state) == near(force).epsilon(1e-12));
    CHECK(pulled(law, far - 1e-3, state) == near(force - 1e-3 * stiffness).epsilon(1e-12));
    CHECK(pulled(law, 0.9 * slip, state) == 0);
    CHECK(pulled(law, 0.0, state) == 0);
    CHECK(pulled(law, 1.1 * far, state) == near(pulled(law, 1.1 * far)).epsilon(1e-12));
    const BoltReport report = law.describe(BoltSpan<2>{{0.5, 0}, {1, 0}, {0, 0}}, state);
    CHECK(report.plastic_extension == near(slip).epsilon(1e-12));
    CHECK(report.has_yielded());
    CHECK(!law.describe(BoltSpan<2>{{0.5, 0}, {1, 0}, {1e-3, 0}}, {}).has_yielded());
  }

  TEST_CASE("a bolt held by its ends is one spring, and gives where the least gives") {
    // 3 m of a 20 mm bar, 314.16 mm2 x 200 GPa / 3 m = 20.94 MN/m, on an anchor of 25 MN/m:
    // 11.40 MN/m.
    const double bar = 314.16e-6 * 200e9;
    EndAnchoredBolt bolt{bar, 25e6, 90e3, 120e3};
    const BoltJoint joint{0.4, 2.6};
    const CurveBolt law = *CurveBolt(bolt).at_joint(joint);
    const double stiffness = 1 / (3 / bar + 1 / 25e6);
    CHECK(stiffness == near(11.395e6).epsilon(1e-3));
    CHECK(pulled(law, 5e-3) == near(5e-3 * stiffness).epsilon(1e-12));
    CHECK(pulled(law, 50e-3) == 90e3);  // the anchor slips
    // A plate weaker than that: lost there.
    bolt.plate_strength = 80e3;
    const CurveBolt weak = *CurveBolt(bolt).at_joint(joint);
    CurveBolt::State state;
    CHECK(!reach(weak, 0.99 * 80e3 / stiffness, state));
    CHECK(reach(weak, 1.01 * 80e3 / stiffness, state));
    CHECK(pulled(weak, 5e-3, state) == 0);
    // A bar that yields first: 2 % of the stiffness is left, as that of AxialBolt.
    bolt.strength.yield_force = 60e3;
    const CurveBolt yields = *CurveBolt(bolt).at_joint(joint);
    const AxialBolt same(
        {.axial_stiffness = stiffness, .yield_force = 60e3, .rupture_force = 80e3});
    for (const double extension : {2e-3, 6e-3, 20e-3, 60e-3})
      CHECK(pulled(yields, extension) == near(pulled(same, extension)).epsilon(1e-9));
    // Pretensioned it starts there.
    const CurveBolt taut = *CurveBolt(bolt, 30e3).at_joint(joint);
    CHECK(pulled(taut, 0.0) == near(30e3).epsilon(1e-12));
    CHECK(pulled(taut, 1e-3) == near(30e3 + 1e-3 * stiffness).epsilon(1e-12));
  }

  TEST_CASE("a yielding bolt holds its plateau until its elongation is used up") {
    // 40 MN/m to 120 kN at 3 mm, then 50 mm more: 120 x (1.5 + 50) mm = 6.18 kJ.
    const BarStrength strength{.yield_force = 120e3, .rupture_extension = 0.05};
    const CurveBolt law(strength.limited(BoltCurve::straight(40e6)));
    CHECK(pulled(law, 1e-3) == near(40e3).epsilon(1e-12));
    CHECK(pulled(law, 20e-3) == near(120e3).epsilon(1e-12));
    CurveBolt::State state;
    CHECK(!reach(law, 52.9e-3, state));
    CHECK(pulled(law, 52.9e-3, state) == near(120e3).epsilon(1e-12));
    CHECK(reach(law, 53.1e-3, state));
    CHECK(pulled(law, 20e-3, state) == 0);
    CHECK(law.energy(BoltSpan<2>{{0.5, 0}, {1, 0}, {0, 0}}, state) ==
          near(120e3 * 51.5e-3).epsilon(1e-9));
    // To a rupture force: straight on to it.
    const CurveBolt stronger(
        BarStrength{.yield_force = 120e3, .rupture_force = 170e3, .rupture_extension = 0.05}
            .limited(BoltCurve::straight(40e6)));
    CHECK(pulled(stronger, 28e-3) == near(145e3).epsilon(1e-9));
    CHECK(pulled(stronger, 52.999e-3) == near(170e3).epsilon(1e-4));
  }

  TEST_CASE("its law is sound, whatever it is made of") {
    BondedBolt yielding = strand;
    yielding.plate_strength = 50e3;
    yielding.strength = {.yield_force = 130e3, .rupture_extension = 0.02};
    const std::vector<CurveBolt> laws{
        CurveBolt(strand), *CurveBolt(strand, 20e3).at_joint({0.5, 3}),
        *CurveBolt(yielding, 30e3).at_joint({1, 2}),
        CurveBolt(EndAnchoredBolt{12e7, 9e7, 9e4, 8e4}),
        CurveBolt(BoltCurve({{1e-3, 4e4}, {4e-3, 9e4}, {2e-2, 1e5}}, 1e5), 1e4)};
    const BoltLawTrial trial{.paths =
                                 40};  // of 15 kinds in all; 200 of each take a third of a minute
    for (const CurveBolt& law : laws) {
      for (const auto& findings :
           {check_law<2>(law, trial), check_law<3>(law, trial), check_law<2>(AnyBolt(law), trial)})
        for (const std::string& finding : findings) FAIL_CHECK(finding);
    }
  }

  TEST_CASE("pretension that bond does not hold is what it holds") {
    const CurveBolt law = *CurveBolt(strand, 50e3).at_joint({0.1, 2});
    CHECK(pulled(law, 0.0) == near(17.5e3).epsilon(1e-9));
  }

  TEST_CASE("a law is that of the joint, where it depends on it") {
    CHECK(AnyBolt(AxialBolt({.axial_stiffness = 2e8})).at_joint({1, 1}) == std::nullopt);
    CHECK(CurveBolt(BoltCurve::straight(2e8)).at_joint({1, 1}) == std::nullopt);
    const auto made = AnyBolt(CurveBolt(strand)).at_joint({1, 2});
    REQUIRE(made);
    REQUIRE(made->as<CurveBolt>() != nullptr);
    CHECK(made->as<CurveBolt>()->curve().strength() == near(bond).epsilon(1e-12));
  }

  TEST_CASE("values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    using Points = std::vector<BoltCurve::Point>;
    CHECK_THROWS_AS(BoltCurve(Points{}), InvalidInput);
    CHECK_THROWS_AS(BoltCurve(Points{{1e-3, 1e4}, {1e-3, 2e4}}), InvalidInput);
    CHECK_THROWS_AS(BoltCurve(Points{{1e-3, 1e4}, {2e-3, 9e3}}), InvalidInput);
    CHECK_THROWS_AS(BoltCurve(Points{{1e-3, 1e4}, {2e-3, 3e4}}), InvalidInput);  // steeper
    CHECK_THROWS_AS(BoltCurve(Points{{nan, 1e4}}), InvalidInput);
    CHECK_THROWS_AS(BoltCurve::straight(0), InvalidInput);
    CHECK_THROWS_AS(CurveBolt(BoltCurve::straight(1e8), -1), InvalidInput);
    CHECK_THROWS_AS(CurveBolt(BoltCurve::straight(1e8).breaking_at(1e5), 1e5), InvalidInput);
    CHECK_THROWS_AS(CurveBolt(BondedBolt{rigidity, 112e6, 0}), InvalidInput);
    CHECK_THROWS_AS(CurveBolt(EndAnchoredBolt{0}), InvalidInput);
    CHECK_THROWS_AS((BarStrength{.rupture_extension = 0.1}.check()), InvalidInput);
  }
}

}  // namespace curve_bolt_test
