// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <optional>
#include <utility>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/tunnel/opening_centre.hpp>
#include <voussoir/tunnel/outline_path.hpp>
#include <voussoir/tunnel/ring_nodes.hpp>

namespace voussoir {

/// What of an outline a lining covers, found by its shape.
enum class LinedPart {
  /// From springing to springing: where the outline, going down from its highest edge, becomes
  /// upright, or bends at a corner into what is steeper than 45 degrees.
  roof,
  /// All but the floor: what round the lowest edge is flatter than 45 degrees, of a section with a
  /// floor from floor corner to floor corner, of a circle the lowest quarter.
  roof_and_walls,
  all
};

/// The ring whose arc covers a part of an outline; what else it says stays.
/// @throws InvalidInput  the outline has no such part: nothing that is flatter than 45 degrees
[[nodiscard]] VOUSSOIR_INLINE LiningRing lined_part(const SimplePolygon& opening, LinedPart part,
                                                    LiningRing ring = {});

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE LiningRing lined_part(const SimplePolygon& opening, LinedPart part,
                                      LiningRing ring) {
  constexpr double round = 2 * std::numbers::pi;
  ring.from = 0;
  ring.to = round;
  if (part == LinedPart::all) return ring;
  const detail::OutlinePath path(opening);
  const bool is_roof = part == LinedPart::roof;
  const auto run = is_roof ? detail::roof_of(path) : detail::floor_of(path);
  if (!run)
    throw InvalidInput(is_roof ? "lining: the outline has no roof: no edge leads from right to left"
                               : "lining: the outline has no floor: nothing at its bottom is "
                                 "flatter than 45 degrees; accepted: two angles");
  const Vec2 centre = ring.centre.value_or(centre_of(opening));
  const auto angle = [&](double s) {
    const Vec2 p = path.at(s) - centre;
    return elementary::angle_of(p.y(), p.x());
  };
  ring.from = angle(is_roof ? run->from : run->to);
  ring.to = angle(is_roof ? run->to : run->from);
  if (!(ring.to > ring.from)) ring.to += round;
  return ring;
}

#endif

}  // namespace voussoir
