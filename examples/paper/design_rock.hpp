// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/tunnel/opening.hpp>

/// The ground of the design case of Boon, Houlsby & Utili (2015), Table 2, for all who need it:
/// analyses, benchmarks, tables.
namespace voussoir::paper {

inline constexpr double degree = std::numbers::pi / 180;
inline constexpr double diameter = 10, radius = 5;       ///< of the opening [m]
inline constexpr double cover = 20, below = 30;          ///< rock above crown, below invert [m]
inline constexpr double width = 70;                      ///< of the domain [m]
inline constexpr double density = 2700, gravity = 9.81;  ///< [kg/m^3], [m/s^2]
inline constexpr double ground_pressure = density * gravity * (cover + radius);  ///< p0 [Pa]
inline constexpr double normal_stiffness = 5e9, shear_stiffness = 5e8;  ///< of joints [Pa/m]
inline constexpr double friction = 35 * degree;                         ///< of joints
inline constexpr double joint_spacing = 0.77;  ///< s_mean, as the paper measured it [m]

/// How the paper's rock is read: it does not print the length of its joints, and 0.5 m of "minimum
/// block size" may be a radius or a diameter.
struct RockReading {
  double joint_extent;  ///< length of a joint [m]
  double min_radius;    ///< least inscribed radius of a block [m]
  double max_elongation;
};
inline constexpr RockReading mass_a{1, 0.25, 5};  ///< the paper's moduli: used throughout
inline constexpr RockReading mass_b{2, 0.36, 5};  ///< the paper's spacing, 0.77 m
/// 75E, 25E and 25W, one centre per square metre each, a standard deviation of 1 degree.
[[nodiscard]] inline std::vector<JointSet> joint_sets(const RockReading& reading) {
  const auto set = [&](const char* name, double dip, DipDirection direction) {
    return JointSet{name, dip * degree, direction, 1 * degree, 1, 0, reading.joint_extent};
  };
  return {set("J1", 75, DipDirection::east), set("J2", 25, DipDirection::east),
          set("J3", 25, DipDirection::west)};
}
/// Rock around the opening, whose centre is the origin.
struct Extent {
  double width = paper::width, below = paper::below;  ///< of the domain, of its base [m]
  auto operator<=>(const Extent&) const = default;
};
[[nodiscard]] inline Domain<2> domain(const Extent& extent = {}) {
  return domain_around(circular_opening(diameter), extent.width, cover, extent.below);
}
/// One random realisation, without the opening.
[[nodiscard]] inline RockMass<Planar> sliced_rock(const RockReading& reading, std::uint64_t seed,
                                                  const Domain<2>& ground = domain()) {
  return slice(
      ground, joint_network(joint_sets(reading), ground, seed),
      {.min_inscribed_radius = reading.min_radius, .max_elongation = reading.max_elongation});
}

}  // namespace voussoir::paper
