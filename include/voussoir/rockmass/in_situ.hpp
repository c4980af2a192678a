// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/theory/initial_friction.hpp>

namespace voussoir {

/// The stress in the ground before anything is built, and the weight that goes with it.
///
///   sigma_v = surcharge + rho g depth,   sigma_h = K0 sigma_v,   no shear on horizontal planes
///
/// Prescribing its tractions at the Gauss points of all contacts puts every block in equilibrium,
/// force and moment, to rounding: no generation stage has to be simulated.
struct InSitu {
  double density;         ///< rho [kg/m^3], > 0
  double k0 = 1;          ///< horizontal (in 3-D: along x) / vertical stress [-], >= 0
  double surcharge = 0;   ///< pressure on the ground surface [Pa], >= 0
  double gravity = 9.81;  ///< g [m/s^2], > 0
  double k0_y = -1;       ///< in 3-D: along y / vertical [-], >= 0; -1: as along x
  double k0_xy = 0;       ///< in 3-D: sigma_xy / vertical [-]

  /// The same with these principal horizontal stresses.
  /// @param major, minor  over the vertical stress [-]
  /// @param azimuth       of the major one, clockwise from North, which is y [rad]
  [[nodiscard]] InSitu with_horizontal(double major, double minor, double azimuth) const {
    InSitu turned = *this;
    const double s = std::sin(azimuth), c = std::cos(azimuth);
    turned.k0 = major * s * s + minor * c * c;
    turned.k0_y = major * c * c + minor * s * s;
    turned.k0_xy = (major - minor) * s * c;
    return turned;
  }

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(density > 0 && std::isfinite(density), "density", density, "> 0 kg/m^3");
    require(k0 >= 0 && std::isfinite(k0), "K0", k0, ">= 0");
    require(surcharge >= 0 && std::isfinite(surcharge), "surcharge", surcharge, ">= 0 Pa");
    require(k0_y == -1 || (k0_y >= 0 && std::isfinite(k0_y)), "K0 along y", k0_y, ">= 0");
    require(k0_xy * k0_xy <= k0 * (k0_y < 0 ? k0 : k0_y) * (1 + 1e-12), "K0 of shear", k0_xy,
            "such that no horizontal stress is tensile");
    require(gravity > 0 && std::isfinite(gravity), "gravity", gravity, "> 0 m/s^2");
  }

  [[nodiscard]] double vertical(double depth) const {
    return surcharge + density * gravity * depth;
  }

  /// Stress at a depth, compression positive [Pa].
  template <int Dim>
  [[nodiscard]] Stress<Dim> stress(double depth) const {
    Stress<Dim> s = diagonal_of<Dim>(k0 * vertical(depth));
    s(Dim - 1, Dim - 1) = vertical(depth);
    if constexpr (Dim == 3) {
      if (k0_y >= 0) s(1, 1) = k0_y * vertical(depth);
      s(0, 1) = s(1, 0) = k0_xy * vertical(depth);
    }
    return s;
  }

  /// Friction that every joint orientation can need to carry this stress in the plane x, z [rad]:
  /// sin(phi) = |1 - K0| / (1 + K0), from the Mohr circle; zero for K0 = 1.
  [[nodiscard]] double required_friction_angle() const { return largest_initial_friction(k0); }
};

}  // namespace voussoir
