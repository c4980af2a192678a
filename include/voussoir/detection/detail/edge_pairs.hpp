// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>
#include <voussoir/core/errors.hpp>
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
    VOUSSOIR_ASSERT(count_ < edges_.size(), "a list of edges has room for all that are looked at");
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
/// Nearly parallel edges are where roundings bite: two of 1e-4 m that cross at 1e-9 rad have a
/// normal that is off by 0.1 rad at 100 m from the origin. Tests that leave out a pair therefore
/// have a margin for the rounding, and what is left is measured over all vertices, which can never
/// give more than the truth. A pair that slips through the margin may so have the normal of the
/// pair that touches, to a rounding, and not be near the contact: of the two, the pair that touches
/// counts.
///
/// Source: the crossing of Gauss maps after Gregorius (2013), The separating axis test between
/// convex polyhedra, Game Developers Conference.
template <class Lanes>
class EdgePairs {
 public:
  /// Of coordinates, in 1 m: a few roundings at 100 m from the origin.
  static constexpr double rounding = 4e-14;

  /// The pair of edges, a's and b's, with the largest separation.
  struct Best {
    double separation = -std::numeric_limits<double>::infinity();
    std::uint16_t edge_a = 0, edge_b = 0;
    Vec3 normal = zeros<Vec3>();  ///< from a to b
    bool is_of_edges = true;      ///< see `Axis`
  };

