// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// A rectangle with sides along the axes: in the world [m, y up] or on the page [px, y down].
struct ViewRect {
  Vec2 low = zeros<Vec2>(), high = zeros<Vec2>();  ///< smallest and largest x and y

  [[nodiscard]] double width() const { return high.x() - low.x(); }
  [[nodiscard]] double height() const { return high.y() - low.y(); }
  [[nodiscard]] Vec2 centre() const { return (low + high) / 2; }
  [[nodiscard]] bool contains(const Vec2& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
  [[nodiscard]] bool overlaps(const ViewRect& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
  /// Moved outward by `by` on all sides (inward if negative).
  [[nodiscard]] ViewRect grown(double by) const {
    return {low - Vec2::Constant(by), high + Vec2::Constant(by)};
  }
  /// The rectangle about the same centre, widened or heightened to width / height = `ratio`.
  [[nodiscard]] ViewRect with_ratio(double ratio) const {
    const Vec2 half =
        Vec2(std::max(width(), height() * ratio), std::max(height(), width() / ratio)) / 2;
    return {centre() - half, centre() + half};
  }
};

/// The smallest rectangle around finite points; nothing if there is none.
[[nodiscard]] VOUSSOIR_INLINE std::optional<ViewRect> bounding_rect(std::span<const Vec2> points);

/// World coordinates [m, y up] to page coordinates [px, y down].
class PageMap {
 public:
  /// Stretches `world` to fill `page`; both with positive width and height.
  PageMap(const ViewRect& world, const ViewRect& page)
      : world_(world),
        page_(page),
        scale_(page.width() / world.width(), page.height() / world.height()) {
    VOUSSOIR_ASSERT(scale_.x() > 0 && scale_.y() > 0, "a map has a size on both sides");
  }

  /// The same scale in x and y, `world` whole and centred in `page`.
  [[nodiscard]] static PageMap equal_scales(const ViewRect& world, const ViewRect& page) {
    return {world.with_ratio(page.width() / page.height()), page};
  }

  [[nodiscard]] Vec2 operator()(const Vec2& p) const {
    return {page_.low.x() + (p.x() - world_.low.x()) * scale_.x(),
            page_.high.y() - (p.y() - world_.low.y()) * scale_.y()};
  }
  /// A direction or displacement; lengths in px.
  [[nodiscard]] Vec2 vector(const Vec2& d) const {
    return {d.x() * scale_.x(), -d.y() * scale_.y()};
  }
  [[nodiscard]] double scale() const { return scale_.x(); }  ///< [px/m] in x
  [[nodiscard]] const ViewRect& world() const { return world_; }
  [[nodiscard]] const ViewRect& page() const { return page_; }

 private:
  ViewRect world_, page_;
  Vec2 scale_;
};

/// Points in page coordinates; those that are not finite are left out.
[[nodiscard]] inline std::vector<Vec2> on_page(std::span<const Vec2> points, const PageMap& map) {
  std::vector<Vec2> result;
  for (const Vec2& p : points) {
    if (p.allFinite()) result.push_back(map(p));
  }
  return result;
}

/// The part of a convex polygon inside a rectangle (Sutherland & Hodgman 1974); may be empty.
[[nodiscard]] VOUSSOIR_INLINE std::vector<Vec2> clip_polygon(std::span<const Vec2> polygon,
                                                             const ViewRect& rect);

/// The part of a segment inside a rectangle (Liang & Barsky 1984).
[[nodiscard]] VOUSSOIR_INLINE std::optional<std::pair<Vec2, Vec2>> clip_segment(
    const Vec2& p, const Vec2& q, const ViewRect& rect);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<ViewRect> bounding_rect(std::span<const Vec2> points) {
  std::optional<ViewRect> rect;
  for (const Vec2& p : points) {
    if (!p.allFinite()) continue;
    if (!rect) rect = ViewRect{p, p};
    rect->low = rect->low.cwiseMin(p);
    rect->high = rect->high.cwiseMax(p);
  }
  return rect;
}

VOUSSOIR_INLINE std::vector<Vec2> clip_polygon(std::span<const Vec2> polygon,
                                               const ViewRect& rect) {
  std::vector<Vec2> inside(polygon.begin(), polygon.end());
  std::vector<Vec2> kept;
  for (int side = 0; side < 4 && !inside.empty(); ++side) {
    const int axis = side % 2;
    const double sign = side < 2 ? 1 : -1, limit = side < 2 ? rect.low[axis] : -rect.high[axis];
    kept.clear();
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const Vec2 &p = inside[i], &q = inside[(i + 1) % inside.size()];
      const double depth_p = sign * p[axis] - limit, depth_q = sign * q[axis] - limit;
      if (depth_p >= 0) kept.push_back(p);
      if ((depth_p >= 0) != (depth_q >= 0)) {
        kept.emplace_back(p + depth_p / (depth_p - depth_q) * (q - p));
      }
    }
    inside.swap(kept);
  }
  return inside;
}

VOUSSOIR_INLINE std::optional<std::pair<Vec2, Vec2>> clip_segment(const Vec2& p, const Vec2& q,
                                                                  const ViewRect& rect) {
  double begin = 0, end = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = q[axis] - p[axis];
    double enter = rect.low[axis] - p[axis], leave = rect.high[axis] - p[axis];
    if (step == 0) {
      if (enter > 0 || leave < 0) return std::nullopt;
      continue;
    }
    if (step < 0) std::swap(enter, leave);
    begin = std::max(begin, enter / step);
    end = std::min(end, leave / step);
  }
  if (!(begin < end)) return std::nullopt;
  return std::pair<Vec2, Vec2>{p + begin * (q - p), p + end * (q - p)};
}

#endif

}  // namespace voussoir
