// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/openings.hpp>

/// In which order linings are installed, and how old they are then.
namespace voussoir::design {

/// The supports of one tunnel among many in the same rock.
struct SupportChoice {
  std::optional<BoltSpacing> spacing;  ///< none: no bolts
  double thickness = 0;                ///< of the lining [m]; 0: no lining
};

/// A stage of the construction as it is built: one of the input, in rounds along the tunnel all
/// that is done in one advance.
struct PlannedStage {
  double duration = 0;                           ///< [s]
  std::vector<const LiningInput*> linings = {};  ///< that it installs, in their order
};
/// All of them, in their order.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<PlannedStage> planned_stages(
    const AnalysisInput& input, const SupportChoice& supports);
/// How old linings are when a stage begins, which then loads them [s]: of all that it and stages
/// before it install, in that order; `ConcreteAge::when_loaded`, and what stages have lasted since
/// they were installed. Infinite: its age is not given.
/// @param stage  from 0
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<double> lining_ages(
    const std::vector<PlannedStage>& stages, std::size_t stage);
/// Linings in the order in which they are installed, in rounds along the tunnel once for every
/// stretch: the number of a lining in forces and tables.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<const LiningInput*> linings_as_installed(
    const AnalysisInput& input, const SupportChoice& supports);
/// That of the input, or for the first lining what is chosen; 0: it is left out [m].
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double thickness_of(const AnalysisInput& input,
                                                         const LiningInput& lining,
                                                         const SupportChoice& supports);
#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// The stretch of its opening in which a stage works when the tunnel's face has advanced so often.
VOUSSOIR_DESIGN_INLINE std::optional<int> stretch_at(const AnalysisInput& input,
                                                     const StageInput& stage, int face) {
  const int k = face - stage.behind;
  if (k < 0 || k >= drive_of(input, stage.opening).count) return std::nullopt;
  return k;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE double thickness_of(const AnalysisInput& input, const LiningInput& lining,
                                           const SupportChoice& supports) {
  return &lining == &input.linings.front() ? supports.thickness : lining.thickness;
}

VOUSSOIR_DESIGN_INLINE std::vector<PlannedStage> planned_stages(const AnalysisInput& input,
                                                                const SupportChoice& supports) {
  std::vector<PlannedStage> stages;
  const auto add = [&](const StageInput& entry) {
    for (const std::size_t k : entry.linings)
      if (thickness_of(input, input.linings[k], supports) > 0)
        stages.back().linings.push_back(&input.linings[k]);
    stages.back().duration = std::max(stages.back().duration, entry.duration);
  };
  if (!input.is_spatial() || !input.tunnel.round_length) {
    for (const StageInput& entry : input.stages) {
      if (!is_modelled(input, entry.opening)) continue;
      stages.emplace_back();
      add(entry);
    }
    return stages;
  }
  for (int face = 0; face < advance_count(input); ++face) {
    stages.emplace_back();
    for (const StageInput& entry : input.stages)
      if (detail::stretch_at(input, entry, face)) add(entry);
  }
  return stages;
}

VOUSSOIR_DESIGN_INLINE std::vector<double> lining_ages(const std::vector<PlannedStage>& stages,
                                                       std::size_t stage) {
  std::vector<double> ages;
  for (std::size_t k = 0; k <= stage && k < stages.size(); ++k) {
    for (const LiningInput* const lining : stages[k].linings)
      ages.push_back(lining->age ? lining->age->when_loaded
                                 : std::numeric_limits<double>::infinity());
    if (k < stage)
      for (double& age : ages) age += stages[k].duration;
  }
  return ages;
}

VOUSSOIR_DESIGN_INLINE std::vector<const LiningInput*> linings_as_installed(
    const AnalysisInput& input, const SupportChoice& supports) {
  std::vector<const LiningInput*> installed;
  for (const PlannedStage& stage : planned_stages(input, supports))
    installed.insert(installed.end(), stage.linings.begin(), stage.linings.end());
  return installed;
}

#endif

}  // namespace voussoir::design