  /// @param list_a, list_b  the edges to try
  /// @param floor           separations below this do not matter [m]
  [[nodiscard]] Best run(const LinkedShape& a, const EdgeList& list_a, const LinkedShape& b,
                         const EdgeList& list_b, double floor) {
    gather(b, list_b);
    const double size = a.topology.diameter + b.topology.diameter;
    slack_ = 10001 * (rounding * size * size) * (rounding * size * size);
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
        if (!(crossing.smallest() < margin)) continue;
        const Lanes worse = max(crossing - Lanes::all(margin),
                                excess(start, along, left + right, best.separation, j));
        if (!(worse.smallest() < 0)) continue;
        alignas(32) std::array<double, lane_count> signs;
        worse.store(signs.data());
        const std::size_t lanes = std::min(lane_count, list_b.size() - j);
        for (std::size_t lane = 0; lane < lanes; ++lane)
          if (signs[lane] < 0) consider(a, list_a[i], b, list_b[j + lane], best);
      }
    }
    return best;
  }

  /// The room between two shapes along the common normal of two edges.
  struct Axis {
    double separation = -std::numeric_limits<double>::infinity();  ///< of the shapes [m]
    double gap = 0;                                                ///< of the two edges [m]
    Vec3 normal = zeros<Vec3>();                                   ///< from a to b

    /// Whether nothing of either shape lies beyond its edge.
    [[nodiscard]] bool is_of_edges() const { return gap - separation <= 4 * rounding; }
  };
  /// @param enough  what is not above this is of no interest: the separation may be -infinity, as
  ///                it is for parallel edges [m]
  [[nodiscard]] static Axis axis(const LinkedShape& a, std::uint16_t i, const LinkedShape& b,
                                 std::uint16_t j, double enough) {
    const Topology::Edge &of_a = a.topology.edges[i], &of_b = b.topology.edges[j];
    const Vec3 p = a.shape.vertex(of_a.from), u = a.shape.vertex(of_a.to) - p;
    const Vec3 q = b.shape.vertex(of_b.from), v = b.shape.vertex(of_b.to) - q;
    const Vec3 outward = a.shape.normal(of_a.left) + a.shape.normal(of_a.right);
    const double uu = squared_length_of(u), vv = squared_length_of(v);
    Axis found;
    Vec3& normal = found.normal;
    normal = cross(u, v);
    if (squared_length_of(normal) <= 1e-24 * uu * vv) return found;
    // Its rounding matters along the longer edge only; across it, it moves neither of the two.
    const Vec3& longer = uu > vv ? u : v;
    normal -= (dot_product(normal, longer) / std::max(uu, vv)) * longer;
    normal *= (dot_product(normal, outward) < 0 ? -1 : 1) / length_of(normal);
    found.gap = dot_product(normal, q - p);
    if (!(found.gap > enough)) return found;  // there is not more room than between them
    found.separation = lowest(normal, b.shape) + lowest(-normal, a.shape);
    return found;
  }

  /// Where an edge of a passes one of b, as seen along their common normal.
  struct Crossing {
    double room = -1;            ///< to the rim of the parallelogram of both; < 0: no crossing [m]
    Vec3 point = zeros<Vec3>();  ///< on the edge of a [m]
  };
  [[nodiscard]] static Crossing crossing(const LinkedShape& a, std::uint16_t i,
                                         const LinkedShape& b, std::uint16_t j) {
    const Topology::Edge &of_a = a.topology.edges[i], &of_b = b.topology.edges[j];
    const Vec3 p = a.shape.vertex(of_a.from), u = a.shape.vertex(of_a.to) - p;
    const Vec3 q = b.shape.vertex(of_b.from), v = b.shape.vertex(of_b.to) - q;
    const Vec3 both = cross(u, v), offset = q - p;
    const double squared = squared_length_of(both);
    const double s = dot_product(cross(offset, v), both), t = dot_product(cross(offset, u), both);
    const double of_u = std::min(s, squared - s), of_v = std::min(t, squared - t);
    if (!(std::min(of_u, of_v) >= 0)) return {};
    return {
        std::sqrt(std::min(of_u * of_u / squared_length_of(v), of_v * of_v / squared_length_of(u)) /
                  squared),
        p + (s / squared) * u};
  }

 private:
  /// Of the products that tell whether arcs cross [m^2].
  static constexpr double margin = 1e-12;

  [[nodiscard]] static double lowest(const Vec3& n, const PlacedShape<3>& shape) {
    const double *const x = shape.vertices(0), *const y = shape.vertices(1);
    const double* const z = shape.vertices(2);
    const Lanes nx = Lanes::all(n[0]), ny = Lanes::all(n[1]), nz = Lanes::all(n[2]);
    Lanes low = nx * Lanes::load(x) + ny * Lanes::load(y) + nz * Lanes::load(z);
    for (std::size_t k = lane_count; k < shape.vertex_stride(); k += lane_count)
      low = min(low, nx * Lanes::load(x + k) + ny * Lanes::load(y + k) + nz * Lanes::load(z + k));
    return low.smallest();
  }

  /// Of every edge of b: direction, normals of the faces left and right of it, one end. The last
  /// group is not filled up: what is worked out from old numbers there is not looked at.
  void gather(const LinkedShape& b, const EdgeList& list) {
    stride_ = PlacedShape<3>::padded(list.size());
    if (packed_.size() < 12 * stride_) packed_.resize(12 * stride_);
    const std::size_t vertex_stride = b.shape.vertex_stride(), face_stride = b.shape.face_stride();
    const double *const x = b.shape.vertices(0), *const n = b.shape.normals(0);
    for (std::size_t j = 0; j < list.size(); ++j) {
      const Topology::Edge edge = b.topology.edges[list[j]];
      double* to = packed_.data() + j;
      for (std::size_t axis = 0; axis < 3; ++axis, to += stride_) {
        const double* const coordinate = x + axis * vertex_stride;
        const double* const component = n + axis * face_stride;
        to[0] = coordinate[edge.to] - coordinate[edge.from];
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
    // Separation = product / root of `squared`, with the sign that turns the normal outward: it is
    // positive, or negative and small. (x + e)^2 <= 1.0001 x^2 + 10001 e^2.
    const double least = best < 0 ? 1.0001 * best * best : 0.0;
    return min(product * inward, product * product - all(least) * squared - all(slack_));
  }

  /// Dot products of v with four columns of three rows.
  [[nodiscard]] Lanes dot(const Vec3& v, std::size_t row, std::size_t j) const {
    const double* const column = packed_.data() + row * stride_ + j;
    return Lanes::all(v[0]) * Lanes::load(column) +
           Lanes::all(v[1]) * Lanes::load(column + stride_) +
           Lanes::all(v[2]) * Lanes::load(column + 2 * stride_);
  }

  /// Takes the pair of edges if it keeps the shapes further apart than the best so far; where that
  /// is a matter of rounding, the pair that touches.
  static void consider(const LinkedShape& a, std::uint16_t i, const LinkedShape& b, std::uint16_t j,
                       Best& best) {
    const Axis found = axis(a, i, b, j, best.separation - (best.is_of_edges ? 0 : rounding));
    const bool is_of_edges = found.is_of_edges();
    const double lead =
        is_of_edges == best.is_of_edges ? 0.0 : (is_of_edges ? -rounding : rounding);
    if (found.separation > best.separation + lead)
      best = {found.separation, i, j, found.normal, is_of_edges};
  }

  std::size_t stride_ = 0;
  double slack_ = 0;  ///< rounding of a triple product of edges, squared [m^6]
  std::vector<double> packed_;
};

}  // namespace voussoir::detail
