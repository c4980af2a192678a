// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/message_number.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/lining_utilisation.hpp>
#include <voussoir/design/shotcrete_blocks.hpp>
#include <voussoir/tunnel/support_forces.hpp>

/// What bolts carry of what they can.
namespace voussoir::design {

/// Of the bar of one bolt in tension [N], the lower of yield and rupture; infinite: none was given.
[[nodiscard]] inline double bolt_strength(const BoltsInput& bolts) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return std::min(bolts.yield_force.value_or(unlimited), bolts.rupture_force.value_or(unlimited));
}

/// What a bolt would fail of at a joint.
enum class BoltMode { yield, rupture, bond_at_tip, bond_at_head, plate, punching, anchor };
[[nodiscard]] inline const char* to_string(BoltMode mode) {
  constexpr const char* words[] = {"yield", "rupture",  "bond at the tip", "bond at the head",
                                   "plate", "punching", "anchor"};
  return words[static_cast<std::size_t>(mode)];
}

/// What a bolt bears in tension where it crosses a joint.
struct BoltLimit {
  double strength = std::numeric_limits<double>::infinity();  ///< [N]; infinite: none was given
  BoltMode mode = BoltMode::yield;
  bool is_of_ends = false;  ///< of a bolt that is held by its ends: everywhere along it
};

/// The least of three: the bar; the bond of all that is grouted beyond the joint, to the tip; the
/// bond of all that is grouted before it, to the head, and the plate there, or what it bears on.
/// `plate`, `punching`: where that bears the larger part of the last. Of an end-anchored bolt bar,
/// anchor and plate.
/// @param length    of the bolt [m]
/// @param position  of the joint from the head [m], 0 to `length`
/// @param punching  of the shotcrete under the plate [N]; infinite: it bears on rock
[[nodiscard]] inline BoltLimit bolt_limit(
    const BoltsInput& bolts, double length, double position,
    double punching = std::numeric_limits<double>::infinity()) {
  BoltLimit limit{bolt_strength(bolts), bolts.yield_force ? BoltMode::yield : BoltMode::rupture};
  if (bolts.type == BoltType::end_anchored) {
    limit.is_of_ends = true;
    if (bolts.anchor_strength && *bolts.anchor_strength < limit.strength)
      limit = {*bolts.anchor_strength, BoltMode::anchor, true};
    if (bolts.plate_strength && *bolts.plate_strength < limit.strength)
      limit = {*bolts.plate_strength, BoltMode::plate, true};
    if (punching < limit.strength) limit = {punching, BoltMode::punching, true};
    return limit;
  }
  if (!bolts.bond_strength) return limit;
  const double plate = std::min(bolts.plate_strength.value_or(0), punching);
  const double beyond = *bolts.bond_strength * (length - position),
               before = *bolts.bond_strength * position;
  if (beyond < limit.strength) limit = {beyond, BoltMode::bond_at_tip};
  if (before + plate < limit.strength)
    limit = {before + plate, plate <= before     ? BoltMode::bond_at_head
                             : plate == punching ? BoltMode::punching
                                                 : BoltMode::plate};
  return limit;
}

/// What the shotcrete under the plate of a bolt bears [N], as old as when it is first loaded: of
/// the thinnest lining with concrete there that is not sprayed after the bolt was set. Infinite:
/// there is none, or the width of the plate is not given.
/// @param thickness  of the first lining [m]; none: that of the input
/// @param angle      of its head about the centre of its opening [rad], 0 to 2 pi
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double punching_under(const AnalysisInput& input,
                                                           const BoltsInput& bolts,
                                                           std::optional<double> thickness,
                                                           double angle);

/// Of the head of a bar about the centre of its opening [rad], 0 to 2 pi.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double angle_of_head(const AnalysisInput& input,
                                                          const BoltsInput& bolts,
                                                          const Segment& bar);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double angle_of_head(const AnalysisInput& input,
                                                          const BoltsInput& bolts,
                                                          const SpatialLine& bar);

