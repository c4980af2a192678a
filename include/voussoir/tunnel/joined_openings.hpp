// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/outline_overlap.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/tunnel/opening_centre.hpp>

namespace voussoir {

// A section that is taken out in several openings: heading and bench, a pilot and its enlargement,
// a niche. What is measured of the tunnel as it stands is measured on the walls of all of them.

/// True if there is no rock between two sections: they overlap, or share a stretch of their
/// outlines.
/// @param tolerance  sections no further apart than this touch [m], > 0
[[nodiscard]] VOUSSOIR_INLINE bool are_joined(const SimplePolygon& a, const SimplePolygon& b,
                                              double tolerance);
/// In 3-D openings along one axis that are open over the same stretch of it: the rounds of a
/// heading, one after the other, are no wider section.
[[nodiscard]] VOUSSOIR_INLINE bool are_joined(const PrismaticOpening& a, const PrismaticOpening& b,
                                              double tolerance);

/// The last opening and those that it is joined to, directly or through others, in the order in
/// which they were excavated; none before one was.
template <class Geometry>
[[nodiscard]] std::vector<typename Geometry::Opening> joined_openings(
    const RockMass<Geometry>& mass) {
  const double tolerance = 1e3 * mass.domain.tolerance();  // what has ten digits still touches
  std::vector<char> is_joined(mass.openings.size(), 0);
  std::vector<std::size_t> next;
  if (!mass.openings.empty()) next.push_back(mass.openings.size() - 1);
  while (!next.empty()) {
    const std::size_t k = next.back();
    next.pop_back();
    if (is_joined[k] != 0) continue;
    is_joined[k] = 1;
    for (std::size_t other = 0; other < mass.openings.size(); ++other)
      if (is_joined[other] == 0 && are_joined(mass.openings[k], mass.openings[other], tolerance))
        next.push_back(other);
  }
  std::vector<typename Geometry::Opening> joined;
  for (std::size_t k = 0; k < is_joined.size(); ++k)
    if (is_joined[k] != 0) joined.push_back(mass.openings[k]);
  return joined;
}

/// The point about which angles are counted on the walls of joined openings [m]: the origin where
/// it lies in one of them or on its outline (`centre_of`), else the middle of their areas.
/// @pre  there is one
[[nodiscard]] VOUSSOIR_INLINE Vec2 centre_of(const std::vector<SimplePolygon>& joined);
/// In the coordinates of their sections.
[[nodiscard]] VOUSSOIR_INLINE Vec2 centre_of(const std::vector<PrismaticOpening>& joined);

#if VOUSSOIR_BODIES

namespace detail {

/// Whether the ground just outside an edge of `a` lies in `b`.
[[nodiscard]] inline bool goes_on_in(const SimplePolygon& a, const SimplePolygon& b,
                                     double tolerance) {
  for (std::size_t e = 0; e < a.size(); ++e) {
    const Segment edge = a.edge(e);
    const Vec2 outwards = -normalized(perpendicular(edge.end - edge.start));
    const std::vector<double> at = meetings(edge, b);
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      if ((at[k + 1] - at[k]) * edge.length() <= 4 * tolerance) continue;
      if (b.contains(edge.at(0.5 * (at[k] + at[k + 1])) + 2 * tolerance * outwards)) return true;
    }
  }
  return false;
}

}  // namespace detail

VOUSSOIR_INLINE bool are_joined(const SimplePolygon& a, const SimplePolygon& b, double tolerance) {
  return detail::goes_on_in(a, b, tolerance) || detail::goes_on_in(b, a, tolerance);
}

VOUSSOIR_INLINE bool are_joined(const PrismaticOpening& a, const PrismaticOpening& b,
                                double tolerance) {
  if (!a.axis().is_parallel_to(b.axis()) || dot_product(a.axis().along(), b.axis().along()) < 0)
    return false;
  const Vec2 aside = a.across(b.axis().origin());
  if (length_of(aside) > tolerance) return false;
  const double shift = a.along(b.axis().origin());
  if (std::min(a.to(), b.to() + shift) - std::max(a.from(), b.from() + shift) <= tolerance)
    return false;
  return are_joined(a.section(), b.section(), tolerance);
}

VOUSSOIR_INLINE Vec2 centre_of(const std::vector<SimplePolygon>& joined) {
  if (joined.size() == 1) return centre_of(joined.front());
  Vec2 sum = zeros<Vec2>();
  double area = 0;
  for (const SimplePolygon& section : joined) {
    const Vec2 centre = centre_of(section);
    if (centre == zeros<Vec2>()) return centre;
    const auto properties = mass_properties({section.vertices().data(), section.vertices().size()});
    sum += properties.measure * properties.centroid;
    area += properties.measure;
  }
  return sum / area;
}
VOUSSOIR_INLINE Vec2 centre_of(const std::vector<PrismaticOpening>& joined) {
  std::vector<SimplePolygon> sections;
  for (const PrismaticOpening& opening : joined) sections.push_back(opening.section());
  return centre_of(sections);
}

#endif

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE std::vector<SimplePolygon> joined_openings(const RockMass<Planar>&);
VOUSSOIR_SPATIAL_TEMPLATE std::vector<PrismaticOpening> joined_openings(const RockMass<Spatial>&);
#endif

}  // namespace voussoir
