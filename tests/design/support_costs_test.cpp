// SPDX-License-Identifier: MIT
// Quantities and costs of supports: a circle by hand, arcs that add up, prices.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/design/support_costs.hpp>

#include "support/near.hpp"

namespace support_costs_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;
using voussoir_test::near;

constexpr double pi = std::numbers::pi;

/// A circle of 10 m with bolts and a lining.
AnalysisInput circle() {
  AnalysisInput input;
  input.model = {.width = 60, .below_invert = 20};
  input.tunnel.diameter = 10;
  input.tunnel.facets = 720;
  input.tunnel.cover = 20;
  input.bolts.push_back({.name = "bolts",
                         .length = 4,
                         .spacing = {pi / 12, true},
                         .arc = {0, pi},
                         .out_of_plane = 1.6});
  LiningInput& lining = input.linings.emplace_back();
  lining.name = "shell";
  lining.thickness = 0.2;
  lining.concrete =
      ConcreteSection{.thickness = 0.2, .strength = 25e6, .bars = {{.area = 5e-4, .depth = 0.05}}};
  input.stages.push_back({.name = "all", .part = SectionPart{}, .bolts = {0}, .linings = {0}});
  return input;
}

}  // namespace

TEST_SUITE("design/support_costs") {
  TEST_CASE("a circle, by hand") {
    const AnalysisInput input = circle();
    const SupportQuantities q = support_quantities(input, {input.bolts[0].spacing, 0.2});
    // Every 15 degrees from springing to springing.
    const double count =
        static_cast<double>(bars_of_pattern(input, input.bolts[0], input.bolts[0].spacing).size());
    CHECK(count >= 12);
    CHECK(count <= 13);
    CHECK(q.holes == near(count / 1.6).epsilon(1e-12));
    CHECK(q.bolt_length == near(4 * count / 1.6).epsilon(1e-9));
    // A ring of radii 4.8 and 5 m; 720 facets are 3e-6 shorter than the circle.
    CHECK(q.concrete == near(pi * (25 - 4.8 * 4.8)).epsilon(1e-5));
    CHECK(q.steel == near(7850 * 5e-4 * 2 * pi * 4.9).epsilon(1e-5));
    const CostsInput costs{.bolt_per_metre = 12,
                           .bolt_per_hole = 30,
                           .concrete_per_m3 = 350,
                           .rebound = 0.2,
                           .steel_per_kg = 1.5};
    costs.check();
    CHECK(cost_of(costs, q) ==
          near(12 * q.bolt_length + 30 * q.holes + 350 * q.concrete / 0.8 + 1.5 * q.steel)
              .epsilon(1e-12));
    AnalysisInput ribbed = input;
    ribbed.linings[0].ribs = SteelRibs{.area = 34e-4, .spacing = 1.25};
    CHECK(support_quantities(ribbed, {input.bolts[0].spacing, 0.2}).steel - q.steel ==
          near(7850 * 34e-4 / 1.25 * 2 * pi * 4.9).epsilon(1e-5));
    // What is left out costs nothing, and what no stage installs neither.
    const SupportQuantities none = support_quantities(input, {std::nullopt, 0});
    CHECK(cost_of(costs, none) == 0);
    AnalysisInput planned = input;
    planned.stages[0].bolts.clear();
    CHECK(support_quantities(planned, {input.bolts[0].spacing, 0.2}).holes == 0);
  }

  TEST_CASE("arcs add up to the whole outline, wherever they are cut") {
    const AnalysisInput input = circle();
    const SimplePolygon round = outline_of(outline_input(input, 0)),
                        square({Vec2(3, -2), Vec2(3, 2), Vec2(-3, 2), Vec2(-3, -2)});
    Random random(5, 0);
    for (int k = 0; k < 200; ++k) {
      const double from = 2 * pi * (random.uniform() - 0.5), way = 2 * pi * random.uniform();
      CAPTURE(from);
      CAPTURE(way);
      for (const SimplePolygon* outline : {&round, &square}) {
        const double one = length_within(*outline, {from, from + way}),
                     other = length_within(*outline, {from + way, from + 2 * pi});
        CHECK(one + other == near(outline->perimeter()).epsilon(1e-12));
      }
      CHECK(length_within(round, {from, from + way}) == near(5 * way).epsilon(1e-4));
    }
    // The roof and what is beside it, as seen from the centre.
    const double corner = std::atan2(2.0, 3.0);
    CHECK(length_within(square, {corner, pi - corner}) == near(6.0).epsilon(1e-12));
    CHECK(length_within(square, {-corner, corner}) == near(4.0).epsilon(1e-12));
  }

  TEST_CASE("prices that are none are refused") {
    CHECK_THROWS_WITH_AS((CostsInput{.bolt_per_metre = -1}.check()),
                         doctest::Contains("metre of bolt"), InvalidInput);
    CHECK_THROWS_WITH_AS((CostsInput{.concrete_per_m3 = 1, .rebound = 0.95}.check()),
                         doctest::Contains("rebound"), InvalidInput);
    CHECK_THROWS_WITH_AS(CostsInput{}.check(), doctest::Contains("all costs"), InvalidInput);
  }
}

}  // namespace support_costs_test
