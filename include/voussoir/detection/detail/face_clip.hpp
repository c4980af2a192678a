// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// Clips a face of one polyhedron to the prism over a face of another.
///
/// The prism stands upright on the reference face; it is open below and ends at a height above.
/// Work is done in the plane of the face: u along its first edge and v across, both in units of
/// that edge's length, so that no square root is needed; h is the height [m].
class FaceClip {
 public:
  /// @param p, face     the reference face
  /// @param q, other    the face of q to be clipped
  /// @param top         what of it lies higher is cut off [m]
  void run(const PlacedShape<3>& p, std::span<const std::uint16_t> face, const Vec3& normal,
           const PlacedShape<3>& q, std::span<const std::uint16_t> other, double top) {
    VOUSSOIR_ASSERT(face.size() >= 3 && other.size() >= 3, "faces have an area");
    VOUSSOIR_ASSERT(is_unit(normal), "heights are in metres");
    normal_ = normal;
    origin_ = p.vertex(face[0]);
    along_ = p.vertex(face[1]) - origin_;
    // A side of 1e-9 m is known to 1e-7: made upright to the normal, or points would leave the
    // face.
    along_ -= dot_product(along_, normal) * normal;
    across_ = cross(normal, along_);
    scale_ = 1 / squared_length_of(along_);
    grow(face.size(), face.size() + other.size() + 3);
    // Seen along the reference normal the other face runs clockwise: turn it round.
    count_ = other.size();
    for (std::size_t k = 0; k < count_; ++k) points_[k] = in_plane(q.vertex(other[count_ - 1 - k]));
    for (std::size_t k = 0; k < side_count_; ++k) outline_[k] = in_plane(p.vertex(face[k]));
    for (std::size_t k = 0; k < side_count_; ++k) {
      const Point &from = outline_[k], &to = outline_[k + 1 == side_count_ ? 0 : k + 1];
      const double du = to.u - from.u, dv = to.v - from.v;
      keep([&](const Point& x) { return du * (x.v - from.v) - dv * (x.u - from.u); });
    }
    keep([top](const Point& x) { return top - x.h; });
  }

  [[nodiscard]] std::size_t size() const { return count_; }

  /// Area of the polygon as seen along the reference normal [m^2].
  [[nodiscard]] double area() const {
    double doubled = 0;
    for (std::size_t k = 2; k < count_; ++k) {
      const Point &o = points_[0], &a = points_[k - 1], &b = points_[k];
      doubled += (a.u - o.u) * (b.v - o.v) - (a.v - o.v) * (b.u - o.u);
    }
    // u and v are lengths along vectors as long as the first edge: an area is so many times too
    // big.
    return 0.5 * doubled * scale_;
  }

  /// Half way from the mean of the polygon's corners to the reference face: inside both shapes
  /// unless one of them tapers away from there. @pre the polygon is not empty
  [[nodiscard]] Vec3 middle() const {
    VOUSSOIR_ASSERT(count_ > 0, "what has a middle is not empty");
    Point sum{0, 0, 0};
    for (std::size_t k = 0; k < count_; ++k)
      sum = {sum.u + points_[k].u, sum.v + points_[k].v, sum.h + points_[k].h};
    const double share = 1 / static_cast<double>(count_);
    return origin_ + (share * sum.u * scale_) * along_ + (share * sum.v * scale_) * across_ +
           (0.5 * share * sum.h) * normal_;
  }

