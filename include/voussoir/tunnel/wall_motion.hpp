// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/opening_centre.hpp>

namespace voussoir {

/// Movement of a part of the wall: what one block shows between two of the rays that stand every
/// 6 degrees about the centre of the opening, the right-hand springing among them. So wide blocks
/// count where they are, not where their middle is.
struct WallMotion {
  double angle;  ///< of its middle about `centre_of` the opening, anticlockwise from the right-hand
                 ///< springing [rad], 0 to 2 pi
  double length;               ///< [m]; in 3-D its area [m^2]
  double convergence;          ///< towards the axis of the tunnel, positive inwards [m]
  Vec2 moved = zeros<Vec2>();  ///< in the section: to the right, up [m]
};

/// Mean displacement of the wall, parts by their length: that of the opening as a whole [m]. Not a
/// number without a wall.
[[nodiscard]] inline Vec2 mean_displacement(const std::vector<WallMotion>& wall) {
  Vec2 sum = zeros<Vec2>();
  double length = 0;
  for (const WallMotion& piece : wall) {
    sum += piece.length * piece.moved;
    length += piece.length;
  }
  return sum / length;
}

namespace detail {

/// What lies in between two places along an edge of the outline, and two along the axis.
struct WallWindow {
  double low, high;  ///< from the beginning of the edge [m]
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();  ///< in 3-D, along the axis [m]
};
/// The part of a piece of wall that a window shows; no measure if there is none.
[[nodiscard]] VOUSSOIR_INLINE Segment seen_in(const SimplePolygon& opening,
                                              const WallPiece<Planar>& piece,
                                              const WallWindow& window);
[[nodiscard]] VOUSSOIR_INLINE SpatialFacet seen_in(const PrismaticOpening& opening,
                                                   const WallPiece<Spatial>& piece,
                                                   const WallWindow& window);

/// For every edge of a section where rays every 6 degrees about a point meet it, its two ends among
/// them: distances from its beginning, increasing [m].
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::vector<double>> ray_marks(
    const SimplePolygon& section, const Vec2& centre);

[[nodiscard]] inline const SimplePolygon& section_of(const SimplePolygon& opening) {
  return opening;
}
[[nodiscard]] inline const SimplePolygon& section_of(const PrismaticOpening& opening) {
  return opening.section();
}

/// Of pieces that are there, moved by a displacement.
/// @param is_there  is_there(body)
/// @param displacement  displacement(body, place) [m]
/// @param window  in 3-D the stretch of the axis; the rest of it is set here
template <class Geometry, class IsThere, class Displacement>
[[nodiscard]] std::vector<WallMotion> wall_motion_of(const RockMass<Geometry>& mass,
                                                     const typename Geometry::Opening& opening,
                                                     IsThere&& is_there,
                                                     Displacement&& displacement,
                                                     WallWindow window = {0, 0}) {
  const Vec2 centre = centre_of(opening);
  const auto marks = ray_marks(section_of(opening), centre);
  std::vector<WallMotion> motion;
  for (const auto& piece : wall_pieces(mass, opening)) {
    if (!is_there(piece.body)) continue;
    const auto& of_edge = marks[static_cast<std::size_t>(piece.edge)];
    for (std::size_t k = 0; k + 1 < of_edge.size(); ++k) {
      window.low = of_edge[k];
      window.high = of_edge[k + 1];
      const auto part = seen_in(opening, piece, window);
      const double measure = part.measure();
      if (!(measure > 0)) continue;
      const auto place = part.centre();
      const auto moved = displacement(piece.body, place);
      Vec2 p, u;
      if constexpr (Geometry::dim == 2) {
        p = place - centre;
        u = moved;
      } else {
        p = opening.across(place) - centre;
        u = opening.across_direction(moved);
      }
      double angle = elementary::angle_of(p.y(), p.x());
      if (angle < 0) angle += 2 * std::numbers::pi;
      VOUSSOIR_ASSERT(angle >= 0 && angle <= 2 * std::numbers::pi, "a full circle has all angles");
      motion.push_back({angle, measure, -u.dot(normalized(p)), u});
    }
  }
  return motion;
}

}  // namespace detail

/// All of the wall of an opening that is not detached. The opening may be the outline of a
/// section that was taken out in rounds.
template <class Solver>
[[nodiscard]] std::vector<WallMotion> wall_motion(
    const Solver& solver, const typename Solver::Geometry::Opening& opening) {
  return detail::wall_motion_of(
      solver.mass(), opening, [&](int b) { return solver.system().body(b).movable; },
      [&](int b, const auto& p) { return solver.displacement_of(b, p); });
}
/// Of the last opening; none before one was carved.
template <class Solver>
[[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver) {
  if (solver.mass().openings.empty()) return {};
  return wall_motion(solver, solver.mass().openings.back());
}
/// In 3-D within a stretch of the opening.
/// @param section  the middle of the stretch along the axis [m]
/// @param half_length  of the stretch [m], > 0
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver,
                                                      const PrismaticOpening& opening,
                                                      double section, double half_length) {
  require(half_length > 0, "half of the stretch of wall", half_length, "> 0 m");
  return detail::wall_motion_of(
      solver.mass(), opening, [&](int b) { return solver.system().body(b).movable; },
      [&](int b, const Vec3& p) { return solver.displacement_of(b, p); },
      {0, 0, section - half_length, section + half_length});
}
/// The same of the last opening.
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver, double section,
                                                      double half_length) {
  if (solver.mass().openings.empty()) return {};
  return wall_motion(solver, solver.mass().openings.back(), section, half_length);
}
/// Of rock that moves.
/// @param mass  from which the run was made
template <class Geometry, class... Parts>
[[nodiscard]] std::vector<WallMotion> wall_motion(const Dynamics<Geometry::dim, Parts...>& run,
                                                  const RockMass<Geometry>& mass) {
  if (mass.openings.empty()) return {};
  return detail::wall_motion_of(
      mass, mass.openings.back(), [&](int b) { return !run.body(b).is_gone; },
      [&](int b, const auto& p) { return Vec<Geometry::dim>(run.motion(b)(p) - p); });
}

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::vector<std::vector<double>> ray_marks(const SimplePolygon& section,
                                                           const Vec2& centre) {
  constexpr double between = std::numbers::pi / 30;
  std::vector<std::vector<double>> marks(section.size());
  for (std::size_t e = 0; e < section.size(); ++e) {
    const Segment edge = section.edge(e);
    const Vec2 a = edge.start - centre, b = edge.end - centre, along = b - a;
    const double turn = elementary::angle_of(cross(a, b), dot_product(a, b));  // 0 seen along a ray
    const double begin = elementary::angle_of(a.y(), a.x()), end = begin + turn;
    marks[e] = {0, edge.length()};
    for (double k = std::ceil(std::min(begin, end) / between); k * between < std::max(begin, end);
         ++k) {
      const Vec2 ray(elementary::cosine(k * between), elementary::sine(k * between));
      const double t = -cross(ray, a) / cross(ray, along);
      if (t > 0 && t < 1) marks[e].push_back(t * edge.length());
    }
    std::sort(marks[e].begin(), marks[e].end());
  }
  return marks;
}

