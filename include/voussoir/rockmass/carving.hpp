// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/welding.hpp>

namespace voussoir {

namespace detail {

/// True if the segment runs through the inside of the polygon, further than `tolerance`.
[[nodiscard]] inline bool crosses(const ConvexPolygon& shape, const Segment& segment,
                                  double tolerance) {
  std::optional<Segment> inside = segment;
  for (std::size_t k = 0; inside && k < shape.size(); ++k)
    inside = split(*inside, shape.half_space(k), tolerance).below;
  return inside && inside->length() > tolerance;
}

[[nodiscard]] inline std::pair<Vec2, Vec2> bounding_box(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {low, high};
}

/// True if the polygon's bounding box does not meet the given one.
[[nodiscard]] inline bool apart(const ConvexPolygon& shape, const Vec2& low, const Vec2& high) {
  const auto [a, b] = bounding_box(shape.vertices());
  return (a.array() > high.array()).any() || (b.array() < low.array()).any();
}

/// True if two faces of one cut touch over more than `tolerance`.
[[nodiscard]] inline bool overlap(const Segment& a, const Segment& b, double tolerance) {
  const Vec2 along = (a.end - a.start).normalized();
  const double a1 = a.length(), b0 = along.dot(b.start - a.start), b1 = along.dot(b.end - a.start);
  return std::min(a1, std::max(b0, b1)) - std::max(0.0, std::min(b0, b1)) > tolerance;
}

/// Sorts parts into connected groups: parts are connected if they share a piece of face.
[[nodiscard]] inline std::vector<std::vector<ConvexPolygon>> connected_groups(
    const std::vector<ConvexPolygon>& parts, double tolerance) {
  std::vector<std::size_t> group(parts.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      bool touch = false;
      for (std::size_t a = 0; !touch && a < parts[i].size(); ++a)
        for (std::size_t b = 0; !touch && b < parts[j].size(); ++b)
          touch = parts[i].cut(a) == parts[j].cut(b) &&
                  overlap(parts[i].face(a), parts[j].face(b), tolerance);
      if (touch) {
        const std::size_t from = group[i], to = group[j];
        std::replace(group.begin(), group.end(), from, to);
      }
    }
  std::vector<std::vector<ConvexPolygon>> groups;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    std::vector<ConvexPolygon> members;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (group[i] == g) members.push_back(parts[i]);
    if (!members.empty()) groups.push_back(std::move(members));
  }
  return groups;
}

}  // namespace detail

/// Takes an opening out of the rock by slicing along its outline.
///
/// The pieces of a block that remain outside stay one rigid body as long as they touch each other;
/// where a block falls apart each connected group becomes a body of its own. Outline cuts do not
/// obey the block limits, so bodies at the wall smaller than `smallest` are dropped, and counted.
///
/// @param smallest  area below which a body at the wall is dropped [m^2]
/// @throws InvalidInput  the opening is not inside the domain, or nothing would be left
/// @cost  one bounding test per body; polygon cuts near the outline only
///
/// Source: the clump variant of Boon's block generator (construction joints). Removing whole blocks
/// by their centroid leaves a ragged wall; making every piece a body leaves slivers that fall.
[[nodiscard]] inline RockMass<Planar> carve(RockMass<Planar> mass, const SimplePolygon& opening,
                                            double smallest) {
  const Domain<2>& domain = mass.domain;
  for (const Vec2& v : opening.vertices())
    if (!((v.array() > domain.low.array()).all() && (v.array() < domain.high.array()).all()))
      throw InvalidInput("opening: its outline touches or leaves the domain at " + text_of<2>(v) +
                         " m");
  const double tolerance = domain.tolerance();
  const std::pair<Vec2, Vec2> box = detail::bounding_box(opening.vertices());
  CarvingReport& report = mass.carving;
  std::vector<Body<Planar>> kept;
  kept.reserve(mass.bodies.size());
  for (Body<Planar>& body : mass.bodies) {
    if (std::all_of(body.parts.begin(), body.parts.end(), [&](const ConvexPolygon& part) {
          return detail::apart(part, box.first, box.second);
        })) {
      kept.push_back(std::move(body));
      continue;
    }
    std::vector<ConvexPolygon> pieces = body.parts;
    for (std::size_t e = 0; e < opening.size(); ++e) {
      const Segment edge = opening.edge(e);
      const std::size_t count = pieces.size();
      for (std::size_t p = 0; p < count; ++p) {
        if (!detail::crosses(pieces[p], edge, tolerance)) continue;
        const auto line = left_of(edge.start, edge.end);
        auto parts = pieces[p].split(line, static_cast<int>(mass.cuts.size()), tolerance);
        if (!parts) continue;
        mass.cuts.push_back({Cut::Kind::outline, static_cast<int>(e)});
        pieces[p] = std::move(parts->first);
        pieces.push_back(std::move(parts->second));
      }
    }
    const std::size_t before = pieces.size();
    std::erase_if(pieces, [&](const ConvexPolygon& piece) {
      const MassProperties<2> properties = mass_properties(piece);
      const bool inside = opening.contains(properties.centroid);
      if (inside) report.removed_measure += properties.measure;
      return inside;
    });
    if (pieces.size() == before && pieces.size() == body.parts.size()) {
      kept.push_back(std::move(body));
      continue;
    }
    if (pieces.empty()) {
      ++report.removed_bodies;
      continue;
    }
    ++report.cut_bodies;
    auto groups = detail::connected_groups(pieces, tolerance);
    report.separated_bodies += groups.size() - 1;
    for (auto& group : groups) {
      Body<Planar> rest;
      rest.properties = mass_properties(group);
      rest.parts = std::move(group);
      if (rest.properties.measure < smallest) {
        ++report.dropped_pieces;
        report.dropped_measure += rest.properties.measure;
      } else {
        kept.push_back(std::move(rest));
      }
    }
  }
  if (kept.empty()) throw InvalidInput("opening: no rock is left around it");
  weld(kept, tolerance);
  mass.bodies = std::move(kept);
  mass.openings.push_back(opening);
  return mass;
}

