// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>
#include <voussoir/design/realisations.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace realisations_test {

using namespace voussoir;
using voussoir_test::degree;

TEST_SUITE("design/realisations") {
  TEST_CASE("one outcome for every seed, in their order, whatever the number of threads") {
    const auto square = [](std::uint64_t seed) { return static_cast<double>(seed * seed); };
    const std::vector<double> expected{49, 64, 81, 100};
    for (const unsigned threads : {1U, 3U, 9U})
      CHECK(realise({.count = 4, .first_seed = 7, .threads = threads}, square) == expected);
    CHECK_THROWS_AS(realise({.count = 0}, square), InvalidInput);
    CHECK_THROWS_AS(realise({.count = 1001}, square), InvalidInput);
  }

  TEST_CASE("progress is told the part that is done, and can stop") {
    std::vector<double> told;
    const auto listen = [&](double part) {
      told.push_back(part);
      return part < 0.5;
    };
    int begun = 0;
    const auto run = [&](std::uint64_t) { return ++begun; };
    CHECK_THROWS_AS(realise({.count = 4}, run, listen), Stopped);
    CHECK(told == std::vector<double>{0.25, 0.5});
    CHECK(begun == 2);
  }

  TEST_CASE("mean, its confidence, and what five sound tunnels say of the sixth") {
    RealisedQuantity crown;
    for (const double value : {1e-3, 2e-3, 3e-3}) crown.add(Verdict::stable, 0, value);
    CHECK(crown.mean() == voussoir_test::near(2e-3));
    CHECK(crown.deviation() == voussoir_test::near(1e-3));
    // Student's t of two degrees of freedom, 97.5 %: 4.302653 (printed tables).
    const double half = 4.302653e-3 / std::sqrt(3.0);
    CHECK(crown.confidence().low == voussoir_test::near(2e-3 - half).epsilon(1e-6));
    CHECK(crown.confidence().high == voussoir_test::near(2e-3 + half).epsilon(1e-6));
    crown.add(Verdict::stable, 0.3, 2e-3);
    crown.add(Verdict::stable, 0, std::numeric_limits<double>::quiet_NaN());
    CHECK(crown.complete() == false);
    CHECK(crown.shedding == 1);
    CHECK(crown.gone == 1);
    CHECK(crown.collapse_share() == 0);
    // None of n: the upper end p leaves (1 - p)^n = 2.5 %.
    CHECK(crown.collapse_interval().low == 0);
    CHECK(crown.collapse_interval().high == voussoir_test::near(1 - std::pow(0.025, 0.2)));
    crown.add(Verdict::collapse, 20, 1);
    crown.add(Verdict::undecided, 0, 1);
    CHECK(crown.collapsed == 2);
    CHECK(crown.samples == 7);
    CHECK(crown.mean() == voussoir_test::near(2e-3));
    CHECK(crown.text(1e3, "mm") ==
          "2.00 ± 0.82 mm (7 realisations; 2 collapsed; 1 have lost that rock; 1 shed rock)");
  }

  TEST_CASE("one value has no confidence, and says what to do") {
    RealisedQuantity one;
    one.add(Verdict::stable, 0, 1);
    CHECK(one.deviation() == 0);
    CHECK_THROWS_AS((void)one.confidence(), InvalidInput);
    CHECK(one.text(1, "") == "1.00 (1 realisation)");
  }

  TEST_CASE("tunnels in three realisations are those that are run one by one") {
    const SimplePolygon opening = circular_opening(5, 36);
    const auto crown = [&](std::uint64_t seed) {
      Solver<> tunnel(voussoir_test::jointed_rock(domain_around(opening, 20, 7, 7), seed),
                      CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700});
      Construction<Solver<>> plan;
      plan.add_stage("excavation", 0.5).excavate(opening);
      return construct(tunnel, plan).stages.back().convergence.crown;
    };
    const std::vector<double> together = realise({.count = 3, .threads = 2}, crown);
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      CHECK(together[static_cast<std::size_t>(seed - 1)] == crown(seed));
    CHECK(together[0] != together[1]);
  }
}

}  // namespace realisations_test
