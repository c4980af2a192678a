// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>

namespace voussoir {

/// The rectangular (box-shaped) piece of ground that is modelled. Its top is the ground surface.
///
/// Coordinates are local, with the origin at the opening; where a site grid is in use,
/// `site_origin` is the origin's place on it. Keeping the numbers small keeps 1e6 m of easting out
/// of the roundings.
template <int Dim>
struct Domain {
  Vec<Dim> low, high;                       ///< corners [m]
  Vec<Dim> site_origin = Vec<Dim>::Zero();  ///< [m]

  [[nodiscard]] Vec<Dim> size() const { return high - low; }
  [[nodiscard]] double measure() const { return size().prod(); }
  [[nodiscard]] double diameter() const { return size().norm(); }
  [[nodiscard]] double surface() const { return high[Dim - 1]; }
  [[nodiscard]] double depth(const Vec<Dim>& p) const { return surface() - p[Dim - 1]; }

  /// Vertices closer than this are one vertex; a facet shorter than this is none [m].
  [[nodiscard]] double tolerance() const { return 1e-10 * diameter(); }

  /// @throws InvalidInput  a side is not positive or not finite
  void check() const {
    if (!(low.allFinite() && high.allFinite() && (size().array() > 0).all()))
      throw InvalidInput("domain: every side must be positive and finite");
  }
};

/// The sides of the domain, as labels of the faces of the uncut ground.
enum class Side { left = 0, bottom = 1, right = 2, top = 3 };

/// The uncut ground as one block, face k labelled with side k in the order of the faces.
[[nodiscard]] inline ConvexPolygon as_block(const Domain<2>& domain) {
  const Vec2 &a = domain.low, &b = domain.high;
  return ConvexPolygon({{a.x(), b.y()}, {a.x(), a.y()}, {b.x(), a.y()}, {b.x(), b.y()}},
                       {static_cast<int>(Side::left), static_cast<int>(Side::bottom),
                        static_cast<int>(Side::right), static_cast<int>(Side::top)});
}

}  // namespace voussoir
