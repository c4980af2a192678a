// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/geometry_of.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/geometry/tangent_basis.hpp>

namespace voussoir {

/// Plane strain: convex polygons, one metre thick. Everything above this layer knows a geometry
/// only through these names and numbers.
struct Planar {
  using role = roles::Geometry;
  static constexpr const char* name = "Planar";
  static constexpr int dim = 2;
  static constexpr int dof = 3;       ///< per body: u_x, u_y [m], rotation [rad]
  static constexpr int tangents = 1;  ///< directions in which a contact can slip

  using Shape = ConvexPolygon;    ///< part of a body
  using Facet = Segment;          ///< piece of a face: contact area, piece of wall
  using Trace = Segment;          ///< extent of a joint
  using Line = Segment;           ///< a bolt, a scanline
  using Opening = SimplePolygon;  ///< outline of an excavation
};

template <>
struct GeometryOf<2> {
  using type = Planar;
};

}  // namespace voussoir
