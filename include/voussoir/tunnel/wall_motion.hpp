// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/joined_openings.hpp>
#include <voussoir/tunnel/opening_centre.hpp>

namespace voussoir {

/// Movement of a part of the wall: what one block shows between two of the rays that stand every
/// 6 degrees about the centre of the opening, the right-hand springing among them. So wide blocks
/// count where they are, not where their middle is. Where a piece of rock was dropped, the wall is
/// the rock behind the hole, with the length of the outline in front of it.
///
/// A wall that runs through the centre, as the floor of a heading at the springing does, is seen
/// where it faces: as the invert.
struct WallMotion {
  double angle;  ///< of its middle about `centre_of` the opening, anticlockwise from the right-hand
                 ///< springing [rad], 0 to 2 pi
  double length;               ///< [m]; in 3-D its area [m^2]
  double convergence;          ///< towards the axis of the tunnel, positive inwards [m]
  Vec2 moved = zeros<Vec2>();  ///< in the section: to the right, up [m]
};

/// Mean displacement of the wall, parts by their length: that of the opening as a whole [m]. Not a
/// number without a wall.
///
/// Loose blocks do not count: those whose movement differs from the median one by more than ten
/// times what half of the wall does. A round wall that gives way elastically becomes an ellipse,
/// and no part of it differs by more than sqrt(2) times that.
[[nodiscard]] VOUSSOIR_INLINE Vec2 mean_displacement(const std::vector<WallMotion>& wall);

namespace detail {

[[nodiscard]] inline const SimplePolygon& section_of(const SimplePolygon& opening) {
  return opening;
}
[[nodiscard]] inline const SimplePolygon& section_of(const PrismaticOpening& opening) {
  return opening.section();
}

/// A stretch of the axis of an opening in 3-D [m].
struct AxisStretch {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// What a solver or a run says of its bodies. Whose they are is no matter of the wall: what finds
/// it is compiled once a geometry.
template <class Geometry>
struct BodiesSeen {
  std::function<bool(int body)> is_there;
  std::function<Vec<Geometry::dim>(int body, const Vec<Geometry::dim>& place)>
      displacement;  ///< [m]
};

/// Where a wall is seen from, and of which openings it is a wall.
template <class Geometry>
struct WallSeen {
  Vec2 centre;                                      ///< about which angles are counted [m]
  std::vector<typename Geometry::Opening> later{};  ///< of which its walls count, not its own
  AxisStretch stretch{};                            ///< that is looked at, in 3-D
};

/// True if a place is on the wall of an opening that faces the same way.
/// @param facing  out of the opening, a unit vector in the section
template <class Geometry>
[[nodiscard]] bool is_on_wall(const typename Geometry::Opening& opening,
                              const Vec<Geometry::dim>& place, const Vec2& facing,
                              double tolerance) {
  const SimplePolygon& section = section_of(opening);
  Vec2 p;
  if constexpr (Geometry::dim == 2) {
    p = place;
  } else {
    p = opening.across(place);
    const double s = opening.along(place);
    if (s < opening.from() - tolerance || s > opening.to() + tolerance) return false;
  }
  for (std::size_t e = 0; e < section.size(); ++e) {
    const Segment edge = section.edge(e);
    const Vec2 along = normalized(edge.end - edge.start), there = p - edge.start;
    const double s = dot_product(along, there);
    if (s >= 0 && s <= edge.length() && std::abs(cross(along, there)) <= tolerance &&
        dot_product(Vec2(-perpendicular(along)), facing) > 0.999)
      return true;
  }
  return false;
}

/// For every edge of a section where rays every 6 degrees about a point meet it, its two ends among
/// them: distances from its beginning, increasing [m].
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::vector<double>> ray_marks(
    const SimplePolygon& section, const Vec2& centre);
/// Adds where corners of another section lie on its edges.
VOUSSOIR_INLINE void add_corners_of(const SimplePolygon& other, const SimplePolygon& section,
                                    double tolerance, std::vector<std::vector<double>>& marks);

/// What of a facet lies in a stretch of the axis.
[[nodiscard]] inline std::optional<SpatialFacet> part_along(std::optional<SpatialFacet> facet,
                                                            const PrismaticOpening& opening,
                                                            const AxisStretch& stretch) {
  const Vec3& along = opening.axis().along();
  const auto keep = [&](const Vec3& normal, double reach) {
    if (facet && std::isfinite(reach))
      facet = part_of(*facet,
                      HalfSpace<3>::through(opening.axis().origin() + reach * along, normal), 0.0);
  };
  keep(along, stretch.to);
  keep(Vec3(-along), stretch.from);
  return facet;
}

/// Of pieces that are there.
template <class Geometry>
[[nodiscard]] std::vector<WallMotion> wall_motion_of(const RockMass<Geometry>& mass,
                                                     const typename Geometry::Opening& opening,
                                                     const WallSeen<Geometry>& seen,
                                                     const BodiesSeen<Geometry>& bodies) {
  constexpr int dim = Geometry::dim;
  constexpr double endless = std::numeric_limits<double>::infinity();
  const double tolerance = 1e3 * mass.domain.tolerance();
  const SimplePolygon& section = section_of(opening);
  const Vec2& centre = seen.centre;
  const WallOutline outline(opening);
  auto marks = ray_marks(section, centre);
  for (const auto& later : seen.later) add_corners_of(section_of(later), section, tolerance, marks);
  std::vector<WallMotion> motion;
  for (const auto& piece : wall_pieces(mass, opening)) {
    if (!bodies.is_there(piece.body)) continue;
    const auto e = static_cast<std::size_t>(piece.edge);
    auto within = std::optional(piece.facet);
    if constexpr (dim == 3) within = part_along(std::move(within), opening, seen.stretch);
    const Segment edge = section.edge(e);
    const Vec2 facing = -normalized(perpendicular(edge.end - edge.start));
    const bool holds_centre = std::abs(dot_product(facing, Vec2(centre - edge.start))) <= tolerance;
    for (std::size_t k = 0; k + 1 < marks[e].size(); ++k) {
      // At the ends of an edge nothing is cut off: a hole may reach behind what lies beside it.
      const bool is_last = k + 2 == marks[e].size();
      const auto part = outline.part_between<dim>(within, e, k == 0 ? -endless : marks[e][k],
                                                  is_last ? endless : marks[e][k + 1], 0.0);
      if (!part) continue;
      const double measure = piece.seen_measure(outline, *part);
      if (!(measure > 0)) continue;
      const auto place = part->centre();
      if (std::any_of(seen.later.begin(), seen.later.end(), [&](const auto& later) {
            return is_on_wall<Geometry>(later, place, facing, tolerance);
          }))
        continue;
      const Vec2 p = holds_centre ? facing : Vec2(outline.in_section(place) - centre);
      const auto moved = bodies.displacement(piece.body, place);
      Vec2 u;
      if constexpr (dim == 2)
        u = moved;
      else
        u = opening.across_direction(moved);
      double angle = elementary::angle_of(p.y(), p.x());
      if (angle < 0) angle += 2 * std::numbers::pi;
      VOUSSOIR_ASSERT(angle >= 0 && angle <= 2 * std::numbers::pi, "a full circle has all angles");
      motion.push_back({angle, measure, -u.dot(normalized(p)), u});
    }
  }
  return motion;
}

/// About the centre of the opening.
/// @param stretch  that is looked at, in 3-D
template <class Geometry>
[[nodiscard]] std::vector<WallMotion> wall_motion_of(const RockMass<Geometry>& mass,
                                                     const typename Geometry::Opening& opening,
                                                     const BodiesSeen<Geometry>& bodies,
                                                     const AxisStretch& stretch = {}) {
  return wall_motion_of<Geometry>(mass, opening,
                                  WallSeen<Geometry>{centre_of(opening), {}, stretch}, bodies);
}

/// Of the last opening and those that it is joined to, as far as the last reaches along its axis.
/// @param stretch  that is looked at, in 3-D along the last
template <class Geometry>
[[nodiscard]] std::vector<WallMotion> wall_motion_of_joined(const RockMass<Geometry>& mass,
                                                            const BodiesSeen<Geometry>& bodies,
                                                            const AxisStretch& stretch = {}) {
  std::vector<WallMotion> motion;
  auto joined = joined_openings(mass);
  if (joined.empty()) return motion;
  WallSeen<Geometry> seen{centre_of(joined)};
  for (auto opening = joined.begin(); opening != joined.end(); ++opening) {
    seen.later.assign(opening + 1, joined.end());
    seen.stretch = stretch;
    if constexpr (Geometry::dim == 3) {
      const auto& last = joined.back();
      const double shift = opening->along(last.axis().origin());
      seen.stretch = {shift + std::max(stretch.from, last.from()),
                      shift + std::min(stretch.to, last.to())};
    }
    for (const WallMotion& part : wall_motion_of(mass, *opening, seen, bodies))
      motion.push_back(part);
  }
  return motion;
}

/// The bodies of a solver as they stand.
template <class Solver>
[[nodiscard]] BodiesSeen<typename Solver::Geometry> bodies_of(const Solver& solver) {
  return {[&solver](int b) { return solver.system().body(b).movable; },
          [&solver](int b, const auto& p) { return solver.displacement_of(b, p); }};
}

}  // namespace detail

/// All of the wall of an opening that is not detached. The opening may be the outline of a
/// section that was taken out in rounds.
template <class Solver>
[[nodiscard]] std::vector<WallMotion> wall_motion(
    const Solver& solver, const typename Solver::Geometry::Opening& opening) {
  return detail::wall_motion_of(solver.mass(), opening, detail::bodies_of(solver));
}
/// Of the last opening and those that it is joined to (`joined_openings`): after the bench the
/// section that it makes with its heading. None before one was carved.
template <class Solver>
[[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver) {
  return detail::wall_motion_of_joined(solver.mass(), detail::bodies_of(solver));
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
  return detail::wall_motion_of(solver.mass(), opening, detail::bodies_of(solver),
                                {section - half_length, section + half_length});
}
/// The same of the last opening and those that it is joined to.
template <class Solver>
requires(Solver::dim == 3)
    [[nodiscard]] std::vector<WallMotion> wall_motion(const Solver& solver, double section,
                                                      double half_length) {
  require(half_length > 0, "half of the stretch of wall", half_length, "> 0 m");
  return detail::wall_motion_of_joined(solver.mass(), detail::bodies_of(solver),
                                       {section - half_length, section + half_length});
}
/// Of rock that moves.
/// @param mass  from which the run was made
template <class Geometry, class... Parts>
[[nodiscard]] std::vector<WallMotion> wall_motion(const Dynamics<Geometry::dim, Parts...>& run,
                                                  const RockMass<Geometry>& mass) {
  const detail::BodiesSeen<Geometry> bodies{
      [&run](int b) { return !run.body(b).is_gone; },
      [&run](int b, const auto& p) { return Vec<Geometry::dim>(run.motion(b)(p) - p); }};
  return detail::wall_motion_of_joined(mass, bodies);
}

#if VOUSSOIR_BODIES

namespace detail {

/// Half of the lengths lie below. @param values  not empty
VOUSSOIR_INLINE double median_of(const std::vector<double>& values,
                                 const std::vector<double>& lengths) {
  double total = 0, below = 0;
  for (const double length : lengths) total += length;
  const std::vector<std::size_t> order = order_of_values(values);
  for (const std::size_t k : order) {
    below += lengths[k];
    if (below >= 0.5 * total) return values[k];
  }
  return values[order.back()];
}

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
      // A ray through a corner, as of many a circle, divides neither of its edges.
      if (t > 1e-9 && t < 1 - 1e-9) marks[e].push_back(t * edge.length());
    }
    std::sort(marks[e].begin(), marks[e].end());
  }
  return marks;
}

VOUSSOIR_INLINE void add_corners_of(const SimplePolygon& other, const SimplePolygon& section,
                                    double tolerance, std::vector<std::vector<double>>& marks) {
  for (std::size_t e = 0; e < section.size(); ++e) {
    const Segment edge = section.edge(e);
    const Vec2 along = normalized(edge.end - edge.start);
    for (const Vec2& corner : other.vertices()) {
      const Vec2 there = corner - edge.start;
      const double s = dot_product(along, there);
      if (s > tolerance && s < edge.length() - tolerance &&
          std::abs(cross(along, there)) <= tolerance)
        marks[e].push_back(s);
    }
    std::sort(marks[e].begin(), marks[e].end());
  }
}

}  // namespace detail

