// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>

namespace voussoir {

/// Coordinates are handled in groups of so many numbers: one vector register of AVX, two of SSE2.
inline constexpr std::size_t lane_count = 4;

/// A convex shape where it is now, coordinate by coordinate.
///
/// Arrays are padded to whole groups of `lane_count` by repeating their last entry, which changes
/// neither a largest nor a smallest value; they are aligned for vector registers.
template <int Dim>
struct PlacedShape {
  const double* data;        ///< vertices by coordinate, then normals by coordinate, then offsets
  std::size_t vertex_count;  ///< in 2-D also the number of faces
  std::size_t face_count;
  std::size_t vertex_stride;  ///< `vertex_count` rounded up to whole groups
  std::size_t face_stride;    ///< `face_count` rounded up to whole groups

  /// Coordinate `axis` of all vertices [m].
  [[nodiscard]] const double* vertices(int axis) const {
    return data + static_cast<std::size_t>(axis) * vertex_stride;
  }
  /// Component `axis` of the outward unit normals of all faces.
  [[nodiscard]] const double* normals(int axis) const {
    return data + Dim * vertex_stride + static_cast<std::size_t>(axis) * face_stride;
  }
  /// normal . x of the points of each face [m].
  [[nodiscard]] const double* offsets() const { return normals(Dim); }

  [[nodiscard]] Vec<Dim> vertex(std::size_t k) const {
    Vec<Dim> point;
    for (int axis = 0; axis < Dim; ++axis) point[axis] = vertices(axis)[k];
    return point;
  }
  [[nodiscard]] Vec<Dim> normal(std::size_t face) const {
    Vec<Dim> direction;
    for (int axis = 0; axis < Dim; ++axis) direction[axis] = normals(axis)[face];
    return direction;
  }
  [[nodiscard]] double offset(std::size_t face) const { return offsets()[face]; }
};

/// How the faces, edges and vertices of a polyhedron hang together; it does not change as it moves.
struct Topology {
  struct Edge {
    std::uint16_t from, to;     ///< vertices
    std::uint16_t left, right;  ///< faces; `left` runs along it from `from` to `to`
  };
  std::span<const Edge> edges;
  std::span<const std::uint32_t> loop_begin;  ///< one more than faces
  std::span<const std::uint16_t> loops;       ///< vertices of each face, anticlockwise from outside

  [[nodiscard]] std::span<const std::uint16_t> loop(std::size_t face) const {
    return loops.subspan(loop_begin[face], loop_begin[face + 1] - loop_begin[face]);
  }
};

/// Convex shapes that move, laid out for contact detection.
///
/// Every shape is kept in a frame of its own, so that what it is at rest never drifts, and written
/// to the common frame by `place`. Coordinates near 1 m and positions below some 100 m keep the
/// common frame good to 1e-14 m; take the site's grid off before (see `Domain::site_origin`).
///
/// @cost  `place`: about 10 ns a polygon, 20 ns a polyhedron of six faces
template <int Dim>
class PlacedShapes {
 public:
  using Shape = std::conditional_t<Dim == 2, ConvexPolygon, ConvexPolyhedron>;

  /// Adds a shape and places it where it is given.
  /// @param origin  of the shape's own frame, e.g. its centroid [m]
  /// @return  its number, from 0
  std::size_t add(const Shape& shape, const Vec<Dim>& origin) {
    const std::size_t vertex_count = shape.vertices().size(), face_count = shape.size();
    const std::size_t vertex_stride = padded(vertex_count), face_stride = padded(face_count);
    records_.push_back({placed_.size(), vertex_count, face_count, vertex_stride, face_stride});
    const std::size_t length = Dim * vertex_stride + (Dim + 1) * face_stride;
    own_.resize(own_.size() + length);
    placed_.resize(own_.size());
    double* out = own_.data() + records_.back().begin;
    for (int axis = 0; axis < Dim; ++axis, out += vertex_stride)
      for (std::size_t k = 0; k < vertex_stride; ++k)
        out[k] = shape.vertex(std::min(k, vertex_count - 1))[axis] - origin[axis];
    for (std::size_t k = 0; k < face_stride; ++k) {
      const auto side = shape.half_space(std::min(k, face_count - 1));
      for (int axis = 0; axis < Dim; ++axis)
        out[static_cast<std::size_t>(axis) * face_stride + k] = side.normal[axis];
      out[Dim * face_stride + k] = -side.distance(origin);
    }
    if constexpr (Dim == 3) add_topology(shape);
    Pose<Dim> pose;
    pose.position = origin;
    place(records_.size() - 1, pose);
    return records_.size() - 1;
  }

