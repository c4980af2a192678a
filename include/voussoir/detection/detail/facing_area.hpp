// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/detail/edge_clip.hpp>
#include <voussoir/detection/detail/edge_pairs.hpp>
#include <voussoir/detection/detail/face_clip.hpp>
#include <voussoir/detection/detail/facing_contact.hpp>
#include <voussoir/detection/detail/facing_face.hpp>
#include <voussoir/detection/detail/plane_axis.hpp>
#include <voussoir/detection/detail/section.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

[[nodiscard]] inline const PlacedShape<2>& shape_in(const PlacedShape<2>& shape) { return shape; }
[[nodiscard]] inline const PlacedShape<3>& shape_in(const LinkedShape& shape) {
  return shape.shape;
}

/// The face of p that a direction names, the one that looks most nearly along it, and what of the
/// other shape q lies over it.
template <int Dim>
struct NamedFace {
  std::size_t face = 0;
  double cosine = -1;     ///< of the angle between its normal and the direction
  double separation = 0;  ///< of the lowest vertex of q over it [m]

  NamedFace(const PlacedShape<Dim>& p, const Vec<Dim>& direction, const PlacedShape<Dim>& q) {
    for (std::size_t k = 0; k < p.face_count; ++k) {
      const double c = dot_product(direction, p.normal(k));
      if (!(c > cosine + 1e-9)) continue;  // of equals the first, whatever direction's roundings
      cosine = c;
      face = k;
    }
    separation = lowest<Dim>(q, p.normal(face)) - p.offset(face);
  }
};

/// The edge of a polygon that faces a face of another, clipped to the strip over it.
class AreaOver2 {
 public:
  /// @param of_a  whether p is the first shape of the pair
  [[nodiscard]] Contact<2> run(const PlacedShape<2>& p, const NamedFace<2>& over,
                               const PlacedShape<2>& q, bool of_a) {
    const Vec2 normal = p.normal(over.face);
    const ClippedEdge clipped =
        clip_edge(p, over.face, q, facing_edge(q, normal), any_height, zeros<Vec2>());
    ends_ = {clipped.start, clipped.end};
    if (!of_a) std::swap(ends_[0], ends_[1]);
    return {of_a ? Touch::face_a : Touch::face_b, of_a ? normal : Vec2(-normal), over.separation,
            clipped.length, ends_};
  }

 private:
  std::array<Vec2, 2> ends_{};
};

/// The face of a polyhedron that faces a face of another, clipped to the prism over it.
class AreaOver3 {
 public:
  [[nodiscard]] Contact<3> run(const LinkedShape& p, const NamedFace<3>& over, const LinkedShape& q,
                               bool of_a) {
    const Vec3 normal = p.shape.normal(over.face);
    const FacingFace across = facing_face<VectorLanes>(p, over.face, q, heights_);
    clip_.run(p.shape, p.topology.loop(over.face), normal, q.shape, q.topology.loop(across.face),
              any_height);
    if (clip_.size() > 0)
      clip_.write(polygon_, !of_a);
    else
      polygon_.assign(1, q.shape.vertex(across.deepest));
    return {of_a ? Touch::face_a : Touch::face_b, of_a ? normal : Vec3(-normal), over.separation,
            clip_.area(), polygon_};
  }

 private:
  FaceClip clip_;
  std::vector<double> heights_;
  std::vector<Vec3> polygon_;
};

/// Two edges that cross, one of each shape.
class CrossingEdges {
 public:
  /// Looks among the edges of a face of each; Touch::none if none keep the shapes further apart
  /// than `floor` [m].
  [[nodiscard]] Contact<3> of_faces(const LinkedShape& a, std::size_t face_a, const LinkedShape& b,
                                    std::size_t face_b, double floor) {
    list(a.topology, face_a, edges_of_a_);
    list(b.topology, face_b, edges_of_b_);
    return best(a, b, floor);
  }
  /// The same among all.
  [[nodiscard]] Contact<3> of_shapes(const LinkedShape& a, const LinkedShape& b, double floor) {
    list(a.topology, edges_of_a_);
    list(b.topology, edges_of_b_);
    return best(a, b, floor);
  }

