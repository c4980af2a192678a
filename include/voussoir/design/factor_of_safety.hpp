// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/strength_reduction.hpp>

/// By how much strength may be divided until a model falls: the factor of safety by strength
/// reduction.
namespace voussoir::design {

/// How a factor is sought.
struct FactorSearch {
  double least = 0.05;  ///< factors are tried from here [-], > 0
  double most = 20;     ///< to here [-]
  double step = 1.5;    ///< between trials until one stands and one falls [-], > 1
  double width = 0.01;  ///< between the two in the end, relative [-], 1e-4 to 1
};

/// What a trial said.
enum class TrialOutcome { stands, falls, undecided };

/// One factor that was tried.
struct FactorTrial {
  double factor;
  TrialOutcome outcome;
};

/// Between which factors strength ends.
struct FactorBracket {
  double stands = 0;  ///< the largest that stands below all that do not; 0: none
  /// The smallest above that does not: it falls, or is not decided; infinite: all stand.
  double falls = std::numeric_limits<double>::infinity();
  std::vector<FactorTrial> trials;  ///< in the order in which they were made

  /// Whether it is as narrow as was asked for.
  [[nodiscard]] bool is_closed() const { return stands > 0 && std::isfinite(falls); }
  /// Some trial that was not decided counts as one that falls.
  [[nodiscard]] bool has_undecided() const {
    return std::any_of(trials.begin(), trials.end(), [](const FactorTrial& trial) {
      return trial.outcome == TrialOutcome::undecided;
    });
  }
};

/// Brackets the factor up to which trials stand: from 1 in steps up or down until one stands and
/// one does not, then by halves. A trial that is not decided counts as one that does not stand.
/// @param trial  trial(factor) -> TrialOutcome; what stands must stand with every smaller factor
/// @throws InvalidInput  a setting out of range; Stopped; what `trial` throws
/// @cost  some 10 trials
template <class Trial>
requires std::same_as<std::invoke_result_t<const Trial&, double>, TrialOutcome>
[[nodiscard]] FactorBracket bracket_factor(const Trial& trial, const FactorSearch& search = {}) {
  require(search.least > 0 && search.least <= 1, "least factor", search.least, "> 0 and <= 1");
  require(search.most >= 1 && std::isfinite(search.most), "largest factor", search.most, ">= 1");
  require(search.step > 1 && std::isfinite(search.step), "step of factors", search.step, "> 1");
  require(search.width >= 1e-4 && search.width <= 1, "width of a bracket", search.width,
          "1e-4 to 1");
  FactorBracket found;
  const auto stands = [&](double factor) {
    const TrialOutcome outcome = trial(factor);
    found.trials.push_back({factor, outcome});
    (outcome == TrialOutcome::stands ? found.stands : found.falls) = factor;
    return outcome == TrialOutcome::stands;
  };
  if (stands(1)) {
    while (std::isinf(found.falls) && found.stands < search.most)
      (void)stands(std::min(found.stands * search.step, search.most));
  } else {
    while (found.stands == 0 && found.falls > search.least)
      (void)stands(std::max(found.falls / search.step, search.least));
  }
  while (found.is_closed() && found.falls > found.stands * (1 + search.width))
    (void)stands(std::sqrt(found.stands * found.falls));
  return found;
}

/// What comes off, until a tunnel is said to fall.
enum class SafetyLimit {
  collapse,  ///< it does not come to rest, or loses more than `collapse_measure_of`
  rockfall,  ///< more rock than is tolerated comes off, or a lining
  supports   ///< that, or a bolt, foot or lining reaches its strength
};
[[nodiscard]] inline const char* to_string(SafetyLimit limit) {
  return limit == SafetyLimit::collapse   ? "collapse"
         : limit == SafetyLimit::rockfall ? "rockfall"
                                          : "supports";
}

/// How the factor of safety of a tunnel is sought.
struct SafetySettings {
  SafetyLimit limit = SafetyLimit::collapse;
  /// That may come off, per metre of tunnel, where the limit is not a collapse [m^2], >= 0.
  double tolerated_loss = 0;
  FactorSearch search = {};
  /// Every trial is the whole analysis, from the in-situ state of the weaker rock on. Else strength
  /// is divided once the tunnel stands: its last state under the largest factor so far goes on.
  bool from_start = false;
  bool with_supports = false;  ///< divides their strength too; `from_start` alone
};

/// The tunnel at one end of the bracket.
template <class Geometry>
struct TunnelAtFactor {
  double factor = 0;
  TunnelResult result;
  TunnelIn<Geometry> tunnel;
  ConstructionResult<Geometry> built;  ///< of the whole construction, or of the last stage alone
};

template <class Geometry>
struct TunnelSafety {
  FactorBracket bracket;
  std::vector<TunnelResult> results;  ///< of its trials, in their order
  /// The largest factor under which it stands, and the smallest under which it does not: its
  /// detached blocks are the mechanism. Empty where there is none.
  std::optional<TunnelAtFactor<Geometry>> standing, falling;
};

/// The factor of safety of a tunnel: by how much the strength of its joints may be divided. A trial
/// is decided by the verdict of a run; with `from_start` it is that of the run whose joints are so
/// much weaker. What is at rest lacks no more of its weight than a tenth of the width of the
/// bracket, for a block that slides at 30 degrees and lacks 1 % of its weight has 2 % too much.
/// @param rock    not excavated
/// @param report  asked now and then whether to go on; the stage is the factor
/// @throws InvalidInput  see `weakened`, `bracket_factor`, `check_input`; supports are to be
///                       weakened in a tunnel that stands
/// @throws Stopped
/// @cost  a run, and some 10 more of which those that stand need no excavation
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelSafety<Planar> factor_of_safety(
    const AnalysisInput& input, const JointedRock<Planar>& rock,
    const SafetySettings& settings = {}, const StageProgress& report = {});
/// In 3-D.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelSafety<Spatial> factor_of_safety(
    const AnalysisInput& input, const JointedRock<Spatial>& rock,
    const SafetySettings& settings = {}, const StageProgress& report = {});

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// One factor of safety being sought.
template <class Geometry>
class SafetySearch {
 public:
  using Solver = TunnelIn<Geometry>;

