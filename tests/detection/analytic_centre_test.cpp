// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/detection/analytic_centre.hpp>

#include "support/long_planes.hpp"
#include "support/pairs.hpp"
#include "support/separating_axes.hpp"

namespace analytic_centre_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

template <int Dim>
struct Dimensions {
  static constexpr int dim = Dim;
};

template <int Dim>
using Pair = AnalyticCentre::Pair<Dim>;
template <int Dim>
using Memory = typename Pair<Dim>::Memory;

/// The shapes of a pair as numbers 0 and 1.
template <int Dim>
PlacedShapes<Dim> placed_pair(const PlainPair<Dim>& pair) {
  PlacedShapes<Dim> shapes;
  shapes.add(convex(pair.a), Vec<Dim>::Zero());
  shapes.add(convex(pair.b), Vec<Dim>::Zero());
  shapes.place(0, pair.pose_a);
  shapes.place(1, pair.pose_b);
  return shapes;
}

/// Two shapes that need not move.
template <int Dim>
PlacedShapes<Dim> placed_pair(const PlainShape<Dim>& a, const PlainShape<Dim>& b) {
  PlainPair<Dim> pair;
  pair.a = a;
  pair.b = b;
  return placed_pair(pair);
}

/// What `contact` says without memory, in numbers that outlive the detector.
template <int Dim>
struct Found {
  bool touch;
  double separation;
  Vec<Dim> normal, point;
};

template <int Dim>
Found<Dim> found(Pair<Dim>& pair, std::size_t a, std::size_t b, Memory<Dim>& memory,
                 double reach = 0) {
  const Contact<Dim> contact = pair.contact(a, b, memory, reach);
  if (contact.touch == Touch::none) return {false, contact.separation, contact.normal, {}};
  REQUIRE(contact.touch == Touch::interior);
  REQUIRE(contact.polygon.size() == 1);
  return {true, contact.separation, contact.normal, contact.polygon[0]};
}
template <int Dim>
Found<Dim> found_cold(const PlacedShapes<Dim>& shapes, std::size_t a = 0, std::size_t b = 1) {
  Pair<Dim> pair(shapes);
  Memory<Dim> memory;
  return found(pair, a, b, memory);
}

/// An axis-parallel box from one corner to the opposite one.
template <int Dim>
PlainShape<Dim> box(const Vec<Dim>& low, const Vec<Dim>& high) {
  PlainShape<Dim> shape;
  if constexpr (Dim == 2)
    shape = plain(rectangle(high[0] - low[0], high[1] - low[1]));
  else
    shape = prism(rectangle(high[0] - low[0], high[1] - low[1]), Vec3(0, 0, high[2] - low[2]));
  for (auto& vertex : shape.vertices) vertex += (low + high) / 2;
  return shape;
}

}  // namespace

