// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A bar or cable held by its bond over a length, pulled at one end.
struct BondedBar {
  double axial_stiffness;  ///< E A, of the bar [N], > 0
  double bond_stiffness;   ///< k_b, bond over slip, per length [N/m^2], > 0
  double bond_strength;    ///< s_b, of the bond, per length [N/m], > 0
  double length;           ///< L, bonded [m], > 0
  /// P, of plate and nut at the other end, which do not give until then and keep it after [N],
  /// >= 0; 0: that end is free
  double end_strength = 0;

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(axial_stiffness > 0 && std::isfinite(axial_stiffness), "axial stiffness E A",
            axial_stiffness, "> 0 N");
    require(bond_stiffness > 0 && std::isfinite(bond_stiffness), "bond stiffness k_b",
            bond_stiffness, "> 0 N/m^2");
    require(bond_strength > 0 && std::isfinite(bond_strength), "bond strength s_b", bond_strength,
            "> 0 N/m");
    require(length > 0 && std::isfinite(length), "bonded length L", length, "> 0 m");
    require(end_strength >= 0 && std::isfinite(end_strength), "end strength P", end_strength,
            ">= 0 N");
  }
};

/// A state of a bar that is being pulled out.
struct PullOutPoint {
  double displacement;  ///< of the pulled end against the rock [m]
  double force;         ///< there [N]
  double slipped;       ///< length from the pulled end over which its bond is used up [m]
};

/// The pull-out test of a bonded bar, in closed form. Bond is elastic to its strength and keeps it:
///
///   E A u'' = min(k_b u, s_b),   b = sqrt(k_b / E A),   u_s = s_b / k_b
///
/// Elastic, the other end free: F = sqrt(k_b E A) tanh(b L) u; held by a plate: coth. Slip begins
/// at the pulled end at u = u_s and goes inwards; with the length p slipped and r = L - p left,
///
///   F = F_r + s_b p,   u = u_s + F_r p / E A + s_b p^2 / 2 E A,   F_r = sqrt(k_b E A) tanh(b r)
///   u_s
///
/// to F = s_b L (with a plate s_b L + P), where all of it slips. A plate whose strength is used up
/// pulls with it: F_r = sqrt(k_b E A) tanh(b r) u_s + P / cosh(b r). Force and displacement grow
/// with p together; the curve bends towards the displacement all the way.
///
/// Source: Farmer (1975), Int. J. Rock Mech. Min. Sci. 12, 347-351, elastic; bond that yields:
/// St. John & Van Dillen (1983), 24th US Symp. Rock Mech., and Hyett et al. (1992), Int. J. Rock
/// Mech. Min. Sci. 29, 503-524; the plate is ours. The bonded length that leaves the rock is not
/// counted off, and the bar stays elastic.
class PullOut {
 public:
  /// @throws InvalidInput  a value out of range
  explicit PullOut(const BondedBar& bar) : bar_(bar) {
    bar.check();
    decay_ = std::sqrt(bar.bond_stiffness / bar.axial_stiffness);
    long_stiffness_ = std::sqrt(bar.bond_stiffness * bar.axial_stiffness);
  }

