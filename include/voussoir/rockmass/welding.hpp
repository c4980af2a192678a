// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>
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
  explicit VertexWelder(double tolerance) : tolerance_(tolerance), cell_(8 * tolerance) {}

  /// The first vertex seen within the tolerance of `p`: `p` itself if there was none.
  Vec<Dim> operator()(const Vec<Dim>& p) {
    Cell low, high, here;
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const double x = p[static_cast<int>(axis)];
      low[axis] = index(x - tolerance_);
      high[axis] = index(x + tolerance_);
      here[axis] = index(x);
    }
    for (Cell cell = low;;) {
      const auto [first, last] = seen_.equal_range(key(cell));
      for (auto it = first; it != last; ++it)
        if ((it->second - p).norm() <= tolerance_) return it->second;
      // The next of the cells that the tolerance reaches: nearly always there is but one.
      std::size_t axis = 0;
      while (axis < Dim && cell[axis] == high[axis]) {
        cell[axis] = low[axis];
        ++axis;
      }
      if (axis == Dim) break;
      ++cell[axis];
    }
    seen_.emplace(key(here), p);
    return p;
  }

  /// Makes room for so many vertices.
  void reserve(std::size_t vertices) { seen_.reserve(vertices); }

 private:
  using Cell = std::array<std::int64_t, Dim>;

  [[nodiscard]] std::int64_t index(double x) const {
    return static_cast<std::int64_t>(std::floor(x / cell_));
  }
  [[nodiscard]] static std::uint64_t key(const Cell& cell) {
    std::uint64_t mixed = 0;
    for (const std::int64_t i : cell)
      mixed = mixed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(i);
    return mixed;
  }
  double tolerance_, cell_;
  std::unordered_multimap<std::uint64_t, Vec<Dim>> seen_;
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
  StopCheck never{Progress()};
  return weld(bodies, tolerance, never);
}

}  // namespace voussoir
