// SPDX-License-Identifier: MIT
// The interior point against a dense simplex on random programmes of forces between bodies.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
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

/// Forces with friction between bodies in 3-D, some with cohesion and tension, and columns of every
/// row that cost 1.
/// @param facets  of a pyramid inside every cone, in its place; 0: cones
LinearProgramme random_cones(int number, int bodies, int contacts, int facets = 0) {
  Random random(static_cast<std::uint64_t>(number), 11);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  LinearProgramme programme;
  for (int i = 0; i < 6 * bodies; ++i) programme.right.push_back(between(-1, 1));
  for (int k = 0; k < contacts; ++k) {
    const int a = static_cast<int>(random.below(static_cast<unsigned>(bodies))),
              b = static_cast<int>(random.below(static_cast<unsigned>(bodies)));
    double entries[3][12];
    for (auto& column : entries)
      for (double& entry : column) entry = between(-1, 1);
    const double slope = between(0.1, 1.5), bond = k % 3 == 0 ? between(0, 0.3) : 0.0,
                 low = -bond * between(0, 1) / slope, high = k % 2 == 0 ? between(0.1, 1) : endless;
    const auto add = [&](const auto& mix) {
      for (int d = 0; d < 6; ++d) programme.add(6 * a + d, mix(d));
      if (b != a)
        for (int d = 6; d < 12; ++d) programme.add(6 * b + d - 6, mix(d));
    };
    if (facets == 0) {
      programme.cones.push_back({programme.columns(), slope, bond});
      for (int c = 0; c < 3; ++c) {
        add([&](int d) { return entries[c][d]; });
        programme.close_column(0, c == 0 ? low : -endless, c == 0 ? high : endless);
      }
    } else {
      // N and a point of the pyramid over it are positive parts of its edges; a bond adds some of a
      // disc's corners, no more than all of it in sum: without bond alone, to keep it simple.
      for (int f = 0; f < facets; ++f) {
        const double angle = 2 * std::numbers::pi * f / facets;
        add([&](int d) {
          return entries[0][d] +
                 slope * (std::cos(angle) * entries[1][d] + std::sin(angle) * entries[2][d]);
        });
        programme.close_column(0, 0, endless);
      }
    }
  }
  for (int row = 0; row < 6 * bodies; ++row)
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

  TEST_CASE("with cones of friction the answer proves itself too") {
    // The proof is by weak duality, of x and y alone: what found them has no part in it.
    const InteriorPoint<6> solver;
    for (int number = 1; number <= 60; ++number) {
      CAPTURE(number);
      const LinearProgramme programme = random_cones(number, 1 + number % 7, 3 * number);
      const LinearSolution solution = solver(programme);
      REQUIRE(solution.is_solved);
      const LinearProof proof = proof_of(programme, solution);
      CHECK(proof.gap() <= 3e-8 * std::max(1.0, proof.cost));
      CHECK(proof.gap() >= -3e-8);
      CHECK(proof.row_fault <= 1e-8);
      CHECK(proof.bound_fault <= 1e-12);
      CHECK(proof.price_fault <= 1e-8);
      CHECK(solution.steps <= 40);
    }
  }

  TEST_CASE("a cone is what pyramids inside it tend to") {
    for (int number = 1; number <= 10; ++number) {
      CAPTURE(number);
      LinearProgramme round = random_cones(number, 3, 8);
      for (FrictionCone& cone : round.cones) {  // friction alone, without ends
        cone.offset = 0;
        const auto j = static_cast<std::size_t>(cone.first);
        round.lower[j] = 0;
        round.upper[j] = endless;
      }
      const double least = proof_of(round, InteriorPoint<6>()(round)).cost;
      const auto by_pyramids = [&](int facets) {
        const LinearProgramme flat = random_cones(number, 3, 8, facets);
        return proof_of(flat, InteriorPoint<6>()(flat)).cost;
      };
      const double coarse = by_pyramids(16) - least, fine = by_pyramids(64) - least;
      CHECK(fine >= -1e-7);
      CHECK(coarse >= fine - 1e-7);
      // What a pyramid misses of a cone goes with the square of its angle, 1 / 830 of 1 for 64.
      CHECK(fine <= 3e-3 * least);
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
    const auto refused = [&](const auto& spoil, const char* words) {
      LinearProgramme cones = random_cones(1, 2, 4);
      spoil(cones);
      CHECK_THROWS_WITH_AS((void)InteriorPoint<6>()(cones), doctest::Contains(words), InvalidInput);
    };
    refused([](auto& p) { p.cones[0].first = p.columns() - 2; }, "three columns");
    refused([](auto& p) { p.cones[0].slope = -0.1; }, "slope >= 0");
    refused([](auto& p) { p.lower[static_cast<std::size_t>(p.cones[0].first) + 1] = 0; },
            "no bounds");
    refused([](auto& p) { p.cones[1].slope = p.cones[1].offset = 0; }, "more than a line");
    refused([](auto& p) { p.cones[1] = p.cones[0]; }, "each in one cone");
    refused([](auto& p) { p.cones.pop_back(); }, "a bound below or a cone");
  }
}

}  // namespace interior_point_test
