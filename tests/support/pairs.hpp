// SPDX-License-Identifier: MIT
#pragma once
// Pairs of convex blocks that are hard on contact detection: every feature of one block brought to
// every feature of another, with gaps and overlaps from nothing to a decimetre, on blocks from
// cubes to needles 1:10^4.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>

#include "support/separating_axes.hpp"
#include "support/shapes.hpp"

namespace voussoir_test {

using voussoir::Pose;
using voussoir::Rotation;
using voussoir::Vec;
using voussoir::Vec3;

/// A convex shape as plain numbers, in its own frame.
template <int Dim>
struct PlainShape {
  std::vector<Vec<Dim>> vertices;       ///< [m]; in 2-D anticlockwise
  std::vector<std::vector<int>> faces;  ///< anticlockwise from outside; in 2-D (k, k + 1)
};

/// The shape where the pose puts it, for the reference.
template <int Dim>
[[nodiscard]] LongShape<Dim> long_shape(const PlainShape<Dim>& shape, const Pose<Dim>& pose) {
  return placed<Dim>(shape.vertices, shape.faces, pose.rotation, pose.position);
}

/// The same of a shape of the toolkit.
template <int Dim, class Shape>
[[nodiscard]] LongShape<Dim> reference_of(const Shape& shape, const Pose<Dim>& pose) {
  std::vector<std::vector<int>> faces = ring_of_faces(shape.size());
  if constexpr (Dim == 3)
    for (std::size_t f = 0; f < shape.size(); ++f) {
      const auto loop = shape.loop(f);
      faces[f].assign(loop.begin(), loop.end());
    }
  return placed<Dim>(shape.vertices(), faces, pose.rotation, pose.position);
}

/// The shape as the toolkit has it; face k has the label k.
[[nodiscard]] inline ConvexPolygon convex(const PlainShape<2>& shape) {
  return polygon(shape.vertices);
}
[[nodiscard]] inline voussoir::ConvexPolyhedron convex(const PlainShape<3>& shape) {
  std::vector<int> labels;
  for (std::size_t k = 0; k < shape.faces.size(); ++k) labels.push_back(static_cast<int>(k));
  return {shape.vertices, shape.faces, labels};
}

/// Two shapes and where they are.
template <int Dim>
struct PlainPair {
  PlainShape<Dim> a, b;
  Pose<Dim> pose_a, pose_b;
  /// Features that were brought together: 0 vertex, 1 edge (3-D), Dim - 1 face; -1 none.
  int order_a = -1, order_b = -1;
};

// ---- shapes
// --------------------------------------------------------------------------------------

[[nodiscard]] inline PlainShape<2> plain(const std::vector<Vec2>& vertices) {
  return {vertices, ring_of_faces(vertices.size())};
}

/// Prism over an anticlockwise outline; `up` from each point of the floor to the roof.
[[nodiscard]] inline PlainShape<3> prism(const std::vector<Vec2>& outline, const Vec3& up) {
  const int n = static_cast<int>(outline.size());
  PlainShape<3> shape;
  for (const double side : {-0.5, 0.5})
    for (const Vec2& p : outline) shape.vertices.push_back(Vec3(p.x(), p.y(), 0) + side * up);
  shape.faces.resize(2);
  for (int k = 0; k < n; ++k) {
    shape.faces[0].push_back(n - 1 - k);
    shape.faces[1].push_back(n + k);
    const int next = (k + 1) % n;
    shape.faces.push_back({k, next, n + next, n + k});
  }
  return shape;
}

[[nodiscard]] inline std::vector<Vec2> rectangle(double width, double height) {
  return {{-width / 2, -height / 2},
          {width / 2, -height / 2},
          {width / 2, height / 2},
          {-width / 2, height / 2}};
}

/// Convex hull of points no four of which lie in one plane: all triangles with nothing above.
[[nodiscard]] inline PlainShape<3> hull(const std::vector<Vec3>& points) {
  PlainShape<3> shape;
  std::vector<int> number(points.size(), -1);
  const auto renumbered = [&](std::size_t k) {
    if (number[k] < 0) {
      number[k] = static_cast<int>(shape.vertices.size());
      shape.vertices.push_back(points[k]);
    }
    return number[k];
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const Vec3 area = voussoir::cross(Vec3(points[j] - points[i]), Vec3(points[k] - points[i]));
        bool above = false, below = false;
        for (std::size_t m = 0; m < points.size(); ++m) {
          if (m == i || m == j || m == k) continue;
          const double side = area.dot(points[m] - points[i]);
          above = above || side >= 0;
          below = below || side <= 0;
        }
        const int p = renumbered(i), q = renumbered(j), r = renumbered(k);
        if (!above) shape.faces.push_back({p, q, r});
        if (!below) shape.faces.push_back({p, r, q});
      }
  // A point inside was numbered with the triples that were looked at: leave it out again.
  std::vector<int> used(shape.vertices.size(), -1);
  PlainShape<3> result;
  for (auto& face : shape.faces) {
    for (int& vertex : face) {
      int& place = used[static_cast<std::size_t>(vertex)];
      if (place < 0) {
        place = static_cast<int>(result.vertices.size());
        result.vertices.push_back(shape.vertices[static_cast<std::size_t>(vertex)]);
      }
      vertex = place;
    }
    result.faces.push_back(face);
  }
  return result;
}

template <int Dim>
[[nodiscard]] Vec<Dim> random_vector(Random& random) {
  Vec<Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = random.normal();
  return v;
}

template <int Dim>
[[nodiscard]] Rotation<Dim> random_rotation(Random& random) {
  if constexpr (Dim == 2) {
    return voussoir::rotation_by(voussoir::Spin<2>(2 * std::numbers::pi * random.uniform()));
  } else {
    // A direction that is uniform on the sphere in four dimensions.
    Eigen::Vector4d q{random.normal(), random.normal(), random.normal(), random.normal()};
    q.normalize();
    const Vec3 axis = q.tail<3>();
    const double sine = axis.norm();
    if (sine == 0) return Rotation<3>::Identity();
    return voussoir::rotation_by(voussoir::Spin<3>(2 * std::atan2(sine, q[0]) / sine * axis));
  }
}

/// Ten to the power of a number uniform between the two.
[[nodiscard]] inline double random_power(Random& random, double from, double to) {
  return std::pow(10.0, from + (to - from) * random.uniform());
}

inline constexpr int shape_kinds = 8;

/// Blocks of about 1 m: triangle, box, hull of points, 40 sides, slab 1:100, plate or needle
/// 1:10^4, skewed box.
template <int Dim>
[[nodiscard]] PlainShape<Dim> shape_of_kind(Random& random, int kind) {
  const double size = random_power(random, -0.5, 0.3);
  const auto triangle = [&] {
    const double tip = random.uniform() - 0.5;
    return std::vector<Vec2>{{-size / 2, 0}, {size / 2, 0}, {size * tip, size}};
  };
  std::vector<Vec2> outline;
  Vec3 up(0, 0, size);
  switch (kind) {
    case 0:
      outline = triangle();
      break;
    case 1:
      outline = rectangle(size, size * (0.5 + random.uniform()));
      break;
    case 2:
      if constexpr (Dim == 2) {
        do {
          outline.clear();
          for (int k = 0; k < 8; ++k) outline.emplace_back(size * random_vector<2>(random) / 2);
          outline = hull(outline);
        } while (outline.size() < 3);
        break;
      } else {
        std::vector<Vec3> cloud;
        const int points = 4 + static_cast<int>(random.below(5));
        for (int k = 0; k < points; ++k)
          cloud.emplace_back(size * random_vector<3>(random).normalized());
        return hull(cloud);
      }
    case 3:
      outline = regular(40, size);
      break;
    case 4:
      outline = rectangle(size, Dim == 2 ? 1e-2 * size : size);
      up *= 1e-2;
      break;
    case 5:
      outline = rectangle(size, Dim == 2 ? 1e-4 * size : size);
      up *= 1e-4;
      break;
    case 6:
      outline = rectangle(1e-4 * size, 1e-4 * size);
      if constexpr (Dim == 2) outline = {{-size, 0}, {size, 0}, {0.9 * size, 1e-4 * size}};
      break;
    default:
      outline = rectangle(size, size / 2);
      for (Vec2& p : outline) p.x() += 0.7 * p.y();
      up += Vec3(0.6 * size, -0.4 * size, 0);
  }
  PlainShape<Dim> shape;
  if constexpr (Dim == 2)
    shape = plain(outline);
  else
    shape = prism(outline, up);
  // Half of them with faces that no axis of coordinates makes exact.
  if (random.below(2) == 0) {
    const Rotation<Dim> turn = random_rotation<Dim>(random);
    for (auto& vertex : shape.vertices) vertex = turn * vertex;
  }
  return shape;
}

// ---- features
// ------------------------------------------------------------------------------------

/// A point of a vertex, edge or face and a direction in which the shape reaches no further.
template <int Dim>
struct Feature {
  Vec<Dim> point, direction;
  Vec<Dim> along;  ///< 3-D: unit, perpendicular to `direction`; of an edge, its direction
};

template <int Dim>
[[nodiscard]] Feature<Dim> random_feature(Random& random, const PlainShape<Dim>& shape, int order) {
  Pose<Dim> here;
  const LongShape<Dim> exact = long_shape(shape, here);
  const auto& face = shape.faces[random.below(shape.faces.size())];
  const std::size_t corner = random.below(face.size());
  const int first = face[corner], second = face[(corner + 1) % face.size()];
  const auto at = [&](int vertex) { return shape.vertices[static_cast<std::size_t>(vertex)]; };
  const auto has = [](const std::vector<int>& loop, int vertex) {
    return std::find(loop.begin(), loop.end(), vertex) != loop.end();
  };
  Feature<Dim> feature;
  LongVec<Dim> direction = LongVec<Dim>::Zero();
  if (order == Dim - 1) {
    feature.point.setZero();
    double weights = 0;
    for (const int vertex : face) {
      const double weight = random.uniform() + 0.01;
      feature.point += weight * at(vertex);
      weights += weight;
    }
    feature.point /= weights;
    direction = exact.normals[static_cast<std::size_t>(&face - shape.faces.data())];
  } else {
    const double t = order == 0 ? 0.0 : random.uniform();
    feature.point = at(first) + t * (at(second) - at(first));
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
      if (has(shape.faces[f], first) && (order == 0 || has(shape.faces[f], second)))
        direction += (random.uniform() + 0.05) * exact.normals[f];
  }
  feature.direction = direction.normalized().template cast<double>();
  if constexpr (Dim == 3) {
    const Vec3 edge = at(second) - at(first);
    feature.along = (edge - edge.dot(feature.direction) * feature.direction).normalized();
  } else {
    feature.along = voussoir::perpendicular(feature.direction);
  }
  return feature;
}

// ---- pairs
// ---------------------------------------------------------------------------------------

/// How far b is moved away after it was brought to touch: nothing, or 1e-9 m to 0.1 m either way.
[[nodiscard]] inline double random_gap(Random& random) {
  if (random.below(8) == 0) return 0;
  const double size = random_power(random, -9, -1);
  return random.below(2) == 0 ? size : -size;
}

/// Feature of b brought to a feature of a, moved `gap` away, and both turned and moved together.
template <int Dim>
[[nodiscard]] PlainPair<Dim> touching_pair(Random& random, int kind_a, int kind_b, int order_a,
                                           int order_b, double gap) {
  PlainPair<Dim> pair;
  pair.a = shape_of_kind<Dim>(random, kind_a);
  pair.b = shape_of_kind<Dim>(random, kind_b);
  pair.order_a = order_a;
  pair.order_b = order_b;
  const Feature<Dim> on_a = random_feature(random, pair.a, order_a);
  const Feature<Dim> on_b = random_feature(random, pair.b, order_b);
  if constexpr (Dim == 2) {
    Rotation<2> from, to;
    from << on_b.direction, on_b.along;
    to << -on_a.direction, -on_a.along;
    pair.pose_b.rotation = to * from.transpose();
  } else {
    // Edges parallel, nearly parallel, or crossing at any angle.
    double spin = 2 * std::numbers::pi * random.uniform();
    if (const auto choice = random.below(4); choice == 0)
      spin = 0;
    else if (choice == 1)
      spin = random_power(random, -13, -1);
    const Vec3 n = -on_a.direction;
    const Vec3 u = std::cos(spin) * on_a.along + std::sin(spin) * voussoir::cross(n, on_a.along);
    Rotation<3> from, to;
    from << on_b.direction, on_b.along, voussoir::cross(on_b.direction, on_b.along);
    to << n, u, voussoir::cross(n, u);
    pair.pose_b.rotation = to * from.transpose();
  }
  pair.pose_b.position = on_a.point + gap * on_a.direction - pair.pose_b.rotation * on_b.point;
  Pose<Dim> common;
  common.rotation = random_rotation<Dim>(random);
  for (int k = 0; k < Dim; ++k) common.position[k] = 120 * (random.uniform() - 0.5);
  pair.pose_a = common;
  pair.pose_b.position = common(pair.pose_b.position);
  pair.pose_b.rotation = common.rotation * pair.pose_b.rotation;
  return pair;
}

/// Boxes on a grid of half metres, turned by right angles: every contact is exact in binary.
template <int Dim>
[[nodiscard]] PlainPair<Dim> grid_pair(Random& random) {
  PlainPair<Dim> pair;
  const auto kicks = [&random](int count) {
    return 0.5 * static_cast<double>(random.below(static_cast<std::uint64_t>(count)));
  };
  const auto box = [&] {
    const auto outline = rectangle(0.5 + kicks(3), 0.5 + kicks(3));
    if constexpr (Dim == 2)
      return plain(outline);
    else
      return prism(outline, Vec3(0, 0, 0.5 + kicks(3)));
  };
  pair.a = box();
  pair.b = box();
  for (Pose<Dim>* pose : {&pair.pose_a, &pair.pose_b}) {
    for (int k = 0; k < Dim; ++k) pose->position[k] = kicks(5);
    if (random.below(2) == 0) {
      pose->rotation.setZero();
      for (int k = 0; k < Dim; ++k) pose->rotation(k, (k + 1) % Dim) = k == 0 && Dim == 2 ? -1 : 1;
    }
  }
  return pair;
}

/// The second a smaller copy of any kind, somewhere in the middle of the first.
template <int Dim>
[[nodiscard]] PlainPair<Dim> contained_pair(Random& random, int kind_a, int kind_b) {
  PlainPair<Dim> pair = touching_pair<Dim>(random, kind_a, kind_b, Dim - 1, Dim - 1, 0);
  pair.order_a = pair.order_b = -1;
  Vec<Dim> middle = Vec<Dim>::Zero();
  for (const auto& vertex : pair.a.vertices)
    middle += vertex / static_cast<double>(pair.a.vertices.size());
  pair.pose_b.position = pair.pose_a(middle);
  const double scale = random_power(random, -2, -0.5);
  for (auto& vertex : pair.b.vertices) vertex *= scale;
  return pair;
}

/// The same block twice, in place or `gap` apart.
template <int Dim>
[[nodiscard]] PlainPair<Dim> identical_pair(Random& random, int kind, double gap) {
  PlainPair<Dim> pair = touching_pair<Dim>(random, kind, kind, Dim - 1, Dim - 1, 0);
  pair.order_a = pair.order_b = -1;
  pair.b = pair.a;
  pair.pose_b = pair.pose_a;
  pair.pose_b.position += gap * random_vector<Dim>(random).normalized();
  return pair;
}

/// A double pyramid over a flat ring of 3 to 8 corners, as low as 1:1000: all its edges are blunt.
[[nodiscard]] inline PlainShape<3> lens(Random& random) {
  const int n = 3 + static_cast<int>(random.below(6));
  PlainShape<3> shape;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.3 * random.uniform()) / n;
    shape.vertices.push_back({0.5 * std::cos(angle), 0.5 * std::sin(angle), 0});
  }
  for (const double side : {-1, 1}) {
    const double x = 0.1 * (random.uniform() - 0.5), y = 0.1 * (random.uniform() - 0.5);
    shape.vertices.push_back({x, y, side * random_power(random, -3, -0.5)});
  }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    shape.faces.push_back({next, k, n});
    shape.faces.push_back({k, next, n + 1});
  }
  return shape;
}

