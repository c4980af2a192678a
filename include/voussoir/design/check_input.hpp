// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/design/placed_loads.hpp>

/// What an analysis needs before anything is computed. Models and geometry check their own values
/// when they are made; here is what only the parts together can tell, and what would pass for
/// another tunnel.
namespace voussoir::design {

/// @param dimension  in which it is to be computed
/// @throws InvalidInput  names the member, its value and what is accepted
VOUSSOIR_DESIGN_INLINE void check_input(const AnalysisInput& input, int dimension);

/// A bolt that would end outside the rock.
struct BoltOutside {
  std::size_t pattern;
  std::string end, low, high;  ///< where it would end, and the corners of the rock [m]
  double room;                 ///< how long it could be to end at the edge of the rock [m]
};
/// The first of those patterns whose spacing is given; none: all end in the rock.
/// @param spacings  of each pattern of the input; none: it is not looked at
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<BoltOutside> bolt_outside(
    const AnalysisInput& input, const std::vector<std::optional<BoltSpacing>>& spacings);

/// @throws InvalidInput  a bolt would end outside the rock
VOUSSOIR_DESIGN_INLINE void check_bolts(const AnalysisInput& input, const SupportChoice& supports);

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// How far it is from a place to the edge of the rock; 0: it lies outside [m].
template <int Dim>
double room_from(const Vec<Dim>& head, const Vec<Dim>& way, const Domain<Dim>& domain) {
  double share = 1;
  for (int axis = 0; axis < Dim; ++axis) {
    const double edge = way[axis] > 0 ? domain.high[axis] : domain.low[axis];
    if (way[axis] != 0) share = std::min(share, (edge - head[axis]) / way[axis]);
  }
  return std::max(share, 0.0) * length_of(way);
}

template <int Dim, class Bars>
std::optional<BoltOutside> end_outside(std::size_t pattern, const Bars& bars,
                                       const Domain<Dim>& domain) {
  for (const auto& bar : bars)
    for (const Vec<Dim>& end : {bar.start, bar.end})
      if ((end.array() < domain.low.array()).any() || (end.array() > domain.high.array()).any())
        return BoltOutside{pattern, text_of<Dim>(end), text_of<Dim>(domain.low),
                           text_of<Dim>(domain.high),
                           room_from(bar.start, Vec<Dim>(bar.end - bar.start), domain)};
  return std::nullopt;
}

VOUSSOIR_DESIGN_INLINE void check_openings(const AnalysisInput& input) {
  for (std::size_t k = 0; k <= input.openings.size(); ++k) {
    const OutlineInput& outline = outline_input(input, k);
    const std::string name = opening_name(input, k) + ": ";
    if (outline.shape == TunnelShape::polygon && outline.vertices.size() < 3)
      throw InvalidInput(
          message({name, "vertices: ", outline.vertices.size(), " of them; must be 3 or more"}));
  }
  const auto fault = fault_of_openings(input);
  if (fault) throw InvalidInput(opening_name(input, fault->opening) + ": " + fault->text);
}

VOUSSOIR_DESIGN_INLINE void check_joints(const AnalysisInput& input) {
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& set = input.joint_sets[k];
    const int given = int{set.intensity.has_value()} + int{set.spacing.has_value()} +
                      int{set.p32.has_value()} + int{set.p30.has_value()};
    if (given > 1 || (given == 0 && input.mapped.traces.empty()))
      throw InvalidInput(message({"joint set ", k, " ", set.name, ": ", given,
                                  " of intensity, spacing, P32 and P30 are given; must be one"}));
    if ((set.intensity || set.p30) && std::isinf(set.extent))
      throw InvalidInput(message(
          {"joint set ", k, " ", set.name, ": counts joints, whose extent must be finite"}));
  }
}

