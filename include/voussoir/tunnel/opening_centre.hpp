// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

namespace voussoir {

/// The point of a section about which angles of bolts, linings and wall movement are counted [m]:
/// the origin where it lies in the section or on its outline, else the centroid. A tunnel that is
/// drawn about the origin has it in the middle of its springing, one that stands beside it (twin
/// tunnels) in its own middle.
[[nodiscard]] inline Vec2 centre_of(const SimplePolygon& section) {
  Vec2 origin = zeros<Vec2>();
  if (section.contains(origin)) return origin;
  const double near = 1e-9 * section.perimeter();
  for (std::size_t e = 0; e < section.size(); ++e) {
    const Segment edge = section.edge(e);
    const Vec2 along = (edge.end - edge.start) / edge.length(), there = origin - edge.start;
    const double s = dot_product(along, there);
    if (s >= -near && s <= edge.length() + near && std::abs(cross(along, there)) <= near)
      return origin;
  }
  return mass_properties({section.vertices().data(), section.vertices().size()}).centroid;
}
/// In 3-D in the coordinates of the section.
[[nodiscard]] inline Vec2 centre_of(const PrismaticOpening& opening) {
  return centre_of(opening.section());
}

}  // namespace voussoir
