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

/// What is taken out of a section at once.
struct ExcavatedPart {
  SimplePolygon outline;      ///< within the section; where it takes the rest, that of the section
  bool takes_rest = false;    ///< what the parts before it have left
  bool may_undercut = false;  ///< rock may be left above it: a drift that is drawn by its outline
};

/// What is wrong with parts that are excavated one after the other.
struct SectionFault {
  enum class Kind {
    empty,       ///< nothing of the section is in a part
    twice,       ///< it has been excavated before
    undermined,  ///< rock of the section is left hanging above it
    left_over    ///< after the last part there is rock left in the section
  };
  Kind kind;
  std::size_t part;   ///< index; of `left_over` that of the last
  SectionPart where;  ///< the box around what is concerned
};

/// @return  the outline of a part; none where nothing of the section is in it
/// @throws InvalidInput  the section falls into several pieces there
[[nodiscard]] VOUSSOIR_INLINE std::optional<SimplePolygon> outline_of_part(
    const SimplePolygon& section, const SectionPart& part);

/// Looks for the first fault of parts in their order. Rock may stand beside a part and below it,
/// above it only where that is allowed.
///
/// Between two neighbouring uprights through corners and crossings of the outlines these run
/// without meeting: what lies above what is seen on the line midway.
/// @cost  edges^2
[[nodiscard]] VOUSSOIR_INLINE std::optional<SectionFault> fault_of_parts(
    const SimplePolygon& section, const std::vector<ExcavatedPart>& parts);

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

/// What of an upright line lies in an outline: stretches from ... to, rising [m].
using Stretches = std::vector<std::pair<double, double>>;

[[nodiscard]] VOUSSOIR_INLINE Stretches stretches_at(const SimplePolygon& outline, double x) {
  std::vector<double> crossings;
  for (std::size_t e = 0; e < outline.size(); ++e) {
    const auto [a, b] = outline.edge(e);
    if ((a.x() < x) == (b.x() < x)) continue;
    crossings.push_back(a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
  }
  std::sort(crossings.begin(), crossings.end());
  Stretches stretches;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
    stretches.emplace_back(crossings[k], crossings[k + 1]);
  return stretches;
}

/// What is in `a` and not in `b`.
[[nodiscard]] VOUSSOIR_INLINE Stretches without(const Stretches& a, const Stretches& b) {
  Stretches left = a;
  for (const auto& [from, to] : b) {
    Stretches cut;
    for (const auto& [low, high] : left) {
      if (std::min(high, from) > low) cut.emplace_back(low, std::min(high, from));
      if (high > std::max(low, to)) cut.emplace_back(std::max(low, to), high);
    }
    left = std::move(cut);
  }
  return left;
}

/// Uprights between which outlines do not meet, rising [m].
[[nodiscard]] VOUSSOIR_INLINE std::vector<double> uprights_of(
    const SimplePolygon& section, const std::vector<ExcavatedPart>& parts) {
  std::vector<Segment> edges;
  const auto add = [&](const SimplePolygon& outline) {
    for (std::size_t e = 0; e < outline.size(); ++e) edges.push_back(outline.edge(e));
  };
  add(section);
  for (const ExcavatedPart& part : parts) add(part.outline);
  std::vector<double> x;
  for (const Segment& a : edges) {
    x.push_back(a.start.x());
    const Vec2 along = a.end - a.start;
    for (const Segment& b : edges) {
      const Vec2 other = b.end - b.start, apart = b.start - a.start;
      const double turn = along.x() * other.y() - along.y() * other.x();
      if (turn == 0) continue;
      const double s = (apart.x() * other.y() - apart.y() * other.x()) / turn,
                   t = (apart.x() * along.y() - apart.y() * along.x()) / turn;
      if (s > 0 && s < 1 && t > 0 && t < 1) x.push_back(a.start.x() + s * along.x());
    }
  }
  std::sort(x.begin(), x.end());
  return x;
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

VOUSSOIR_INLINE std::optional<SectionFault> fault_of_parts(
    const SimplePolygon& section, const std::vector<ExcavatedPart>& parts) {
  using Kind = SectionFault::Kind;
  const std::vector<double> x = detail::uprights_of(section, parts);
  const double apart = 1e-9 * section.perimeter();  // rounding of outlines that share a line
  struct Upright {
    double low, high;         // x
    detail::Stretches left;   // rock of the section
    detail::Stretches taken;  // by parts before
  };
  std::vector<Upright> uprights;
  for (std::size_t k = 0; k + 1 < x.size(); ++k)
    if (x[k + 1] - x[k] > apart)
      uprights.push_back(
          {x[k], x[k + 1], detail::stretches_at(section, 0.5 * (x[k] + x[k + 1])), {}});
  std::optional<SectionFault> fault;  // of the part that is looked at
  const auto note = [&fault](Kind kind, std::size_t part, const Upright& at, double from,
                             double to) {
    const SectionPart cell{at.low, at.high, from, to};
    if (!fault || (kind == Kind::twice && fault->kind != kind))
      fault = SectionFault{kind, part, cell};
    else if (fault->kind == kind)
      fault->where = {
          std::min(fault->where.left, cell.left), std::max(fault->where.right, cell.right),
          std::min(fault->where.bottom, cell.bottom), std::max(fault->where.top, cell.top)};
  };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    bool takes_rock = false;
    for (Upright& at : uprights) {
      const detail::Stretches asked =
          parts[k].takes_rest ? at.left
                              : detail::stretches_at(parts[k].outline, 0.5 * (at.low + at.high));
      for (const auto& [from, to] : asked) {
        for (const auto& [low, high] : detail::stretches_at(section, 0.5 * (at.low + at.high)))
          takes_rock = takes_rock || std::min(to, high) - std::max(from, low) > apart;
        for (const auto& [low, high] : at.taken)
          if (std::min(to, high) - std::max(from, low) > apart)
            note(Kind::twice, k, at, std::max(from, low), std::min(to, high));
      }
      at.left = detail::without(at.left, asked);
      at.taken.insert(at.taken.end(), asked.begin(), asked.end());
      if (parts[k].may_undercut) continue;
      for (const auto& [low, high] : at.left)
        for (const auto& [from, to] : asked)
          if (high - low > apart && to - from > apart && low > to - apart)
            note(Kind::undermined, k, at, low, high);
    }
    if (!takes_rock) return SectionFault{Kind::empty, k, {}};
    if (fault) return fault;
  }
  if (parts.empty()) return std::nullopt;
  for (const Upright& at : uprights)
    for (const auto& [low, high] : at.left)
      if ((high - low) * (at.high - at.low) > 1e-9 * section.area())
        note(Kind::left_over, parts.size() - 1, at, low, high);
  return fault;
}

#endif

}  // namespace voussoir