VOUSSOIR_DESIGN_INLINE void check_stages(const AnalysisInput& input) {
  if (input.stages.empty()) throw InvalidInput("stages: there is none; must be one or more");
  const std::size_t openings = input.openings.size() + 1;
  const auto below = [](std::size_t number, std::size_t count, const std::string& what) {
    if (number >= count)
      throw InvalidInput(message({what, ": ", number, "; must be below ", count}));
  };
  bool excavates = false;
  for (const StageInput& stage : input.stages) {
    const std::string name = stage.name + ", ";
    below(stage.opening, openings, name + "number of its opening");
    for (const std::size_t k : stage.bolts)
      below(k, input.bolts.size(), name + "number of a pattern of bolts");
    for (const std::size_t k : stage.linings)
      below(k, input.linings.size(), name + "number of a lining");
    require(stage.wall_traction >= 0 && stage.wall_traction <= 1,
            (name + "traction left on the wall").c_str(), stage.wall_traction, "0 to 1");
    require(stage.duration >= 0 && std::isfinite(stage.duration), (name + "duration").c_str(),
            stage.duration, ">= 0");
    excavates = excavates || stage.part.has_value();
  }
  if (!excavates) throw InvalidInput("stages: none of them excavates anything; one must");
  if (const StageInput& last = input.stages.back(); last.wall_traction > 0)
    throw InvalidInput(message({last.name, ", traction left on the wall: ", last.wall_traction,
                                " at the end; must be 0, the tunnel stands without it"}));
  for (const BoltsInput& bolts : input.bolts)
    below(bolts.opening, openings, bolts.name + ", number of its opening");
  for (const LiningInput& lining : input.linings)
    below(lining.opening, openings, lining.name + ", number of its opening");
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE void check_input(const AnalysisInput& input, int dimension) {
  if (input.model.dimension != dimension)
    throw InvalidInput(message(
        {"dimension of the model: ", input.model.dimension, "; must be ", dimension, " here"}));
  require(input.model.width > 0 && std::isfinite(input.model.width), "width of the model",
          input.model.width, "> 0 m");
  require(input.model.below_invert > 0 && std::isfinite(input.model.below_invert),
          "ground under the invert", input.model.below_invert, "> 0 m");
  require(input.tunnel.cover > 0 && std::isfinite(input.tunnel.cover), "cover of the tunnel",
          input.tunnel.cover, "> 0 m");
  if (dimension == 3)
    require(input.model.length > 0 && std::isfinite(input.model.length), "length of the model",
            input.model.length, "> 0 m");
  require(input.rock.density > 0 && std::isfinite(input.rock.density), "density of the rock",
          input.rock.density, "> 0 kg/m3");
  require(input.stress.K0 >= 0 && std::isfinite(input.stress.K0), "K0", input.stress.K0, ">= 0");
  require(input.run.out_of_balance > 0 && input.run.out_of_balance <= 0.1,
          "accepted out-of-balance force ratio", input.run.out_of_balance, "> 0 and <= 0.1");
  if (input.boundary.sides.has_value() != input.boundary.base.has_value())
    throw InvalidInput("boundary: sides and base must be given together");
  if (dimension == 3 && (!input.mapped.traces.empty()))
    throw InvalidInput("mapped traces: are of a section; must be none in 3-D");
  detail::check_openings(input);
  detail::check_joints(input);
  detail::check_stages(input);
  if (const auto fault = fault_of_loads(input))
    throw InvalidInput(message({"load ", fault->load, ": ", fault->text}));
}

VOUSSOIR_DESIGN_INLINE std::optional<BoltOutside> bolt_outside(
    const AnalysisInput& input, const std::vector<std::optional<BoltSpacing>>& spacings) {
  for (std::size_t k = 0; k < input.bolts.size() && k < spacings.size(); ++k) {
    const BoltsInput& bolts = input.bolts[k];
    if (!spacings[k] || !is_modelled(input, bolts)) continue;
    // Along a level tunnel the rows lie inside; the section says the rest.
    const bool by_section =
        !input.is_spatial() || (bolts.opening == 0 && !bolts.ahead && input.tunnel.plunge == 0);
    auto found = by_section ? detail::end_outside<2>(k, bars_of_pattern(input, bolts, *spacings[k]),
                                                     section_domain(input))
                            : detail::end_outside<3>(k, rows_of_pattern(input, bolts, *spacings[k]),
                                                     spatial_domain(input));
    if (found) return found;
  }
  return std::nullopt;
}

VOUSSOIR_DESIGN_INLINE void check_bolts(const AnalysisInput& input, const SupportChoice& supports) {
  std::vector<std::optional<BoltSpacing>> spacings{supports.spacing};
  for (std::size_t k = 1; k < input.bolts.size(); ++k) spacings.push_back(input.bolts[k].spacing);
  if (const auto found = bolt_outside(input, spacings))
    throw InvalidInput(input.bolts[found->pattern].name + ": a bolt would end at " + found->end +
                       message({" m, outside the rock; it could be ", found->room,
                                " m long there: must end within "}) +
                       found->low + " and " + found->high + " m");
}

#endif

}  // namespace voussoir::design
