// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <voussoir/core/roles.hpp>

namespace voussoir {

template <class Geometry>
concept HasDimensions = requires {
  requires Geometry::dim == 2 || Geometry::dim == 3;
  requires Geometry::dof == 3 * (Geometry::dim - 1);
  requires Geometry::tangents == Geometry::dim - 1;
};
template <class Geometry>
concept HasShapes = requires {
  typename Geometry::Shape;
  typename Geometry::Facet;
  typename Geometry::Trace;
  typename Geometry::Line;
  typename Geometry::Opening;
};

/// The shapes that a calculation is made of, and how many numbers describe a motion.
///
/// What the compiler cannot check: the shapes are of that dimension, and do what those of the
/// models do under the same names.
///
/// Models: Planar, Spatial.
template <class Geometry>
concept GeometryModel = Fills<Geometry, roles::Geometry> && HasName<Geometry> &&
    HasDimensions<Geometry> && HasShapes<Geometry>;

template <class Geometry>
consteval bool explain_geometry() {
  static_assert(Fills<Geometry, roles::Geometry>,
                "geometry: add `using role = voussoir::roles::Geometry`");
  static_assert(HasName<Geometry>, "geometry: add `static constexpr const char* name` for the log");
  static_assert(HasDimensions<Geometry>,
                "geometry: add `static constexpr int dim, dof, tangents`: 2, 3, 1 or 3, 6, 2");
  static_assert(HasShapes<Geometry>,
                "geometry: add the types `Shape`, `Facet`, `Trace`, `Line` and `Opening`");
  return true;
}

}  // namespace voussoir
