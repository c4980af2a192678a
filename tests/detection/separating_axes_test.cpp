// SPDX-License-Identifier: MIT
// The reference that contact detection is tested with must itself be right.
#include "support/separating_axes.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/pairs.hpp"

namespace separating_axes_test {

using namespace voussoir_test;

namespace {

template <int Dim>
struct Dimensions {
  static constexpr int dim = Dim;
};

[[nodiscard]] PlainShape<3> unit_cube() { return prism(rectangle(1, 1), Vec3(0, 0, 1)); }

[[nodiscard]] Pose<3> at(const Vec3& position, const voussoir::Spin<3>& spin) {
  return {position, voussoir::rotation_by(spin)};
}

}  // namespace

TEST_SUITE("detection/separating_axes") {
  TEST_CASE("cubes corner to face, edge to edge and face to face have their textbook depths") {
    const auto cube = unit_cube();
    const auto fixed = long_shape(cube, {});
    const double pi = std::numbers::pi;
    SUBCASE("edge to edge: a diamond's ridge across a ridge") {
      // Turned by 45 degrees about x, a cube has a ridge along x at z = sqrt(1/2); turned about y
      // and then below, one along y.
      const auto a = long_shape(cube, at({0, 0, 0}, {pi / 4, 0, 0}));
      for (const double gap : {-0.01, 0.02}) {
        const auto b = long_shape(cube, at({0, 0, std::sqrt(2.0) + gap}, {0, pi / 4, 0}));
        const auto answer = separating_axes(a, b);
        CHECK(std::abs(static_cast<double>(answer.value) - gap) < 1e-15);
        CHECK(std::abs(static_cast<double>(answer.normal[2]) - 1) < 1e-15);
        if (gap > 0) CHECK(std::abs(static_cast<double>(distance_apart(a, b)) - gap) < 1e-15);
      }
    }
    SUBCASE("corner to face") {
      // The diagonal of b upright: its lowest corner is sqrt(3)/2 below its centre.
      const double tilt = std::acos(1 / std::sqrt(3.0));
      const auto spin = voussoir::Spin<3>(tilt * Vec3(1, -1, 0).normalized());
      const auto b = long_shape(cube, at({0.1, 0.2, 0.5 + std::sqrt(0.75) - 0.03}, spin));
      CHECK(std::abs(static_cast<double>(separating_axes(fixed, b).value) + 0.03) < 1e-15);
    }
    SUBCASE("corner to corner: the axes know less than the distance") {
      const auto b = long_shape(cube, at({2, 2, 2}, {0, 0, 0}));
      CHECK(static_cast<double>(separating_axes(fixed, b).value) == 1);
      CHECK(std::abs(static_cast<double>(distance_apart(fixed, b)) - std::sqrt(3.0)) < 1e-15);
    }
    SUBCASE("the part of a face inside the other block") {
      const auto b = long_shape(cube, at({0.25, 0.5, 0.75}, {0, 0, 0}));
      // The floor of b (face 0 of a prism) overlaps a in 0.75 m x 0.5 m.
      CHECK(static_cast<double>(measure_of<3>(face_inside(b, 0, fixed))) == 0.375);
      CHECK(face_inside(b, 1, fixed).empty());
    }
  }

  TEST_CASE("a face too short to tell a direction is left out") {
    // A square with a corner cut off by 1e-10 m, another 3 m to the right and 3 m up. The distance
    // is that of the corners, 3 sqrt(2); the face at 45 degrees finds it as exactly as corners
    // known to 1e-16 m tell its direction, the long faces find 3.
    const double cut = 1e-10;
    const PlainShape<2> a{{{0, 0}, {1, 0}, {1, 1 - cut}, {1 - cut, 1}, {0, 1}},
                          {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}};
    const PlainShape<2> b{{{4, 4}, {5, 4}, {5, 5}, {4, 5}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
    const auto from = long_shape(a, {}), to = long_shape(b, {});
    CHECK(std::abs(static_cast<double>(separating_axes(from, to, 0).value) - std::sqrt(18.0)) <
          1e-5);
    CHECK(static_cast<double>(separating_axes(from, to, 1e-8).value) == 3);
  }

  TEST_CASE_TEMPLATE("no direction separates better, and moving by the depth comes free", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(3);
    long double excess = -1, left = 0, shorter = 0;
    for (int trial = 0; trial < (dim == 2 ? 400 : 100); ++trial) {
      const auto pair = random_pair<dim>(random);
      const auto a = long_shape(pair.a, pair.pose_a), b = long_shape(pair.b, pair.pose_b);
      const auto answer = separating_axes(a, b);
      for (int k = 0; k < 50; ++k) {
        // All around, and close to the answer, where a missed axis would show.
        LongVec<dim> direction = random_vector<dim>(random).template cast<long double>();
        if (k % 2 == 0) direction = answer.normal + 1e-3L * direction;
        const long double room = room_along<dim>(a, b, direction.normalized());
        // In a gap directions between the axes know more, up to the distance.
        if (answer.value <= 0) excess = std::max(excess, room - answer.value);
      }
      auto moved = b;
      if (answer.value <= 0)
        for (auto& vertex : moved.vertices) vertex -= answer.value * answer.normal;
      else
        shorter = std::max(shorter, answer.value - distance_apart(a, b));
      if (answer.value <= 0)
        left = std::max(left, std::abs(room_along<dim>(a, moved, answer.normal)));
    }
    // Roundings of long double at 60 m, 3e-18 m each.
    CHECK(static_cast<double>(excess) < 1e-16);
    CHECK(static_cast<double>(left) < 1e-16);
    CHECK(static_cast<double>(shorter) < 1e-16);
  }
}

}  // namespace separating_axes_test
