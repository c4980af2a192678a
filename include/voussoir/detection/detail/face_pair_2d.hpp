// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/detail/edge_clip.hpp>
#include <voussoir/detection/detail/facing_contact.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// Two convex polygons: separating axes, then the touching edge clipped to the face it touches.
///
/// What limits it: 32 dot products for two quadrilaterals in vector lanes, the divisions of the
/// clip, and one branch that nobody can foresee (do they touch). The face that decided last time
/// is tried first; a pair that it still keeps apart costs four dot products.
template <class Lanes>
class FacePair2 {
 public:
  /// The face that decided last time. It saves time and never changes an answer.
  struct Memory {
    std::uint16_t face = 0;
    std::uint16_t edge = 0;  ///< of the other shape, facing it
    std::uint8_t side = 0;   ///< 0: a face of a, 1: a face of b
    bool apart = true;
  };

  explicit FacePair2(const PlacedShapes<2>& shapes) : shapes_(&shapes) {}

  [[nodiscard]] bool overlap(std::size_t a, std::size_t b, Memory& memory) {
    return find_axis((*shapes_)[a], shapes_->seen_from(a, b, shifted_), 0, memory) < 0;
  }

  [[nodiscard]] double separation(std::size_t a, std::size_t b, Memory& memory,
                                  double enough = std::numeric_limits<double>::infinity()) {
    return find_axis((*shapes_)[a], shapes_->seen_from(a, b, shifted_), enough, memory);
  }

  [[nodiscard]] Contact<2> contact(std::size_t a, std::size_t b, Memory& memory, double reach) {
    return contact_from(shapes_->grid_point(a), a, b, memory, reach);
  }
  [[nodiscard]] Contact<2> contact_near(std::size_t a, std::size_t b, Memory& memory,
                                        double reach) {
    return contact_from(zeros<Vec2>(), a, b, memory, reach);
  }
  [[nodiscard]] Contact<2> facing_contact(std::size_t a, std::size_t b, Memory& memory,
                                          double reach) {
    return detail::facing_contact(*this, a, b, memory, reach);
  }

 private:
  /// @param grid_point  of a, or 0 if points are to be counted from it
  [[nodiscard]] Contact<2> contact_from(const Vec2& grid_point, std::size_t a, std::size_t b,
                                        Memory& memory, double reach) {
    const PlacedShape<2> shape_a = (*shapes_)[a], shape_b = shapes_->seen_from(a, b, shifted_);
    Memory guess = memory;
    const double separation = find_axis(shape_a, shape_b, reach, memory);
    Contact<2> found;
    if (!(separation <= reach)) return found;
    found.separation = separation;
    const bool of_a = memory.side == 0;
    const PlacedShape<2>&p = of_a ? shape_a : shape_b, &q = of_a ? shape_b : shape_a;
    memory.edge = facing_edge(q, p.normal(memory.face));
    // Almost always all is as it was. The processor foresees that, and clips what was remembered
    // while it still looks for the axis.
    if (memory.face == guess.face && memory.edge == guess.edge && memory.side == guess.side) {
      opaque(guess);
      const bool was_of_a = guess.side == 0;
      clip(was_of_a ? shape_a : shape_b, was_of_a ? shape_b : shape_a, guess, reach, grid_point,
           found);
    } else {
      clip_anew(p, q, memory, reach, grid_point, found);
    }
    return found;
  }

  /// How far face `face` of p keeps q away [m].
  [[nodiscard]] static double separation_by(const PlacedShape<2>& p, std::size_t face,
                                            const PlacedShape<2>& q) {
    const Lanes nx = Lanes::all(p.normals(0)[face]), ny = Lanes::all(p.normals(1)[face]);
    const double *x = q.vertices(0), *y = q.vertices(1);
    Lanes low = nx * Lanes::load(x) + ny * Lanes::load(y);
    for (std::size_t k = lane_count; k < q.vertex_stride(); k += lane_count)
      low = min(low, nx * Lanes::load(x + k) + ny * Lanes::load(y + k));
    return low.smallest() - p.offset(face);
  }

