// SPDX-License-Identifier: MIT
// Plain loops beside Eigen's own expressions, which code outside namespace voussoir still gets.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <voussoir/core/random.hpp>
#include <voussoir/core/small_algebra.hpp>
#include <voussoir/core/vec.hpp>

namespace small_algebra_test {

namespace {

template <int Rows, int Cols>
using Matrix = Eigen::Matrix<double, Rows, Cols>;

template <int Rows, int Cols>
Matrix<Rows, Cols> random_matrix(voussoir::Random& random) {
  Matrix<Rows, Cols> a;
  for (int c = 0; c < Cols; ++c)
    for (int r = 0; r < Rows; ++r) a(r, c) = 2 * random.uniform() - 1;
  return a;
}

/// A matrix of any size: Eigen's expressions of these are compiled once for all sizes.
using Any = Eigen::MatrixXd;
template <int Rows, int Cols>
Any any(const Matrix<Rows, Cols>& a) {
  return Eigen::Map<const Any>(a.data(), Rows, Cols);
}

/// Products of entries below 1: a sum of n of them is known to n roundings of 1, whatever its
/// order.
bool same_to_rounding(const Any& ours, const Any& eigens, int terms) {
  return (ours - eigens).cwiseAbs().maxCoeff() <= terms * std::numeric_limits<double>::epsilon();
}

template <int Rows, int Inner, int Cols>
struct Sizes {
  static constexpr int rows = Rows, inner = Inner, cols = Cols;
};

}  // namespace

TEST_SUITE("core/small_algebra") {
  // The type of a sum tells which operator was taken: a value, not an expression.
  TEST_CASE("code in namespace voussoir gets values, code outside it expressions") {
    const voussoir::Vec3 a(1, 2, 3), b(4, 5, 6);
    const auto ours = voussoir::operator+(a, b);
    const auto eigens = a + b;
    CHECK(std::is_same_v<std::remove_const_t<decltype(ours)>, voussoir::Vec3>);
    CHECK_FALSE(std::is_same_v<std::remove_const_t<decltype(eigens)>, voussoir::Vec3>);
    CHECK(ours == eigens);
  }

  TEST_CASE_TEMPLATE("sums and products are Eigen's", Size, Sizes<1, 1, 1>, Sizes<2, 2, 1>,
                     Sizes<3, 3, 1>, Sizes<2, 3, 3>, Sizes<3, 3, 3>, Sizes<6, 6, 6>, Sizes<6, 3, 6>,
                     Sizes<12, 12, 12>) {
    constexpr int R = Size::rows, N = Size::inner, C = Size::cols;
    voussoir::Random random(1, R + 100 * N + 10000 * C);
    for (int k = 0; k < 20; ++k) {
      const Matrix<R, N> a = random_matrix<R, N>(random), c = random_matrix<R, N>(random);
      const Matrix<N, C> b = random_matrix<N, C>(random);
      // Entry by entry there is one rounding, the same one.
      const Any x = any(a), y = any(b), z = any(c);
      CHECK(any(voussoir::operator+(a, c)) == x + z);
      CHECK(any(voussoir::operator-(a, c)) == x - z);
      CHECK(any(voussoir::operator-(a)) == -x);
      CHECK(any(voussoir::operator*(0.3, a)) == 0.3 * x);
      CHECK(any(voussoir::operator*(a, 3)) == x * 3);
      CHECK(any(voussoir::operator/(a, 0.7)) == x / 0.7);
      const Matrix<N, R> a_turned = voussoir::transposed(a);
      const Matrix<C, N> b_turned = voussoir::transposed(b);
      CHECK(any(a_turned) == x.transpose());
      const Any product = x * y;
      CHECK(same_to_rounding(any(voussoir::operator*(a, b)), product, 2 * N));
      CHECK(same_to_rounding(any(voussoir::transposed_product(a_turned, b)), product, 2 * N));
      Matrix<R, C> left = random_matrix<R, C>(random), other = left;
      const Any expected = any(left) - product;
      voussoir::subtract_product(left, a, b);
      CHECK(same_to_rounding(any(left), expected, 2 * N + 2));
      voussoir::subtract_product_transposed(other, a, b_turned);
      CHECK(same_to_rounding(any(other), expected, 2 * N + 2));
    }
  }

  TEST_CASE("parts, rows, columns and blocks are those of Eigen") {
    voussoir::Random random(2, 0);
    const Matrix<6, 6> a = random_matrix<6, 6>(random);
    const Matrix<6, 1> v = random_matrix<6, 1>(random);
    CHECK(voussoir::part<3>(v, 2) == v.segment<3>(2));
    CHECK(voussoir::part<2>(Eigen::VectorXd(v), 4) == v.segment<2>(4));
    CHECK(voussoir::column(a, 4) == a.col(4));
    CHECK(voussoir::row(a, 1) == a.row(1).transpose());
    CHECK(voussoir::block_at<2, 3>(a, 1, 2) == a.block<2, 3>(1, 2));
    CHECK(voussoir::outer(v, v) == v * v.transpose());
    CHECK(voussoir::diagonal_of<4>(2.5) == 2.5 * Matrix<4, 4>::Identity());
    CHECK(voussoir::axis_vector<3>(1) == voussoir::Vec3::UnitY());
    const Matrix<3, 1> upper = v.head<3>(), lower = v.tail<3>();
    CHECK(voussoir::stacked(upper, lower) == v);
    CHECK(voussoir::stacked(v[0], Matrix<5, 1>(v.tail<5>())) == v);
    Matrix<6, 6> b = a;
    voussoir::set_block(b, 3, 1, Matrix<2, 2>(Matrix<2, 2>::Zero()));
    voussoir::set_row(b, 0, v);
    voussoir::set_column(b, 5, v);
    Matrix<6, 6> expected = a;
    expected.block<2, 2>(3, 1).setZero();
    expected.row(0) = v.transpose();
    expected.col(5) = v;
    CHECK(b == expected);
    CHECK(voussoir::by_rows<2, 3>({1, 2, 3, 4, 5, 6}) ==
          (Matrix<2, 3>() << 1, 2, 3, 4, 5, 6).finished());
  }

  TEST_CASE_TEMPLATE(
      "products of vectors and sums in place, bit by bit where nothing is rounded twice", Size,
      Sizes<1, 1, 1>, Sizes<2, 1, 1>, Sizes<3, 1, 1>, Sizes<6, 1, 1>) {
    constexpr int size = Size::rows;
    voussoir::Random random(5, size);
    for (int round = 0; round < 100; ++round) {
      const auto a = random_matrix<size, 1>(random), b = random_matrix<size, 1>(random);
      const double dot = voussoir::dot_product(a, b), tolerance = size * 2.3e-16;
      CHECK(std::abs(dot - a.dot(b)) <= tolerance);
      CHECK(std::abs(voussoir::squared_length_of(a) - a.squaredNorm()) <= tolerance);
      CHECK(std::abs(voussoir::length_of(a) - a.norm()) <= tolerance);
      CHECK(same_to_rounding(any(voussoir::normalized(a)), any(a) / any(a).norm(), 2));
      Matrix<size, 1> ours = a, eigens = a;
      voussoir::operator+=(ours, b);
      CHECK(ours == (eigens += b));
      voussoir::operator-=(ours, Matrix<size, 1>(3 * b));
      CHECK(ours == (eigens -= Matrix<size, 1>(3 * b)));
      voussoir::operator*=(ours, 0.3);
      CHECK(ours == (eigens *= 0.3));
      voussoir::operator/=(ours, 7);
      CHECK(ours == (eigens /= 7));
      CHECK(voussoir::operator==(ours, eigens));
    }
    const auto none = voussoir::zeros<Matrix<size, 1>>();
    CHECK(none == Matrix<size, 1>::Zero());
    CHECK(voussoir::normalized(none) == none);
    CHECK(voussoir::zeros<Matrix<size, 2>>() == Matrix<size, 2>::Zero());
  }

  TEST_CASE("comparisons entry by entry, and numbers that are none") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const voussoir::Vec2 low(1, 2), high(3, 4), across(0, 5), none(nan, 0);
    CHECK(voussoir::all_less(low, high));
    CHECK_FALSE(voussoir::all_less(low, across));
    CHECK_FALSE(voussoir::all_less(low, low));
    CHECK(voussoir::all_less_equal(low, low));
    CHECK(voussoir::any_less(across, low));
    CHECK_FALSE(voussoir::any_less(high, low));
    CHECK_FALSE(voussoir::all_less(none, high));
    CHECK_FALSE(voussoir::all_less_equal(none, none));
    CHECK_FALSE(voussoir::is_finite(none));
    CHECK(voussoir::is_finite(low));
    CHECK(voussoir::smaller_of(low, across) == voussoir::Vec2(0, 2));
    CHECK(voussoir::larger_of(low, across) == voussoir::Vec2(1, 5));
    CHECK(voussoir::largest_entry(across) == 5);
    CHECK(voussoir::smallest_entry(across) == 0);
    CHECK(voussoir::product_of_entries(high) == 12);
    CHECK(voussoir::shifted_by(low, -1) == voussoir::Vec2(0, 1));
    CHECK(voussoir::scaled_by(low, high) == voussoir::Vec2(3, 8));
    CHECK(voussoir::quotients(high, low) == voussoir::Vec2(3, 2));
    CHECK(voussoir::magnitudes(voussoir::Vec2(-1, 2)) == low);
    CHECK(voussoir::is_zero(voussoir::Vec2(0, -0.0)));
    CHECK_FALSE(voussoir::operator==(none, none));
  }
}

}  // namespace small_algebra_test
