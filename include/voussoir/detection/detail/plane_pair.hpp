// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/lanes.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// The half spaces of two convex shapes in one list, those of a first, seen from a point.
///
/// The room of a half space is what normal . x <= offset leaves at that point: offset - normal . x,
/// positive inside. It is taken once and then changed by small steps, so that an overlap of a
/// nanometre far from the origin loses nothing while the point moves in it. The last group is
/// filled up with half spaces of normal 0 and endless room, which neither sums nor smallest rooms
/// notice.
template <int Dim>
class PlanePair {
 public:
  using Lanes = VectorLanes;

  /// Gathers the half spaces of both shapes, seen from `point`. Allocates only when it has never
  /// seen as many.
  void gather(const PlacedShape<Dim>& a, const PlacedShape<Dim>& b, const Vec<Dim>& point) {
    const std::size_t needed = a.face_stride() + b.face_stride();
    if (stride_ < needed) {
      stride_ = needed;
      data_.resize((Dim + 1) * stride_);
    }
    point_ = point;
    count_a_ = a.face_count;
    count_ = count_a_ + b.face_count;
    VOUSSOIR_ASSERT(a.face_count > Dim && b.face_count > Dim, "shapes are closed");
    append(a, 0);
    append(b, count_a_);
    for (std::size_t k = count_; k < padded_count(); ++k) {
      for (int axis = 0; axis < Dim; ++axis) normals(axis)[k] = 0;
      rooms()[k] = std::numeric_limits<double>::infinity();
    }
  }

  [[nodiscard]] const Vec<Dim>& point() const { return point_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t count_a() const { return count_a_; }
  /// `count` rounded up to whole groups of lanes; groups start at multiples of `lane_count`.
  [[nodiscard]] std::size_t padded_count() const { return PlacedShape<Dim>::padded(count_); }

  [[nodiscard]] Lanes normal(int axis, std::size_t group) const {
    return Lanes::load(normals(axis) + group);
  }
  [[nodiscard]] Lanes room(std::size_t group) const { return Lanes::load(rooms() + group); }
  /// +1 for planes of a, -1 for planes of b.
  [[nodiscard]] Lanes side(std::size_t group) const {
    static_assert(lane_count == 4);
    double sides[lane_count];
    for (std::size_t k = 0; k < lane_count; ++k) sides[k] = group + k < count_a_ ? 1 : -1;
    return Lanes::load(sides);
  }

  [[nodiscard]] Vec<Dim> normal_of(std::size_t plane) const {
    Vec<Dim> n;
    for (int axis = 0; axis < Dim; ++axis) n[axis] = normals(axis)[plane];
    return n;
  }
  [[nodiscard]] double room_of(std::size_t plane) const { return rooms()[plane]; }

  /// normal . direction of a group.
  [[nodiscard]] Lanes along(const Vec<Dim>& direction, std::size_t group) const {
    Lanes sum = normal(0, group) * Lanes::all(direction[0]);
    for (int axis = 1; axis < Dim; ++axis)
      sum = sum + normal(axis, group) * Lanes::all(direction[axis]);
    return sum;
  }

  /// Positive if the point lies strictly inside both shapes.
  [[nodiscard]] double smallest_room() const {
    Lanes least = room(0);
    for (std::size_t group = lane_count; group < padded_count(); group += lane_count)
      least = min(least, room(group));
    return least.smallest();
  }

  /// Goes on by `step`.
  void move(const Vec<Dim>& step) {
    point_ += step;
    for (std::size_t group = 0; group < padded_count(); group += lane_count)
      set_room(group, room(group) - along(step, group));
  }
  /// The same in two parts, for who knows by which fraction the step shrinks each room.
  void move_point(const Vec<Dim>& step) { point_ += step; }
  void shrink_room(std::size_t group, const Lanes& fraction) {
    set_room(group, room(group) * (Lanes::all(1) - fraction));
  }

  /// Moves every half space outwards by `distance` [m].
  void swell(double distance) {
    for (std::size_t k = 0; k < count_; ++k) rooms()[k] += distance;
  }

 private:
  [[nodiscard]] double* normals(int axis) {
    return data_.data() + static_cast<std::size_t>(axis) * stride_;
  }
  [[nodiscard]] const double* normals(int axis) const {
    return data_.data() + static_cast<std::size_t>(axis) * stride_;
  }
  [[nodiscard]] double* rooms() { return normals(Dim); }
  [[nodiscard]] const double* rooms() const { return normals(Dim); }

  void set_room(std::size_t group, const Lanes& room) { room.store(rooms() + group); }

  void append(const PlacedShape<Dim>& shape, std::size_t at) {
    for (std::size_t k = 0; k < shape.face_stride(); k += lane_count) {
      Lanes room = Lanes::load(shape.offsets() + k);
      for (int axis = 0; axis < Dim; ++axis) {
        const Lanes n = Lanes::load(shape.normals(axis) + k);
        room = room - n * Lanes::all(point_[axis]);
        n.store(normals(axis) + at + k);
      }
      room.store(rooms() + at + k);
    }
  }

  std::vector<double> data_;
  Vec<Dim> point_ = zeros<Vec<Dim>>();
  std::size_t stride_ = 0, count_a_ = 0, count_ = 0;
};

}  // namespace voussoir::detail
