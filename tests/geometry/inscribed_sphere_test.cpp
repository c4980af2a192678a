// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/inscribed_ball.hpp>
#include <voussoir/geometry/mass_properties.hpp>

#include "support/solids.hpp"

namespace inscribed_sphere_test {

using namespace voussoir;
using voussoir_test::box;
using voussoir_test::placed;

namespace {

using Real = long double;

/// n . x + r = c at distance r below a face, relative to vertex 0.
struct Plane {
  std::array<Real, 3> n;
  Real c;
};
std::vector<Plane> planes_of(const ConvexPolyhedron& shape) {
  std::vector<Plane> planes;
  for (std::size_t f = 0; f < shape.size(); ++f) {
    Plane plane{};
    const Vec3& on_face = shape.vertex(static_cast<std::size_t>(shape.loop(f).front()));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = static_cast<Eigen::Index>(i);
      plane.n[i] = shape.half_space(f).normal[e];
      plane.c += plane.n[i] * (static_cast<Real>(on_face[e]) - shape.vertex(0)[e]);
    }
    planes.push_back(plane);
  }
  return planes;
}

/// Distance from a point to the nearest face, negative outside.
Real clearance(const std::vector<Plane>& planes, const std::array<Real, 3>& x) {
  Real least = 1e300L;
  for (const Plane& p : planes)
    least = std::min(least, p.c - p.n[0] * x[0] - p.n[1] * x[1] - p.n[2] * x[2]);
  return least;
}

/// The radius by brute force: the ball of every four faces; the one with the most clearance.
double radius_of_all_fours(const std::vector<Plane>& planes) {
  Real best = 0;
  const std::size_t count = planes.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k)
        for (std::size_t l = k + 1; l < count; ++l) {
          // Subtracting the first equation leaves three for the centre: Cramer's rule.
          std::array<std::array<Real, 4>, 3> rows{};
          for (std::size_t r = 0; r < 3; ++r) {
            const Plane& p = planes[std::array{j, k, l}[r]];
            for (std::size_t e = 0; e < 3; ++e) rows[r][e] = p.n[e] - planes[i].n[e];
            rows[r][3] = p.c - planes[i].c;
          }
          const auto determinant = [&](std::size_t a, std::size_t b, std::size_t c) {
            return rows[0][a] * (rows[1][b] * rows[2][c] - rows[1][c] * rows[2][b]) -
                   rows[0][b] * (rows[1][a] * rows[2][c] - rows[1][c] * rows[2][a]) +
                   rows[0][c] * (rows[1][a] * rows[2][b] - rows[1][b] * rows[2][a]);
          };
          const Real det = determinant(0, 1, 2);
          if (std::abs(det) < 1e-15L) continue;
          best = std::max(best,
                          clearance(planes, {determinant(3, 1, 2) / det, determinant(0, 3, 2) / det,
                                             determinant(0, 1, 3) / det}));
        }
  return static_cast<double>(best);
}

void check_ball(const ConvexPolyhedron& shape, double relative) {
  const double tolerance = relative * shape.diameter();
  const auto planes = planes_of(shape);
  const Ball<3> ball = inscribed_ball(shape);
  CHECK(std::abs(ball.radius - radius_of_all_fours(planes)) <= tolerance);
  std::array<Real, 3> centre{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    centre[i] = static_cast<Real>(ball.centre[e]) - shape.vertex(0)[e];
  }
  // The centre is rounded where it is.
  CHECK(std::abs(static_cast<double>(clearance(planes, centre)) - ball.radius) <=
        tolerance + 2e-16 * ball.centre.norm());
}

}  // namespace

