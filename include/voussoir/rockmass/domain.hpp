// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/repeatable.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>

namespace voussoir {

/// The rectangular (box-shaped) piece of ground that is modelled. Its top is the ground surface.
///
/// Coordinates are local, with the origin at the opening; where a site grid is in use,
/// `site_origin` is the origin's place on it. Keeping the numbers small keeps 1e6 m of easting out
/// of the roundings.
template <int Dim>
struct Domain {
  Vec<Dim> low, high;                        ///< corners [m]
  Vec<Dim> site_origin = zeros<Vec<Dim>>();  ///< [m]

  [[nodiscard]] Vec<Dim> size() const { return high - low; }
  [[nodiscard]] double measure() const { return product_of_entries(size()); }
  [[nodiscard]] double diameter() const { return repeatable::norm<Dim>(size()); }
  [[nodiscard]] double surface() const { return high[Dim - 1]; }
  [[nodiscard]] double depth(const Vec<Dim>& p) const { return surface() - p[Dim - 1]; }

  /// Vertices closer than this are one vertex; a facet shorter (narrower) than this is none [m].
  /// Where the domain lies a million of its sizes from the origin the rounding of coordinates
  /// decides.
  [[nodiscard]] double tolerance() const {
    const double largest = largest_entry(larger_of(magnitudes(low), magnitudes(high)));
    return std::max(1e-10 * diameter(), 8 * std::numeric_limits<double>::epsilon() * largest);
  }

  /// @throws InvalidInput  a side is not positive or not finite, or too long to be squared
  void check() const {
    if (!(is_finite(low) && is_finite(high) && all_less(low, high) && std::isfinite(diameter()) &&
          std::isfinite(measure())))
      throw InvalidInput("domain: every side must be positive and finite");
  }
};

/// The sides of the domain, as labels of the faces of the uncut ground.
enum class Side { left = 0, bottom = 1, right = 2, top = 3 };
/// The same in 3-D: x points East, y North, z up.
enum class SpatialSide { west = 0, bottom = 1, east = 2, top = 3, south = 4, north = 5 };
template <int Dim>
using SideOf = std::conditional_t<Dim == 2, Side, SpatialSide>;

/// The uncut ground as one block, face k labelled with side k in the order of the faces.
[[nodiscard]] inline ConvexPolygon as_block(const Domain<2>& domain) {
  const Vec2 &a = domain.low, &b = domain.high;
  return ConvexPolygon({{a.x(), b.y()}, {a.x(), a.y()}, {b.x(), a.y()}, {b.x(), b.y()}},
                       {static_cast<int>(Side::left), static_cast<int>(Side::bottom),
                        static_cast<int>(Side::right), static_cast<int>(Side::top)});
}
[[nodiscard]] VOUSSOIR_INLINE ConvexPolyhedron as_block(const Domain<3>& domain);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE ConvexPolyhedron as_block(const Domain<3>& domain) {
  // Corner k has the higher x, y, z where bits 0, 1, 2 of k are set.
  std::vector<Vec3> corners;
  corners.reserve(8);
  for (int k = 0; k < 8; ++k)
    corners.emplace_back((k & 1 ? domain.high : domain.low).x(),
                         (k & 2 ? domain.high : domain.low).y(),
                         (k & 4 ? domain.high : domain.low).z());
  // West, bottom, east, top, south, north; anticlockwise seen from outside.
  return ConvexPolyhedron(
      std::move(corners),
      {{0, 4, 6, 2}, {0, 2, 3, 1}, {1, 3, 7, 5}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}},
      {0, 1, 2, 3, 4, 5});
}

#endif

}  // namespace voussoir
