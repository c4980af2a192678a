// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/repeatable.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// How a plane lies in space, as a geologist's compass reads it. Axes: x East, y North, z up.
struct Orientation {
  double dip;            ///< below the horizontal, along the steepest line [rad], 0 to pi/2
  double dip_direction;  ///< azimuth of that line, clockwise from North [rad], 0 to 2 pi
};

/// The plane whose strike is written by the right-hand rule: it falls to the right of that
/// direction, a quarter turn clockwise from it.
/// @param strike  azimuth, clockwise from North [rad], 0 to 2 pi
[[nodiscard]] inline Orientation orientation_by_strike(double strike, double dip) {
  const double direction = strike + 0.5 * std::numbers::pi, turn = 2 * std::numbers::pi;
  return {dip, direction >= turn ? direction - turn : direction};
}

/// The same plane by a dip of 0 to pi/2 and a direction of 0 to 2 pi. Some write a dip beyond
/// pi/2 for an overturned bed: 105 deg towards 090 is 75 deg towards 270.
/// @pre  dip from 0 to pi, direction from -2 pi to 4 pi
[[nodiscard]] inline Orientation upright(const Orientation& plane) {
  constexpr double pi = std::numbers::pi;
  const bool is_overturned = plane.dip > 0.5 * pi;
  double direction = plane.dip_direction + (is_overturned ? pi : 0);
  while (direction >= 2 * pi) direction -= 2 * pi;
  while (direction < 0) direction += 2 * pi;
  return {is_overturned ? pi - plane.dip : plane.dip, direction};
}

/// Unit vector down the dip.
[[nodiscard]] inline Vec3 dip_vector(const Orientation& plane) {
  using namespace repeatable;
  const auto [fall, level] = sine_cosine(plane.dip);
  const auto [east, north] = sine_cosine(plane.dip_direction);
  return {product(level, east), product(level, north), -fall};
}

/// Unit vector along the strike, the plane falling to its right (right-hand rule): it is a quarter
/// turn to the left of the dip direction, and cross(dip, strike) points upward.
[[nodiscard]] inline Vec3 strike_vector(const Orientation& plane) {
  const auto [east, north] = repeatable::sine_cosine(plane.dip_direction);
  return {-north, east, 0};
}

/// Unit normal that points upward: 30 deg towards 090 gives (sin 30, 0, cos 30).
[[nodiscard]] inline Vec3 upward_normal(const Orientation& plane) {
  using namespace repeatable;
  const auto [level, up] = sine_cosine(plane.dip);
  const auto [east, north] = sine_cosine(plane.dip_direction);
  return {product(level, east), product(level, north), up};
}

/// Dip and dip direction of the plane with this normal, of either sense and any length > 0. A
/// horizontal plane has dip direction 0.
[[nodiscard]] inline Orientation orientation_of(const Vec3& normal) {
  const Vec3 up = normal.z() < 0 ? Vec3(-normal) : normal;
  const double level = elementary::length(up.x(), up.y());
  if (!(level > 0)) return {0, 0};
  const double azimuth = elementary::angle_of(up.x(), up.y());
  return {elementary::angle_of(level, up.z()),
          azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth};
}

/// Mean orientation of planes given by their normals, of either sense: the direction of the sum of
/// the normals, each turned to their common side. For sets that scatter less than 90
/// degrees about their mean.
/// @pre  at least one normal
[[nodiscard]] VOUSSOIR_INLINE Orientation mean_orientation(std::span<const Vec3> normals);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE Orientation mean_orientation(std::span<const Vec3> normals) {
  Vec3 side = normals.front();
  for (int round = 0; round < 2; ++round) {  // the first normal may be an outlier, its mean is not
    Vec3 sum = zeros<Vec3>();
    for (const Vec3& normal : normals)
      sum += dot_product(normal, side) < 0 ? Vec3(-normal) : normal;
    side = sum;
  }
  return orientation_of(side);
}

#endif

}  // namespace voussoir
