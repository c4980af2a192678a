// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/message_number.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/tunnel/support_forces.hpp>

/// What bolts carry of what they can.
namespace voussoir::design {

/// Of the bar of one bolt in tension [N], the lower of yield and rupture; infinite: none was given.
[[nodiscard]] inline double bolt_strength(const BoltsInput& bolts) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return std::min(bolts.yield_force.value_or(unlimited), bolts.rupture_force.value_or(unlimited));
}

/// Whether anything of a pattern says what it bears.
[[nodiscard]] inline bool has_strength(const BoltsInput& bolts) {
  return std::isfinite(bolt_strength(bolts)) || bolts.bond_strength || bolts.anchor_strength ||
         (bolts.type == BoltType::end_anchored && bolts.plate_strength);
}

/// What a bolt would fail of at a joint.
enum class BoltMode { yield, rupture, bond_at_tip, bond_at_head, plate, anchor };
[[nodiscard]] inline const char* to_string(BoltMode mode) {
  constexpr const char* words[] = {"yield", "rupture", "bond at the tip", "bond at the head",
                                   "plate", "anchor"};
  return words[static_cast<std::size_t>(mode)];
}

/// What a bolt bears in tension where it crosses a joint.
struct BoltLimit {
  double strength = std::numeric_limits<double>::infinity();  ///< [N]; infinite: none was given
  BoltMode mode = BoltMode::yield;
  bool is_of_ends = false;  ///< of a bolt that is held by its ends: everywhere along it
};

/// The least of three: the bar; the bond of all that is grouted beyond the joint, to the tip; the
/// bond of all that is grouted before it, to the head, and the plate there. `plate`: where that
/// bears the larger part of the last. Of an end-anchored bolt bar, anchor and plate.
/// @param length    of the bolt [m]
/// @param position  of the joint from the head [m], 0 to `length`
[[nodiscard]] inline BoltLimit bolt_limit(const BoltsInput& bolts, double length, double position) {
  BoltLimit limit{bolt_strength(bolts), bolts.yield_force ? BoltMode::yield : BoltMode::rupture};
  if (bolts.type == BoltType::end_anchored) {
    limit.is_of_ends = true;
    if (bolts.anchor_strength && *bolts.anchor_strength < limit.strength)
      limit = {*bolts.anchor_strength, BoltMode::anchor, true};
    if (bolts.plate_strength && *bolts.plate_strength < limit.strength)
      limit = {*bolts.plate_strength, BoltMode::plate, true};
    return limit;
  }
  if (!bolts.bond_strength) return limit;
  const double plate = bolts.plate_strength.value_or(0);
  const double beyond = *bolts.bond_strength * (length - position),
               before = *bolts.bond_strength * position;
  if (beyond < limit.strength) limit = {beyond, BoltMode::bond_at_tip};
  if (before + plate < limit.strength)
    limit = {before + plate, plate > before ? BoltMode::plate : BoltMode::bond_at_head};
  return limit;
}

/// A bolt where it crosses a joint: what it carries there of what it can.
struct BoltUtilisation {
  int bolt = 0;         ///< in the order of installation, from 0
  int joint = 0;        ///< along it from the head, from 1
  double position = 0;  ///< of that joint from the head [m]
  double force = 0;     ///< axial, tension positive [N]
  BoltLimit limit = {};

  [[nodiscard]] double value() const {  ///< [-]; 0 in compression, and where there is no limit
    return limit.strength > 0 ? std::max(0.0, force / limit.strength)
           : force > 0        ? std::numeric_limits<double>::infinity()
                              : 0.0;
  }
};

/// At all joints, in the order of `bolt_forces`.
template <class Solver>
[[nodiscard]] std::vector<BoltUtilisation> bolt_utilisations(const AnalysisInput& input,
                                                             const Solver& tunnel) {
  const auto bars = bars_of(tunnel);
  const std::vector<const BoltsInput*> patterns = patterns_of_bars(input, bars);
  std::vector<int> joints(bars.size(), 0);
  std::vector<BoltUtilisation> found;
  for (const CrossingForce& at : bolt_forces(tunnel)) {
    const auto k = static_cast<std::size_t>(at.bolt);
    found.push_back({at.bolt, ++joints[k], at.position, at.report.axial,
                     bolt_limit(*patterns[k], bars[k].length(), at.position)});
  }
  return found;
}

/// The one that governs; none: nothing is checked.
[[nodiscard]] inline const BoltUtilisation* governing(const std::vector<BoltUtilisation>& joints) {
  const BoltUtilisation* most = nullptr;
  for (const BoltUtilisation& at : joints)
    if (std::isfinite(at.limit.strength) && (most == nullptr || at.value() > most->value()))
      most = &at;
  return most;
}

/// What of a bolt governs, and where: "bolt 7: bond beyond its joint at 2.9 m", "bolt 2: anchor".
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string governed_by(const BoltUtilisation& at);

/// Its value [-]; 0: no bolt that has a strength crosses a joint; none: no bolt has one.
template <class Solver>
[[nodiscard]] std::optional<double> most_of_bolt_strength(const AnalysisInput& input,
                                                          const Solver& tunnel) {
  const std::vector<BoltUtilisation> joints = bolt_utilisations(input, tunnel);
  if (const BoltUtilisation* const most = governing(joints)) return most->value();
  for (const BoltsInput* pattern : patterns_of_bars(input, bars_of(tunnel)))
    if (has_strength(*pattern)) return 0.0;
  return std::nullopt;
}

/// The strength of the bar of every bolt that was installed [N].
template <class Solver>
[[nodiscard]] std::vector<double> bolt_strengths(const AnalysisInput& input, const Solver& tunnel) {
  std::vector<double> strengths;
  for (const BoltsInput* pattern : patterns_of_bars(input, bars_of(tunnel)))
    strengths.push_back(bolt_strength(*pattern));
  return strengths;
}

/// Supports whose strength is not given, so that nothing says whether they bear what they carry:
/// "bolts", "lining", "feet of the lining".
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<std::string> unchecked_supports(
    const AnalysisInput& input);
inline constexpr const char* not_checked = "no strength was given: not checked";

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE std::string governed_by(const BoltUtilisation& at) {
  const std::string bolt = "bolt " + std::to_string(at.bolt + 1) + ": ";
  if (at.limit.is_of_ends) return bolt + to_string(at.limit.mode);
  const char* words = "";
  switch (at.limit.mode) {
    case BoltMode::yield:
      words = "yield at";
      break;
    case BoltMode::rupture:
      words = "rupture at";
      break;
    case BoltMode::bond_at_tip:
      words = "bond beyond";
      break;
    case BoltMode::bond_at_head:
      words = "bond before";
      break;
    case BoltMode::plate:
      words = "plate and bond before";
      break;
    case BoltMode::anchor:
      break;  // of a bolt that is held by its ends
  }
  return bolt + words + " its joint at " + message_number(at.position, 3) + " m";
}

VOUSSOIR_DESIGN_INLINE std::vector<std::string> unchecked_supports(const AnalysisInput& input) {
  std::vector<std::string> unchecked;
  if (!std::all_of(input.bolts.begin(), input.bolts.end(), has_strength))
    unchecked.emplace_back("bolts");
  if (std::any_of(input.linings.begin(), input.linings.end(),
                  [](const LiningInput& lining) { return !lining.concrete; }))
    unchecked.emplace_back("lining");
  if (std::any_of(input.linings.begin(), input.linings.end(),
                  [](const LiningInput& lining) { return lining.feet && !lining.feet->strength; }))
    unchecked.emplace_back("feet of the lining");
  return unchecked;
}

#endif

}  // namespace voussoir::design
