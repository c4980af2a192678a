// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/segment.hpp>

namespace voussoir {

/// The outline of an opening: any polygon that does not cross itself, stored anticlockwise.
class SimplePolygon {
 public:
  /// @param vertices  in either direction; the first must not be repeated at the end [m]
  /// @throws InvalidInput  fewer than 3 vertices, not finite, repeated vertex, edges that cross or
  ///                       touch; the message names the vertex or the two edges
  /// @cost  O(n^2) for the crossing test
  explicit SimplePolygon(std::vector<Vec2> vertices);

  [[nodiscard]] std::size_t size() const { return vertices_.size(); }
  [[nodiscard]] const std::vector<Vec2>& vertices() const { return vertices_; }
  [[nodiscard]] Segment edge(std::size_t k) const {
    return {vertices_[k], vertices_[(k + 1) % size()]};
  }
  /// Positive once constructed [m^2].
  [[nodiscard]] double area() const {
    return mass_properties({vertices_.data(), vertices_.size()}).measure;
  }
  [[nodiscard]] double perimeter() const {
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) sum += edge(k).length();
    return sum;
  }

  /// Crossing-number test; a point on the outline may count either way.
  [[nodiscard]] bool contains(const Vec2& p) const {
    bool inside = false;
    for (std::size_t k = 0; k < size(); ++k) {
      const auto [a, b] = edge(k);
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
  }

  /// Parameter along `ray` (0 start, 1 end) of its last crossing with the outline, or nothing.
  [[nodiscard]] std::optional<double> last_crossing(const Segment& ray) const;

 private:
  [[nodiscard]] bool edges_meet(std::size_t i, std::size_t j) const;

  std::vector<Vec2> vertices_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE SimplePolygon::SimplePolygon(std::vector<Vec2> vertices)
    : vertices_(std::move(vertices)) {
  if (size() < 3) throw InvalidInput("outline: needs at least 3 vertices");
  for (std::size_t k = 0; k < size(); ++k)
    if (!is_finite(vertices_[k]))
      throw InvalidInput(message({"outline: vertex ", k, " is not finite"}));
  for (std::size_t k = 0; k < size(); ++k) {
    if (!(edge(k).length() > 0))
      throw InvalidInput(message({"outline: vertex ", k, " is repeated"}));
  }
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t j = i + 1; j < size(); ++j)
      if (edges_meet(i, j))
        throw InvalidInput(message({"outline: edges ", i, " and ", j, " cross or touch"}));
  if (area() < 0) std::reverse(vertices_.begin(), vertices_.end());
  VOUSSOIR_ASSERT(area() >= 0, "an outline is anticlockwise");
}

VOUSSOIR_INLINE auto SimplePolygon::last_crossing(const Segment& ray) const
    -> std::optional<double> {
  std::optional<double> last;
  const Vec2 d = ray.end - ray.start;
  for (std::size_t k = 0; k < size(); ++k) {
    const auto [a, b] = edge(k);
    const double det = cross(d, b - a);
    if (det == 0) continue;
    const double t = cross(a - ray.start, b - a) / det, s = cross(a - ray.start, d) / det;
    if (t >= 0 && t <= 1 && s >= -1e-12 && s <= 1 + 1e-12) last = std::max(last.value_or(t), t);
  }
  return last;
}

VOUSSOIR_INLINE bool SimplePolygon::edges_meet(std::size_t i, std::size_t j) const {
  const auto [a, b] = edge(i);
  const auto [c, d] = edge(j);
  const bool follows = j == i + 1, closes = i == 0 && j + 1 == size();
  if (follows || closes) {
    // Neighbours share a corner; they overlap if the second folds back onto the first.
    const Vec2 u = follows ? Vec2(b - a) : Vec2(d - c), v = follows ? Vec2(d - c) : Vec2(b - a);
    return std::abs(cross(u, v)) <= 1e-12 * length_of(u) * length_of(v) && dot_product(u, v) < 0;
  }
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) { return cross(q - p, r - p); };
  const auto between = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return dot_product(r - p, r - q) <= 0;
  };
  const double s1 = side(a, b, c), s2 = side(a, b, d), s3 = side(c, d, a), s4 = side(c, d, b);
  if (((s1 > 0 && s2 < 0) || (s1 < 0 && s2 > 0)) && ((s3 > 0 && s4 < 0) || (s3 < 0 && s4 > 0)))
    return true;
  return (s1 == 0 && between(a, b, c)) || (s2 == 0 && between(a, b, d)) ||
         (s3 == 0 && between(c, d, a)) || (s4 == 0 && between(c, d, b));
}

#endif

}  // namespace voussoir
