// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/detail/surface.hpp>
#include <voussoir/geometry/detail/surface_check.hpp>
#include <voussoir/geometry/detail/surface_split.hpp>
#include <voussoir/geometry/detail/surface_weld.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/spatial_facet.hpp>

namespace voussoir {

/// A convex polyhedron whose faces remember the cut that made them.
///
/// Faces keep the plane they were made with: a sliver left by a cut has the exact normal of the
/// joint, which its own vertices could no longer give.
class ConvexPolyhedron {
 public:
  static constexpr int dim = 3;

  /// Where two faces meet.
  struct Edge {
    int from, to;     ///< vertices
    int left, right;  ///< faces; `left` runs along the edge from `from` to `to`
  };

  ConvexPolyhedron() = default;

  /// @param vertices  each once [m]
  /// @param faces     vertices of each face by number, anticlockwise seen from outside
  /// @param cuts      label of each face: for rock, its index in RockMass::cuts
  /// @throws InvalidInput  fewer than 4 vertices or faces, a coordinate that is not finite, a
  ///                       vertex repeated or in no face, a face with fewer than 3 vertices, a
  ///                       wrong number or one twice, a face without area, not planar or not
  ///                       convex, no volume, a clockwise face, a vertex above a face, an edge
  ///                       without a second face; the message names the face or vertex, the value
  ///                       and the rule. Lengths are compared with 1e-9 of the size.
  /// @cost  O(vertices * (vertices + faces)): all of them are compared with each other
  ConvexPolyhedron(std::vector<Vec3> vertices, const std::vector<std::vector<int>>& faces,
                   const std::vector<int>& cuts);

  /// The same with faces that no cut made; enough for all but `CutContacts`.
  ConvexPolyhedron(std::vector<Vec3> vertices, const std::vector<std::vector<int>>& faces)
      : ConvexPolyhedron(std::move(vertices), faces, std::vector<int>(faces.size(), no_cut)) {}

  /// Number of faces.
  [[nodiscard]] std::size_t size() const { return surface_.faces.size(); }
  [[nodiscard]] const std::vector<Vec3>& vertices() const { return surface_.vertices; }
  [[nodiscard]] const Vec3& vertex(std::size_t k) const { return surface_.vertices[k]; }
  [[nodiscard]] int cut(std::size_t face) const { return surface_.faces[face].cut; }
  void set_cut(std::size_t face, int cut) { surface_.faces[face].cut = cut; }
  /// Vertices of a face by number, anticlockwise seen from outside.
  [[nodiscard]] std::span<const int> loop(std::size_t face) const {
    return surface_.loop(surface_.faces[face]);
  }
  [[nodiscard]] SpatialFacet face(std::size_t k) const {
    VOUSSOIR_ASSERT(k < size(), "a face is one of the polyhedron");
    SpatialFacet facet;
    facet.vertices.reserve(loop(k).size());
    for (const int v : loop(k)) facet.vertices.push_back(vertex(static_cast<std::size_t>(v)));
    return facet;
  }
  /// The half space that face k bounds, the polyhedron inside.
  [[nodiscard]] const HalfSpace<3>& half_space(std::size_t k) const {
    return surface_.faces[k].plane;
  }
  /// Signed distance of a point from face k, positive outside [m]. As exact as the point is near,
  /// wherever both are.
  [[nodiscard]] double distance(std::size_t k, const Vec3& point) const {
    const Vec3& on_face = vertex(static_cast<std::size_t>(loop(k).front()));
    return dot_product(half_space(k).normal, point - on_face);
  }
  [[nodiscard]] bool contains(const Vec3& point, double tolerance = 0) const {
    for (std::size_t k = 0; k < size(); ++k)
      if (!(distance(k, point) <= tolerance)) return false;
    return true;
  }

  [[nodiscard]] std::size_t edge_count() const { return surface_.loops.size() / 2; }
  /// All edges, each once.
  [[nodiscard]] std::vector<Edge> edges() const;

  /// Number of the vertex farthest in a direction (of any length); the first of equals.
  [[nodiscard]] std::size_t support(const Vec3& direction) const {
    std::size_t best = 0;
    double farthest = 0;  // relative to vertex 0, so that no digit is lost far from the origin
    for (std::size_t k = 1; k < vertices().size(); ++k)
      if (const double d = dot_product(direction, vertex(k) - vertex(0)); d > farthest) {
        farthest = d;
        best = k;
      }
    return best;
  }

