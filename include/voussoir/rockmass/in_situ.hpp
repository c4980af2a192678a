// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/principal_axes.hpp>
#include <voussoir/theory/initial_friction.hpp>

namespace voussoir {

/// A stress that was measured at one place in 3-D: three principal values, compression positive,
/// and their directions.
struct PrincipalStresses {
  /// A direction by the trend of its downward end, clockwise from North, which is y, and its plunge
  /// below the horizontal [rad].
  struct Axis {
    double trend, plunge;
    [[nodiscard]] Vec3 direction() const {
      const double level = elementary::cosine(plunge);
      return {level * elementary::sine(trend), level * elementary::cosine(trend),
              -elementary::sine(plunge)};
    }
  };
  double values[3];  ///< [Pa], >= 0
  Axis axes[3];      ///< of each, at right angles to one another within a degree

  /// @throws InvalidInput  a value out of range, or axes that are not at right angles
  [[nodiscard]] Stress<3> tensor() const;
};

/// The stress in the ground before anything is built, and the weight that goes with it.
///
///   sigma_v = surcharge + rho g depth,   sigma_h = K0 sigma_v + constant,   no shear on horizontal
///   planes
///
/// Prescribing its tractions at the Gauss points of all contacts puts every block in equilibrium,
/// force and moment, to rounding: no generation stage has to be simulated.
///
/// In 3-D a measured stress can stand in the place of surcharge and ratios (`with_measured`): it is
/// met at the depth of the measurement, and grows from there with rho g per depth times the ratios:
///
///   sigma = S + rho g (depth - depth_0) K
struct InSitu {
  double density;         ///< rho [kg/m^3], > 0
  double k0 = 1;          ///< horizontal (in 3-D: along x) / vertical stress [-], >= 0
  double surcharge = 0;   ///< pressure on the ground surface [Pa], >= 0
  double gravity = 9.81;  ///< g [m/s^2], > 0
  double k0_y = -1;       ///< in 3-D: along y / vertical [-], >= 0; -1: as along x
  double k0_xy = 0;       ///< in 3-D: sigma_xy / vertical [-]
  /// Blocks that are laid, not cut out of the ground: nothing presses between them, and the first
  /// stage lets their weight come on.
  bool is_laid = false;
  /// What there is besides surcharge and ratios, at every depth [Pa]: horizontal stress that does
  /// not grow with it (`with_constant_horizontal`), or in 3-D of a measured stress. Its vertical
  /// part is zero. In 2-D its part along x acts.
  Stress<3> besides = zeros<Stress<3>>();

  /// The same with these principal horizontal stresses.
  /// @param major, minor  over the vertical stress [-]
  /// @param azimuth       of the major one, clockwise from North, which is y [rad]
  [[nodiscard]] InSitu with_horizontal(double major, double minor, double azimuth) const {
    InSitu turned = *this;
    const double s = elementary::sine(azimuth), c = elementary::cosine(azimuth);
    turned.k0 = major * s * s + minor * c * c;
    turned.k0_y = major * c * c + minor * s * s;
    turned.k0_xy = (major - minor) * s * c;
    return turned;
  }

  /// Adds a horizontal stress that is the same in all directions and at every depth, as tectonic
  /// stress is often reported: sigma_h = constant + K0 sigma_v.
  /// @param constant  [Pa], >= 0
  [[nodiscard]] InSitu with_constant_horizontal(double constant) const {
    require(constant >= 0 && std::isfinite(constant), "constant horizontal stress", constant,
            ">= 0 Pa");
    InSitu made = *this;
    made.besides(0, 0) += constant;
    made.besides(1, 1) += constant;
    return made;
  }

