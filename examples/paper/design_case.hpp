// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/tunnel/measurements.hpp>

#include "design_rock.hpp"

/// The tunnel that Boon, Houlsby & Utili (2015) design, and what they change about it: Table 2 and
/// sections 5 to 8. One place for all analyses, so that they share every assumption.
namespace voussoir::paper {

inline constexpr double bolt_stiffness = 2e8;       ///< K_a, across a joint [N/m]
inline constexpr double bolt_strength = 5e5;        ///< [N]
inline constexpr double bolt_diameter = 0.028;      ///< [m]
inline constexpr double lining_modulus = 25e9;      ///< E_L [Pa]
inline constexpr double interface_stiffness = 1e9;  ///< K_L [Pa/m]
inline constexpr double interface_friction = 30 * degree;
/// A block that has moved so far is detached [m]. Where a lining may catch it, it is followed
/// further, with contact updates every 20 mm: a soft ring holds rock that has come down on it.
inline constexpr double fall_limit = 0.02, lined_fall_limit = 0.1;

/// A realisation under its in-situ stress, before anything is excavated.
struct InSituState {
  /// Mean stress of the blocks within a radius of the tunnel centre, from the forces at their
  /// contacts [Pa].
  double vertical, horizontal;
  double gradient;   ///< of the vertical stress with depth, from 5 m above to 5 m below [Pa/m]
  double unbalance;  ///< of the worst block over its weight [-]
  double drift;      ///< largest displacement during the equilibrium search [m]
};
/// @param surcharge  on the ground surface [Pa]
[[nodiscard]] InSituState in_situ_state(std::uint64_t seed, double k0, double friction_angle,
                                        double surcharge = 0);

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
  int nodes = 72;          ///< around the circle
  double interface_stiffness = paper::interface_stiffness;
  double bending_factor = 1;  ///< of E I of that thickness
  auto operator<=>(const Lining&) const = default;
};

/// The solution procedure.
enum class Way {
  /// The search with an error estimate: what a design should use.
  quasi_static,
  /// As near as can be told to how the paper ran it: explicit stepping, all rock taken out at once,
  /// local damping of 0.1.
  as_the_paper,
  /// Explicit stepping that takes the rock out slowly, well damped: to check the search.
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
  Extent extent = {};
  double tolerance = 1e-3;  ///< of the error estimate; ten times that for the force ratio
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

/// What came of one tunnel in one realisation of the rock.
struct Outcome {
  std::uint64_t seed = 0;
  EquilibriumReport report;
  Convergence convergence{};    ///< [m]
  double mean_convergence = 0;  ///< of the wall above the springings, by length [m]
  double boundary_change = 0;   ///< mean change of stress at sides and base, over what it was [-]
  std::vector<WallMotion> wall;
  std::vector<BoltOutcome> bolts;
  std::vector<LiningOutcome> lining;

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

/// A realisation of the rock in its in-situ stress, excavated, nothing moved: the start of every
/// variant with the same stress, friction, extent and points per contact. Making it costs as much
/// as solving.
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