  /// Cuts the polyhedron by a plane into the parts below and above; nothing if the plane misses it
  /// or only touches it.
  ///
  /// Both parts get the very same new vertices, bit for bit; both new faces carry the label `cut`
  /// and the plane itself. A vertex within `tolerance` of the plane is taken to lie on it (a few
  /// times that where vertices lie about as far as the tolerance from it).
  ///
  /// @cost  O(vertices)
  [[nodiscard]] std::optional<std::pair<ConvexPolyhedron, ConvexPolyhedron>> split(
      const HalfSpace<3>& plane, int cut, double tolerance) const {
    thread_local detail::SurfaceSplit splitter;
    if (!splitter.cut(surface_, plane, cut, tolerance)) return std::nullopt;
    std::pair<ConvexPolyhedron, ConvexPolyhedron> parts;
    parts.first.surface_ = splitter.below;
    parts.second.surface_ = splitter.above;
    // Two faces are all that is left of a part no thicker than the tolerance.
    VOUSSOIR_ASSERT(parts.first.size() >= 2 && parts.second.size() >= 2, "a part is closed");
    VOUSSOIR_ASSERT(
        parts.first.surface_.loops.size() % 2 == 0 && parts.second.surface_.loops.size() % 2 == 0,
        "an edge has two sides");
    return parts;
  }

  /// Replaces every vertex by `place(vertex)`, which must not move it by more than a rounding,
  /// makes one of those that have become equal, and drops faces that have lost their area so.
  /// @return  number of faces dropped
  template <class Place>
  std::size_t move_vertices(Place&& place) {
    for (Vec3& vertex : surface_.vertices) vertex = place(vertex);
    return detail::merge_equal_vertices(surface_);
  }

  /// Longest distance between two vertices [m].
  [[nodiscard]] double diameter() const {
    double squared = 0;
    for (std::size_t i = 0; i < vertices().size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        squared = std::max(squared, squared_length_of(vertex(i) - vertex(j)));
    return std::sqrt(squared);
  }

  /// [m^2]
  [[nodiscard]] double surface_area() const {
    double sum = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      const auto corners = loop(k);
      sum += length_of(detail::doubled_area(corners.size(), [&](std::size_t i) -> const Vec3& {
        return vertex(static_cast<std::size_t>(corners[i]));
      }));
    }
    return 0.5 * sum;
  }

 private:
  detail::Surface surface_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE ConvexPolyhedron::ConvexPolyhedron(std::vector<Vec3> vertices,
                                                   const std::vector<std::vector<int>>& faces,
                                                   const std::vector<int>& cuts) {
  if (cuts.size() != faces.size())
    throw InvalidInput("convex polyhedron: has " + std::to_string(cuts.size()) + " labels for " +
                       std::to_string(faces.size()) + " faces, needs one for each");
  surface_.vertices = std::move(vertices);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto begin = static_cast<int>(surface_.loops.size());
    for (const int v : faces[f]) surface_.loops.push_back(v);
    surface_.faces.push_back({{}, cuts[f], begin, static_cast<int>(surface_.loops.size())});
  }
  detail::SurfaceCheck(surface_).run();
}

VOUSSOIR_INLINE auto ConvexPolyhedron::edges() const -> std::vector<Edge> {
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  std::vector<int> face_of(surface_.loops.size());
  for (std::size_t f = 0; f < size(); ++f)
    for (int h = surface_.faces[f].begin; h < surface_.faces[f].end; ++h)
      face_of[at(h)] = static_cast<int>(f);
  std::vector<Edge> all;
  all.reserve(edge_count());
  for (std::size_t h = 0; h < surface_.loops.size(); ++h)
    if (const std::size_t twin = at(surface_.twins[h]); h < twin)
      all.push_back({surface_.loops[h], surface_.loops[twin], face_of[h], face_of[twin]});
  VOUSSOIR_ASSERT(all.size() == edge_count(), "an edge has two sides");
  return all;
}

#endif

}  // namespace voussoir