  /// The same with this stress at a depth. Its surcharge becomes what the vertical stress there
  /// leaves; the ratios remain, for what comes with depth.
  /// @param depth  of the measurement, below the top of the domain [m], >= 0
  /// @throws InvalidInput  as `PrincipalStresses::tensor`; or the vertical stress is less than the
  ///                       weight above
  [[nodiscard]] InSitu with_measured(const PrincipalStresses& measured, double depth) const {
    require(depth >= 0 && std::isfinite(depth), "depth of the measured stress", depth, ">= 0 m");
    const Stress<3> s = measured.tensor();
    InSitu made = *this;
    made.surcharge = s(2, 2) - density * gravity * depth;
    require(made.surcharge >= 0, "measured vertical stress less the weight above", made.surcharge,
            ">= 0 Pa");
    made.besides = zeros<Stress<3>>();
    made.besides = s - made.template stress<3>(depth);
    made.besides(2, 2) = 0;
    return made;
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
    require(!is_laid || (surcharge == 0 && !(besides.squaredNorm() > 0)),
            "surcharge or measured stress of blocks that are laid", surcharge, "none");
    if (!(besides.squaredNorm() > 0)) return;
    const double least = principal_axes(stress<3>(0)).moments[0];
    require(least >= 0, "smallest principal stress at the top of the domain", least,
            ">= 0 Pa: the ratios take more off the measured stress than there is");
  }

  [[nodiscard]] double vertical(double depth) const {
    return is_laid ? 0.0 : surcharge + density * gravity * depth;
  }

  /// Stress at a depth, compression positive [Pa].
  template <int Dim>
  [[nodiscard]] Stress<Dim> stress(double depth) const {
    Stress<Dim> s = diagonal_of<Dim>(k0 * vertical(depth));
    s(Dim - 1, Dim - 1) = vertical(depth);
    if constexpr (Dim == 3) {
      if (k0_y >= 0) s(1, 1) = k0_y * vertical(depth);
      s(0, 1) = s(1, 0) = k0_xy * vertical(depth);
      s += besides;
    } else {
      s(0, 0) += besides(0, 0);
    }
    VOUSSOIR_ASSERT(detail::is_symmetric(s), "a stress is symmetric");
    return s;
  }

  /// Friction that every joint orientation can need to carry this stress [rad], from the largest
  /// Mohr circle: sin(phi) = (s1 - s3) / (s1 + s3), in 2-D |1 - K0| / (1 + K0). Zero where all
  /// principal stresses are equal; pi/2 where one is a tension.
  /// @tparam Dim  2: in the plane x, z; 3: of joints that strike in any direction
  /// @param depth  where, if part of the stress does not grow with it: otherwise the angle is the
  ///               same at every depth [m]
  template <int Dim = 2>
  [[nodiscard]] double required_friction_angle(double depth = 1) const {
    if constexpr (Dim == 2) {
      if (!(besides(0, 0) > 0)) return largest_initial_friction(k0);
      return vertical(depth) > 0 ? largest_initial_friction(k0 + besides(0, 0) / vertical(depth))
                                 : 0.5 * std::numbers::pi;
    }
    Stress<3> s = stress<3>(depth);
    if (!(s.squaredNorm() > 0)) s = stress<3>(depth + 1);  // on the bare surface
    const Vec3 principal = principal_axes(s).moments;
    if (!(principal[0] >= 0)) return 0.5 * std::numbers::pi;
    return std::asin((principal[2] - principal[0]) / (principal[2] + principal[0]));
  }
};

inline Stress<3> PrincipalStresses::tensor() const {
  Stress<3> sum = zeros<Stress<3>>();
  Fixed<3, 3> directions;
  for (int k = 0; k < 3; ++k) {
    require(values[k] >= 0 && std::isfinite(values[k]), "principal stress", values[k], ">= 0 Pa");
    set_column(directions, k, axes[k].direction());
    for (int other = 0; other < k; ++other) {
      const double cosine = column(directions, k).dot(column(directions, other));
      require_angle(std::abs(cosine) < elementary::sine(std::numbers::pi / 180),
                    "angle between principal stresses", std::acos(std::clamp(cosine, -1.0, 1.0)),
                    "pi/2 rad, within a degree");
    }
  }
  // Compasses read whole degrees: what is left of the angles is shared among the axes.
  const PrincipalAxes right = principal_axes(directions * transposed(directions));
  Fixed<3, 3> square = zeros<Fixed<3, 3>>();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = column(right.directions, k);
    square += outer(axis, axis) / std::sqrt(right.moments[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = square * column(directions, k);
    sum += values[k] * outer(axis, axis);
  }
  return sum;
}

}  // namespace voussoir
