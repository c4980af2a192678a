// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_facet.hpp>

namespace voussoir {

/// The slab that has a facet as its face, which looks where the area vector points; every face has
/// cut 0.
/// @param thickness  [m], > 0
/// @throws InvalidInput  the facet is no convex polygon with an area (3-D), or has no length
[[nodiscard]] inline ConvexPolygon slab_behind(const Segment& facet, double thickness) {
  const Vec2 in = -thickness * normalized(facet.area_vector());
  return ConvexPolygon({facet.start, facet.end, facet.end + in, facet.start + in}, {0, 0, 0, 0});
}

[[nodiscard]] VOUSSOIR_INLINE ConvexPolyhedron slab_behind(const SpatialFacet& facet,
                                                           double thickness);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE ConvexPolyhedron slab_behind(const SpatialFacet& facet, double thickness) {
  const Vec3 in = -thickness * normalized(facet.area_vector());
  const int count = static_cast<int>(facet.vertices.size());
  VOUSSOIR_ASSERT(thickness > 0, "a slab has a thickness");
  std::vector<Vec3> vertices = facet.vertices;
  for (const Vec3& v : facet.vertices) vertices.emplace_back(v + in);
  std::vector<std::vector<int>> faces(2);
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    faces[0].push_back(k);
    faces[1].push_back(2 * count - 1 - k);
    faces.push_back({k, count + k, count + next, next});
  }
  const std::vector<int> cuts(faces.size(), 0);
  return ConvexPolyhedron(std::move(vertices), faces, cuts);
}

#endif

}  // namespace voussoir
