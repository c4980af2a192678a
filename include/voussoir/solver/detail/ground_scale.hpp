// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// Lower and upper corner of what openings take of the section, and their middle in the domain.
struct OpenBox {
  double longer_side, height_of_middle;  ///< [m]
};
/// Of a section that is excavated in rounds: of all of them together.
[[nodiscard]] inline OpenBox open_box(const RockMass<Planar>& mass) {
  Vec2 low = mass.openings.front().vertices().front(), high = low;
  for (const SimplePolygon& opening : mass.openings)
    for (const Vec2& v : opening.vertices()) {
      low = smaller_of(low, v);
      high = larger_of(high, v);
    }
  return {std::max(high.x() - low.x(), high.y() - low.y()), 0.5 * (low.y() + high.y())};
}
/// Of the tunnel with the largest section: drifts that cross it are no part of its span.
[[nodiscard]] inline OpenBox open_box(const RockMass<Spatial>& mass) {
  OpenBox largest{0, 0};
  for (const PrismaticOpening& opening : mass.openings) {
    const auto [low, high] = opening.local_box();
    const double side = std::max(high.x() - low.x(), high.y() - low.y());
    if (!(side > largest.longer_side)) continue;
    // Where it ends may be far outside.
    const auto [from, to] = stretch_inside(opening, mass.domain);
    const Vec2 middle(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()));
    largest = {side, opening.in_space(middle, 0.5 * (from + to)).z()};
  }
  return largest;
}

/// What movements are measured by: see `GroundScale`.
template <class Geometry>
[[nodiscard]] GroundScale ground_scale(const RockMass<Geometry>& mass, const InSitu& in_situ,
                                       const FarField<Geometry::dim>& far_field) {
  constexpr int dim = Geometry::dim;
  GroundScale scale;
  const double top = mass.domain.high[dim - 1];
  double height = 0.5 * (top + mass.domain.low[dim - 1]);
  if (!mass.openings.empty()) {
    const OpenBox box = open_box(mass);
    scale.span = box.longer_side;
    height = box.height_of_middle;
  }
  scale.pressure = in_situ.template stress<dim>(std::max(0.0, top - height)).trace() / dim;
  if (far_field.has(Boundary::elastic)) {
    scale.modulus = 0;
    for (int k = 0; k < dim; ++k) scale.modulus += far_field.moduli()(k, k) / dim;
  }
  return scale;
}

}  // namespace voussoir::detail
