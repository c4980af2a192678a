// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/geometry/joined_facets.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/detail/connected_parts.hpp>
#include <voussoir/rockmass/detail/segment_grid.hpp>
#include <voussoir/rockmass/opening_box.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/wall_outline.hpp>

namespace voussoir {

/// A piece of the wall of an opening: the body behind it and where it lies.
template <class Geometry>
struct WallPiece {
  int body;
  typename Geometry::Facet facet;  ///< the opening on its left (2-D); looks into the rock (3-D)
  int edge;                        ///< index of the outline edge that it lies behind
  double from,
      to;  ///< places that it lies behind, along the outline anticlockwise from vertex 0 [m]
  double depth = 0;  ///< of its centre behind the edge; 0: on the outline [m]
  int hole = -1;     ///< that it bounds, an index; -1: it lies on the outline
  /// Of one that bounds a hole, in 2-D: stretches of its edge where another piece is in front of
  /// it, in order and apart, from the beginning of the edge [m].
  std::vector<std::pair<double, double>> hidden{};

  /// What of the outline, or of the area of its edges, it stands for: as wide as it is seen from
  /// the opening. Nothing where it overhangs or, in 2-D, another is in front of it: there the
  /// pieces of a wall are as long as its outline. In 3-D what overhangs comes on top [m], [m^2].
  [[nodiscard]] double seen_measure(const WallOutline& outline) const {
    return seen_measure(outline, facet);
  }
  /// Of a part of it.
  [[nodiscard]] double seen_measure(const WallOutline& outline,
                                    const typename Geometry::Facet& part) const {
    if (hole < 0) return part.measure();
    const auto e = static_cast<std::size_t>(edge);
    // In 2-D it is that of its parts together, however it is divided.
    if constexpr (Geometry::dim == 2) {
      const double start = outline.place(e, part.start), end = outline.place(e, part.end);
      double seen_length = std::max(0.0, end - start);
      for (const auto& [low, high] : hidden)
        seen_length -= std::max(0.0, std::min(end, high) - std::max(start, low));
      return seen_length;
    }
    const double seen = dot_product(part.area_vector(),
                                    outline.in_space<Geometry::dim>(outline.within(e, 0)).normal);
    return std::max(0.0, seen) /
           outline.widening(e, outline.depth(e, outline.in_section(part.centre())));
  }
};

/// Void behind the outline where a piece of rock was dropped or a block has fallen, as far as it
/// lies behind one edge.
template <class Geometry>
struct WallHole {
  int group;  ///< holes of one number are parts of one void
  int edge;
  typename Geometry::Shape shape;
};

/// The wall of an opening.
template <class Geometry>
struct Wall {
  std::vector<WallPiece<Geometry>> pieces;  ///< in the order of the outline
  std::vector<WallHole<Geometry>> holes;
};

/// The surface of the remaining rock that bounds an opening, in the order of the outline: its faces
/// on the outline and, where a piece of rock was dropped, those around the hole that it has left.
/// There are gaps where the outline runs through another opening. The opening need not be one that
/// was carved: the outline of a section that was taken out in rounds has the wall that these left.
///
/// Faces on the outline are found by their place, not by the cut they come from: where it runs
/// along a joint, the wall is a face of that joint. Those around a hole are the other sides of its
/// cuts.
///
/// @param fallen  bodies that are no longer there: they have left holes as dropped pieces have
/// @throws InvalidInput  there is no such body
/// @cost  one bounding test per body; faces x outline edges near the opening only
[[nodiscard]] VOUSSOIR_INLINE Wall<Planar> wall_of(const RockMass<Planar>& mass,
                                                   const SimplePolygon& opening,
                                                   const std::vector<int>& fallen = {});
/// The sides of an opening in 3-D, not its ends.
[[nodiscard]] VOUSSOIR_INLINE Wall<Spatial> wall_of(const RockMass<Spatial>& mass,
                                                    const PrismaticOpening& opening,
                                                    const std::vector<int>& fallen = {});

/// Its pieces alone.
template <class Geometry>
[[nodiscard]] std::vector<WallPiece<Geometry>> wall_pieces(
    const RockMass<Geometry>& mass, const typename Geometry::Opening& opening) {
  return wall_of(mass, opening).pieces;
}
/// Those of the last opening; none before one was carved.
template <class Geometry>
[[nodiscard]] std::vector<WallPiece<Geometry>> wall_pieces(const RockMass<Geometry>& mass) {
  if (mass.openings.empty()) return {};
  return wall_pieces(mass, mass.openings.back());
}

#if VOUSSOIR_BODIES

namespace detail {

/// What two faces of one cut share, seen from the second.
[[nodiscard]] inline std::optional<Segment> shared_face(const Segment& face, const Segment& other,
                                                        double tolerance) {
  const Vec2 along = normalized(other.end - other.start);
  const auto place = [&](const Vec2& p) { return dot_product(along, p - other.start); };
  const double from = std::max(0.0, place(face.end)),
               to = std::min(other.length(), place(face.start));
  if (to - from <= tolerance) return {};
  return Segment{from > 0 ? face.end : other.start, to < other.length() ? face.start : other.end};
}
[[nodiscard]] inline std::optional<SpatialFacet> shared_face(const SpatialFacet& face,
                                                             const SpatialFacet& other,
                                                             double tolerance) {
  auto common = common_part(face, other, tolerance);
  if (!common || common->area() <= tolerance * std::sqrt(face.measure())) return {};
  std::reverse(common->corners.begin(), common->corners.end());
  return SpatialFacet{std::move(common->corners)};
}

/// Finds the wall of one opening.
template <class Geometry>
class WallFinder {
 public:
  static constexpr int dim = Geometry::dim;
  using Shape = typename Geometry::Shape;
  using Facet = typename Geometry::Facet;
  using Opening = typename Geometry::Opening;

