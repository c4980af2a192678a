// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>
#include <voussoir/linear/rigid_aggregates.hpp>

#include "linear/dense_matrix.hpp"
#include "linear/rigid_network.hpp"

namespace rigid_aggregates_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

/// Every body's values when all move as one rigid body about the origin.
template <int Dof>
Eigen::VectorXd moved_as_one(const BodyCentres<Dof>& centres, const Fixed<Dof, 1>& motion) {
  constexpr int dim = dimension_of<Dof>;
  Eigen::VectorXd u(Dof * static_cast<Eigen::Index>(centres.size()));
  for (std::size_t b = 0; b < centres.size(); ++b) {
    Fixed<Dof, 1> values = motion;
    const Vec<dim> shift = turned(part<Dof - dim>(motion, dim), centres[b]);
    for (int d = 0; d < dim; ++d) values[d] += shift[d];
    set_part<Dof>(u, Dof * static_cast<Eigen::Index>(b), values);
  }
  return u;
}

/// The prolongation as a dense matrix.
template <int Dof>
Eigen::MatrixXd dense_prolongation(const RigidAggregates<Dof>& aggregates) {
  const auto bodies = static_cast<Eigen::Index>(aggregates.of_body.size());
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(Dof * bodies, Dof * aggregates.count());
  for (Eigen::Index b = 0; b < bodies; ++b) {
    const int a = aggregates.of_body[static_cast<std::size_t>(b)];
    if (a < 0) continue;
    for (int k = 0; k < Dof; ++k)
      p.block<Dof, 1>(Dof * b, Dof * a + k) =
          aggregates.prolonged(static_cast<std::size_t>(b), axis_vector<Dof>(k));
  }
  return p;
}

}  // namespace

TEST_SUITE("linear/rigid_aggregates") {
  TEST_CASE_TEMPLATE("a rigid motion of all aggregates is that of all bodies", D, Dofs<3>,
                     Dofs<6>) {
    constexpr int dof = D::value;
    Random random(17, dof);
    const auto network = rigid_network<dof>(random, {.side = dof == 3 ? 20 : 8});
    const RigidAggregates<dof> aggregates(network.matrix, network.centres, 8);
    Fixed<dof, 1> motion;
    for (int k = 0; k < dof; ++k) motion[k] = 2 * random.uniform() - 1;
    const Eigen::VectorXd fine = moved_as_one<dof>(network.centres, motion);
    const Eigen::VectorXd coarse = moved_as_one<dof>(aggregates.centres, motion);
    double worst = 0;
    for (std::size_t b = 0; b < network.centres.size(); ++b) {
      const auto at = static_cast<Eigen::Index>(b);
      const auto values = aggregates.prolonged(b, part<dof>(coarse, dof * aggregates.of_body[b]));
      worst = std::max(worst, (values - part<dof>(fine, dof * at)).norm());
    }
    CHECK(worst <= 1e-13);  // a few roundings of motions of some 30 m
  }

  TEST_CASE_TEMPLATE("the stiffness of aggregates is P^T K P, and restriction is P^T", D, Dofs<3>,
                     Dofs<6>) {
    constexpr int dof = D::value;
    Random random(18, dof);
    const auto network = rigid_network<dof>(random, {.side = dof == 3 ? 7 : 4, .contrast = 100});
    const RigidAggregates<dof> aggregates(network.matrix, network.centres, 6);
    const Eigen::MatrixXd p = dense_prolongation(aggregates), k = dense(network.matrix);
    const Eigen::MatrixXd expected = p.transpose() * k * p;
    const Eigen::MatrixXd made = dense(aggregates.stiffness(network.matrix));
    CHECK((made - expected).norm() <= 1e-14 * k.norm() * p.squaredNorm());
    const Eigen::VectorXd f = random_forces(random, k.rows());
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(p.cols());
    for (std::size_t b = 0; b < aggregates.of_body.size(); ++b)
      sum.segment<dof>(dof * aggregates.of_body[b]) +=
          aggregates.restricted(b, part<dof>(f, dof * static_cast<Eigen::Index>(b)));
    CHECK((sum - p.transpose() * f).norm() <= 1e-13 * f.norm() * p.norm());
  }

  TEST_CASE_TEMPLATE("a network that nothing holds has aggregates that nothing holds", D, Dofs<3>,
                     Dofs<6>) {
    constexpr int dof = D::value;
    Random random(19, dof);
    const auto network =
        rigid_network<dof>(random, {.side = dof == 3 ? 12 : 5, .held = false, .contrast = 1e4});
    const RigidAggregates<dof> aggregates(network.matrix, network.centres, 8);
    const BlockMatrix<dof> coarse = aggregates.stiffness(network.matrix);
    Eigen::VectorXd force;
    for (int k = 0; k < dof; ++k) {
      coarse.multiply(moved_as_one<dof>(aggregates.centres, axis_vector<dof>(k)), force);
      // Forces of joints of 5 GN/m moved by up to 12 m, and what rounding leaves of them.
      CHECK(force.cwiseAbs().maxCoeff() <= 1e-13 * 5e9 * 12 * 12);
    }
  }

  TEST_CASE("every coupled body is in one connected aggregate, one coupled to nothing in none") {
    Random random(20);
    BlockMatrix<3> matrix(500);
    BodyCentres<3> centres;
    std::vector<std::vector<int>> neighbours(500);
    for (int b = 0; b < 500; ++b) {
      const double x = random.uniform(), y = random.uniform();
      centres.emplace_back(x, y);
      matrix.add(b, diagonal_of<3>(1));
    }
    for (int k = 0; k < 700; ++k) {  // some 30 of the 500 are left alone
      const int i = static_cast<int>(random.below(500)), j = static_cast<int>(random.below(500));
      if (i == j) continue;
      matrix.add(i, j, diagonal_of<3>(-random.uniform()));
      neighbours[static_cast<std::size_t>(i)].push_back(j);
      neighbours[static_cast<std::size_t>(j)].push_back(i);
    }
    matrix.compress();
    const RigidAggregates<3> aggregates(matrix, centres, 6);
    std::vector<std::vector<int>> members(static_cast<std::size_t>(aggregates.count()));
    int alone = 0;
    for (int b = 0; b < 500; ++b) {
      const int a = aggregates.of_body[static_cast<std::size_t>(b)];
      REQUIRE((a < 0) == neighbours[static_cast<std::size_t>(b)].empty());
      if (a < 0)
        ++alone;
      else
        members[static_cast<std::size_t>(a)].push_back(b);
    }
    CHECK(alone > 5);
    CHECK(aggregates.count() < 250);
    for (const auto& some : members) {
      REQUIRE(!some.empty());
      std::vector<int> reached{some.front()};
      for (std::size_t k = 0; k < reached.size(); ++k)
        for (const int next : neighbours[static_cast<std::size_t>(reached[k])])
          if (aggregates.of_body[static_cast<std::size_t>(next)] ==
                  aggregates.of_body[static_cast<std::size_t>(some.front())] &&
              std::find(reached.begin(), reached.end(), next) == reached.end())
            reached.push_back(next);
      CHECK(reached.size() == some.size());
    }
  }
}

}  // namespace rigid_aggregates_test
