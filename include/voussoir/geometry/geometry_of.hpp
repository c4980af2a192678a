// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <voussoir/core/roles.hpp>

namespace voussoir {

/// The geometry of a number of dimensions: the shapes that a calculation is made of, and how many
/// numbers describe a motion. There are two, `Planar` and `Spatial`. Searches for contacts, slicing
/// and carving are written for their shapes, each in its dimension: another type under the same
/// names could not take their place.
template <int Dim>
struct GeometryOf;

template <class Geometry>
concept IsGeometryOfItsDimension = std::same_as<Geometry, typename GeometryOf<Geometry::dim>::type>;

template <class Geometry>
consteval bool explain_geometry() {
  static_assert(IsGeometryOfItsDimension<Geometry>,
                "geometry: it is `Planar` or `Spatial`; there are no others");
  return true;
}

}  // namespace voussoir
