// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/lanes.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/detail/remove_dents.hpp>

namespace voussoir {

/// A convex shape where it is now, coordinate by coordinate, counted from a point of a coarse grid
/// (see PlacedShapes).
///
/// Arrays are padded to whole groups of `lane_count` by repeating their last entry, which changes
/// neither a largest nor a smallest value; they are aligned for vector registers.
template <int Dim>
struct PlacedShape {
  const double* data;          ///< vertices by coordinate, normals by coordinate, offsets
  std::uint32_t vertex_count;  ///< in 2-D also the number of faces
  std::uint32_t face_count;

  /// Counts rounded up to whole groups.
  [[nodiscard]] std::size_t vertex_stride() const { return padded(vertex_count); }
  [[nodiscard]] std::size_t face_stride() const { return padded(face_count); }
  [[nodiscard]] static constexpr std::size_t padded(std::size_t count) {
    return (count + lane_count - 1) / lane_count * lane_count;
  }

  /// Coordinate `axis` of all vertices [m].
  [[nodiscard]] const double* vertices(int axis) const {
    return data + static_cast<std::size_t>(axis) * vertex_stride();
  }
  /// Component `axis` of the outward unit normals of all faces.
  [[nodiscard]] const double* normals(int axis) const {
    return data + Dim * vertex_stride() + static_cast<std::size_t>(axis) * face_stride();
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
  /// Vertices of each face, anticlockwise from outside, but for those in dents (see
  /// `remove_dents`) and on the straight line between others.
  std::span<const std::uint16_t> loops;
  std::span<const std::uint16_t> sides;  ///< the edges that start there, loop after loop

  std::span<const std::uint32_t> fan_begin;  ///< one more than vertices
  std::span<const std::uint16_t> fans;       ///< faces at each vertex
  double diameter = 0;                       ///< longest distance between two vertices [m]
  /// Longest distance of a vertex from the plane of a face it is of, and above that of any [m].
  double unevenness = 0;

  [[nodiscard]] std::span<const std::uint16_t> loop(std::size_t face) const {
    return loops.subspan(loop_begin[face], loop_begin[face + 1] - loop_begin[face]);
  }
  /// The edge of a face from vertex k of its loop to the next; the longest of several.
  [[nodiscard]] std::uint16_t side(std::size_t face, std::size_t k) const {
    return sides[loop_begin[face] - loop_begin[0] + k];
  }
  [[nodiscard]] std::span<const std::uint16_t> faces_at(std::size_t vertex) const {
    return fans.subspan(fan_begin[vertex], fan_begin[vertex + 1] - fan_begin[vertex]);
  }
};

/// Convex shapes that move, laid out for contact detection.
///
/// Every shape is kept in a frame of its own, so that what it is at rest never drifts, and written
/// to where it is by `place`. There its coordinates are counted from the point of a grid of 256 m
/// that is nearest to its position, which keeps them below some 130 m and good to 1e-14 m wherever
/// the site is: what is lost is only what the given coordinates and positions have been rounded to.
/// Who compares two shapes reads both from the grid point of the first (`seen_from`). Most have the
/// same, and nothing is to be done; steps between grid points are exact.
///
/// @cost  `place`: about 10 ns a polygon, 20 ns a polyhedron of six faces
template <int Dim>
class PlacedShapes {
 public:
  using Shape = std::conditional_t<Dim == 2, ConvexPolygon, ConvexPolyhedron>;

  /// Adds a shape and places it where it is given.
  /// @param origin  of the shape's own frame, e.g. its centroid [m]
  /// @return  its number, from 0
  /// @throws InvalidInput  the origin is not finite, or more than 65535 vertices or faces
  std::size_t add(const Shape& shape, const Vec<Dim>& origin);

  /// Moves a shape from its own frame to `pose`.
  /// @throws InvalidInput  the pose is not finite; the shape stays where it was
  void place(std::size_t shape, const Pose<Dim>& pose);

  [[nodiscard]] std::size_t size() const { return records_.size(); }

  /// Numbers of a shape as it is seen from another grid point.
  using Shifted = std::vector<double, Eigen::aligned_allocator<double>>;

