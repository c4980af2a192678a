// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/mass_properties.hpp>

#include "support/solids.hpp"

namespace solid_mass_properties_test {

using namespace voussoir;
using voussoir_test::box;
using voussoir_test::placed;

namespace {

using Tensor = Eigen::Matrix3d;
using Real = long double;

/// Inertia of a box of these sides about its centre.
Tensor box_inertia(const Vec3& side) {
  const Vec3 square = side.cwiseProduct(side);
  Tensor inertia = Tensor::Zero();
  for (int i = 0; i < 3; ++i)
    inertia(i, i) = side.prod() * (square[(i + 1) % 3] + square[(i + 2) % 3]) / 12;
  return inertia;
}

/// The same integrals in long double, another way: tetrahedra over an inner point, each by the
/// tetrahedron's four corners (exact for degree 2: (sum of x_i y_i + (sum x)(sum y)) / 20).
struct Twin {
  Real volume = 0;
  std::array<Real, 3> centroid{};
  Real inertia[3][3] = {};
};
Twin twin_of(const ConvexPolyhedron& shape) {
  using Point = std::array<Real, 3>;
  const auto relative = [&](const Vec3& v) {
    Point p{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = static_cast<Eigen::Index>(i);
      p[i] = static_cast<Real>(v[e]) - static_cast<Real>(shape.vertex(0)[e]);
    }
    return p;
  };
  Point tip{};
  for (const Vec3& v : shape.vertices())
    for (std::size_t i = 0; i < 3; ++i)
      tip[i] += relative(v)[i] / static_cast<Real>(shape.vertices().size());
  Twin twin;
  Real first[3] = {}, second[3][3] = {};
  for (std::size_t f = 0; f < shape.size(); ++f) {
    const auto loop = shape.loop(f);
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      std::array<Point, 3> arm{};
      const std::array<int, 3> names{loop[0], loop[k], loop[k + 1]};
      for (std::size_t c = 0; c < 3; ++c) {
        const Point p = relative(shape.vertex(static_cast<std::size_t>(names[c])));
        for (std::size_t i = 0; i < 3; ++i) arm[c][i] = p[i] - tip[i];
      }
      const auto& [a, b, c] = arm;
      const Real piece = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                          a[2] * (b[0] * c[1] - b[1] * c[0])) /
                         6;
      twin.volume += piece;
      for (std::size_t i = 0; i < 3; ++i) {
        first[i] += piece / 4 * (a[i] + b[i] + c[i]);
        for (std::size_t j = 0; j < 3; ++j)
          second[i][j] += piece / 20 *
                          (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] +
                           (a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j]));
      }
    }
  }
  Real trace = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    trace += second[i][i] - first[i] * first[i] / twin.volume;
    twin.centroid[i] = tip[i] + first[i] / twin.volume;  // from vertex 0
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      twin.inertia[i][j] =
          (i == j ? trace : 0) - (second[i][j] - first[i] * first[j] / twin.volume);
  return twin;
}

void check_against_twin(const ConvexPolyhedron& shape, double relative) {
  const auto properties = mass_properties(shape);
  const Twin twin = twin_of(shape);
  const double size = shape.diameter(), volume = static_cast<double>(twin.volume);
  CHECK(std::abs(properties.measure - volume) <= relative * volume);
  double worst_place = 0, worst_inertia = 0;
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const double place = properties.centroid[i] - shape.vertex(0)[i];
    worst_place = std::max(worst_place, std::abs(place - static_cast<double>(twin.centroid[a])));
    for (int j = 0; j < 3; ++j)
      worst_inertia =
          std::max(worst_inertia,
                   std::abs(properties.second_moment(i, j) -
                            static_cast<double>(twin.inertia[a][static_cast<std::size_t>(j)])));
  }
  // The centroid itself is rounded as coordinates of its size are.
  CHECK(worst_place <= relative * size + 3e-16 * properties.centroid.norm());
  CHECK(worst_inertia <= relative * volume * size * size);
}

}  // namespace

