// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/bolt_strength.hpp>
#include <voussoir/design/boundary.hpp>
#include <voussoir/design/check_input.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/lining_utilisation.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/design/rock.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/outline_convergence.hpp>
#include <voussoir/tunnel/support_demand.hpp>

/// From the input of an analysis to its results: one tunnel, stage by stage.
namespace voussoir::design {

/// The rock of an input under its in-situ stress, nothing moved: the start of every tunnel that
/// differs in its supports only. A section that is taken out at once is out.
struct ExcavatedRock {
  std::variant<Tunnel, SpatialTunnel> tunnel;
  SimplePolygon opening;              ///< section of the tunnel
  ChosenBoundary boundary = {};       ///< 2-D; in 3-D there are rollers
  double in_situ_out_of_balance = 0;  ///< of the worst block over its weight [-]
};

/// A finished analysis.
template <class Geometry>
struct TunnelRun {
  TunnelIn<Geometry> tunnel;
  SimplePolygon opening;         ///< section of the tunnel
  ChosenBoundary boundary = {};  ///< 2-D; in 3-D there are rollers
  ConstructionResult<Geometry> built = {};
  double in_situ_out_of_balance =
      0;  ///< of the worst block over its weight, before the excavation [-]
  /// Of linings whose concrete ages, after every stage; else empty.
  std::vector<StageUtilisation> lining_history = {};

  [[nodiscard]] const EquilibriumReport& last() const { return built.last(); }
  /// In words: `to_string(verdict(), fallen_measure(), built.has_lost_lining())`.
  [[nodiscard]] Verdict verdict() const { return built.verdict(); }
  [[nodiscard]] double fallen_measure() const { return built.fallen_measure(); }
  /// How much of that hangs on limits and rates; where rock has come off in motion, or nearly.
  [[nodiscard]] std::optional<RockfallRange> rockfall() const { return built.rockfall_range(); }
  /// At the end [m]; in 3-D of the whole length.
  [[nodiscard]] const Convergence& convergence() const { return built.stages.back().convergence; }
};

/// What its linings carry of what they can, at the end of it.
template <class Geometry>
[[nodiscard]] std::vector<NodeUtilisation> lining_utilisations(const AnalysisInput& input,
                                                               const TunnelRun<Geometry>& run);

/// @param rock        consumed
/// @param wants_bias  see `bounded_tunnel`
/// @throws InvalidInput  the input does not fit together; NumericalFault; Stopped
[[nodiscard]] VOUSSOIR_DESIGN_INLINE ExcavatedRock excavated_rock(const AnalysisInput& input,
                                                                  JointedRock<Planar> rock,
                                                                  bool wants_bias,
                                                                  const StageProgress& report = {});
[[nodiscard]] VOUSSOIR_DESIGN_INLINE ExcavatedRock excavated_rock(const AnalysisInput& input,
                                                                  JointedRock<Spatial> rock,
                                                                  const StageProgress& report = {});

/// The same of a section between sides that are chosen already.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE ExcavatedRock excavated_rock(const AnalysisInput& input,
                                                                  JointedRock<Planar> rock,
                                                                  const ChosenBoundary& boundary,
                                                                  const StageProgress& report = {});

/// The supports of the input itself.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SupportChoice supports_of(const AnalysisInput& input);

template <class Geometry>
std::vector<NodeUtilisation> lining_utilisations(const AnalysisInput& input,
                                                 const TunnelRun<Geometry>& run) {
  return lining_utilisations(input, supports_of(input), run.tunnel, run.built.stages.size());
}

/// All stages of an input, in rock that is ready.
/// @param rock      of a section
/// @param observer  of its stages
/// @throws InvalidInput, NumericalFault, Stopped
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelRun<Planar> run_tunnel(
    const AnalysisInput& input, ExcavatedRock rock, const StageProgress& report = {},
    const StageObserver<Tunnel>& observer = {});
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelRun<Spatial> run_spatial_tunnel(
    const AnalysisInput& input, ExcavatedRock rock, const StageProgress& report = {},
    const StageObserver<SpatialTunnel>& observer = {});
