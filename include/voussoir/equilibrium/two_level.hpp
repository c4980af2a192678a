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
#include <voussoir/equilibrium/active_set.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/detail/elastic_corrections.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/fire.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/update_when_due.hpp>
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
  }

  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const;

 private:
  enum class Outcome { decided, open };

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
    // The fallback mostly has to tell what detaches: blocks at a tenth of their weight do not. One
    // that creeps to its rest is followed more closely.
    double follow_to = std::max(0.1, accept.unbalance_over_weight);
    for (int attempt = 0; attempt <= params_.max_restarts; ++attempt) {
      if (search(system, context, give_up_at_a_fall, elastic, report) != Outcome::open) break;
      if (give_up_at_a_fall) return;  // without a reason: not decided
      SearchContext follow = context;
      follow.acceptance.unbalance_over_weight = follow_to;
      follow.acceptance.collapse_measure =
          accept.collapse_measure - report.fallen_measure / context.open_length;
      EquilibriumReport fall;
      fallback_.follow(system, follow, fall);
      report.steps += fall.steps;
      report.fallen.insert(report.fallen.end(), fall.fallen.begin(), fall.fallen.end());
      report.fallen_measure += fall.fallen_measure;
      report.largest_displacement = fall.largest_displacement;
      report.unbalance_over_weight = fall.unbalance_over_weight;
      report.stopped = fall.stopped;
      report.error_estimate = std::numeric_limits<double>::quiet_NaN();
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
      follow_to = std::max(0.3 * follow_to, accept.unbalance_over_weight);
    }
    if (report.verdict == Verdict::undecided && report.reason.empty())
      report.reason = message({"no equilibrium in ", params_.max_restarts + 1,
                               " searches, detached blocks taken out in between"});
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

  /// One search with the present bodies; `decided` with a verdict or a reason to stop.
  template <class System>
  Outcome search(System& system, const SearchContext& context, bool give_up_at_a_fall,
                 detail::ElasticCorrections<System>& elastic, EquilibriumReport& report) const {
    const Acceptance& accept = context.acceptance;
    system.wall_fraction = context.wall_fraction;
    elastic.prepare(system, params_.fire, params_.linear, context.progress, report);
    Eigen::VectorXd& u = system.displacement;
    Eigen::VectorXd f, d, trial;
    double inexact = 0;  // of the last correction
    const auto correction = [&] {
      system.forces(u, f);
      ++report.steps;
      d = f;
      inexact = elastic.solve(d, detail::tolerance_of_correction(system, accept), context.progress,
                              report);
    };
    correction();
    u += d;
    Eigen::VectorXd left = elastic.residual();  // of elastic solves: for the next to take
    double estimate = 1;
    Eigen::VectorXd reach = constants(system.body_count(), 0.2 * longest_move(accept));
    // More often than a block can need on its way to the displacement limit is no progress.
    int may_find = 4 + static_cast<int>(8 * accept.displacement_limit / accept.refind_limit);
    for (int burst = 1; burst <= params_.max_bursts; ++burst) {
      settle_locally(system, elastic.fire(), context, estimate, left, reach, f, report);
      // A maximum would not tell: it passes over what is not a number.
      if (!is_finite(u))
        throw NumericalFault(
            message({"two-level search: displacements are not finite in search ", burst}));
      const bool falls = system.largest_translation(u) > accept.displacement_limit;
      if (falls && give_up_at_a_fall) return Outcome::open;
      if (falls)
        detail::drop(system, detail::fallen_bodies(system, accept.displacement_limit), context,
                     report);
      const bool found = detail::find_when_due(system, context, report);
      if (found) detail::drop(system, {}, context, report);
      if (found && --may_find < 0) return Outcome::open;
      if (falls || found) {
        if (detail::has_collapsed<System::dim>(report, context)) {
          report.largest_displacement = system.largest_translation(u);
          report.error_estimate = report.unbalance_over_weight =
              std::numeric_limits<double>::quiet_NaN();  // it is on its way down
          return Outcome::decided;
        }
        elastic.prepare(system, params_.fire, params_.linear, context.progress, report);
        burst = std::min(burst, params_.max_bursts / 2);  // falling is progress
      }
      correction();
      report.largest_displacement = system.largest_translation(u);
      report.error_estimate = estimate = system.relative_correction(d, u, inexact);
      report.unbalance_over_weight = system.unbalance_over_weight(f);
      if (!is_finite(d))
        throw NumericalFault(
            message({"two-level search: the elastic correction is not finite in search ", burst}));
      if (report.error_estimate < accept.error_estimate &&
          report.unbalance_over_weight < accept.unbalance_over_weight) {
        // A bolt broke, a joint failed, or contacts are elsewhere: look again.
        if (system.commit() > 0 || detail::find_when_due(system, context, report, true)) {
          elastic.prepare(system, params_.fire, params_.linear, context.progress, report);
          continue;
        }
        report.verdict = Verdict::stable;
        report.reason =
            "error estimate, out-of-balance force ratio and displacements are within their limits";
        return Outcome::decided;
      }
      detail::ask_to_go_on(context, progress_of(report, accept, burst));
      correct(system, u, d, elastic.residual(), f, trial, left, report);
    }
    return Outcome::open;
  }

  /// Nobody goes further than half of this at a time.
  [[nodiscard]] static double longest_move(const Acceptance& accept) {
    return std::min(accept.displacement_limit, accept.refind_limit);
  }

  /// Settles the bodies that are out of balance, all others fixed.
  ///
  /// Newton steps are damped as Levenberg and Marquardt do, but body by body: `reach` is how far
  /// one that nothing holds may move in a step. It grows while steps succeed; when one fails it
  /// shrinks for the bodies that ran into something, and the others fall on.
  template <class System>
  void settle_locally(System& system, Fire& fire, const SearchContext& context, double estimate,
                      const Eigen::VectorXd& left, Eigen::VectorXd& reach, Eigen::VectorXd& f,
                      EquilibriumReport& report) const {
    constexpr int dim = System::dim, dof = System::dof;
    const Acceptance& accept = context.acceptance;
    StopCheck stop(context.progress, 1);
    Eigen::VectorXd& u = system.displacement;
    system.forces(u, f);
    ++report.steps;
    ActiveSet<System> active(system, f, left, 0.1 * accept.unbalance_over_weight, params_.rings);
    const std::vector<int>& bodies = active.bodies();
    fire.rest();
    for (int step = 0; step < params_.burst_steps; ++step) {
      stop();
      fire.template advance<dof>(bodies, f, u);
      active.forces(u, f);
      ++report.steps;
    }
    if (!(estimate < params_.newton_below)) return;
    double now = active.squared_unbalance(f);
    Eigen::VectorXd before, worse;
    for (int k = 0; k < params_.newton_steps; ++k) {
      if (active.worst_unbalance(f) < 0.1 * accept.unbalance_over_weight) break;
      const Eigen::VectorXd step = active.newton_step(u, f, reach, context.progress);
      before = u;
      double share = is_finite(step) ? 1.0 : 0.0, next = now;
      for (; share > 0.2; share *= 0.5) {
        stop();
        for (std::size_t b = 0; b < bodies.size(); ++b) {
          Fixed<dof, 1> move = share * part<dof>(step, dof * static_cast<Eigen::Index>(b));
          const double length = part<dim>(move, 0).norm();
          if (length > 0.5 * longest_move(accept))
            move = move * (0.5 * longest_move(accept) / length);
          set_part<dof>(u, dof * bodies[b], part<dof>(before, dof * bodies[b]) + move);
        }
        active.forces(u, f);
        ++report.steps;
        next = active.squared_unbalance(f);
        if (next <= 1.02 * now) break;
      }
      if (share < 0.2) {
        worse = f;
        u = before;
        active.forces(u, f);
        hold_back(system, bodies, f, worse, reach);
        continue;
      }
      now = next;
      if (share == 1.0)
        for (const int b : bodies) reach[b] = std::min(4 * reach[b], longest_move(accept));
      if (active.largest_translation(u) > accept.displacement_limit ||
          detail::is_due(system, accept))
        break;
    }
  }

  /// After a step that failed: shortens the reach of the bodies whose balance it has spoilt, or of
  /// all if none stands out. `f` forces before the step, `worse` after it.
  template <class System>
  static void hold_back(const System& system, const std::vector<int>& bodies,
                        const Eigen::VectorXd& f, const Eigen::VectorXd& worse,
                        Eigen::VectorXd& reach) {
    constexpr double shortest = 1e-6;
    const double lightest = system.lightest_weight();
    bool found = false;
    for (const bool everybody : {false, true}) {
      if (found) return;
      for (const int b : bodies) {
        if (!everybody && !(system.unbalance_of(worse, b, lightest) >
                            2 * system.unbalance_of(f, b, lightest) + 0.3))
          continue;
        reach[b] = std::max(0.1 * reach[b], shortest);
        found = true;
      }
    }
  }

  /// Adds the elastic correction, halved while it would make the residual four times larger.
  /// @param residual  what the solve for it has left
  /// @param left      what of it is for the next solve; what a shortened correction has not taken
  ///                  is not, for that may be slip
  template <class System>
  static void correct(System& system, Eigen::VectorXd& u, const Eigen::VectorXd& d,
                      const Eigen::VectorXd& residual, Eigen::VectorXd& f, Eigen::VectorXd& trial,
                      Eigen::VectorXd& left, EquilibriumReport& report) {
    const double before = f.squaredNorm();
    left = zeros(f.size());
    for (double part = 1; part > 0.2; part *= 0.5) {
      set_to_sum(trial, u, part, d);
      system.forces(trial, f);
      ++report.steps;
      if (f.squaredNorm() <= 16 * before) {
        u = trial;
        set_to_sum(left, left, part, residual);
        return;
      }
    }
  }

  /// How far the estimate has come down, on a logarithmic scale; never quite there.
  [[nodiscard]] double progress_of(const EquilibriumReport& report, const Acceptance& accept,
                                   int burst) const {
    const double left = std::log(std::max(report.error_estimate / accept.error_estimate, 1.0)) /
                        std::log(1.0 / accept.error_estimate);
    const double spent = static_cast<double>(burst) / params_.max_bursts;
    return std::clamp(std::max(1 - left, spent), 0.0, 0.99);
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
  elastic.prepare(system, params_.fire, params_.linear, context.progress, whole);
  const auto solve = [&](Eigen::VectorXd& f, const SolveTolerance& tolerance) {
    return elastic.solve(f, tolerance, context.progress, whole);
  };
  if (detail::has_collapsed<System::dim>(whole, context)) return;
  if (detail::moves_too_far(system, context, solve, whole)) return;
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
      const double left = last ? to : to + (from - to) * std::pow(0.4, k);
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