  /// Moves a shape from its own frame to `pose`.
  void place(std::size_t shape, const Pose<Dim>& pose) {
    const Record& r = records_[shape];
    const double* from = own_.data() + r.begin;
    double* to = placed_.data() + r.begin;
    const auto turn = [&](std::size_t stride, std::size_t k, int axis) {
      double sum = pose.rotation(axis, 0) * from[k] + pose.rotation(axis, 1) * from[stride + k];
      if constexpr (Dim == 3) sum += pose.rotation(axis, 2) * from[2 * stride + k];
      return sum;
    };
    for (int axis = 0; axis < Dim; ++axis)
      for (std::size_t k = 0; k < r.vertex_stride; ++k)
        to[static_cast<std::size_t>(axis) * r.vertex_stride + k] =
            turn(r.vertex_stride, k, axis) + pose.position[axis];
    from += Dim * r.vertex_stride;
    to += Dim * r.vertex_stride;
    for (int axis = 0; axis < Dim; ++axis)
      for (std::size_t k = 0; k < r.face_stride; ++k)
        to[static_cast<std::size_t>(axis) * r.face_stride + k] = turn(r.face_stride, k, axis);
    for (std::size_t k = 0; k < r.face_stride; ++k) {
      double along = to[k] * pose.position[0] + to[r.face_stride + k] * pose.position[1];
      if constexpr (Dim == 3) along += to[2 * r.face_stride + k] * pose.position[2];
      to[Dim * r.face_stride + k] = from[Dim * r.face_stride + k] + along;
    }
  }

  [[nodiscard]] std::size_t size() const { return records_.size(); }

  [[nodiscard]] PlacedShape<Dim> operator[](std::size_t shape) const {
    const Record& r = records_[shape];
    return {placed_.data() + r.begin, r.vertex_count, r.face_count, r.vertex_stride, r.face_stride};
  }

  [[nodiscard]] Topology topology(std::size_t shape) const requires(Dim == 3) {
    const Links& l = links_[shape];
    const std::size_t faces = records_[shape].face_count;
    return {{edges_.data() + l.first_edge, l.edge_count},
            {loop_begin_.data() + l.first_begin, faces + 1},
            loops_};
  }

 private:
  /// Where a shape's numbers start, and how many there are.
  struct Record {
    std::size_t begin, vertex_count, face_count, vertex_stride, face_stride;
  };
  struct Links {
    std::size_t first_edge, edge_count, first_begin;
  };

  [[nodiscard]] static std::size_t padded(std::size_t count) {
    return (count + lane_count - 1) / lane_count * lane_count;
  }

  void add_topology(const ConvexPolyhedron& shape) {
    links_.push_back({edges_.size(), shape.edges().size(), loop_begin_.size()});
    const auto small = [](int index) { return static_cast<std::uint16_t>(index); };
    for (const auto& edge : shape.edges())
      edges_.push_back({small(edge.from), small(edge.to), small(edge.left), small(edge.right)});
    for (std::size_t face = 0; face < shape.size(); ++face) {
      loop_begin_.push_back(static_cast<std::uint32_t>(loops_.size()));
      for (const int vertex : shape.loop(face)) loops_.push_back(small(vertex));
    }
    loop_begin_.push_back(static_cast<std::uint32_t>(loops_.size()));
  }

  template <class T>
  using Aligned = std::vector<T, Eigen::aligned_allocator<T>>;
  std::vector<Record> records_;
  Aligned<double> own_, placed_;
  std::vector<Links> links_;
  std::vector<Topology::Edge> edges_;
  std::vector<std::uint32_t> loop_begin_;
  std::vector<std::uint16_t> loops_;
};

}  // namespace voussoir
