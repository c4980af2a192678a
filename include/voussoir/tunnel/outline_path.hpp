// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

namespace voussoir {

/// From a corner of more than this on an outline is no polygon that stands for a smooth curve: a
/// circle of 12 facets, the fewest, turns by as much at every vertex [rad].
inline constexpr double largest_smooth_turn = std::numbers::pi / 6;

namespace detail {

/// A part of an outline, anticlockwise; `to` may lie behind vertex 0, a round further.
struct OutlineRun {
  double from, to;  ///< from vertex 0 along the outline [m], 0 <= from < perimeter, from < to
};

/// Places on an outline by their distance from vertex 0 along it, anticlockwise [m].
class OutlinePath {
 public:
  /// Outlives not the polygon.
  explicit OutlinePath(const SimplePolygon& outline) : outline_(&outline), starts_{0} {
    for (std::size_t e = 0; e < outline.size(); ++e)
      starts_.push_back(starts_.back() + outline.edge(e).length());
  }
  [[nodiscard]] std::size_t size() const { return outline_->size(); }
  [[nodiscard]] double perimeter() const { return starts_.back(); }
  /// Of a vertex; behind the last of them the perimeter.
  [[nodiscard]] double start(std::size_t vertex) const { return starts_[vertex]; }
  /// Places closer than this are one [m].
  [[nodiscard]] double near() const { return 1e-9 * perimeter(); }
  /// In the first round, 0 <= s < perimeter.
  [[nodiscard]] double in_round(double s) const {
    s = std::fmod(s, perimeter());
    return s < 0 ? s + perimeter() : s;
  }
  [[nodiscard]] Vec2 at(double s) const {
    s = in_round(s);
    for (std::size_t e = 0; e < size(); ++e) {
      const Segment edge = outline_->edge(e);
      if (s <= edge.length() || e + 1 == size()) return edge.at(s / edge.length());
      s -= edge.length();
    }
    return outline_->vertices().front();
  }
  [[nodiscard]] const SimplePolygon& outline() const { return *outline_; }
  /// Whether two places are one, a round apart or not.
  [[nodiscard]] bool is_near(double s, double t) const {
    const double apart = in_round(s - t);
    return std::min(apart, perimeter() - apart) <= near();
  }

 private:
  const SimplePolygon* outline_;
  std::vector<double> starts_;
};

/// The corners of an outline: vertices at which its direction over `reach` before and behind
/// differs by more than `largest_smooth_turn`; of several within twice the reach the sharpest, or
/// all that are as sharp as this. So neither the facets of a curve nor the roughness of a wall that
/// was scanned make corners, and the mirror image has the same.
///
/// @param reach  [m], > 0: half of what a node of a lining stands for
/// @return  their places, rising
/// @cost    vertices^2
[[nodiscard]] VOUSSOIR_INLINE std::vector<double> corners_of(const OutlinePath& path, double reach);

/// The floor of an outline: what round its lowest edge is flatter than 45 degrees; none where
/// nothing is. Between corners it goes from corner to corner, of a circle it is the lowest quarter.
[[nodiscard]] VOUSSOIR_INLINE std::optional<OutlineRun> floor_of(const OutlinePath& path);
/// What round its highest edge is flatter than 45 degrees.
[[nodiscard]] VOUSSOIR_INLINE std::optional<OutlineRun> flat_roof_of(const OutlinePath& path);
/// The roof of an outline, from springing to springing: what round its highest edge leads from
/// right to left, as far as a corner behind which the outline is steeper than 45 degrees.
[[nodiscard]] VOUSSOIR_INLINE std::optional<OutlineRun> roof_of(const OutlinePath& path);

}  // namespace detail

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::vector<double> corners_of(const OutlinePath& path, double reach) {
  std::vector<double> turns(path.size());
  for (std::size_t v = 0; v < path.size(); ++v) {
    const double s = path.start(v);
    const Vec2 here = path.outline().vertices()[v];
    const Vec2 before = here - path.at(s - reach), after = path.at(s + reach) - here;
    turns[v] = std::abs(elementary::angle_of(cross(before, after), dot_product(before, after)));
  }
  std::vector<double> corners;
  for (std::size_t v = 0; v < path.size(); ++v) {
    bool is_corner = turns[v] > largest_smooth_turn + 1e-6;
    for (std::size_t w = 0; is_corner && w < path.size(); ++w) {
      const double apart = path.in_round(path.start(w) - path.start(v));
      is_corner = std::min(apart, path.perimeter() - apart) >= 2 * reach ||
                  turns[w] <= turns[v] * (1 + 1e-6);
    }
    if (is_corner) corners.push_back(path.start(v));
  }
  return corners;
}

/// The edges round one that hold a condition.
/// @param is_in  is_in(edge);  @param goes_on  goes_on(edge, the next one to the first): whether
/// the run does
template <class IsIn, class GoesOn>
[[nodiscard]] std::optional<OutlineRun> run_of_edges(const OutlinePath& path, bool is_lowest,
                                                     IsIn&& is_in, GoesOn&& goes_on) {
  const std::size_t count = path.size();
  const auto edge = [&](std::size_t e) { return path.outline().edge(e); };
  std::optional<std::size_t> seed;
  for (std::size_t e = 0; e < count; ++e) {
    if (!is_in(edge(e))) continue;
    const double above = seed ? edge(e).centre().y() - edge(*seed).centre().y() : 0;
    if (!seed || (is_lowest ? above < -path.near() : above > path.near())) seed = e;
  }
  if (!seed) return std::nullopt;
  std::size_t first = *seed, last = *seed, size = 1;
  const auto grows = [&](std::size_t from, std::size_t next) {
    const bool grown = size < count && is_in(edge(next)) && goes_on(edge(from), edge(next));
    size += grown ? 1 : 0;
    return grown;
  };
  while (grows(first, (first + count - 1) % count)) first = (first + count - 1) % count;
  while (grows(last, (last + 1) % count)) last = (last + 1) % count;
  if (size == count) return std::nullopt;
  const double from = path.start(first), to = path.start(last) + edge(last).length();
  return OutlineRun{from, last < first ? to + path.perimeter() : to};
}

[[nodiscard]] inline bool is_flat(const Segment& edge) {
  const Vec2 along = edge.end - edge.start;
  return std::abs(along.y()) <= std::abs(along.x()) * (1 + 1e-9);
}

VOUSSOIR_INLINE std::optional<OutlineRun> floor_of(const OutlinePath& path) {
  return run_of_edges(
      path, true,
      [](const Segment& edge) { return is_flat(edge) && edge.end.x() > edge.start.x(); },
      [](const Segment&, const Segment&) { return true; });
}
VOUSSOIR_INLINE std::optional<OutlineRun> flat_roof_of(const OutlinePath& path) {
  return run_of_edges(
      path, false,
      [](const Segment& edge) { return is_flat(edge) && edge.end.x() < edge.start.x(); },
      [](const Segment&, const Segment&) { return true; });
}
VOUSSOIR_INLINE std::optional<OutlineRun> roof_of(const OutlinePath& path) {
  return run_of_edges(
      path, false,
      [](const Segment& edge) { return edge.start.x() - edge.end.x() > 1e-9 * edge.length(); },
      [](const Segment& edge, const Segment& next) {
        const Vec2 a = edge.end - edge.start, b = next.end - next.start;
        return is_flat(next) || !is_flat(edge) ||
               std::abs(elementary::angle_of(cross(a, b), dot_product(a, b))) <=
                   largest_smooth_turn + 1e-6;
      });
}

}  // namespace detail

#endif

}  // namespace voussoir
