// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voussoir/core/elementary.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/orientation.hpp>

namespace voussoir {

/// How a plane shows in the section at right angles to a tunnel: as a line.
struct TraceInSection {
  double dip;              ///< apparent, from the horizontal of the section [rad], 0 to pi/2
  DipDirection direction;  ///< east: down to the right, looking along the tunnel
  /// Sine of the angle between plane and section, 0 to 1 [-]. Parallel planes a distance s apart
  /// have traces s / sine apart; joints of the area P32 per volume have traces of the length
  /// sine P32 per area. 0: the plane is parallel to the section, and has no trace.
  double sine;
};

/// @param trend   of the tunnel, clockwise from North [rad]
/// @param plunge  of the tunnel below the horizontal [rad], -pi/2 < . < pi/2
/// @return  the trace; a plane that strikes along a level tunnel has its true dip, to the last bit
///
/// Of a level tunnel tan(apparent dip) = tan(dip) sin(dip direction - trend), and the normal of the
/// plane makes sin(dip) cos(dip direction - trend) with the axis.
[[nodiscard]] inline TraceInSection trace_in_section(const Orientation& plane, double trend,
                                                     double plunge = 0) {
  const double turned = plane.dip_direction - trend;
  const double across = elementary::sine(turned), along = elementary::cosine(turned);
  // The upward normal, to the right and upwards in the section.
  const double right = elementary::sine(plane.dip) * across;
  double up = elementary::cosine(plane.dip);
  if (plunge != 0)
    up = up * elementary::cosine(plunge) +
         elementary::sine(plane.dip) * along * elementary::sine(plunge);
  const DipDirection direction = (across < 0) != (up < 0) ? DipDirection::west : DipDirection::east;
  if (plunge == 0 && std::abs(along) < 1e-12) return {plane.dip, direction, 1};
  const double fall = std::abs(right), level = std::abs(up);
  const double sine = elementary::length(fall, level);
  const double dip = sine > 0 ? elementary::angle_of(fall, level) : 0.5 * std::numbers::pi;
  return {std::min(dip, 0.5 * std::numbers::pi), direction, std::min(sine, 1.0)};
}

}  // namespace voussoir
