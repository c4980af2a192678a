// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/detection/detail/least_excess.hpp>
#include <voussoir/geometry/linear_program.hpp>

#include "support/long_planes.hpp"
#include "support/pairs.hpp"

namespace least_excess_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

template <int Dim>
struct Dimensions {
  static constexpr int dim = Dim;
};

}  // namespace

TEST_SUITE("detection/least_excess") {
  TEST_CASE_TEMPLATE("the least excess is that of the best set of planes, and of Seidel's method",
                     D, Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    using Program = detail::LeastExcess<dim>;
    using V = Vec<dim>;
    Random random(7);
    detail::ActivePlanes<dim> earlier = detail::no_planes<dim>;
    detail::PlanePair<dim> planes;
    int overlapping = 0;
    for (int trial = 0; trial < (dim == 2 ? 300 : 60); ++trial) {
      CAPTURE(trial);
      PlainPair<dim> pair;
      do pair = random_pair<dim>(random);
      while (pair.a.faces.size() > 8 || pair.b.faces.size() > 8);
      // Near the origin, for small roundings.
      for (Pose<dim>* pose : {&pair.pose_b, &pair.pose_a})
        pose->position -= V(pair.pose_a.position);
      PlacedShapes<dim> shapes;
      shapes.add(convex(pair.a), V::Zero());
      shapes.add(convex(pair.b), V::Zero());
      shapes.place(0, pair.pose_a);
      shapes.place(1, pair.pose_b);
      planes.gather(shapes[0], shapes[1], V::Zero());
      const Program cold(planes, 10, detail::no_planes<dim>, detail::Until::optimum);
      LongPlanes<dim> same;
      for (std::size_t k = 0; k < planes.count(); ++k) {
        same.normals.push_back(planes.normal_of(k).template cast<long double>());
        same.offsets.push_back(planes.room_of(k));
      }
      // The program stops 1e-15 of the region, 10 m, from its optimum.
      CHECK(std::abs(cold.excess() - static_cast<double>(least_excess_by_sets(same))) < 1.1e-14);
      if (cold.excess() < 0) ++overlapping;

      // Any start gives the same, and so does the sign alone.
      const Program warm(planes, 10, earlier, detail::Until::optimum);
      CHECK(std::abs(warm.excess() - cold.excess()) < 1.1e-14);
      if (std::abs(cold.excess()) > 1e-13) {
        const Program sign(planes, 10, earlier, detail::Until::sign);
        CHECK((sign.excess() < 0) == (cold.excess() < 0));
      }
      earlier = cold.active();

      std::vector<LinearConstraint<dim + 1>> constraints;
      Eigen::Matrix<double, dim + 1, 1> objective = Eigen::Matrix<double, dim + 1, 1>::Zero();
      objective[dim] = 1;
      for (std::size_t k = 0; k < planes.count(); ++k) {
        Eigen::Matrix<double, dim + 1, 1> normal;
        normal << planes.normal_of(k), 1;
        constraints.push_back({normal, planes.room_of(k)});
      }
      const auto seidel = maximise<dim + 1>(objective, constraints, 100);
      REQUIRE(seidel.has_value());
      CHECK(std::abs(-(*seidel)[dim] - cold.excess()) < 1e-11);  // it obeys to 1e-14 of its bound
    }
    CHECK(overlapping > 20);
  }

  TEST_CASE_TEMPLATE("blocks of metres: the filling of the last group of planes is no plane", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    using V = Vec<dim>;
    // Twice an equilateral triangle, inscribed radius 5 m, or a prism on it that is 20 m high:
    // 6 planes, or 10, in groups of 4.
    PlacedShapes<dim> shapes;
    for (int copy = 0; copy < 2; ++copy) {
      if constexpr (dim == 2)
        shapes.add(convex(plain(regular(3, 10))), V::Zero());
      else
        shapes.add(convex(prism(regular(3, 10), Vec3(0, 0, 20))), V::Zero());
    }
    detail::PlanePair<dim> planes;
    planes.gather(shapes[0], shapes[1], V::Zero());
    REQUIRE(planes.padded_count() > planes.count());
    const detail::LeastExcess<dim> program(planes, 20, detail::no_planes<dim>,
                                           detail::Until::optimum);
    CHECK(std::abs(program.excess() + 5) < 2e-14);
    CHECK(std::abs(planes.smallest_room() - 5) < 2e-14);
  }
}

}  // namespace least_excess_test
