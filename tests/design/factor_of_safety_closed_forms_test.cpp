// SPDX-License-Identifier: MIT
// The factor of safety of blocks in a roof under horizontal stress, wedges in 2-D and pyramids in
// 3-D, by every procedure: friction over that at which Crawford and Bray's block falls.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>
#include <voussoir/design/factor_of_safety.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>

#include "support/near.hpp"
#include "support/roof_blocks.hpp"

namespace factor_of_safety_closed_forms_test {

using namespace voussoir;
using namespace voussoir::design;
using namespace voussoir_test;

namespace {

/// What is at rest lacks no more of its weight than a tenth of the bracket's width, as in
/// `factor_of_safety`.
template <class Method, class System>
TrialOutcome outcome_of(System system, double width) {
  SearchContext context;
  context.acceptance.unbalance_over_weight = 0.1 * width;
  const EquilibriumReport report = Method{}.find(system, context);
  const bool stands = report.verdict == Verdict::stable && report.fallen.empty();
  return stands                                 ? TrialOutcome::stands
         : report.verdict == Verdict::undecided ? TrialOutcome::undecided
                                                : TrialOutcome::falls;
}

/// Both ends of the bracket, within 1 %.
void check_factor(const FactorBracket& bracket, double expected) {
  CAPTURE(expected);
  REQUIRE(bracket.is_closed());
  CHECK_FALSE(bracket.has_undecided());
  CHECK(bracket.stands == near(expected).epsilon(0.01));
  CHECK(bracket.falls == near(expected).epsilon(0.01));
}

constexpr double width = 5e-3;

}  // namespace

TEST_SUITE("design/factor_of_safety_closed_forms") {
  TEST_CASE_TEMPLATE_DEFINE("a wedge in a roof", Method, wedges) {
    CAPTURE(std::string(Method::name));
    for (const RoofWedge& c :
         {RoofWedge{"", 20, 50, 5e9, 5e8, 1e6}, RoofWedge{"", 15, 45, 5e9, 5e8, 1e6},
          RoofWedge{"", 30, 60, 1e10, 1e9, 5e5}, RoofWedge{"", 20, 50, 5e9, 5e9, 1e6}}) {
      CAPTURE(c.semi_apical);
      const double load = 0.3 * c.thrust, full = std::tan(c.friction * degree);
      const FactorBracket bracket = bracket_factor(
          [&](double factor) {
            RoofWedge weaker = c;
            weaker.friction = std::atan(full / factor) / degree;
            return outcome_of<Method>(roof_wedge(weaker, load), width);
          },
          {.width = width});
      check_factor(bracket, full / c.tan_of_friction(load));
    }
  }
  TEST_CASE_TEMPLATE_APPLY(wedges, std::tuple<TwoLevel, Relaxation, Explicit>);

  TEST_CASE_TEMPLATE_DEFINE("pyramids of three to six faces in a roof", Method, pyramids) {
    CAPTURE(std::string(Method::name));
    const std::vector<RoofPyramid> drawn = roof_pyramids();
    for (std::size_t number = 0; number < 8; ++number) {
      CAPTURE(number);
      const RoofPyramid& pyramid = drawn[number];
      const double strength = 1.7;  // of what it needs
      const FactorBracket bracket = bracket_factor(
          [&](double factor) {
            return outcome_of<Method>(pyramid.system(strength / factor * pyramid.tan_of_friction()),
                                      width);
          },
          {.width = width});
      check_factor(bracket, strength);
    }
  }
  TEST_CASE_TEMPLATE_APPLY(pyramids, std::tuple<TwoLevel, Relaxation, Explicit>);
}

}  // namespace factor_of_safety_closed_forms_test
