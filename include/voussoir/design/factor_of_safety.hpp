// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/bodies.hpp>

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

/// A joint whose strength is divided: tan(phi), c and sigma_t, at the peak and what is left of
/// them; stiffness stays, and dilation where it is not more than the friction that is left.
/// @param factor  > 0
/// @throws InvalidInput  of a law whose strength is no sum of friction and cohesion
[[nodiscard]] VOUSSOIR_DESIGN_INLINE AnyJoint weakened(const AnyJoint& joint, double factor);

/// What comes off, until a tunnel is said to fall.
enum class SafetyLimit {
  collapse,  ///< it does not come to rest, or loses more than `collapse_measure_of`
  rockfall   ///< any rock or lining comes off
};

struct TunnelSafety {
  FactorBracket bracket;
  TunnelResult standing, falling;  ///< of its ends, where there are such
};

/// The factor of safety of a tunnel: by how much the strength of its joints may be divided. Each
/// trial is the whole analysis from the in-situ state on, decided by the verdict of a run; supports
/// keep their strength. What is at rest lacks no more of its weight than a tenth of the width of
/// the bracket, for a block that slides at 30 degrees and lacks 1 % of its weight has 2 % too much.
/// @param rock     not excavated
/// @param report   asked now and then whether to go on; the stage is the factor
/// @throws InvalidInput  see `weakened`, `bracket_factor`, `check_input`; Stopped
/// @cost  some 10 runs
[[nodiscard]] VOUSSOIR_DESIGN_INLINE TunnelSafety
factor_of_safety(const AnalysisInput& input, const JointedRock<Planar>& rock,
                 SafetyLimit limit = SafetyLimit::collapse, const FactorSearch& search = {},
                 const StageProgress& report = {});

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

[[nodiscard]] inline double weaker_angle(double angle, double factor) {
  return elementary::angle_of(elementary::tangent(angle), factor);
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE AnyJoint weakened(const AnyJoint& joint, double factor) {
  require(factor > 0 && std::isfinite(factor), "factor of strength", factor, "> 0");
  return joint.visit([&](const auto& law) -> AnyJoint {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (std::is_same_v<Law, CoulombJoint>) {
      return CoulombJoint({law.joint_normal_stiffness(), law.joint_shear_stiffness(),
                           elementary::angle_of(law.friction_coefficient(), factor)},
                          any_units);
    } else if constexpr (std::is_same_v<Law, MohrCoulombJoint>) {
      MohrCoulombJoint::Params weaker = law.params();
      weaker.friction_angle = detail::weaker_angle(weaker.friction_angle, factor);
      weaker.residual_friction_angle = std::min(
          detail::weaker_angle(weaker.residual_friction_angle, factor), weaker.friction_angle);
      weaker.cohesion /= factor;
      weaker.residual_cohesion = std::min(weaker.residual_cohesion / factor, weaker.cohesion);
      weaker.tensile_strength /= factor;
      if (weaker.friction_angle > 0)  // c / tan(phi) is what it was, but for a rounding
        weaker.tensile_strength = std::min(
            weaker.tensile_strength, weaker.cohesion / elementary::tangent(weaker.friction_angle));
      weaker.dilation_angle = std::min(weaker.dilation_angle, weaker.residual_friction_angle);
      return MohrCoulombJoint(weaker, any_units);
    } else {
      throw InvalidInput(message({"strength reduction: the strength of ", law.name,
                                  " is no sum of friction and cohesion; must be CoulombJoint or "
                                  "MohrCoulombJoint"}));
    }
  });
}

VOUSSOIR_DESIGN_INLINE TunnelSafety factor_of_safety(const AnalysisInput& input,
                                                     const JointedRock<Planar>& rock,
                                                     SafetyLimit limit, const FactorSearch& search,
                                                     const StageProgress& report) {
  check_input(input, 2);
  check_bolts(input, supports_of(input));
  (void)laws_of(input);  // refused before anything is computed
  // What the sides meet does not hang on strength: it is chosen once.
  const ExcavatedRock first = excavated_rock(input, rock, false, report);
  TunnelSafety safety;
  const auto trial = [&](double factor) {
    AnalysisInput weaker = input;
    weaker.run.out_of_balance = std::min(input.run.out_of_balance, 0.1 * search.width);
    weaker.joint = weakened(*input.joint, factor);
    for (JointSetInput& set : weaker.joint_sets)
      if (set.law) set.law = weakened(*set.law, factor);
    const ExcavatedRock ready =
        factor == 1 ? first : excavated_rock(weaker, rock, first.boundary, report);
    StageProgress told;
    if (report)
      told = [&](const std::string&, double fraction) {
        return report(message({"factor ", factor}), fraction);
      };
    TunnelResult result = supported_tunnel(weaker, ready, supports_of(input), told);
    const bool stands =
        limit == SafetyLimit::rockfall ? result.is_whole() : result.verdict == Verdict::stable;
    const TrialOutcome outcome = stands ? TrialOutcome::stands
                                 : result.failed || result.verdict == Verdict::undecided
                                     ? TrialOutcome::undecided
                                     : TrialOutcome::falls;
    (stands ? safety.standing : safety.falling) = std::move(result);
    return outcome;
  };
  safety.bracket = bracket_factor(trial, search);
  return safety;
}

#endif

}  // namespace voussoir::design
