// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
/// during the search, so the answer does not depend on the path the search took. On the path of the
/// rock it does depend: where much slips, the unloading is followed in increments (`PathTuning`).
/// What is committed on the way is not in the error estimate, which is of the last search.
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
    int increments = 16;         ///< of the unloading, where one step is not enough
    int max_restarts = 8;        ///< searches after the first, without what is detached
    LinearSettings linear{};     ///< of the elastic solves
    Fire::Params fire{};
    Relaxation::Params fallback{};
    LocalSearchTuning local{};
    CorrectionTuning correction{};
    DetachmentTuning detachment{};
    RestartTuning restart{};
    PathTuning path{};
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
    require(params.increments > 0 && params.increments <= 1'000'000, "increments",
            params.increments, "1 to 1000000");
    require(params.max_restarts >= 0, "max_restarts", params.max_restarts, ">= 0");
    params.fire.check();
    params.local.check();
    params.correction.check();
    params.detachment.check();
    params.restart.check();
    params.path.check();
    params.motion.check();
  }

  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const;

 private:
  /// One search; without an end where something falls. Where much of the movement is slip and
  /// opening, or one step finds no end though nothing falls, the unloading is followed in
  /// increments: friction remembers the path, and the elastic start of one large step breaks and
  /// opens joints that a gradual unloading spares. Where increments find no end though nothing
  /// falls, the equilibrium that one step found is kept.
  template <class System>
  [[nodiscard]] detail::SearchEnd search_once(System& system, const SearchContext& context,
                                              const System& start,
                                              detail::ElasticCorrections<System>& elastic,
                                              EquilibriumReport& report) const {
    const bool is_divisible =
        system.wall_fraction != context.wall_fraction && params_.increments > 1;
    const auto falls = [&] {
      return !(system.largest_translation(system.displacement) <=
               context.acceptance.displacement_limit);
    };
    const EquilibriumReport before = report;
    detail::GlobalSearch<System> one_step(system, effort(), context, elastic, report);
    const detail::SearchEnd end = one_step.run(detail::AtAFall::gives_up_early);
    const bool is_open = end == detail::SearchEnd::open;
    if (!is_divisible || (is_open ? falls() || one_step.moves_far()
                                  : report.verdict != Verdict::stable ||
                                        one_step.unforeseen_share() <= params_.path.one_step_share))
      return end;
    const System found(system);
    const EquilibriumReport by_one_step = report;
    go_back(system, report, start, before);
    if (follow_unloading(system, context, !is_open, elastic, report) == detail::SearchEnd::decided)
      return detail::SearchEnd::decided;
    if (is_open || falls()) return detail::SearchEnd::open;
    go_back(system, report, found, by_one_step);
    report.reason += "; in one step: increments of the unloading found no end";
    return detail::SearchEnd::decided;
  }

  /// To an earlier state and its report; what was spent since stays spent.
  template <class System>
  static void go_back(System& system, EquilibriumReport& report, const System& state,
                      EquilibriumReport then) {
    then.steps = report.steps;
    then.elastic_solves = report.elastic_solves;
    then.factorisations = report.factorisations;
    report = std::move(then);
    system = System(state);  // moved: less code than an assignment of every part
  }

  /// The unloading in increments. On the way states are accepted loosely, and a search begins with
  /// the movement of the increment before. Where the movement turns, joints begin to slip, open or
  /// stick: the increment is halved there, as an integrator halves its step. A turn that gets no
  /// less with the length is a jump, which no increment is short enough for; one within the error
  /// that is accepted on the way is none.
  /// @param may_step_over  where the shortest finds no end though nothing falls, longer and longer
  ///                       ones step over that; else the search ends after a few without an end
  template <class System>
  [[nodiscard]] detail::SearchEnd follow_unloading(System& system, const SearchContext& context,
                                                   bool may_step_over,
                                                   detail::ElasticCorrections<System>& elastic,
                                                   EquilibriumReport& report) const {
    const PathTuning& path = params_.path;
    const double from = system.wall_fraction, to = context.wall_fraction;
    const double limit = context.acceptance.displacement_limit;
    // In parts of the unloading as long as the shortest increment.
    const int longest = 1 << path.halvings, all = longest * params_.increments;
    Eigen::VectorXd movement;  // in the increment before
    bool steps_over = false;   // what the shortest increment has not ended in
    int open_left = path.open;
    double turn_before = std::numeric_limits<double>::infinity();  // of twice the length, from here
    for (int done = 0, parts = longest, parts_before = longest; done < all;) {
      parts = std::min(parts, all - done);
      const bool is_last = done + parts == all;
      SearchContext part = context;
      part.wall_fraction = is_last ? to : from + (to - from) * (done + parts) / all;
      detail::SearchEffort spent = effort();
      if (!is_last) {
        part.acceptance.error_estimate *= path.looseness;
        part.acceptance.unbalance_over_weight *= path.looseness;
        spent.local.burst_steps = std::min(path.burst_steps, params_.burst_steps);
      }
      const System start(system);
      const EquilibriumReport before = report;
      report.verdict = Verdict::undecided;
      detail::GlobalSearch<System> search(system, spent, part, elastic, report);
      const Eigen::VectorXd foreseen = movement * (static_cast<double>(parts) / parts_before);
      const bool is_open =
          search.run(detail::AtAFall::gives_up, foreseen) == detail::SearchEnd::open;
      if (is_open && !(system.largest_translation(system.displacement) <= limit))
        return detail::SearchEnd::open;  // something falls
      const double turn =
          search.unforeseen_share(is_last ? 0
                                          : part.acceptance.error_estimate *
                                                system.largest_translation(system.displacement));
      const bool may_be_shorter = parts > 1 && !steps_over;
      const bool jumps = turn > path.jump * turn_before;
      if (is_open || (turn > path.turn && !jumps && may_be_shorter)) {
        if (is_open && !may_step_over && --open_left < 0) return detail::SearchEnd::open;
        if (!may_be_shorter && is_last) return detail::SearchEnd::open;
        turn_before = is_open ? std::numeric_limits<double>::infinity() : turn;
        go_back(system, report, start, before);
        steps_over = !may_be_shorter;
        parts = steps_over ? 2 * parts : parts / 2;
        continue;
      }
      steps_over = false;
      turn_before = std::numeric_limits<double>::infinity();
      if (report.verdict != Verdict::stable) break;
      done += parts;
      parts_before = parts;
      set_to_sum(movement, system.displacement, -1, start.displacement);
      if (report.fallen.size() != before.fallen.size()) movement.resize(0);
      parts = std::min(turn < 0.25 * path.turn ? 2 * parts : parts, longest);
    }
    return detail::SearchEnd::decided;
  }

  /// A search that takes out what detaches on its way: in increments, with the fallback where one
  /// has no end.
  template <class System>
  [[nodiscard]] detail::SearchEnd search_on(System& system, const SearchContext& context,
                                            detail::ElasticCorrections<System>& elastic,
                                            EquilibriumReport& report) const {
    const double from = system.wall_fraction, to = context.wall_fraction;
    SearchContext part = context;
    const int increments = params_.increments;
    for (int k = from == to ? increments : 1; k <= increments; ++k) {
      part.wall_fraction = k == increments ? to : from + (to - from) * k / increments;
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
