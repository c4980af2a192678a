// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/detail/surface.hpp>
#include <voussoir/geometry/half_space.hpp>

namespace voussoir::detail {

/// Cuts surfaces by planes. Keeps its working memory, so that a cut allocates nothing.
///
/// Only the side of each vertex (below, on, above) is taken from numbers; everything else follows
/// from how faces hang together. Each face is divided into a piece above and the rest, and the cap
/// is walked along the rim between them. The two parts are therefore closed whatever the roundings;
/// what roundings can spoil is that the rim is one simple loop, which is checked.
class SurfaceSplit {
 public:
  Surface below, above;  ///< the parts after `cut` has returned true

  /// @return  whether the plane divides the surface
  /// @cost    linear in the number of half-edges
  [[nodiscard]] bool cut(const Surface& whole, const HalfSpace<3>& plane, int label,
                         double tolerance) {
    measure(whole, plane);
    // Where vertices lie about as far from the plane as the tolerance, roundings may leave a face
    // above the plane in two places. A few tolerances more put all of them on it.
    for (int attempt = 0; attempt < 5; ++attempt, tolerance *= 2) {
      if (!classify(tolerance)) return false;
      if (divide(whole) && close(plane, label)) return true;
    }
    return false;
  }

 private:
  /// An edge between the parts; in the piece above it runs from `from` to `to`, and vertices are
  /// numbered as in `number`.
  struct Rim {
    int above_half, below_half, from, to;
  };
  /// How the numbers of the whole translate to one part.
  struct Map {
    std::vector<int> number;  ///< of each vertex of the whole, then of each new one; -1: not there
    std::vector<int> half;    ///< of each half-edge of the whole; -1: not there
  };

  void measure(const Surface& whole, const HalfSpace<3>& plane) {
    // Relative to one vertex: the differences that decide the side keep their digits far away.
    const Vec3 origin = whole.vertices.front();
    const double here = plane.distance(origin);
    distance_.resize(whole.vertices.size());
    for (std::size_t k = 0; k < distance_.size(); ++k)
      distance_[k] = here + dot_product(plane.normal, whole.vertices[k] - origin);
  }

  [[nodiscard]] bool classify(double tolerance);

  [[nodiscard]] static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  [[nodiscard]] int side(const Surface& whole, int half) const {
    return side_[at(whole.loops[at(half)])];
  }

  void start(const Surface& whole, Surface& part, Map& map) const {
    part.vertices.clear();
    part.loops.clear();
    part.faces.clear();
    map.number.assign(whole.vertices.size() + fresh_.size(), -1);
    map.half.assign(whole.loops.size(), -1);
  }

  /// Appends a half-edge that starts at `vertex`; it is (a piece of) `old_half`, or new if < 0.
  int append(const Surface& whole, Surface& part, Map& map, int vertex, int old_half) const;

  static void finish_face(Surface& part, const HalfSpace<3>& plane, int cut) {
    const int begin = part.faces.empty() ? 0 : part.faces.back().end;
    part.faces.push_back({plane, cut, begin, static_cast<int>(part.loops.size())});
  }

  /// A new vertex on every edge that the plane crosses, one for both of its half-edges.
  void cross_edges(const Surface& whole);

  [[nodiscard]] bool divide(const Surface& whole);

  [[nodiscard]] bool divide_face(const Surface& whole, const Surface::Face& face);

  static void link(const Surface& whole, Surface& part, const Map& map) {
    part.twins.assign(part.loops.size(), -1);
    for (std::size_t h = 0; h < whole.loops.size(); ++h)
      if (map.half[h] >= 0) part.twins[at(map.half[h])] = map.half[at(whole.twins[h])];
  }

  /// Walks the rim and closes both parts by a cap; false if the rim is not one simple loop.
  [[nodiscard]] bool close(const HalfSpace<3>& plane, int label);

  static void join(Surface& part, const Map& map, int vertex, int twin) {
    part.twins[at(twin)] = static_cast<int>(part.loops.size());
    part.loops.push_back(map.number[at(vertex)]);
    part.twins.push_back(twin);
  }