  /// The shape, counted from its own grid point.
  [[nodiscard]] PlacedShape<Dim> operator[](std::size_t shape) const {
    VOUSSOIR_ASSERT(shape < records_.size(), "a shape is one of those placed");
    const Record& r = records_[shape];
    return {placed_.data() + r.begin, r.vertex_count, r.face_count};
  }
  /// What its coordinates are counted from [m].
  [[nodiscard]] const Vec<Dim>& grid_point(std::size_t shape) const {
    return grid_points_[records_[shape].cell];
  }
  /// Shape b, counted from the grid point of shape a.
  /// @param shifted  holds its numbers where the two have not the same grid point
  [[nodiscard]] PlacedShape<Dim> seen_from(std::size_t a, std::size_t b, Shifted& shifted) const {
    if (records_[a].cell == records_[b].cell) return (*this)[b];
    return shift(b, grid_point(b) - grid_point(a), shifted);
  }

  /// Where the origin of a shape was when it was added: tells shapes apart whatever their numbers.
  [[nodiscard]] const Vec<Dim>& home(std::size_t shape) const { return homes_[shape]; }

  [[nodiscard]] Topology topology(std::size_t shape) const requires(Dim == 3) {
    VOUSSOIR_ASSERT(shape < links_.size() && links_.size() == records_.size(),
                    "a shape in 3-D has its edges");
    const Links& l = links_[shape];
    const Record& r = records_[shape];
    return {{edges_.data() + l.first_edge, l.edge_count},
            {begins_.data() + l.first_loop, r.face_count + std::size_t{1}},
            indices_,
            {sides_.data() + l.first_side, l.side_count},
            {begins_.data() + l.first_fan, r.vertex_count + std::size_t{1}},
            indices_,
            l.diameter,
            l.unevenness};
  }

 private:
  /// Where a shape's numbers start, and how many there are.
  struct Record {
    std::size_t begin;
    std::uint16_t vertex_count, face_count;
    std::uint32_t cell;  ///< in `grid_points_`
    [[nodiscard]] std::size_t vertex_stride() const {
      return PlacedShape<Dim>::padded(vertex_count);
    }
    [[nodiscard]] std::size_t face_stride() const { return PlacedShape<Dim>::padded(face_count); }
  };
  struct Links {
    std::size_t first_edge, edge_count, first_loop, first_side, side_count, first_fan;
    double diameter, unevenness;
  };

  void add_topology(const ConvexPolyhedron& shape);

  [[nodiscard]] PlacedShape<Dim> shift(std::size_t shape, const Vec<Dim>& by,
                                       Shifted& shifted) const;

  static constexpr double half_a_cell = 128;  ///< of the grid [m]

  /// The nearest point of the grid. Numbers as large as the one added have no digits below 256.
  [[nodiscard]] static Vec<Dim> nearest_grid_point(const Vec<Dim>& x) {
    constexpr double large = 0x1.8p52 * (2 * half_a_cell);
    Vec<Dim> point;
    for (int axis = 0; axis < Dim; ++axis) point[axis] = (x[axis] + large) - large;
    return point;
  }
  /// The number of the grid point that is nearest. There are few of them, and one is looked up only
  /// when a shape has gone to another.
  [[nodiscard]] std::uint32_t cell_of(const Vec<Dim>& x) {
    const Vec<Dim> point = nearest_grid_point(x);
    std::size_t k = 0;
    while (k < grid_points_.size() && grid_points_[k] != point) ++k;
    if (k == grid_points_.size()) grid_points_.push_back(point);
    return static_cast<std::uint32_t>(k);
  }

