// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/mass_properties.hpp>

/// Solids to test with.
namespace voussoir_test {

using voussoir::ConvexPolyhedron;
using voussoir::HalfSpace;
using voussoir::Random;
using voussoir::Vec3;

using Faces = std::vector<std::vector<int>>;

/// A polyhedron whose face k has the label k.
[[nodiscard]] inline ConvexPolyhedron solid(const std::vector<Vec3>& vertices, const Faces& faces) {
  std::vector<int> labels;
  for (std::size_t k = 0; k < faces.size(); ++k) labels.push_back(static_cast<int>(k));
  return {vertices, faces, labels};
}

/// Vertex k has the bits of k as x, y, z: 0 low, 1 high.
[[nodiscard]] inline std::vector<Vec3> box_vertices(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> vertices;
  for (int k = 0; k < 8; ++k)
    vertices.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                          (k & 4) != 0 ? high.z() : low.z());
  return vertices;
}
/// Faces x low, x high, y low, y high, z low, z high.
[[nodiscard]] inline Faces box_faces() {
  return {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
}
[[nodiscard]] inline ConvexPolyhedron box(const Vec3& low, const Vec3& high) {
  return solid(box_vertices(low, high), box_faces());
}

/// The corner of the axes cut off at a, b and c.
[[nodiscard]] inline ConvexPolyhedron corner_tetrahedron(double a, double b, double c) {
  return solid({{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}},
               {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

/// Upright prism over a regular polygon, the first corner along x; bottom, top, then sides.
[[nodiscard]] inline ConvexPolyhedron regular_prism(int corners, double radius, double height) {
  std::vector<Vec3> vertices;
  Faces faces(2);
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    vertices.emplace_back(x, y, 0);
    vertices.emplace_back(x, y, height);
    const int next = (k + 1) % corners;
    faces[0].insert(faces[0].begin(), 2 * k);
    faces[1].push_back(2 * k + 1);
    faces.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
  }
  return solid(vertices, faces);
}

/// A bar and a sheet, 1 to 10^4.
[[nodiscard]] inline ConvexPolyhedron needle() {
  return box({-0.5, -0.5e-4, -0.5e-4}, {0.5, 0.5e-4, 0.5e-4});
}
[[nodiscard]] inline ConvexPolyhedron plate() {
  return box({-0.5, -0.5, -0.5e-4}, {0.5, 0.5, 0.5e-4});
}

[[nodiscard]] inline Vec3 random_direction(Random& random) {
  for (;;) {
    const Vec3 v{random.normal(), random.normal(), random.normal()};
    if (v.norm() > 1e-3) return v.normalized();
  }
}
[[nodiscard]] inline Vec3 random_point(Random& random, const Vec3& low, const Vec3& high) {
  const Vec3 t{random.uniform(), random.uniform(), random.uniform()};
  return low + t.cwiseProduct(high - low);
}
[[nodiscard]] inline voussoir::Rotation<3> random_rotation(Random& random) {
  const Vec3 axis = random_direction(random);
  return voussoir::rotation_by(voussoir::Spin<3>(2 * std::numbers::pi * random.uniform() * axis));
}

/// The faces of a solid, for another one like it.
[[nodiscard]] inline Faces faces_of(const ConvexPolyhedron& shape) {
  Faces faces;
  for (std::size_t k = 0; k < shape.size(); ++k)
    faces.emplace_back(shape.loop(k).begin(), shape.loop(k).end());
  return faces;
}
[[nodiscard]] inline std::vector<int> cuts_of(const ConvexPolyhedron& shape) {
  std::vector<int> cuts;
  for (std::size_t k = 0; k < shape.size(); ++k) cuts.push_back(shape.cut(k));
  return cuts;
}

/// The same solid elsewhere: every vertex p at position + rotation p.
[[nodiscard]] inline ConvexPolyhedron placed(const ConvexPolyhedron& shape,
                                             const voussoir::Pose<3>& pose) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : shape.vertices()) vertices.push_back(pose(v));
  return {vertices, faces_of(shape), cuts_of(shape)};
}

/// The solid seen in the mirror x -> -x.
[[nodiscard]] inline ConvexPolyhedron mirrored(const ConvexPolyhedron& shape) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : shape.vertices()) vertices.emplace_back(-v.x(), v.y(), v.z());
  Faces faces;
  for (std::size_t k = 0; k < shape.size(); ++k)
    faces.emplace_back(shape.loop(k).rbegin(), shape.loop(k).rend());
  return {vertices, faces, cuts_of(shape)};
}

/// A piece of the unit cube about the origin after cuts by random planes, of which the larger part
/// is kept; labels 100, 101, ... for the cuts.
[[nodiscard]] inline ConvexPolyhedron random_solid(Random& random, int cuts) {
  ConvexPolyhedron shape = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (int k = 0; k < cuts; ++k) {
    const Vec3 normal = random_direction(random);
    const auto parts = shape.split({normal, 0.5 * random.uniform()}, 100 + k, 1e-10);
    if (!parts) continue;
    const bool first = voussoir::mass_properties(parts->first).measure >=
                       voussoir::mass_properties(parts->second).measure;
    shape = first ? parts->first : parts->second;
  }
  return shape;
}

}  // namespace voussoir_test
