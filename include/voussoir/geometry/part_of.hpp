// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/joint_plane.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_facet.hpp>

namespace voussoir {

/// What of a facet lies in a half space; none: no part that reaches further than `tolerance` into
/// it [m].
[[nodiscard]] inline std::optional<Segment> part_of(const Segment& facet, const HalfSpace<2>& side,
                                                    double tolerance) {
  return split(facet, side, tolerance).below;
}
/// Of a facet in 3-D. @cost  linear in its corners
[[nodiscard]] inline std::optional<SpatialFacet> part_of(const SpatialFacet& facet,
                                                         const HalfSpace<3>& side,
                                                         double tolerance) {
  const HalfSpace<3> plane =
      HalfSpace<3>::through(facet.vertices.front(), normalized(facet.area_vector()));
  JointPlaneSplit parts = split(JointPlane{plane, facet.vertices}, side, tolerance);
  if (!parts.below) return {};
  return SpatialFacet{std::move(parts.below->corners)};
}

/// What of a convex shape lies in a half space; the new face has no cut.
template <class Shape>
[[nodiscard]] std::optional<Shape> part_of(const Shape& shape, const HalfSpace<Shape::dim>& side,
                                           double tolerance) {
  if (auto parts = shape.split(side, no_cut, tolerance)) return std::move(parts->first);
  if (side.distance(mass_properties(shape).centroid) > 0) return {};
  return shape;
}

}  // namespace voussoir