  template <class T>
  using Aligned = std::vector<T, Eigen::aligned_allocator<T>>;
  std::vector<Record> records_;
  std::vector<Vec<Dim>> homes_, grid_points_;
  Aligned<double> own_, placed_;
  std::vector<Links> links_;
  std::vector<Topology::Edge> edges_;
  std::vector<std::uint32_t> begins_;   ///< where loops and fans start in `indices_`
  std::vector<std::uint16_t> indices_;  ///< vertices of loops, faces of fans
  std::vector<std::uint16_t> sides_;    ///< edges of loops
};

template <int Dim>
std::size_t PlacedShapes<Dim>::add(const Shape& shape, const Vec<Dim>& origin) {
  const std::size_t vertex_count = shape.vertices().size(), face_count = shape.size();
  const auto refuse = [this](const std::string& what) {
    throw InvalidInput(message({"placed shapes: shape ", size(), what}));
  };
  if (!is_finite(origin)) refuse(": the origin of its frame must be finite");
  if (std::max(vertex_count, face_count) > UINT16_MAX)
    refuse(" has more than 65535 vertices or faces");
  const Record record{placed_.size(), static_cast<std::uint16_t>(vertex_count),
                      static_cast<std::uint16_t>(face_count), cell_of(origin)};
  const std::size_t vertex_stride = record.vertex_stride(), face_stride = record.face_stride();
  records_.push_back(record);
  homes_.push_back(origin);
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
    out[Dim * face_stride + k] = -shape.distance(std::min(k, face_count - 1), origin);
  }
  if constexpr (Dim == 3) add_topology(shape);
  Pose<Dim> pose;
  pose.position = origin;
  place(records_.size() - 1, pose);
  return records_.size() - 1;
}

template <int Dim>
void PlacedShapes<Dim>::place(std::size_t shape, const Pose<Dim>& pose) {
  if (!std::isfinite(pose.position.sum() + pose.rotation.sum()))
    throw InvalidInput(
        message({"placed shapes: pose of shape ", shape, " at ", text_of<Dim>(pose.position),
                 ": position and rotation must be finite"}));
  VOUSSOIR_ASSERT(shape < records_.size() && own_.size() == placed_.size(),
                  "a shape is one of those added");
  Record& r = records_[shape];
  Vec<Dim> position = pose.position - grid_points_[r.cell];
  double farthest = 0;
  for (int axis = 0; axis < Dim; ++axis) farthest = std::max(farthest, std::abs(position[axis]));
  if (farthest > half_a_cell) {
    r.cell = cell_of(pose.position);
    position = pose.position - grid_points_[r.cell];
  }
  const double* from = own_.data() + r.begin;
  double* to = placed_.data() + r.begin;
  const std::size_t vertex_stride = r.vertex_stride(), face_stride = r.face_stride();
  using Lanes = detail::VectorLanes;
  const auto turned = [&pose](const double* x, std::size_t stride, int axis) {
    Lanes sum = Lanes::all(pose.rotation(axis, 0)) * Lanes::load(x) +
                Lanes::all(pose.rotation(axis, 1)) * Lanes::load(x + stride);
    if constexpr (Dim == 3)
      sum = sum + Lanes::all(pose.rotation(axis, 2)) * Lanes::load(x + 2 * stride);
    return sum;
  };
  for (std::size_t k = 0; k < vertex_stride; k += lane_count)
    for (int axis = 0; axis < Dim; ++axis)
      (turned(from + k, vertex_stride, axis) + Lanes::all(position[axis]))
          .store(to + static_cast<std::size_t>(axis) * vertex_stride + k);
  from += Dim * vertex_stride;
  to += Dim * vertex_stride;
  for (std::size_t k = 0; k < face_stride; k += lane_count) {
    Lanes offset = Lanes::load(from + Dim * face_stride + k);
    for (int axis = 0; axis < Dim; ++axis) {
      const Lanes normal = turned(from + k, face_stride, axis);
      normal.store(to + static_cast<std::size_t>(axis) * face_stride + k);
      offset = offset + normal * Lanes::all(position[axis]);
    }
    offset.store(to + Dim * face_stride + k);
  }
}

template <int Dim>
PlacedShape<Dim> PlacedShapes<Dim>::shift(std::size_t shape, const Vec<Dim>& by,
                                          Shifted& shifted) const {
  const PlacedShape<Dim> from = (*this)[shape];
  const std::size_t vertex_stride = from.vertex_stride(), face_stride = from.face_stride();
  shifted.resize(Dim * vertex_stride + (Dim + 1) * face_stride);
  double* to = shifted.data();
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t k = 0; k < vertex_stride; ++k) *to++ = from.vertices(axis)[k] + by[axis];
  to = std::copy(from.normals(0), from.normals(0) + Dim * face_stride, to);
  for (std::size_t k = 0; k < face_stride; ++k) {
    double along = 0;
    for (int axis = 0; axis < Dim; ++axis) along += from.normals(axis)[k] * by[axis];
    to[k] = from.offsets()[k] + along;
  }
  return {shifted.data(), from.vertex_count, from.face_count};
}