/// A strength of the pattern is given.
[[nodiscard]] inline bool is_checked(const BoltsInput& bolts) {
  return std::isfinite(bolt_strength(bolts)) || bolts.bond_strength || bolts.anchor_strength ||
         (bolts.type == BoltType::end_anchored && bolts.plate_strength);
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
/// @param thickness  of the first lining [m]; none: that of the input
template <class Solver>
[[nodiscard]] std::vector<BoltUtilisation> bolt_utilisations(const AnalysisInput& input,
                                                             const Solver& tunnel,
                                                             std::optional<double> thickness = {}) {
  const auto bars = bars_of(tunnel);
  const std::vector<const BoltsInput*> patterns = patterns_of_bars(input, bars);
  std::vector<int> joints(bars.size(), 0);
  std::vector<BoltUtilisation> found;
  for (const CrossingForce& at : bolt_forces(tunnel)) {
    const auto k = static_cast<std::size_t>(at.bolt);
    const double punching = patterns[k]->plate_width
                                ? punching_under(input, *patterns[k], thickness,
                                                 angle_of_head(input, *patterns[k], bars[k]))
                                : std::numeric_limits<double>::infinity();
    found.push_back({at.bolt, ++joints[k], at.position, at.report.axial,
                     bolt_limit(*patterns[k], bars[k].length(), at.position, punching)});
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
                                                          const Solver& tunnel,
                                                          std::optional<double> thickness = {}) {
  const std::vector<BoltUtilisation> joints = bolt_utilisations(input, tunnel, thickness);
  if (const BoltUtilisation* const most = governing(joints)) return most->value();
  for (const BoltsInput* pattern : patterns_of_bars(input, bars_of(tunnel)))
    if (is_checked(*pattern)) return 0.0;
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

VOUSSOIR_DESIGN_INLINE double angle_of_head(const AnalysisInput& input, const BoltsInput& bolts,
                                            const Segment& bar) {
  return detail::turn_of(bar.start - centre_in_section(input, bolts.opening));
}
VOUSSOIR_DESIGN_INLINE double angle_of_head(const AnalysisInput& input, const BoltsInput& bolts,
                                            const SpatialLine& bar) {
  return detail::turn_of(
      opening_in_space(input, bolts.opening, outline_of(outline_input(input, bolts.opening)))
          .across(bar.start));
}

VOUSSOIR_DESIGN_INLINE double punching_under(const AnalysisInput& input, const BoltsInput& bolts,
                                             std::optional<double> thickness, double angle) {
  double least = std::numeric_limits<double>::infinity();
  if (!bolts.plate_width) return least;
  // In rounds what is farther behind the face is later, then what comes later in the file.
  const auto set_at = [&](const auto& installs) {
    std::pair<int, std::size_t> first{std::numeric_limits<int>::max(), 0};
    for (std::size_t k = 0; k < input.stages.size(); ++k)
      if (installs(input.stages[k])) first = std::min(first, {input.stages[k].behind, k});
    return first;
  };
  const auto has = [](const std::vector<std::size_t>& list, std::size_t number) {
    return std::find(list.begin(), list.end(), number) != list.end();
  };
  const auto pattern = static_cast<std::size_t>(&bolts - input.bolts.data());
  const auto bolted = set_at([&](const StageInput& stage) { return has(stage.bolts, pattern); });
  for (std::size_t k = 0; k < input.linings.size(); ++k) {
    const LiningInput& lining = input.linings[k];
    const double depth = k == 0 ? thickness.value_or(lining.thickness) : lining.thickness;
    if (lining.opening != bolts.opening || !lining.concrete || !(depth > 0) ||
        !covers(lining, angle))
      continue;
    if (set_at([&](const StageInput& stage) { return has(stage.linings, k); }) > bolted) continue;
    least = std::min(least, punching_resistance(shotcrete_of(lining, depth), *bolts.plate_width));
  }
  return least;
}

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
    case BoltMode::punching:
      words = "punching of the shotcrete by its plate, and bond before";
      break;
    case BoltMode::anchor:
      break;  // of a bolt that is held by its ends
  }
  return bolt + words + " its joint at " + message_number(at.position, 3) + " m";
}

VOUSSOIR_DESIGN_INLINE std::vector<std::string> unchecked_supports(const AnalysisInput& input) {
  std::vector<std::string> unchecked;
  if (!std::all_of(input.bolts.begin(), input.bolts.end(), is_checked))
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