  WallFinder(const RockMass<Geometry>& mass, const Opening& opening, const std::vector<int>& fallen)
      : mass_(mass),
        outline_(opening),
        box_(opening, mass.domain.tolerance()),
        tolerance_(mass.domain.tolerance()),
        is_there_(mass.bodies.size(), true) {
    for (const int b : fallen) {
      if (!is_index(b, mass.bodies.size()))
        throw InvalidInput(
            message({"wall: there is no body ", b, " that could have fallen; accepted: 0 to ",
                     static_cast<int>(mass.bodies.size()) - 1}));
      is_there_[static_cast<std::size_t>(b)] = false;
    }
    for (std::size_t e = 0; e < outline_.size(); ++e)
      sides_.push_back(outline_piece(opening, e, mass.domain));
  }

  [[nodiscard]] Wall<Geometry> find() {
    for (std::size_t b = 0; b < mass_.bodies.size(); ++b)
      for (const Shape& part : standing_parts(b))
        on_outline(part, [&](std::size_t e, Facet facet, double from, double to) {
          const double start = outline_.start(e);
          wall_.pieces.push_back({static_cast<int>(b), std::move(facet), static_cast<int>(e),
                                  start + from, start + to});
        });

    std::vector<Shape> missing;
    const auto add = [&](const Body<Geometry>& body) {
      missing.insert(missing.end(), body.parts.begin(), body.parts.end());
    };
    for (const Body<Geometry>& body : mass_.dropped) add(body);
    for (std::size_t b = 0; b < mass_.bodies.size(); ++b)
      if (!is_there_[b]) add(mass_.bodies[b]);
    // Pieces that lay side by side have left one hole, across joints, too.
    const std::vector<Cut> all_connect(mass_.cuts.size(), Cut{Cut::Kind::seam, 0});
    int number = 0;
    for (const auto& group : connected_groups(missing, all_connect, tolerance_))
      add_holes(group, number++);
    if (!faces_.empty()) add_faces_of_holes();
    add_pieces_of_holes();
    if constexpr (dim == 2) find_hidden();
    sort();
    return std::move(wall_);
  }

 private:
  /// What of a body is there: all or nothing.
  [[nodiscard]] std::span<const Shape> standing_parts(std::size_t body) const {
    return is_there_[body] ? std::span<const Shape>(mass_.bodies[body].parts)
                           : std::span<const Shape>();
  }

  /// Faces of a shape that lie on the outline: visit(edge, what of the face lies on it, from, to).
  template <class Visit>
  void on_outline(const Shape& shape, Visit&& visit) const {
    if (box_.is_apart_from(shape)) return;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Facet face = shape.face(k);
      for (std::size_t e = 0; e < outline_.size(); ++e) {
        if constexpr (dim == 2) {
          const Segment& edge = outline_.edge(e);
          const double length = outline_.start(e + 1) - outline_.start(e);
          const Vec2 along = (edge.end - edge.start) / edge.length();
          // The outline is anticlockwise round the opening, the face round the rock.
          const double from = std::max(0.0, dot_product(along, face.end - edge.start));
          const double to = std::min(length, dot_product(along, face.start - edge.start));
          if (to - from <= tolerance_) continue;
          const HalfSpace<2> line = plane_of(sides_[e]);
          if (std::abs(line.distance(face.start)) > tolerance_ ||
              std::abs(line.distance(face.end)) > tolerance_)
            continue;
          visit(e, Segment{edge.start + from * along, edge.start + to * along}, from, to);
        } else {
          const HalfSpace<3>& plane = plane_of(sides_[e]);
          // The face looks into the opening: the same way as the half space on its left.
          if (!(dot_product(shape.half_space(k).normal, plane.normal) < -0.5)) continue;
          if (std::any_of(face.vertices.begin(), face.vertices.end(),
                          [&](const Vec3& v) { return std::abs(plane.distance(v)) > tolerance_; }))
            continue;
          if (auto facet = shared_face(face, SpatialFacet{sides_[e].corners}, tolerance_)) {
            const auto [from, to] = places(e, *facet);
            visit(e, std::move(*facet), from, to);
          }
        }
      }
    }
  }

