// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>
#include <voussoir/drawing/contour.hpp>
#include <voussoir/drawing/smooth_grid.hpp>

#include "support/near.hpp"

namespace contour_test {

using namespace voussoir;

namespace {

ContourGrid sampled(const std::vector<double>& x, const std::vector<double>& y,
                    const std::function<double(double, double)>& f) {
  ContourGrid grid{x, y, Eigen::MatrixXd(x.size(), y.size())};
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < y.size(); ++j) {
      grid.value(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = f(x[i], y[j]);
    }
  }
  return grid;
}

/// Holes turn the other way and count negative.
double area(const Contour& contour) {
  double sum = 0;
  for (const auto& loop : contour.region) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += cross(loop[i], loop[(i + 1) % loop.size()]) / 2;
  }
  return sum;
}

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_SUITE("drawing/contour") {
  TEST_CASE("a linear field has one straight line at the right place") {
    // f = 2 x + y = 3 from (1.5, 0) to (0.5, 2) on [0, 4] x [0, 2]: right of it 8 - 2 = 6 m2.
    const ContourGrid grid =
        sampled({0, 0.3, 1, 2.5, 4}, {0, 0.7, 2}, [](double x, double y) { return 2 * x + y; });
    for (const ContourGrid& g : {grid, refined(grid, 7)}) {
      const Contour contour = contour_at(g, 3);
      REQUIRE(contour.lines.size() == 1);
      REQUIRE(contour.lines[0].size() == 2);  // points on the way are dropped: it is straight
      for (const Vec2& p : contour.lines[0]) CHECK(std::abs(2 * p.x() + p.y() - 3) < 1e-13);
      const Vec2 &p = contour.lines[0][0], &q = contour.lines[0][1];
      CHECK((p - q).cwiseAbs().isApprox(Vec2(1, 2), 1e-13));
      REQUIRE(contour.region.size() == 1);
      CHECK(contour.region[0].size() == 4);
      CHECK(std::abs(area(contour) - 6) < 1e-12);
    }
  }

  TEST_CASE("levels outside the values give all or nothing") {
    const ContourGrid grid = sampled({0, 1, 3}, {0, 2}, [](double x, double y) { return x * y; });
    const Contour all = contour_at(grid, -std::numeric_limits<double>::infinity());
    CHECK(all.lines.empty());
    REQUIRE(all.region.size() == 1);
    CHECK(all.region[0].size() == 4);
    CHECK(area(all) == voussoir_test::near(6));
    CHECK(contour_at(grid, 7).region.empty());
    CHECK(contour_at(grid, 7).lines.empty());
  }

  TEST_CASE("a level that passes through nodes makes no spikes") {
    const ContourGrid grid =
        sampled({0, 1, 2, 3}, {0, 1, 2, 3}, [](double x, double y) { return x - y; });
    const Contour contour = contour_at(grid, 0);  // through nodes and centres alike
    CHECK(area(contour) == voussoir_test::near(4.5));
    REQUIRE(contour.lines.size() == 1);
    CHECK(contour.lines[0].size() == 2);
  }

  TEST_CASE("a hill has a closed line, a hollow a hole") {
    std::vector<double> axis;
    for (int i = -20; i <= 20; ++i) axis.push_back(i / 10.0);
    const auto cone = [](double x, double y) { return std::hypot(x, y); };
    const Contour hollow = contour_at(sampled(axis, axis, cone), 1.5);
    REQUIRE(hollow.lines.size() == 1);
    CHECK(hollow.lines[0].front() == hollow.lines[0].back());
    // Chords of a circle of radius 1.5 with edges of about 0.1 m: 1e-3 of the area too much at
    // most.
    const double disc = std::acos(-1.0) * 1.5 * 1.5;
    CHECK(std::abs(area(hollow) - (16 - disc)) < 0.01);
    CHECK(hollow.region.size() == 2);
    const Contour hill =
        contour_at(sampled(axis, axis, [&](double x, double y) { return -cone(x, y); }), -1.5);
    CHECK(std::abs(area(hill) - disc) < 0.01);
  }

  TEST_CASE("regions of neighbouring levels fit without gap: areas add up") {
    const ContourGrid grid = sampled({0, 1, 2, 4, 5}, {0, 1, 3, 4}, [](double x, double y) {
      return std::sin(3 * x) + std::cos(2 * y * x);
    });
    // Saddles included: {f >= c} and {-f > -c} together cover the rectangle.
    for (const double level : {-1.0, -0.35, 0.0, 0.4, 1.2}) {
      ContourGrid mirrored = grid;
      mirrored.value *= -1;
      const double sum = area(contour_at(grid, level)) + area(contour_at(mirrored, -level));
      CHECK(std::abs(sum - 20) < 1e-12);
    }
  }

  TEST_CASE("one missing corner costs half a cell, two the whole") {
    ContourGrid grid = sampled({0, 1, 2}, {0, 1, 2}, [](double, double) { return 1.0; });
    const double all = -std::numeric_limits<double>::infinity();
    grid.value(0, 2) = not_a_number;
    for (const int parts : {1, 6}) {
      CHECK(area(contour_at(refined(grid, parts), all)) == voussoir_test::near(3.5));
    }
    grid.value(0, 1) = not_a_number;
    CHECK(area(contour_at(grid, all)) == voussoir_test::near(2.5));
    grid.value.setConstant(not_a_number);
    CHECK(contour_at(refined(grid, 3), 0).region.empty());
  }

  TEST_CASE("smoothing passes through the data and makes no new extremes") {
    const ContourGrid grid = sampled({0, 0.02, 0.05, 0.2}, {1, 2, 5, 6, 7}, [](double x, double y) {
      return y > 4 ? 1 / (x + 0.01) : 5 + y;
    });
    const int parts = 5;
    const ContourGrid fine = refined(grid, parts);
    REQUIRE(fine.x.size() == 16);
    REQUIRE(fine.y.size() == 21);
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 5; ++j)
        CHECK(fine.value(i * parts, j * parts) == grid.value(i, j));
    }
    CHECK(fine.value.minCoeff() >= grid.value.minCoeff());
    CHECK(fine.value.maxCoeff() <= grid.value.maxCoeff());
  }

  TEST_CASE("grids that are none are refused") {
    const ContourGrid grid = sampled({0, 1}, {0, 1}, [](double x, double y) { return x + y; });
    CHECK(contour_at(grid, 0.5).lines.size() == 1);
    ContourGrid bad = grid;
    bad.x = {1, 0};
    CHECK_THROWS_AS((void)contour_at(bad, 0), InvalidInput);
    bad.x = {0, 1, 2};
    CHECK_THROWS_AS((void)contour_at(bad, 0), InvalidInput);
    CHECK_THROWS_AS((void)refined(bad, 2), InvalidInput);
    CHECK_THROWS_AS((void)refined(grid, 0), InvalidInput);
  }
}

}  // namespace contour_test
