// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

namespace voussoir::detail {

/// The least box with sides along the axes that has all points in it.
template <int Dim>
[[nodiscard]] std::pair<Vec<Dim>, Vec<Dim>> bounding_box(const std::vector<Vec<Dim>>& points) {
  Vec<Dim> low = points.front(), high = low;
  for (const Vec<Dim>& p : points) {
    low = smaller_of(low, p);
    high = larger_of(high, p);
  }
  return {low, high};
}

/// The box around an opening, along its own axes: what lies beside it need not be looked at.
class OpeningBox {
 public:
  /// @param margin  by which the box is larger [m];  the opening outlives the box
  OpeningBox(const SimplePolygon& outline, double margin) {
    const auto [low, high] = bounding_box<2>(outline.vertices());
    low_ = {low.x() - margin, low.y() - margin, 0};
    high_ = {high.x() + margin, high.y() + margin, 0};
  }
  OpeningBox(const PrismaticOpening& opening, double margin) : axis_(&opening.axis()) {
    const auto [low, high] = opening.local_box();
    low_ = shifted_by(low, -margin);
    high_ = shifted_by(high, margin);
  }

  /// True if no point of the convex shape can lie in the opening. A shape that is seen from a
  /// turned axis is judged by the box around it there.
  template <class Shape>
  [[nodiscard]] bool is_apart_from(const Shape& shape) const {
    if constexpr (Shape::dim == 2) {
      const auto [a, b] = bounding_box<2>(shape.vertices());
      return high_.x() < a.x() || high_.y() < a.y() || b.x() < low_.x() || b.y() < low_.y();
    } else {
      Vec3 a = axis_->local(shape.vertices().front()), b = a;
      for (const Vec3& v : shape.vertices()) {
        const Vec3 seen = axis_->local(v);
        a = smaller_of(a, seen);
        b = larger_of(b, seen);
      }
      return any_less(high_, a) || any_less(b, low_);
    }
  }

 private:
  const TunnelAxis* axis_ = nullptr;
  Vec3 low_ = zeros<Vec3>(), high_ = zeros<Vec3>();
};

}  // namespace voussoir::detail
