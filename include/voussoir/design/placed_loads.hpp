// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/placed_load.hpp>

/// Loads on blocks of the rock, where an analysis puts them.
namespace voussoir::design {

/// Where it acts in the model, and what.
template <int Dim>
[[nodiscard]] PlacedLoad<Dim> placed_load(const AnalysisInput& input, const LoadInput& load) {
  if constexpr (Dim == 2) {
    (void)input;
    return {load.at, {Vec2(load.force[0], load.force[1]), Spin<2>(load.moment[0])}};
  } else {
    return {opening_in_space(input, 0, opening_of(input)).in_space(load.at, load.place),
            {load.force, load.moment}};
  }
}

/// What is wrong with a load, before any rock is made.
struct LoadFault {
  std::size_t load;      ///< from 0
  bool is_of_its_stage;  ///< else of its place
  std::string text;
};
/// @pre  stages and openings are without fault
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<LoadFault> fault_of_loads(
    const AnalysisInput& input);

/// With which of the stages that are built a load comes on, from 0.
/// @param count  of these, > 0
/// @pre  `fault_of_loads` finds none
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::size_t stage_of(const AnalysisInput& input,
                                                          const LoadInput& load, std::size_t count);

/// Gives loads to the stages with which they come on.
/// @pre  `fault_of_loads` finds none
template <class Solver>
void load_blocks(const AnalysisInput& input, Construction<Solver>& construction) {
  auto& stages = construction.stages;
  for (const LoadInput& load : input.loads)
    stages[stage_of(input, load, stages.size())].load_block(placed_load<Solver::dim>(input, load));
}

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// Why a load cannot come on with its stage; empty: it can.
VOUSSOIR_DESIGN_INLINE std::string fault_of_stage(const AnalysisInput& input,
                                                  const LoadInput& load) {
  if (!load.stage) return "";
  if (*load.stage >= input.stages.size())
    return message({"stage ", *load.stage, " is none; must be below ", input.stages.size()});
  const StageInput& stage = input.stages[*load.stage];
  if (input.is_spatial() && input.tunnel.round_length)
    return "\"" + stage.name +
           "\" is done in every advance of the face; must be left out: it comes on in the last";
  if (!is_modelled(input, stage.opening))
    return "\"" + stage.name + "\" works in an opening that a section does not show";
  for (std::size_t k = *load.stage + 1; k < input.stages.size(); ++k)
    if (input.stages[k].part && is_modelled(input, input.stages[k].opening))
      return "\"" + input.stages[k].name + "\" excavates after \"" + stage.name +
             "\"; must be a stage after the last excavation";
  return "";
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE std::size_t stage_of(const AnalysisInput& input, const LoadInput& load,
                                            std::size_t count) {
  if (!load.stage) return count - 1;
  std::size_t before = 0;
  for (std::size_t k = 0; k < *load.stage; ++k)
    if (is_modelled(input, input.stages[k].opening)) ++before;
  return before;
}

VOUSSOIR_DESIGN_INLINE std::optional<LoadFault> fault_of_loads(const AnalysisInput& input) {
  std::vector<SimplePolygon> sections;
  std::vector<PrismaticOpening> openings;
  for (std::size_t k = 0; k <= input.openings.size(); ++k)
    if (is_modelled(input, k)) {
      if (input.is_spatial())
        openings.push_back(opening_in_space(input, k, outline_of(outline_input(input, k))));
      else
        sections.push_back(opening_in_section(input, k));
    }
  for (std::size_t k = 0; k < input.loads.size(); ++k) {
    const LoadInput& load = input.loads[k];
    if (std::string text = detail::fault_of_stage(input, load); !text.empty())
      return LoadFault{k, true, std::move(text)};
    try {
      if (input.is_spatial())
        check_load(placed_load<3>(input, load), spatial_domain(input), openings);
      else
        check_load(placed_load<2>(input, load), section_domain(input), sections);
    } catch (const InvalidInput& fault) {
      return LoadFault{k, false, fault.what()};
    }
  }
  return std::nullopt;
}

#endif

}  // namespace voussoir::design
