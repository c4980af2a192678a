// SPDX-License-Identifier: MIT
#pragma once
// What contact detection must answer, from the definitions: every axis, every pair of features, in
// long double, and nothing of the toolkit but its vectors.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>

namespace voussoir_test {

/// A point or direction with 64 bits of mantissa.
template <int Dim>
using LongVec = Eigen::Matrix<long double, Dim, 1>;

[[nodiscard]] inline LongVec<3> long_cross(const LongVec<3>& a, const LongVec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Area vector of a flat polygon (twice the sum of triangles, halved), anticlockwise from its tip.
[[nodiscard]] inline LongVec<3> area_vector_of(const std::vector<LongVec<3>>& polygon) {
  LongVec<3> sum = LongVec<3>::Zero();
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += long_cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5L * sum;
}

/// A convex shape where it is: vertices, and what follows from them.
template <int Dim>
struct LongShape {
  std::vector<LongVec<Dim>> vertices;             ///< [m]; in 2-D anticlockwise
  std::vector<std::vector<int>> faces;            ///< vertices; in 2-D (k, k + 1)
  std::vector<LongVec<Dim>> normals;              ///< of the faces, unit, outward
  std::vector<long double> widths;                ///< of faces: area / longest side; 2-D: length
  std::vector<std::array<std::size_t, 2>> edges;  ///< 3-D: ends of each edge, once

  LongShape(std::vector<LongVec<Dim>> points, std::vector<std::vector<int>> loops)
      : vertices(std::move(points)), faces(std::move(loops)) {
    for (const auto& face : faces) {
      if constexpr (Dim == 2) {
        const LongVec<2> along = at(face[1]) - at(face[0]);
        widths.push_back(along.norm());
        normals.push_back(LongVec<2>(along[1], -along[0]) / widths.back());
      } else {
        const LongVec<3> area = area_vector_of(corners(face));
        normals.push_back(area / area.norm());
        long double longest = 0;
        for (std::size_t k = 0; k < face.size(); ++k) {
          const auto from = static_cast<std::size_t>(face[k]);
          const auto to = static_cast<std::size_t>(face[(k + 1) % face.size()]);
          longest = std::max(longest, (vertices[to] - vertices[from]).norm());
          if (from < to) edges.push_back({from, to});
        }
        widths.push_back(area.norm() / longest);
      }
    }
  }

  [[nodiscard]] const LongVec<Dim>& at(int vertex) const {
    return vertices[static_cast<std::size_t>(vertex)];
  }
  [[nodiscard]] std::vector<LongVec<Dim>> corners(const std::vector<int>& face) const {
    std::vector<LongVec<Dim>> points;
    for (const int vertex : face) points.push_back(at(vertex));
    return points;
  }
};

/// position + rotation x of every vertex; `rotation` anything that is indexed (row, column).
template <int Dim, class Point, class Turn>
[[nodiscard]] LongShape<Dim> placed(const std::vector<Point>& own,
                                    const std::vector<std::vector<int>>& faces,
                                    const Turn& rotation, const Point& position) {
  std::vector<LongVec<Dim>> points(own.size());
  for (std::size_t k = 0; k < own.size(); ++k)
    for (int row = 0; row < Dim; ++row) {
      long double sum = position[row];
      for (int column = 0; column < Dim; ++column)
        sum += static_cast<long double>(rotation(row, column)) * own[k][column];
      points[k][row] = sum;
    }
  return {points, faces};
}

/// Faces of a polygon of so many corners.
[[nodiscard]] inline std::vector<std::vector<int>> ring_of_faces(std::size_t corners) {
  std::vector<std::vector<int>> faces;
  const int count = static_cast<int>(corners);
  for (int k = 0; k < count; ++k) faces.push_back({k, (k + 1) % count});
  return faces;
}

/// Room between two shapes along a unit direction from a to b: how far b lies beyond a, or with the
/// other sign how far b must move along it to come free [m]. No direction gives more than the
/// truth.
/// @param enough  once the room cannot be more than this, any value not above it may be returned
template <int Dim>
[[nodiscard]] long double room_along(
    const LongShape<Dim>& a, const LongShape<Dim>& b, const LongVec<Dim>& direction,
    long double enough = -std::numeric_limits<long double>::infinity()) {
  const auto along = [&direction](const LongVec<Dim>& x) {
    long double sum = direction[0] * x[0] + direction[1] * x[1];
    if constexpr (Dim == 3) sum += direction[2] * x[2];
    return sum;
  };
  long double high = along(a.vertices[0]), low = along(b.vertices[0]);
  for (const LongVec<Dim>& vertex : a.vertices) high = std::max(high, along(vertex));
  for (const LongVec<Dim>& vertex : b.vertices) {
    low = std::min(low, along(vertex));
    if (low - high <= enough) break;
  }
  return low - high;
}

/// The greatest room over all directions that can have it.
template <int Dim>
struct LongSeparation {
  long double value = -std::numeric_limits<long double>::infinity();  ///< < 0: least depth [m]
  LongVec<Dim> normal = LongVec<Dim>::Zero();                         ///< unit, from a to b
};

/// Separating axes: all face normals and, in 3-D, all products of two edges.
///
/// In an overlap the value is minus the least translation that separates the shapes; in a gap it is
/// the distance where two faces, or a face and a vertex, or two edges are nearest, else less. Two
/// edges count where they are what touches along their product (in an overlap no other can be the
/// best). An axis is always measured over all vertices, so that one spoiled by rounding can only be
/// useless, never wrong.
///
/// @param across  what a direction is taken from must be wider [m]: a face, and of two edges what
///                the shorter reaches across the longer. Vertices known to 1e-16 m tell it no
///                better than 1e-16 m / `across`, and a gap of metres multiplies that.
///
/// @cost  about 0.3 us for two quadrilaterals, 20 us for two hexahedra
template <int Dim>
[[nodiscard]] LongSeparation<Dim> separating_axes(const LongShape<Dim>& a, const LongShape<Dim>& b,
                                                  long double across = 1e-16L) {
  LongSeparation<Dim> best;
  constexpr long double infinite = std::numeric_limits<long double>::infinity();
  const auto consider = [&](const LongVec<Dim>& direction, long double between) {
    if (between <= best.value) return;  // there is not more room than between the two edges
    const long double room = room_along(a, b, direction, best.value);
    const bool supported = between == infinite || room >= between - 1e-15L;
    if (room > best.value && supported) best = {room, direction};
  };
  for (std::size_t f = 0; f < a.faces.size(); ++f)
    if (a.widths[f] > across) consider(a.normals[f], infinite);
  for (std::size_t f = 0; f < b.faces.size(); ++f)
    if (b.widths[f] > across) consider(-b.normals[f], infinite);
  if constexpr (Dim == 3) {
    for (const auto& edge_a : a.edges) {
      const LongVec<3>& p = a.vertices[edge_a[0]];
      const LongVec<3> u = a.vertices[edge_a[1]] - p;
      const long double u_squared = u.squaredNorm();
      for (const auto& edge_b : b.edges) {
        const LongVec<3>& q = b.vertices[edge_b[0]];
        const LongVec<3> v = b.vertices[edge_b[1]] - q;
        LongVec<3> axis = long_cross(u, v);
        const long double squared = axis.squaredNorm();
        const long double v_squared = v.squaredNorm();
        const long double longer_squared = std::max(u_squared, v_squared);
        if (squared <= across * across * longer_squared) continue;
        axis /= std::sqrt(squared);
        // The product of nearly parallel edges is known well across them but not along them.
        const LongVec<3>& longer = u_squared > v_squared ? u : v;
        axis -= axis.dot(longer) / longer_squared * longer;
        axis /= axis.norm();
        const long double between = axis.dot(q - p);
        consider(axis, between);
        consider(-axis, -between);
      }
    }
  }
  return best;
}

template <int Dim>
[[nodiscard]] long double point_to_edge(const LongVec<Dim>& point, const LongVec<Dim>& start,
                                        const LongVec<Dim>& end) {
  const LongVec<Dim> along = end - start;
  const long double t = (point - start).dot(along) / along.squaredNorm();
  return (point - start - std::clamp(t, 0.0L, 1.0L) * along).norm();
}

[[nodiscard]] inline long double edge_to_edge(const LongVec<3>& p, const LongVec<3>& p_end,
                                              const LongVec<3>& q, const LongVec<3>& q_end) {
  long double least = std::min({point_to_edge(p, q, q_end), point_to_edge(p_end, q, q_end),
                                point_to_edge(q, p, p_end), point_to_edge(q_end, p, p_end)});
  const LongVec<3> u = p_end - p, v = q_end - q, w = q - p, n = long_cross(u, v);
  const long double squared = n.squaredNorm();
  if (squared > 0) {
    const long double s = long_cross(w, v).dot(n) / squared, t = long_cross(w, u).dot(n) / squared;
    // Between two points of them, not along n: of nearly parallel edges n is not good enough.
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least = std::min(least, (w + t * v - s * u).norm());
  }
  return least;
}

/// Distance of two shapes that are apart, over all pairs of features [m].
/// @pre   they do not overlap
/// @cost  about 30 us for two hexahedra
template <int Dim>
[[nodiscard]] long double distance_apart(const LongShape<Dim>& a, const LongShape<Dim>& b) {
  long double least = std::numeric_limits<long double>::infinity();
  const auto vertices_to_faces = [&least](const LongShape<Dim>& from, const LongShape<Dim>& to) {
    for (std::size_t f = 0; f < to.faces.size(); ++f) {
      const auto face = to.corners(to.faces[f]);
      for (const LongVec<Dim>& point : from.vertices) {
        if constexpr (Dim == 2) {
          least = std::min(least, point_to_edge(point, face[0], face[1]));
        } else {
          bool above = true;  // the foot of the perpendicular lies in the face
          for (std::size_t k = 0; above && k < face.size(); ++k) {
            const LongVec<3> along = face[(k + 1) % face.size()] - face[k];
            above = long_cross(along, point - face[k]).dot(to.normals[f]) >= 0;
          }
          if (above) least = std::min(least, std::abs((point - face[0]).dot(to.normals[f])));
        }
      }
    }
  };
  vertices_to_faces(a, b);
  vertices_to_faces(b, a);
  if constexpr (Dim == 3)
    for (const auto& edge_a : a.edges)
      for (const auto& edge_b : b.edges)
        least = std::min(least, edge_to_edge(a.vertices[edge_a[0]], a.vertices[edge_a[1]],
                                             b.vertices[edge_b[0]], b.vertices[edge_b[1]]));
  return least;
}

/// How far a point lies outside the shape, by its faces; negative inside [m].
template <int Dim>
[[nodiscard]] long double outside(const LongShape<Dim>& shape, const LongVec<Dim>& point) {
  long double most = -std::numeric_limits<long double>::infinity();
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    most = std::max(most, shape.normals[f].dot(point - shape.at(shape.faces[f][0])));
  return most;
}

/// The part of a flat convex polygon (2-D: of a segment, its two ends) where `distance` of a point
/// is not positive; `distance` must be linear.
template <int Dim, class Distance>
[[nodiscard]] std::vector<LongVec<Dim>> clipped(const std::vector<LongVec<Dim>>& polygon,
                                                Distance&& distance) {
  std::vector<LongVec<Dim>> kept;
  const std::size_t count = polygon.size(), sides = Dim == 2 ? count - (count > 0) : count;
  for (std::size_t k = 0; k < count; ++k) {
    const long double here = distance(polygon[k]);
    if (here <= 0) kept.push_back(polygon[k]);
    if (k >= sides) break;
    const LongVec<Dim>& next = polygon[(k + 1) % count];
    const long double there = distance(next);
    if ((here < 0 && there > 0) || (here > 0 && there < 0))
      kept.push_back(polygon[k] + here / (here - there) * (next - polygon[k]));
  }
  return kept;
}

/// The part of face `face` of `of` that lies in the other shape.
template <int Dim>
[[nodiscard]] std::vector<LongVec<Dim>> face_inside(const LongShape<Dim>& of, std::size_t face,
                                                    const LongShape<Dim>& other) {
  auto part = of.corners(of.faces[face]);
  for (std::size_t f = 0; f < other.faces.size() && !part.empty(); ++f) {
    const LongVec<Dim>& origin = other.at(other.faces[f][0]);
    part =
        clipped<Dim>(part, [&](const LongVec<Dim>& x) { return other.normals[f].dot(x - origin); });
  }
  return part;
}

/// Length (2-D) or area (3-D) of what `clipped` returns [m], [m^2].
template <int Dim>
[[nodiscard]] long double measure_of(const std::vector<LongVec<Dim>>& part) {
  if constexpr (Dim == 2)
    return part.size() < 2 ? 0.0L : (part.back() - part.front()).norm();
  else
    return part.size() < 3 ? 0.0L : area_vector_of(part).norm();
}

}  // namespace voussoir_test
