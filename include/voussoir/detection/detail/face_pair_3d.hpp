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
#include <voussoir/detection/detail/facing_contact.hpp>
#include <voussoir/detection/detail/facing_face.hpp>
#include <voussoir/detection/detail/section.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// Two convex polyhedra: separating axes of faces and of pairs of edges, then the touching face
/// clipped to the face it touches.
///
/// Edges are the dear part, and half of the pairs that touch do without trying them. Let M be all
/// points x - y with x in a and y in b: a convex set. The depth along a unit vector n is how far M
/// reaches, h(n), and its least value belongs to the side of M that is nearest to the origin. That
/// side is the touching face p of a less the deepest vertex of b (or the other way round), or the
/// parallelogram of two edges. Its foot, the point of its plane that is nearest to the origin, lies
/// inside if the vertex is over p, or if the edges cross; let r > 0 be its room to the rim. M has a
/// disc of radius r there, so along an axis at the angle t from n
///     h >= h(n) cos t + r sin t,
/// which is more than h(n) as long as tan(t / 2) < r / h(n). So a foot inside settles all axes near
/// n. The rest is settled by the touching face q of b, clipped to the prism over p: a polygon K. A
/// point x of K is in b, and x shifted to the plane of p is in a; therefore along any axis
///     separation <= -(width of K along it) + max(reach, depth by p).
/// K is flat, so its width is at least w sin(angle to the normal of q), with w >= area / extent its
/// least width in its plane. An axis better than p makes an angle with the normal of q of at most
///     sin(angle) < (depth by p + max(reach, depth by p)) / w,
/// or nearly the opposite direction; but there a point of M far behind the foot is in the way.
/// Where the shapes are apart, a foot inside is their distance, which no axis exceeds.
template <class Lanes>
class FacePair3 {
 public:
  /// What decided last time. It saves time and never changes an answer.
  struct Memory {
    std::uint16_t first = 0, second = 0;  ///< a face, or an edge of a and an edge of b
    Touch by = Touch::face_a;
    bool apart = true;
    /// A point of the overlap, from the first vertex of a; 0 if none is known [m].
    std::array<float, 3> inside{};
  };

  explicit FacePair3(const PlacedShapes<3>& shapes) : shapes_(&shapes) {}

  [[nodiscard]] bool overlap(std::size_t a, std::size_t b, Memory& memory) {
    take_up(a, b);
    // A point in both is proof enough, and cheaper than all axes.
    if (!memory.apart && both_contain(memory.inside)) return true;
    const double by_faces = find_face(0, 0, memory);
    if (memory.apart) return false;
    if (clip_.size() > 0) {
      const Vec3 arm = clip_.middle() - a_.vertex(0);
      const std::array<float, 3> from_a{static_cast<float>(arm.x()), static_cast<float>(arm.y()),
                                        static_cast<float>(arm.z())};
      if (both_contain(from_a)) {
        memory.inside = from_a;
        return true;
      }
    }
    return find_edges(by_faces, 0, 0, memory) < 0;
  }

  [[nodiscard]] double separation(std::size_t a, std::size_t b, Memory& memory,
                                  double enough = std::numeric_limits<double>::infinity()) {
    take_up(a, b);
    return find_axis(enough, 0, memory);
  }

  [[nodiscard]] Contact<3> contact(std::size_t a, std::size_t b, Memory& memory, double reach) {
    Contact<3> found = contact_near(a, b, memory, reach);
    if (found.touch == Touch::none) return found;
    const Vec3 grid_point = shapes_->grid_point(a);
    for (Vec3& point : polygon_) point += grid_point;
    return found;
  }

