// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

namespace voussoir {

// A section that is excavated in parts: heading, bench, invert, drifts.

/// What of a section lies between two elevations and two upright lines [m].
struct SectionPart {
  double left = -std::numeric_limits<double>::infinity();    ///< x from here
  double right = std::numeric_limits<double>::infinity();    ///< to here
  double bottom = -std::numeric_limits<double>::infinity();  ///< y from here
  double top = std::numeric_limits<double>::infinity();      ///< to here
};

/// What is wrong with parts that are excavated one after the other.
struct SectionFault {
  enum class Kind {
    empty,       ///< nothing of the section is in a part
    in_pieces,   ///< the section falls into several pieces there
    twice,       ///< it has been excavated before
    undermined,  ///< rock of the section is left hanging above it
    left_over    ///< after the last part there is rock left in the section
  };
  Kind kind;
  std::size_t part;   ///< index; of `left_over` that of the last
  SectionPart where;  ///< a piece of the section that is concerned
};

/// @return  the outline of a part; none where nothing of the section is in it
/// @throws InvalidInput  the section falls into several pieces there
[[nodiscard]] VOUSSOIR_INLINE std::optional<SimplePolygon> outline_of_part(
    const SimplePolygon& section, const SectionPart& part);

/// Looks for the first fault of parts in their order. Rock may stand beside a part and below it,
/// not above.
/// @cost  parts^3 x edges
[[nodiscard]] VOUSSOIR_INLINE std::optional<SectionFault> fault_of_parts(
    const SimplePolygon& section, const std::vector<SectionPart>& parts);

#if VOUSSOIR_BODIES

namespace detail {

/// The polygon on the lower side of a line x = limit or y = limit (Sutherland & Hodgman 1974);
/// `sign` -1: on the upper side. Where it falls into pieces they hang together along the line.
[[nodiscard]] VOUSSOIR_INLINE std::vector<Vec2> cut_polygon(const std::vector<Vec2>& polygon,
                                                            int axis, double limit, double sign) {
  std::vector<Vec2> kept;
  const auto beyond = [&](const Vec2& p) { return sign * (p[axis] - limit); };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double at_a = beyond(a), at_b = beyond(b);
    if (!(at_a > 0)) kept.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      Vec2 crossing = a + at_a / (at_a - at_b) * (b - a);
      crossing[axis] = limit;
      kept.push_back(crossing);
    }
  }
  return kept;
}

/// Twice the area.
[[nodiscard]] VOUSSOIR_INLINE double doubled_area(const std::vector<Vec2>& polygon) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec2 u = polygon[k] - polygon[0], v = polygon[k + 1] - polygon[0];
    sum += u.x() * v.y() - u.y() * v.x();
  }
  return sum;
}

[[nodiscard]] VOUSSOIR_INLINE std::vector<Vec2> cut_to_part(const SimplePolygon& section,
                                                            const SectionPart& part) {
  std::vector<Vec2> polygon = section.vertices();
  const double limits[] = {part.left, part.bottom, part.right, part.top};
  for (int k = 0; k < 4; ++k)
    if (limits[k] > -std::numeric_limits<double>::infinity() &&
        limits[k] < std::numeric_limits<double>::infinity())
      polygon = cut_polygon(polygon, k % 2, limits[k], k < 2 ? -1 : 1);
  return polygon;
}

[[nodiscard]] VOUSSOIR_INLINE bool covers(const SectionPart& part, const SectionPart& cell) {
  return part.left <= cell.left && cell.right <= part.right && part.bottom <= cell.bottom &&
         cell.top <= part.top;
}

/// The cells into which the lines of all parts divide the plane, that have rock of the section.
[[nodiscard]] VOUSSOIR_INLINE std::vector<SectionPart> cells_of(
    const SimplePolygon& section, const std::vector<SectionPart>& parts) {
  std::vector<double> x, y;
  for (const Vec2& v : section.vertices()) {
    x.push_back(v.x());
    y.push_back(v.y());
  }
  const auto ends = [](std::vector<double>& v) {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    v = {*low, *high};
  };
  ends(x);
  ends(y);
  const double low_x = x[0], high_x = x[1], low_y = y[0], high_y = y[1];
  for (const SectionPart& part : parts) {
    for (const double limit : {part.left, part.right})
      if (limit > low_x && limit < high_x) x.push_back(limit);
    for (const double limit : {part.bottom, part.top})
      if (limit > low_y && limit < high_y) y.push_back(limit);
  }
  for (auto* lines : {&x, &y}) {
    std::sort(lines->begin(), lines->end());
    lines->erase(std::unique(lines->begin(), lines->end()), lines->end());
  }
  std::vector<SectionPart> cells;
  const double least = 1e-9 * section.area();
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const SectionPart cell{x[i], x[i + 1], y[j], y[j + 1]};
      if (0.5 * doubled_area(cut_to_part(section, cell)) > least) cells.push_back(cell);
    }
  return cells;
}

}  // namespace detail

VOUSSOIR_INLINE std::optional<SimplePolygon> outline_of_part(const SimplePolygon& section,
                                                             const SectionPart& part) {
  const std::vector<Vec2> cut = detail::cut_to_part(section, part);
  if (cut.size() < 3 || !(0.5 * detail::doubled_area(cut) > 1e-9 * section.area()))
    return std::nullopt;
  std::vector<Vec2> corners;
  const double apart = 1e-9 * section.perimeter();
  for (const Vec2& p : cut)
    if (corners.empty() || length_of(Vec2(p - corners.back())) > apart) corners.push_back(p);
  while (corners.size() > 1 && length_of(Vec2(corners.front() - corners.back())) <= apart)
    corners.pop_back();
  try {
    return SimplePolygon(std::move(corners));
  } catch (const InvalidInput&) {
    throw InvalidInput(
        "part of a section: the section falls into several pieces there; accepted: "
        "limits between which it is in one piece");
  }
}

VOUSSOIR_INLINE std::optional<SectionFault> fault_of_parts(const SimplePolygon& section,
                                                           const std::vector<SectionPart>& parts) {
  using Kind = SectionFault::Kind;
  std::vector<SectionPart> left = detail::cells_of(section, parts);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    try {
      if (!outline_of_part(section, parts[k])) return SectionFault{Kind::empty, k, parts[k]};
    } catch (const InvalidInput&) {
      return SectionFault{Kind::in_pieces, k, parts[k]};
    }
    for (std::size_t before = 0; before < k; ++before) {
      const SectionPart both{std::max(parts[k].left, parts[before].left),
                             std::min(parts[k].right, parts[before].right),
                             std::max(parts[k].bottom, parts[before].bottom),
                             std::min(parts[k].top, parts[before].top)};
      if (both.left < both.right && both.bottom < both.top &&
          0.5 * detail::doubled_area(detail::cut_to_part(section, both)) > 1e-9 * section.area())
        return SectionFault{Kind::twice, k, both};
    }
    std::erase_if(left, [&](const SectionPart& cell) { return detail::covers(parts[k], cell); });
    for (const SectionPart& cell : left)
      if (cell.bottom >= parts[k].top && cell.left < parts[k].right && cell.right > parts[k].left)
        return SectionFault{Kind::undermined, k, cell};
  }
  if (!left.empty() && !parts.empty())
    return SectionFault{Kind::left_over, parts.size() - 1, left.front()};
  return std::nullopt;
}

#endif

}  // namespace voussoir
