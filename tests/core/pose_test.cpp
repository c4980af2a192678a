// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/random.hpp>

namespace pose_test {

using namespace voussoir;

namespace {

using LongMatrix = Eigen::Matrix<long double, 3, 3>;

/// exp of a skew matrix: power series of a small part of it, squared up again.
LongMatrix exponential(const Spin<3>& spin) {
  constexpr int halvings = 10;
  LongMatrix skew;
  const Eigen::Matrix<long double, 3, 1> s = spin.cast<long double>() / (1 << halvings);
  skew << 0, -s[2], s[1], s[2], 0, -s[0], -s[1], s[0], 0;
  LongMatrix sum = LongMatrix::Identity(), term = sum;
  for (int k = 1; k < 25; ++k) {
    term = (term * skew / static_cast<long double>(k)).eval();
    sum += term;
  }
  for (int k = 0; k < halvings; ++k) sum = (sum * sum).eval();
  return sum;
}

constexpr std::array<double, 12> angles{0,    1e-300, 1e-12, 1e-9,  0.9e-8, 1.1e-8,
                                        1e-5, 1e-3,   0.5,   3.141, 10,     100};

double largest(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

}  // namespace

TEST_SUITE("core/pose") {
  TEST_CASE("a rotation is the exponential of its spin, from nothing to a hundred radians") {
    Random random(1);
    for (const double angle : angles)
      for (int trial = 0; trial < 20; ++trial) {
        const Vec3 direction{random.normal(), random.normal(), random.normal()};
        const Spin<3> spin = angle * direction.normalized();
        const Rotation<3> turned = rotation_by(spin);
        // Roundings of the matrix, and of the angle times the angle.
        const double bound = 1e-15 + 4e-16 * angle;
        CHECK(largest(turned - exponential(spin).cast<double>()) < bound);
        // A small rotation must not lose its few digits beside the identity.
        const Rotation<3> change = turned - turned.transpose();
        if (angle > 0 && angle < 1e-2)
          CHECK(std::abs(0.5 * change(1, 0) - spin[2]) <= 3e-16 * angle + angle * angle * angle);
      }
  }

  TEST_CASE("a rotation is orthogonal to rounding and keeps right-handed axes right-handed") {
    Random random(2);
    for (const double angle : angles)
      for (int trial = 0; trial < 20; ++trial) {
        const Vec3 direction{random.normal(), random.normal(), random.normal()};
        const Rotation<3> turned = rotation_by(Spin<3>(angle * direction.normalized()));
        CHECK(largest(turned * turned.transpose() - Rotation<3>::Identity()) < 2e-15);
        CHECK((cross(turned.col(0), turned.col(1)) - turned.col(2)).norm() < 2e-15);
        const Rotation<2> plane = rotation_by(Spin<2>(angle * random.normal()));
        CHECK(largest(plane * plane.transpose() - Rotation<2>::Identity()) < 5e-16);
        CHECK(cross(plane.col(0), plane.col(1)) > 0);
      }
  }

  TEST_CASE("positive spins turn anticlockwise in 2-D and right-handed in 3-D") {
    const double quarter = std::numbers::pi / 2;
    CHECK((rotation_by(Spin<2>(quarter)) * Vec2(1, 0) - Vec2(0, 1)).norm() < 1e-16);
    for (int axis = 0; axis < 3; ++axis) {
      const Rotation<3> turned = rotation_by(Spin<3>(quarter * Vec3::Unit(axis)));
      CHECK((turned * Vec3::Unit((axis + 1) % 3) - Vec3::Unit((axis + 2) % 3)).norm() < 5e-16);
      CHECK((turned * Vec3::Unit(axis) - Vec3::Unit(axis)).norm() < 1e-16);
    }
    // A small one agrees with `turned` of core/vec.hpp, which moves the points of a body.
    const Spin<3> spin(1e-9, -2e-9, 3e-9);
    const Vec3 arm(3, 1, -2);
    CHECK((rotation_by(spin) * arm - arm - turned(spin, arm)).norm() < 1e-15);
    const Spin<2> turn(1e-9);
    CHECK((rotation_by(turn) * Vec2(3, 1) - Vec2(3, 1) - turned(turn, Vec2(3, 1))).norm() < 1e-15);
  }

  TEST_CASE("rotations about one axis add up, in 2-D and 3-D") {
    Random random(3);
    for (int trial = 0; trial < 50; ++trial) {
      const double first = 3 * random.normal(), second = 3 * random.normal();
      const Vec3 axis = Vec3{random.normal(), random.normal(), random.normal()}.normalized();
      const Rotation<3> both =
          rotation_by(Spin<3>(first * axis)) * rotation_by(Spin<3>(second * axis));
      CHECK(largest(both - rotation_by(Spin<3>((first + second) * axis))) < 2e-14);
      const Rotation<2> plane = rotation_by(Spin<2>(first)) * rotation_by(Spin<2>(second));
      CHECK(largest(plane - rotation_by(Spin<2>(first + second))) < 2e-14);
    }
  }

  TEST_CASE("a pose turns about the body's own origin and then moves it") {
    Pose<2> flat;
    CHECK(flat(Vec2(3, 4)) == Vec2(3, 4));
    flat = {Vec2(10, 20), rotation_by(Spin<2>(std::numbers::pi / 2))};
    CHECK(flat(Vec2(0, 0)) == Vec2(10, 20));
    CHECK((flat(Vec2(1, 0)) - Vec2(10, 21)).norm() < 1e-14);
    const Pose<3> space{Vec3(1, 2, 3), rotation_by(Spin<3>(0, 0, std::numbers::pi / 2))};
    CHECK((space(Vec3(1, 0, 5)) - Vec3(1, 3, 8)).norm() < 1e-15);
  }
}

}  // namespace pose_test
