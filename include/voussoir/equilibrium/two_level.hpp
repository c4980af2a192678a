// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/detail/elastic_corrections.hpp>
#include <voussoir/equilibrium/detail/global_search.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/fire.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/search_tuning.hpp>
#include <voussoir/linear/linear_method.hpp>

namespace voussoir {

/// The default solution procedure: local searches corrected by global elastic solves.
///
///   factor K (all contacts closed and sticking);  u += K^-1 F(u)
///   repeat  local search on the bodies out of balance, all others fixed, history frozen
///           d = K^-1 F(u);  estimate = max|d| / max|u|
///           accept if estimate, out-of-balance force ratios and displacements pass
///           u += d
///   commit slip
///
/// The local search settles slip and openings: a burst of FIRE and, once the estimate is small,
/// anchored Newton steps with the unsymmetric tangent. The elastic solve settles what is
/// long-ranged, and its correction d measures the error of the displacements. The history is frozen
/// during the search, so the answer does not depend on the path the search took.
///
/// d is blind to mechanisms: a key block that detaches has a tiny elastic correction. Hence the
/// test on every block's out-of-balance force ratio. A block that nothing holds runs away under the
/// Newton steps until it passes the displacement limit: the search gives up, and the stage is
/// followed in motion (`MotionTuning`). In a model without shapes such blocks are taken out on the
/// way; where many detach at once `Relaxation` finds out which, and the search starts anew without
/// them.
class TwoLevel {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "TwoLevel";

  struct Params {
    int burst_steps = 60;        ///< FIRE steps in a local search
    int newton_steps = 8;        ///< at most, in a local search
    double newton_below = 3e-3;  ///< error estimate from which on Newton steps are tried [-]
    int rings = 2;               ///< generations of neighbours searched with a body out of balance
    int max_bursts = 14;         ///< local searches without detachment or end before the fallback
    int increments = 5;          ///< of the unloading, where one step finds no end
    int max_restarts = 8;        ///< searches after the first, without what is detached
    LinearSettings linear{};     ///< of the elastic solves
    Fire::Params fire{};
    Relaxation::Params fallback{};
    LocalSearchTuning local{};
    CorrectionTuning correction{};
    DetachmentTuning detachment{};
    RestartTuning restart{};
    MotionTuning motion{};  ///< of a stage in which rock fails
  };
  TwoLevel() = default;
  /// @throws InvalidInput  a parameter out of range
  explicit TwoLevel(const Params& params) : params_(params), fallback_(params.fallback) {
    require(params.burst_steps > 0, "burst_steps", params.burst_steps, "> 0");
    require(params.newton_steps >= 0, "newton_steps", params.newton_steps, ">= 0");
    require(params.newton_below >= 0, "newton_below", params.newton_below, ">= 0");
    require(params.rings >= 0, "rings", params.rings, ">= 0");
    require(params.max_bursts > 0, "max_bursts", params.max_bursts, "> 0");
    require(params.increments > 0, "increments", params.increments, "> 0");
    require(params.max_restarts >= 0, "max_restarts", params.max_restarts, ">= 0");
    params.fire.check();
    params.local.check();
    params.correction.check();
    params.detachment.check();
    params.restart.check();
    params.motion.check();
  }

  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const;

 private:
  /// One search; without an end where something falls. Where none is found though nothing falls,
  /// the unloading is followed in increments: the elastic start of one large step breaks and opens
  /// joints that a gradual unloading spares. Most happens when little traction is left: the
  /// increments shrink with it.
  template <class System>
  [[nodiscard]] detail::SearchEnd search_once(System& system, const SearchContext& context,
                                              const System& start,
                                              detail::ElasticCorrections<System>& elastic,
                                              EquilibriumReport& report) const {
    const double from = system.wall_fraction, to = context.wall_fraction;
    const std::vector<int> fallen_before = report.fallen;
    const double measure_before = report.fallen_measure;
    const auto run = [&](double wall_fraction) {
      SearchContext part = context;
      part.wall_fraction = wall_fraction;
      return detail::GlobalSearch<System>(system, effort(), part, elastic, report)
          .run(detail::AtAFall::gives_up);
    };
    if (run(to) == detail::SearchEnd::decided) return detail::SearchEnd::decided;
    const double limit = context.acceptance.displacement_limit;
    if (from == to || params_.increments == 1 ||
        !(system.largest_translation(system.displacement) <= limit))
      return detail::SearchEnd::open;
    system = System(start);  // moved: less code than an assignment of every part
    report.fallen = fallen_before;
    report.fallen_measure = measure_before;
    for (int k = 1; k <= params_.increments; ++k) {
      report.verdict = Verdict::undecided;
      if (run(end_of_increment(k, from, to)) == detail::SearchEnd::open)
        return detail::SearchEnd::open;
      if (report.verdict != Verdict::stable) break;
    }
    return detail::SearchEnd::decided;
  }
  [[nodiscard]] double end_of_increment(int k, double from, double to) const {
    return k == params_.increments
               ? to
               : to + (from - to) * std::pow(params_.restart.increment_ratio, k);
  }

