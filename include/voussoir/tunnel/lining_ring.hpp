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
#include <voussoir/core/errors.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>

namespace voussoir {

/// A lining along the wall: the full ring, or an arc of it.
struct LiningRing {
  int nodes = 72;                    ///< on the full outline; evenly spaced, 8 to 2000
  double from = 0;                   ///< [rad], anticlockwise from the right-hand springing
  double to = 2 * std::numbers::pi;  ///< [rad], from < to <= from + 2 pi
};

namespace detail {

/// Where the nodes of a ring lie on an outline: node k stands for the stretch [k, k + 1] of it and
/// lies in its middle.
///
/// Stretches are counted anticlockwise from `offset` behind vertex 0 of the outline, so the last
/// one may reach past vertex 0. The offset is such that a stretch ends at the crown if that is a
/// corner, else a node lies there: whichever vertex an outline begins with, and in the mirror, the
/// nodes are the same.
struct RingNodes {
  double stretch;            ///< [m]
  double offset;             ///< 0 <= offset < stretch [m]
  bool closed;               ///< all the way round
  std::vector<Vec2> places;  ///< of those in the arc, neighbours one after the other [m]
  std::vector<int> number;   ///< for every stretch, index into `places`, or -1

  std::vector<char> joined;  ///< for every node, whether a member joins it and the next

  /// The first stretch that reaches beyond a place on the outline; -1: the last one, of which the
  /// end lies behind vertex 0.
  [[nodiscard]] int first_beyond(double s) const {
    return static_cast<int>(std::floor((s - offset) / stretch));
  }
  [[nodiscard]] double begin(int k) const { return offset + k * stretch; }
  /// @return  index into `places`, or -1
  [[nodiscard]] int node_of(int k) const {
    const auto count = static_cast<int>(number.size());
    return k < count ? number[static_cast<std::size_t>(k < 0 ? k + count : k)] : -1;
  }
};

/// @throws InvalidInput  a value out of range; fewer than two nodes in the arc
[[nodiscard]] VOUSSOIR_INLINE RingNodes ring_nodes(const SimplePolygon& opening,
                                                   const LiningRing& ring);

/// A straight part of the outline in the stretch of one node, opening on its left.
struct OutlinePart {
  int node;
  Segment edge;
};
/// @param shortest  parts that are no longer are left out [m]
[[nodiscard]] VOUSSOIR_INLINE std::vector<OutlinePart> outline_parts(const SimplePolygon& opening,
                                                                     const RingNodes& nodes,
                                                                     double shortest);

}  // namespace detail

/// Nodes and members of a ring, and its contact with the wall that `carve` left.
///
/// Node k stands for a stretch of the outline divided evenly, symmetrically about the crown, and
/// lies in its middle: with as many nodes as facets of a circle, on the middle of each facet. Every
/// piece of wall in its stretch touches it at one point, so a uniform pressure loads the node
/// without turning it. On a partial ring a node is there if its angle lies in the arc.
///
/// @throws InvalidInput  a value out of range; no opening; fewer than two nodes in the arc
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                               const LiningRing& ring);

/// A lining in 3-D: ribs, lattice girders or strips of shotcrete across the tunnel, and what
/// joins them along it.
struct LiningRibs {
  LiningRing ring{};   ///< one rib
  double spacing = 1;  ///< of the ribs along the tunnel [m], > 0
  bool tied = true;    ///< longitudinal members join the nodes of neighbouring ribs
};

/// Nodes and members of ribs over the length of the last opening inside the domain: members across
/// the tunnel have section 0, members along it section 1. Every rib stands for the rock up to half
/// its spacing on both sides; each piece of wall there touches its node at one point.
///
/// @throws InvalidInput  as `lining_frame` of a ring; spacing out of range or longer than the
/// tunnel
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Spatial> lining_frame(const RockMass<Spatial>& mass,
                                                                const LiningRibs& ribs);

#if VOUSSOIR_BODIES

namespace detail {

/// From vertex 0 to where the stretches of a ring begin, see `RingNodes`.
[[nodiscard]] inline double ring_offset(const SimplePolygon& opening, double stretch) {
  const auto& vertices = opening.vertices();
  double low = vertices.front().x(), high = low;
  for (const Vec2& v : vertices) {
    low = std::min(low, v.x());
    high = std::max(high, v.x());
  }
  // The crown: the highest point midway between the walls.
  const double middle = 0.5 * (low + high), near = 1e-9 * opening.perimeter();
  double along = 0, crown = 0, highest = -std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < opening.size(); ++e) {
    const Segment edge = opening.edge(e);
    const double from = edge.start.x() - middle, to = edge.end.x() - middle;
    const bool crosses = (from < -near && to > near) || (from > near && to < -near);
    const double part = crosses ? from / (from - to) : 0.0;
    if (crosses || std::abs(from) <= near)
      if (const double height = edge.at(part).y(); height > highest + near) {
        highest = height;
        crown = along + part * edge.length() + (crosses ? 0.5 * stretch : 0.0);
      }
    along += edge.length();
  }
  const double offset = crown - stretch * std::floor(crown / stretch);
  return offset < 1e-9 * stretch || offset > (1 - 1e-9) * stretch ? 0.0 : offset;
}