template <int Dim>
void PlacedShapes<Dim>::add_topology(const ConvexPolyhedron& shape) {
  if (shape.size() > 65535 || shape.vertices().size() > 65535)
    throw InvalidInput(
        message({"placed shapes: shape ", links_.size(), " has ", shape.size(), " faces and ",
                 shape.vertices().size(), " vertices: at most 65535 of each"}));
  const auto small = [](auto index) { return static_cast<std::uint16_t>(index); };
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  const auto mark = [this] { begins_.push_back(static_cast<std::uint32_t>(indices_.size())); };
  Links links{
      edges_.size(), shape.edge_count(), begins_.size(), sides_.size(), 0, 0, shape.diameter(), 0};
  // By face and place in its loop: the edge that starts there.
  std::vector<std::vector<std::uint16_t>> starting(shape.size());
  for (std::size_t face = 0; face < shape.size(); ++face)
    starting[face].resize(shape.loop(face).size());
  const auto link = [&](int face, int vertex, std::size_t edge) {
    const auto loop = shape.loop(at(face));
    starting[at(face)]
            [static_cast<std::size_t>(std::find(loop.begin(), loop.end(), vertex) - loop.begin())] =
                small(edge);
  };
  for (const auto& edge : shape.edges()) {
    link(edge.left, edge.from, edges_.size() - links.first_edge);
    link(edge.right, edge.to, edges_.size() - links.first_edge);
    edges_.push_back({small(edge.from), small(edge.to), small(edge.left), small(edge.right)});
  }
  // A rounding turns a side of 1e-9 m by 1e-6 whenever the shape moves: what stands out by so
  // little goes as well, or it might become a dent.
  const double straight = 1e-13 * links.diameter;
  std::vector<std::vector<std::uint16_t>> fans(shape.vertices().size());
  std::vector<std::size_t> outline;
  for (std::size_t face = 0; face < shape.size(); ++face) {
    mark();
    const auto loop = shape.loop(face);
    const auto corner = [&](std::size_t k) -> const Vec3& { return shape.vertex(at(loop[k])); };
    outline.clear();
    for (const Vec3& vertex : shape.vertices())
      links.unevenness = std::max(links.unevenness, shape.distance(face, vertex));
    for (std::size_t k = 0; k < loop.size(); ++k) {
      outline.push_back(k);
      links.unevenness = std::max(links.unevenness, -shape.distance(face, corner(k)));
      fans[at(loop[k])].push_back(small(face));
    }
    detail::remove_dents(outline, 0, [&](std::size_t a, std::size_t b, std::size_t c) {
      const Vec3 before = corner(b) - corner(a), after = corner(c) - corner(b);
      return dot_product(shape.half_space(face).normal, cross(before, after)) <=
             straight * length_of(before + after);
    });
    for (std::size_t k = 0; k < outline.size(); ++k) {
      indices_.push_back(small(loop[outline[k]]));
      const std::size_t next = outline[k + 1 == outline.size() ? 0 : k + 1];
      std::size_t longest = outline[k];
      double length = 0;
      for (std::size_t from = outline[k]; from != next;) {
        const std::size_t to = from + 1 == loop.size() ? 0 : from + 1;
        const double squared = squared_length_of(corner(to) - corner(from));
        longest = squared > length ? from : longest;
        length = std::max(length, squared);
        from = to;
      }
      sides_.push_back(starting[face][longest]);
    }
  }
  mark();
  links.side_count = sides_.size() - links.first_side;
  links.first_fan = begins_.size();
  for (const auto& fan : fans) {
    mark();
    for (const auto index : fan) indices_.push_back(index);
  }
  mark();
  links_.push_back(links);
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class PlacedShapes<2>;
VOUSSOIR_SPATIAL_TEMPLATE class PlacedShapes<3>;
#endif

}  // namespace voussoir
