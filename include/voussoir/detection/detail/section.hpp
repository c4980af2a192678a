// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/geometry/tangent_basis.hpp>

namespace voussoir::detail {

/// The area over which two crossing edges touch: the section of the overlap by the plane midway
/// between the edges, perpendicular to their common normal. Usually a small rhombus.
class Section {
 public:
  /// @param normal  from a to b
  /// @param out     the section, anticlockwise about the normal; the point midway if it has no area
  void run(const PlacedShape<3>& a, const PlacedShape<3>& b, const Topology& of_a,
           const Topology& of_b, std::uint16_t edge_a, std::uint16_t edge_b, const Vec3& normal,
           std::vector<Vec3>& out) {
    const Vec3 middle = midway(a, of_a.edges[edge_a], b, of_b.edges[edge_b]);
    const TangentBasis<3> basis = tangent_basis(normal);
    const Vec3 first = column(basis, 0), second = column(basis, 1);
    const double size = of_a.diameter + of_b.diameter;
    points_ = {{-size, -size}, {size, -size}, {size, size}, {-size, size}};
    for (const PlacedShape<3>* shape : {&a, &b})
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
  /// The point midway between the closest points of two edges.
  [[nodiscard]] static Vec3 midway(const PlacedShape<3>& a, const Topology::Edge& edge_a,
                                   const PlacedShape<3>& b, const Topology::Edge& edge_b) {
    const Vec3 p = a.vertex(edge_a.from), u = a.vertex(edge_a.to) - p;
    const Vec3 q = b.vertex(edge_b.from), v = b.vertex(edge_b.to) - q;
    const Vec3 both = cross(u, v), offset = q - p;
    const double s =
        std::clamp(dot_product(cross(offset, v), both) / squared_length_of(both), 0.0, 1.0);
    const double t =
        std::clamp(dot_product(cross(offset, u), both) / squared_length_of(both), 0.0, 1.0);
    return p + 0.5 * ((offset + t * v) + s * u);
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
