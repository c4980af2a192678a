// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Friction angle that a joint needs to carry the in-situ stress without slipping [rad].
///
///   tan(phi) = |1 - K0| sin d cos d / (cos^2 d + K0 sin^2 d)
///
/// @param k0   horizontal / vertical stress [-], >= 0
/// @param dip  d, from the horizontal [rad]
/// @throws InvalidInput  a value out of range
/// Source: Mohr's circle; the rule of Boon, Houlsby & Utili (2015), section 2.1.
[[nodiscard]] inline double initial_friction(double k0, double dip) {
  require(k0 >= 0 && std::isfinite(k0), "K0", k0, ">= 0");
  require(std::isfinite(dip), "dip", dip, "finite [rad]");
  const double s = std::sin(dip), c = std::cos(dip);
  return std::atan2(std::abs((1 - k0) * s * c), c * c + k0 * s * s);
}

/// The most that any joint can need: sin(phi) = |1 - K0| / (1 + K0) [rad].
/// @throws InvalidInput  K0 out of range
[[nodiscard]] inline double largest_initial_friction(double k0) {
  require(k0 >= 0 && std::isfinite(k0), "K0", k0, ">= 0");
  return std::asin(std::abs(1 - k0) / (1 + k0));
}

}  // namespace voussoir