VOUSSOIR_INLINE RingNodes ring_nodes(const SimplePolygon& opening, const LiningRing& ring) {
  require(ring.nodes >= 8 && ring.nodes <= 2000, "lining nodes", ring.nodes, "8 to 2000");
  const double circle = 2 * std::numbers::pi, arc = ring.to - ring.from;
  require(arc > 0 && arc <= circle * (1 + 1e-12), "lining arc", arc, "> 0 and <= 2 pi rad");
  RingNodes nodes;
  const double stretch = nodes.stretch = opening.perimeter() / ring.nodes;
  nodes.offset = ring_offset(opening, stretch);
  const auto point_at = [&](double s) {
    s = std::fmod(s + nodes.offset, opening.perimeter());
    for (std::size_t e = 0; e < opening.size(); ++e) {
      const Segment edge = opening.edge(e);
      if (s <= edge.length() || e + 1 == opening.size()) return edge.at(s / edge.length());
      s -= edge.length();
    }
    return opening.vertices().front();
  };
  const bool closed = nodes.closed = arc > circle * (1 - 1e-9);
  nodes.number.assign(static_cast<std::size_t>(ring.nodes), -1);
  // Start behind the gap of a partial ring, so that consecutive nodes are neighbours.
  const auto inside = [&](const Vec2& p) {
    const double angle = std::atan2(p.y(), p.x()) - ring.from;
    return closed || angle - circle * std::floor(angle / circle) <= arc;
  };
  int start = 0;
  for (int k = 0; !closed && k < ring.nodes; ++k)
    if (inside(point_at((k + 0.5) * stretch)) &&
        !inside(point_at(((k + ring.nodes - 1) % ring.nodes + 0.5) * stretch)))
      start = k;
  for (int i = 0; i < ring.nodes; ++i) {
    const int k = (start + i) % ring.nodes;
    const Vec2 p = point_at((k + 0.5) * stretch);
    if (!inside(p)) continue;
    const int node = static_cast<int>(nodes.places.size());
    nodes.number[static_cast<std::size_t>(k)] = node;
    nodes.places.push_back(p);
    // An outline that turns back can leave the arc and come again: no member across the gap.
    const int before = nodes.number[static_cast<std::size_t>((k + ring.nodes - 1) % ring.nodes)];
    if (node > 0) nodes.joined.push_back(before == node - 1);
  }
  if (nodes.places.size() < 2) throw InvalidInput("lining: fewer than two nodes lie in the arc");
  nodes.joined.push_back(closed);
  return nodes;
}

VOUSSOIR_INLINE std::vector<OutlinePart> outline_parts(const SimplePolygon& opening,
                                                       const RingNodes& nodes, double shortest) {
  std::vector<OutlinePart> parts;
  double start = 0;
  for (std::size_t e = 0; e < opening.size(); ++e) {
    const Segment edge = opening.edge(e);
    const double length = edge.length();
    for (int k = nodes.first_beyond(start); nodes.begin(k) < start + length; ++k) {
      const double from = std::max(0.0, nodes.begin(k) - start);
      const double to = std::min(length, nodes.begin(k + 1) - start);
      if (nodes.node_of(k) >= 0 && to - from > shortest)
        parts.push_back({nodes.node_of(k), {edge.at(from / length), edge.at(to / length)}});
    }
    start += length;
  }
  return parts;
}

}  // namespace detail

VOUSSOIR_INLINE LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                 const LiningRing& ring) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  const detail::RingNodes nodes = detail::ring_nodes(mass.openings.back(), ring);
  LiningFrame<Planar> frame;
  frame.nodes = nodes.places;
  for (std::size_t n = 0; n < nodes.places.size(); ++n)
    if (nodes.joined[n])
      frame.members.push_back(
          {static_cast<int>(n), n + 1 == nodes.places.size() ? 0 : static_cast<int>(n) + 1});
  const double shortest = mass.domain.tolerance();
  for (const detail::OutlinePart& part :
       detail::outline_parts(mass.openings.back(), nodes, shortest))
    frame.panels.push_back({part.node, part.edge});
  for (const WallPiece<Planar>& wall : wall_pieces(mass)) {
    for (int k = nodes.first_beyond(wall.from); nodes.begin(k) < wall.to; ++k) {
      const double from = std::max(wall.from, nodes.begin(k)),
                   to = std::min(wall.to, nodes.begin(k + 1));
      const int node = nodes.node_of(k);
      if (node < 0 || to - from <= shortest) continue;
      const double length = wall.to - wall.from;
      frame.contacts.push_back(
          {node,
           wall.body,
           {wall.facet.at((from - wall.from) / length), wall.facet.at((to - wall.from) / length)}});
    }
  }
  return frame;
}