VOUSSOIR_INLINE Segment seen_in(const SimplePolygon& opening, const WallPiece<Planar>& piece,
                                const WallWindow& window) {
  const Segment edge = opening.edge(static_cast<std::size_t>(piece.edge));
  const Vec2 along = (edge.end - edge.start) / edge.length();
  const double start = dot_product(along, piece.facet.start - edge.start);
  const double end = dot_product(along, piece.facet.end - edge.start);
  const double from = std::max(start, window.low), to = std::min(end, window.high);
  if (!(from < to)) return {piece.facet.start, piece.facet.start};
  return {from == start ? piece.facet.start : Vec2(edge.start + from * along),
          to == end ? piece.facet.end : Vec2(edge.start + to * along)};
}

/// What of a convex polygon lies in a half space.
[[nodiscard]] inline SpatialFacet part_in(const SpatialFacet& facet, const HalfSpace<3>& side) {
  SpatialFacet part;
  const std::size_t n = facet.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 &here = facet.vertices[k], &next = facet.vertices[k + 1 == n ? 0 : k + 1];
    const double h = side.distance(here), g = side.distance(next);
    if (h <= 0) part.vertices.push_back(here);
    if ((h < 0 && g > 0) || (h > 0 && g < 0))
      part.vertices.push_back(here + h / (h - g) * (next - here));
  }
  return part;
}

VOUSSOIR_INLINE SpatialFacet seen_in(const PrismaticOpening& opening,
                                     const WallPiece<Spatial>& piece, const WallWindow& window) {
  const Segment edge = opening.section().edge(static_cast<std::size_t>(piece.edge));
  const Vec3 across = opening.axis().direction((edge.end - edge.start) / edge.length());
  const Vec3 along = opening.axis().along();
  const Vec3 begin = opening.in_space(edge.start, 0);
  SpatialFacet part = piece.facet;
  const auto keep = [&](const Vec3& normal, double reach) {
    if (std::isfinite(reach) && !part.vertices.empty())
      part = part_in(part, HalfSpace<3>::through(begin + reach * normal, normal));
  };
  keep(across, window.high);
  keep(-across, -window.low);
  keep(along, window.to);
  keep(-along, -window.from);
  if (part.vertices.size() < 3) part.vertices.assign(3, begin);  // it has a centre and no area
  return part;
}

}  // namespace detail

#endif

}  // namespace voussoir
