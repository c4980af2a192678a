// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/tunnel/opening_centre.hpp>

namespace voussoir {

/// Nodes on the full outline of a lining: where no number is given, and at most.
inline constexpr int default_lining_nodes = 72, most_lining_nodes = 2000;
/// How far behind the outline a lining fills holes where it is not said [m].
inline constexpr double default_fill_depth = 0.5;

/// A lining along the wall: the full ring, or an arc of it about the centre of the opening. An arc
/// next to one that stands on the same outline, with as many nodes, joins it.
struct LiningRing {
  /// On the full outline, evenly spaced, 8 to 2000; none: 72, or what a bond to the rock needs
  /// (`with_chosen_nodes`, asked by `construct`).
  std::optional<int> nodes{};
  double from = 0;                   ///< [rad], anticlockwise from the right-hand springing
  double to = 2 * std::numbers::pi;  ///< [rad], from < to <= from + 2 pi
  std::optional<Vec2> centre{};      ///< about which angles are counted [m]; none: see `centre_of`
  /// Where pieces of rock were dropped (`carve`), it fills the holes up to this far behind the
  /// outline and bears on the rock there; what is deeper stays a gap, see `LiningFrame::gaps`
  /// [m], >= 0.
  double fill_depth = default_fill_depth;
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
  /// A place of the full ring next to a node at an end of an arc.
  struct Neighbour {
    int node;
    Vec2 place;     ///< [m]
    bool is_after;  ///< it follows the node, anticlockwise
  };
  std::vector<Neighbour> neighbours{};

  /// Which way an end goes on, a unit vector: that of the last member; none if the node is alone.
  [[nodiscard]] std::optional<Vec2> direction_of(const Neighbour& end) const {
    const int other = end.is_after ? end.node - 1 : end.node + 1;
    if (other < 0 || other >= static_cast<int>(places.size())) return std::nullopt;
    if (!joined[static_cast<std::size_t>(std::min(other, end.node))]) return std::nullopt;
    return normalized(places[static_cast<std::size_t>(end.node)] -
                      places[static_cast<std::size_t>(other)]);
  }
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
  const int count = ring.nodes.value_or(default_lining_nodes);
  require(count >= 8 && count <= most_lining_nodes, "lining nodes", count, "8 to 2000");
  const double circle = 2 * std::numbers::pi, arc = ring.to - ring.from;
  require(ring.fill_depth >= 0 && std::isfinite(ring.fill_depth), "fill depth of a lining",
          ring.fill_depth, ">= 0 m and finite");
  require(arc > 0 && arc <= circle * (1 + 1e-12), "lining arc", arc, "> 0 and <= 2 pi rad");
  RingNodes nodes;
  const double stretch = nodes.stretch = opening.perimeter() / count;
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
  const Vec2 centre = ring.centre.value_or(centre_of(opening));
  nodes.number.assign(static_cast<std::size_t>(count), -1);
  // Start behind the gap of a partial ring, so that consecutive nodes are neighbours.
  const auto inside = [&](const Vec2& p) {
    const double angle = elementary::angle_of(p.y() - centre.y(), p.x() - centre.x()) - ring.from;
    return closed || angle - circle * std::floor(angle / circle) <= arc;
  };
  int start = 0;
  for (int k = 0; !closed && k < count; ++k)
    if (inside(point_at((k + 0.5) * stretch)) &&
        !inside(point_at(((k + count - 1) % count + 0.5) * stretch)))
      start = k;
  for (int i = 0; i < count; ++i) {
    const int k = (start + i) % count;
    const Vec2 p = point_at((k + 0.5) * stretch);
    if (!inside(p)) continue;
    const int node = static_cast<int>(nodes.places.size());
    nodes.number[static_cast<std::size_t>(k)] = node;
    nodes.places.push_back(p);
    // An outline that turns back can leave the arc and come again: no member across the gap.
    const int before = nodes.number[static_cast<std::size_t>((k + count - 1) % count)];
    if (node > 0) nodes.joined.push_back(before == node - 1);
  }
  if (nodes.places.size() < 2) throw InvalidInput("lining: fewer than two nodes lie in the arc");
  nodes.joined.push_back(closed);
  for (int k = 0; k < count; ++k)
    for (const int step : {-1, 1}) {
      const int next = (k + step + count) % count;
      if (nodes.number[static_cast<std::size_t>(k)] >= 0 &&
          nodes.number[static_cast<std::size_t>(next)] < 0)
        nodes.neighbours.push_back({nodes.number[static_cast<std::size_t>(k)],
                                    point_at((next + 0.5) * stretch), step > 0});
    }
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

#endif

}  // namespace voussoir
