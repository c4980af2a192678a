// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/small_algebra.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Where an opening in 3-D lies: a straight axis and how the section is held to it.
///
/// Seen along the axis the section's x points to the right and its y up: for an axis towards North,
/// which is y, they are x and z of the world. For a shaft sunk from its collar, x is East and y
/// North, and places along the axis are depths below the collar.
///
/// A point has coordinates (x, y of the section; s along the axis), in that order.
class TunnelAxis {
 public:
  /// Along y through the origin.
  TunnelAxis() = default;
  /// @param origin  a point of the axis, from which places along it are counted [m]
  /// @param trend   of the axis, clockwise from North, which is y [rad]
  /// @param plunge  below the horizontal, -pi/2 to pi/2 [rad]; pi/2: a shaft
  /// @throws InvalidInput  not finite, or plunge out of range
  explicit TunnelAxis(const Vec3& origin, double trend = 0, double plunge = 0) : origin_(origin) {
    constexpr double right_angle = 1.5707963267948966;
    if (!is_finite(origin)) throw InvalidInput("tunnel axis: its origin is not finite");
    require_angle(std::isfinite(trend), "trend of the tunnel axis", trend, "a finite angle");
    require_angle(std::abs(plunge) <= right_angle * (1 + 1e-12), "plunge of the tunnel axis",
                  plunge, "-pi/2 to pi/2");
    const double s = exact(elementary::sine(trend)), c = exact(elementary::cosine(trend));
    const double down = exact(elementary::sine(plunge)), level = exact(elementary::cosine(plunge));
    along_ = {level * s, level * c, -down};
    right_ = {c, -s, 0};
    up_ = cross(right_, along_);
    VOUSSOIR_ASSERT(
        std::abs(dot_product(up_, along_)) < 1e-12 && std::abs(dot_product(up_, up_) - 1) < 1e-12,
        "the axes are at right angles and of unit length");
  }

  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] const Vec3& right() const { return right_; }
  [[nodiscard]] const Vec3& up() const { return up_; }
  [[nodiscard]] const Vec3& along() const { return along_; }

  /// The point of the world that lies at a place of the section, `s` along the axis [m].
  [[nodiscard]] Vec3 point(const Vec2& section, double s) const {
    return origin_ + section.x() * right_ + section.y() * up_ + s * along_;
  }
  /// The direction in the world of one in the section.
  [[nodiscard]] Vec3 direction(const Vec2& section) const {
    return section.x() * right_ + section.y() * up_;
  }
  /// A point of the world, seen from the axis: x and y of the section, place along the axis.
  [[nodiscard]] Vec3 local(const Vec3& p) const { return local_direction(Vec3(p - origin_)); }
  [[nodiscard]] Vec3 local_direction(const Vec3& d) const {
    return {dot_product(right_, d), dot_product(up_, d), dot_product(along_, d)};
  }

  /// True if the axes run the same way or opposite ways, within 1e-6 rad.
  [[nodiscard]] bool is_parallel_to(const TunnelAxis& other) const {
    return length_of(cross(along_, other.along_)) < 1e-6;
  }

 private:
  /// Right angles come out as such: cos(pi/2) is 6e-17.
  [[nodiscard]] static double exact(double value) {
    if (std::abs(value) < 1e-15) return 0;
    return std::abs(value) > 1 - 1e-15 ? std::copysign(1.0, value) : value;
  }

  Vec3 origin_ = zeros<Vec3>();
  Vec3 right_{1, 0, 0}, up_{0, 0, 1}, along_{0, 1, 0};
};

}  // namespace voussoir
