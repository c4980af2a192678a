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
/// Node k stands for a stretch of the outline divided evenly, symmetrically about the crown, and
/// lies in its middle: with as many nodes as facets of a circle, on the middle of each facet. Every
/// piece of wall behind its stretch touches it at one point, so a uniform pressure loads the node
/// without turning it. On a partial ring a node is there if its angle lies in the arc.
///
/// @param opening  that is lined; its outline may be that of a section taken out in rounds
/// @throws InvalidInput  a value out of range; no opening; fewer than two nodes in the arc; rock
///                       that is not yet excavated where a node would be, or no rock at all because
///                       that is outside the domain
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                               const SimplePolygon& opening,
                                                               const LiningRing& ring);
/// The same on the wall of the last opening.
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                               const LiningRing& ring);

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

/// The end of an arc, as far as half a stretch beyond its last node, and the rock that it may stand
/// on: what is under the lining within a stretch, else what is straight ahead or beside; else,
/// where a piece of the wall has been left out because it is too small for a block, what is nearest
/// behind it within a stretch, for concrete fills such a hole.
/// @param direction  in which the end goes on;  @param inward  at right angles, into the opening
/// @param end  its node, neighbour, the place of the node and the length are given
template <class Geometry>
[[nodiscard]] LiningEnd<Geometry> founded(const RockMass<Geometry>& mass, LiningEnd<Geometry> end,
                                          const Vec<Geometry::dim>& direction,
                                          const Vec<Geometry::dim>& inward, double stretch) {
  using Point = Vec<Geometry::dim>;
  const Point last = end.place + 0.5 * stretch * direction;
  end.place = last;
  end.direction = direction;
  end.body = -1;
  const auto look = [&](double ahead, double side) {
    if (end.body >= 0) return;
    const Point here = last + stretch * (ahead * direction + side * inward);
    end.body = body_at<Geometry>(mass, here);
    if (end.body >= 0) end.place = here;
  };
  const double distances[] = {0.05, 0.35, 0.65, 1};
  for (const double ahead : distances) look(ahead, 0.05);
  look(0.05, -0.05);
  look(0.05, 0);
  if (end.body >= 0) return end;
  for (const double behind : distances) {
    for (const double ahead : distances)
      if (ahead <= behind) look(ahead, -behind);
    for (const double side : distances)
      if (side < behind) look(behind, -side);
  }
  if (end.body >= 0) end.place = last + 0.05 * stretch * direction;  // the foot is on the axis
  return end;
}

}  // namespace detail

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                 const LiningRing& ring) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  return lining_frame(mass, mass.openings.back(), ring);
}

VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                 const SimplePolygon& opening,
                                                 const LiningRing& ring) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  const detail::RingNodes nodes = detail::ring_nodes(opening, ring);
  LiningFrame<Planar> frame;
  frame.nodes = nodes.places;
  frame.centre = ring.centre.value_or(centre_of(opening));
  frame.count_on_outline = ring.nodes.value_or(default_lining_nodes);
  for (std::size_t n = 0; n < nodes.places.size(); ++n)
    if (nodes.joined[n])
      frame.members.push_back(
          {static_cast<int>(n), n + 1 == nodes.places.size() ? 0 : static_cast<int>(n) + 1});
  for (const auto& neighbour : nodes.neighbours) {
    const auto there = static_cast<int>(frame.nodes.size() + frame.neighbours.size());
    frame.neighbours.push_back(neighbour.place);
    if (const auto direction = nodes.direction_of(neighbour)) {
      const Vec2 inward =
          neighbour.is_after ? perpendicular(*direction) : Vec2(-perpendicular(*direction));
      frame.ends.push_back(detail::founded<Planar>(
          mass,
          {neighbour.node, static_cast<int>(frame.neighbours.size()) - 1, -1,
           nodes.places[static_cast<std::size_t>(neighbour.node)], *direction},
          *direction, inward, nodes.stretch));
    }
    if (neighbour.is_after)
      frame.joints.push_back({neighbour.node, there});
    else
      frame.joints.push_back({there, neighbour.node});
  }
  const double shortest = mass.domain.tolerance(), inwards = 1e-6 * opening.perimeter();
  for (const detail::OutlinePart& part : detail::outline_parts(opening, nodes, shortest)) {
    const Vec2 normal = normalized(perpendicular(part.edge.end - part.edge.start));
    if (part.edge.length() > 4 * inwards)
      detail::require_excavated(mass, Vec2(part.edge.centre() + inwards * normal));
    frame.panels.push_back({part.node, part.edge});
  }
  detail::LiningOnWall<Planar> wall(mass, opening, nodes, ring.fill_depth);
  wall.put_on(frame, [](int node, auto&& part, auto&& add) { add(node, part); });
  return frame;
}

#endif

}  // namespace voussoir
