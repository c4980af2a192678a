// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>

namespace voussoir {

/// Gives vertices that lie within `tolerance` of each other the very same coordinates.
///
/// Slicing already shares vertices between the two sides of a cut. Where one joint crosses another
/// joint in two different blocks, though, the two crossing points are computed from different edges
/// and differ in the last digit; the stress on that digit would spoil the in-situ balance.
class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance), cell_(8 * tolerance) {}

  /// The first vertex seen within the tolerance of `p`: `p` itself if there was none.
  Vec2 operator()(const Vec2& p) {
    const auto column = [this](double x) {
      return static_cast<std::int64_t>(std::floor(x / cell_));
    };
    for (std::int64_t i = column(p.x() - tolerance_); i <= column(p.x() + tolerance_); ++i)
      for (std::int64_t j = column(p.y() - tolerance_); j <= column(p.y() + tolerance_); ++j) {
        const auto [first, last] = seen_.equal_range(key(i, j));
        for (auto it = first; it != last; ++it)
          if ((it->second - p).norm() <= tolerance_) return it->second;
      }
    seen_.emplace(key(column(p.x()), column(p.y())), p);
    return p;
  }

  /// Makes room for so many vertices.
  void reserve(std::size_t vertices) { seen_.reserve(vertices); }

 private:
  [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(j);
  }
  double tolerance_, cell_;
  std::unordered_multimap<std::uint64_t, Vec2> seen_;
};

/// Welds all vertices of some bodies.
/// @return  faces that vanished because their two ends were one vertex
template <class Bodies>
std::size_t weld(Bodies& bodies, double tolerance) {
  Welder welder(tolerance);
  std::size_t vertices = 0, vanished = 0;
  for (const auto& body : bodies)
    for (const auto& part : body.parts) vertices += part.size();
  welder.reserve(vertices);
  for (auto& body : bodies)
    for (auto& part : body.parts) vanished += part.move_vertices(welder);
  return vanished;
}

}  // namespace voussoir
