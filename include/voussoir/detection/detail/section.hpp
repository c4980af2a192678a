// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/edge_pairs.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/geometry/tangent_basis.hpp>

namespace voussoir::detail {

/// The area over which two crossing edges touch: the section of the overlap by the plane that is
/// perpendicular to their common normal, midway between its lowest and its highest point. Usually a
/// small rhombus, midway between the edges.
///
/// The overlap lies between the two edges, but need not reach them: deep in a thin block the other
/// one's edge is out on its far side. So the plane midway between the edges may miss the overlap;
/// the one midway in the overlap has an area as long as there is a volume.
class Section {
 public:
  /// @param normal  from a to b
  /// @param out     the section, anticlockwise about the normal; the point midway if it has no area
  void run(const LinkedShape& a, std::uint16_t edge_a, const LinkedShape& b, std::uint16_t edge_b,
           const Vec3& normal, std::vector<Vec3>& out) {
    const Vec3 middle = inside_overlap(a, edge_a, b, edge_b, normal);
    const TangentBasis<3> basis = tangent_basis(normal);
    const Vec3 first = column(basis, 0), second = column(basis, 1);
    const double size = a.topology.diameter + b.topology.diameter;
    points_ = {{-size, -size}, {size, -size}, {size, size}, {-size, size}};
    for (const PlacedShape<3>* shape : {&a.shape, &b.shape})
      for (std::size_t face = 0; face < shape->face_count; ++face) {
        const Vec3 side = shape->normal(face);
        const Vec2 slope(dot_product(side, first), dot_product(side, second));
        keep(slope, shape->offset(face) - dot_product(side, middle));
      }
    area_ = 0;
    for (std::size_t k = 2; k < points_.size(); ++k)
      area_ += 0.5 * cross(points_[k - 1] - points_[0], points_[k] - points_[0]);
    if (!(area_ > 0)) {
      area_ = 0;
      out.assign(1, middle);
      return;
    }
    out.clear();
    for (const Vec2& p : points_) out.push_back(middle + p.x() * first + p.y() * second);
  }

  [[nodiscard]] double area() const { return area_; }  ///< [m^2]

 private:
  /// Heights over a point.
  struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -low;  ///< [m]
  };

  /// The point of the line through the closest points of two edges that is midway in the overlap.
  [[nodiscard]] static Vec3 inside_overlap(const LinkedShape& a, std::uint16_t edge_a,
                                           const LinkedShape& b, std::uint16_t edge_b,
                                           const Vec3& normal) {
    const auto [on_a, on_b] =
        closest(a.shape, a.topology.edges[edge_a], b.shape, b.topology.edges[edge_b]);
    Vec3 middle = on_a + 0.5 * (on_b - on_a);
    const double half = 0.5 * dot_product(normal, on_a - on_b);
    // Where each edge is in the other shape, the overlap goes from one to the other.
    if (!(half > 0) || (contains(b.shape, on_a) && contains(a.shape, on_b))) return middle;
    Span span;
    widen(a, b.shape, normal, middle, span);
    widen(b, a.shape, normal, middle, span);
    if (!(span.low <= span.high)) return middle;
    return middle + 0.5 * (std::max(span.low, -half) + std::min(span.high, half)) * normal;
  }

  [[nodiscard]] static bool contains(const PlacedShape<3>& shape, const Vec3& x) {
    for (std::size_t face = 0; face < shape.face_count; ++face)
      if (dot_product(shape.normal(face), x) > shape.offset(face)) return false;
    return true;
  }

  /// Takes in what of the edges of one shape lies in the other: the corners of the overlap.
  static void widen(const LinkedShape& of, const PlacedShape<3>& in, const Vec3& normal,
                    const Vec3& origin, Span& span) {
    for (const Topology::Edge& edge : of.topology.edges) {
      const Vec3 from = of.shape.vertex(edge.from) - origin, to = of.shape.vertex(edge.to) - origin;
      double begin = 0, end = 1;
      for (std::size_t face = 0; face < in.face_count && begin <= end; ++face) {
        const Vec3 side = in.normal(face);
        const double room = in.offset(face) - dot_product(side, origin);
        const double at_from = dot_product(side, from) - room, at_to = dot_product(side, to) - room;
        if (at_from > 0 && at_to > 0) end = -1;
        if (at_from > 0 && at_to <= 0) begin = std::max(begin, at_from / (at_from - at_to));
        if (at_from <= 0 && at_to > 0) end = std::min(end, at_from / (at_from - at_to));
      }
      if (!(begin <= end)) continue;
      const double low = dot_product(normal, from), rise = dot_product(normal, to) - low;
      for (const double t : {begin, end}) {
        span.low = std::min(span.low, low + t * rise);
        span.high = std::max(span.high, low + t * rise);
      }
    }
  }

  /// The closest points of two edges, a's and b's.
  [[nodiscard]] static std::pair<Vec3, Vec3> closest(const PlacedShape<3>& a,
                                                     const Topology::Edge& edge_a,
                                                     const PlacedShape<3>& b,
                                                     const Topology::Edge& edge_b) {
    const Vec3 p = a.vertex(edge_a.from), u = a.vertex(edge_a.to) - p;
    const Vec3 q = b.vertex(edge_b.from), v = b.vertex(edge_b.to) - q;
    const Vec3 both = cross(u, v), offset = q - p;
    const double s =
        std::clamp(dot_product(cross(offset, v), both) / squared_length_of(both), 0.0, 1.0);
    const double t =
        std::clamp(dot_product(cross(offset, u), both) / squared_length_of(both), 0.0, 1.0);
    return {p + s * u, q + t * v};
  }

  /// Keeps slope . x <= offset.
  void keep(const Vec2& slope, double offset) {
    spare_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec2 &here = points_[k], &next = points_[k + 1 == points_.size() ? 0 : k + 1];
      const double d = dot_product(slope, here) - offset, e = dot_product(slope, next) - offset;
      if (d <= 0) spare_.push_back(here);
      if ((d < 0 && e > 0) || (d > 0 && e < 0))
        spare_.emplace_back(here + d / (d - e) * (next - here));
    }
    points_.swap(spare_);
  }

  double area_ = 0;
  std::vector<Vec2> points_, spare_;
};

}  // namespace voussoir::detail
