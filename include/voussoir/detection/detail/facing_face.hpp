// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/edge_pairs.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir::detail {

/// What of a polyhedron lies across a face of another.
struct FacingFace {
  std::size_t face = 0;     ///< the one at the deepest vertex that faces the other most squarely
  std::size_t deepest = 0;  ///< vertex, lowest over the other face
  std::size_t highest = 0;  ///< vertex
};

/// @param p, face  the face that q lies across
/// @param heights  working memory: those of the vertices of q along its normal are left there [m]
template <class Lanes>
[[nodiscard]] FacingFace facing_face(const LinkedShape& p, std::size_t face, const LinkedShape& q,
                                     std::vector<double>& heights) {
  const PlacedShape<3>& shape = q.shape;
  const Vec3 normal = p.shape.normal(face);
  if (heights.size() < shape.vertex_stride()) heights.resize(shape.vertex_stride());
  for (std::size_t k = 0; k < shape.vertex_stride(); k += lane_count)
    (Lanes::all(normal[0]) * Lanes::load(shape.vertices(0) + k) +
     Lanes::all(normal[1]) * Lanes::load(shape.vertices(1) + k) +
     Lanes::all(normal[2]) * Lanes::load(shape.vertices(2) + k))
        .store(heights.data() + k);
  FacingFace found;
  double low = heights[0], high = low;
  for (std::size_t k = 1; k < shape.vertex_count; ++k) {
    found.deepest = heights[k] < low ? k : found.deepest;
    low = std::min(low, heights[k]);
    found.highest = heights[k] > high ? k : found.highest;
    high = std::max(high, heights[k]);
  }
  double facing = std::numeric_limits<double>::infinity();
  const auto look_at = [&](std::size_t vertex) {
    for (const std::uint16_t candidate : q.topology.faces_at(vertex)) {
      const double cosine = dot_product(normal, shape.normal(candidate));
      found.face = cosine < facing ? candidate : found.face;
      facing = std::min(facing, cosine);
    }
  };
  look_at(found.deepest);
  // Where vertices stand out of faces, the deepest may not be of the face that touches.
  const double uneven = p.topology.unevenness + q.topology.unevenness;
  if (uneven > EdgePairs<Lanes>::rounding)
    for (std::size_t k = 0; k < shape.vertex_count; ++k)
      if (heights[k] <= low + 2 * uneven) look_at(k);
  return found;
}

}  // namespace voussoir::detail
