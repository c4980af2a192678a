// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/line_clip.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_line.hpp>

#include "support/shapes.hpp"
#include "support/solids.hpp"

namespace line_clip_test {

using namespace voussoir;
using voussoir_test::box;
using voussoir_test::random_direction;

namespace {

constexpr double tolerance = 1e-9;

struct Stretch {
  double from, to;
};

/// The stretches of a line in all shapes, in order.
template <class Line, class Shape>
std::vector<Stretch> stretches(const Line& line, const std::vector<Shape>& shapes) {
  std::vector<Stretch> found;
  for (const Shape& shape : shapes) {
    double from = 0, to = 0;
    if (clip(line, shape, tolerance, from, to)) found.push_back({from, to});
  }
  std::sort(found.begin(), found.end(),
            [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  return found;
}

/// Whether the stretches follow each other without gap or overlap from `from` to `to`.
bool covers_once(const std::vector<Stretch>& found, double from, double to) {
  double reached = from;
  for (const Stretch& s : found) {
    if (std::abs(s.from - reached) > 10 * tolerance) return false;
    reached = s.to;
  }
  return std::abs(reached - to) <= 10 * tolerance;
}

/// The unit cube cut by three sets of planes a quarter apart and one diagonal plane.
std::vector<ConvexPolyhedron> grid(const Pose<3>& pose) {
  std::vector<ConvexPolyhedron> parts = {voussoir_test::placed(box({0, 0, 0}, {1, 1, 1}), pose)};
  const auto cut_all = [&](const Vec3& point, const Vec3& normal) {
    std::vector<ConvexPolyhedron> next;
    for (const ConvexPolyhedron& part : parts) {
      const auto both =
          part.split(HalfSpace<3>::through(pose(point), pose.rotation * normal), 9, tolerance);
      if (both) {
        next.push_back(both->first);
        next.push_back(both->second);
      } else {
        next.push_back(part);
      }
    }
    parts = next;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 1; k < 4; ++k) cut_all(0.25 * k * Vec3::Unit(axis), Vec3::Unit(axis));
  cut_all({0, 0, 0}, Vec3(1, -1, 0).normalized());
  return parts;
}

}  // namespace

TEST_SUITE("geometry/line_clip") {
  TEST_CASE("a line through a box, into it, beside it and short of it") {
    const ConvexPolyhedron shape = box({0, 0, 0}, {1, 2, 3});
    double from = 0, to = 0;
    REQUIRE(clip(SpatialLine{{-1, 1, 1}, {5, 1, 1}}, shape, tolerance, from, to));
    CHECK(std::abs(from - 1) < 1e-15);
    CHECK(std::abs(to - 2) < 1e-15);
    REQUIRE(clip(SpatialLine{{0.5, 1, 1}, {0.5, 1, 9}}, shape, tolerance, from, to));
    CHECK(from == 0);
    CHECK(std::abs(to - 2) < 1e-15);
    REQUIRE(clip(SpatialLine{{0.5, 1, 1}, {0.5, 1, 1.5}}, shape, tolerance, from, to));
    CHECK(from == 0);
    CHECK(to == 0.5);
    // Corner to corner.
    REQUIRE(clip(SpatialLine{{-1, -2, -3}, {2, 4, 6}}, shape, tolerance, from, to));
    CHECK(std::abs(from - std::sqrt(14.0)) < 1e-14);
    CHECK(std::abs(to - 2 * std::sqrt(14.0)) < 1e-14);
    CHECK_FALSE(clip(SpatialLine{{-1, 3, 1}, {5, 3, 1}}, shape, tolerance, from, to));
    CHECK_FALSE(clip(SpatialLine{{-2, 1, 1}, {-1, 1, 1}}, shape, tolerance, from, to));
    CHECK_FALSE(clip(SpatialLine{{-1, 1, 1}, {0, 1, 1}}, shape, tolerance, from, to));
    // Past an edge from outside, touching it in one point.
    CHECK_FALSE(clip(SpatialLine{{-1, 1, 1}, {1, -1, 1}}, shape, tolerance, from, to));
  }

  TEST_CASE("random lines and solids: the ends are where sampled points go in and out") {
    Random random(1);
    int hits = 0;
    for (int trial = 0; trial < 200; ++trial) {
      CAPTURE(trial);
      const ConvexPolyhedron shape = voussoir_test::random_solid(random, trial % 12);
      const SpatialLine line{random_direction(random), random_direction(random)};
      double from = 0, to = 0;
      const bool hit = clip(line, shape, tolerance, from, to);
      hits += hit ? 1 : 0;
      for (int k = 0; k <= 50; ++k) {
        const double at = k / 50.0 * line.length();
        const bool between = hit && at > from && at < to;
        if (hit && std::min(std::abs(at - from), std::abs(at - to)) < 1e-9) continue;
        CHECK(shape.contains(line.at(k / 50.0)) == between);
      }
    }
    CHECK(hits > 30);
  }

  TEST_CASE("any line through a mass of blocks is in exactly one of them at every point") {
    Random random(2);
    for (int trial = 0; trial < 4; ++trial) {
      Pose<3> pose;
      if (trial > 0) pose.rotation = voussoir_test::random_rotation(random);
      if (trial > 1) pose.position = Vec3(30, -20, 10);
      const std::vector<ConvexPolyhedron> parts = grid(pose);
      REQUIRE(parts.size() == 80);
      // Along joints, along the lines in which two, three and four planes meet, through corners:
      // from any point of the lattice of eighths to any other, lattice planes being the joints.
      int lines = 0;
      for (int k = 0; k < 400; ++k) {
        const auto lattice = [&] {
          return Vec3(1.0 / 8 + static_cast<double>(random.below(7)) / 8,
                      1.0 / 8 + static_cast<double>(random.below(7)) / 8,
                      1.0 / 8 + static_cast<double>(random.below(7)) / 8);
        };
        const SpatialLine line{pose(lattice()), pose(lattice())};
        if (!(line.length() > 0.1)) continue;
        ++lines;
        CAPTURE(trial);
        CAPTURE(line.start.transpose());
        CAPTURE(line.end.transpose());
        CHECK(covers_once(stretches(line, parts), 0, line.length()));
        CHECK(covers_once(stretches(SpatialLine{line.end, line.start}, parts), 0, line.length()));
      }
      CHECK(lines > 300);
    }
  }

  TEST_CASE("a line along a face goes to the side of its first tangent, then of its second") {
    const SpatialLine line{{0, 0, -1}, {0, 0, 2}};
    const TangentBasis<3> sideways = tangent_basis(Vec3(0, 0, 1));
    double from = 0, to = 0;
    // Four columns around the z axis: only that into which the first tangent points has the line.
    int owners = 0;
    for (const double x : {-1.0, 0.0})
      for (const double y : {-1.0, 0.0}) {
        const ConvexPolyhedron column = box({x, y, 0}, {x + 1, y + 1, 1});
        const bool expected = (sideways(0, 0) > 0) == (x == 0) && (sideways(1, 0) > 0) == (y == 0);
        CHECK(clip(line, column, tolerance, from, to) == expected);
        owners += expected ? 1 : 0;
      }
    CHECK(owners == 1);
    // Two blocks whose common face holds the first tangent: the second decides.
    const Vec3 normal = sideways.col(1);
    for (const double sign : {1.0, -1.0}) {
      Pose<3> pose;
      pose.rotation << sideways.col(0), normal, Vec3(0, 0, 1);
      const ConvexPolyhedron half = voussoir_test::placed(
          box({-1, std::min(sign, 0.0), 0}, {1, std::max(sign, 0.0), 1}), pose);
      CHECK(clip(line, half, tolerance, from, to) == (sign > 0));
    }
  }

  TEST_CASE("in 2-D a line along a face goes to the block on its left") {
    const ConvexPolygon left = voussoir_test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    const ConvexPolygon right = voussoir_test::polygon({{0, -1}, {1, -1}, {1, 0}, {0, 0}});
    double from = 0, to = 0;
    for (const double off : {0.0, 5e-10, -5e-10}) {
      const Segment line{{-1, off}, {2, off}}, back{{2, off}, {-1, off}};
      REQUIRE(clip(line, left, tolerance, from, to));
      CHECK(std::abs(from - 1) < 1e-15);
      CHECK(std::abs(to - 2) < 1e-15);
      CHECK_FALSE(clip(line, right, tolerance, from, to));
      CHECK_FALSE(clip(back, left, tolerance, from, to));
      CHECK(clip(back, right, tolerance, from, to));
    }
  }

  TEST_CASE("far from the origin a line is clipped as exactly as it can be written down") {
    Pose<3> pose;
    pose.position = Vec3(1e6, -2e6, 5e5);
    const ConvexPolyhedron shape = voussoir_test::placed(box({0, 0, 0}, {1, 2, 3}), pose);
    double from = 0, to = 0;
    REQUIRE(clip(SpatialLine{pose({-1, -2, -3}), pose({2, 4, 6})}, shape, tolerance, from, to));
    CHECK(std::abs(from - std::sqrt(14.0)) < 1e-14);  // these coordinates are exact
    CHECK(std::abs(to - 2 * std::sqrt(14.0)) < 1e-14);
  }
}

}  // namespace line_clip_test
