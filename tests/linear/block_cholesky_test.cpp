// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/linear/block_cholesky.hpp>
#include <voussoir/linear/minimum_degree.hpp>

#include "linear/dense_matrix.hpp"
#include "linear/graphs.hpp"
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

/// A spring for every pair, and one that ties every body to the ground.
template <int Dof>
BlockMatrix<Dof> springs_between(Random& random, const voussoir_test::BodyPairs& graph,
                                 double held) {
  using Block = Eigen::Matrix<double, Dof, Dof>;
  BlockMatrix<Dof> matrix(graph.size);
  for (const auto& [i, j] : graph.pairs) {
    const Block a = random_matrix<Block>(random, Dof, Dof),
                b = random_matrix<Block>(random, Dof, Dof);
    matrix.add(i, a.transpose() * a);
    matrix.add(j, b.transpose() * b);
    matrix.add(i, j, a.transpose() * b);
  }
  for (int i = 0; i < graph.size; ++i) matrix.add(i, held * Block::Identity());
  matrix.compress();
  return matrix;
}

bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() &&
         (a.size() == 0 || std::memcmp(a.data(), b.data(),
                                       static_cast<std::size_t>(a.size()) * sizeof(double)) == 0);
}

/// Bodies tied to their neighbours as if by bars along the unknowns, and each to the ground but
/// `loose`, which nothing holds.
template <int Dof>
BlockMatrix<Dof> held_but_one(const voussoir_test::BodyPairs& graph, int loose) {
  BlockMatrix<Dof> matrix(graph.size);
  for (const auto& [i, j] : graph.pairs) {
    // The loose body keeps its place in the pattern, with couplings of nothing.
    const double stiffness = i == loose || j == loose ? 0 : 1;
    matrix.add(i, diagonal_of<Dof>(stiffness));
    matrix.add(j, diagonal_of<Dof>(stiffness));
    matrix.add(i, j, diagonal_of<Dof>(-stiffness));
  }
  for (int i = 0; i < graph.size; ++i) matrix.add(i, diagonal_of<Dof>(i == loose ? 0 : 1));
  matrix.compress();
  return matrix;
}

