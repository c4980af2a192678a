// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>
#include <voussoir/bolt/bolt_curve.hpp>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/theory/pull_out.hpp>

namespace voussoir {

/// What the steel of a bolt bears in tension.
struct BarStrength {
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  double yield_force = unlimited;    ///< [N], > 0
  double rupture_force = unlimited;  ///< [N], > 0; below the yield force: brittle
  /// Beyond yield until it is lost, at the joint or of the bolt [m], > 0: the force goes straight
  /// to the rupture force or, where none is given, stays: a yielding bolt.
  double rupture_extension = unlimited;
  double hardening_ratio = 0.02;  ///< without it: stiffness after / before yield [-], 0 <= . < 1

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(yield_force > 0, "yield_force", yield_force, "> 0 N");
    require(rupture_force > 0, "rupture_force", rupture_force, "> 0 N");
    require(rupture_extension > 0, "rupture_extension", rupture_extension, "> 0 m");
    require(std::isinf(rupture_extension) || std::isfinite(yield_force), "rupture_extension",
            rupture_extension, "with a yield force, beyond which it is");
    require(hardening_ratio >= 0 && hardening_ratio < 1, "hardening_ratio", hardening_ratio,
            ">= 0 and < 1");
  }
  /// Of a bolt that is elastic, or slips, without it.
  [[nodiscard]] BoltCurve limited(const BoltCurve& curve) const {
    check();
    if (!(yield_force < rupture_force)) return curve.breaking_at(rupture_force);
    if (std::isinf(yield_force) || yield_force > curve.strength()) return curve;
    const double bond = curve.strength();
    if (std::isinf(rupture_extension))
      return curve.yielding_at(yield_force, hardening_ratio)
          .holding_at(bond)
          .breaking_at(rupture_force);
    const BoltCurve yields =
        curve.yielding_at(yield_force, 0)
            .breaking_after(rupture_extension,
                            std::isinf(rupture_force) ? yield_force : rupture_force);
    return bond < yields.strength() ? yields.holding_at(bond) : yields;
  }
};

/// A bar or cable in grout all along: at a joint it opens by what it slips out of both sides, each
/// a `PullOut` over all of the bolt on that side, to the tip and to the head with its plate.
struct BondedBolt {
  double axial_stiffness;     ///< E A [N], > 0
  double bond_stiffness;      ///< k_b [N/m^2], > 0
  double bond_strength;       ///< s_b [N/m], > 0
  double plate_strength = 0;  ///< of plate and nut at the head [N], >= 0; 0: none
  BarStrength strength = {};
};

/// A bar that is held at its ends, by a plate at the head and an anchor at the tip: one spring,
/// 1 / (L / E A + 1 / k_a). An anchor that slips holds on; without its plate the bolt is lost.
struct EndAnchoredBolt {
  double axial_stiffness;                            ///< E A [N], > 0
  double anchor_stiffness = BarStrength::unlimited;  ///< k_a [N/m], > 0
  double anchor_strength = BarStrength::unlimited;   ///< [N], > 0
  double plate_strength = BarStrength::unlimited;    ///< [N], > 0
  BarStrength strength = {};
};

/// A bolt by what is installed.
using BarInRock = std::variant<BondedBolt, EndAnchoredBolt>;

namespace detail {

/// A bonded length that is pulled by its end, in chords that are within 0.1 % of it; with the other
/// side of a joint, which bears as much or more, what both give.
/// @param length  of `weak` [m]
[[nodiscard]] inline BoltCurve pulled_curve(const PullOut& weak, double length,
                                            const PullOut* strong) {
  std::vector<double> forces{weak.linear_to()};
  if (strong != nullptr)
    forces.insert(forces.end(), {strong->linear_to(), strong->first_slip().force});
  // Of a step h the chord is off by s h^2 / 8 E A: of u >= s (1 / b^2 + p / b + p^2 / 2) / E A
  // less than a thousandth.
  for (double slipped = 0; slipped < length;
       slipped += 0.09 * (weak.transfer_length() + 0.7 * slipped))
    forces.push_back(weak.at_slipped(slipped).force);
  const double most = weak.last().force;
  forces.push_back(most);
  std::sort(forces.begin(), forces.end());
  std::vector<BoltCurve::Point> points;
  for (const double force : forces) {
    const double from = points.empty() ? 0.0 : points.back().force;
    if (!(force > from) || force > most) continue;
    // Neighbours that rounding tells apart make slopes of any size; the last is the strength.
    if (force <= from * (1 + 1e-6)) {
      if (force < most) continue;
      points.pop_back();
    }
    points.push_back({weak.at_force(force).displacement +
                          (strong != nullptr ? strong->at_force(force).displacement : 0.0),
                      force});
  }
  return BoltCurve(std::move(points));
}

}  // namespace detail

/// A length of the bolt that is pulled by its end.
/// @param plate  at its other end [N]
[[nodiscard]] inline PullOut pull_out_of(const BondedBolt& bolt, double length, double plate = 0) {
  return PullOut({bolt.axial_stiffness, bolt.bond_stiffness, bolt.bond_strength, length, plate});
}
/// What the bar bears of it, too.
/// @throws InvalidInput  a value out of range
[[nodiscard]] inline BoltCurve pull_out_curve(const BondedBolt& bolt, double length) {
  return bolt.strength.limited(detail::pulled_curve(pull_out_of(bolt, length), length, nullptr));
}

/// How far a joint opens of a force.
/// @param joint  between head and tip of the bolt, both lengths > 0
/// @throws InvalidInput  a value out of range
[[nodiscard]] inline BoltCurve curve_of(const BondedBolt& bolt, const BoltJoint& joint) {
  const PullOut head = pull_out_of(bolt, joint.before, bolt.plate_strength),
                tip = pull_out_of(bolt, joint.after);
  const bool head_is_weaker = head.last().force < tip.last().force;
  return bolt.strength.limited(head_is_weaker ? detail::pulled_curve(head, joint.before, &tip)
                                              : detail::pulled_curve(tip, joint.after, &head));
}
[[nodiscard]] inline BoltCurve curve_of(const EndAnchoredBolt& bolt, const BoltJoint& joint) {
  require(bolt.axial_stiffness > 0 && std::isfinite(bolt.axial_stiffness), "axial stiffness E A",
          bolt.axial_stiffness, "> 0 N");
  require(bolt.anchor_stiffness > 0, "anchor_stiffness", bolt.anchor_stiffness, "> 0 N/m");
  const double give =
      (joint.before + joint.after) / bolt.axial_stiffness + 1 / bolt.anchor_stiffness;
  return bolt.strength.limited(BoltCurve::straight(1 / give))
      .holding_at(bolt.anchor_strength)
      .breaking_at(bolt.plate_strength);
}
[[nodiscard]] inline BoltCurve curve_of(const BarInRock& bolt, const BoltJoint& joint) {
  return std::visit([&](const auto& bar) { return curve_of(bar, joint); }, bolt);
}

/// In the middle of a long bolt, as a law that is not yet installed has it.
[[nodiscard]] inline BoltJoint long_bolt(const BarInRock& bolt) {
  const auto* const bonded = std::get_if<BondedBolt>(&bolt);
  if (bonded == nullptr) return {1, 1};
  constexpr double long_beside_transfer = 20;
  const double transfer = std::sqrt(bonded->axial_stiffness / bonded->bond_stiffness);
  return {long_beside_transfer * transfer, long_beside_transfer * transfer};
}

}  // namespace voussoir
