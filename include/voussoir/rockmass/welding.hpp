// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// Gives vertices that lie within `tolerance` of each other the very same coordinates.
///
/// Slicing already shares vertices between the two sides of a cut. Where one joint crosses another
/// joint in two different blocks, though, the two crossing points are computed from different edges
/// and differ in the last digit; the stress on that digit would spoil the in-situ balance.
template <int Dim>
class VertexWelder {
 public:
  explicit VertexWelder(double tolerance) : tolerance_(tolerance), cell_(8 * tolerance) {
    VOUSSOIR_ASSERT(tolerance > 0, "cells have a size");
  }

  /// A vertex seen within the tolerance of `p`: `p` itself if there was none.
  Vec<Dim> operator()(const Vec<Dim>& p) {
    if (2 * (points_.size() + 1) > slots_.size()) make_room(points_.size() + 1);
    Cell low, high, here;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const double x = p[static_cast<int>(axis)];
      low[axis] = index(x - tolerance_);
      high[axis] = index(x + tolerance_);
      here[axis] = index(x);
    }
    for (Cell cell = low;;) {
      for (std::size_t at = slot_of(cell); slots_[at] >= 0; at = next(at)) {
        const Vec<Dim>& seen = points_[static_cast<std::size_t>(slots_[at])];
        if ((seen - p).norm() <= tolerance_) return seen;
      }
      // The next of the cells that the tolerance reaches: nearly always there is but one.
      std::size_t axis = 0;
      while (axis < Dim && cell[axis] == high[axis]) {
        cell[axis] = low[axis];
        ++axis;
      }
      if (axis == Dim) break;
      ++cell[axis];
    }
    enter(slot_of(here));
    points_.push_back(p);
    VOUSSOIR_ASSERT(2 * points_.size() <= slots_.size(), "half of the slots are free");
    return p;
  }

  /// Makes room for so many vertices.
  void reserve(std::size_t vertices) {
    if (2 * vertices > slots_.size()) make_room(vertices);
  }

 private:
  using Cell = std::array<std::int64_t, Dim>;

  [[nodiscard]] std::int64_t index(double x) const {
    return static_cast<std::int64_t>(std::floor(x / cell_));
  }
  /// Where the search for the points of a cell begins; it ends at the first slot without one.
  [[nodiscard]] std::size_t slot_of(const Cell& cell) const {
    std::uint64_t mixed = 0;
    for (const std::int64_t i : cell)
      mixed = (mixed ^ (mixed >> 32) ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(mixed >> 20) & (slots_.size() - 1);
  }
  [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (slots_.size() - 1); }
  /// Enters the point that comes next.
  void enter(std::size_t at) {
    while (slots_[at] >= 0) at = next(at);
    slots_[at] = static_cast<std::int32_t>(points_.size());
  }
  /// At least twice as many slots as points.
  void make_room(std::size_t points) {
    std::size_t size = 64;
    while (size < 2 * points) size *= 2;
    slots_.assign(size, -1);
    std::vector<Vec<Dim>> seen;
    seen.swap(points_);
    points_.reserve(size / 2);
    for (const Vec<Dim>& p : seen) {
      Cell here;
      for (std::size_t axis = 0; axis < Dim; ++axis) here[axis] = index(p[static_cast<int>(axis)]);
      enter(slot_of(here));
      points_.push_back(p);
    }
  }

  double tolerance_, cell_;
  std::vector<std::int32_t> slots_;  ///< hashed by cell: numbers of points, -1: none
  std::vector<Vec<Dim>> points_;     ///< in the order in which they were seen
};
using Welder = VertexWelder<2>;

/// Welds all vertices of some bodies.
/// @throws Stopped  with the bodies partly welded
/// @return  faces that vanished because their vertices became one (or, in 3-D, two)
template <class Geometry>
std::size_t weld(std::vector<Body<Geometry>>& bodies, double tolerance, StopCheck& stop) {
  VertexWelder<Geometry::dim> welder(tolerance);
  std::size_t vertices = 0, vanished = 0;
  for (const auto& body : bodies)
    for (const auto& part : body.parts) vertices += part.vertices().size();
  welder.reserve(vertices);
  for (auto& body : bodies) {
    stop();
    for (auto& part : body.parts) vanished += part.move_vertices(welder);
  }
  return vanished;
}
template <class Geometry>
std::size_t weld(std::vector<Body<Geometry>>& bodies, double tolerance) {
  StopCheck never;
  return weld(bodies, tolerance, never);
}

}  // namespace voussoir
