// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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
/// during the search, so the answer does not depend on the path the search took: on increments and
/// the fallback only, where blocks detach.
///
/// d is blind to mechanisms: a key block that detaches has a tiny elastic correction. Hence the
/// test on every block's out-of-balance force ratio. A block that nothing holds runs away under the
/// Newton steps until it passes the displacement limit, is removed, and the search goes on without
/// it. Where many blocks detach at once `Relaxation` finds out which, and the search starts anew
/// without them. Detached blocks are judged in increments of the unloading: in a single one
/// marginal blocks are lost that stay.
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
    int increments = 5;          ///< of the unloading, where blocks detach in one step
    int max_restarts = 8;        ///< searches after the first, without what is detached
    LinearSettings linear{};     ///< of the elastic solves
    Fire::Params fire{};
    Relaxation::Params fallback{};
    LocalSearchTuning local{};
    CorrectionTuning correction{};
    DetachmentTuning detachment{};
    RestartTuning restart{};
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
  }

  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const;

 private:
  template <class System>
  void find_by_stages(System& system, const SearchContext& context,
                      detail::ElasticCorrections<System>& elastic, EquilibriumReport& whole) const;

  template <class System>
  [[nodiscard]] EquilibriumReport find_in_one_step(
      System& system, const SearchContext& context, bool give_up_at_a_fall,
      detail::ElasticCorrections<System>& elastic) const {
    EquilibriumReport report;
    detail::until_stopped(
        report, [&] { search_anew(system, context, give_up_at_a_fall, elastic, report); });
    report.broken_bolts = system.supports.broken_count();
    return report;
  }

  /// Searches until one is decided, without what detaches meanwhile.
  template <class System>
  void search_anew(System& system, const SearchContext& context, bool give_up_at_a_fall,
                   detail::ElasticCorrections<System>& elastic, EquilibriumReport& report) const {
    const Acceptance& accept = context.acceptance;
    // Where a search without the detached blocks begins. One that gives up has no use for it.
    std::optional<System> start;
    if (!give_up_at_a_fall) start.emplace(system);
    double follow_to = std::max(params_.restart.follow_to, accept.unbalance_over_weight);
    for (int attempt = 0; attempt <= params_.max_restarts; ++attempt) {
      detail::GlobalSearch<System> search(system, effort(), context, elastic, report);
      if (search.run(give_up_at_a_fall) != detail::SearchEnd::open) break;
      if (give_up_at_a_fall) return;  // without a reason: not decided
      const EquilibriumReport fall = follow(system, context, follow_to, report);
      if (detail::has_collapsed<System::dim>(report, context)) break;
      if (fall.verdict == Verdict::undecided) {
        report.reason = fall.stopped ? fall.reason
                                     : "detached blocks were followed without end: " + fall.reason;
        break;
      }
      if (attempt == params_.max_restarts) break;
      if (!fall.fallen.empty()) {
        system = System(*start);  // moved: less code than an assignment of every part
        detail::remove_with_loose(system, report.fallen);
        continue;
      }
      // Nothing detached: the search goes on from the slip that the fallback has committed.
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

  /// Adds what an increment did; its state replaces that of the one before.
  static void add(EquilibriumReport& whole, const EquilibriumReport& part) {
    EquilibriumReport sum = part;
    sum.steps += whole.steps;
    sum.elastic_solves += whole.elastic_solves;
    sum.factorisations += whole.factorisations;
    sum.contact_updates.add(whole.contact_updates);
    sum.fallen.insert(sum.fallen.begin(), whole.fallen.begin(), whole.fallen.end());
    sum.fallen_measure += whole.fallen_measure;
    whole = sum;
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
  EquilibriumReport whole;
  detail::ElasticCorrections<System> elastic;
  detail::until_stopped(whole, [&] { find_by_stages(system, context, elastic, whole); });
  whole.linear = elastic.report();
  return whole;
}

template <class System>
void TwoLevel::find_by_stages(System& system, const SearchContext& context,
                              detail::ElasticCorrections<System>& elastic,
                              EquilibriumReport& whole) const {
  detail::drop(system, {}, context, whole);
  detail::prepare_without_free_bodies(system, context, whole, [&] {
    elastic.prepare(system, params_.fire, params_.linear, context.progress, whole);
  });
  const auto solve = [&](Eigen::VectorXd& f, const SolveTolerance& tolerance) {
    return elastic.solve(f, tolerance, context.progress, whole);
  };
  if (detail::has_collapsed<System::dim>(whole, context)) return;
  if (detail::moves_too_far(system, context, solve, whole, params_.detachment)) return;
  const auto part_of_stage = [&](double wall_fraction) {
    SearchContext part = context;
    part.wall_fraction = wall_fraction;
    part.acceptance.collapse_measure -= whole.fallen_measure / context.open_length;
    return part;
  };
  const double from = system.wall_fraction, to = context.wall_fraction;
  const bool unloading = from != to && params_.increments > 1;
  std::optional<System> start;
  if (unloading) start.emplace(system);
  add(whole, find_in_one_step(system, part_of_stage(to), unloading, elastic));
  if (unloading && whole.reason.empty()) {
    // Something detached, or no end was found. The elastic start of one large step opens joints
    // that a gradual unloading keeps closed, so only what detaches then counts. Most detaches when
    // little traction is left: the increments shrink with it.
    system = std::move(*start);
    for (int k = 1; k <= params_.increments; ++k) {
      const bool last = k == params_.increments;
      const double left =
          last ? to : to + (from - to) * std::pow(params_.restart.increment_ratio, k);
      add(whole, find_in_one_step(system, part_of_stage(left), false, elastic));
      if (whole.verdict != Verdict::stable) break;
    }
  }
  // The search that ended it speaks of its own blocks; the verdict of all of them.
  if (whole.verdict == Verdict::collapsing)
    (void)detail::has_collapsed<System::dim>(whole, context);
  if (whole.verdict == Verdict::stable && !whole.fallen.empty())
    whole.reason = "within all limits after blocks had detached";
}

}  // namespace voussoir
