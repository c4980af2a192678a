// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/segment.hpp>

namespace voussoir {

/// A convex polygon whose faces remember the cut that made them.
///
/// Face k runs from vertex k to vertex k + 1; vertices are anticlockwise.
class ConvexPolygon {
 public:
  static constexpr int dim = 2;

  ConvexPolygon() = default;

  /// @param vertices  anticlockwise, first not repeated [m]
  /// @param cuts      label of each face: for rock, its index in RockMass::cuts; as many as
  /// vertices
  /// @throws InvalidInput  fewer than 3 vertices, a number that is not finite, a repeated vertex, a
  ///                       clockwise or non-convex corner, no area, an outline that crosses
  ///                       itself; the message names the vertex, the value and the rule
  ConvexPolygon(std::vector<Vec2> vertices, std::vector<int> cuts)
      : vertices_(std::move(vertices)), cuts_(std::move(cuts)) {
    check();
  }

  /// The same with faces that no cut made; enough for all but `CutContacts`.
  explicit ConvexPolygon(std::vector<Vec2> vertices)
      : vertices_(std::move(vertices)), cuts_(vertices_.size(), no_cut) {
    check();
  }

  /// Of corners that are convex to roundings, as what was cut from a polygon has; nothing is
  /// checked.
  [[nodiscard]] static ConvexPolygon trusted(std::vector<Vec2> vertices, std::vector<int> cuts) {
    ConvexPolygon made;
    made.vertices_ = std::move(vertices);
    made.cuts_ = std::move(cuts);
    VOUSSOIR_ASSERT(made.size() >= 3 && made.cuts_.size() == made.size(),
                    "a face has a vertex and a label");
    return made;
  }

  [[nodiscard]] std::size_t size() const { return vertices_.size(); }
  [[nodiscard]] const std::vector<Vec2>& vertices() const { return vertices_; }
  [[nodiscard]] const Vec2& vertex(std::size_t k) const { return vertices_[k]; }
  [[nodiscard]] int cut(std::size_t face) const { return cuts_[face]; }
  void set_cut(std::size_t face, int cut) { cuts_[face] = cut; }
  [[nodiscard]] Segment face(std::size_t k) const {
    VOUSSOIR_ASSERT(k < size(), "a face is one of the polygon");
    return {vertices_[k], vertices_[k + 1 == size() ? 0 : k + 1]};
  }
  /// The half space that face k bounds, the polygon inside.
  [[nodiscard]] HalfSpace<2> half_space(std::size_t k) const {
    const Segment side = face(k);
    return left_of(side.start, side.end);
  }

  /// Signed distance of a point from the line of face k, positive outside [m]. As exact as the
  /// point is near, wherever both are.
  [[nodiscard]] double distance(std::size_t k, const Vec2& point) const {
    return dot_product(half_space(k).normal, point - vertices_[k]);
  }

  [[nodiscard]] bool contains(const Vec2& point, double tolerance = 0) const {
    for (std::size_t k = 0; k < size(); ++k)
      if (!(distance(k, point) <= tolerance)) return false;
    return true;
  }

  /// Cuts the polygon by a line into the parts below and above; nothing if the line misses it.
  ///
  /// Both parts get the very same new vertices, bit for bit, so contacts found later from shared
  /// vertices close exactly. A vertex within `tolerance` of the line is taken to lie on it.
  [[nodiscard]] std::optional<std::pair<ConvexPolygon, ConvexPolygon>> split(
      const HalfSpace<2>& line, int cut, double tolerance) const;

  /// Replaces every vertex by `place(vertex)`, which must not move it by more than a rounding, and
  /// drops faces whose ends have become one vertex.
  /// @return  number of faces dropped
  template <class Place>
  std::size_t move_vertices(Place&& place) {
    for (Vec2& vertex : vertices_) vertex = place(vertex);
    const std::size_t before = size();
    for (std::size_t k = size(); k-- > 0;)
      if (size() > 3 && vertices_[k] == vertices_[k + 1 == size() ? 0 : k + 1]) {
        vertices_.erase(vertices_.begin() + static_cast<std::ptrdiff_t>(k));
        cuts_.erase(cuts_.begin() + static_cast<std::ptrdiff_t>(k));
      }
    VOUSSOIR_ASSERT(size() >= 3 && cuts_.size() == size(), "a face has a vertex and a label");
    return before - size();
  }

  /// Longest distance between two vertices [m].
  [[nodiscard]] double diameter() const {
    double squared = 0;
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        squared = std::max(squared, squared_length_of(vertices_[i] - vertices_[j]));
    return std::sqrt(squared);
  }