/// From the input alone: its rock, then its stages.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelRun<Planar> run_tunnel(const AnalysisInput& input,
                                                                  const StageProgress& report = {});
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelRun<Spatial> run_spatial_tunnel(
    const AnalysisInput& input, const StageProgress& report = {});

/// Of the middle third of a tunnel that has been driven, 3-D [m].
[[nodiscard]] VOUSSOIR_DESIGN_INLINE Convergence middle_convergence(const AnalysisInput& input,
                                                                    const SpatialTunnel& tunnel);

/// Of an opening besides the tunnel.
struct OpeningConvergence {
  std::string name;
  Convergence convergence;  ///< [m]; 3-D: of its whole length
};
/// Of those that the model has, in the order of the input.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<OpeningConvergence> other_convergences(
    const AnalysisInput& input, const Tunnel& tunnel);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<OpeningConvergence> other_convergences(
    const AnalysisInput& input, const SpatialTunnel& tunnel);

/// Forces of the strips of a lining [N] over their width [N/m]; bolts as they are. 3-D.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SupportDemand per_metre(const AnalysisInput& input,
                                                             SupportDemand demand);

/// What came of one tunnel among many: the numbers that a design is chosen by.
struct TunnelResult {
  Verdict verdict = Verdict::undecided;
  bool failed = false;       ///< it could not be computed: the reason says why
  bool lost_lining = false;  ///< a lining came off its wall
  double fallen = 0;         ///< rock that detached, over all stages; 3-D: per metre driven [m^2]
  bool marginal = false;     ///< that hangs on limits and rates, see `RockfallRange`
  std::string reason;        ///< of the verdict, one sentence
  Convergence convergence = {not_computed, not_computed, not_computed, not_computed};  ///< [m]
  SupportDemand demand = {};
  double error_estimate = not_computed;  ///< of displacements [-]
  double out_of_balance = not_computed;  ///< of the worst block over its weight [-]
  std::size_t blocks = 0;
  std::string boundary;  ///< in words
  /// Joints at which a bolt has yielded or ruptured, and feet that have reached their strength.
  int bolts_yielded = 0, bolts_ruptured = 0, feet_yielded = 0;
  /// The largest utilisation of a bolt at a joint [-]; not a number: no strength was given. See
  /// `bolt_utilisations`.
  double of_bolt_strength = not_computed;
  std::string bolts_governed_by = {};  ///< see `governed_by`
  /// The largest utilisation of a lining [-], infinite where no thrust bears its moment; not a
  /// number: no concrete was given. See `lining_utilisations`.
  double of_lining_strength = not_computed;
  std::string lining_governed_by = {};  ///< see `governed_by`
  std::vector<std::string> warnings = {};

  static constexpr double not_computed = std::numeric_limits<double>::quiet_NaN();

