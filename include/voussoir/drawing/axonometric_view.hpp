// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Parallel projection of space on a picture: parallel lines stay parallel, and equal lengths along
/// one direction stay equal. World axes: x East, y North, z up.
class AxonometricView {
 public:
  /// @param azimuth    where the viewer stands, clockwise from North [rad]; 5 pi / 4: South-West
  /// @param elevation  how high above the horizontal [rad], -pi/2 to pi/2
  /// @throws InvalidInput
  AxonometricView(double azimuth, double elevation) {
    require(std::isfinite(azimuth), "azimuth of the view", azimuth, "finite");
    require(std::abs(elevation) <= 0.5 * std::numbers::pi, "elevation of the view", elevation,
            "-pi/2 to pi/2");
    const double level = std::cos(elevation);
    towards_ = Vec3(level * std::sin(azimuth), level * std::cos(azimuth), std::sin(elevation));
    right_ = Vec3(-std::cos(azimuth), std::sin(azimuth), 0);
    up_ = cross(towards_, right_);
  }

  /// Unit vectors towards the viewer, and to the right and up in the picture.
  [[nodiscard]] const Vec3& towards() const { return towards_; }
  [[nodiscard]] const Vec3& right() const { return right_; }
  [[nodiscard]] const Vec3& up() const { return up_; }

  /// Place in the picture of a point or a direction [m].
  [[nodiscard]] Vec2 operator()(const Vec3& p) const { return {right_.dot(p), up_.dot(p)}; }

 private:
  Vec3 towards_, right_, up_;
};

}  // namespace voussoir
