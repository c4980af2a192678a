// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/detection/placed_shapes.hpp>

#include "support/pairs.hpp"

namespace placed_shapes_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

template <int Dim>
struct Dimensions {
  static constexpr int dim = Dim;
};

/// All numbers of a placed shape, padding included.
template <int Dim>
std::vector<double> numbers_of(const PlacedShape<Dim>& shape) {
  const std::size_t count = Dim * shape.vertex_stride() + (Dim + 1) * shape.face_stride();
  return {shape.data, shape.data + count};
}

template <int Dim>
Pose<Dim> random_pose(Random& random, double distance) {
  return {distance * random_vector<Dim>(random), random_rotation<Dim>(random)};
}

}  // namespace

TEST_SUITE("detection/placed_shapes") {
  TEST_CASE_TEMPLATE("placing moves vertices, normals and offsets as the pose says", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(1);
    for (int trial = 0; trial < 60; ++trial) {
      const auto plain_shape = shape_of_kind<dim>(random, trial % shape_kinds);
      const auto shape = convex(plain_shape);
      const Vec<dim> origin = 0.3 * random_vector<dim>(random);
      PlacedShapes<dim> shapes;
      shapes.add(shape, origin);
      const Pose<dim> pose = random_pose<dim>(random, 50);
      shapes.place(0, pose);
      const PlacedShape<dim> placed = shapes[0];
      REQUIRE(placed.vertex_count == shape.vertices().size());
      REQUIRE(placed.face_count == shape.size());
      // Some roundings of coordinates up to about 150 m, 1.4e-14 m each.
      constexpr double tolerance = 3e-13;
      for (std::size_t k = 0; k < placed.vertex_count; ++k)
        CHECK((shapes.grid_point(0) + placed.vertex(k) - pose(Vec<dim>(shape.vertex(k) - origin)))
                  .norm() < tolerance);
      for (std::size_t face = 0; face < placed.face_count; ++face) {
        const Vec<dim> normal = placed.normal(face);
        CHECK((normal - pose.rotation * shape.half_space(face).normal).norm() < 5e-16);
        double highest = -1e300;
        for (std::size_t k = 0; k < placed.vertex_count; ++k)
          highest = std::max(highest, normal.dot(placed.vertex(k)) - placed.offset(face));
        CHECK(std::abs(highest) < tolerance);
        const auto corner = static_cast<std::size_t>(plain_shape.faces[face].front());
        CHECK(std::abs(normal.dot(placed.vertex(corner)) - placed.offset(face)) < tolerance);
      }
    }
  }

  TEST_CASE_TEMPLATE("arrays are filled up with their last entry and aligned for registers", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(2);
    PlacedShapes<dim> shapes;
    std::vector<std::size_t> faces;
    for (const int kind : {0, 1, 2, 3, 2, 0}) {
      const auto shape = convex(shape_of_kind<dim>(random, kind));
      faces.push_back(shape.size());
      shapes.add(shape, Vec<dim>::Zero());
      shapes.place(shapes.size() - 1, random_pose<dim>(random, 3));
    }
    REQUIRE(shapes.size() == 6);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const PlacedShape<dim> placed = shapes[i];
      CHECK(placed.face_count == faces[i]);
      CHECK(placed.vertex_stride() % lane_count == 0);
      CHECK(placed.face_stride() % lane_count == 0);
      CHECK(reinterpret_cast<std::uintptr_t>(placed.data) % EIGEN_MAX_ALIGN_BYTES == 0);
      for (int axis = 0; axis < dim; ++axis) {
        for (std::size_t k = placed.vertex_count; k < placed.vertex_stride(); ++k)
          CHECK(placed.vertices(axis)[k] == placed.vertices(axis)[placed.vertex_count - 1]);
        for (std::size_t k = placed.face_count; k < placed.face_stride(); ++k)
          CHECK(placed.normals(axis)[k] == placed.normals(axis)[placed.face_count - 1]);
      }
      for (std::size_t k = placed.face_count; k < placed.face_stride(); ++k)
        CHECK(placed.offset(k) == placed.offset(placed.face_count - 1));
    }
  }

  TEST_CASE_TEMPLATE("a shape added is where it was given, in site coordinates too", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(3);
    auto given = shape_of_kind<dim>(random, 1);
    const Vec<dim> far = 1e6 * Vec<dim>::Ones();
    for (auto& vertex : given.vertices) vertex += far;
    PlacedShapes<dim> shapes;
    shapes.add(convex(given), far);
    // Differences of numbers that near are exact (Sterbenz), so nothing is rounded on the way.
    for (std::size_t k = 0; k < given.vertices.size(); ++k)
      CHECK(shapes.grid_point(0) + shapes[0].vertex(k) == given.vertices[k]);
    Pose<dim> near;
    shapes.place(0, near);
    for (std::size_t k = 0; k < given.vertices.size(); ++k)
      CHECK(shapes[0].vertex(k) == Vec<dim>(given.vertices[k] - far));
    CHECK(shapes.grid_point(0) == Vec<dim>::Zero());
  }

  TEST_CASE_TEMPLATE("nothing drifts, and the others stay, however often a shape is placed", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(4);
    PlacedShapes<dim> shapes;
    for (const int kind : {2, 1, 3})
      shapes.add(convex(shape_of_kind<dim>(random, kind)), Vec<dim>::Zero());
    for (std::size_t i = 0; i < 3; ++i) shapes.place(i, random_pose<dim>(random, 10));
    const auto before = numbers_of(shapes[0]), after = numbers_of(shapes[2]);
    const Pose<dim> pose = random_pose<dim>(random, 10);
    shapes.place(1, pose);
    const auto first = numbers_of(shapes[1]);
    for (int k = 0; k < 100; ++k) shapes.place(1, random_pose<dim>(random, 1e3));
    CHECK(numbers_of(shapes[1]) != first);
    shapes.place(1, pose);
    CHECK(numbers_of(shapes[1]) == first);
    CHECK(numbers_of(shapes[0]) == before);
    CHECK(numbers_of(shapes[2]) == after);
  }

  TEST_CASE("a polyhedron's edges join the two faces they say, in the direction they say") {
    Random random(5);
    PlacedShapes<3> shapes;
    std::vector<PlainShape<3>> given;
    for (int kind = 0; kind < shape_kinds; ++kind) {
      given.push_back(shape_of_kind<3>(random, kind));
      shapes.add(convex(given.back()), Vec3::Zero());
    }
    for (std::size_t i = 0; i < given.size(); ++i) {
      const Topology topology = shapes.topology(i);
      // Euler's formula.
      CHECK(given[i].vertices.size() + given[i].faces.size() == topology.edges.size() + 2);
      for (std::size_t face = 0; face < given[i].faces.size(); ++face)
        REQUIRE(topology.loop(face).size() == given[i].faces[face].size());
      const auto runs_along = [&](std::size_t face, int from, int to) {
        const auto loop = topology.loop(face);
        for (std::size_t k = 0; k < loop.size(); ++k)
          if (loop[k] == from && loop[(k + 1) % loop.size()] == to) return true;
        return false;
      };
      for (const auto& edge : topology.edges) {
        CHECK(runs_along(edge.left, edge.from, edge.to));
        CHECK(runs_along(edge.right, edge.to, edge.from));
      }
      for (std::size_t face = 0; face < given[i].faces.size(); ++face) {
        const auto loop = topology.loop(face);
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const Topology::Edge& edge = topology.edges[topology.side(face, k)];
          const bool left = edge.left == face;
          CHECK((left ? edge.left : edge.right) == face);
          CHECK((left ? edge.from : edge.to) == loop[k]);
          CHECK((left ? edge.to : edge.from) == loop[(k + 1) % loop.size()]);
        }
      }
    }
  }

  TEST_CASE_TEMPLATE("a pose that is not a number is refused, with the shape's number", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(6);
    PlacedShapes<dim> shapes;
    for (int k = 0; k < 3; ++k) shapes.add(convex(shape_of_kind<dim>(random, k)), Vec<dim>::Zero());
    const auto before = numbers_of(shapes[1]);
    for (const double wrong :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      Pose<dim> moved, turned;
      moved.position[dim - 1] = wrong;
      turned.rotation(0, dim - 1) = wrong;
      for (const auto& pose : {moved, turned}) {
        std::string message;
        try {
          shapes.place(1, pose);
        } catch (const InvalidInput& error) {
          message = error.what();
        }
        CHECK(message.find("shape 1") != std::string::npos);
        CHECK(message.find("finite") != std::string::npos);
      }
    }
    CHECK(numbers_of(shapes[1]) == before);
  }

  TEST_CASE("a shape that cannot be added is refused and leaves nothing behind") {
    PlacedShapes<2> shapes;
    const ConvexPolygon square = polygon(rectangle(1, 1));
    const auto nowhere = Vec2(0, std::numeric_limits<double>::quiet_NaN());
    CHECK_THROWS_WITH_AS(shapes.add(square, nowhere),
                         "placed shapes: shape 0: the origin of its frame must be finite",
                         InvalidInput);
    CHECK_THROWS_WITH_AS(shapes.add(polygon(regular(65536, 1)), Vec2(0, 0)),
                         "placed shapes: shape 0 has more than 65535 vertices or faces",
                         InvalidInput);
    CHECK(shapes.size() == 0);
    CHECK(shapes.add(square, Vec2(0, 0)) == 0);
  }
}

}  // namespace placed_shapes_test
