// SPDX-License-Identifier: MIT
// Strength and modulus of young concrete against hand values, and the ages that stages make.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/concrete_age.hpp>

#include "support/near.hpp"

namespace concrete_age_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;
using voussoir_test::near;

}  // namespace

TEST_SUITE("design/concrete_age") {
  TEST_CASE("EN 1992-1-1, 3.1.2 and 3.1.3, by hand") {
    const ConcreteAge normal{.law = AgeLaw::en1992, .cement = 0.25};
    // 7 days: beta = exp(0.25 (1 - 2)) = 0.7788008; C30: f_cm = 38 MPa, 29.59443 - 8 = 21.59443.
    CHECK(normal.maturity(7 * one_day, 30e6) == near(0.77880078).epsilon(1e-7));
    CHECK(normal.strength_at(7 * one_day, 30e6) == near(21.59443e6).epsilon(1e-6));
    CHECK(normal.modulus_part(7 * one_day, 30e6) == near(std::exp(-0.075)).epsilon(1e-12));
    CHECK(normal.strength_at(28 * one_day, 30e6) == 30e6);
    CHECK(normal.strength_at(365 * one_day, 30e6) == 30e6);  // nothing is gained later
    CHECK(normal.modulus_part(365 * one_day, 30e6) == 1);
    // Class S, C10 at 3 days: exp(0.38 (1 - 3.05505)) = 0.457985 x 18 - 8 = 0.24373 MPa.
    const ConcreteAge slow{.law = AgeLaw::en1992, .cement = 0.38};
    CHECK(slow.strength_at(3 * one_day, 10e6) == near(0.24373e6).epsilon(2e-5));
    CHECK_THROWS_WITH_AS((void)slow.maturity(2.9 * one_day, 10e6), doctest::Contains(">= 3 d"),
                         InvalidInput);
  }

  TEST_CASE("Chang and Stille by hand") {
    const ConcreteAge shotcrete{};
    // A day: 1.105 exp(-0.743) = 0.5256316, 1.062 exp(-0.446) = 0.6798752.
    CHECK(shotcrete.strength_at(one_day, 40e6) == near(0.5256316 * 40e6).epsilon(1e-6));
    CHECK(shotcrete.modulus_part(one_day, 40e6) == near(0.6798752).epsilon(1e-6));
    // 7 days: 7^-0.7 = 0.256104, 1.105 exp(-0.190285) = 0.913523; 7^-0.6 = 0.311129, 0.924401.
    CHECK(shotcrete.strength_at(7 * one_day, 1) == near(0.913523).epsilon(1e-5));
    CHECK(shotcrete.modulus_part(7 * one_day, 1) == near(0.924401).epsilon(1e-5));
    CHECK(shotcrete.strength_at(28 * one_day, 30e6) == 30e6);  // 1.028 of it, which is not counted
    CHECK(shotcrete.modulus_part(28 * one_day, 30e6) == near(0.99975).epsilon(1e-5));
    double before = 0;
    for (double hours = 1; hours < 1000; hours *= 1.3) {
      const double now = shotcrete.strength_at(hours * one_day / 24, 30e6);
      CHECK(now >= before);
      before = now;
    }
    ConcreteAge constant = shotcrete;
    constant.has_growing_modulus = false;
    CHECK(constant.modulus_part(one_day, 40e6) == 1);
  }

  TEST_CASE("tested strengths: at their ages, over the logarithm between, to f_ck at 28 days") {
    const ConcreteAge tested{
        .law = AgeLaw::tested,
        .tests = {{0.25 * one_day, 4e6}, {one_day, 12e6}, {7 * one_day, 24e6}}};
    CHECK(tested.strength_at(0.25 * one_day, 30e6) == near(4e6).epsilon(1e-12));
    CHECK(tested.strength_at(0.5 * one_day, 30e6) == near(8e6).epsilon(1e-12));  // half of log 4
    CHECK(tested.strength_at(one_day, 30e6) == near(12e6).epsilon(1e-12));
    CHECK(tested.strength_at(14 * one_day, 30e6) == near(27e6).epsilon(1e-12));  // half of log 4
    CHECK(tested.strength_at(28 * one_day, 30e6) == near(30e6).epsilon(1e-12));
    CHECK(tested.modulus_part(one_day, 30e6) == near(std::pow(0.4, 0.3)).epsilon(1e-12));
    CHECK(tested.strength_at(7 * one_day, 20e6) == 20e6);  // a mix that is better than asked for
    CHECK_THROWS_AS((void)tested.strength_at(0.2 * one_day, 30e6), InvalidInput);
    CHECK_THROWS_AS((void)ConcreteAge{.law = AgeLaw::tested}.maturity(one_day, 30e6), InvalidInput);
  }

  TEST_CASE("a young section: compression by the law, tension and fibres by maturity") {
    ConcreteSection section{.thickness = 0.2, .strength = 30e6, .fibre_strength = 1e6};
    const ConcreteAge age{.law = AgeLaw::en1992, .cement = 0.25};
    const ConcreteSection young = age.aged(section, 7 * one_day);
    CHECK(young.strength == near(21.59443e6).epsilon(1e-6));
    // 0.7 x 0.3 x 30^(2/3) = 2.0275277 MPa, EN 1992-1-1, 3.1.2(9) with alpha = 1.
    CHECK(young.characteristic_tension() == near(0.77880078 * 2.0275277e6).epsilon(1e-6));
    CHECK(young.fibre_strength == near(0.77880078e6).epsilon(1e-7));
    CHECK(age.aged(section, 28 * one_day).tensile_strength == section.tensile_strength);
  }

  TEST_CASE("ages are those at which stages load: when installed, then what stages have lasted") {
    AnalysisInput input;
    input.linings.resize(3);
    for (LiningInput& lining : input.linings) lining.thickness = 0.2;
    input.linings[0].age = ConcreteAge{.when_loaded = one_day};
    input.linings[2].age = ConcreteAge{.when_loaded = 3 * one_day};
    input.stages = {{.name = "a", .wall_traction = 0.5, .duration = 2 * one_day, .linings = {0}},
                    {.name = "b", .duration = 4 * one_day, .linings = {1, 2}},
                    {.name = "c"}};
    const auto stages = planned_stages(input, {{}, 0.2});
    REQUIRE(stages.size() == 3);
    CHECK(lining_ages(stages, 0) == std::vector<double>{one_day});
    const auto second = lining_ages(stages, 1), last = lining_ages(stages, 2);
    REQUIRE(last.size() == 3);
    CHECK(second[0] == 3 * one_day);
    CHECK(second[2] == 3 * one_day);
    CHECK(last[0] == 7 * one_day);
    CHECK(std::isinf(last[1]));
    CHECK(last[2] == 7 * one_day);
    // Of the first lining, left out, nothing ages.
    CHECK(lining_ages(planned_stages(input, {{}, 0}), 2).size() == 2);
  }
}

}  // namespace concrete_age_test
