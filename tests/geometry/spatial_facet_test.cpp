// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/geometry/spatial_facet.hpp>

#include "support/shapes.hpp"
#include "support/solids.hpp"

namespace spatial_facet_test {

using namespace voussoir;
using voussoir_test::random_direction;

namespace {

/// A plane outline put into space.
SpatialFacet facet_of(const std::vector<Vec2>& outline, const Pose<3>& pose = {}) {
  SpatialFacet facet;
  for (const Vec2& p : outline) facet.vertices.push_back(pose({p.x(), p.y(), 0}));
  return facet;
}

Pose<3> random_pose(Random& random, double far) {
  Pose<3> pose;
  pose.rotation = voussoir_test::random_rotation(random);
  pose.position = far * random_direction(random);
  return pose;
}

/// Integral over a triangle of a polynomial of degree 2, by the middles of its sides.
template <class Function>
double over_triangle(const Vec3& a, const Vec3& b, const Vec3& c, Function&& f) {
  return cross(b - a, c - a).norm() / 6 * (f((a + b) / 2) + f((b + c) / 2) + f((c + a) / 2));
}
template <class Function>
double over_facet(const SpatialFacet& facet, Function&& f) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < facet.vertices.size(); ++k)
    sum += over_triangle(facet.vertices[0], facet.vertices[k], facet.vertices[k + 1], f);
  return sum;
}

/// How far a point of the facet's plane lies outside its outline [m]; negative inside.
double outside(const SpatialFacet& facet, const Vec3& point) {
  const Vec3 normal = facet.area_vector().normalized();
  double worst = -1e300;
  for (std::size_t k = 0; k < facet.vertices.size(); ++k) {
    const Vec3& a = facet.vertices[k];
    const Vec3 along = (facet.vertices[(k + 1) % facet.vertices.size()] - a).normalized();
    worst = std::max(worst, cross(along, normal).dot(point - a));
  }
  return worst;
}

}  // namespace

TEST_SUITE("geometry/spatial_facet") {
  TEST_CASE("area vector and centre of a rectangle and a triangle") {
    const SpatialFacet rectangle{{{1, 0, 0}, {1, 2, 0}, {1, 2, 3}, {1, 0, 3}}};
    CHECK(rectangle.area_vector() == Vec3(6, 0, 0));
    CHECK(rectangle.measure() == 6);
    CHECK((rectangle.centre() - Vec3(1, 1, 1.5)).norm() < 1e-15);
    const SpatialFacet triangle{{{3, 0, 0}, {0, 3, 0}, {0, 0, 3}}};
    CHECK((triangle.area_vector() - Vec3(4.5, 4.5, 4.5)).norm() < 1e-15);
    CHECK((triangle.centre() - Vec3(1, 1, 1)).norm() < 1e-15);
    CHECK((triangle.centre_from({1, 1, 0}) - Vec3(0, 0, 1)).norm() < 1e-15);
  }

  TEST_CASE("the area vectors of a solid's faces add up to nothing, near and far") {
    Random random(1);
    for (const double far : {0.0, 1e6})
      for (int trial = 0; trial < 30; ++trial) {
        const auto shape = voussoir_test::placed(voussoir_test::random_solid(random, trial % 12),
                                                 random_pose(random, far));
        Vec3 sum = Vec3::Zero();
        double total = 0;
        for (std::size_t k = 0; k < shape.size(); ++k) {
          sum += shape.face(k).area_vector();
          total += shape.face(k).measure();
        }
        CHECK(sum.norm() < 1e-15 * total);  // a few roundings, far as near: arms are differences
      }
  }

  TEST_CASE("a square of side a: points a / sqrt(6) from the centre, along its sides") {
    const auto points = facet_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}}).gauss_points();
    const double reach = 2 / std::sqrt(6.0);
    CHECK((points[0].offset - Vec3(reach, 0, 0)).norm() < 1e-15);
    CHECK((points[1].offset + Vec3(reach, 0, 0)).norm() < 1e-15);
    CHECK((points[2].offset - Vec3(0, reach, 0)).norm() < 1e-15);
    CHECK((points[3].offset + Vec3(0, reach, 0)).norm() < 1e-15);
    for (const auto& point : points) CHECK(point.weight == 1);
  }

  TEST_CASE("the four points integrate every polynomial of degree 2 exactly, from inside") {
    Random random(2);
    for (int trial = 0; trial < 200; ++trial) {
      CAPTURE(trial);
      const double thickness = std::array{1.0, 1.0, 1e-2, 1e-4}[random.below(4)];
      const int count = 3 + static_cast<int>(random.below(8));
      const std::vector<Vec2> outline =
          trial % 5 == 0 ? voussoir_test::regular(count, 0.5)
                         : voussoir_test::random_convex(random, count, 1, thickness).vertices();
      const SpatialFacet facet = facet_of(outline, random_pose(random, 2));
      const double area = facet.measure();
      const Vec3 centre = facet.centre();
      const auto points = facet.gauss_points();
      const Vec3 p = random_direction(random), q = random_direction(random);
      const double r = random.normal(), s = random.normal();
      const auto f = [&](const Vec3& x) {
        return (p.dot(x - centre) + r) * (q.dot(x - centre) + s);
      };
      double sum = 0, total = 0;
      for (const auto& point : points) {
        sum += point.weight * f(centre + point.offset);
        total += point.weight;
        // A triangle's ellipse touches its sides. Rounding: coordinates up to 3.
        CHECK(outside(facet, centre + point.offset) < 2e-15);
      }
      CHECK(std::abs(total - area) <= 1e-15 * area);
      const double size = 1 + std::abs(r) + std::abs(s);
      // The area of a thin triangle is only known to the roundings of its corners over its width.
      CHECK(std::abs(sum - over_facet(facet, f)) < 2e-14 / thickness * area * size * size);
      // Principal axes: the two pairs are at right angles.
      CHECK(std::abs(points[0].offset.dot(points[2].offset)) < 1e-15);
      CHECK(points[0].offset.norm() >= points[2].offset.norm() * (1 - 1e-9));
    }
  }

  TEST_CASE("of a thin facet the small spread keeps its digits, turned as it may be") {
    Random random(3);
    for (int trial = 0; trial < 50; ++trial) {
      // A parallelogram: the longest edge is not a principal axis. Its second moments over the
      // area are x: (1 + s^2) / 12, y: w^2 / 12, mixed s w / 12 with the shear s and the width w.
      const double width = 1e-4, shear = 0.3;
      const Pose<3> pose = random_pose(random, 0);
      const auto points =
          facet_of({{0, 0}, {1, 0}, {1 + shear, width}, {shear, width}}, pose).gauss_points();
      const double xx = (1 + shear * shear) / 12, yy = width * width / 12, xy = shear * width / 12;
      const double large = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
      const double small = (xx * yy - xy * xy) / large;
      CHECK(std::abs(points[0].offset.norm() / std::sqrt(2 * large) - 1) < 1e-14);
      // Coordinates rounded to 1e-16 in a width of 1e-4.
      CHECK(std::abs(points[2].offset.norm() / std::sqrt(2 * small) - 1) < 1e-11);
    }
  }

  TEST_CASE("renumbered, mirrored and turned, the points are the same") {
    Random random(4);
    for (int trial = 0; trial < 50; ++trial) {
      const SpatialFacet facet = facet_of(
          voussoir_test::random_convex(random, 6, 1, 0.4).vertices(), random_pose(random, 0));
      const auto points = facet.gauss_points();
      SpatialFacet renumbered;
      for (std::size_t k = 0; k < facet.vertices.size(); ++k)
        renumbered.vertices.push_back(facet.vertices[(k + 1) % facet.vertices.size()]);
      SpatialFacet back;
      back.vertices.assign(facet.vertices.rbegin(), facet.vertices.rend());
      const Pose<3> pose = random_pose(random, 1);
      SpatialFacet turned_facet;
      for (const Vec3& v : facet.vertices) turned_facet.vertices.push_back(pose(v));
      const auto compare = [&](const SpatialFacet& other, const Rotation<3>& rotation) {
        const auto others = other.gauss_points();
        for (std::size_t k = 0; k < 4; k += 2) {
          // Which of a pair comes first may change with the numbering.
          const Vec3 expected = rotation * points[k].offset;
          const double apart =
              std::min((others[k].offset - expected).norm(), (others[k].offset + expected).norm());
          // The axes are as well conditioned as the two moments are different.
          const double contrast = points[0].offset.squaredNorm() - points[2].offset.squaredNorm();
          CHECK(apart < 2e-15 / contrast);
        }
      };
      compare(renumbered, Rotation<3>::Identity());
      compare(back, Rotation<3>::Identity());
      compare(turned_facet, pose.rotation);
    }
  }

  TEST_CASE("a facet without area weighs nothing, and nothing of it is not a number") {
    const SpatialFacet line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
    CHECK(line.measure() == 0);
    CHECK(line.centre().allFinite());
    for (const auto& point : line.gauss_points()) {
      CHECK(point.weight == 0);
      CHECK(point.offset == Vec3(0, 0, 0));
    }
  }
}

