// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/detail/edge_pairs.hpp>
#include <voussoir/detection/detail/face_clip.hpp>
#include <voussoir/detection/detail/section.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// Two convex polyhedra: separating axes of faces and of pairs of edges, then the touching face
/// clipped to the face it touches.
///
/// Most pairs of edges need not be tried. Let K be the touching face q of b, clipped to the prism
/// over the touching face p of a (or the other way round), and d the separation by p. A point x of
/// K is in b, and x shifted to the plane of p is in a; therefore along any unit vector n
///     separation(n) <= -(width of K along n) + max(reach, -d).
/// K is flat, so its width is at least w sin(n, normal of q), with w >= area / extent its least
/// width in its plane. An axis better than d thus makes an angle with the normal of q of at most
///     sin(angle) < (max(0, -d) + max(reach, -d)) / w,
/// and edges that support it lie near the plane of q. Between neighbours in a rock mass some four
/// edges of each block are left of twelve.
template <class Lanes>
class FacePair3 {
 public:
  /// What decided last time. It saves time and never changes an answer.
  struct Memory {
    std::uint16_t first = 0, second = 0;  ///< a face, or an edge of a and an edge of b
    Touch by = Touch::face_a;
    bool apart = true;
  };

  explicit FacePair3(const PlacedShapes<3>& shapes) : shapes_(&shapes) {}

  [[nodiscard]] bool overlap(std::size_t a, std::size_t b, Memory& memory) {
    return find_axis(a, b, 0, 0, memory) < 0;
  }

  [[nodiscard]] double separation(std::size_t a, std::size_t b, Memory& memory,
                                  double enough = std::numeric_limits<double>::infinity()) {
    return find_axis(a, b, enough, 0, memory);
  }

  [[nodiscard]] Contact<3> contact(std::size_t a, std::size_t b, Memory& memory, double reach) {
    Contact<3> found;
    const double separation = find_axis(a, b, reach, reach, memory);
    if (!(separation <= reach)) return found;
    found.separation = separation;
    found.normal = normal_;
    // An edge pair whose normal is that of the face, but for the small angle between two faces
    // that touch, limits the depth of a contact of faces.
    if (memory.by == Touch::edge_edge && !(area_ > 0 && normal_.dot(face_normal_) > flat)) {
      found.touch = Touch::edge_edge;
      section_.run((*shapes_)[a], (*shapes_)[b], (*shapes_).topology(a), (*shapes_).topology(b),
                   memory.first, memory.second, normal_, polygon_);
      found.measure = section_.area();
    } else {
      found.touch = face_side_ == 0 ? Touch::face_a : Touch::face_b;
      if (clip_.size() > 0) {
        clip_.write(polygon_, face_side_ == 1);
      } else {
        polygon_.assign(1, deepest_);  // a rounding: the deepest point
      }
      found.measure = area_;
    }
    found.polygon = polygon_;
    return found;
  }

 private:
  static constexpr double flat = 0.995;  ///< cosine of 0.1 rad

  using Shape = PlacedShape<3>;

  [[nodiscard]] static Lanes along(const Vec3& n, const Shape& shape, std::size_t k) {
    return Lanes::all(n[0]) * Lanes::load(shape.vertices(0) + k) +
           Lanes::all(n[1]) * Lanes::load(shape.vertices(1) + k) +
           Lanes::all(n[2]) * Lanes::load(shape.vertices(2) + k);
  }
  /// Smallest n . x of a shape [m].
  [[nodiscard]] static double lowest(const Vec3& n, const Shape& shape) {
    Lanes low = along(n, shape, 0);
    for (std::size_t k = lane_count; k < shape.vertex_stride(); k += lane_count)
      low = min(low, along(n, shape, k));
    return low.smallest();
  }

