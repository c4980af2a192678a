// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <utility>
#include <voussoir/linear/tangent_solver.hpp>

#include "linear/rigid_network.hpp"
#include "support/dense_algebra.hpp"

namespace tangent_solver_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

/// The stiffness of a network of which a share of the joints slides: forces across them depend on
/// what presses, and not the other way round.
template <int Dof>
TangentMatrix<Dof> sliding_network(Random& random, int side, double share) {
  const auto network = rigid_network<Dof>(random, {.side = side});
  TangentMatrix<Dof> matrix;
  matrix.pairs = network.matrix.pairs();
  for (int i = 0; i < network.matrix.size(); ++i)
    matrix.diagonal.push_back(network.matrix.diagonal(i));
  for (std::size_t k = 0; k < matrix.pairs.size(); ++k) {
    const Fixed<Dof, Dof> block = network.matrix.below(static_cast<int>(k));
    matrix.forward.push_back(block);
    matrix.backward.push_back(transposed(block));
    if (random.uniform() > share) continue;
    const double friction = 0.7 * random.uniform();
    for (int c = 0; c < Dof; ++c) {
      matrix.forward.back()(0, c) = friction * block(1, c);
      matrix.backward.back()(0, c) = friction * block(c, 1);
    }
  }
  return matrix;
}

template <int Dof>
Eigen::MatrixXd dense(const TangentMatrix<Dof>& matrix) {
  const auto n = static_cast<Eigen::Index>(Dof * matrix.diagonal.size());
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < matrix.diagonal.size(); ++i) {
    const auto at = Dof * static_cast<Eigen::Index>(i);
    full.block<Dof, Dof>(at, at) = matrix.diagonal[i];
  }
  for (std::size_t k = 0; k < matrix.pairs.size(); ++k) {
    const auto& [i, j] = matrix.pairs[k];
    full.block<Dof, Dof>(Dof * i, Dof * j) = matrix.forward[k];
    full.block<Dof, Dof>(Dof * j, Dof * i) = matrix.backward[k];
  }
  return full;
}

}  // namespace

TEST_SUITE("linear/tangent_solver") {
  TEST_CASE_TEMPLATE("minimal residuals reach the residual they say", D, Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    Random random(71, dof);
    for (const double tolerance : {1e-1, 1e-3, 1e-10}) {
      const auto matrix = sliding_network<dof>(random, dof == 3 ? 8 : 4, 0.3);
      const Eigen::MatrixXd full = dense(matrix);
      const Eigen::VectorXd f = random_forces(random, full.rows());
      Eigen::VectorXd x = f;
      REQUIRE(minimal_residuals(matrix, x, tolerance, 200));
      CHECK((full * x - f).norm() <= 1.001 * tolerance * f.norm());  // the residual is updated
      if (tolerance > 1e-9) continue;
      const Eigen::VectorXd expected = voussoir_test::solve(full, f);
      CHECK((x - expected).norm() <= 1e-6 * expected.norm());
    }
  }

  TEST_CASE("a chain has no fill: its incomplete factor is the factor, one step solves it") {
    Random random(72);
    TangentMatrix<3> chain;
    for (int k = 0; k < 50; ++k) {
      chain.diagonal.push_back(4 * diagonal_of<3>(1 + random.uniform()));
      if (k == 0) continue;
      chain.pairs.emplace_back(k, k - 1);
      Fixed<3, 3> forward, backward;
      for (int e = 0; e < 9; ++e) forward.data()[e] = random.uniform();
      for (int e = 0; e < 9; ++e) backward.data()[e] = random.uniform();
      chain.forward.push_back(forward);
      chain.backward.push_back(backward);
    }
    const Eigen::VectorXd f = random_forces(random, 150);
    Eigen::VectorXd by_factor = f, x = f;
    IncompleteLU<3>(chain).solve_in_place(by_factor);
    CHECK((dense(chain) * by_factor - f).norm() <= 1e-12 * f.norm());
    CHECK(minimal_residuals(chain, x, 1e-10, 1));
  }

  TEST_CASE("what minimal residuals cannot solve is left as it was, and factored") {
    Random random(73);
    const auto matrix = sliding_network<6>(random, 8, 0.3);  // more than are factored at once
    const Eigen::VectorXd f = random_forces(random, 6 * 512);
    Eigen::VectorXd x = f;
    CHECK_FALSE(minimal_residuals(matrix, x, 1e-10, 2));
    CHECK(x == f);
    auto spoilt = matrix;
    spoilt.diagonal[3](0, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(minimal_residuals(spoilt, x, 1e-3, 100));
    solve_tangent(spoilt, x);
    CHECK_FALSE(is_finite(x));  // nor does the factor hide it
    Eigen::VectorXd zero = zeros(f.size());
    solve_tangent(matrix, zero);
    CHECK(zero == zeros(f.size()));
  }

  TEST_CASE("a Newton step leaves a thousandth where blocks are many, nothing where they are few") {
    Random random(74);
    for (const int side : {4, 8}) {
      const auto matrix = sliding_network<6>(random, side, 0.3);
      const Eigen::VectorXd f = random_forces(random, 6 * side * side * side);
      Eigen::VectorXd step = f;
      solve_tangent(matrix, step);
      const double left = (dense(matrix) * step - f).norm() / f.norm();
      CHECK(left <= (side == 4 ? 1e-12 : 1.001e-3));
      CHECK((left > 1e-9) == (side == 8));
    }
  }
}

}  // namespace tangent_solver_test