TEST_SUITE("geometry/solid_mass_properties") {
  TEST_CASE("a box: a b c, its middle, m (b^2 + c^2) / 12") {
    const Vec3 low(1, -2, 3), side(2, 3, 0.5);
    const auto properties = mass_properties(box(low, low + side));
    CHECK(std::abs(properties.measure - 3) < 1e-15);
    CHECK((properties.centroid - low - 0.5 * side).norm() < 1e-15);
    CHECK((properties.second_moment - box_inertia(side)).norm() < 3e-15);  // entries up to 3.25
  }

  TEST_CASE("a tetrahedron at the corner of the axes: a b c / 6, m / 80 times what is tabled") {
    const double a = 2, b = 3, c = 5;
    const auto properties = mass_properties(voussoir_test::corner_tetrahedron(a, b, c));
    CHECK(std::abs(properties.measure - 5) < 2e-15);
    CHECK((properties.centroid - Vec3(a, b, c) / 4).norm() < 1e-15);
    // About the corner the integral of x^2 is m a^2 / 10 and that of x y is m a b / 20; about the
    // centroid 3 m a^2 / 80 and - m a b / 80.
    Tensor expected;
    expected << 3 * (b * b + c * c), a * b, a * c,  //
        a * b, 3 * (a * a + c * c), b * c,          //
        a * c, b * c, 3 * (a * a + b * b);
    CHECK((properties.second_moment - 5.0 / 80 * expected).norm() < 1e-14);
  }

  TEST_CASE(
      "a regular prism: m (r^2 (2 + cos(2 pi / n)) / 12 + h^2 / 12) across, twice the first along") {
    for (const int n : {3, 4, 6, 25}) {
      CAPTURE(n);
      const double r = 1.5, h = 0.7, step = 2 * std::numbers::pi / n;
      const auto properties = mass_properties(voussoir_test::regular_prism(n, r, h));
      const double mass = 0.5 * n * r * r * std::sin(step) * h;
      // Polar radius of gyration of a regular polygon: r^2 (2 + cos(step)) / 6.
      const double disc = r * r * (2 + std::cos(step)) / 6;
      CHECK(std::abs(properties.measure - mass) < 1e-14);
      CHECK((properties.centroid - Vec3(0, 0, 0.5 * h)).norm() < 2e-15);
      const Vec3 across(disc / 2 + h * h / 12, disc / 2 + h * h / 12, disc);
      CHECK((properties.second_moment - Tensor((mass * across).asDiagonal())).norm() < 2e-14);
    }
  }

  TEST_CASE("sheared, an integral of x x^T is sheared: an oblique prism") {
    // x -> S x with det S = 1 keeps the volume and turns the second moment P into S P S^T.
    Tensor shear;
    shear << 1, 0, 0.75, 0, 1, -0.5, 0, 0, 1;
    const Vec3 side(1, 2, 3);
    std::vector<Vec3> vertices;
    for (const Vec3& v : voussoir_test::box_vertices(-0.5 * side, 0.5 * side))
      vertices.emplace_back(shear * v);
    const auto properties =
        mass_properties(voussoir_test::solid(vertices, voussoir_test::box_faces()));
    const Vec3 squares(1.0 / 12, 4.0 / 12, 9.0 / 12);
    const Tensor p = 6 * (shear * squares.asDiagonal() * shear.transpose());
    const Tensor expected = p.trace() * Tensor::Identity() - p;
    CHECK(std::abs(properties.measure - 6) < 1e-14);
    CHECK(properties.centroid.norm() < 1e-15);
    CHECK((properties.second_moment - expected).norm() < 1e-14);
  }

  TEST_CASE("random solids, needles and plates agree with a long double twin, near and far") {
    Random random(1);
    for (const double far : {0.0, 100.0, 1e6})
      for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(far);
        CAPTURE(trial);
        Pose<3> pose;
        pose.rotation = voussoir_test::random_rotation(random);
        pose.position = far * voussoir_test::random_direction(random);
        const ConvexPolyhedron shape = trial % 4 == 0 ? voussoir_test::needle()
                                       : trial % 4 == 1
                                           ? voussoir_test::plate()
                                           : voussoir_test::random_solid(random, trial % 15);
        // Turned needles are 1e-4 across in coordinates of 1: their volume has 8 digits less. Far
        // away both see the same rounded vertices.
        check_against_twin(placed(shape, pose), trial % 4 == 0   ? 1e-11
                                                : trial % 4 == 1 ? 1e-12
                                                                 : 1e-14);
      }
  }

  TEST_CASE("the moment of a needle about its own axis keeps its digits") {
    const auto properties = mass_properties(voussoir_test::needle());
    const double mass = 1e-8, along = mass * (1e-8 + 1e-8) / 12;
    CHECK(std::abs(properties.second_moment(0, 0) / along - 1) < 1e-12);
  }

  TEST_CASE("at mine-grid coordinates a block keeps every digit") {
    // Coordinates in 1/1024 m: adding 1e6 m rounds nothing, so nothing at all may change.
    const ConvexPolyhedron near =
        voussoir_test::solid({{0, 0, 0}, {1.125, 0, 0.25}, {0.25, 1.5, 0}, {0.5, 0.25, 1.0078125}},
                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
    Pose<3> grid;
    grid.position = Vec3(1e6, -2e6, 5e5);
    const auto here = mass_properties(near), there = mass_properties(placed(near, grid));
    CHECK(there.measure == here.measure);
    CHECK(there.second_moment == here.second_moment);
    CHECK((there.centroid - grid.position - here.centroid).norm() < 3e-10);  // rounded at 2e6
  }

  TEST_CASE("cut into pieces and put together again, a solid is the same body, near and far") {
    Random random(2);
    for (const double far : {0.0, 1e6})
      for (int trial = 0; trial < 20; ++trial) {
        CAPTURE(far);
        CAPTURE(trial);
        Pose<3> pose;
        pose.position = far * voussoir_test::random_direction(random);
        const auto shape = placed(voussoir_test::random_solid(random, trial % 8), pose);
        const auto whole = mass_properties(shape);
        std::vector<ConvexPolyhedron> parts = {shape};
        for (int cut = 0; cut < 3; ++cut) {
          const auto plane =
              HalfSpace<3>::through(whole.centroid, voussoir_test::random_direction(random));
          std::vector<ConvexPolyhedron> next;
          for (const ConvexPolyhedron& part : parts) {
            if (const auto both = part.split(plane, 50 + cut, 1e-10)) {
              next.push_back(both->first);
              next.push_back(both->second);
            } else {
              next.push_back(part);
            }
          }
          parts = next;
        }
        CHECK(parts.size() >= 6);
        const auto together = mass_properties(parts);
        // New vertices are rounded to 1.2e-10 m at 1e6 m.
        const double bound = far > 0 ? 1e-9 : 1e-14;
        CHECK(std::abs(together.measure - whole.measure) < bound);
        CHECK((together.centroid - whole.centroid).norm() < bound);
        CHECK((together.second_moment - whole.second_moment).norm() < bound);
      }
  }

  TEST_CASE("turned and mirrored, the tensor turns and its mixed terms change sign") {
    Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
      const auto shape = voussoir_test::random_solid(random, trial % 9);
      const auto properties = mass_properties(shape);
      Pose<3> pose;
      pose.rotation = voussoir_test::random_rotation(random);
      const auto after = mass_properties(placed(shape, pose));
      CHECK((after.second_moment -
             pose.rotation * properties.second_moment * pose.rotation.transpose())
                .norm() < 1e-15);
      CHECK((after.centroid - pose(properties.centroid)).norm() < 2e-15);
      const auto seen = mass_properties(voussoir_test::mirrored(shape));
      Tensor expected = properties.second_moment;
      for (const int k : {1, 2}) expected(0, k) = expected(k, 0) = -expected(0, k);
      CHECK((seen.second_moment - expected).norm() < 1e-15);
    }
  }
}

}  // namespace solid_mass_properties_test