  /// The places of an edge that a facet lies behind.
  [[nodiscard]] std::pair<double, double> places(std::size_t e, const Facet& facet) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& corner : corners_of(facet)) {
      const double s = outline_.place(e, outline_.in_section(corner));
      low = std::min(low, s);
      high = std::max(high, s);
    }
    return {low, high};
  }

  struct Bounds {
    OutlinePlace low, high;
  };
  /// A face of what is missing, and the holes that its part has left.
  struct HoleFace {
    Facet facet;
    std::size_t first_hole, end_hole;
  };
  /// What of a body bounds one void behind an edge.
  struct FacesOfHole {
    int hole = 0;  ///< one of that void
    std::vector<Facet> facets;
  };

  /// Of what is missing, in one piece; nothing if it did not lie at this outline.
  void add_holes(const std::vector<Shape>& missing, int number) {
    std::vector<std::size_t> edges;
    for (const Shape& part : missing)
      on_outline(part, [&](std::size_t e, const Facet&, double, double) { edges.push_back(e); });
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const Shape& part : missing) {
      const std::size_t first = wall_.holes.size();
      for (const std::size_t e : edges) {
        const Bounds bounds = bounds_of_hole(e, edges);
        auto shape = outline_.template part_between<dim>(std::optional(part), bounds.low,
                                                         bounds.high, tolerance_);
        if (!shape) continue;
        wall_.holes.push_back({number, static_cast<int>(e), std::move(*shape)});
        bounds_.push_back(bounds);
      }
      for (std::size_t k = 0; k < part.size(); ++k)
        faces_[part.cut(k)].push_back({part.face(k), first, wall_.holes.size()});
    }
  }

  /// Places between which what is missing is a hole of an edge: its own, and on each side half of
  /// those up to the next edge at which something is missing, for what lies behind rock; all there
  /// is on a side where no such edge comes before the outline has turned round.
  /// @param edges  at which something is missing, in order
  [[nodiscard]] Bounds bounds_of_hole(std::size_t e, const std::vector<std::size_t>& edges) const {
    constexpr double endless = std::numeric_limits<double>::infinity();
    const auto at =
        static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), e) - edges.begin());
    const std::size_t before = edges[(at + edges.size() - 1) % edges.size()],
                      after = edges[(at + 1) % edges.size()];
    const auto between = [&](std::size_t first, std::size_t last, const OutlinePlace& otherwise) {
      double turn = 0, length = 0;
      for (std::size_t k = first;;) {
        turn += outline_.turn_after(k);
        k = (k + 1) % outline_.size();
        if (k == last || k == first) break;
        length += edge_length(k);
      }
      if (first == last || turn > std::numbers::pi) return otherwise;
      std::size_t k = (first + 1) % outline_.size();
      for (length *= 0.5; k != last && length > edge_length(k); k = (k + 1) % outline_.size())
        length -= edge_length(k);
      return OutlinePlace{k, length};
    };
    return {between(before, e, {e, -endless}), between(e, after, {e, endless})};
  }
  [[nodiscard]] double edge_length(std::size_t e) const {
    return outline_.start(e + 1) - outline_.start(e);
  }

  void add_faces_of_holes() {
    for (std::size_t b = 0; b < mass_.bodies.size(); ++b)
      for (const Shape& part : standing_parts(b))
        for (std::size_t k = 0; k < part.size(); ++k) {
          const auto of_cut = faces_.find(part.cut(k));
          if (of_cut == faces_.end()) continue;
          const Facet face = part.face(k);
          for (const HoleFace& hole : of_cut->second)
            if (dot_product(face.area_vector(), hole.facet.area_vector()) < 0)
              if (const auto common = shared_face(face, hole.facet, tolerance_))
                for (std::size_t h = hole.first_hole; h < hole.end_hole; ++h)
                  add_face_of_hole(static_cast<int>(b), *common, h);
        }
  }
  void add_face_of_hole(int body, const Facet& face, std::size_t hole) {
    const int e = wall_.holes[hole].edge;
    const auto facet = outline_.template part_between<dim>(std::optional(face), bounds_[hole].low,
                                                           bounds_[hole].high, tolerance_);
    if (!facet) return;
    FacesOfHole& of_hole = faces_of_holes_[{e, body, wall_.holes[hole].group}];
    of_hole.hole = static_cast<int>(hole);
    of_hole.facets.push_back(*facet);
  }

  /// Joined: into which convex parts carving has divided blocks and what is missing is no matter of
  /// the wall.
  void add_pieces_of_holes() {
    for (auto& [where, faces] : faces_of_holes_) {
      const auto& [edge, body, group] = where;
      const auto e = static_cast<std::size_t>(edge);
      for (Facet& facet : joined_facets(std::move(faces.facets), tolerance_)) {
        const auto [from, to] = places(e, facet);
        const double depth = outline_.depth(e, outline_.in_section(facet.centre()));
        wall_.pieces.push_back({body, std::move(facet), edge, outline_.start(e) + from,
                                outline_.start(e) + to, std::max(0.0, depth), faces.hole});
      }
    }
  }

  /// Where rock overhangs in a hole, what lies behind it is not seen.
  void find_hidden() {
    const auto is_seen = [&](const WallPiece<Geometry>& piece) {
      const auto e = static_cast<std::size_t>(piece.edge);
      return piece.hole < 0 ||
             outline_.place(e, piece.facet.end) > outline_.place(e, piece.facet.start);
    };
    for (WallPiece<Geometry>& piece : wall_.pieces) {
      if (piece.hole < 0 || !is_seen(piece)) continue;
      const auto e = static_cast<std::size_t>(piece.edge);
      for (const WallPiece<Geometry>& other : wall_.pieces) {
        const double from = std::max(piece.from, other.from), to = std::min(piece.to, other.to);
        // Pieces do not cross: what is in front anywhere is so wherever both are.
        const double middle = 0.5 * (from + to) - outline_.start(e);
        if (other.edge == piece.edge && from < to && is_seen(other) &&
            depth_at(other, middle) < depth_at(piece, middle))
          piece.hidden.emplace_back(from - outline_.start(e), to - outline_.start(e));
      }
      std::sort(piece.hidden.begin(), piece.hidden.end());
      double end = 0;
      for (auto& [from, to] : piece.hidden) {
        from = std::max(from, end);
        end = to = std::max(from, to);
      }
    }
  }
  /// How far a piece lies behind a place of its edge [m].
  [[nodiscard]] double depth_at(const WallPiece<Geometry>& piece, double s) const {
    const auto e = static_cast<std::size_t>(piece.edge);
    const Vec2 way = piece.facet.end - piece.facet.start;
    return cross(Vec2(piece.facet.start - outline_.point(e, s)), way) /
           cross(outline_.way_behind(e, s), way);
  }

  /// Along the outline; in 3-D edge by edge, as they were found.
  void sort() {
    std::vector<double> keys;
    keys.reserve(wall_.pieces.size());
    for (const auto& piece : wall_.pieces) keys.push_back(dim == 2 ? piece.from : piece.edge);
    std::vector<WallPiece<Geometry>> along;
    along.reserve(keys.size());
    for (const std::size_t k : order_of_values(keys)) along.push_back(std::move(wall_.pieces[k]));
    wall_.pieces = std::move(along);
  }

  const RockMass<Geometry>& mass_;
  WallOutline outline_;
  OpeningBox box_;
  double tolerance_;
  std::vector<bool> is_there_;  ///< of every body
  std::vector<decltype(outline_piece(std::declval<const Opening&>(), 0, mass_.domain))> sides_;
  Wall<Geometry> wall_;
  std::vector<Bounds> bounds_;                                ///< of every hole
  std::map<int, std::vector<HoleFace>> faces_;                ///< of what is missing, by their cuts
  std::map<std::array<int, 3>, FacesOfHole> faces_of_holes_;  ///< by edge, body and void
};

}  // namespace detail

VOUSSOIR_INLINE Wall<Planar> wall_of(const RockMass<Planar>& mass, const SimplePolygon& opening,
                                     const std::vector<int>& fallen) {
  return detail::WallFinder<Planar>(mass, opening, fallen).find();
}

VOUSSOIR_INLINE Wall<Spatial> wall_of(const RockMass<Spatial>& mass,
                                      const PrismaticOpening& opening,
                                      const std::vector<int>& fallen) {
  return detail::WallFinder<Spatial>(mass, opening, fallen).find();
}

#endif

}  // namespace voussoir