  /// How far the faces of p keep q away at most; one number per face is left in `separations`.
  [[nodiscard]] static double largest_separation(const PlacedShape<2>& p, const PlacedShape<2>& q,
                                                 double* separations) {
    const double *x = q.vertices(0), *y = q.vertices(1);
    Lanes best = Lanes::all(-std::numeric_limits<double>::infinity());
    for (std::size_t group = 0; group < p.face_stride(); group += lane_count) {
      const Lanes nx = Lanes::load(p.normals(0) + group), ny = Lanes::load(p.normals(1) + group);
      const auto along = [&](std::size_t k) {
        return nx * Lanes::all(x[k]) + ny * Lanes::all(y[k]);
      };
      // By whole groups: how many vertices there are is then seldom a surprise to the processor.
      Lanes low = min(min(along(0), along(1)), min(along(2), along(3)));
      for (std::size_t k = lane_count; k < q.vertex_stride(); k += lane_count)
        low = min(low, min(min(along(k), along(k + 1)), min(along(k + 2), along(k + 3))));
      low = low - Lanes::load(p.offsets() + group);
      low.store(separations + group);
      best = max(best, low);
    }
    return best.largest();
  }

  /// The largest separation, or the first one found that keeps the shapes apart by more than
  /// `reach`; the face is left in `memory`. Written without branches that depend on the pair, but
  /// for the one that tells whether it touches.
  [[nodiscard]] double find_axis(const PlacedShape<2>& a, const PlacedShape<2>& b, double reach,
                                 Memory& memory) {
    if (memory.apart) {
      const bool of_a = memory.side == 0;
      const double known = separation_by(of_a ? a : b, memory.face, of_a ? b : a);
      if (known > reach) return known;
    }
    const std::size_t half = std::max(a.face_stride(), b.face_stride());
    if (separations_.size() < 2 * half) separations_.resize(2 * half);
    double* const of_faces = separations_.data();
    const double by_a = largest_separation(a, b, of_faces);
    const double by_b = largest_separation(b, a, of_faces + half);
    const bool of_a = by_a >= by_b;
    const double best = of_a ? by_a : by_b;
    const double* const winner = of_a ? of_faces : of_faces + half;
    const std::size_t count = of_a ? a.face_stride() : b.face_stride();
    std::size_t face = 0;
    for (std::size_t k = count; k-- > 0;) face = winner[k] == best ? k : face;
    memory.face = static_cast<std::uint16_t>(face);
    memory.side = of_a ? 0 : 1;
    memory.apart = best > reach;
    return best;
  }

  /// Clips the edge of q that faces the given face of p to what lies in front of that face.
  void clip(const PlacedShape<2>& p, const PlacedShape<2>& q, const Memory& axis, double reach,
            const Vec2& grid_point, Contact<2>& found) {
    const ClippedEdge clipped = clip_edge(p, axis.face, q, axis.edge, reach, grid_point);
    ends_[axis.side] = clipped.start;
    ends_[1 - axis.side] = clipped.end;
    found.touch = axis.side == 0 ? Touch::face_a : Touch::face_b;
    found.normal = (1.0 - 2.0 * axis.side) * p.normal(axis.face);
    found.measure = clipped.length;
    found.polygon = ends_;
  }

  void clip_anew(const PlacedShape<2>& p, const PlacedShape<2>& q, const Memory& axis, double reach,
                 const Vec2& grid_point, Contact<2>& found) {
    clip(p, q, axis, reach, grid_point, found);
  }

  /// Hides from the compiler that a value is known.
  static void opaque(Memory& memory) {
#if defined(__GNUC__)
    asm("" : "+m"(memory));
#else
    (void)memory;
#endif
  }

  const PlacedShapes<2>* shapes_;
  PlacedShapes<2>::Shifted shifted_;
  std::array<Vec2, 2> ends_;
  std::vector<double, Eigen::aligned_allocator<double>> separations_;  ///< by the faces of a, of b
};

}  // namespace voussoir::detail