TEST_SUITE("geometry/inscribed_sphere") {
  TEST_CASE("closed forms: cube, box, tetrahedra, prisms") {
    const auto cube = inscribed_ball(box({1, 1, 1}, {3, 3, 3}));
    CHECK(std::abs(cube.radius - 1) < 2e-15);
    CHECK((cube.centre - Vec3(2, 2, 2)).norm() < 4e-15);
    const auto slab = inscribed_ball(box({0, 0, 0}, {5, 3, 0.5}));
    CHECK(std::abs(slab.radius - 0.25) < 2e-15);
    CHECK(std::abs(slab.centre.z() - 0.25) < 2e-15);
    // r = 3 V / S for every tetrahedron.
    for (const Vec3& legs : {Vec3(1, 1, 1), Vec3(2, 3, 5), Vec3(1, 1, 1e-3)}) {
      const auto shape = voussoir_test::corner_tetrahedron(legs.x(), legs.y(), legs.z());
      const double expected = 3 * mass_properties(shape).measure / shape.surface_area();
      CHECK(std::abs(inscribed_ball(shape).radius - expected) < 1e-14);
    }
    for (const int corners : {3, 4, 7, 38}) {
      CAPTURE(corners);
      const double across = 2 * std::cos(std::numbers::pi / corners);
      CHECK(std::abs(inscribed_ball(voussoir_test::regular_prism(corners, 2, 10)).radius - across) <
            1e-14);
      CHECK(std::abs(inscribed_ball(voussoir_test::regular_prism(corners, 2, 0.5)).radius - 0.25) <
            1e-14);
    }
  }

  TEST_CASE("random solids, near and far, agree with the balls of all fours of faces") {
    Random random(1);
    std::size_t most_faces = 0;
    for (int trial = 0; trial < 60; ++trial) {
      CAPTURE(trial);
      Pose<3> pose;
      pose.position = (trial % 3 == 0 ? 1e6 : 1.0) * voussoir_test::random_direction(random);
      const auto shape = placed(voussoir_test::random_solid(random, trial % 15), pose);
      most_faces = std::max(most_faces, shape.size());
      check_ball(shape, 1e-14);  // a few dozen roundings
    }
    CHECK(most_faces >= 12);
  }

  TEST_CASE("needles and plates 1 : 10 000, cut and turned, to a fraction of their thickness") {
    Random random(2);
    for (int trial = 0; trial < 60; ++trial) {
      CAPTURE(trial);
      Pose<3> pose;
      pose.rotation = voussoir_test::random_rotation(random);
      ConvexPolyhedron shape =
          placed(trial % 2 == 0 ? voussoir_test::needle() : voussoir_test::plate(), pose);
      for (int cut = 0; cut < trial % 5; ++cut)
        if (const auto parts =
                shape.split(HalfSpace<3>::through(mass_properties(shape).centroid,
                                                  voussoir_test::random_direction(random)),
                            cut, 1e-10))
          shape = random.below(2) == 0 ? parts->first : parts->second;
      check_ball(shape, 3e-14);  // radii down to about 1e-5 m
    }
  }

  TEST_CASE("faces that are parallel or the same but for a rounding do no harm") {
    Random random(3);
    for (int trial = 0; trial < 60; ++trial) {
      CAPTURE(trial);
      ConvexPolyhedron shape = box({0, 0, 0}, {1, 1, 1});
      for (int cut = 0; cut < 5; ++cut) {
        // A face tilted by 1e-16 to 0.1, through a vertex: slivers, and faces that nearly coincide.
        HalfSpace<3> plane = shape.half_space(random.below(shape.size()));
        const double tilt = std::pow(10.0, -1 - 15 * random.uniform());
        plane.normal = (plane.normal + tilt * voussoir_test::random_direction(random)).normalized();
        const auto parts =
            shape.split(HalfSpace<3>::through(shape.vertex(random.below(shape.vertices().size())),
                                              plane.normal),
                        cut, 1e-14);
        if (!parts) continue;
        const bool first =
            mass_properties(parts->first).measure > mass_properties(parts->second).measure;
        shape = first ? parts->first : parts->second;
      }
      check_ball(shape, 1e-13);
    }
  }

  TEST_CASE("forty faces in any order give the same radius") {
    Random random(4);
    ConvexPolyhedron shape = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    for (int cut = 0; cut < 40; ++cut)
      if (auto parts = shape.split({voussoir_test::random_direction(random), 0.5}, cut, 1e-10))
        shape = std::move(parts->first);
    REQUIRE(shape.size() >= 40);
    // All faces touch the ball of radius 1/2.
    const double radius = inscribed_ball(shape).radius;
    CHECK(std::abs(radius - 0.5) < 1e-14);
    for (int trial = 0; trial < 10; ++trial) {
      auto faces = voussoir_test::faces_of(shape);
      random.shuffle(faces);
      // Normals computed from the vertices of small faces: 1e-16 over their size of 1e-2.
      CHECK(std::abs(inscribed_ball(voussoir_test::solid(shape.vertices(), faces)).radius -
                     radius) < 1e-12);
    }
  }
}

}  // namespace inscribed_sphere_test