/// A piece of the wall of an opening: the body behind it and where it lies.
template <class Geometry>
struct WallPiece {
  int body;
  typename Geometry::Facet facet;
  int edge;         ///< index of the outline edge
  double from, to;  ///< arc length along the outline, anticlockwise from vertex 0 [m]
};

/// The faces of the remaining rock that lie on the outline of the last opening, in the order of
/// the outline. Where a piece of rock was dropped there is a gap.
///
/// Found by their place, not by the cut they come from: where the outline runs along a joint, the
/// wall is a face of that joint.
///
/// @cost  one bounding test per body; faces x outline edges near the opening only
[[nodiscard]] inline std::vector<WallPiece<Planar>> wall_pieces(const RockMass<Planar>& mass) {
  if (mass.openings.empty()) return {};
  const SimplePolygon& opening = mass.openings.back();
  const double tolerance = mass.domain.tolerance();
  std::vector<double> start(opening.size() + 1, 0.0);
  for (std::size_t e = 0; e < opening.size(); ++e)
    start[e + 1] = start[e] + opening.edge(e).length();
  auto [low, high] = detail::bounding_box(opening.vertices());
  low.array() -= tolerance;
  high.array() += tolerance;
  std::vector<WallPiece<Planar>> pieces;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const ConvexPolygon& part : mass.bodies[b].parts) {
      if (detail::apart(part, low, high)) continue;
      for (std::size_t k = 0; k < part.size(); ++k)
        for (std::size_t e = 0; e < opening.size(); ++e) {
          const Segment edge = opening.edge(e), face = part.face(k);
          const Vec2 along = (edge.end - edge.start) / edge.length();
          // The outline is anticlockwise round the opening, the face round the rock: opposite ways.
          const double from = std::max(0.0, along.dot(face.end - edge.start));
          const double to = std::min(edge.length(), along.dot(face.start - edge.start));
          if (to - from <= tolerance) continue;
          const HalfSpace<2> line = left_of(edge.start, edge.end);
          if (std::abs(line.distance(face.start)) > tolerance ||
              std::abs(line.distance(face.end)) > tolerance)
            continue;
          pieces.push_back({static_cast<int>(b),
                            {edge.start + from * along, edge.start + to * along},
                            static_cast<int>(e),
                            start[e] + from,
                            start[e] + to});
        }
    }
  std::sort(pieces.begin(), pieces.end(),
            [](const auto& a, const auto& b) { return a.from < b.from; });
  return pieces;
}

}  // namespace voussoir
