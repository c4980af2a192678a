// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <vector>
#include <voussoir/laboratory/elastic_moduli.hpp>
#include <voussoir/laboratory/oedometer.hpp>
#include <voussoir/linear/small_inverse.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/theory/equivalent_moduli.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace elastic_moduli_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

constexpr double k_n = 5e9, k_s = 5e8;
const CoulombJoint joint({k_n, k_s, 35 * degree});

/// Endless joints of two sets, at equal distances.
RockMass<Planar> persistent(const std::vector<PersistentSet>& sets, double half_width) {
  const Domain<2> ground{{-half_width, -half_width}, {half_width, half_width}};
  std::vector<Joint> joints;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const Vec2 normal = sets[k].normal(), along(-normal.y(), normal.x());
    const double far = 2 * ground.diameter();
    const int count = static_cast<int>(far / sets[k].spacing);
    for (int n = -count; n <= count; ++n) {
      const Vec2 middle = (n + 0.37) * sets[k].spacing * normal;
      joints.push_back({Segment{middle - far * along, middle + far * along}, static_cast<int>(k)});
    }
  }
  return slice(ground, joints, {});
}

/// The largest difference of two entries, over the largest entry.
template <int Dim>
double difference(const ElasticMatrix<Dim>& a, const ElasticMatrix<Dim>& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_SUITE("laboratory/elastic_moduli") {
  // Blocks at the edge turn with the plates, which stiffens a layer as thick as a block: the
  // difference goes with block size over size of the mass.
  TEST_CASE("persistent joints: the sum over the sets, nearer the larger the mass") {
    const std::vector<PersistentSet> sets{{75 * degree, 1.0}, {-25 * degree, 0.8}};
    const Eigen::Matrix3d exact = inverse_of<3>(joint_compliance(sets, {k_n, k_s}));
    double before = 1;
    for (const double half_width : {5.0, 10.0, 20.0}) {
      CAPTURE(half_width);
      const double apart =
          difference<2>(elastic_moduli(persistent(sets, half_width), joint), exact);
      CHECK(apart < 0.22 / half_width);
      CHECK(apart < 0.6 * before);
      before = apart;
    }
  }

  // Isotropic where k_s = k_n, at any angle to the edge.
  TEST_CASE("squares at any angle: E = k s, G = k s / 2, no Poisson's ratio") {
    const CoulombJoint alike({k_n, k_n, 35 * degree});
    for (const double turn : {0.0, 20.0, 45.0}) {
      CAPTURE(turn);
      const auto rock = persistent({{turn * degree, 0.8}, {(turn - 90) * degree, 0.8}}, 8);
      const auto expected = elastic_matrix<2>({0.5 * k_n * 0.8, 0});
      CHECK(difference<2>(elastic_moduli(rock, alike), expected) < 0.03);
    }
  }

  TEST_CASE("in 3-D cubes: E = k s, G = k s / 2") {
    const CoulombJoint alike({k_n, k_n, 35 * degree});
    const auto expected = elastic_matrix<3>({0.5 * k_n, 0});
    for (const int half_width : {2, 4}) {
      CAPTURE(half_width);
      const double h = half_width;
      std::vector<SpatialJoint> joints;
      for (int axis = 0; axis < 3; ++axis)
        for (int n = -half_width; n < half_width; ++n) {
          Vec3 normal = zeros<Vec3>();
          normal[axis] = 1;
          joints.push_back({{HalfSpace<3>::through((n + 0.37) * normal, normal), {}}, axis});
        }
      const auto rock = slice<Spatial>(Domain<3>{{-h, -h, -h}, {h, h, h}}, joints, {});
      REQUIRE(rock.bodies.size() == static_cast<std::size_t>(std::pow(2 * half_width + 1, 3)));
      CHECK(difference<3>(elastic_moduli(rock, alike), expected) < 0.01);
    }
  }

  // Smooth walls restrain the blocks along them in another way than glued plates do: both are
  // within the width of a block over that of the mass of the mass without end.
  TEST_CASE("rock of the paper: as the oedometer reads it") {
    const Domain<2> ground{{-20, -20}, {20, 20}};
    const auto rock = jointed_rock(ground, 1);
    const auto matrix = elastic_moduli(rock, joint);
    const auto pressed = oedometer(rock, joint);
    CHECK(matrix(1, 1) == voussoir_test::near(pressed.constrained_modulus).epsilon(0.05));
    CHECK(matrix(0, 1) / matrix(1, 1) ==
          voussoir_test::near(pressed.stress_lateral / pressed.stress_axial).epsilon(0.05));
    CHECK((matrix - matrix.transpose()).norm() == 0);
  }

  TEST_CASE("an opening is refused") {
    const Domain<2> ground{{-10, -10}, {10, 10}};
    const auto rock = carve(jointed_rock(ground, 1), circular_opening(4, 24), 0.01);
    CHECK_THROWS_AS((void)elastic_moduli(rock, joint), InvalidInput);
  }
}

}  // namespace elastic_moduli_test
