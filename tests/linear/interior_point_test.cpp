// SPDX-License-Identifier: MIT
// The interior point against a dense simplex on random programmes of forces between bodies.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/linear/interior_point.hpp>

#include "support/limit_analysis.hpp"
#include "support/near.hpp"

namespace interior_point_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Columns between bodies, some with bounds, and columns of every row that cost 1.
LinearProgramme random_programme(int number, int bodies, int columns) {
  Random random(static_cast<std::uint64_t>(number), 7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  LinearProgramme programme;
  for (int i = 0; i < 3 * bodies; ++i) programme.right.push_back(between(-1, 1));
  for (int j = 0; j < columns; ++j) {
    const int a = static_cast<int>(random.below(static_cast<unsigned>(bodies))),
              b = static_cast<int>(random.below(static_cast<unsigned>(bodies)));
    for (int d = 0; d < 3; ++d) programme.add(3 * a + d, between(-1, 1));
    if (b != a)
      for (int d = 0; d < 3; ++d) programme.add(3 * b + d, between(-1, 1));
    const double low = j % 3 == 0 ? between(-0.5, 0) : 0.0;
    programme.close_column(between(0, 0.2), low, j % 2 == 0 ? low + between(0.1, 1) : endless);
  }
  for (int row = 0; row < 3 * bodies; ++row)
    for (const double sign : {1.0, -1.0}) {
      programme.add(row, sign);
      programme.close_column(1, 0, endless);
    }
  return programme;
}

/// By the tableau, with a row more for every bound from above.
double least_cost(const LinearProgramme& programme) {
  const auto n = static_cast<std::size_t>(programme.columns());
  std::size_t bounds = 0;
  for (const double upper : programme.upper) bounds += std::isfinite(upper) ? 1U : 0U;
  std::vector<std::vector<double>> rows(programme.right.size() + bounds,
                                        std::vector<double>(n + bounds + 1, 0.0));
  for (std::size_t i = 0; i < programme.right.size(); ++i) rows[i].back() = programme.right[i];
  std::vector<double> worth(n + bounds, 0.0);
  double constant = 0;
  std::size_t bound = 0;
  for (std::size_t j = 0; j < n; ++j) {
    worth[j] = -programme.cost[j];
    constant += programme.cost[j] * programme.lower[j];
    for (auto k = static_cast<std::size_t>(programme.start[j]);
         k < static_cast<std::size_t>(programme.start[j + 1]); ++k) {
      auto& row = rows[static_cast<std::size_t>(programme.row[k])];
      row[j] += programme.entry[k];
      row.back() -= programme.entry[k] * programme.lower[j];
    }
    if (!std::isfinite(programme.upper[j])) continue;
    auto& row = rows[programme.right.size() + bound];
    row[j] = row[n + bound] = 1;
    row.back() = programme.upper[j] - programme.lower[j];
    ++bound;
  }
  const auto most = simplex(std::move(rows), worth, n + bounds);
  REQUIRE(most);
  return constant - *most;
}

}  // namespace

TEST_SUITE("linear/interior_point") {
  TEST_CASE("random programmes have the least cost of a dense simplex, and the answer proves it") {
    const InteriorPoint<3> solver;
    for (int number = 1; number <= 30; ++number) {
      CAPTURE(number);
      const LinearProgramme programme = random_programme(number, 2 + number % 7, 5 * number);
      const double expected = least_cost(programme);
      const LinearSolution solution = solver(programme);
      REQUIRE(solution.is_solved);
      const LinearProof proof = proof_of(programme, solution);
      // Within the gap that it stops at, and what the prices are off by times the unknowns.
      CHECK(proof.cost == near(expected).scale(1).epsilon(2e-8));
      CHECK(proof.bound == near(expected).scale(1).epsilon(2e-8));
      CHECK(proof.row_fault <= 1e-8);
      CHECK(proof.bound_fault <= 0);
      CHECK(proof.price_fault <= 1e-8);
    }
  }

  TEST_CASE("asked on which side of a value the least cost lies it stops earlier, and is right") {
    for (int number = 1; number <= 20; ++number) {
      CAPTURE(number);
      const LinearProgramme programme = random_programme(number, 6, 40);
      const double expected = least_cost(programme);
      const LinearSolution whole = InteriorPoint<3>()(programme);
      for (const double part : {0.7, 1.3}) {
        const double asked = part * expected;
        const LinearSolution solution = InteriorPoint<3>({.asked = asked})(programme);
        REQUIRE(solution.is_solved);
        CHECK(solution.steps < whole.steps);
        const LinearProof proof = proof_of(programme, solution);
        if (part < 1)
          CHECK(proof.bound > asked);
        else
          CHECK(proof.cost <= asked);
      }
    }
  }

  TEST_CASE("threads change no bit") {
    const LinearProgramme programme = random_programme(3, 40, 300);
    const LinearSolution one = InteriorPoint<3>()(programme),
                         two = InteriorPoint<3>({.threads = 2})(programme);
    CHECK(one.unknowns == two.unknowns);
    CHECK(one.multipliers == two.multipliers);
  }

  TEST_CASE("programmes that it cannot solve are refused") {
    LinearProgramme programme = random_programme(1, 2, 4);
    programme.right.push_back(0);
    CHECK_THROWS_WITH_AS((void)InteriorPoint<3>()(programme), doctest::Contains("rows"),
                         InvalidInput);
    LinearProgramme three = random_programme(1, 3, 4);
    for (const int row : {0, 3, 6}) three.add(row, 1);
    three.close_column(1, 0, endless);
    CHECK_THROWS_WITH_AS((void)InteriorPoint<3>()(three), doctest::Contains("two bodies"),
                         InvalidInput);
    LinearProgramme open = random_programme(1, 3, 4);
    open.lower[1] = -endless;
    CHECK_THROWS_WITH_AS((void)InteriorPoint<3>()(open), doctest::Contains("bound below"),
                         InvalidInput);
    CHECK_THROWS_AS(
        (void)InteriorPoint<3>()(random_programme(1, 3, 4), [](double) { return false; }), Stopped);
  }
}

}  // namespace interior_point_test