  /// What kept the pair apart last time, tried again [m]; maybe -infinity if not above `limit`.
  [[nodiscard]] double known_separation(std::size_t i, std::size_t j, double limit,
                                        const Memory& memory) const {
    const Shape a = (*shapes_)[i], b = (*shapes_)[j];
    if (memory.by == Touch::face_a)
      return lowest(a.normal(memory.first), b) - a.offset(memory.first);
    if (memory.by == Touch::face_b)
      return lowest(b.normal(memory.first), a) - b.offset(memory.first);
    Vec3 normal;
    return EdgePairs<Lanes>::separation({a, shapes_->topology(i)}, memory.first,
                                        {b, shapes_->topology(j)}, memory.second, limit, normal);
  }

  /// How far the faces of p keep q away at most; one number per face is left in `separations`.
  [[nodiscard]] static double largest_separation(const Shape& p, const Shape& q,
                                                 double* separations) {
    const double *x = q.vertices(0), *y = q.vertices(1), *z = q.vertices(2);
    Lanes best = Lanes::all(-std::numeric_limits<double>::infinity());
    for (std::size_t group = 0; group < p.face_stride(); group += lane_count) {
      const Lanes nx = Lanes::load(p.normals(0) + group), ny = Lanes::load(p.normals(1) + group),
                  nz = Lanes::load(p.normals(2) + group);
      const auto project = [&](std::size_t k) {
        return nx * Lanes::all(x[k]) + ny * Lanes::all(y[k]) + nz * Lanes::all(z[k]);
      };
      // By whole groups: how many vertices there are is then seldom a surprise to the processor.
      Lanes low = min(min(project(0), project(1)), min(project(2), project(3)));
      for (std::size_t k = lane_count; k < q.vertex_stride(); k += lane_count)
        low = min(low, min(min(project(k), project(k + 1)), min(project(k + 2), project(k + 3))));
      low = low - Lanes::load(p.offsets() + group);
      low.store(separations + group);
      best = max(best, low);
    }
    return best.largest();
  }

  /// The largest separation, or the first one found that keeps the shapes apart by more than
  /// `limit`. What decided is left in `memory`, and its normal and clipped face in the members.
  [[nodiscard]] double find_axis(std::size_t i, std::size_t j, double limit, double reach,
                                 Memory& memory) {
    if (memory.apart) {
      const double known = known_separation(i, j, limit, memory);
      if (known > limit) return known;
    }
    const LinkedShape a{(*shapes_)[i], shapes_->topology(i)};
    const LinkedShape b{(*shapes_)[j], shapes_->topology(j)};
    const std::size_t half = std::max(a.shape.face_stride(), b.shape.face_stride());
    if (separations_.size() < 2 * half) separations_.resize(2 * half);
    double* const of_faces = separations_.data();
    const double by_a = largest_separation(a.shape, b.shape, of_faces);
    const double by_b = largest_separation(b.shape, a.shape, of_faces + half);
    const bool of_a = by_a >= by_b;
    double best = of_a ? by_a : by_b;
    const double* const winner = of_a ? of_faces : of_faces + half;
    std::size_t face = 0;
    for (std::size_t k = (of_a ? a : b).shape.face_stride(); k-- > 0;)
      face = winner[k] == best ? k : face;
    memory = {static_cast<std::uint16_t>(face), 0, of_a ? Touch::face_a : Touch::face_b,
              best > limit};
    if (memory.apart) return best;

    face_side_ = of_a ? 0 : 1;
    face_normal_ = normal_ = of_a ? a.shape.normal(face) : Vec3(-b.shape.normal(face));
    clip_face(of_a ? a : b, of_a ? b : a, face, reach);
    choose_edges(a, b, best, reach);
    const auto edges = edge_pairs_.run(a, edges_of_a_, b, edges_of_b_, best);
    if (edges.separation > best) {
      best = edges.separation;
      normal_ = edges.normal;
      memory = {edges.edge_a, edges.edge_b, Touch::edge_edge, best > limit};
    }
    return best;
  }

