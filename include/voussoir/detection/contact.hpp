// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Which features of two shapes touch.
enum class Touch : unsigned char {
  none,       ///< apart
  face_a,     ///< a face of a, and a face, edge or vertex of b
  face_b,     ///< a face of b, and a face, edge or vertex of a
  edge_edge,  ///< an edge of each (3-D)
  interior    ///< no features: a method that looks at the overlap as a whole
};

/// How two convex shapes touch.
///
/// The normal points from a to b. The polygon (2-D: the two ends of a segment) is the area over
/// which they touch; its points are valid until the next query of the same detector object.
template <int Dim>
struct Contact {
  Touch touch = Touch::none;
  Vec<Dim> normal = zeros<Vec<Dim>>();
  double separation = 0;              ///< along the normal, < 0: depth of the overlap [m]
  double measure = 0;                 ///< length (2-D) or area (3-D) of the polygon [m], [m^2]
  std::span<const Vec<Dim>> polygon;  ///< 3-D: anticlockwise seen from b [m]
};

}  // namespace voussoir