VOUSSOIR_INLINE LiningFrame<Spatial> lining_frame(const RockMass<Spatial>& mass,
                                                  const LiningRibs& ribs) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  const PrismaticOpening& opening = mass.openings.back();
  const SimplePolygon& section = opening.section();
  const detail::RingNodes nodes = detail::ring_nodes(section, ribs.ring);
  const double from = std::max(opening.from(), mass.domain.low.y()),
               to = std::min(opening.to(), mass.domain.high.y());
  require(ribs.spacing > 0 && ribs.spacing <= (to - from) * (1 + 1e-9), "spacing of ribs",
          ribs.spacing, "> 0 m and no longer than the tunnel");
  const int rows = static_cast<int>(std::floor((to - from) / ribs.spacing + 1e-9));
  const double width = (to - from) / rows;
  const int ring = static_cast<int>(nodes.places.size());
  const auto node_at = [ring](int row, int n) { return row * ring + n; };
  LiningFrame<Spatial> frame;
  for (int row = 0; row < rows; ++row)
    for (int n = 0; n < ring; ++n) {
      const auto here = static_cast<std::size_t>(n);
      const std::size_t next = n + 1 == ring ? 0 : here + 1;
      frame.nodes.push_back(
          PrismaticOpening::in_space(nodes.places[here], from + (row + 0.5) * width));
      const Vec2 along = nodes.places[next] - nodes.places[here];
      if (nodes.joined[here])
        frame.members.push_back({node_at(row, n), node_at(row, static_cast<int>(next)),
                                 PrismaticOpening::in_space(-perpendicular(along), 0), 0});
      if (ribs.tied && row > 0) {
        const std::size_t before = n == 0 ? nodes.places.size() - 1 : here - 1;
        const Vec2 chord = (nodes.joined[here] ? nodes.places[next] : nodes.places[here]) -
                           (nodes.joined[before] ? nodes.places[before] : nodes.places[here]);
        frame.members.push_back({node_at(row - 1, n), node_at(row, n),
                                 PrismaticOpening::in_space(-perpendicular(chord), 0), 1});
      }
    }
  const double tolerance = mass.domain.tolerance();
  for (const detail::OutlinePart& part : detail::outline_parts(section, nodes, tolerance))
    for (int row = 0; row < rows; ++row) {
      const auto at = [&](const Vec2& p, int end) {
        return PrismaticOpening::in_space(p, from + (row + end) * width);
      };
      const Vec2 &a = part.edge.start, &b = part.edge.end;
      frame.panels.push_back({node_at(row, part.node), {{at(a, 0), at(a, 1), at(b, 1), at(b, 0)}}});
    }
  for (const WallPiece<Spatial>& wall : wall_pieces(mass)) {
    const Segment edge = section.edge(static_cast<std::size_t>(wall.edge));
    const Vec3 along = PrismaticOpening::in_space(normalized(edge.end - edge.start), 0);
    const Vec3 begin = PrismaticOpening::in_space(edge.start, 0);
    const Vec3 normal = normalized(wall.facet.area_vector());
    for (int k = nodes.first_beyond(wall.from); nodes.begin(k) < wall.to; ++k) {
      const int node = nodes.node_of(k);
      if (node < 0) continue;
      std::optional<JointPlane> strip = JointPlane{
          HalfSpace<3>::through(wall.facet.vertices.front(), normal), wall.facet.vertices};
      const auto keep = [&](const Vec3& outward, const Vec3& on) {
        if (strip)
          strip = split(std::move(*strip), HalfSpace<3>::through(on, outward), tolerance).below;
      };
      keep(-along, begin + (nodes.begin(k) - wall.from) * along);
      keep(along, begin + (nodes.begin(k + 1) - wall.from) * along);
      for (int row = 0; strip && row < rows; ++row) {
        auto parts = split(
            std::move(*strip),
            HalfSpace<3>::through(Vec3(0, from + (row + 1) * width, 0), Vec3(0, 1, 0)), tolerance);
        if (parts.below && parts.below->area() > tolerance * nodes.stretch)
          frame.contacts.push_back({node_at(row, node), wall.body, {parts.below->corners}});
        strip = std::move(parts.above);
      }
    }
  }
  return frame;
}

#endif

}  // namespace voussoir
