// SPDX-License-Identifier: MIT
// The inverses of small blocks beside Eigen's decompositions.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <voussoir/core/random.hpp>
#include <voussoir/linear/small_inverse.hpp>

#include "support/dense_algebra.hpp"

namespace small_inverse_test {

using voussoir::Fixed, voussoir::inverse_cholesky_factor, voussoir::inverse_of;

namespace {

template <int Size>
Eigen::Matrix<double, Size, Size> random_block(voussoir::Random& random) {
  Eigen::Matrix<double, Size, Size> a;
  for (int c = 0; c < Size; ++c)
    for (int r = 0; r < Size; ++r) a(r, c) = 2 * random.uniform() - 1;
  return a;
}

template <int Size>
struct Block {
  static constexpr int size = Size;
};

}  // namespace

TEST_SUITE("linear/small_inverse") {
  TEST_CASE_TEMPLATE("L^-1 is that of Eigen's Cholesky factor", B, Block<1>, Block<3>, Block<6>) {
    constexpr int n = B::size;
    using Matrix = Eigen::Matrix<double, n, n>;
    voussoir::Random random(1, n);
    for (int k = 0; k < 100; ++k) {
      const Matrix root = random_block<n>(random);
      const Matrix a = root * root.transpose() + 0.1 * Matrix::Identity();
      const auto ours = inverse_cholesky_factor<n>(a, Fixed<n, 1>::Zero());
      REQUIRE(ours.has_value());
      const Matrix eigens = voussoir_test::inverse_of_lower_factor(a);
      // Eigenvalues between 0.1 and some 10: a condition of 100 roundings at most.
      CHECK((*ours - eigens).cwiseAbs().maxCoeff() < 1e-13 * eigens.cwiseAbs().maxCoeff() * 100);
    }
  }

  TEST_CASE("what is not positive definite to the measure given is refused") {
    Fixed<3, 3> a = Fixed<3, 3>::Identity();
    a(2, 2) = 1e-14;
    CHECK(inverse_cholesky_factor<3>(a, Fixed<3, 1>::Zero()).has_value());
    CHECK_FALSE(inverse_cholesky_factor<3>(a, Fixed<3, 1>(0, 0, 1e-13)).has_value());
    a(1, 0) = 2;  // the lower triangle is read
    CHECK_FALSE(inverse_cholesky_factor<3>(a, Fixed<3, 1>::Zero()).has_value());
    a(1, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(inverse_cholesky_factor<3>(a, Fixed<3, 1>::Zero()).has_value());
  }

  TEST_CASE_TEMPLATE("the inverse times the matrix is one, pivots zero or not", B, Block<1>,
                     Block<3>, Block<6>) {
    constexpr int n = B::size;
    using Matrix = Eigen::Matrix<double, n, n>;
    voussoir::Random random(2, n);
    for (int k = 0; k < 100; ++k) {
      Matrix a = random_block<n>(random);
      if (n > 1 && k % 2 == 0) a(0, 0) = 0;  // no elimination without a change of rows
      const Matrix ours = inverse_of<n>(a);
      const Matrix eigens = voussoir_test::inverse(a);
      const double condition = a.cwiseAbs().sum() * eigens.cwiseAbs().sum();
      CHECK((ours - eigens).cwiseAbs().maxCoeff() <
            1e-15 * condition * eigens.cwiseAbs().maxCoeff());
      CHECK((ours * a - Matrix::Identity()).cwiseAbs().maxCoeff() < 1e-15 * condition);
    }
  }

  TEST_CASE("a singular block has no finite inverse") {
    CHECK_FALSE(voussoir::is_finite(inverse_of<3>(Fixed<3, 3>(Fixed<3, 3>::Zero()))));
  }
}

}  // namespace small_inverse_test
