// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/solver/equilibrium.hpp>
#include <voussoir/tunnel/measurements.hpp>

/// The tunnel that Boon, Houlsby & Utili (2015) design, and what they change about it: Table 2 and
/// sections 5 to 8. One place for all analyses, so that they share every assumption.
namespace voussoir::paper {

inline constexpr double degree = std::numbers::pi / 180;
inline constexpr double diameter = 10, radius = 5;       ///< of the opening [m]
inline constexpr double cover = 20, below = 30;          ///< rock above crown, below invert [m]
inline constexpr double width = 70;                      ///< of the domain [m]
inline constexpr double density = 2700, gravity = 9.81;  ///< [kg/m^3], [m/s^2]
inline constexpr double ground_pressure = density * gravity * (cover + radius);  ///< p0 [Pa]
inline constexpr double normal_stiffness = 5e9, shear_stiffness = 5e8;  ///< of joints [Pa/m]
inline constexpr double friction = 35 * degree;                         ///< of joints
inline constexpr double bolt_stiffness = 2e8;       ///< K_a, across a joint [N/m]
inline constexpr double bolt_strength = 5e5;        ///< [N]
inline constexpr double bolt_diameter = 0.028;      ///< [m]
inline constexpr double joint_spacing = 0.77;       ///< s_mean, as the paper measured it [m]
inline constexpr double lining_modulus = 25e9;      ///< E_L [Pa]
inline constexpr double interface_stiffness = 1e9;  ///< K_L [Pa/m]
inline constexpr double interface_friction = 30 * degree;
/// A block that has moved so far has fallen [m]. Where a lining may catch it, it is followed
/// further, contacts found again every 20 mm: a soft ring holds rock that has come down on it.
inline constexpr double fall_limit = 0.02, lined_fall_limit = 0.1;

/// How the paper's rock is read: it does not print the length of its joints, and 0.5 m of "minimum
/// block size" may be a radius or a diameter.
struct RockReading {
  const char* name;
  double joint_extent;  ///< length of a joint [m]
  double min_radius;    ///< least inscribed radius of a block [m]
  double max_elongation;
};
inline constexpr RockReading mass_a{"A", 1, 0.25, 5};  ///< the paper's moduli: used throughout
inline constexpr RockReading mass_b{"B", 2, 0.36, 5};  ///< the paper's spacing, 0.77 m
/// 75E, 25E and 25W, one centre per square metre each, a standard deviation of 1 degree.
[[nodiscard]] std::vector<JointSet> joint_sets(const RockReading& reading);
/// 70 m x 60 m around the opening; its centre is the origin.
[[nodiscard]] Domain<2> domain();
/// One random sample, without the opening.
[[nodiscard]] RockMass<Planar> sliced_rock(const RockReading& reading, std::uint64_t seed,
                                           const Domain<2>& ground = domain());

/// A sample under its in-situ stress, before anything is excavated.
struct InSituState {
  /// Mean stress of the blocks within a radius of the tunnel centre, from the forces at their
  /// contacts [Pa].
  double vertical, horizontal;
  double gradient;   ///< of the vertical stress with depth, from 5 m above to 5 m below [Pa/m]
  double unbalance;  ///< of the worst block over its weight [-]
  double drift;      ///< largest displacement on the way to equilibrium [m]
};
[[nodiscard]] InSituState in_situ_state(std::uint64_t seed, double k0, double friction_angle);

enum class AnchorPlace { near_joint, mid_block, on_joint };

struct Bolts {
  double length = 4;             ///< [m]
  double spacing = 15 * degree;  ///< theta_b [rad]
  double from = 0, to = 180 * degree;
  double pretension = 0;  ///< [N]
  double stiffness = bolt_stiffness;
  double shear_stiffness = 0;  ///< across a joint [N/m]
  AnchorPlace anchors = AnchorPlace::near_joint;
  auto operator<=>(const Bolts&) const = default;
};
/// The reference pattern: 21 bolts of 7 m from 22.5 degrees below one springing to the other.
inline constexpr Bolts reference_bolts{
    .length = 7, .spacing = 11.25 * degree, .from = -22.5 * degree, .to = 202.5 * degree};

struct Lining {
  double thickness = 0.1;  ///< t [m]
  double interface_stiffness = paper::interface_stiffness;
  double bending_factor = 1;  ///< of E I of that thickness
  auto operator<=>(const Lining&) const = default;
};

/// The way to equilibrium.
enum class Way {
  /// The search with an error estimate, two points a contact: what a design should use.
  quasi_static,
  /// As near as can be told to how the paper ran it: explicit stepping, all rock taken out at once,
  /// local damping of 0.1, one point a contact.
  as_the_paper,
  /// Explicit stepping that takes the rock out over 2000 steps, well damped: to check the search.
  slow_explicit,
};

/// One tunnel of the study; what is not said is as in Table 2.
struct Variant {
  std::optional<Bolts> bolts = {};
  std::optional<Lining> lining = {};
  double k0 = 1;
  double friction = paper::friction;
  double held = 0;  ///< part of the wall traction that is left at the end [-]
  /// Part left when support goes in; 1: wished in place before the rock moves [-].
  double held_at_support = 1;
  Way way = Way::quasi_static;
  auto operator<=>(const Variant&) const = default;