 private:
  [[nodiscard]] Contact<3> best(const LinkedShape& a, const LinkedShape& b, double floor) {
    const double least = floor + EdgePairs<VectorLanes>::rounding;
    const auto best = edge_pairs_.run(a, edges_of_a_, b, edges_of_b_, least);
    if (!(best.separation > least)) return {};
    section_.run(a, best.edge_a, b, best.edge_b, best.normal, polygon_);
    return {Touch::edge_edge, best.normal, best.separation, section_.area(), polygon_};
  }

  static void list(const Topology& topology, EdgeList& edges) {
    edges.start(topology.edges.size());
    for (std::size_t k = 0; k < topology.edges.size(); ++k) edges.add_if(k, true);
  }
  static void list(const Topology& topology, std::size_t face, EdgeList& edges) {
    const std::size_t count = topology.loop(face).size();
    edges.start(count);
    for (std::size_t k = 0; k < count; ++k) edges.add_if(topology.side(face, k), true);
  }

  EdgePairs<VectorLanes> edge_pairs_;
  Section section_;
  EdgeList edges_of_a_, edges_of_b_;
  std::vector<Vec3> polygon_;
};

/// The area over which two shapes touch whose contact has a known direction.
///
/// The direction names a face of each: the face of a most nearly along it and the face of b most
/// nearly against it. The one of the two in which the other shape is less deep is the reference,
/// and the face across from it is clipped to the upright prism over it. In 3-D, where neither face
/// is within 0.1 rad of the direction, an edge of one may cross an edge of the other with less
/// depth still: then these touch.
template <int Dim>
class FacingArea {
 public:
  using Shape = std::conditional_t<Dim == 2, PlacedShape<2>, LinkedShape>;

  /// @param direction  from a to b, unit
  /// @param a_first    of equals the reference is the face of a; (b, a) needs the opposite
  [[nodiscard]] Contact<Dim> run(const Shape& a, const Shape& b, const Vec<Dim>& direction,
                                 bool a_first) {
    const NamedFace<Dim> of_a(shape_in(a), direction, shape_in(b));
    const NamedFace<Dim> of_b(shape_in(b), -direction, shape_in(a));
    const bool over_a =
        of_a.separation > of_b.separation || (of_a.separation == of_b.separation && a_first);
    const Contact<Dim> found = over_a ? area_.run(a, of_a, b, true) : area_.run(b, of_b, a, false);
    if constexpr (Dim == 3) {
      if (std::max(of_a.cosine, of_b.cosine) < flat) {
        const Contact<3> edges = edges_.of_faces(a, of_a.face, b, of_b.face, found.separation);
        if (edges.touch != Touch::none &&
            !(found.measure > 0 && dot_product(edges.normal, found.normal) > flat))
          return edges;
      }
    }
    return found;
  }

  /// The same for an overlap whose deepest point lies beside what its direction names: over the
  /// face that is left by the shortest way, or else whichever edges cross.
  [[nodiscard]] Contact<Dim> by_shortest_way(const Shape& a, const Shape& b, bool a_first) {
    const Vec<Dim> direction = shallowest_normal<Dim>(shape_in(a), shape_in(b), a_first);
    const Contact<Dim> found = run(a, b, direction, a_first);
    if constexpr (Dim == 3) {
      if (!(found.measure > 0)) {
        const Contact<3> edges = edges_.of_shapes(a, b, found.separation);
        if (edges.touch != Touch::none) return edges;
      }
    }
    return found;
  }

 private:
  static constexpr double flat = 0.995;  ///< cosine of 0.1 rad

  struct NoEdges {};
  std::conditional_t<Dim == 2, AreaOver2, AreaOver3> area_;
  [[no_unique_address]] std::conditional_t<Dim == 2, NoEdges, CrossingEdges> edges_;
};

}  // namespace voussoir::detail