  /// @param in_situ  makes the rock of an input, ready to be built in
  template <class InSitu>
  SafetySearch(const AnalysisInput& input, const SafetySettings& settings,
               const StageProgress& report, InSitu in_situ)
      : input_(input), settings_(settings), report_(report), in_situ_(std::move(in_situ)) {
    input_.run.out_of_balance = std::min(input.run.out_of_balance, 0.1 * settings.search.width);
  }

  [[nodiscard]] TunnelSafety<Geometry> find() {
    safety_.bracket =
        bracket_factor([&](double factor) { return trial(factor); }, settings_.search);
    // A trial may have ended at the first block too many: what comes after it belongs to the
    // mechanism.
    if (settings_.limit != SafetyLimit::collapse && safety_.falling) {
      ends_early_ = false;
      safety_.falling = computed(safety_.falling->factor);
    }
    return std::move(safety_);
  }

 private:
  TrialOutcome trial(double factor) {
    TunnelAtFactor<Geometry> at = computed(factor);
    const TunnelResult& result = at.result;
    const bool keeps_rock = result.fallen <= settings_.tolerated_loss && !result.lost_lining;
    const bool stands = result.verdict == Verdict::stable && !result.failed &&
                        (settings_.limit == SafetyLimit::collapse || keeps_rock) &&
                        (settings_.limit != SafetyLimit::supports || !result.has_yielded());
    const TrialOutcome outcome = stands ? TrialOutcome::stands
                                 : result.failed || result.verdict == Verdict::undecided
                                     ? TrialOutcome::undecided
                                     : TrialOutcome::falls;
    safety_.results.push_back(result);
    (stands ? safety_.standing : safety_.falling) = std::move(at);
    return outcome;
  }

  [[nodiscard]] TunnelAtFactor<Geometry> computed(double factor) const {
    const bool goes_on = safety_.standing && !settings_.from_start;
    return goes_on ? weakened_further(factor) : built(factor);
  }

  /// The whole analysis of a weaker input.
  [[nodiscard]] TunnelAtFactor<Geometry> built(double factor) const {
    AnalysisInput weaker = with_weaker_joints(input_, factor);
    if (settings_.with_supports) weaker = with_weaker_supports(std::move(weaker), factor);
    Solver tunnel = in_situ_(weaker);
    auto construction = construction_in(weaker, tunnel);
    return carried_out(weaker, factor, std::move(tunnel), construction, 0);
  }