VOUSSOIR_INLINE Vec2 mean_displacement(const std::vector<WallMotion>& wall) {
  constexpr double loose = 10;
  Vec2 median = zeros<Vec2>();
  double reach = std::numeric_limits<double>::infinity();
  if (!wall.empty()) {
    std::vector<double> lengths, values(wall.size());
    for (const WallMotion& piece : wall) lengths.push_back(piece.length);
    for (int d = 0; d < 2; ++d) {
      for (std::size_t k = 0; k < wall.size(); ++k) values[k] = wall[k].moved[d];
      median[d] = detail::median_of(values, lengths);
    }
    for (std::size_t k = 0; k < wall.size(); ++k) values[k] = length_of(wall[k].moved - median);
    reach = loose * detail::median_of(values, lengths);
  }
  Vec2 sum = zeros<Vec2>();
  double length = 0;
  for (const WallMotion& piece : wall) {
    if (length_of(piece.moved - median) > reach) continue;
    sum += piece.length * piece.moved;
    length += piece.length;
  }
  return sum / length;
}

#endif

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE std::vector<WallMotion> detail::wall_motion_of<Planar>(
    const RockMass<Planar>&, const SimplePolygon&, const BodiesSeen<Planar>&, const AxisStretch&);
VOUSSOIR_PLANAR_TEMPLATE std::vector<WallMotion> detail::wall_motion_of_joined<Planar>(
    const RockMass<Planar>&, const BodiesSeen<Planar>&, const AxisStretch&);
VOUSSOIR_SPATIAL_TEMPLATE std::vector<WallMotion> detail::wall_motion_of<Spatial>(
    const RockMass<Spatial>&, const PrismaticOpening&, const BodiesSeen<Spatial>&,
    const AxisStretch&);
VOUSSOIR_SPATIAL_TEMPLATE std::vector<WallMotion> detail::wall_motion_of_joined<Spatial>(
    const RockMass<Spatial>&, const BodiesSeen<Spatial>&, const AxisStretch&);
#endif

}  // namespace voussoir
