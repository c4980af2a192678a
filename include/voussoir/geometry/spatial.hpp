// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/geometry_of.hpp>
#include <voussoir/geometry/joint_plane.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/spatial_facet.hpp>
#include <voussoir/geometry/spatial_line.hpp>
#include <voussoir/geometry/tangent_basis.hpp>

namespace voussoir {

/// Space: convex polyhedra. Everything above this layer knows a geometry only through these names
/// and numbers.
struct Spatial {
  using role = roles::Geometry;
  static constexpr const char* name = "Spatial";
  static constexpr int dim = 3;
  static constexpr int dof = 6;       ///< per body: displacement [m], rotation [rad]
  static constexpr int tangents = 2;  ///< directions in which a contact can slip

  using Shape = ConvexPolyhedron;    ///< part of a body
  using Facet = SpatialFacet;        ///< piece of a face: contact area, piece of wall
  using Trace = JointPlane;          ///< extent of a joint
  using Line = SpatialLine;          ///< a bolt, a scanline
  using Opening = PrismaticOpening;  ///< what an excavation takes out
};

template <>
struct GeometryOf<3> {
  using type = Spatial;
};

}  // namespace voussoir
