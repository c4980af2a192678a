// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir::detail {

/// (cos, sin) of an angle in degrees, exact at multiples of 90.
[[nodiscard]] VOUSSOIR_INLINE Vec2 direction_of_degrees(double degrees);

/// Chords for `turns` of a circle, so that none lies further than `sagitta` from its arc; those of
/// a full turn are eight or more and a multiple of four. A whole number, which may be too large to
/// do anything with.
///
///   sagitta = r (1 - cos(step / 2)) = 2 r sin^2(step / 4)
///
/// @param turns    part of the full turn [-], > 0
/// @param radius   r [m], > 0
/// @param sagitta  [m], > 0
[[nodiscard]] VOUSSOIR_INLINE double chords_of_arc(double turns, double radius, double sagitta);

/// The arc from `a` to `b` of two neighbours of a polyline, as DXF writes it.
///
///   bulge = tan(angle / 4), positive where the arc runs anticlockwise from a to b
///
/// Source: Autodesk, DXF Reference (2018), LWPOLYLINE, group code 42.
struct BulgeArc {
  /// @pre  a != b, bulge != 0
  VOUSSOIR_INLINE BulgeArc(const Vec2& a, const Vec2& b, double bulge);
  /// Point at `fraction` of the way from a (0) to b (1), on the arc to rounding however flat it is.
  [[nodiscard]] VOUSSOIR_INLINE Vec2 at(double fraction) const;

  Vec2 middle, along, outwards;  ///< of the chord [m]; unit vectors from a to b and to the arc
  double half_angle, radius;     ///< half of the arc's angle [rad]; [m]
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE Vec2 direction_of_degrees(double degrees) {
  degrees = std::fmod(degrees, 360);
  const double quarter = std::floor(degrees / 90 + 0.5);
  const auto [s, c] = elementary::sine_cosine((degrees - 90 * quarter) * (std::numbers::pi / 180));
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

VOUSSOIR_INLINE double chords_of_arc(double turns, double radius, double sagitta) {
  constexpr double slack = 1e-9;  // of a chord: half a circle has half the chords of a circle
  const double sine = std::min(0.5, std::sqrt(sagitta / (2 * radius)));
  const double step = 4 * elementary::angle_of(sine, std::sqrt(1 - sine * sine));
  const double of_turn = 4 * std::max(2.0, std::ceil(0.5 * std::numbers::pi / step - slack));
  return std::max(1.0, std::ceil(turns * of_turn - slack));
}

VOUSSOIR_INLINE BulgeArc::BulgeArc(const Vec2& a, const Vec2& b, double bulge)
    : middle(0.5 * (a + b)), half_angle(2 * elementary::angle_of(std::abs(bulge), 1)) {
  const Vec2 chord = b - a;
  const double length = elementary::length(chord.x(), chord.y());
  along = chord / length;
  // An anticlockwise arc lies to the right of its chord.
  outwards = bulge > 0 ? Vec2(-perpendicular(along)) : perpendicular(along);
  radius = 0.25 * length * (1 + bulge * bulge) / std::abs(bulge);
}

VOUSSOIR_INLINE Vec2 BulgeArc::at(double fraction) const {
  // From the chord and not from the centre, which is far away for a flat arc: cos t - cos h as a
  // product of sines.
  const double t = half_angle * (2 * fraction - 1);
  const double rise = 2 * radius * elementary::sine(0.5 * (half_angle + t)) *
                      elementary::sine(0.5 * (half_angle - t));
  return middle + (radius * elementary::sine(t)) * along + rise * outwards;
}

#endif

}  // namespace voussoir::detail
