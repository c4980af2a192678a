// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/solver/solver.hpp>

namespace voussoir {

/// A lining along the wall: the full ring, or an arc of it.
struct LiningRing {
  int nodes = 72;                    ///< on the full outline; evenly spaced, 8 to 2000
  double from = 0;                   ///< [rad], anticlockwise from the right-hand springing
  double to = 2 * std::numbers::pi;  ///< [rad], from < to <= from + 2 pi
};

/// Nodes and members of a ring, and its contact with the wall that `carve` left.
///
/// Node k stands for the stretch [k, k + 1] of the outline divided evenly, and lies in its middle:
/// with as many nodes as facets of a circle, on the middle of each facet. Every piece of wall in
/// its stretch touches it at one point, so a uniform pressure loads the node without turning it.
/// On a partial ring a node is there if its angle lies in the arc.
///
/// @throws InvalidInput  a value out of range; no opening; fewer than two nodes in the arc
[[nodiscard]] inline LiningFrame<Planar> lining_frame(const RockMass<Planar>& mass,
                                                      const LiningRing& ring) {
  require(ring.nodes >= 8 && ring.nodes <= 2000, "lining nodes", ring.nodes, "8 to 2000");
  const double circle = 2 * std::numbers::pi, arc = ring.to - ring.from;
  require(arc > 0 && arc <= circle * (1 + 1e-12), "lining arc", arc, "> 0 and <= 2 pi rad");
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  const SimplePolygon& opening = mass.openings.back();
  const double stretch = opening.perimeter() / ring.nodes;
  const auto point_at = [&](double s) {
    for (std::size_t e = 0; e < opening.size(); ++e) {
      const Segment edge = opening.edge(e);
      if (s <= edge.length() || e + 1 == opening.size()) return edge.at(s / edge.length());
      s -= edge.length();
    }
    return opening.vertices().front();
  };
  const bool closed = arc > circle * (1 - 1e-9);
  LiningFrame<Planar> frame;
  std::vector<int> number(static_cast<std::size_t>(ring.nodes), -1);
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
    const int node = static_cast<int>(frame.nodes.size());
    number[static_cast<std::size_t>(k)] = node;
    frame.nodes.push_back(p);
    // An outline that turns back can leave the arc and come again: no member across the gap.
    const int before = number[static_cast<std::size_t>((k + ring.nodes - 1) % ring.nodes)];
    if (before >= 0 && before == node - 1) frame.members.emplace_back(before, node);
  }
  if (frame.nodes.size() < 2) throw InvalidInput("lining: fewer than two nodes lie in the arc");
  if (closed) frame.members.emplace_back(static_cast<int>(frame.nodes.size()) - 1, 0);
  const double shortest = mass.domain.tolerance();
  for (const WallPiece<Planar>& wall : wall_pieces(mass)) {
    const auto first = static_cast<int>(std::floor(wall.from / stretch));
    for (int k = std::max(0, first); k < ring.nodes && k * stretch < wall.to; ++k) {
      const double from = std::max(wall.from, k * stretch),
                   to = std::min(wall.to, (k + 1) * stretch);
      const int node = number[static_cast<std::size_t>(k)];
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

}  // namespace voussoir
