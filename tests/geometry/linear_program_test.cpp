// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/linear_program.hpp>

#include "support/dense_algebra.hpp"

namespace linear_program_test {

using namespace voussoir;

namespace {

template <int N>
using Point = Eigen::Matrix<double, N, 1>;

template <int N>
double excess(const Point<N>& x, const std::vector<LinearConstraint<N>>& constraints) {
  double worst = -std::numeric_limits<double>::infinity();
  for (const auto& c : constraints) worst = std::max(worst, c.normal.dot(x) - c.offset);
  return worst;
}

/// Best feasible corner among the meeting points of all N-tuples of constraints.
template <int N>
std::optional<double> best_corner(const Point<N>& objective,
                                  const std::vector<LinearConstraint<N>>& constraints) {
  std::optional<double> best;
  std::vector<std::size_t> pick(N);
  const auto search = [&](const auto& self, std::size_t depth, std::size_t from) -> void {
    if (depth == N) {
      Eigen::MatrixXd a(N, N);
      Eigen::VectorXd b(N);
      for (std::size_t k = 0; k < N; ++k) {
        a.row(static_cast<Eigen::Index>(k)) = constraints[pick[k]].normal.transpose();
        b[static_cast<Eigen::Index>(k)] = constraints[pick[k]].offset;
      }
      const auto corner = voussoir_test::solve_if_regular(a, b);
      if (!corner) return;
      const Point<N> x = *corner;
      if (excess<N>(x, constraints) <= 1e-9)
        best = std::max(best.value_or(-1e300), objective.dot(x));
      return;
    }
    for (std::size_t k = from; k < constraints.size(); ++k) {
      pick[depth] = k;
      self(self, depth + 1, k + 1);
    }
  };
  search(search, 0, 0);
  return best;
}

template <int N>
std::vector<LinearConstraint<N>> box(double half) {
  std::vector<LinearConstraint<N>> sides;
  for (int k = 0; k < N; ++k) {
    sides.push_back({Point<N>::Unit(k), half});
    sides.push_back({-Point<N>::Unit(k), half});
  }
  return sides;
}

template <int N>
Point<N> random_direction(Random& random) {
  Point<N> v;
  for (int k = 0; k < N; ++k) v[k] = random.normal();
  return v.normalized();
}

}  // namespace

TEST_SUITE("geometry/linear_program") {
  TEST_CASE("a corner known by hand: x + y under x + 2 y <= 4, 3 x + y <= 6") {
    // The lines meet at (8/5, 6/5).
    const auto best =
        maximise<2>({1, 1}, {{{1, 2}, 4}, {{3, 1}, 6}, {{-1, 0}, 0}, {{0, -1}, 0}}, 100);
    REQUIRE(best.has_value());
    CHECK((*best - Point<2>(1.6, 1.2)).norm() < 1e-14);
  }

  TEST_CASE("constraints that contradict each other have no solution") {
    CHECK_FALSE(maximise<1>(Point<1>(1), {{Point<1>(1), 1}, {Point<1>(-1), -2}}, 100).has_value());
    CHECK_FALSE(maximise<2>({1, 0}, {{{0, 1}, 1}, {{0, -1}, -2}}, 100).has_value());
    CHECK_FALSE(maximise<2>({1, 0}, {{{1, 1}, 0}, {{-1, 0}, -1}, {{0, -1}, -1}}, 100).has_value());
    CHECK_FALSE(maximise<3>({0, 0, 1},
                            {{{1, 1, 1}, -1}, {{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{0, 0, -1}, 0}},
                            100)
                    .has_value());
    CHECK_FALSE(maximise<2>({1, 0}, {{{0, 0}, -1}}, 100).has_value());    // 0 <= -1
    CHECK_FALSE(maximise<2>({1, 0}, {{{1, 0}, -200}}, 100).has_value());  // outside the bound
  }

  TEST_CASE("a problem without a finite maximum stops at the bound") {
    const auto free = maximise<2>({1, -1}, {}, 7);
    REQUIRE(free.has_value());
    CHECK(*free == Point<2>(7, -7));
    const auto half = maximise<2>({1, 1}, {{{1, -1}, 0}}, 7);  // x <= y
    REQUIRE(half.has_value());
    CHECK((*half - Point<2>(7, 7)).norm() < 1e-14);
    // A constraint that holds everywhere changes nothing.
    CHECK(maximise<2>({1, -1}, {{{0, 0}, 1}}, 7) == Point<2>(7, -7));
  }

  TEST_CASE("a constraint that cuts off very little is obeyed all the same") {
    for (const double cut : {1e-3, 1e-6, 1e-9, 1e-12}) {
      CAPTURE(cut);
      // First x <= 1 and y <= 1, then a bevel of the corner (1, 1): the best of x + y is 2 - cut.
      const auto best = maximise<2>({1, 1}, {{{1, 0}, 1}, {{0, 1}, 1}, {{1, 1}, 2 - cut}}, 10);
      REQUIRE(best.has_value());
      CHECK(std::abs(best->sum() - (2 - cut)) < 1e-14 * 10);  // the tolerance: 1e-14 of the bound
    }
  }

  TEST_CASE("an objective along a face gives a point of that face") {
    const auto best = maximise<2>({0, 1}, {{{0, 1}, 1}, {{1, 0}, 3}, {{-1, 0}, 3}}, 100);
    REQUIRE(best.has_value());
    CHECK(best->y() == 1);
    CHECK(std::abs(best->x()) <= 3);
  }

  TEST_CASE_TEMPLATE("random problems agree with the best of all corners", Dim,
                     std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
    constexpr int N = Dim::value;
    Random random(1);
    int solved = 0, refused = 0;
    for (int trial = 0; trial < 300; ++trial) {
      CAPTURE(trial);
      auto constraints = box<N>(10);
      const int extra = 1 + trial % 6;
      // Offsets of both signs: some problems have no solution.
      for (int k = 0; k < extra; ++k)
        constraints.push_back({random_direction<N>(random), 4 * random.normal() + 2});
      random.shuffle(constraints);
      const Point<N> objective = random_direction<N>(random);
      const auto found = maximise<N>(objective, constraints, 20);
      const auto expected = best_corner<N>(objective, constraints);
      REQUIRE(found.has_value() == expected.has_value());
      if (!found) {
        ++refused;
        continue;
      }
      ++solved;
      // Corners of random lines are conditioned up to about 1e3; lengths up to 20.
      CHECK(std::abs(objective.dot(*found) - *expected) < 1e-11);
      CHECK(excess<N>(*found, constraints) < 1e-11);
    }
    CHECK(solved > 100);
    CHECK(refused > 10);
  }

  TEST_CASE_TEMPLATE("constraints repeated but for rounding change nothing", Dim,
                     std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
    constexpr int N = Dim::value;
    Random random(2);
    for (int trial = 0; trial < 500; ++trial) {
      CAPTURE(trial);
      auto constraints = box<N>(10);
      for (int k = 0; k < 4; ++k)
        constraints.push_back({random_direction<N>(random), 5 * random.uniform() + 0.1});
      const Point<N> objective = random_direction<N>(random);
      const auto once = maximise<N>(objective, constraints, 20);
      REQUIRE(once.has_value());  // the origin is feasible
      auto twice = constraints;
      for (auto c : constraints) {
        for (int k = 0; k < N; ++k) c.normal[k] *= 1 + 2e-16 * random.normal();
        c.offset *= 1 + 2e-16 * random.normal();
        twice.push_back(c);
      }
      random.shuffle(twice);
      const auto again = maximise<N>(objective, twice, 20);
      REQUIRE(again.has_value());
      CHECK(std::abs(objective.dot(*again) - objective.dot(*once)) < 1e-11);
      CHECK(excess<N>(*again, constraints) < 1e-11);
    }
  }
}

}  // namespace linear_program_test