  /// Finds the face of q that faces the reference face of p at q's deepest vertex, and clips it.
  void clip_face(const LinkedShape& reference, const LinkedShape& incident, std::size_t face,
                 double reach) {
    const Shape &p = reference.shape, &q = incident.shape;
    const Vec3 normal = p.normal(face);
    if (heights_.size() < q.vertex_stride()) heights_.resize(q.vertex_stride());
    for (std::size_t k = 0; k < q.vertex_stride(); k += lane_count)
      along(normal, q, k).store(heights_.data() + k);
    std::size_t deepest = 0;
    double depth = heights_[0];
    for (std::size_t k = 1; k < q.vertex_count; ++k) {
      deepest = heights_[k] < depth ? k : deepest;
      depth = std::min(depth, heights_[k]);
    }
    double facing = std::numeric_limits<double>::infinity();
    std::size_t other = 0;
    for (const std::uint16_t candidate : incident.topology.faces_at(deepest)) {
      const double cosine = normal.dot(q.normal(candidate));
      other = cosine < facing ? candidate : other;
      facing = std::min(facing, cosine);
    }
    deepest_ = q.vertex(deepest);
    other_normal_ = face_side_ == 0 ? Vec3(-q.normal(other)) : q.normal(other);
    clip_.run(p, reference.topology.loop(face), normal, q, incident.topology.loop(other), reach);
    area_ = clip_.area();
  }

  /// The edges that could support an axis better than `best` (see the class).
  void choose_edges(const LinkedShape& a, const LinkedShape& b, double best, double reach) {
    const double depth = std::max(0.0, -best), bound = depth + std::max(reach, depth);
    const double extent = clip_.squared_extent();
    const Topology &of_a = a.topology, &of_b = b.topology;
    const double squared_sine = bound * bound * extent / (area_ * area_);
    const double size = of_a.diameter + of_b.diameter;
    if (squared_sine < 0.5) {  // false without an area
      const double sine = std::sqrt(squared_sine), cosine = std::sqrt(1 - squared_sine);
      const double slope = sine / cosine;
      double low_a = 0, high_b = 0;
      const double top_a = project(other_normal_, a.shape, heights_a_, low_a);
      const double bottom_b = -project(-other_normal_, b.shape, heights_b_, high_b);
      // Axes near the opposite direction would have to push a and b through each other.
      if (cosine * (-high_b - low_a) - sine * size >= depth) {
        pick(of_a, heights_a_, top_a - slope * of_a.diameter, edges_of_a_);
        pick(of_b, heights_b_, -bottom_b - slope * of_b.diameter, edges_of_b_);
        return;
      }
    }
    if (clip_.size() > 0) {
      near(a, b, depth);
    } else {
      all(of_a, edges_of_a_);
      all(of_b, edges_of_b_);
    }
  }

  /// The edges that come near enough to the other shape. If a pair of edges has the least depth of
  /// all, d* <= depth, the edges touch once b is moved by d* along their normal: they pass each
  /// other within d*. So an edge of a that lies further inside a face of a than b reaches and d*,
  /// or further outside a face of b than d*, plays no part. The two faces of each shape that are
  /// entered least are looked at. If the shapes are apart, although no face says so, the axis
  /// wanted is that of two edges as near as the shapes are, and these are within `depth` too, for
  /// so far below the reference face there is a point of the clipped one.
  void near(const LinkedShape& linked_a, const LinkedShape& linked_b, double depth) {
    const Shape &a = linked_a.shape, &b = linked_b.shape;
    alignas(32) std::array<double, lane_count> x, y, z, limit_a, limit_b;
    const std::size_t half = std::max(a.face_stride(), b.face_stride());
    for (std::size_t side = 0; side < 2; ++side) {
      const Shape& shape = side == 0 ? a : b;
      const double* const separations = separations_.data() + side * half;
      std::size_t first = 0, second = 0;
      for (std::size_t k = 1; k < shape.face_count; ++k) {
        if (separations[k] > separations[first]) {
          second = first;
          first = k;
        } else if (second == first || separations[k] > separations[second]) {
          second = k;
        }
      }
      // Along the normals so taken a point counts if it is high enough.
      const double sign = side == 0 ? 1 : -1;
      for (const auto& [lane, face] : {std::pair{2 * side, first}, {2 * side + 1, second}}) {
        x[lane] = sign * shape.normals(0)[face];
        y[lane] = sign * shape.normals(1)[face];
        z[lane] = sign * shape.normals(2)[face];
        const double outside = shape.offset(face) + depth;
        const double inside = shape.offset(face) + separations[face] - depth;
        limit_a[lane] = side == 0 ? inside : -outside;
        limit_b[lane] = side == 0 ? outside : -inside;
      }
    }
    const Lanes nx = Lanes::load(x.data()), ny = Lanes::load(y.data()), nz = Lanes::load(z.data());
    const auto score = [&](const Shape& shape, std::size_t k) {
      return nx * Lanes::all(shape.vertices(0)[k]) + ny * Lanes::all(shape.vertices(1)[k]) +
             nz * Lanes::all(shape.vertices(2)[k]);
    };
    const std::size_t needed = lane_count * std::max(a.vertex_count, b.vertex_count);
    if (scores_.size() < needed) scores_.resize(needed);
    const Lanes low = Lanes::load(limit_a.data()), high = Lanes::load(limit_b.data());
    for (std::size_t k = 0; k < a.vertex_count; ++k)
      (score(a, k) - low).store(scores_.data() + lane_count * k);
    pick_near(linked_a.topology, edges_of_a_);
    for (std::size_t k = 0; k < b.vertex_count; ++k)
      (high - score(b, k)).store(scores_.data() + lane_count * k);
    pick_near(linked_b.topology, edges_of_b_);
  }

