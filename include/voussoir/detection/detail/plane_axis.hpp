// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/lanes.hpp>
#include <voussoir/detection/detail/least_excess.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// Least height of the vertices along a direction [m].
template <int Dim>
[[nodiscard]] double lowest(const PlacedShape<Dim>& shape, const Vec<Dim>& direction) {
  using Lanes = VectorLanes;
  Lanes low = Lanes::all(std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < shape.vertex_stride(); k += lane_count) {
    Lanes height = Lanes::load(shape.vertices(0) + k) * Lanes::all(direction[0]);
    for (int axis = 1; axis < Dim; ++axis)
      height = height + Lanes::load(shape.vertices(axis) + k) * Lanes::all(direction[axis]);
    low = min(low, height);
  }
  return low.smallest();
}

/// The outward normal of the face of `shape` that `other` has to move least along to leave it,
/// and how far away it is then [m], < 0.
template <int Dim>
struct ShallowFace {
  Vec<Dim> normal = zeros<Vec<Dim>>();
  double separation = -std::numeric_limits<double>::infinity();

  ShallowFace(const PlacedShape<Dim>& shape, const PlacedShape<Dim>& other) {
    for (std::size_t face = 0; face < shape.face_count; ++face) {
      const Vec<Dim> n = shape.normal(face);
      if (const double found = lowest<Dim>(other, n) - shape.offset(face); found > separation) {
        separation = found;
        normal = n;
      }
    }
  }
};

/// How far apart the planes of either shape keep the other at most [m].
template <int Dim>
[[nodiscard]] double largest_separation_by_faces(const PlacedShape<Dim>& a,
                                                 const PlacedShape<Dim>& b) {
  return std::max(ShallowFace<Dim>(a, b).separation, ShallowFace<Dim>(b, a).separation);
}

/// Normal, from a to b, of the face of either that is left by the shortest way. Of equals the one
/// of the shape with the lower number, so that (b, a) has the opposite normal.
/// @param in_order  whether a has the lower number
template <int Dim>
[[nodiscard]] Vec<Dim> shallowest_normal(const PlacedShape<Dim>& a, const PlacedShape<Dim>& b,
                                         bool in_order) {
  const PlacedShape<Dim>&first = in_order ? a : b, &second = in_order ? b : a;
  const ShallowFace<Dim> of_first(first, second), of_second(second, first);
  const bool use_first = of_first.separation >= of_second.separation;
  const Vec<Dim> n = use_first ? of_first.normal : of_second.normal;
  return use_first == in_order ? n : Vec<Dim>(-n);
}

/// A separating axis in terms of planes of the shapes, so that it moves with them.
///
/// Where the linear program finds two shapes apart, a convex combination of its active normals is
/// 0; the part of it that comes from a is the direction in which a ends before b begins. In the
/// plane one shape has a single active plane, whose normal this is. In 3-D two may come from
/// each; then it is perpendicular to the edge that each two meet in.
///
/// A positive separation along any direction proves the shapes apart, so nothing has to be checked
/// but the vertices, whatever has moved since.
template <int Dim>
class PlaneAxis {
 public:
  /// Takes the best axis of those that the active planes define, if they are to separate at all.
  void set(const PlacedShape<Dim>& a, const PlacedShape<Dim>& b, const ActivePlanes<Dim>& active,
           bool apart) {
    active_ = active;
    choice_ = none;
    if (!apart) return;
    double best = 0;
    for (std::uint8_t choice = 0; choice <= edges; ++choice)
      if (const double separation = along(a, b, choice); separation > best) {
        best = separation;
        choice_ = choice;
      }
  }

  [[nodiscard]] bool separates(const PlacedShape<Dim>& a, const PlacedShape<Dim>& b) const {
    return choice_ != none && along(a, b, choice_) > 0;
  }
  /// How far apart the plane in use as an axis keeps the shapes [m]; -infinity if it is none.
  [[nodiscard]] double separation_by_face(const PlacedShape<Dim>& a,
                                          const PlacedShape<Dim>& b) const {
    return choice_ <= Dim ? along(a, b, choice_) : never;
  }
  [[nodiscard]] const ActivePlanes<Dim>& active() const { return active_; }

 private:
  // Choices: the normal of active plane 0 to Dim, and
  static constexpr std::uint8_t edges = Dim == 3 ? Dim + 1 : Dim, none = Dim + 2;
  static constexpr double never = -std::numeric_limits<double>::infinity();

  /// Separation along a direction [m]; `never` if it is not defined.
  [[nodiscard]] double along(const PlacedShape<Dim>& a, const PlacedShape<Dim>& b,
                             std::uint8_t choice) const {
    if (choice > Dim) return along_edges(a, b);
    const std::size_t plane = active_[choice];
    if (plane < a.face_count) return lowest<Dim>(b, a.normal(plane)) - a.offset(plane);
    const std::size_t face = plane - a.face_count;
    if (face < b.face_count) return lowest<Dim>(a, b.normal(face)) - b.offset(face);
    return never;
  }

  [[nodiscard]] double along_edges(const PlacedShape<Dim>& a, const PlacedShape<Dim>& b) const {
    if constexpr (Dim == 3) {
      std::array<Vec3, 4> normals;  // of a from the front, of b from the back
      std::size_t of_a = 0, of_b = 0;
      for (const std::size_t plane : active_) {
        if (plane < a.face_count)
          normals[of_a++] = a.normal(plane);
        else if (plane - a.face_count < b.face_count)
          normals[3 - of_b++] = b.normal(plane - a.face_count);
      }
      if (of_a != 2 || of_b != 2) return never;
      Vec3 n = cross(cross(normals[0], normals[1]), cross(normals[2], normals[3]));
      const double length = length_of(n);
      if (!(length > 0)) return never;
      n *= (dot_product(n, normals[0] + normals[1]) < 0 ? -1 : 1) / length;
      return lowest<3>(b, n) + lowest<3>(a, -n);
    }
    return never;
  }

  ActivePlanes<Dim> active_ = no_planes<Dim>;
  std::uint8_t choice_ = none;
};

}  // namespace voussoir::detail