TEST_SUITE("geometry/tangent_basis") {
  TEST_CASE("tangents are unit vectors at right angles, right-handed with the normal") {
    Random random(5);
    for (int trial = 0; trial < 1000; ++trial) {
      Vec3 normal = random_direction(random);
      // Down to a hair from the one direction where the formula changes.
      if (trial % 2 == 0) {
        const double near = std::pow(10.0, -16 * random.uniform());
        normal = (Vec3(-2, -3, -6) / 7 + near * normal).normalized();
      }
      const TangentBasis<3> basis = tangent_basis(normal);
      CHECK((basis.transpose() * basis - Eigen::Matrix2d::Identity()).norm() < 2e-15);
      CHECK((cross(Vec3(basis.col(0)), Vec3(basis.col(1))) - normal).norm() < 2e-15);
    }
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0}) {
        const TangentBasis<3> basis = tangent_basis(Vec3(sign * Vec3::Unit(k)));
        CHECK((cross(Vec3(basis.col(0)), Vec3(basis.col(1))) - sign * Vec3::Unit(k)).norm() <
              1e-15);
      }
    const TangentBasis<3> last = tangent_basis(Vec3(-2.0 / 7, -3.0 / 7, -6.0 / 7));
    CHECK((last.transpose() * last - Eigen::Matrix2d::Identity()).norm() < 1e-15);
  }

  TEST_CASE("a normal turned a little turns its tangents a little, but about one direction") {
    Random random(6);
    const Vec3 singular = Vec3(-2, -3, -6) / 7;
    for (int trial = 0; trial < 1000; ++trial) {
      const Vec3 normal = random_direction(random);
      const Vec3 other = (normal + 1e-6 * random_direction(random)).normalized();
      const double moved = (tangent_basis(normal) - tangent_basis(other)).norm();
      // Derivatives of a mirror at this distance from the singular direction.
      CHECK(moved < 1e-5 / (normal - singular).norm());
    }
  }
}

}  // namespace spatial_facet_test
