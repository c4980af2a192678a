// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// The edge of q that faces `normal` most squarely: one of the two at the deepest vertex, for the
/// normals of a polygon go round in order and the opposite of `normal` lies between theirs.
[[nodiscard]] inline std::uint16_t facing_edge(const PlacedShape<2>& q, const Vec2& normal) {
  const double *x = q.normals(0), *y = q.normals(1);
  std::size_t facing = 0;
  double cosine = normal.x() * x[0] + normal.y() * y[0];
  for (std::size_t k = 1; k < q.face_stride(); ++k) {
    const double c = normal.x() * x[k] + normal.y() * y[k];
    facing = c < cosine ? k : facing;
    cosine = std::min(c, cosine);
  }
  return static_cast<std::uint16_t>(facing);
}

/// The number after k of a ring, without a branch.
[[nodiscard]] inline std::size_t following(std::size_t k, std::size_t count) {
  return (k + 1) * static_cast<std::size_t>(k + 1 != count);
}

/// An edge of one polygon clipped to the strip over a face of another.
struct ClippedEdge {
  Vec2 start, end;  ///< in the order in which the coordinate along the face rises [m]
  double length;    ///< seen along the normal of the face [m]
};

/// The strip stands upright on face `face` of p; it is open below and ends at the height `top` [m].
/// @param origin  what the coordinates of the shapes are counted from, added to the ends [m]
[[nodiscard]] inline ClippedEdge clip_edge(const PlacedShape<2>& p, std::size_t face,
                                           const PlacedShape<2>& q, std::size_t edge, double top,
                                           const Vec2& origin) {
  const std::size_t next = following(face, p.vertex_count);
  const Vec2 normal = p.normal(face), along = perpendicular(normal), corner = p.vertex(face);
  // From `low` to `high` the coordinate along the face rises; s is the fraction of the way.
  const Vec2 low = q.vertex(following(edge, q.vertex_count));
  const Vec2 span = q.vertex(edge) - low;
  const double length = dot_product(along, span), start = dot_product(along, low - corner);
  const double height = dot_product(normal, low - corner), rise = dot_product(normal, span);
  const double face_length = dot_product(along, p.vertex(next) - corner);
  const double scale = 1 / length;
  // Where the edge leaves the strip at its top; parallel to the face it never does.
  const double leaves = (top - height) / rise;
  const double highest = rise > 0 ? leaves : 1.0, lowest = rise < 0 ? leaves : 0.0;
  double from = std::max(std::max(0.0, lowest), -start * scale);
  double to = std::min(std::min(1.0, highest), (face_length - start) * scale);
  if (!(from <= to)) from = to = rise > 0 ? 0 : 1;  // a rounding: the deepest point
  const Vec2 start_at = low + origin;
  return {start_at + from * span, start_at + to * span, (to - from) * length};
}

}  // namespace voussoir::detail