  /// Length of the outline [m].
  [[nodiscard]] double perimeter() const {
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) sum += face(k).length();
    return sum;
  }

 private:
  void reserve(std::size_t count) {
    vertices_.reserve(count);
    cuts_.reserve(count);
  }
  void append(const Vec2& vertex, int cut) {
    vertices_.push_back(vertex);
    cuts_.push_back(cut);
  }

  void check() const;

  std::vector<Vec2> vertices_;
  std::vector<int> cuts_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE auto ConvexPolygon::split(const HalfSpace<2>& line, int cut, double tolerance) const
    -> std::optional<std::pair<ConvexPolygon, ConvexPolygon>> {
  VOUSSOIR_ASSERT(tolerance >= 0 && detail::is_unit(line.normal), "distances are in metres");
  std::vector<double> distances(size());
  std::size_t below = 0, above = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    const double d = line.distance(vertices_[k]);
    distances[k] = std::abs(d) <= tolerance ? 0.0 : d;
    below += distances[k] < 0;
    above += distances[k] > 0;
  }
  if (below == 0 || above == 0) return std::nullopt;
  std::pair<ConvexPolygon, ConvexPolygon> parts;
  // The line meets the outline twice, in vertices or between them: what is reserved is exact.
  const std::size_t on_line = std::max<std::size_t>(2, size() - below - above);
  parts.first.reserve(below + on_line);
  parts.second.reserve(above + on_line);
  for (std::size_t k = 0; k < size(); ++k) {
    const std::size_t next = k + 1 == size() ? 0 : k + 1;
    const double here = distances[k], there = distances[next];
    if (here <= 0) parts.first.append(vertices_[k], here == 0 && there > 0 ? cut : cuts_[k]);
    if (here >= 0) parts.second.append(vertices_[k], here == 0 && there < 0 ? cut : cuts_[k]);
    if (here * there < 0) {
      const Vec2 crossing =
          vertices_[k] + (here / (here - there)) * (vertices_[next] - vertices_[k]);
      parts.first.append(crossing, here < 0 ? cut : cuts_[k]);
      parts.second.append(crossing, here > 0 ? cut : cuts_[k]);
    }
  }
  VOUSSOIR_ASSERT(parts.first.size() >= 3 && parts.second.size() >= 3, "a part has an area");
  VOUSSOIR_ASSERT(parts.first.size() + parts.second.size() <= size() + 4,
                  "a line meets a convex outline twice");
  return parts;
}

VOUSSOIR_INLINE void ConvexPolygon::check() const {
  const auto fail = [this](std::size_t k, const std::string& rule) {
    throw InvalidInput(message(
        {"convex polygon: vertex ", k, " ", rule, ": it is at ", text_of<2>(vertices_[k]), " m"}));
  };
  if (size() < 3)
    throw InvalidInput(message({"convex polygon: needs at least 3 vertices, has ", size()}));
  if (cuts_.size() != size())
    throw InvalidInput(
        message({"convex polygon: needs one label per face, has ", cuts_.size(), " for ", size()}));
  for (std::size_t k = 0; k < size(); ++k)
    if (!is_finite(vertices_[k])) fail(k, "is not finite");
  double turning = 0, doubled_area = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    doubled_area += cross(vertices_[k] - vertices_[0], vertices_[(k + 1) % size()] - vertices_[0]);
    const std::size_t corner = k + 1 == size() ? 0 : k + 1;
    const Segment in = face(k), out = face(corner);
    if (!(in.length() > 0)) fail(k, "is repeated by the next one");
    const Vec2 u = in.end - in.start, v = out.end - out.start;
    const double turn = elementary::angle_of(cross(u, v), dot_product(u, v));
    if (!(cross(u, v) >= 0))
      fail(corner, message({"is a non-convex or clockwise corner, the outline turns by ",
                            turn * 180 / 3.141592653589793,
                            " degrees where it must turn left, by 0 or more"}));
    turning += turn;
  }
  // Every corner turns left; a star polygon does so too, but turns more than once.
  if (!(doubled_area > 0))
    throw InvalidInput(
        message({"convex polygon: encloses an area of ", 0.5 * doubled_area, " m^2, must be > 0"}));
  if (!(std::abs(turning - 6.283185307179586) <= 1e-6))
    throw InvalidInput(
        message({"convex polygon: the outline crosses itself: it turns by ",
                 turning * 180 / 3.141592653589793, " degrees in all, must be 360"}));
}

#endif

}  // namespace voussoir