TEST_SUITE("detection/analytic_centre") {
  TEST_CASE_TEMPLATE("faces that overlap by d: exact point, normal and depth", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    using V = Vec<dim>;
    for (const double d : {0.25, 1e-2, 1e-4, 1e-6, 1e-9}) {
      CAPTURE(d);
      // Unit cubes side by side: the overlap is its own mirror image about every middle plane.
      const V shift = (1 - d) * V::UnitX();
      const auto shapes =
          placed_pair<dim>(box<dim>(V::Zero(), V::Ones()), box<dim>(shift, V::Ones() + shift));
      const auto contact = found_cold(shapes);
      REQUIRE(contact.touch);
      CHECK((contact.normal - V::UnitX()).norm() < 1e-15 / d);  // rounding of room over room
      CHECK(std::abs(contact.separation + d) < 5e-16);          // roundings of coordinates about 1
      V middle = V::Constant(0.5);
      middle[0] = 1 - d / 2;
      CHECK((contact.point - middle).norm() < 1e-13);
    }
  }

  TEST_CASE_TEMPLATE("at the contact point the barrier is least: random pairs, long double", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(1);
    int touching = 0;
    for (int trial = 0; trial < (dim == 2 ? 1500 : 400); ++trial) {
      CAPTURE(trial);
      const auto pair = random_pair<dim>(random);
      const auto contact = found_cold(placed_pair(pair));
      if (!contact.touch) continue;
      const LongPlanes<dim> planes(long_shape(pair.a, pair.pose_a),
                                   long_shape(pair.b, pair.pose_b));
      long double least = 1;
      for (std::size_t k = 0; k < planes.normals.size(); ++k)
        least = std::min(least, planes.room(k, contact.point));
      // The planes are rounded by about 1e-13 m; where that is the room itself nothing can be said.
      if (least < 1e-10) continue;
      ++touching;
      CHECK(decrement(planes, contact.point) < 1e-12 + 1e-12 / least);
    }
    CHECK(touching > (dim == 2 ? 500 : 120));
  }

  TEST_CASE_TEMPLATE("the contact point goes with any affine map of both shapes", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    using V = Vec<dim>;
    Random random(2);
    int touching = 0;
    for (int trial = 0; trial < 60; ++trial) {
      CAPTURE(trial);
      const int kinds[] = {0, 1, 2, 7};
      auto a = shape_of_kind<dim>(random, kinds[trial % 4]);
      auto b = shape_of_kind<dim>(random, kinds[trial / 4 % 4]);
      for (V& vertex : b.vertices) vertex += 0.6 * V::UnitX();
      const auto before = found_cold(placed_pair<dim>(a, b));
      if (!before.touch) continue;
      ++touching;
      Rotation<dim> stretch = Rotation<dim>::Identity();
      for (int k = 0; k < dim; ++k) stretch(k, k) = random_power(random, -1, 1);
      stretch = random_rotation<dim>(random) * stretch * random_rotation<dim>(random);
      const V shift = random_vector<dim>(random);
      for (auto* shape : {&a, &b})
        for (V& vertex : shape->vertices) vertex = stretch * vertex + shift;
      const auto after = found_cold(placed_pair<dim>(a, b));
      REQUIRE(after.touch);
      // Coordinates up to 10 m and a stretch of 100: 1e-15 * 10 * 100, some of them.
      CHECK((after.point - (stretch * before.point + shift)).norm() < 1e-11);
    }
    CHECK(touching > 20);
  }

  TEST_CASE_TEMPLATE("decisions agree with separating axes in long double", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(3);
    int overlapping = 0, apart = 0;
    for (int trial = 0; trial < (dim == 2 ? 6000 : 1000); ++trial) {
      CAPTURE(trial);
      const auto pair = random_pair<dim>(random);
      const auto shapes = placed_pair(pair);
      const double exact = static_cast<double>(
          separating_axes(long_shape(pair.a, pair.pose_a), long_shape(pair.b, pair.pose_b)).value);
      // Planes are rounded by 1e-14 m at 100 m, and corners of 1e-4 rad are among the shapes.
      if (std::abs(exact) < 5e-10) continue;
      CAPTURE(exact);
      ++(exact < 0 ? overlapping : apart);
      Pair<dim> detect(shapes);
      Memory<dim> first, second, third;
      CHECK(detect.overlap(0, 1, first) == (exact < 0));
      const double separation = detect.separation(0, 1, second);
      CHECK((separation < 0) == (exact < 0));
      const auto contact = found(detect, 0, 1, third);
      CHECK(contact.touch == (exact < 0));
      if (contact.touch) {
        CHECK(contact.separation == separation);
        CHECK(std::abs(contact.normal.norm() - 1) < 1e-14);
      }
    }
    CHECK(overlapping > (dim == 2 ? 2000 : 300));
    CHECK(apart > (dim == 2 ? 1000 : 150));
  }

  TEST_CASE_TEMPLATE("memory changes no answer while blocks creep, jump, or are others", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    using V = Vec<dim>;
    Random random(4);
    int touching = 0, apart = 0;
    Memory<dim> elsewhere;  // goes from pair to pair, of any numbers of faces
    for (int trial = 0; trial < (dim == 2 ? 300 : 100); ++trial) {
      CAPTURE(trial);
      const int kinds[] = {0, 1, 2, 3, 7};
      auto pair = touching_pair<dim>(random, kinds[trial % 5], kinds[trial / 5 % 5], dim - 1,
                                     trial % dim, random_power(random, -5, -2) * (trial % 2 - 0.5));
      auto shapes = placed_pair(pair);
      Pair<dim> detect(shapes);
      Memory<dim> memory;
      const V drift = random_vector<dim>(random);
      for (int step = 0; step < 8; ++step) {
        CAPTURE(step);
        pair.pose_b.position += (step < 6 ? 3e-6 : 1e-2) * drift;
        shapes.place(1, pair.pose_b);
        const auto cold = found_cold(shapes);
        for (auto* used : {&memory, &elsewhere}) {
          const auto warm = found(detect, 0, 1, *used);
          CHECK(warm.touch == cold.touch);
          if (!cold.touch || !warm.touch) continue;
          ++touching;
          // 1e-14 m of the planes against overlaps of 1e-6 m and more, as an angle; times lengths.
          CHECK((warm.point - cold.point).norm() < 1e-9);
          CHECK((warm.normal - cold.normal).norm() < 1e-7);
          CHECK(std::abs(warm.separation - cold.separation) < 1e-9);
        }
        if (!cold.touch) ++apart;
        Memory<dim> none;
        CHECK(std::abs(detect.separation(0, 1, memory) - detect.separation(0, 1, none)) < 1e-9);
      }
    }
    CHECK(touching > 500);
    CHECK(apart > 100);
  }

  TEST_CASE_TEMPLATE("the pair turned round, moved, and seen in a mirror", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    using V = Vec<dim>;
    Random random(5);
    int touching = 0;
    for (int trial = 0; trial < (dim == 2 ? 400 : 150); ++trial) {
      CAPTURE(trial);
      const int kinds[] = {0, 1, 2, 3, 4, 7};
      auto pair = touching_pair<dim>(random, kinds[trial % 6], kinds[trial / 6 % 6], dim - 1,
                                     trial % dim, -random_power(random, -4, -1));
      const auto shapes = placed_pair(pair);
      const auto here = found_cold(shapes);
      if (!here.touch) continue;  // deeper than the shape is thick
      ++touching;
      // Roundings of 1e-14 m at 100 m against overlaps of 1e-5 m and more, as an angle.
      constexpr double tolerance = 1e-8;
      const auto swapped = found_cold(shapes, 1, 0);
      CHECK((swapped.normal + here.normal).norm() < tolerance);
      CHECK((swapped.point - here.point).norm() < tolerance);
      CHECK(std::abs(swapped.separation - here.separation) < tolerance);

      Pose<dim> move;
      move.rotation = random_rotation<dim>(random);
      move.position = 10 * random_vector<dim>(random);
      auto moved_pair = pair;
      for (Pose<dim>* pose : {&moved_pair.pose_a, &moved_pair.pose_b})
        *pose = {move(pose->position), move.rotation * pose->rotation};
      const auto moved = found_cold(placed_pair(moved_pair));
      CHECK((moved.normal - move.rotation * here.normal).norm() < tolerance);
      CHECK((moved.point - move(here.point)).norm() < tolerance);
      CHECK(std::abs(moved.separation - here.separation) < tolerance);

      // x becomes -x: of the vertices, and of the poses on either side; faces run the other way.
      const auto mirror = [](const V& x) {
        V y = x;
        y[0] = -y[0];
        return y;
      };
      auto mirrored_pair = pair;
      for (auto* shape : {&mirrored_pair.a, &mirrored_pair.b}) {
        for (V& vertex : shape->vertices) vertex = mirror(vertex);
        if constexpr (dim == 2)
          std::reverse(shape->vertices.begin(), shape->vertices.end());
        else
          for (auto& face : shape->faces) std::reverse(face.begin(), face.end());
      }
      for (Pose<dim>* pose : {&mirrored_pair.pose_a, &mirrored_pair.pose_b}) {
        pose->position = mirror(pose->position);
        pose->rotation.row(0) *= -1;
        pose->rotation.col(0) *= -1;
      }
      const auto mirrored = found_cold(placed_pair(mirrored_pair));
      CHECK((mirrored.normal - mirror(here.normal)).norm() < tolerance);
      CHECK((mirrored.point - mirror(here.point)).norm() < tolerance);
      CHECK(std::abs(mirrored.separation - here.separation) < tolerance);
    }
    CHECK(touching > 100);
  }

  TEST_CASE("a corner in a face: depth d upright, 2/3 d with one side upright") {
    // Tip at (0, -d), sides rising with the given slopes to feet p < 0 < q on the face y = 0. The
    // overlap is that triangle, its analytic centre the centroid, d (2 q - p) / (3 q) thick there.
    const double d = 1e-4;
    for (const double left : {1.0, 2.0, 10.0, 1e3}) {
      CAPTURE(left);
      const PlainShape<2> face = box<2>({-300, -300}, {300, 0});
      const PlainShape<2> corner = plain({{0, -d}, {100, 100 - d}, {-100 / left, 100 - d}});
      const double p = -d / left, q = d;
      const auto contact = found_cold(placed_pair<2>(face, corner));
      REQUIRE(contact.touch);
      // The far planes, 100 m and 300 m away, change weights by d / 100 m.
      CHECK((contact.normal - Vec2::UnitY()).norm() < 1e-5);
      CHECK((contact.point - Vec2((p + q) / 3, -d / 3)).norm() < 1e-5 * d);
      CHECK(std::abs(-contact.separation - d * (2 * q - p) / (3 * q)) < 1e-4 * d);
      // The least penetration depth is d all the time.
      CHECK(-contact.separation < d * (1 + 1e-5));
    }
  }

  TEST_CASE("between two corners the normal leans to the diagonal and the depth grows") {
    // Unit squares that overlap in a square of side d at their corners: the centre is its middle,
    // the barrier's gradient its diagonal, so the depth is the diagonal; the least depth is d.
    const double d = 1e-5;
    const Vec2 shift(1 - d, 1 - d);
    const auto contact =
        found_cold(placed_pair<2>(box<2>({0, 0}, {1, 1}), box<2>(shift, Vec2(1, 1) + shift)));
    REQUIRE(contact.touch);
    CHECK((contact.normal - Vec2(1, 1).normalized()).norm() < 1e-10);
    CHECK(std::abs(-contact.separation - std::sqrt(2.0) * d) < 1e-10 * d + 1e-15);
  }

  TEST_CASE("with rounded inner particles the normal is the face's away from corners") {
    const Vec2 shift(0.3, 1 - 1e-3);
    const auto shapes = placed_pair<2>(box<2>({0, 0}, {1, 1}), box<2>(shift, Vec2(1, 1) + shift));
    Memory<2> memory;
    Pair<2> barrier(shapes), sharp(shapes, 1e-4), rounded(shapes, 0.1), round(shapes, 0.5);
    const Vec2 leaning = found(barrier, 0, 1, memory).normal;
    CHECK(std::abs(leaning.x()) > 1e-5);  // the sides of the squares, at 0.3 m, push
    // Nearer than 0.1 m there is only the one face of each, nearer than 1e-4 m none.
    CHECK(found(rounded, 0, 1, memory).normal == Vec2(0, 1));
    CHECK(found(sharp, 0, 1, memory).normal == Vec2(0, 1));
    // With r = 0.5 m each adds its side at 0.35 m: (0.5 - 0.35, 0.5 - d / 2), the same for both.
    const auto wide = found(round, 0, 1, memory);
    CHECK((wide.normal - Vec2(0.15, 0.4995).normalized()).norm() < 1e-6);
    for (const double wrong :
         {-1e-9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
      CHECK_THROWS_AS(Pair<2>(shapes, wrong), InvalidInput);
  }

  TEST_CASE_TEMPLATE("concentric shapes: the way out through the nearest face", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    using V = Vec<dim>;
    V size = V::Constant(2);
    size[1] = 1;  // out through y is shortest
    for (const double scale : {1.0, 0.25}) {
      CAPTURE(scale);
      const auto shapes = placed_pair<dim>(box<dim>(-size / 2, size / 2),
                                           box<dim>(-scale * size / 2, scale * size / 2));
      const auto contact = found_cold(shapes), swapped = found_cold(shapes, 1, 0);
      REQUIRE(contact.touch);
      CHECK(contact.point.norm() < 1e-15);
      CHECK(std::abs(contact.normal[1]) == 1);
      // From the middle to the face of either.
      CHECK(std::abs(contact.separation + (0.5 + scale / 2)) < 1e-15);
      CHECK(swapped.normal == -contact.normal);
      CHECK(swapped.separation == contact.separation);
    }
  }

  TEST_CASE_TEMPLATE("shapes apart: half the separation is the swelling that makes them touch", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    using V = Vec<dim>;
    Random random(6);
    // Between faces the gap itself.
    for (const double gap : {1e-9, 1e-4, 0.3, 100.0}) {
      CAPTURE(gap);
      const V shift = (1 + gap) * V::UnitX() + 0.3 * V::Unit(dim - 1);
      const auto shapes =
          placed_pair<dim>(box<dim>(V::Zero(), V::Ones()), box<dim>(shift, V::Ones() + shift));
      Pair<dim> detect(shapes);
      Memory<dim> memory;
      CHECK(std::abs(detect.separation(0, 1, memory) - gap) < 1e-13 * (1 + gap));
      CHECK_FALSE(found(detect, 0, 1, memory).touch);
      CHECK_FALSE(found(detect, 0, 1, memory, 0.999 * gap).touch);
      const auto near = found(detect, 0, 1, memory, 1.5 * gap);
      REQUIRE(near.touch);
      CHECK(std::abs(near.separation - gap) < 1e-13 * (1 + gap));
      CHECK(near.normal[0] > 0.5);
      CHECK(std::abs(near.point[0] - (1 + gap / 2)) < gap);
    }
    // Elsewhere no more than the distance.
    int apart = 0;
    for (int trial = 0; trial < (dim == 2 ? 300 : 60); ++trial) {
      CAPTURE(trial);
      const auto pair = touching_pair<dim>(random, trial % 3, 7 - trial % 2, trial % dim,
                                           trial / 2 % dim, random_power(random, -6, -1));
      const auto a = long_shape(pair.a, pair.pose_a), b = long_shape(pair.b, pair.pose_b);
      if (separating_axes(a, b).value <= 0) continue;
      ++apart;
      const auto shapes = placed_pair(pair);
      Pair<dim> detect(shapes);
      Memory<dim> memory;
      const double separation = detect.separation(0, 1, memory);
      CHECK(separation > 0);
      CHECK(separation < static_cast<double>(distance_apart(a, b)) + 1e-12);
    }
    CHECK(apart > 40);
  }
}

}  // namespace analytic_centre_test
