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
  [[nodiscard]] Best run(const PlacedShape<3>& a, const Topology& of_a,
                         const std::vector<std::uint16_t>& list_a, const PlacedShape<3>& b,
                         const Topology& of_b, const std::vector<std::uint16_t>& list_b,
                         double floor) {
    gather(b, of_b, list_b);
    Best best;
    best.separation = floor;
    const std::size_t groups = list_b.size();
    for (const std::uint16_t i : list_a) {
      const Topology::Edge& edge = of_a.edges[i];
      const Vec3 start = a.vertex(edge.from), along = a.vertex(edge.to) - start;
      const Vec3 left = a.normal(edge.left), right = a.normal(edge.right);
      for (std::size_t j = 0; j < groups; j += lane_count) {
        const Lanes left_b = dot(along, 3, j), right_b = dot(along, 6, j);
        const Lanes left_a = dot(left, 0, j), right_a = dot(right, 0, j);
        const Lanes crossing = max(max(left_b * right_b, left_a * right_a), left_b * right_a);
        if (!(crossing.smallest() < 0)) continue;
        alignas(32) std::array<double, lane_count> signs;
        crossing.store(signs.data());
        for (std::size_t lane = 0; lane < lane_count; ++lane)
          if (signs[lane] < 0)
            consider(start, along, left + right, i, b, of_b, list_b[j + lane], best);
      }
    }
    return best;
  }

  /// Separation along the common normal of two lines, and that normal, taken to point as `outward`
  /// does. Measured between their closest points: between others the rounding of the normal of
  /// nearly parallel edges would count with their distance.
  [[nodiscard]] static double between(const Vec3& start_a, const Vec3& along_a, const Vec3& start_b,
                                      const Vec3& along_b, const Vec3& outward, Vec3& normal) {
    const Vec3 both = cross(along_a, along_b), offset = start_b - start_a;
    const double squared = both.squaredNorm();
    normal = both / std::copysign(std::sqrt(squared), both.dot(outward));
    const double s = std::clamp(cross(offset, along_b).dot(both) / squared, 0.0, 1.0);
    const double t = std::clamp(cross(offset, along_a).dot(both) / squared, 0.0, 1.0);
    return normal.dot((offset + t * along_b) - s * along_a);
  }

 private:
  /// Of every edge of b: direction, normals of the faces left and right of it.
  void gather(const PlacedShape<3>& b, const Topology& of_b,
              const std::vector<std::uint16_t>& list) {
    stride_ = PlacedShape<3>::padded(list.size());
    if (packed_.size() < 9 * stride_) packed_.resize(9 * stride_);
    for (std::size_t j = 0; j < stride_; ++j) {
      // Past the end a direction of zero: its arcs cross nothing.
      const Topology::Edge& edge = of_b.edges[list[std::min(j, list.size() - 1)]];
      const Vec3 left = b.normal(edge.left), right = b.normal(edge.right);
      const Vec3 along =
          j < list.size() ? Vec3(b.vertex(edge.to) - b.vertex(edge.from)) : Vec3(Vec3::Zero());
      for (int axis = 0; axis < 3; ++axis) {
        at(axis, j) = along[axis];
        at(3 + axis, j) = left[axis];
        at(6 + axis, j) = right[axis];
      }
    }
  }
  [[nodiscard]] double& at(int row, std::size_t j) {
    return packed_[static_cast<std::size_t>(row) * stride_ + j];
  }
  /// Dot products of v with four columns of three rows.
  [[nodiscard]] Lanes dot(const Vec3& v, std::size_t row, std::size_t j) const {
    const double* const column = packed_.data() + row * stride_ + j;
    return Lanes::all(v[0]) * Lanes::load(column) +
           Lanes::all(v[1]) * Lanes::load(column + stride_) +
           Lanes::all(v[2]) * Lanes::load(column + 2 * stride_);
  }

  static void consider(const Vec3& start, const Vec3& along, const Vec3& outward, std::uint16_t i,
                       const PlacedShape<3>& b, const Topology& of_b, std::uint16_t j, Best& best) {
    const Topology::Edge& edge = of_b.edges[j];
    const Vec3 other = b.vertex(edge.from), direction = b.vertex(edge.to) - other;
    const Vec3 both = cross(along, direction);
    const double squared = both.squaredNorm();
    // Of edges that are parallel but for 1e-6 rad the common normal is noise, and the normals of
    // the faces beside them say as much.
    if (squared < 1e-12 * along.squaredNorm() * direction.squaredNorm()) return;
    // Most pairs are far from the best: told without a root. The margin covers the rounding.
    const double product = std::copysign(1.0, both.dot(outward)) * both.dot(other - start);
    const double least = best.separation - 1e-9 * std::abs(best.separation);
    if (product < 0 && (least >= 0 || product * product > least * least * squared)) return;
    Vec3 normal;
    const double separation = between(start, along, other, direction, outward, normal);
    if (separation > best.separation) best = {separation, i, j, normal};
  }

  std::size_t stride_ = 0;
  std::vector<double> packed_;
};

}  // namespace voussoir::detail
