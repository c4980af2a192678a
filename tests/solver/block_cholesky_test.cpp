// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <string>
#include <type_traits>
#include <voussoir/core/random.hpp>
#include <voussoir/solver/block_cholesky.hpp>

#include "solver/dense_matrix.hpp"
#include "support/dense_algebra.hpp"

namespace block_cholesky_test {

using namespace voussoir;
using voussoir_test::dense;

namespace {

template <int Dof>
using Dofs = std::integral_constant<int, Dof>;

template <class Matrix>
Matrix random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  Matrix m(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) m(i, j) = 2 * random.uniform() - 1;
  return m;
}

/// Springs between random pairs of bodies, and (if `held`) one that ties every body to the ground.
template <int Dof>
BlockMatrix<Dof> random_springs(Random& random, int bodies, int springs, double held) {
  using Block = Eigen::Matrix<double, Dof, Dof>;
  BlockMatrix<Dof> matrix(bodies);
  for (int k = 0; k < springs; ++k) {
    const int i = static_cast<int>(random.below(static_cast<std::uint64_t>(bodies)));
    const int j = static_cast<int>(random.below(static_cast<std::uint64_t>(bodies)));
    if (i == j) continue;
    // A spring of rank Dof acts on A u_i + B u_j: a sum of squares, so never negative.
    const Block a = random_matrix<Block>(random, Dof, Dof),
                b = random_matrix<Block>(random, Dof, Dof);
    matrix.add(i, a.transpose() * a);
    matrix.add(j, b.transpose() * b);
    matrix.add(i, j, a.transpose() * b);  // in either order of i and j, and repeated
  }
  for (int i = 0; i < bodies; ++i) matrix.add(i, held * Block::Identity());
  matrix.compress();
  return matrix;
}

}  // namespace

TEST_SUITE("solver/block_cholesky") {
  TEST_CASE_TEMPLATE("solutions are those of a dense factorisation", D, Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    Random random(7, dof);
    for (const int bodies : {1, 2, 3, 10, 60}) {
      CAPTURE(bodies);
      const BlockMatrix<dof> matrix = random_springs<dof>(random, bodies, 3 * bodies, 0.1);
      const Eigen::MatrixXd full = dense(matrix);
      const Eigen::VectorXd b = random_matrix<Eigen::VectorXd>(random, dof * bodies, 1);
      Eigen::VectorXd x = b;
      BlockCholesky<dof>(matrix).solve_in_place(x);
      // Backward stable: the residual is a few eps |A| |x|, the error a few eps times the condition
      // (largest eigenvalue about 1e2 over 0.1).
      CHECK((full * x - b).norm() <= 1e-14 * full.norm() * x.norm());
      CHECK((x - voussoir_test::solve(full, b)).norm() <= 1e-12 * x.norm());
    }
  }

  TEST_CASE("a factor solves again and again, whatever it solved before") {
    Random random(8);
    const BlockMatrix<3> matrix = random_springs<3>(random, 40, 120, 0.1);
    const BlockCholesky<3> factor(matrix);
    const Eigen::VectorXd b = random_matrix<Eigen::VectorXd>(random, 120, 1);
    Eigen::VectorXd first = b, other = 3 * b, again = b;
    factor.solve_in_place(first);
    factor.solve_in_place(other);
    factor.solve_in_place(again);
    CHECK(again == first);
  }

  TEST_CASE("blocks that are not coupled do not fill in") {
    Random random(9);
    BlockMatrix<3> chain(100);
    for (int i = 0; i < 100; ++i) {
      chain.add(i, 4 * Eigen::Matrix3d::Identity());
      if (i > 0) chain.add(i - 1, i, -Eigen::Matrix3d::Identity());
    }
    chain.compress();
    CHECK(BlockCholesky<3>(chain).block_count() == 199);  // 100 on the diagonal, 99 below
  }

  TEST_CASE("absolute row sums are those of the full matrix, and bound its eigenvalues") {
    Random random(10);
    const BlockMatrix<3> matrix = random_springs<3>(random, 30, 90, 0.1);
    const Eigen::MatrixXd full = dense(matrix);
    const Eigen::VectorXd sums = matrix.absolute_row_sums();
    CHECK((sums - full.cwiseAbs().rowwise().sum()).norm() <= 1e-14 * sums.norm());
    CHECK(voussoir_test::eigenvalues(full).maxCoeff() <= sums.maxCoeff());
  }

  TEST_CASE_TEMPLATE("a body held by nothing is named", D, Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    using Block = Eigen::Matrix<double, dof, dof>;
    BlockMatrix<dof> matrix(5);
    for (const int i : {0, 1, 2, 4}) matrix.add(i, Block::Identity());
    matrix.add(4, 0, 0.1 * Block::Identity());
    matrix.compress();
    std::string message;
    try {
      (void)BlockCholesky<dof>(matrix);
    } catch (const NumericalFault& fault) {
      message = fault.what();
    }
    CHECK(message.find(" 3 can move") != std::string::npos);
  }

  TEST_CASE("ordering and factorisation ask whether to go on") {
    const auto grid = [](int side) {
      BlockMatrix<3> springs(side * side);
      const auto spring = [&](int i, int j) {
        springs.add(i, diagonal_of<3>(1));
        springs.add(j, diagonal_of<3>(1));
        springs.add(i, j, diagonal_of<3>(-1));
      };
      for (int i = 0; i < side * side; ++i) {
        if (i % side > 0) spring(i, i - 1);
        if (i >= side) spring(i, i - side);
      }
      springs.add(0, diagonal_of<3>(1));
      springs.compress();
      return springs;
    };
    // Large enough to take longer than the 10 ms in which nothing is asked.
    const BlockMatrix<3> large = grid(250), small = grid(90);
    const Progress never = [](double) { return false; };
    CHECK_THROWS_AS((void)minimum_degree_order(large.size(), large.pairs(), never), Stopped);
    CHECK_THROWS_AS((void)BlockCholesky<3>(large, never), Stopped);
    // Where ordering has no more to ask, the factor has: it takes many times as long.
    int of_order = 0, of_factor = 0;
    (void)minimum_degree_order(small.size(), small.pairs(), [&](double) { return ++of_order > 0; });
    const BlockCholesky<3> with(small, [&](double) { return ++of_factor > 0; });
    CHECK(of_factor > 2 * of_order);
    Eigen::VectorXd x = constants(3 * small.size(), 1), y = x;
    with.solve_in_place(x);
    BlockCholesky<3>(small).solve_in_place(y);
    CHECK(x == y);
  }

  TEST_CASE_TEMPLATE("what is not positive definite is refused", D, Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    using Block = Eigen::Matrix<double, dof, dof>;
    Random random(11);
    // Two bodies tied to each other only: they can move together.
    BlockMatrix<dof> floating(2);
    const Block a = random_matrix<Block>(random, dof, dof);
    const Block k = a.transpose() * a + Block::Identity();
    floating.add(0, k);
    floating.add(1, k);
    floating.add(0, 1, -k);
    floating.compress();
    CHECK_THROWS_AS(BlockCholesky<dof>{floating}, NumericalFault);
    // One direction that a force drives the wrong way.
    BlockMatrix<dof> indefinite(3);
    for (int i = 0; i < 3; ++i) indefinite.add(i, Block::Identity());
    indefinite.add(0, 2, 1.5 * Block::Identity());  // eigenvalue 1 - 1.5
    indefinite.compress();
    CHECK_THROWS_AS(BlockCholesky<dof>{indefinite}, NumericalFault);
  }
}

}  // namespace block_cholesky_test