  std::vector<double> distance_;
  std::vector<signed char> side_;  ///< of each vertex: -1 below, 0 on, 1 above the plane
  std::vector<int> crossing_;      ///< of each half-edge that is crossed: its new vertex
  std::vector<Vec3> fresh_;        ///< new vertices
  Map below_, above_;
  std::vector<Rim> rims_;
  std::vector<int> ending_, order_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE bool SurfaceSplit::classify(double tolerance) {
  bool any_below = false, any_above = false;
  side_.resize(distance_.size());
  for (std::size_t k = 0; k < side_.size(); ++k) {
    const double d = distance_[k];
    side_[k] = static_cast<signed char>((d > tolerance) - (d < -tolerance));
    any_below = any_below || side_[k] < 0;
    any_above = any_above || side_[k] > 0;
  }
  return any_below && any_above;
}

VOUSSOIR_INLINE int SurfaceSplit::append(const Surface& whole, Surface& part, Map& map, int vertex,
                                         int old_half) const {
  int& number = map.number[at(vertex)];
  if (number < 0) {
    number = static_cast<int>(part.vertices.size());
    const std::size_t old_count = whole.vertices.size();
    part.vertices.push_back(at(vertex) < old_count ? whole.vertices[at(vertex)]
                                                   : fresh_[at(vertex) - old_count]);
  }
  const int half = static_cast<int>(part.loops.size());
  part.loops.push_back(number);
  if (old_half >= 0) map.half[at(old_half)] = half;
  return half;
}

VOUSSOIR_INLINE void SurfaceSplit::cross_edges(const Surface& whole) {
  fresh_.clear();
  crossing_.resize(whole.loops.size());
  for (std::size_t h = 0; h < whole.loops.size(); ++h) {
    const std::size_t twin = at(whole.twins[h]);
    if (twin < h) continue;
    const std::size_t v = at(whole.loops[h]), w = at(whole.loops[twin]);
    if (side_[v] * side_[w] >= 0) continue;
    crossing_[h] = crossing_[twin] = static_cast<int>(whole.vertices.size() + fresh_.size());
    const double t = distance_[v] / (distance_[v] - distance_[w]);
    fresh_.emplace_back(whole.vertices[v] + t * (whole.vertices[w] - whole.vertices[v]));
  }
}

VOUSSOIR_INLINE bool SurfaceSplit::divide(const Surface& whole) {
  cross_edges(whole);
  start(whole, below, below_);
  start(whole, above, above_);
  rims_.clear();
  for (const Surface::Face& face : whole.faces)
    if (!divide_face(whole, face)) return false;
  // Edges on the plane between a face above and one below.
  for (std::size_t h = 0; h < whole.loops.size(); ++h) {
    const std::size_t twin = at(whole.twins[h]);
    if (above_.half[h] >= 0 && above_.half[twin] < 0)
      rims_.push_back({above_.half[h], below_.half[twin], whole.loops[h], whole.loops[twin]});
  }
  link(whole, below, below_);
  link(whole, above, above_);
  return rims_.size() >= 3;
}

VOUSSOIR_INLINE bool SurfaceSplit::divide_face(const Surface& whole, const Surface::Face& face) {
  int runs = 0, first = 0;
  bool any_below = false, any_above = false;
  int before = side(whole, face.end - 1);
  for (int h = face.begin; h < face.end; ++h) {
    const int here = side(whole, h);
    any_below = any_below || here < 0;
    any_above = any_above || here > 0;
    if (here > 0 && before <= 0) {
      ++runs;
      first = h;
    }
    before = here;
  }
  if (!any_above || !any_below) {
    Surface& part = any_above ? above : below;
    Map& map = any_above ? above_ : below_;
    for (int h = face.begin; h < face.end; ++h) append(whole, part, map, whole.loops[at(h)], h);
    finish_face(part, face.plane, face.cut);
    return runs <= 1;
  }
  if (runs != 1) return false;
  // The piece above: from where the loop comes up through the plane to where it goes down again,
  // and straight back.
  const auto after = [&](int h) { return h + 1 == face.end ? face.begin : h + 1; };
  const int up = first == face.begin ? face.end - 1 : first - 1;
  const bool up_inside = side(whole, up) < 0;  // within an edge, not at a vertex
  const int entry = up_inside ? crossing_[at(up)] : whole.loops[at(up)];
  append(whole, above, above_, entry, up);
  int h = first;
  for (; side(whole, h) > 0; h = after(h)) append(whole, above, above_, whole.loops[at(h)], h);
  const int down = h == face.begin ? face.end - 1 : h - 1;
  const bool down_inside = side(whole, h) < 0;
  const int exit = down_inside ? crossing_[at(down)] : whole.loops[at(h)];
  const int chord_above = append(whole, above, above_, exit, -1);
  finish_face(above, face.plane, face.cut);
  // The rest.
  if (down_inside) append(whole, below, below_, exit, down);
  for (; h != up; h = after(h)) append(whole, below, below_, whole.loops[at(h)], h);
  if (up_inside) append(whole, below, below_, whole.loops[at(up)], up);
  const int chord_below = append(whole, below, below_, entry, -1);
  finish_face(below, face.plane, face.cut);
  rims_.push_back({chord_above, chord_below, exit, entry});
  return true;
}

VOUSSOIR_INLINE bool SurfaceSplit::close(const HalfSpace<3>& plane, int label) {
  ending_.assign(above_.number.size(), -1);
  for (std::size_t r = 0; r < rims_.size(); ++r) {
    int& ending = ending_[at(rims_[r].to)];
    if (ending >= 0) return false;
    ending = static_cast<int>(r);
  }
  order_.clear();
  int r = 0;
  do {
    order_.push_back(r);
    r = ending_[at(rims_[at(r)].from)];
  } while (r > 0);
  if (r < 0 || order_.size() != rims_.size()) return false;
  // Both caps start at the same vertex: a fan over either is then the same surface.
  for (const int k : order_) join(above, above_, rims_[at(k)].to, rims_[at(k)].above_half);
  finish_face(above, {-plane.normal, -plane.offset}, label);
  for (std::size_t k = order_.size(); k-- > 0;)
    join(below, below_, rims_[at(order_[k])].from, rims_[at(order_[k])].below_half);
  finish_face(below, plane, label);
  return true;
}

#endif

}  // namespace voussoir::detail