  [[nodiscard]] Variant as_the_paper() const {
    Variant other = *this;
    other.way = Way::as_the_paper;
    return other;
  }
};

struct BoltOutcome {
  double angle;    ///< anticlockwise from the right-hand springing [rad]
  double largest;  ///< over its joints [N]
  struct Crossing {
    double distance;  ///< from the tunnel centre [m]
    double force;     ///< tension positive [N]
  };
  std::vector<Crossing> crossings;  ///< from the head inwards
};

struct LiningOutcome {
  double angle;   ///< [rad]
  double thrust;  ///< compression positive [N/m]
  double moment;  ///< tension outside positive [N m/m]
};

/// What came of one tunnel in one sample of the rock.
struct Outcome {
  std::uint64_t seed = 0;
  EquilibriumReport report;
  Convergence convergence{};    ///< [m]
  double mean_convergence = 0;  ///< of the wall above the springings, by length [m]
  double boundary_change = 0;   ///< mean change of stress at sides and base, over what it was [-]
  std::vector<WallMotion> wall;
  std::vector<BoltOutcome> bolts;
  std::vector<LiningOutcome> lining;
  double seconds = 0;

  [[nodiscard]] bool stable() const { return report.verdict == Verdict::stable; }
  /// Rock came off [m^2].
  [[nodiscard]] double fallen() const { return report.fallen_measure; }
  [[nodiscard]] bool sheds() const { return fallen() > 0; }
  [[nodiscard]] std::vector<double> largest_forces() const;
  [[nodiscard]] double mean_force() const;     ///< of the bolts' largest [N]; 0 without bolts
  [[nodiscard]] double largest_force() const;  ///< [N]; 0 without bolts
  [[nodiscard]] double mean_thrust() const;    ///< [N/m]; 0 without lining
  [[nodiscard]] double largest_thrust() const;
  [[nodiscard]] double largest_moment() const;  ///< absolute value [N m/m]
  /// Mean over +- 15 degrees around an angle [N/m].
  [[nodiscard]] double thrust_near(double angle) const;
  [[nodiscard]] double moment_near(double angle) const;
};

/// A sample of the rock in its in-situ stress, excavated, nothing moved: the start of every variant
/// with the same stress, friction and points per contact. Making it costs as much as solving.
class ExcavatedRock {
 public:
  ExcavatedRock(std::uint64_t seed, const Variant& variant);
  ~ExcavatedRock();
  ExcavatedRock(ExcavatedRock&&) noexcept;
  ExcavatedRock& operator=(ExcavatedRock&&) noexcept;

  /// Supports it and finds its equilibrium. Leaves the rock as it is; any number at a time.
  /// @throws NumericalFault  see the method
  [[nodiscard]] Outcome run(const Variant& variant) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace voussoir::paper