  [[nodiscard]] Contact<3> contact_near(std::size_t a, std::size_t b, Memory& memory,
                                        double reach) {
    Contact<3> found;
    take_up(a, b);
    const double separation = find_axis(reach, reach, memory);
    if (!(separation <= reach)) return found;
    found.separation = separation;
    found.normal = normal_;
    // An edge pair whose normal is that of the face, but for the small angle between two faces
    // that touch, limits the depth of a contact of faces.
    if (memory.by == Touch::edge_edge &&
        !(area_ > 0 && dot_product(normal_, face_normal_) > flat)) {
      found.touch = Touch::edge_edge;
      section_.run(linked_a(), memory.first, linked_b(), memory.second, normal_, polygon_);
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

  [[nodiscard]] Contact<3> facing_contact(std::size_t a, std::size_t b, Memory& memory,
                                          double reach) {
    return detail::facing_contact(*this, a, b, memory, reach);
  }

 private:
  static constexpr double flat = 0.995;  ///< cosine of 0.1 rad
  /// A face decides rather than edges that are better by a rounding, e.g. those of another face
  /// just as good: where they cross in its plane is not well defined [m].
  static constexpr double preference = EdgePairs<Lanes>::rounding;

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

  /// Takes up the pair, both counted from the grid point of a.
  void take_up(std::size_t a, std::size_t b) {
    number_a_ = a;
    number_b_ = b;
    a_ = (*shapes_)[a];
    b_ = shapes_->seen_from(a, b, shifted_);
  }
  [[nodiscard]] LinkedShape linked_a() const { return {a_, shapes_->topology(number_a_)}; }
  [[nodiscard]] LinkedShape linked_b() const { return {b_, shapes_->topology(number_b_)}; }

  /// Whether a point, given from the first vertex of a, is inside both shapes beyond any doubt:
  /// deeper than some fifty roundings of its coordinates, and than the vertices of a face, over
  /// which the axes are measured, lie off its plane.
  [[nodiscard]] bool both_contain(const std::array<float, 3>& from_a) const {
    const LinkedShape a = linked_a(), b = linked_b();
    const Vec3 point = a.shape.vertex(0) + Vec3(from_a[0], from_a[1], from_a[2]);
    const double doubt =
        1e-14 * (1 + std::abs(point.x()) + std::abs(point.y()) + std::abs(point.z())) +
        std::max(a.topology.unevenness, b.topology.unevenness);
    return height_above_faces(a.shape, point) < -doubt &&
           height_above_faces(b.shape, point) < -doubt;
  }
  /// Of a point over the face that it is furthest above, < 0 inside [m].
  [[nodiscard]] static double height_above_faces(const Shape& shape, const Vec3& point) {
    Lanes high = Lanes::all(-std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < shape.face_stride(); k += lane_count)
      high = max(high, Lanes::all(point[0]) * Lanes::load(shape.normals(0) + k) +
                           Lanes::all(point[1]) * Lanes::load(shape.normals(1) + k) +
                           Lanes::all(point[2]) * Lanes::load(shape.normals(2) + k) -
                           Lanes::load(shape.offsets() + k));
    return high.largest();
  }

  /// What kept the pair apart last time, tried again [m]; maybe -infinity if not above `limit`.
  [[nodiscard]] double known_separation(double limit, const Memory& memory) const {
    const Shape a = a_, b = b_;
    if (memory.by == Touch::face_a)
      return lowest(a.normal(memory.first), b) - a.offset(memory.first);
    if (memory.by == Touch::face_b)
      return lowest(b.normal(memory.first), a) - b.offset(memory.first);
    return EdgePairs<Lanes>::axis(linked_a(), memory.first, linked_b(), memory.second, limit)
        .separation;
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
  [[nodiscard]] double find_axis(double limit, double reach, Memory& memory) {
    const double by_faces = find_face(limit, reach, memory);
    return memory.apart ? by_faces : find_edges(by_faces, limit, reach, memory);
  }

  /// The same by the faces alone, if what is in `memory` does not keep the shapes apart already.
  [[nodiscard]] double find_face(double limit, double reach, Memory& memory) {
    if (memory.apart) {
      const double known = known_separation(limit, memory);
      if (known > limit) return known;
    }
    const LinkedShape a = linked_a(), b = linked_b();
    const std::size_t half = std::max(a.shape.face_stride(), b.shape.face_stride());
    if (separations_.size() < 2 * half) separations_.resize(2 * half);
    double* const of_faces = separations_.data();
    const double by_a = largest_separation(a.shape, b.shape, of_faces);
    const double by_b = largest_separation(b.shape, a.shape, of_faces + half);
    const bool of_a = by_a >= by_b;
    const double best = of_a ? by_a : by_b;
    const double* const winner = of_a ? of_faces : of_faces + half;
    std::size_t face = 0;
    for (std::size_t k = (of_a ? a : b).shape.face_stride(); k-- > 0;)
      face = winner[k] == best ? k : face;
    memory.first = static_cast<std::uint16_t>(face);
    memory.by = of_a ? Touch::face_a : Touch::face_b;
    memory.apart = best > limit;
    if (memory.apart) return best;

    face_side_ = of_a ? 0 : 1;
    face_normal_ = normal_ = of_a ? a.shape.normal(face) : Vec3(-b.shape.normal(face));
    clip_face(of_a ? a : b, of_a ? b : a, face, reach);
    return best;
  }

  /// The same by the edges, after `find_face` found `best` and did not keep the shapes apart.
  [[nodiscard]] double find_edges(double best, double limit, double reach, Memory& memory) {
    const LinkedShape a = linked_a(), b = linked_b();
    if (settled(a, b, memory.first, reach, best, memory)) {
      memory.apart = best > limit;
      return best;
    }
    if (best <= 0 && clip_.lowest() <= 0) {
      near(a, b, -best);
    } else {
      all(a.topology, edges_of_a_);
      all(b.topology, edges_of_b_);
    }
    const auto edges = edge_pairs_.run(a, edges_of_a_, b, edges_of_b_, best + preference);
    if (edges.separation > best + preference) {
      best = edges.separation;
      normal_ = edges.normal;
      memory.first = edges.edge_a;
      memory.second = edges.edge_b;
      memory.by = Touch::edge_edge;
      memory.apart = best > limit;
    }
    return best;
  }

  /// Finds the face of q that faces the reference face of p at q's deepest vertex, and clips it.
  void clip_face(const LinkedShape& reference, const LinkedShape& incident, std::size_t face,
                 double reach) {
    const Shape &p = reference.shape, &q = incident.shape;
    const FacingFace across = facing_face<Lanes>(reference, face, incident, heights_);
    other_ = across.face;
    deepest_ = q.vertex(across.deepest);
    highest_ = q.vertex(across.highest);
    other_normal_ = face_side_ == 0 ? Vec3(-q.normal(other_)) : q.normal(other_);
    clip_.run(p, reference.topology.loop(face), p.normal(face), q, incident.topology.loop(other_),
              reach);
    area_ = clip_.area();
  }

  /// Tries to settle the pair by the foot on one side of M (see the class): that of the reference
  /// face, else that of the two edges that cross at the deepest point of the clipped polygon, whose
  /// separation and numbers are then put in place of those given.
  [[nodiscard]] bool settled(const LinkedShape& a, const LinkedShape& b, std::size_t face,
                             double reach, double& best, Memory& memory) {
    if (!(area_ > 0)) return false;
    // The angle that a better axis may make with `other_normal_`, as a length on the unit sphere,
    // which for up to 30 degrees is at most 1.04 times its sine.
    const double depth = std::max(0.0, -best), bound = depth + std::max(reach, depth);
    const double squared_sine = bound * bound * clip_.squared_extent() / (area_ * area_);
    if (!(squared_sine < 0.25)) return false;
    const double spread = 1.04 * std::sqrt(squared_sine);

    const bool of_a = face_side_ == 0;
    const double room = clip_.room_around(deepest_);
    if (room >= 0) {
      const Vec3 foot = deepest_ - (of_a ? best : -best) * normal_;
      return is_largest(best, normal_, room, foot, spread);
    }
    const LinkedShape &p = of_a ? a : b, &q = of_a ? b : a;
    const auto sides = clip_.deepest_crossing(q.shape, q.topology.loop(other_));
    const std::uint16_t of_p = p.topology.side(face, sides.reference);
    const std::uint16_t of_q = q.topology.side(other_, sides.other);
    const std::uint16_t edge_a = of_a ? of_p : of_q, edge_b = of_a ? of_q : of_p;
    const auto axis = EdgePairs<Lanes>::axis(a, edge_a, b, edge_b, best + preference);
    if (!(axis.separation > best + preference && axis.is_of_edges())) return false;
    const auto crossing = EdgePairs<Lanes>::crossing(p, of_p, q, of_q);
    if (!(crossing.room >= 0 &&
          is_largest(axis.separation, axis.normal, crossing.room, crossing.point, spread)))
      return false;
    best = axis.separation;
    normal_ = axis.normal;
    memory.first = edge_a;
    memory.second = edge_b;
    memory.by = Touch::edge_edge;
    return true;
  }

  /// Whether no axis separates better than `normal`, on whose side of M the foot lies inside.
  /// @param room    of the foot to the rim, >= 0 [m]
  /// @param foot    a point of the shape with the reference face, that the foot was made of [m]
  /// @param spread  a better axis is no further than this from `other_normal_` or its opposite
  [[nodiscard]] bool is_largest(double separation, const Vec3& normal, double room,
                                const Vec3& foot, double spread) const {
    if (separation >= 0) return true;
    const double depth = -separation, chord = spread + length_of(normal - other_normal_);
    // tan(t / 2) <= 0.6 chord up to a chord of 1.
    if (!(chord < 1 && room >= 0.6 * chord * depth)) return false;
    const Vec3 back = highest_ - foot;
    const double behind = face_side_ == 0 ? dot_product(normal, back) : -dot_product(normal, back);
    return (1 - 0.5 * chord * chord) * behind - chord * length_of(back) > depth;
  }

  /// The edges that come near enough to the other shape. If a pair of edges has the least depth of
  /// all, d* <= depth, the edges touch once b is moved by d* along their normal: they pass each
  /// other within d*. So an edge of a that lies further inside a face of a than b reaches and d*,
  /// or further outside a face of b than d*, plays no part. The two faces of each shape that are
  /// entered least are looked at. If the shapes are apart, although no face says so, the axis
  /// wanted is that of two edges as near as the shapes are, and these are within `depth` too if a
  /// point of the clipped face is below the reference face, for it is no deeper than that.
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
  PlacedShapes<3>::Shifted shifted_;
  std::size_t number_a_ = 0, number_b_ = 0;
  Shape a_{}, b_{};  ///< the pair at hand, counted from the grid point of a
  FaceClip clip_;
  Section section_;
  EdgePairs<Lanes> edge_pairs_;
  // Of the pair at hand, from `find_axis` to `contact`.
  int face_side_ = 0;  ///< whose face is the best: 0 a's, 1 b's
  double area_ = 0;    ///< of the clipped face [m^2]
  Vec3 normal_ = zeros<Vec3>(), face_normal_ = zeros<Vec3>();  ///< from a to b
  // Of the shape across from the reference face: the face that was clipped, its normal as seen from
  // a, and the lowest and the highest vertex over the reference face.
  std::size_t other_ = 0;
  Vec3 other_normal_ = zeros<Vec3>(), deepest_ = zeros<Vec3>(), highest_ = zeros<Vec3>();
  std::vector<Vec3> polygon_;
  EdgeList edges_of_a_, edges_of_b_;
  std::vector<double> separations_, heights_, scores_;
};

}  // namespace voussoir::detail
