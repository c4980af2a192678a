// SPDX-License-Identifier: MIT
// Jacobi's axes beside Eigen's, and what axes must do whoever computes them.
#include <doctest/doctest.h>

#include <cmath>
#include <voussoir/core/random.hpp>
#include <voussoir/core/repeatable.hpp>
#include <voussoir/geometry/principal_axes.hpp>

#include "support/dense_algebra.hpp"
#include "support/near.hpp"

namespace principal_axes_test {

using voussoir::principal_axes, voussoir::PrincipalAxes, voussoir::Vec3;

namespace {

/// A rotation drawn at random, by Gram-Schmidt.
Eigen::Matrix3d random_rotation(voussoir::Random& random) {
  const auto draw = [&random] { return Vec3(random.normal(), random.normal(), random.normal()); };
  const Vec3 x = draw().normalized();
  Vec3 y = draw();
  y = (y - y.dot(x) * x).eval().normalized();
  Eigen::Matrix3d r;
  r << x, y, voussoir::repeatable::cross(x, y);
  return r;
}

}  // namespace

TEST_SUITE("geometry/principal_axes") {
  TEST_CASE("moments are those of Eigen, and the axes diagonalise the tensor") {
    voussoir::Random random(1, 0);
    for (const Vec3& moments : {Vec3(1, 2, 3), Vec3(1, 1, 5), Vec3(1, 5, 5), Vec3(2, 2, 2),
                                Vec3(1e-6, 1, 1), Vec3(1e-3, 1e3, 1e3)})
      for (int k = 0; k < 50; ++k) {
        const Eigen::Matrix3d turn = random_rotation(random);
        Eigen::Matrix3d tensor = turn * moments.asDiagonal() * turn.transpose();
        tensor = 0.5 * (tensor + tensor.transpose()).eval();
        const PrincipalAxes axes = principal_axes(tensor);
        const Vec3 eigens = voussoir_test::eigenvalues(tensor);
        // A tensor of size m has its moments to some roundings of m.
        const double rounding = 1e-14 * moments.maxCoeff();
        CHECK((axes.moments - eigens).cwiseAbs().maxCoeff() < rounding);
        const Eigen::Matrix3d back = axes.directions.transpose() * tensor * axes.directions;
        CHECK((back - Eigen::Matrix3d(axes.moments.asDiagonal())).cwiseAbs().maxCoeff() < rounding);
        const Eigen::Matrix3d unit = axes.directions.transpose() * axes.directions;
        CHECK((unit - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-14);
        CHECK(voussoir_test::determinant(axes.directions) == voussoir_test::near(1).epsilon(1e-14));
      }
  }

  TEST_CASE("a tensor that is diagonal keeps its entries to the last bit, sorted") {
    const PrincipalAxes axes = principal_axes(Vec3(3.1, 1.7, 2.3).asDiagonal());
    CHECK(axes.moments == Vec3(1.7, 2.3, 3.1));
    CHECK(voussoir_test::determinant(axes.directions) == 1);
  }
}

}  // namespace principal_axes_test