/// Two lenses upon each other, somewhat tilted, anything from barely touching to all but passed
/// through each other: many axes near each other are nearly as good.
[[nodiscard]] inline PlainPair<3> lens_pair(Random& random) {
  PlainPair<3> pair;
  pair.a = lens(random);
  pair.b = lens(random);
  const double room = pair.a.vertices.back().z() - (pair.b.vertices.end() - 2)->z();
  const Vec3 tilt = 0.2 * random.uniform() * random_vector<3>(random);
  const double turn = 2 * std::numbers::pi * random.uniform();
  pair.pose_b.rotation = voussoir::rotation_by(voussoir::Spin<3>(tilt)) *
                         voussoir::rotation_by(voussoir::Spin<3>(0, 0, turn));
  if (random.below(2) == 0) {
    pair.pose_b.position = 0.2 * random.uniform() * random_vector<3>(random);
    pair.pose_b.position.z() = (1 - random_power(random, -3, 0.3)) * room;
  } else {  // the tip of b just beside an edge of a
    const Vec3 top = pair.a.vertices.back(), tip = *(pair.b.vertices.end() - 2);
    const double along = 0.2 + 0.6 * random.uniform();
    Vec3 at = top + along * (pair.a.vertices[0] - top);
    at += random_power(random, -4, -1) * random_vector<3>(random);
    at.z() -= random_power(random, -3, -1);
    pair.pose_b.position = at - pair.pose_b.rotation * tip;
  }
  Pose<3> common;
  common.rotation = random_rotation<3>(random);
  common.position = 30 * random_vector<3>(random);
  pair.pose_a = common;
  pair.pose_b.position = common(pair.pose_b.position);
  pair.pose_b.rotation = common.rotation * pair.pose_b.rotation;
  return pair;
}

/// One of all families. In 3-D 40-sided blocks meet others only: the reference is slow on two.
template <int Dim>
[[nodiscard]] PlainPair<Dim> random_pair(Random& random) {
  const int kind_a = static_cast<int>(random.below(shape_kinds));
  int kind_b = static_cast<int>(random.below(shape_kinds));
  if (Dim == 3 && kind_a == 3 && kind_b == 3) kind_b = 1;
  const double gap = random_gap(random);
  switch (random.below(12)) {
    case 0:
      return grid_pair<Dim>(random);
    case 1:
      return contained_pair<Dim>(random, kind_a, kind_b);
    case 2:
      return identical_pair<Dim>(random, Dim == 3 && kind_a == 3 ? 1 : kind_a, gap);
    default:
      const int order_a = static_cast<int>(random.below(Dim));
      const int order_b = static_cast<int>(random.below(Dim));
      return touching_pair<Dim>(random, kind_a, kind_b, order_a, order_b, gap);
  }
}

}  // namespace voussoir_test