  /// F / u before anything slips [N/m].
  [[nodiscard]] double head_stiffness() const {
    const double shape = std::tanh(decay_ * bar_.length);
    return bar_.end_strength > 0 ? long_stiffness_ / shape : long_stiffness_ * shape;
  }
  /// sqrt(k_b E A): that of an endless bar [N/m].
  [[nodiscard]] double long_stiffness() const { return long_stiffness_; }
  /// 1 / b: over which the force goes into the rock while bond is elastic [m].
  [[nodiscard]] double transfer_length() const { return 1 / decay_; }
  /// Where the bond at the pulled end is used up.
  [[nodiscard]] PullOutPoint first_slip() const { return at_slipped(0); }
  /// To where displacement is proportional to force: slip begins, or the plate gives [N].
  [[nodiscard]] double linear_to() const { return std::min(first_slip().force, plate_gives()); }
  /// Where all of it slips: F = s_b L + P, which it keeps.
  [[nodiscard]] PullOutPoint last() const { return at_slipped(bar_.length); }
  /// @param slipped  p [m], 0 to L
  /// @throws InvalidInput  it is not
  [[nodiscard]] PullOutPoint at_slipped(double slipped) const {
    require(slipped >= 0 && slipped <= bar_.length, "slipped length", slipped,
            "from 0 m to the bonded length");
    const double bond = bar_.bond_strength, bar = bar_.axial_stiffness,
                 start = bond / bar_.bond_stiffness,
                 rest = rest_force(start, bar_.length - slipped);
    return {start + (rest + 0.5 * bond * slipped) * slipped / bar, rest + bond * slipped, slipped};
  }
  /// As far as it takes to carry a force.
  /// @param force  [N], 0 to that of `last`
  /// @throws InvalidInput  it is not: it cannot be carried
  [[nodiscard]] VOUSSOIR_INLINE PullOutPoint at_force(double force) const;
  /// @param displacement  [m], >= 0; beyond `last` the force stays
  /// @throws InvalidInput  it is not
  [[nodiscard]] VOUSSOIR_INLINE PullOutPoint at_displacement(double displacement) const;

 private:
  /// At the end of a stretch of elastic bond, moved so far there [N].
  [[nodiscard]] double rest_force(double displacement, double rest) const {
    const double x = decay_ * rest, plate = bar_.end_strength;
    // What the plate holds while it does not give is that or less; at rest = 0 it is not finite.
    if (plate > 0 && long_stiffness_ * displacement <= plate * std::sinh(x))
      return long_stiffness_ * displacement / std::tanh(x);
    // A bar much longer than its transfer length overflows cosh, and feels nothing of its end.
    const double felt = plate > 0 ? plate / std::cosh(std::min(x, 700.0)) : 0.0;
    return long_stiffness_ * displacement * std::tanh(x) + felt;
  }
  /// The force at which the plate gives, if no bond slips before [N].
  [[nodiscard]] double plate_gives() const {
    const double x = decay_ * bar_.length;
    return bar_.end_strength > 0 && x < 700 ? bar_.end_strength * std::cosh(x)
                                            : std::numeric_limits<double>::infinity();
  }
  /// The first state at which `is_beyond(point)`, where slip has begun.
  template <class IsBeyond>
  [[nodiscard]] PullOutPoint sought(const IsBeyond& is_beyond) const {
    double low = 0, high = bar_.length;
    // Bisection to the last digit: force and displacement grow with the slipped length.
    for (double middle = 0.5 * (low + high); low < middle && middle < high;
         middle = 0.5 * (low + high))
      (is_beyond(at_slipped(middle)) ? high : low) = middle;
    return at_slipped(high);
  }

  BondedBar bar_;
  double decay_, long_stiffness_;  ///< b [1/m], sqrt(k_b E A) [N/m]
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE PullOutPoint PullOut::at_force(double force) const {
  const PullOutPoint all = last(), first = first_slip();
  require(force >= 0 && force <= all.force, "pull-out force", force,
          "from 0 N to what bond and plate bear");
  if (force >= first.force)
    return sought([&](const PullOutPoint& point) { return point.force >= force; });
  // Before slip only a plate that gives makes two straight lines of it.
  if (force <= plate_gives()) return {force / head_stiffness(), force, 0};
  const double x = decay_ * bar_.length;
  return {(force - bar_.end_strength / std::cosh(x)) / (long_stiffness_ * std::tanh(x)), force, 0};
}

VOUSSOIR_INLINE PullOutPoint PullOut::at_displacement(double displacement) const {
  require(displacement >= 0 && std::isfinite(displacement), "pull-out displacement", displacement,
          ">= 0 m");
  const PullOutPoint all = last(), first = first_slip();
  if (displacement >= all.displacement) return {displacement, all.force, bar_.length};
  if (displacement >= first.displacement)
    return sought([&](const PullOutPoint& point) { return point.displacement >= displacement; });
  return {displacement, rest_force(displacement, bar_.length), 0};
}

#endif

}  // namespace voussoir
