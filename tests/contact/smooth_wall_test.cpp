// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <type_traits>
#include <voussoir/contact/smooth_wall.hpp>

namespace smooth_wall_test {

using namespace voussoir;

namespace {
template <int Dim>
using Dimension = std::integral_constant<int, Dim>;
}

TEST_SUITE("contact/smooth_wall") {
  TEST_CASE_TEMPLATE("the normal force has slope w k_n and ends where the wall opens", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const SmoothWall wall(5e9);
    PointLoad<dim> load{0.25, {}, {1e-5, Vec<dim - 1>::Zero()}};
    load.initial.normal = 2e4;
    // 2e4 - 0.25 * 5e9 * 1e-5 = 7.5e3 N; it opens at 2e4 / (0.25 * 5e9) = 1.6e-5 m.
    CHECK(std::abs(wall.force(load, SmoothWall::State<dim>{}).normal - 7.5e3) <= 1e-15 * 2e4);
    load.motion.opening = 1.61e-5;
    CHECK(wall.force(load, SmoothWall::State<dim>{}).normal == 0);
  }

  TEST_CASE_TEMPLATE("no shear, whatever the slip and the initial shear", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const SmoothWall wall(5e9);
    PointLoad<dim> load{0.25, {}, {0, Vec<dim - 1>::Constant(0.3)}};
    load.initial = {2e4, Vec<dim - 1>::Constant(1e3)};
    SmoothWall::State<dim> state;
    CHECK(wall.force(load, state).tangential == Vec<dim - 1>::Zero());
    wall.commit(load, state);
    CHECK(wall.force(load, state).tangential == Vec<dim - 1>::Zero());
    CHECK(wall.joint_shear_stiffness() == 0);
  }

  TEST_CASE("a stiffness that is not positive and finite is refused") {
    for (const double bad : {0.0, -5e9, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()})
      CHECK_THROWS_AS(SmoothWall{bad}, InvalidInput);
  }
}

}  // namespace smooth_wall_test
