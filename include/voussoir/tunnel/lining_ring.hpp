// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/tunnel/lining_wall.hpp>
#include <voussoir/tunnel/ring_nodes.hpp>

namespace voussoir {

/// Nodes and members of a ring, and its contact with the wall that `carve` left.
///
/// A node stands for a stretch of the outline and lies in its middle: with as many nodes as facets
/// of a circle, on the middle of each facet. Stretches end at the corners of the outline, where
/// nodes lie that touch nothing, and at the ends of an arc (`detail::RingNodes`). Every piece of
/// wall behind its stretch touches a node at one point, so a uniform pressure loads it without
/// turning it.
///
/// @param opening  that is lined; its outline may be that of a section taken out in rounds
/// @param fallen   bodies that have fallen before (`ComposedSolver::fallen`), whose holes it fills
/// @throws InvalidInput  a value out of range; no opening; fewer than two nodes in the arc; rock
///                       that is not yet excavated where a node would be, or no rock at all because
///                       that is outside the domain
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                               const SimplePolygon& opening,
                                                               const LiningRing& ring,
                                                               const std::vector<int>& fallen = {});
/// The same on the wall of the last opening.
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                               const LiningRing& ring,
                                                               const std::vector<int>& fallen = {});

namespace detail {

/// Refuses to line what is not yet excavated, or lies outside the domain.
/// @param inside  a point of the opening in front of the wall
template <class Geometry>
void require_excavated(const RockMass<Geometry>& mass, const Vec<Geometry::dim>& inside) {
  const auto& domain = mass.domain;
  if (any_less(inside, domain.low) || any_less(domain.high, inside))
    throw InvalidInput("lining: at " + text_of<Geometry::dim>(inside) +
                       " m it is outside the domain: line an arc or a stretch inside it");
  for (const auto& opening : mass.openings)
    if (opening.contains(inside)) return;
  throw InvalidInput("lining: at " + text_of<Geometry::dim>(inside) +
                     " m rock is not yet excavated: excavate it first, or line an arc or a stretch "
                     "of what is");
}

/// The body of rock that a point lies in; -1: none, or it is outside the domain.
template <class Geometry>
[[nodiscard]] int body_at(const RockMass<Geometry>& mass, const Vec<Geometry::dim>& point) {
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const auto& part : mass.bodies[b].parts)
      if (part.contains(point)) return static_cast<int>(b);
  return -1;
}

/// The end of an arc, and the rock that it stands on: what is under it or beside it; else, where a
/// piece of the wall has been left out because it is too small for a block, what is nearest within
/// a stretch, for concrete fills such a hole.
/// @param inward  at right angles to its direction, into the opening
/// @param end     its place is where the lining ends; its body is given, and its place where the
///                foot acts, a thousandth of a stretch inside, for a foot goes with its rock
template <class Geometry>
[[nodiscard]] LiningEnd<Geometry> founded(const RockMass<Geometry>& mass, LiningEnd<Geometry> end,
                                          const Vec<Geometry::dim>& inward, double stretch) {
  using Point = Vec<Geometry::dim>;
  end.body = -1;
  const auto at = [&](double ahead, double side) {
    return Point(end.place + stretch * (ahead * end.direction + side * inward));
  };
  for (const double side : {1e-3, -1e-3, 0.0}) {
    const Point here = at(1e-3, side);
    end.body = body_at<Geometry>(mass, here);
    if (end.body < 0) continue;
    end.place = here;
    return end;
  }
  const auto look = [&](double ahead, double side) {
    if (end.body < 0) end.body = body_at<Geometry>(mass, at(ahead, side));
  };
  const double distances[] = {0.05, 0.35, 0.65, 1};
  for (const double ahead : distances) look(ahead, 0.05);
  for (const double behind : distances) {
    for (const double ahead : distances)
      if (ahead <= behind) look(ahead, -behind);
    for (const double side : distances)
      if (side < behind) look(behind, -side);
  }
  return end;
}

}  // namespace detail

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                 const LiningRing& ring,
                                                 const std::vector<int>& fallen) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  return lining_frame(mass, mass.openings.back(), ring, fallen);
}

VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                 const SimplePolygon& opening,
                                                 const LiningRing& ring,
                                                 const std::vector<int>& fallen) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  const detail::RingNodes nodes = detail::ring_nodes(opening, ring);
  LiningFrame<Planar> frame;
  frame.nodes = nodes.places;
  frame.centre = ring.centre.value_or(centre_of(opening));
  frame.perimeter = opening.perimeter();
  for (std::size_t n = 0; n < nodes.places.size(); ++n)
    if (nodes.joined[n])
      frame.members.push_back(
          {static_cast<int>(n), n + 1 == nodes.places.size() ? 0 : static_cast<int>(n) + 1});
  for (std::size_t n = 0; n < nodes.places.size(); ++n)
    if (nodes.is_bare[n]) frame.bare.push_back(static_cast<int>(n));
  for (const detail::RingEnd& end : nodes.ends) {
    const auto there = static_cast<int>(frame.nodes.size() + frame.neighbours.size());
    frame.ends.push_back(
        detail::founded<Planar>(mass,
                                {end.node, static_cast<int>(frame.neighbours.size()), -1, end.place,
                                 end.direction, 1, end.refusal},
                                end.inward(), nodes.stretch));
    frame.neighbours.push_back(end.place);
    if (end.is_after)
      frame.joints.push_back({end.node, there});
    else
      frame.joints.push_back({there, end.node});
  }
  const double shortest = mass.domain.tolerance(), inwards = 1e-6 * opening.perimeter();
  for (const detail::OutlinePart& part : detail::outline_parts(opening, nodes, shortest)) {
    const Vec2 normal = normalized(perpendicular(part.edge.end - part.edge.start));
    if (part.edge.length() > 4 * inwards)
      detail::require_excavated(mass, Vec2(part.edge.centre() + inwards * normal));
    frame.panels.push_back({part.node, part.edge});
  }
  detail::LiningOnWall<Planar> wall(mass, opening, nodes, ring.fill_depth, fallen);
  wall.put_on(frame, [](int node, auto&& part, auto&& add) { add(node, part); });
  return frame;
}

#endif

}  // namespace voussoir