  /// Height of the polygon's lowest point over the reference face [m]; infinity if it is empty.
  [[nodiscard]] double lowest() const {
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count_; ++k) low = std::min(low, points_[k].h);
    return low;
  }

  /// Square of a length that no two points of the polygon are further apart than [m^2].
  [[nodiscard]] double squared_extent() const {
    if (count_ == 0) return 0;
    Point low = points_[0], high = points_[0];
    for (std::size_t k = 1; k < count_; ++k) {
      const Point& x = points_[k];
      low = {std::min(low.u, x.u), std::min(low.v, x.v), std::min(low.h, x.h)};
      high = {std::max(high.u, x.u), std::max(high.v, x.v), std::max(high.h, x.h)};
    }
    const double u = high.u - low.u, v = high.v - low.v, h = high.h - low.h;
    return (u * u + v * v) * scale_ + h * h;
  }

  /// Distance from a point over the reference face to its nearest side [m]; negative beside it.
  [[nodiscard]] double room_around(const Vec3& x) const {
    const Point point = in_plane(x);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < side_count_; ++k) {
      const Point &from = outline_[k], &to = outline_[k + 1 == side_count_ ? 0 : k + 1];
      const double du = to.u - from.u, dv = to.v - from.v;
      const double side = du * (point.v - from.v) - dv * (point.u - from.u);
      if (side < 0) return -1;
      least = std::min(least, side * side / (du * du + dv * dv));
    }
    return std::sqrt(least * scale_);
  }

  /// Sides of the reference face and of the other, each by the place in its loop where it starts.
  struct Sides {
    std::size_t reference, other;
  };
  /// Those that run nearest to the deepest point of the polygon. If it is no corner of either face
  /// they cross there. @pre the polygon is not empty
  [[nodiscard]] Sides deepest_crossing(const PlacedShape<3>& q,
                                       std::span<const std::uint16_t> other) const {
    Point deepest = points_[0];
    for (std::size_t k = 1; k < count_; ++k)
      deepest = points_[k].h < deepest.h ? points_[k] : deepest;
    const auto nearest = [&deepest](std::size_t count, auto&& corner) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t found = 0;
      Point from = corner(0);
      for (std::size_t k = 0; k < count; ++k) {
        const Point to = corner(k + 1 == count ? 0 : k + 1);
        const double du = to.u - from.u, dv = to.v - from.v;
        const double side = du * (deepest.v - from.v) - dv * (deepest.u - from.u);
        const double squared = side * side / (du * du + dv * dv);
        found = squared < least ? k : found;
        least = std::min(least, squared);
        from = to;
      }
      return found;
    };
    return {nearest(side_count_, [&](std::size_t k) { return outline_[k]; }),
            nearest(other.size(), [&](std::size_t k) { return in_plane(q.vertex(other[k])); })};
  }

  /// The polygon, anticlockwise about the reference normal, or the other way round.
  void write(std::vector<Vec3>& out, bool reversed) const {
    out.resize(count_);
    for (std::size_t k = 0; k < count_; ++k) {
      const Point& x = points_[reversed ? count_ - 1 - k : k];
      out[k] = origin_ + (x.u * scale_) * along_ + (x.v * scale_) * across_ + x.h * normal_;
    }
  }

 private:
  struct Point {
    double u, v, h;
  };

  [[nodiscard]] Point in_plane(const Vec3& x) const {
    const Vec3 r = x - origin_;
    return {dot_product(r, along_), dot_product(r, across_), dot_product(r, normal_)};
  }

  void grow(std::size_t sides, std::size_t size) {
    side_count_ = sides;
    if (outline_.size() < sides) outline_.resize(sides);
    make_room(size);
  }
  void make_room(std::size_t size) {
    if (points_.size() >= size) return;
    points_.resize(size);
    spare_.resize(size);
    sides_.resize(size);
  }

  /// Keeps the part of the polygon where `side`, linear, is not negative.
  template <class Side>
  void keep(Side&& side) {
    const std::size_t count = count_;
    // A line cuts a convex polygon twice, but roundings may have several corners on the line lie on
    // either side by turns.
    make_room(2 * count);
    const Point* const from = points_.data();
    double* const sides = sides_.data();
    double lowest = 0;
    for (std::size_t k = 0; k < count; ++k) {
      sides[k] = side(from[k]);
      lowest = std::min(lowest, sides[k]);
    }
    if (!(lowest < 0)) return;
    Point* to = spare_.data();
    double there = sides[count - 1];
    Point a = from[count - 1];
    for (std::size_t k = 0; k < count; ++k) {
      const double here = sides[k];
      const Point b = from[k];
      if ((here < 0) != (there < 0)) {
        const double t = there / (there - here);
        *to++ = {a.u + t * (b.u - a.u), a.v + t * (b.v - a.v), a.h + t * (b.h - a.h)};
      }
      *to = b;
      to += here < 0 ? 0 : 1;
      a = b;
      there = here;
    }
    count_ = static_cast<std::size_t>(to - spare_.data());
    VOUSSOIR_ASSERT(count_ <= spare_.size(), "there is room for every corner");
    points_.swap(spare_);
  }

  Vec3 normal_, origin_, along_, across_;
  double scale_ = 1;
  std::size_t count_ = 0, side_count_ = 0;
  std::vector<Point> outline_;  ///< of the reference face
  std::vector<Point> points_, spare_;
  std::vector<double> sides_;
};

}  // namespace voussoir::detail