  /// The tunnel that stands under a smaller factor, after one more stage.
  [[nodiscard]] TunnelAtFactor<Geometry> weakened_further(double factor) const {
    Solver tunnel = safety_.standing->tunnel;
    tunnel.change_joint_laws(laws_of(with_weaker_joints(input_, factor)));
    auto construction = construction_in(input_, tunnel);
    construction.stages.clear();
    construction.add_stage(message({"strength over ", factor}),
                           safety_.standing->built.stages.back().wall_traction);
    return carried_out(input_, factor, std::move(tunnel), construction,
                       planned_stages(input_, supports_of(input_)).size());
  }

  [[nodiscard]] Construction<Solver> construction_in(const AnalysisInput& input,
                                                     const Solver& tunnel) const {
    const LinearSettings linear = linear_of_this_computer();
    Construction<Solver> made;
    if constexpr (std::is_same_v<Geometry, Planar>)
      made = construction_of(input, tunnel, !input.has_rounds, supports_of(input), linear,
                             RangeSought::none);
    else
      made = construction_of(input, supports_of(input), linear, RangeSought::none);
    if (settings_.limit != SafetyLimit::collapse && ends_early_)
      made.acceptance.collapse_measure = settings_.tolerated_loss;
    return made;
  }

  /// @param before  stages that stand already: concrete has the age of the last of them
  [[nodiscard]] TunnelAtFactor<Geometry> carried_out(const AnalysisInput& input, double factor,
                                                     Solver tunnel,
                                                     const Construction<Solver>& construction,
                                                     std::size_t before) const {
    StageProgress told;
    if (report_)
      told = [&](const std::string&, double fraction) {
        return report_(message({"strength over ", factor}), fraction);
      };
    TunnelAtFactor<Geometry> at{factor, {}, std::move(tunnel), {}};
    const SupportChoice supports = supports_of(input);
    std::vector<StageUtilisation> lining_history;
    at.result.blocks = at.tunnel.mass().bodies.size();
    try {
      at.built = construct(at.tunnel, construction, told,
                           before == 0 ? observing_age<Solver>(input, supports, lining_history)
                                       : StageObserver<Solver>());
    } catch (const NumericalFault& fault) {
      at.result.failed = true;
      at.result.reason = fault.what();
      return at;
    }
    if (at.built.last().stopped) throw Stopped();
    describe(input, supports, at.tunnel, at.built, before + at.built.stages.size(), lining_history,
             at.result);
    return at;
  }

  AnalysisInput input_;
  SafetySettings settings_;
  StageProgress report_;
  std::function<Solver(const AnalysisInput&)> in_situ_;
  bool ends_early_ = true;  ///< a trial, as soon as more has come off than is tolerated
  TunnelSafety<Geometry> safety_;
};

inline void check_safety(const AnalysisInput& input, int dimension,
                         const SafetySettings& settings) {
  check_input(input, dimension);
  check_bolts(input, supports_of(input));
  (void)laws_of(with_weaker_joints(input, 1));  // refused before anything is computed
  require(settings.tolerated_loss >= 0 && std::isfinite(settings.tolerated_loss), "tolerated loss",
          settings.tolerated_loss, ">= 0 m2 per metre");
  if (settings.with_supports && !settings.from_start)
    throw InvalidInput(
        "strength reduction: supports that stand keep their strength; must be from the start where "
        "theirs is divided too");
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE TunnelSafety<Planar> factor_of_safety(const AnalysisInput& input,
                                                             const JointedRock<Planar>& rock,
                                                             const SafetySettings& settings,
                                                             const StageProgress& report) {
  detail::check_safety(input, 2, settings);
  // What the sides meet does not hang on strength: it is chosen once.
  std::optional<ChosenBoundary> boundary;
  return detail::SafetySearch<Planar>(
             input, settings, report,
             [&](const AnalysisInput& weaker) {
               ExcavatedRock made = boundary ? excavated_rock(weaker, rock, *boundary, report)
                                             : excavated_rock(weaker, rock, false, report);
               boundary = made.boundary;
               return std::get<Tunnel>(std::move(made.tunnel));
             })
      .find();
}

VOUSSOIR_DESIGN_INLINE TunnelSafety<Spatial> factor_of_safety(const AnalysisInput& input,
                                                              const JointedRock<Spatial>& rock,
                                                              const SafetySettings& settings,
                                                              const StageProgress& report) {
  detail::check_safety(input, 3, settings);
  return detail::SafetySearch<Spatial>(
             input, settings, report,
             [&](const AnalysisInput& weaker) {
               return std::get<SpatialTunnel>(excavated_rock(weaker, rock, report).tunnel);
             })
      .find();
}

#endif

}  // namespace voussoir::design
