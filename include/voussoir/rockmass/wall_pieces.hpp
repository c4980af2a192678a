// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/opening_box.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// A piece of the wall of an opening: the body behind it and where it lies.
template <class Geometry>
struct WallPiece {
  int body;
  typename Geometry::Facet facet;
  int edge;         ///< index of the outline edge
  double from, to;  ///< arc length along the outline, anticlockwise from vertex 0 [m]
};

/// The faces of the remaining rock that lie on the outline of an opening, in the order of the
/// outline. Where a piece of rock was dropped there is a gap, and where the outline runs through
/// another opening. The opening need not be one that was carved: the outline of a section that was
/// taken out in rounds has the wall that these left.
///
/// Found by their place, not by the cut they come from: where the outline runs along a joint, the
/// wall is a face of that joint.
///
/// @cost  one bounding test per body; faces x outline edges near the opening only
[[nodiscard]] VOUSSOIR_INLINE std::vector<WallPiece<Planar>> wall_pieces(
    const RockMass<Planar>& mass, const SimplePolygon& opening);

/// The same in 3-D: pieces of the faces of the rock on the sides of the opening (not on its ends);
/// `from` and `to` are those of the edge that they belong to.
[[nodiscard]] VOUSSOIR_INLINE std::vector<WallPiece<Spatial>> wall_pieces(
    const RockMass<Spatial>& mass, const PrismaticOpening& opening);

/// Those of the last opening; none before one was carved.
template <class Geometry>
[[nodiscard]] std::vector<WallPiece<Geometry>> wall_pieces(const RockMass<Geometry>& mass) {
  if (mass.openings.empty()) return {};
  return wall_pieces(mass, mass.openings.back());
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<WallPiece<Planar>> wall_pieces(const RockMass<Planar>& mass,
                                                           const SimplePolygon& opening) {
  const double tolerance = mass.domain.tolerance();
  std::vector<double> start(opening.size() + 1, 0.0);
  for (std::size_t e = 0; e < opening.size(); ++e)
    start[e + 1] = start[e] + opening.edge(e).length();
  const detail::OpeningBox box(opening, tolerance);
  std::vector<WallPiece<Planar>> pieces;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const ConvexPolygon& part : mass.bodies[b].parts) {
      if (box.is_apart_from(part)) continue;
      for (std::size_t k = 0; k < part.size(); ++k)
        for (std::size_t e = 0; e < opening.size(); ++e) {
          const Segment edge = opening.edge(e), face = part.face(k);
          const Vec2 along = (edge.end - edge.start) / edge.length();
          // The outline is anticlockwise round the opening, the face round the rock: opposite ways.
          const double from = std::max(0.0, dot_product(along, face.end - edge.start));
          const double to = std::min(edge.length(), dot_product(along, face.start - edge.start));
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
  std::vector<double> starts;
  starts.reserve(pieces.size());
  for (const auto& piece : pieces) starts.push_back(piece.from);
  std::vector<WallPiece<Planar>> along;
  along.reserve(pieces.size());
  for (const std::size_t k : order_of_values(starts)) along.push_back(pieces[k]);
  VOUSSOIR_ASSERT(along.empty() || (along.front().from >= 0 && along.back().from <= start.back()),
                  "pieces of wall lie on the outline");
  return along;
}

VOUSSOIR_INLINE std::vector<WallPiece<Spatial>> wall_pieces(const RockMass<Spatial>& mass,
                                                            const PrismaticOpening& opening) {
  const SimplePolygon& section = opening.section();
  const double tolerance = mass.domain.tolerance();
  std::vector<double> start(section.size() + 1, 0.0);
  for (std::size_t e = 0; e < section.size(); ++e)
    start[e + 1] = start[e] + section.edge(e).length();
  const detail::OpeningBox box(opening, tolerance);
  std::vector<JointPlane> sides;
  for (std::size_t e = 0; e < section.size(); ++e)
    sides.push_back(detail::outline_piece(opening, e, mass.domain));
  std::vector<std::vector<WallPiece<Spatial>>> at_edge(section.size());
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const ConvexPolyhedron& part : mass.bodies[b].parts) {
      if (box.is_apart_from(part)) continue;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const SpatialFacet face = part.face(k);
        const Vec3 normal = part.half_space(k).normal;
        for (std::size_t e = 0; e < section.size(); ++e) {
          // The face looks into the opening: the same way as the half space on its left.
          if (!(dot_product(normal, sides[e].plane.normal) < -0.5)) continue;
          if (std::any_of(face.vertices.begin(), face.vertices.end(), [&](const Vec3& v) {
                return std::abs(sides[e].plane.distance(v)) > tolerance;
              }))
            continue;
          // Towards the rock, as the left side of a planar facet.
          const auto common = detail::common_part(face, {sides[e].corners}, tolerance);
          if (!common || common->area() <= tolerance * std::sqrt(face.measure())) continue;
          SpatialFacet facet;
          for (std::size_t c = common->corners.size(); c-- > 0;)
            facet.vertices.push_back(common->corners[c]);
          at_edge[e].push_back(
              {static_cast<int>(b), std::move(facet), static_cast<int>(e), start[e], start[e + 1]});
        }
      }
    }
  std::vector<WallPiece<Spatial>> pieces;
  for (auto& of_edge : at_edge)
    for (auto& piece : of_edge) pieces.push_back(std::move(piece));
  return pieces;
}

#endif

}  // namespace voussoir