  /// n . x of all vertices. @return the largest; `low`: the smallest [m]
  static double project(const Vec3& n, const Shape& shape, std::vector<double>& heights,
                        double& low) {
    if (heights.size() < shape.vertex_stride()) heights.resize(shape.vertex_stride());
    Lanes smallest = along(n, shape, 0), largest = smallest;
    smallest.store(heights.data());
    for (std::size_t k = lane_count; k < shape.vertex_stride(); k += lane_count) {
      const Lanes here = along(n, shape, k);
      here.store(heights.data() + k);
      smallest = min(smallest, here);
      largest = max(largest, here);
    }
    low = smallest.smallest();
    return largest.largest();
  }

  /// The edges with both ends at `floor` or above.
  static void pick(const Topology& topology, const std::vector<double>& heights, double floor,
                   EdgeList& list) {
    list.start(topology.edges.size());
    const double* const height = heights.data();
    for (std::size_t k = 0; k < topology.edges.size(); ++k) {
      const Topology::Edge& edge = topology.edges[k];
      list.add_if(k, std::min(height[edge.from], height[edge.to]) >= floor);
    }
  }
  static void all(const Topology& topology, EdgeList& list) {
    list.start(topology.edges.size());
    for (std::size_t k = 0; k < topology.edges.size(); ++k) list.add_if(k, true);
  }
  /// The edges with a point that is near enough to each of the four planes.
  void pick_near(const Topology& topology, EdgeList& list) const {
    list.start(topology.edges.size());
    const double* const score = scores_.data();
    for (std::size_t k = 0; k < topology.edges.size(); ++k) {
      const Topology::Edge& edge = topology.edges[k];
      const Lanes highest = max(Lanes::load(score + lane_count * edge.from),
                                Lanes::load(score + lane_count * edge.to));
      list.add_if(k, highest.smallest() >= 0);
    }
  }

  const PlacedShapes<3>* shapes_;
  FaceClip clip_;
  Section section_;
  EdgePairs<Lanes> edge_pairs_;
  // Of the pair at hand, from `find_axis` to `contact`.
  int face_side_ = 0;  ///< whose face is the best: 0 a's, 1 b's
  double area_ = 0;    ///< of the clipped face [m^2]
  Vec3 normal_ = Vec3::Zero(), face_normal_ = Vec3::Zero(), other_normal_ = Vec3::Zero(),
       deepest_ = Vec3::Zero();
  std::vector<Vec3> polygon_;
  EdgeList edges_of_a_, edges_of_b_;
  std::vector<double> separations_, heights_, heights_a_, heights_b_, scores_;
};

}  // namespace voussoir::detail
