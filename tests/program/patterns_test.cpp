// SPDX-License-Identifier: MIT
// How unsupported tunnels fail: the cases, their names, one short run.
#include "patterns.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "io/xml_check.hpp"
#include "support/near.hpp"

namespace program_patterns_test {

using namespace voussoir::program;

namespace {

const PatternCase& the_case(int number) {
  return pattern_cases()[static_cast<std::size_t>(number - 1)];
}

}  // namespace

TEST_SUITE("program/patterns") {
  TEST_CASE("the table has the paper's counts") {
    // Claims PF-020, PF-021: 9 wedges, 5 slides on the steepest and 1 on the second steepest set,
    // 8 minor falls, 1 without pattern; at the walls 12 slide, 2 topple, 3 both ways (and no. 4,
    // whose second mechanism is another roof fall).
    REQUIRE(pattern_cases().size() == 24);
    int roof[7] = {}, wall[5] = {};
    for (const PatternCase& c : pattern_cases()) {
      CHECK(&c == &the_case(c.number));
      ++roof[static_cast<int>(c.roof)];
      ++wall[static_cast<int>(c.wall)];
    }
    CHECK(roof[static_cast<int>(RoofFall::wedge)] == 9);
    CHECK(roof[static_cast<int>(RoofFall::steepest)] == 5);
    CHECK(roof[static_cast<int>(RoofFall::second_steepest)] == 1);
    CHECK(roof[static_cast<int>(RoofFall::minor)] == 8);
    CHECK(roof[static_cast<int>(RoofFall::mixed)] == 1);
    CHECK(wall[static_cast<int>(WallFailure::sliding)] == 12);
    CHECK(wall[static_cast<int>(WallFailure::toppling)] == 2);
    CHECK(wall[static_cast<int>(WallFailure::both_ways)] == 3);
  }

  TEST_CASE("a short run of a case is the same whenever it is made, and keeps its energy") {
    const PatternOptions options{.duration = 0.2};
    const PatternResult first = run_pattern(the_case(8), 1, options),
                        second = run_pattern(the_case(8), 1, options);
    CHECK(first.note.empty());
    CHECK(first.blocks > 1000);
    CHECK(first.stages.size() == 4);
    CHECK(first.time == voussoir_test::near(0.2));
    CHECK(std::abs(first.imbalance) < 0.01);
    REQUIRE(first.stages.size() == second.stages.size());
    CHECK(first.stages.back().outlines == second.stages.back().outlines);
    // 65W and 75E are 40 degrees apart, 55E and 65W are 60.
    CHECK(first.widest_pair == std::array<int, 2>{1, 2});
    CHECK(xml_fault(pattern_svg(first)) == "");
    CHECK(xml_fault(patterns_sheet({first, second})) == "");
    const std::string table = patterns_csv({first});
    CHECK(table.find("8,1,") != std::string::npos);
  }

  TEST_CASE("a wedge that slides on one of its planes is still that wedge") {
    PatternResult result;
    result.widest_pair = {1, 2};
    result.roof = RoofFall::wedge;
    CHECK(roof_agrees(the_case(8), result));
    result.roof = RoofFall::second_steepest;  // C, 65W
    CHECK(roof_agrees(the_case(8), result));
    result.roof = RoofFall::steepest;  // A, 75E: not of the pair
    CHECK(!roof_agrees(the_case(8), result));
    result.roof = RoofFall::minor;
    CHECK(!roof_agrees(the_case(8), result));
    CHECK(roof_agrees(the_case(7), result));
    result.wall = WallFailure::both_ways;
    CHECK(wall_agrees(the_case(3), result));
    CHECK(!wall_agrees(the_case(2), result));
  }
}

}  // namespace program_patterns_test
