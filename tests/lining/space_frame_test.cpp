// SPDX-License-Identifier: MIT
// Elements in 3-D, pinned bars and bonded chains.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/lining/frame_element.hpp>

#include "support/dense_algebra.hpp"
#include "support/near.hpp"

namespace space_frame_test {

using namespace voussoir;

namespace {

LiningSection rib() { return LiningSection::strip(0.2, 0.5, 25e9); }

/// Deflection and end rotation of a cantilever of `elements` from the origin along `along`, loaded
/// at its tip [N]; all in world axes.
template <class Beam>
Eigen::Matrix<double, 6, 1> cantilever(int elements, const Vec3& along, const Vec3& outward,
                                       const Eigen::Matrix<double, 6, 1>& tip_load) {
  const int size = 6 * elements;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size + 6, size + 6);
  const Vec3 step = along / elements;
  const auto turn = in_element_axes<3>(frame_axes<3>(step, outward));
  const ElementMatrix<6> e =
      turn.transpose() * Beam::template stiffness<6>(rib(), step.norm()) * turn;
  for (int n = 0; n < elements; ++n) k.block<12, 12>(6 * n, 6 * n) += e;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(size);
  f.tail<6>() = tip_load;
  const Eigen::VectorXd u = voussoir_test::solve(k.bottomRightCorner(size, size), f);
  return u.tail<6>();
}

}  // namespace

TEST_SUITE("lining/space_frame") {
  TEST_CASE_TEMPLATE("elements are symmetric and do not resist rigid motion", Beam,
                     EulerBernoulliBeam, TimoshenkoBeam, BondedChain) {
    const double length = 0.7;
    const ElementMatrix<6> k = Beam::template stiffness<6>(rib(), length);
    CHECK((k - k.transpose()).norm() < 1e-12 * k.norm());
    for (int mode = 0; mode < 6; ++mode) {
      Eigen::Matrix<double, 12, 1> u = Eigen::Matrix<double, 12, 1>::Zero();
      const Vec3 shift = mode < 3 ? Vec3(Vec3::Unit(mode)) : Vec3::Zero();
      const Vec3 spin = mode < 3 ? Vec3::Zero() : Vec3(Vec3::Unit(mode - 3));
      u << shift, spin, shift + cross(spin, Vec3(length, 0, 0)), spin;
      CHECK((k * u).norm() < 1e-9 * k.norm());
    }
    const ElementMatrix<3> plane = Beam::template stiffness<3>(rib(), length);
    // What it does in its own plane is what the plane element does.
    constexpr int in_plane[] = {0, 1, 5, 6, 7, 11};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        CHECK(std::abs(k(in_plane[i], in_plane[j]) - plane(i, j)) < 1e-12 * k.norm());
  }

  TEST_CASE("a cantilever bends both ways and twists as theory says, however it lies") {
    const LiningSection s = rib();
    const double length = 3, load = 1e4;
    const Rotation<3> turn = rotation_by(Spin<3>(0.4, -0.7, 1.1));
    const Vec3 x = turn.col(0), y = turn.col(1), z = turn.col(2);
    const auto tip = [&](const Vec3& force, const Vec3& moment) {
      Eigen::Matrix<double, 6, 1> f;
      f << force, moment;
      return cantilever<EulerBernoulliBeam>(2, length * x, y + 0.3 * x, f);
    };
    const auto bent = tip(load * y, Vec3::Zero());
    const double cubed = length * length * length;
    CHECK(bent.head<3>().dot(y) == voussoir_test::near(load * cubed / (3 * s.bending_stiffness)));
    CHECK(bent.tail<3>().dot(z) ==
          voussoir_test::near(load * length * length / (2 * s.bending_stiffness)));
    CHECK(tip(load * z, Vec3::Zero()).head<3>().dot(z) ==
          voussoir_test::near(load * cubed / (3 * s.lateral_bending_stiffness)));
    CHECK(tip(Vec3::Zero(), load * x).tail<3>().dot(x) ==
          voussoir_test::near(load * length / s.torsional_stiffness));
    CHECK(tip(load * x, Vec3::Zero()).head<3>().dot(x) ==
          voussoir_test::near(load * length / s.axial_stiffness));
  }

  TEST_CASE("shear deformation adds P l / (kappa G A); a bonded chain tends to it") {
    const LiningSection s = rib();
    const double length = 1, load = 1e4;
    Eigen::Matrix<double, 6, 1> f = Eigen::Matrix<double, 6, 1>::Zero();
    f[1] = load;
    const Vec3 x = length * Vec3::UnitX(), y = Vec3::UnitY();
    const double exact = load * length * length * length / (3 * s.bending_stiffness) +
                         load * length / s.shear_stiffness;
    CHECK(cantilever<TimoshenkoBeam>(3, x, y, f)[1] == voussoir_test::near(exact).epsilon(1e-10));
    const double coarse = cantilever<BondedChain>(4, x, y, f)[1] - exact,
                 fine = cantilever<BondedChain>(8, x, y, f)[1] - exact;
    CHECK(std::abs(coarse / exact) < 0.05);
    CHECK(coarse / fine == voussoir_test::near(4).epsilon(0.02));
  }

  TEST_CASE("a strip has the torsion of a thin rectangle, and of a square") {
    // J of a square of side a: 0.1406 a^4; of a thin strip: b t^3 / 3 (Roark).
    const double g = 25e9 / 2.4;
    CHECK(LiningSection::strip(0.3, 0.3, 25e9).torsional_stiffness ==
          voussoir_test::near(g * 0.1406 * 0.0081).epsilon(3e-3));
    CHECK(LiningSection::strip(0.01, 2, 25e9).torsional_stiffness ==
          voussoir_test::near(g * 2 * 1e-6 / 3).epsilon(4e-3));
    CHECK_THROWS_AS((void)LiningSection::strip(0.1, 0, 25e9), InvalidInput);
  }

  TEST_CASE("pinned bars carry thrust alone") {
    const ElementMatrix<3> k = PinnedBar::stiffness<3>(rib(), 2);
    const double axial = rib().axial_stiffness / 2;
    Eigen::Matrix<double, 6, 1> u;
    u << 0, 1e-3, 0, 2e-3, -1e-3, 0;
    Eigen::Matrix<double, 6, 1> expected;
    expected << -2e-3 * axial, 0, 0, 2e-3 * axial, 0, 0;
    CHECK((k * u - expected).norm() < 1e-9 * axial);
  }
}

}  // namespace space_frame_test