template <int Dof>
std::string refusal(const BlockMatrix<Dof>& matrix, unsigned threads) {
  try {
    const BlockCholesky<Dof> factor(matrix, {}, threads);
  } catch (const NumericalFault& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace

TEST_SUITE("linear/block_cholesky") {
  TEST_CASE_TEMPLATE(
      "every kind of graph: the solution is the dense one, its bits are the same for "
      "any number of threads",
      D, Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    Random random(12, dof);
    for (const auto& graph : voussoir_test::graphs_of_all_kinds()) {
      CAPTURE(graph.size);
      CAPTURE(graph.pairs.size());
      const BlockMatrix<dof> matrix = springs_between<dof>(random, graph, 0.1);
      const Eigen::VectorXd b = random_matrix<Eigen::VectorXd>(random, dof * graph.size, 1);
      Eigen::VectorXd x = b;
      const BlockCholesky<dof> alone(matrix);
      alone.solve_in_place(x);
      if (graph.size > 0 && graph.size < 100) {
        const Eigen::MatrixXd full = dense(matrix);
        CHECK((full * x - b).norm() <= 1e-14 * full.norm() * x.norm());
        CHECK((x - voussoir_test::solve(full, b)).norm() <= 1e-12 * x.norm());
      }
      for (const unsigned threads : {1U, 2U, 3U}) {
        CAPTURE(threads);
        Eigen::VectorXd y = b, z = b;
        const BlockCholesky<dof> factor(matrix, {}, threads);
        factor.solve_in_place(y);
        CHECK(same_bits(x, y));
        // With the pattern of another factor, and by a copy.
        const BlockCholesky<dof> again(matrix, alone.pattern(), {}, threads), copy = again;
        copy.solve_in_place(z);
        CHECK(same_bits(x, z));
      }
    }
  }

  TEST_CASE_TEMPLATE("large fronts, dense and of a cube", D, Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    Random random(13, dof);
    // More columns than are eliminated at once, and not a multiple of the tiles.
    for (const auto& graph :
         {voussoir_test::all_pairs(71), voussoir_test::grid_pairs(9, 8, 9, true),
          voussoir_test::grid_pairs(60, 50, 1, true)}) {
      CAPTURE(graph.size);
      const BlockMatrix<dof> matrix = springs_between<dof>(random, graph, 0.1);
      const Eigen::VectorXd b = random_matrix<Eigen::VectorXd>(random, dof * graph.size, 1);
      Eigen::VectorXd x = b, y = b;
      BlockCholesky<dof>(matrix).solve_in_place(x);
      BlockCholesky<dof>(matrix, {}, 3).solve_in_place(y);
      CHECK(same_bits(x, y));
      Eigen::VectorXd rest = -b;
      for (int i = 0; i < graph.size; ++i)
        rest.segment<dof>(dof * i) += matrix.diagonal(i) * x.segment<dof>(dof * i);
      int k = 0;
      for (const auto& [i, j] : matrix.pairs()) {
        rest.segment<dof>(dof * i) += matrix.below(k) * x.segment<dof>(dof * j);
        rest.segment<dof>(dof * j) += matrix.below(k++).transpose() * x.segment<dof>(dof * i);
      }
      CHECK(rest.norm() <= 1e-14 * matrix.absolute_row_sums().maxCoeff() * x.norm());
    }
  }

  TEST_CASE("a pattern serves other matrices of the same pairs, and no others") {
    Random random(14);
    const auto graph = voussoir_test::grid_pairs(9, 9, 1, true);
    const BlockMatrix<3> first = springs_between<3>(random, graph, 0.1),
                         second = springs_between<3>(random, graph, 0.2);
    const Eigen::VectorXd b = random_matrix<Eigen::VectorXd>(random, 3 * graph.size, 1);
    const auto pattern = std::make_shared<const CholeskyPattern>(3, graph.size, first.pairs());
    for (const auto* matrix : {&first, &second}) {
      Eigen::VectorXd x = b, y = b;
      BlockCholesky<3>(*matrix).solve_in_place(x);
      BlockCholesky<3>(*matrix, pattern).solve_in_place(y);
      CHECK(same_bits(x, y));
    }
    CHECK_THROWS_AS(BlockCholesky<3>(random_springs<3>(random, 81, 100, 0.1), pattern),
                    InvalidInput);
    CHECK_THROWS_AS(BlockCholesky<6>(springs_between<6>(random, graph, 0.1), pattern),
                    InvalidInput);
  }

  TEST_CASE("the bits do not depend on the length of the vectors that the processor has") {
    Random random(15);
    std::vector<double> a(8 * 37), b(8 * 37), c(8 * 11), x(64), reciprocal(8);
    for (auto* values : {&a, &b, &c, &x, &reciprocal})
      for (double& value : *values) value = 2 * random.uniform() - 1;
    std::vector<double> with_two = c, expected = c, solved = x, plain = x;
    const detail::TileKernels fastest = detail::tile_kernels();
    fastest.subtract(c.data(), 11, a.data(), b.data(), 37);
    detail::subtract_tile_plain(with_two.data(), 11, a.data(), b.data(), 37);
    CHECK(c == with_two);
    for (std::size_t j = 0; j < 8; ++j)
      for (std::size_t i = 0; i < 8; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < 37; ++k) sum += a[8 * k + i] * b[8 * k + j];
        expected[11 * j + i] -= sum;
      }
    CHECK(c == expected);
    fastest.solve(solved.data(), a.data(), reciprocal.data(), 7);
    detail::solve_tile_plain(plain.data(), a.data(), reciprocal.data(), 7);
    CHECK(solved == plain);
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t j = 0; j < 7; ++j) {
        for (std::size_t k = 0; k < j; ++k) x[8 * j + i] -= x[8 * k + i] * a[8 * k + j];
        x[8 * j + i] *= reciprocal[j];
      }
    CHECK(solved == x);
  }

  TEST_CASE_TEMPLATE("wherever it stands in the order, the body that nothing holds is named", D,
                     Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    for (const auto& graph :
         {voussoir_test::grid_pairs(12, 12, 1, true), voussoir_test::grid_pairs(6, 6, 6, false)}) {
      const CholeskyPattern pattern(dof, graph.size, graph.pairs);
      for (const int place : {0, 1, 17, graph.size / 2, graph.size - 9, graph.size - 1}) {
        const int body = pattern.original(place);
        const BlockMatrix<dof> matrix = held_but_one<dof>(graph, body);
        const std::string expected =
            "elastic stiffness: body " + std::to_string(body) + " can move without resistance";
        for (const unsigned threads : {1U, 2U, 3U}) CHECK(refusal(matrix, threads) == expected);
      }
      // Of several, the one that is eliminated first, whoever finds which first.
      BlockMatrix<dof> several = held_but_one<dof>(graph, pattern.original(5));
      several.add(pattern.original(3), diagonal_of<dof>(-1e3));
      for (int k = 1; k < 8; ++k)
        several.add(pattern.original(graph.size * k / 8), diagonal_of<dof>(-1e3));
      const std::string alone = refusal(several, 1);
      CHECK(alone.find(" " + std::to_string(pattern.original(3)) + " ") != std::string::npos);
      for (int k = 0; k < 5; ++k) CHECK(refusal(several, 3) == alone);
    }
  }

  TEST_CASE("of several failures the first in the order of elimination counts, whenever it comes") {
    detail::FactorState state{Progress()};
    CHECK_FALSE(state.has_failed());
    state.fail(7, 70);
    CHECK(state.is_over(7));
    CHECK(state.is_over(8));
    CHECK_FALSE(state.is_over(6));  // it may fail too, and would come first
    state.fail(3, 30);
    state.fail(5, 50);
    CHECK(state.has_failed());
    CHECK(state.failed_column() == 30);
    CHECK_FALSE(state.is_over(2));
    CHECK_FALSE(state.is_stopped());
    CHECK_NOTHROW(state.rethrow());
  }

  TEST_CASE("memory of several threads: what all subtrees leave waits at one time") {
    for (const auto& graph :
         {voussoir_test::grid_pairs(40, 40, 1, true), voussoir_test::grid_pairs(9, 9, 9, true)}) {
      const CholeskyPattern pattern(6, graph.size, graph.pairs);
      const detail::FrontSchedule alone(pattern, 1);
      CHECK(alone.most_numbers(pattern) == pattern.most_numbers());
      for (const unsigned threads : {2U, 4U}) {
        const detail::FrontSchedule schedule(pattern, threads);
        double waiting = 0;
        for (const int last : schedule.subtrees()) {
          const auto& front = pattern.fronts()[static_cast<std::size_t>(last)];
          const double below = 6 * static_cast<double>(front.end - front.begin);
          waiting += below * below;
        }
        const double most = schedule.most_numbers(pattern);
        CHECK(most >= pattern.stored_numbers() + waiting);
        CHECK(most >= pattern.most_numbers());
        CHECK(most <= 2 * pattern.most_numbers());  // no reason to refuse what fits
      }
    }
  }

  TEST_CASE("stopped at any question, and made again") {
    Random random(16);
    const auto graph = voussoir_test::grid_pairs(12, 12, 12, true);
    const BlockMatrix<6> matrix = springs_between<6>(random, graph, 0.1);
    const Eigen::VectorXd b = random_matrix<Eigen::VectorXd>(random, 6 * graph.size, 1);
    for (const unsigned threads : {1U, 3U}) {
      int all = 0;
      Eigen::VectorXd x = b, y = b;
      BlockCholesky<6>(
          matrix, [&](double) { return ++all > 0; }, threads)
          .solve_in_place(x);
      REQUIRE(all > 3);
      for (const int last : {1, 3}) {
        int asked = 0;
        CHECK_THROWS_AS(BlockCholesky<6>(
                            matrix, [&](double) { return ++asked < last; }, threads),
                        Stopped);
        CHECK(asked == last);
      }
      // What a Progress throws comes out.
      CHECK_THROWS_AS(BlockCholesky<6>(
                          matrix, [](double) -> bool { throw std::runtime_error("no"); }, threads),
                      std::runtime_error);
      BlockCholesky<6>(matrix, {}, threads).solve_in_place(y);
      CHECK(same_bits(x, y));
    }
  }

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
    CHECK(BlockCholesky<3>(chain).pattern()->block_count() == 199);  // 100 on the diagonal
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
    int asked = 0;
    const BlockCholesky<3> with(small, [&](double) { return ++asked > 0; });
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
