// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/part_of.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

namespace voussoir {

/// A place of an outline.
struct OutlinePlace {
  std::size_t edge;
  double s;  ///< from its beginning [m]
};

/// Parts the rock behind the outline of an opening among the edges in front of it, and along these.
///
/// Behind an edge lies what is outside and between the lines that halve the angles at its two
/// corners. From the one to the other the lines turn evenly, so every place of the outline has a
/// line of its own (on a circle its radius), and what lies on it is behind that place. Behind an
/// edge between two corners that turn the other way, where rock hangs into the opening, the lines
/// meet: there it parts rock as far as to where they do.
class WallOutline {
 public:
  /// Outlives neither the polygon nor the opening.
  explicit WallOutline(const SimplePolygon& section);
  explicit WallOutline(const PrismaticOpening& opening) : WallOutline(opening.section()) {
    opening_ = &opening;
  }

  [[nodiscard]] std::size_t size() const { return edges_.size(); }
  [[nodiscard]] const Segment& edge(std::size_t e) const { return edges_[e].line; }
  /// Where an edge begins, from vertex 0 along the outline; of the last but one its length [m].
  [[nodiscard]] double start(std::size_t e) const { return starts_[e]; }

  /// Distance behind an edge [m].
  [[nodiscard]] double depth(std::size_t e, const Vec2& p) const {
    return dot_product(edges_[e].outward, p - edges_[e].line.start);
  }
  /// The place in front of a point that lies behind an edge, from its beginning [m].
  [[nodiscard]] double place(std::size_t e, const Vec2& p) const;
  /// By how much what is as far behind the edge is wider than it [-].
  [[nodiscard]] double widening(std::size_t e, double depth) const {
    const Edge& edge = edges_[e];
    return std::max(0.0, 1 + depth * (edge.slope_end - edge.slope_start) / edge.length);
  }
  /// The way from a place to what is behind it, 1 m away from the edge with every step.
  [[nodiscard]] Vec2 way_behind(std::size_t e, double s) const {
    const Edge& edge = edges_[e];
    return edge.outward + slope(edge, s) * edge.along;
  }
  /// The point of an edge at a place.
  [[nodiscard]] Vec2 point(std::size_t e, double s) const {
    return edges_[e].line.start + s * edges_[e].along;
  }
  /// All that is behind places of an edge before one, `s` from its beginning.
  [[nodiscard]] HalfSpace<2> before(std::size_t e, double s) const;
  /// All that is no further than this behind an edge [m].
  [[nodiscard]] HalfSpace<2> within(std::size_t e, double depth) const {
    const Edge& edge = edges_[e];
    return HalfSpace<2>::through(edge.line.start + depth * edge.outward, edge.outward);
  }

  /// A half plane of the section, in the space of the opening.
  template <int Dim>
  [[nodiscard]] HalfSpace<Dim> in_space(const HalfSpace<2>& side) const {
    if constexpr (Dim == 2) {
      return side;
    } else {
      const Vec3 normal = opening_->axis().direction(side.normal);
      return {normal, side.offset + dot_product(normal, opening_->axis().origin())};
    }
  }
  /// A point as it is seen in the section.
  [[nodiscard]] const Vec2& in_section(const Vec2& p) const { return p; }
  [[nodiscard]] Vec2 in_section(const Vec3& p) const { return opening_->across(p); }

  /// What of a facet or a shape lies behind the places between two; an infinite place does not
  /// bound it.
  template <int Dim, class Thing>
  [[nodiscard]] std::optional<Thing> part_between(std::optional<Thing> thing,
                                                  const OutlinePlace& low, const OutlinePlace& high,
                                                  double tolerance) const {
    if (thing && std::isfinite(high.s))
      thing = part_of(*thing, in_space<Dim>(before(high.edge, high.s)), tolerance);
    if (thing && std::isfinite(low.s)) {
      HalfSpace<2> side = before(low.edge, low.s);
      thing = part_of(*thing, in_space<Dim>({-side.normal, -side.offset}), tolerance);
    }
    return thing;
  }
  /// Between two places of one edge.
  template <int Dim, class Thing>
  [[nodiscard]] std::optional<Thing> part_between(std::optional<Thing> thing, std::size_t e,
                                                  double low, double high, double tolerance) const {
    return part_between<Dim>(std::move(thing), {e, low}, {e, high}, tolerance);
  }

  /// The angle by which the outline turns from an edge to the next, to the left [rad].
  [[nodiscard]] double turn_after(std::size_t e) const {
    const Vec2 &here = edges_[e].along, &next = edges_[e + 1 == size() ? 0 : e + 1].along;
    return elementary::angle_of(cross(here, next), dot_product(here, next));
  }

 private:
  struct Edge {
    Segment line;
    Vec2 along, outward;  ///< unit vectors
    double length;        ///< [m]
    /// How far the lines at the two corners go along the edge while they go 1 m away from it.
    double slope_start, slope_end;
  };
  [[nodiscard]] static double slope(const Edge& edge, double s) {
    return edge.slope_start + s / edge.length * (edge.slope_end - edge.slope_start);
  }

  std::vector<Edge> edges_;
  std::vector<double> starts_;
  const PrismaticOpening* opening_ = nullptr;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE WallOutline::WallOutline(const SimplePolygon& section) : starts_{0} {
  for (std::size_t e = 0; e < section.size(); ++e) {
    const Segment line = section.edge(e);
    const double length = line.length();
    const Vec2 along = (line.end - line.start) / length;
    edges_.push_back({line, along, -perpendicular(along), length, 0, 0});
    starts_.push_back(starts_.back() + length);
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    Edge &here = edges_[e], &next = edges_[e + 1 == edges_.size() ? 0 : e + 1];
    const Vec2 halving = here.outward + next.outward;
    const double away = dot_product(halving, here.outward);  // 1 + cosine of the turn, as of next
    if (!(away > 1e-6)) continue;                            // the outline turns back
    here.slope_end = dot_product(halving, here.along) / away;
    next.slope_start = dot_product(halving, next.along) / away;
  }
}

VOUSSOIR_INLINE double WallOutline::place(std::size_t e, const Vec2& p) const {
  const Edge& edge = edges_[e];
  const double x = dot_product(edge.along, p - edge.line.start), behind = depth(e, p);
  const double wide = widening(e, behind);
  const double s = wide > 0 ? (x - behind * edge.slope_start) / wide : x;
  return std::clamp(s, 0.0, edge.length);
}

VOUSSOIR_INLINE HalfSpace<2> WallOutline::before(std::size_t e, double s) const {
  const Edge& edge = edges_[e];
  // Right of the line that goes away from the place, behind it: later places.
  return HalfSpace<2>::through(point(e, s),
                               normalized(Vec2(edge.along - slope(edge, s) * edge.outward)));
}

#endif

}  // namespace voussoir
