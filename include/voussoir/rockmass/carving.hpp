// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/welding.hpp>

namespace voussoir {

namespace detail {

// What carving asks of an opening, in 2-D and 3-D: its outline piece by piece, and
// whether a piece runs through the inside of a block.

[[nodiscard]] inline Segment outline_piece(const SimplePolygon& opening, std::size_t k,
                                           const Domain<2>&) {
  return opening.edge(k);
}
[[nodiscard]] inline JointPlane outline_piece(const PrismaticOpening& opening, std::size_t k,
                                              const Domain<3>& domain) {
  return opening.side(k, largest_entry(larger_of(magnitudes(domain.low), magnitudes(domain.high))) +
                             domain.diameter());
}
[[nodiscard]] inline HalfSpace<2> plane_of(const Segment& edge) {
  return left_of(edge.start, edge.end);
}
[[nodiscard]] inline const HalfSpace<3>& plane_of(const JointPlane& side) { return side.plane; }

/// True if the piece runs through the inside of the shape, further than `tolerance`.
[[nodiscard]] inline bool crosses(const ConvexPolygon& shape, const Segment& segment,
                                  double tolerance) {
  std::optional<Segment> inside = segment;
  for (std::size_t k = 0; inside && k < shape.size(); ++k)
    inside = split(*inside, shape.half_space(k), tolerance).below;
  return inside && inside->length() > tolerance;
}
[[nodiscard]] inline bool crosses(const ConvexPolyhedron& shape, const JointPlane& side,
                                  double tolerance) {
  std::optional<JointPlane> inside = side;
  for (std::size_t k = 0; inside && k < shape.size(); ++k)
    inside = split(std::move(*inside), shape.half_space(k), tolerance).below;
  return inside && inside->area() > tolerance * tolerance;
}

template <int Dim>
[[nodiscard]] std::pair<Vec<Dim>, Vec<Dim>> bounding_box(const std::vector<Vec<Dim>>& points) {
  Vec<Dim> low = points.front(), high = low;
  for (const Vec<Dim>& p : points) {
    low = smaller_of(low, p);
    high = larger_of(high, p);
  }
  return {low, high};
}
[[nodiscard]] inline std::pair<Vec2, Vec2> box_of(const SimplePolygon& opening) {
  return bounding_box<2>(opening.vertices());
}
[[nodiscard]] inline std::pair<Vec3, Vec3> box_of(const PrismaticOpening& opening) {
  const auto [low, high] = bounding_box<2>(opening.section().vertices());
  return {PrismaticOpening::in_space(low, opening.from()),
          PrismaticOpening::in_space(high, opening.to())};
}

/// True if the bounding box of the shape does not meet the given one.
template <class Shape, int Dim = Shape::dim>
[[nodiscard]] bool apart(const Shape& shape, const Vec<Dim>& low, const Vec<Dim>& high) {
  const auto [a, b] = bounding_box<Dim>(shape.vertices());
  return any_less(high, a) || any_less(b, low);
}

/// Refuses an opening that leaves the domain.
inline void check_inside(const SimplePolygon& opening, const Domain<2>& domain) {
  for (const Vec2& v : opening.vertices())
    if (!(all_less(domain.low, v) && all_less(v, domain.high)))
      throw InvalidInput(
          message({"opening: its outline touches or leaves the domain at ", text_of<2>(v), " m"}));
}
VOUSSOIR_INLINE void check_inside(const PrismaticOpening& opening, const Domain<3>& domain);

/// True if two faces of one cut touch over more than `tolerance`.
[[nodiscard]] inline bool overlap(const Segment& a, const Segment& b, double tolerance) {
  const Vec2 along = normalized(a.end - a.start);
  const double a1 = a.length(), b0 = dot_product(along, b.start - a.start),
               b1 = dot_product(along, b.end - a.start);
  return std::min(a1, std::max(b0, b1)) - std::max(0.0, std::min(b0, b1)) > tolerance;
}
/// The part of a face inside the prism over another, which faces the other way.
[[nodiscard]] VOUSSOIR_INLINE std::optional<JointPlane> common_part(const SpatialFacet& a,
                                                                    const SpatialFacet& b,
                                                                    double tolerance);
[[nodiscard]] inline bool overlap(const SpatialFacet& a, const SpatialFacet& b, double tolerance) {
  const auto common = common_part(a, b, tolerance);
  return common && common->area() > tolerance * std::sqrt(a.measure());
}

/// Sorts parts into connected groups: parts are connected if they share a piece of face.
template <class Shape>
[[nodiscard]] std::vector<std::vector<Shape>> connected_groups(const std::vector<Shape>& parts,
                                                               double tolerance) {
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
  std::vector<std::vector<Shape>> groups;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    std::vector<Shape> members;
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
/// New corners are welded with the corners nearby; bodies that no edge of the outline cuts stay as
/// they are, bit for bit. Of which body each is what is left: `RockMass::origins`.
///
/// @param smallest  area (2-D) or volume (3-D) below which a body at the wall is dropped [m^2],
///                  [m^3]
/// @throws InvalidInput  the opening is not inside the domain, or nothing would be left
/// @throws Stopped
/// @cost  one bounding test per body; cuts near the outline only
///
/// Source: the clump variant of Boon's block generator (construction joints). Removing whole blocks
/// by their centroid leaves a ragged wall; making every piece a body leaves slivers that fall.
template <class Geometry>
[[nodiscard]] RockMass<Geometry> carve(RockMass<Geometry> mass,
                                       const typename Geometry::Opening& opening, double smallest,
                                       const Progress& progress = {}) {
  constexpr int dim = Geometry::dim;
  using Shape = typename Geometry::Shape;
  const Domain<dim>& domain = mass.domain;
  detail::check_inside(opening, domain);
  const double tolerance = domain.tolerance();
  auto box = detail::box_of(opening);
  // So that whoever has a corner within the tolerance of a new one is looked at.
  box = {shifted_by(box.first, -2 * tolerance), shifted_by(box.second, 2 * tolerance)};
  std::vector<decltype(detail::outline_piece(opening, 0, domain))> outline;
  for (std::size_t e = 0; e < opening.size(); ++e)
    outline.push_back(detail::outline_piece(opening, e, domain));
  CarvingReport& report = mass.carving;
  std::vector<Body<Geometry>> kept;
  kept.reserve(mass.bodies.size());
  mass.origins.clear();
  const auto keep = [&](Body<Geometry> body, std::size_t origin) {
    kept.push_back(std::move(body));
    mass.origins.push_back(static_cast<int>(origin));
  };
  std::vector<std::size_t> beside, cut;  // indices of kept bodies
  StopCheck stop(progress);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    Body<Geometry>& body = mass.bodies[b];
    stop();
    if (std::all_of(body.parts.begin(), body.parts.end(), [&](const Shape& part) {
          return detail::apart(part, box.first, box.second);
        })) {
      keep(std::move(body), b);
      continue;
    }
    std::vector<Shape> pieces = body.parts;
    for (std::size_t e = 0; e < outline.size(); ++e) {
      const std::size_t count = pieces.size();
      for (std::size_t p = 0; p < count; ++p) {
        if (!detail::crosses(pieces[p], outline[e], tolerance)) continue;
        auto parts = pieces[p].split(detail::plane_of(outline[e]),
                                     static_cast<int>(mass.cuts.size()), tolerance);
        if (!parts) continue;
        mass.cuts.push_back({Cut::Kind::outline, static_cast<int>(e)});
        pieces[p] = std::move(parts->first);
        pieces.push_back(std::move(parts->second));
      }
    }
    const std::size_t before = pieces.size();
    std::erase_if(pieces, [&](const Shape& piece) {
      const MassProperties<dim> properties = mass_properties(piece);
      const bool inside = opening.contains(properties.centroid);
      if (inside) report.removed_measure += properties.measure;
      return inside;
    });
    if (pieces.size() == before && pieces.size() == body.parts.size()) {
      beside.push_back(kept.size());
      keep(std::move(body), b);
      continue;
    }
    if (pieces.empty()) {
      ++report.removed_bodies;
      continue;
    }
    VOUSSOIR_ASSERT(pieces.size() >= body.parts.size() || pieces.size() < before,
                    "an outline cuts pieces, and takes out whole ones");
    ++report.cut_bodies;
    auto groups = detail::connected_groups(pieces, tolerance);
    VOUSSOIR_ASSERT(!groups.empty() && groups.size() <= pieces.size(),
                    "every piece is in one group");
    report.separated_bodies += groups.size() - 1;
    for (auto& group : groups) {
      Body<Geometry> rest;
      rest.properties = mass_properties(group);
      rest.parts = std::move(group);
      if (rest.properties.measure < smallest) {
        ++report.dropped_pieces;
        report.dropped_measure += rest.properties.measure;
      } else {
        cut.push_back(kept.size());
        keep(std::move(rest), b);
      }
    }
  }
  if (kept.empty()) throw InvalidInput("opening: no rock is left around it");
  VertexWelder<dim> welder(tolerance);
  for (const auto* bodies : {&beside, &cut})
    for (const std::size_t k : *bodies)
      for (Shape& part : kept[k].parts) part.move_vertices(welder);
  VOUSSOIR_ASSERT(mass.origins.size() == kept.size(), "every body has one that it comes from");
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
[[nodiscard]] VOUSSOIR_INLINE std::vector<WallPiece<Planar>> wall_pieces(
    const RockMass<Planar>& mass);

/// The same in 3-D: pieces of the faces of the rock on the sides of the last opening (not on its
/// ends); `from` and `to` are those of the edge that they belong to.
[[nodiscard]] VOUSSOIR_INLINE std::vector<WallPiece<Spatial>> wall_pieces(
    const RockMass<Spatial>& mass);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE void check_inside(const PrismaticOpening& opening, const Domain<3>& domain) {
  for (const Vec2& v : opening.section().vertices())
    if (!(v.x() > domain.low.x() && v.x() < domain.high.x() && v.y() > domain.low.z() &&
          v.y() < domain.high.z()))
      throw InvalidInput(
          "opening: its section touches or leaves the domain at x, z = " + text_of<2>(v) + " m");
  if (!(opening.to() > domain.low.y() && opening.from() < domain.high.y()))
    throw InvalidInput("opening: it lies beside the domain, which reaches from " +
                       message_number(domain.low.y()) + " to " + message_number(domain.high.y()) +
                       " m along y");
}

VOUSSOIR_INLINE std::optional<JointPlane> common_part(const SpatialFacet& a, const SpatialFacet& b,
                                                      double tolerance) {
  const Vec3 normal = normalized(a.area_vector());
  std::optional<JointPlane> rest =
      JointPlane{HalfSpace<3>::through(a.vertices.front(), normal), a.vertices};
  const Vec3 other = normalized(b.area_vector());
  for (std::size_t k = 0; rest && k < b.vertices.size(); ++k) {
    const Vec3 &from = b.vertices[k], &to = b.vertices[k + 1 == b.vertices.size() ? 0 : k + 1];
    const Vec3 out = cross(Vec3(to - from), other);
    if (!(length_of(out) > tolerance)) continue;
    rest = split(std::move(*rest), HalfSpace<3>::through(from, normalized(out)), tolerance).below;
  }
  return rest;
}

}  // namespace detail

VOUSSOIR_INLINE std::vector<WallPiece<Planar>> wall_pieces(const RockMass<Planar>& mass) {
  if (mass.openings.empty()) return {};
  const SimplePolygon& opening = mass.openings.back();
  const double tolerance = mass.domain.tolerance();
  std::vector<double> start(opening.size() + 1, 0.0);
  for (std::size_t e = 0; e < opening.size(); ++e)
    start[e + 1] = start[e] + opening.edge(e).length();
  auto [low, high] = detail::bounding_box(opening.vertices());
  low = shifted_by(low, -tolerance);
  high = shifted_by(high, tolerance);
  std::vector<WallPiece<Planar>> pieces;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const ConvexPolygon& part : mass.bodies[b].parts) {
      if (detail::apart(part, low, high)) continue;
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

VOUSSOIR_INLINE std::vector<WallPiece<Spatial>> wall_pieces(const RockMass<Spatial>& mass) {
  if (mass.openings.empty()) return {};
  const PrismaticOpening& opening = mass.openings.back();
  const SimplePolygon& section = opening.section();
  const double tolerance = mass.domain.tolerance();
  std::vector<double> start(section.size() + 1, 0.0);
  for (std::size_t e = 0; e < section.size(); ++e)
    start[e + 1] = start[e] + section.edge(e).length();
  auto [low, high] = detail::box_of(opening);
  low = shifted_by(low, -tolerance);
  high = shifted_by(high, tolerance);
  std::vector<JointPlane> sides;
  for (std::size_t e = 0; e < section.size(); ++e)
    sides.push_back(detail::outline_piece(opening, e, mass.domain));
  std::vector<std::vector<WallPiece<Spatial>>> at_edge(section.size());
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const ConvexPolyhedron& part : mass.bodies[b].parts) {
      if (detail::apart(part, low, high)) continue;
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