  /// "stable", "stable after rockfall", "stable, bolts yielded", ..., "failed".
  [[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string word() const;
  /// Something of the supports has reached its strength.
  [[nodiscard]] bool has_yielded() const {
    return bolts_yielded + bolts_ruptured + feet_yielded > 0 || of_bolt_strength > 1 ||
           of_lining_strength > 1;
  }
  /// It has a verdict and, where no rock has fallen, a number for the crown.
  [[nodiscard]] bool is_decided() const {
    return !failed && verdict != Verdict::undecided &&
           (verdict == Verdict::collapse || fallen > 0 || std::isfinite(convergence.crown));
  }
  /// It stands, and all of its rock and its lining with it.
  [[nodiscard]] bool is_whole() const {
    return verdict == Verdict::stable && fallen == 0 && !lost_lining;
  }
};

/// Builds one tunnel in rock that is ready for it. The rock stays as it is: any number at a time.
/// What is computed does not depend on the machine: neither on its memory, which elsewhere decides
/// how elastic equations are solved, nor on its number of processors.
/// @return  a numerical fault is a result too: failed, with its text
/// @throws Stopped  `report` said so
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelResult
supported_tunnel(const AnalysisInput& input, const ExcavatedRock& rock,
                 const SupportChoice& supports, const StageProgress& report = {});

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// What the direct solution may take of one tunnel among many: the same on every machine, lest its
/// memory decide how equations are solved [bytes].
inline constexpr double memory_of_a_case = 4e9;

/// Two threads make and apply a factor 1.6 times as fast as one (bench/elastic_bench).
[[nodiscard]] inline LinearSettings linear_of_this_computer() {
  return {.threads = std::clamp(std::thread::hardware_concurrency(), 1U, 2U)};
}

[[nodiscard]] inline Progress progress_of_blocks(const StageProgress& report) {
  if (!report) return {};
  return [&report](double fraction) { return report("blocks", fraction); };
}

template <class Geometry>
TunnelRun<Geometry> run_of(ExcavatedRock rock) {
  return {std::get<TunnelIn<Geometry>>(std::move(rock.tunnel)),
          rock.opening,
          std::move(rock.boundary),
          {},
          rock.in_situ_out_of_balance};
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE ExcavatedRock excavated_rock(const AnalysisInput& input,
                                                    JointedRock<Planar> rock, bool wants_bias,
                                                    const StageProgress& report) {
  const Progress progress = detail::progress_of_blocks(report);
  const SimplePolygon opening = opening_of(input);
  const LawsBySet<AnyJoint> laws = laws_of(input);
  double out_of_balance = 0;
  const auto in_situ_tunnel = [&](const FarField<2>& far_field) {
    return Tunnel(rock.mass, laws, in_situ_of(input), progress, far_field);
  };
  const auto tunnel_of = [&](const FarField<2>& far_field) {
    Tunnel tunnel = in_situ_tunnel(far_field);
    out_of_balance = tunnel.out_of_balance_ratio();
    tunnel.excavate(opening, input.blocks.min_wall_area, progress);
    return tunnel;
  };
  BoundedTunnel bounded = bounded_tunnel(input, rock.mass, laws, tunnel_of, wants_bias, progress);
  if (input.has_rounds)  // each takes out its part; what the boundary does was asked of the whole
    bounded.tunnel = in_situ_tunnel(bounded.boundary.field);
  return {std::move(bounded.tunnel), opening, std::move(bounded.boundary), out_of_balance};
}

VOUSSOIR_DESIGN_INLINE ExcavatedRock excavated_rock(const AnalysisInput& input,
                                                    JointedRock<Planar> rock,
                                                    const ChosenBoundary& boundary,
                                                    const StageProgress& report) {
  const Progress progress = detail::progress_of_blocks(report);
  const SimplePolygon opening = opening_of(input);
  Tunnel tunnel(std::move(rock.mass), laws_of(input), in_situ_of(input), progress, boundary.field);
  const double out_of_balance = tunnel.out_of_balance_ratio();
  if (!input.has_rounds) tunnel.excavate(opening, input.blocks.min_wall_area, progress);
  return {std::move(tunnel), opening, boundary, out_of_balance};
}

VOUSSOIR_DESIGN_INLINE ExcavatedRock excavated_rock(const AnalysisInput& input,
                                                    JointedRock<Spatial> rock,
                                                    const StageProgress& report) {
  SpatialTunnel tunnel(std::move(rock.mass), laws_of(input), in_situ_of(input),
                       detail::progress_of_blocks(report));
  const double out_of_balance = tunnel.out_of_balance_ratio();
  return {std::move(tunnel), opening_of(input), {}, out_of_balance};
}

VOUSSOIR_DESIGN_INLINE SupportChoice supports_of(const AnalysisInput& input) {
  return {input.bolts.empty() ? std::nullopt : std::optional(input.bolts.front().spacing),
          input.linings.empty() ? 0.0 : input.linings.front().thickness};
}

VOUSSOIR_DESIGN_INLINE TunnelRun<Planar> run_tunnel(const AnalysisInput& input, ExcavatedRock rock,
                                                    const StageProgress& report,
                                                    const StageObserver<Tunnel>& observer) {
  auto run = detail::run_of<Planar>(std::move(rock));
  run.built =
      construct(run.tunnel,
                construction_of(input, run.tunnel, !input.has_rounds, supports_of(input),
                                detail::linear_of_this_computer(), RangeSought::all),
                report, observing_age(input, supports_of(input), run.lining_history, observer));
  if (run.last().stopped) throw Stopped();  // nobody reads what could be told
  return run;
}

VOUSSOIR_DESIGN_INLINE TunnelRun<Spatial> run_spatial_tunnel(
    const AnalysisInput& input, ExcavatedRock rock, const StageProgress& report,
    const StageObserver<SpatialTunnel>& observer) {
  auto run = detail::run_of<Spatial>(std::move(rock));
  run.built =
      construct(run.tunnel,
                construction_of(input, supports_of(input), detail::linear_of_this_computer(),
                                RangeSought::all),
                report, observing_age(input, supports_of(input), run.lining_history, observer));
  if (run.last().stopped) throw Stopped();
  return run;
}

VOUSSOIR_DESIGN_INLINE TunnelRun<Planar> run_tunnel(const AnalysisInput& input,
                                                    const StageProgress& report) {
  check_input(input, 2);
  check_bolts(input, supports_of(input));
  return run_tunnel(
      input,
      excavated_rock(input, rock_of(input, detail::progress_of_blocks(report)), true, report),
      report);
}

VOUSSOIR_DESIGN_INLINE TunnelRun<Spatial> run_spatial_tunnel(const AnalysisInput& input,
                                                             const StageProgress& report) {
  check_input(input, 3);
  check_bolts(input, supports_of(input));
  return run_spatial_tunnel(
      input,
      excavated_rock(input, spatial_rock_of(input, detail::progress_of_blocks(report)), report),
      report);
}

VOUSSOIR_DESIGN_INLINE Convergence middle_convergence(const AnalysisInput& input,
                                                      const SpatialTunnel& tunnel) {
  const double driven = input.round_count() * input.stretch();
  return convergence(tunnel, driven_tunnel(input), 0.5 * driven, driven / 6);
}

VOUSSOIR_DESIGN_INLINE std::vector<OpeningConvergence> other_convergences(
    const AnalysisInput& input, const Tunnel& tunnel) {
  std::vector<OpeningConvergence> found;
  for (std::size_t k = 1; k <= input.openings.size(); ++k)
    if (is_modelled(input, k))
      found.push_back({opening_name(input, k), convergence(tunnel, opening_in_section(input, k))});
  return found;
}

VOUSSOIR_DESIGN_INLINE std::vector<OpeningConvergence> other_convergences(
    const AnalysisInput& input, const SpatialTunnel& tunnel) {
  std::vector<OpeningConvergence> found;
  for (std::size_t k = 1; k <= input.openings.size(); ++k) {
    const SimplePolygon section = outline_of(outline_input(input, k));
    found.push_back(
        {opening_name(input, k), convergence(tunnel, opening_in_space(input, k, section))});
  }
  return found;
}

VOUSSOIR_DESIGN_INLINE SupportDemand per_metre(const AnalysisInput& input, SupportDemand demand) {
  if (input.linings.empty()) return demand;
  const double width = strip_width(input);
  for (double* const force : {&demand.largest_thrust, &demand.mean_thrust, &demand.largest_moment})
    *force /= width;
  return demand;
}

VOUSSOIR_DESIGN_INLINE std::string TunnelResult::word() const {
  if (failed) return "failed";
  std::string text = to_string(verdict, fallen, lost_lining);
  if (verdict != Verdict::stable) return text;
  if (bolts_yielded > 0) text += ", bolts yielded";
  if (bolts_ruptured > 0) text += ", bolts ruptured";
  if (of_bolt_strength > 1 && bolts_yielded + bolts_ruptured == 0)
    text += ", bolts beyond their bond";
  if (feet_yielded > 0) text += ", feet at their strength";
  if (of_lining_strength > 1) text += ", lining beyond its strength";
  return text;
}

namespace detail {

/// The numbers of a tunnel that has been built.
/// @param begun  see `lining_utilisations`
template <class Solver>
void describe(const AnalysisInput& input, const SupportChoice& supports, const Solver& tunnel,
              const ConstructionResult<typename Solver::Geometry>& built, std::size_t begun,
              const std::vector<StageUtilisation>& lining_history, TunnelResult& result) {
  result.verdict = built.verdict();
  result.lost_lining = built.has_lost_lining();
  result.fallen = built.fallen_measure();
  if (const auto range = built.rockfall_range()) result.marginal = range->is_marginal();
  result.reason = built.last().reason;
  result.demand = support_demand(tunnel);
  if constexpr (std::is_same_v<Solver, SpatialTunnel>) {
    result.convergence = middle_convergence(input, tunnel);
    result.demand = per_metre(input, result.demand);
    result.fallen /= input.round_count() * input.stretch();
    if (result.fallen > 0 && !built.rockfall_range())
      result.warnings.emplace_back("rock came off; whether that is marginal was not looked for");
  } else {
    result.convergence = built.stages.back().convergence;
  }
  const SupportCondition condition = support_condition(tunnel);
  result.bolts_yielded = condition.yielded;
  result.bolts_ruptured = condition.ruptured;
  result.feet_yielded = static_cast<int>(condition.yielded_feet.size());
  if (const auto part = most_of_bolt_strength(input, tunnel, supports.thickness))
    result.of_bolt_strength = *part;
  const std::vector<BoltUtilisation> joints = bolt_utilisations(input, tunnel, supports.thickness);
  if (const BoltUtilisation* const most = governing(joints))
    result.bolts_governed_by = governed_by(*most);
  const std::vector<NodeUtilisation> nodes = lining_utilisations(input, supports, tunnel, begun);
  if (const StageUtilisation* const stage = governing(lining_history)) {
    result.of_lining_strength = stage->most.use.value;
    result.lining_governed_by = stage->stage + ": " + governed_by(stage->most);
  } else if (const NodeUtilisation* const most = governing(nodes)) {
    result.of_lining_strength = most->use.value;
    result.lining_governed_by = governed_by(*most);
  }
  result.error_estimate = built.last().error_estimate;
  result.out_of_balance = built.last().unbalance_over_weight;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE TunnelResult supported_tunnel(const AnalysisInput& input,
                                                     const ExcavatedRock& rock,
                                                     const SupportChoice& supports,
                                                     const StageProgress& report) {
  TunnelResult result;
  std::visit([&](const auto& tunnel) { result.blocks = tunnel.mass().bodies.size(); }, rock.tunnel);
  result.boundary = input.is_spatial() ? spatial_boundary_text : boundary_text(rock.boundary);
  const auto compute = [&](auto tunnel, const auto& construction) {
    using Solver = std::decay_t<decltype(tunnel)>;
    std::vector<StageUtilisation> lining_history;
    const auto built = construct(tunnel, construction, report,
                                 observing_age<Solver>(input, supports, lining_history));
    if (built.last().stopped) throw Stopped();
    detail::describe(input, supports, tunnel, built, built.stages.size(), lining_history, result);
  };
  const LinearSettings linear{.memory_limit = detail::memory_of_a_case};
  try {
    if (const auto* section = std::get_if<Tunnel>(&rock.tunnel))
      compute(*section, construction_of(input, *section, !input.has_rounds, supports, linear,
                                        RangeSought::until_marginal));
    else
      compute(std::get<SpatialTunnel>(rock.tunnel),
              construction_of(input, supports, linear, RangeSought::until_marginal));
  } catch (const NumericalFault& fault) {
    result.failed = true;
    result.reason = fault.what();
  }
  return result;
}

#endif

}  // namespace voussoir::design
