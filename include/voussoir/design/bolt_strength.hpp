// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/tunnel/support_forces.hpp>

/// What bolts carry of what they can.
namespace voussoir::design {

/// Of one bolt in tension [N], the lower of yield and rupture; infinite: none was given.
[[nodiscard]] inline double bolt_strength(const BoltsInput& bolts) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return std::min(bolts.yield_force.value_or(unlimited), bolts.rupture_force.value_or(unlimited));
}

/// Of every bolt that was installed [N].
template <class Solver>
[[nodiscard]] std::vector<double> bolt_strengths(const AnalysisInput& input, const Solver& tunnel) {
  std::vector<double> strengths;
  for (const BoltsInput* pattern : patterns_of_bars(input, bars_of(tunnel)))
    strengths.push_back(bolt_strength(*pattern));
  return strengths;
}

/// The largest force of a bolt over its strength [-]; none: no bolt has one.
template <class Solver>
[[nodiscard]] std::optional<double> most_of_bolt_strength(const AnalysisInput& input,
                                                          const Solver& tunnel) {
  const std::vector<double> strengths = bolt_strengths(input, tunnel);
  const std::vector<double> forces = largest_bolt_forces(tunnel);
  std::optional<double> most;
  for (std::size_t k = 0; k < strengths.size(); ++k)
    if (std::isfinite(strengths[k])) most = std::max(most.value_or(0), forces[k] / strengths[k]);
  return most;
}

/// Supports whose strength is not given, so that nothing says whether they bear what they carry:
/// "bolts", "lining", "feet of the lining".
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<std::string> unchecked_supports(
    const AnalysisInput& input);
inline constexpr const char* not_checked = "no strength was given: not checked";

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE std::vector<std::string> unchecked_supports(const AnalysisInput& input) {
  std::vector<std::string> unchecked;
  if (std::any_of(input.bolts.begin(), input.bolts.end(),
                  [](const BoltsInput& pattern) { return std::isinf(bolt_strength(pattern)); }))
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
