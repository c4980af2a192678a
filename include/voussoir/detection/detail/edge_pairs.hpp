// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// A shape and how its features hang together.
struct LinkedShape {
  PlacedShape<3> shape;
  Topology topology;
};

/// Edges of a shape by number; memory is kept from one use to the next.
class EdgeList {
 public:
  /// Empties the list and makes room.
  void start(std::size_t capacity) {
    count_ = 0;
    if (edges_.size() < capacity) edges_.resize(capacity);
  }
  /// Adds the edge if `wanted`, without a branch. @pre there is room
  void add_if(std::size_t edge, bool wanted) {
    edges_[count_] = static_cast<std::uint16_t>(edge);
    count_ += static_cast<std::size_t>(wanted);
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] std::uint16_t operator[](std::size_t k) const { return edges_[k]; }

 private:
  std::size_t count_ = 0;
  std::vector<std::uint16_t> edges_;
};

/// The separating axes that are perpendicular to an edge of each of two polyhedra.
///
/// Of the many pairs only those count whose edges can touch: the arcs that the edges draw on the
/// sphere of normals, one from face to face of a and one from face to face of b reversed, must
/// cross. Four pairs are tested at once by the signs of four dot products.
///
/// Source: the crossing of Gauss maps after Gregorius (2013), The separating axis test between
/// convex polyhedra, Game Developers Conference.
template <class Lanes>
class EdgePairs {
 public:
  /// The pair of edges, a's and b's, with the largest separation.
  struct Best {
    double separation = -std::numeric_limits<double>::infinity();
    std::uint16_t edge_a = 0, edge_b = 0;
    Vec3 normal = Vec3::Zero();  ///< from a to b
  };

  /// @param list_a, list_b  the edges to try
  /// @param floor           separations below this do not matter [m]
  [[nodiscard]] Best run(const LinkedShape& a, const EdgeList& list_a, const LinkedShape& b,
                         const EdgeList& list_b, double floor) {
    gather(b, list_b);
    Best best;
    best.separation = floor;
    for (std::size_t i = 0; i < list_a.size(); ++i) {
      const Topology::Edge& edge = a.topology.edges[list_a[i]];
      const Vec3 start = a.shape.vertex(edge.from), along = a.shape.vertex(edge.to) - start;
      const Vec3 left = a.shape.normal(edge.left), right = a.shape.normal(edge.right);
      for (std::size_t j = 0; j < stride_; j += lane_count) {
        const Lanes left_b = dot(along, 3, j), right_b = dot(along, 6, j);
        const Lanes left_a = dot(left, 0, j), right_a = dot(right, 0, j);
        const Lanes crossing = max(max(left_b * right_b, left_a * right_a), left_b * right_a);
        if (!(crossing.smallest() < 0)) continue;
        const Lanes worse = max(crossing, excess(start, along, left + right, best.separation, j));
        if (!(worse.smallest() < 0)) continue;
        alignas(32) std::array<double, lane_count> signs;
        worse.store(signs.data());
        for (std::size_t lane = 0; lane < lane_count; ++lane)
          if (signs[lane] < 0)
            consider(start, along, left + right, list_a[i], b, list_b[j + lane], best);
      }
    }
    return best;
  }

 private:
  /// Of every edge of b: direction, normals of the faces left and right of it, one end.
  void gather(const LinkedShape& b, const EdgeList& list) {
    stride_ = PlacedShape<3>::padded(list.size());
    if (packed_.size() < 12 * stride_) packed_.resize(12 * stride_);
    const std::size_t vertex_stride = b.shape.vertex_stride(), face_stride = b.shape.face_stride();
    const double *const x = b.shape.vertices(0), *const n = b.shape.normals(0);
    for (std::size_t j = 0; j < stride_; ++j) {
      const bool inside = j < list.size();
      const Topology::Edge edge = b.topology.edges[list[inside ? j : 0]];
      // Past the end a direction of zero: its arcs cross nothing.
      const double scale = inside ? 1 : 0;
      double* to = packed_.data() + j;
      for (std::size_t axis = 0; axis < 3; ++axis, to += stride_) {
        const double* const coordinate = x + axis * vertex_stride;
        const double* const component = n + axis * face_stride;
        to[0] = scale * (coordinate[edge.to] - coordinate[edge.from]);
        to[3 * stride_] = component[edge.left];
        to[6 * stride_] = component[edge.right];
        to[9 * stride_] = coordinate[edge.from];
      }
    }
  }

  /// Negative where a pair of edges may keep the shapes further apart than `best`: told without a
  /// root, with a margin for the rounding.
  [[nodiscard]] Lanes excess(const Vec3& start, const Vec3& along, const Vec3& outward, double best,
                             std::size_t j) const {
    const auto row = [&](std::size_t k) { return Lanes::load(packed_.data() + k * stride_ + j); };
    const auto all = [](double value) { return Lanes::all(value); };
    const Lanes x = row(0), y = row(1), z = row(2);
    const Lanes cx = all(along[1]) * z - all(along[2]) * y;
    const Lanes cy = all(along[2]) * x - all(along[0]) * z;
    const Lanes cz = all(along[0]) * y - all(along[1]) * x;
    const Lanes inward = all(-outward[0]) * cx + all(-outward[1]) * cy + all(-outward[2]) * cz;
    const Lanes product = (row(9) - all(start[0])) * cx + (row(10) - all(start[1])) * cy +
                          (row(11) - all(start[2])) * cz;
    const Lanes squared = cx * cx + cy * cy + cz * cz;
    const double least = best < 0 ? best * best * (1 + 1e-8) : -1;
    // Separation = product / root of `squared`, with the sign that turns the normal outward: it is
    // positive, or negative and small.
    if (least < 0) return product * inward;
    return min(product * inward, product * product - all(least) * squared);
  }

  /// Dot products of v with four columns of three rows.
  [[nodiscard]] Lanes dot(const Vec3& v, std::size_t row, std::size_t j) const {
    const double* const column = packed_.data() + row * stride_ + j;
    return Lanes::all(v[0]) * Lanes::load(column) +
           Lanes::all(v[1]) * Lanes::load(column + stride_) +
           Lanes::all(v[2]) * Lanes::load(column + 2 * stride_);
  }

  /// Takes the pair of edges if it keeps the shapes further apart than the best so far.
  static void consider(const Vec3& start, const Vec3& along, const Vec3& outward, std::uint16_t i,
                       const LinkedShape& b, std::uint16_t j, Best& best) {
    const Topology::Edge& edge = b.topology.edges[j];
    const Vec3 other = b.shape.vertex(edge.from), direction = b.shape.vertex(edge.to) - other;
    const Vec3 both = cross(along, direction), offset = other - start;
    const double squared = both.squaredNorm();
    // Of edges that are parallel but for 1e-6 rad the common normal is noise, and the normals of
    // the faces beside them say as much.
    if (squared < 1e-12 * along.squaredNorm() * direction.squaredNorm()) return;
    const double sign = both.dot(outward) < 0 ? -1 : 1;
    const Vec3 normal = both * (sign / std::sqrt(squared));
    // Measured between the closest points of the edges: between others the rounding of the normal
    // of nearly parallel edges would count with their distance.
    const double s = std::clamp(cross(offset, direction).dot(both) / squared, 0.0, 1.0);
    const double t = std::clamp(cross(offset, along).dot(both) / squared, 0.0, 1.0);
    const double separation = normal.dot((offset + t * direction) - s * along);
    if (separation > best.separation) best = {separation, i, j, normal};
  }

  std::size_t stride_ = 0;
  std::vector<double> packed_;
};

}  // namespace voussoir::detail