  /// The same in increments, with the fallback where one has no end; what detaches is taken out.
  template <class System>
  [[nodiscard]] detail::SearchEnd search_on(System& system, const SearchContext& context,
                                            detail::ElasticCorrections<System>& elastic,
                                            EquilibriumReport& report) const {
    const double from = system.wall_fraction, to = context.wall_fraction;
    SearchContext part = context;
    for (int k = from == to ? params_.increments : 1; k <= params_.increments; ++k) {
      part.wall_fraction = end_of_increment(k, from, to);
      report.verdict = Verdict::undecided;
      (void)search_anew(system, part, elastic, report);
      if (report.verdict != Verdict::stable) break;
    }
    return detail::SearchEnd::decided;
  }

  /// Searches until one is decided, without what detaches meanwhile.
  template <class System>
  [[nodiscard]] detail::SearchEnd search_anew(System& system, const SearchContext& context,
                                              detail::ElasticCorrections<System>& elastic,
                                              EquilibriumReport& report) const {
    const Acceptance& accept = context.acceptance;
    const std::size_t fallen_before = report.fallen.size();
    const System start(system);  // where a search without the detached blocks begins
    double follow_to = std::max(params_.restart.follow_to, accept.unbalance_over_weight);
    for (int attempt = 0; attempt <= params_.max_restarts; ++attempt) {
      detail::GlobalSearch<System> search(system, effort(), context, elastic, report);
      if (search.run(detail::AtAFall::goes_on) == detail::SearchEnd::decided) break;
      const EquilibriumReport fall = follow(system, context, follow_to, report);
      if (detail::has_collapsed<System::dim>(report, context)) break;
      if (fall.verdict == Verdict::undecided) {
        report.reason = fall.stopped ? fall.reason
                                     : "detached blocks were followed without end: " + fall.reason;
        break;
      }
      if (attempt == params_.max_restarts) break;
      if (!fall.fallen.empty()) {
        system = System(start);  // moved: less code than an assignment of every part
        detail::remove_with_loose(
            system, {report.fallen.begin() + static_cast<std::ptrdiff_t>(fallen_before),
                     report.fallen.end()});
        continue;
      }
      // Nothing detached: the fallback may have found the state; or the search goes on from the
      // slip that it has committed.
      if (detail::GlobalSearch<System>(system, effort(), context, elastic, report).accepts_start())
        break;
      if (attempt > 0 && follow_to <= accept.unbalance_over_weight) {
        report.reason = "neither an equilibrium nor detached blocks were found";
        break;
      }
      // One that creeps to its rest is followed more closely.
      follow_to = std::max(params_.restart.follow_closer * follow_to, accept.unbalance_over_weight);
    }
    if (report.verdict == Verdict::undecided && report.reason.empty())
      report.reason = message({"no equilibrium in ", params_.max_restarts + 1,
                               " searches, detached blocks taken out in between"});
    return detail::SearchEnd::decided;
  }

  /// Lets the fallback follow what falls, and enters it in the report.
  /// @param follow_to  out-of-balance force ratio of the others at which it ends [-]
  template <class System>
  EquilibriumReport follow(System& system, const SearchContext& context, double follow_to,
                           EquilibriumReport& report) const {
    SearchContext follow = context;
    follow.acceptance.unbalance_over_weight = follow_to;
    follow.acceptance.collapse_measure =
        context.acceptance.collapse_measure - report.fallen_measure / context.open_length;
    EquilibriumReport fall;
    fallback_.follow(system, follow, fall);
    report.steps += fall.steps;
    report.fallen.insert(report.fallen.end(), fall.fallen.begin(), fall.fallen.end());
    report.fallen_measure += fall.fallen_measure;
    report.largest_displacement = fall.largest_displacement;
    report.unbalance_over_weight = fall.unbalance_over_weight;
    report.stopped = fall.stopped;
    report.error_estimate = std::numeric_limits<double>::quiet_NaN();
    return fall;
  }

  [[nodiscard]] detail::SearchEffort effort() const {
    return {{params_.burst_steps, params_.newton_steps, params_.newton_below, params_.rings},
            params_.max_bursts,
            params_.linear,
            params_.fire,
            params_.local,
            params_.correction,
            params_.restart};
  }

  Params params_;
  Relaxation fallback_;
};

template <class System>
EquilibriumReport TwoLevel::find(System& system, const SearchContext& context) const {
  EquilibriumReport report;
  detail::ElasticCorrections<System> elastic;
  const auto solve = [&](Eigen::VectorXd& f, const SolveTolerance& tolerance) {
    detail::prepare_without_free_bodies(system, context, report, [&] {
      elastic.prepare(system, params_.fire, params_.linear, context.progress, report);
    });
    return elastic.solve(f, tolerance, context.progress, report);
  };
  const auto search = [&](const SearchContext& stage, detail::AtAFall at_a_fall,
                          const System& start, EquilibriumReport& to) {
    return at_a_fall == detail::AtAFall::gives_up ? search_once(system, stage, start, elastic, to)
                                                  : search_on(system, stage, elastic, to);
  };
  detail::until_stopped(report, [&] {
    detail::carry_out_stage(system, context, solve, params_.detachment, &params_.motion, search,
                            report);
  });
  report.linear = elastic.report();
  report.broken_bolts = system.supports.broken_count();
  return report;
}

}  // namespace voussoir
