// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/detail/elastic_corrections.hpp>
#include <voussoir/equilibrium/detail/local_search.hpp>
#include <voussoir/equilibrium/detail/search_or_follow.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/fire.hpp>
#include <voussoir/equilibrium/search_tuning.hpp>
#include <voussoir/equilibrium/update_when_due.hpp>
#include <voussoir/linear/linear_method.hpp>

namespace voussoir::detail {

/// What a search may spend, and how it goes about it.
struct SearchEffort {
  LocalEffort local;
  int max_bursts;  ///< local searches without detachment or end
  LinearSettings linear;
  Fire::Params fire;
  LocalSearchTuning local_tuning;
  CorrectionTuning correction;
  RestartTuning restart;
};

/// One search with the present bodies: local searches and elastic corrections in turn, see
/// `TwoLevel`. What detaches on the way is taken out.
template <class System>
class GlobalSearch {
 public:
  GlobalSearch(System& system, const SearchEffort& effort, const SearchContext& context,
               ElasticCorrections<System>& elastic, EquilibriumReport& report)
      : system_(system),
        effort_(effort),
        context_(context),
        elastic_(elastic),
        report_(report),
        local_(system, effort.local, effort_.local_tuning, context) {
    const Acceptance& accept = context.acceptance;
    may_find_ = effort.restart.updates +
                static_cast<int>(effort.restart.updates_on_the_way * accept.displacement_limit /
                                 accept.contact_update_limit);
  }

  /// @param predicted  movement to begin with; empty: an elastic step
  /// @throws NumericalFault, Stopped, FreeBody, NotEnoughMemory
  SearchEnd run(AtAFall at_a_fall, const Eigen::VectorXd& predicted = {}) {
    system_.wall_fraction = context_.wall_fraction;
    prepare();
    Eigen::VectorXd& u = system_.displacement;
    start_ = u;
    if (predicted.size() == u.size()) {
      first_ = predicted;
      left_ = zeros(u.size());
    } else {
      find_correction();
      first_ = d_;
      left_ = elastic_.residual();
    }
    u += first_;
    for (int burst = 1; burst <= effort_.max_bursts; ++burst) {
      local_.settle(elastic_.fire(), estimate_, left_, f_, report_);
      // A maximum would not tell: it passes over what is not a number.
      if (!voussoir::is_finite(u))
        throw NumericalFault(
            message({"two-level search: displacements are not finite in search ", burst}));
      if (at_a_fall != AtAFall::goes_on &&
          system_.largest_translation(u) > context_.acceptance.displacement_limit)
        return SearchEnd::open;
      if (at_a_fall == AtAFall::gives_up_early && largest_move() > context_.seldom_moved) {
        moves_far_ = true;
        return SearchEnd::open;
      }
      const Change change = take_out_and_update();
      if (change == Change::too_often) return SearchEnd::open;
      if (change == Change::collapse) return SearchEnd::decided;
      if (change == Change::some)
        burst = std::min(burst, effort_.max_bursts / 2);  // it is progress
      find_correction();
      judge(burst);
      if (is_accepted()) {
        const int failed = system_.commit();
        if (failed == 0 && rests()) return SearchEnd::decided;
        // A joint fails once, and a bolt breaks once: where that goes from one to the next, every
        // step of it is progress.
        if (failed > 0) {
          prepare();
          burst = std::min(burst, effort_.max_bursts / 2);
        }
        continue;
      }
      ask_to_go_on(context_, progress_of(burst));
      add_correction();
    }
    return SearchEnd::open;
  }

  /// Judges the state as it is, without a search: one that a fallback has brought to rest.
  /// @return  true: accepted, and what has slipped is committed
  bool accepts_start() {
    system_.wall_fraction = context_.wall_fraction;
    prepare();
    find_correction();
    judge(0);
    return is_accepted() && system_.commit() == 0 && rests();
  }

  /// Whether it gave up because a block had moved further than one seldom does.
  [[nodiscard]] bool moves_far() const { return moves_far_; }

  /// Part of the movement that the first step has not foreseen: of an elastic one, slip and
  /// opening; of a movement that was predicted, its turn. Norms of all translations [-].
  /// @param error  of a body's translation: what is unforeseen by less is not known to be [m]
  [[nodiscard]] double unforeseen_share(double error = 0) const {
    constexpr int dof = System::dof;
    double unforeseen = 0, all = 0;
    for (int b = 0; b < system_.body_count(); ++b) {
      const Vec<System::dim> moved =
          part<System::dim>(system_.displacement, dof * b) - part<System::dim>(start_, dof * b);
      const double off = (moved - part<System::dim>(first_, dof * b)).norm();
      if (off > error) unforeseen += (off - error) * (off - error);
      all += moved.squaredNorm();
    }
    return all > 0 ? std::sqrt(unforeseen / all) : 0.0;
  }

 private:
  /// Of a block since the search began [m].
  [[nodiscard]] double largest_move() {
    set_to_sum(trial_, system_.displacement, -1, start_);
    return system_.largest_translation(trial_);
  }

  /// Of bodies and contacts, between a local search and its correction.
  enum class Change { none, some, too_often, collapse };

  void prepare() {
    prepare_without_free_bodies(system_, context_, report_, [this] {
      elastic_.prepare(system_, effort_.fire, effort_.linear, context_.progress, report_);
    });
  }

  /// Forces, and the elastic displacements that they cause.
  void find_correction() {
    system_.forces(system_.displacement, f_);
    ++report_.steps;
    d_ = f_;
    inexact_ = elastic_.solve(
        d_, tolerance_of_correction(system_, context_.acceptance, effort_.correction),
        context_.progress, report_);
    VOUSSOIR_ASSERT(d_.size() == system_.displacement.size(), "a correction is of all bodies");
    VOUSSOIR_ASSERT(inexact_ >= 0, "errors are no less than 0");
  }

  /// Takes out what is beyond the displacement limit, and updates contacts where that is due.
  Change take_out_and_update() {
    const double limit = context_.acceptance.displacement_limit;
    const bool falls = system_.largest_translation(system_.displacement) > limit;
    if (falls) drop(system_, fallen_bodies(system_, limit), context_, report_);
    const bool found = update_when_due(system_, context_, report_);
    if (found) drop(system_, {}, context_, report_);
    if (found && --may_find_ < 0) return Change::too_often;
    if (!falls && !found) return Change::none;
    if (has_collapsed<System::dim>(report_, context_)) {
      report_.largest_displacement = system_.largest_translation(system_.displacement);
      report_.error_estimate = report_.unbalance_over_weight =
          std::numeric_limits<double>::quiet_NaN();  // it is on its way down
      return Change::collapse;
    }
    prepare();
    return Change::some;
  }

  /// Puts into the report how good the state is.
  void judge(int burst) {
    const Eigen::VectorXd& u = system_.displacement;
    report_.largest_displacement = system_.largest_translation(u);
    VOUSSOIR_ASSERT(f_.size() == u.size(), "a force for every displacement");
    report_.error_estimate = estimate_ = system_.relative_correction(d_, u, inexact_);
    report_.unbalance_over_weight = system_.unbalance_over_weight(f_);
    if (!voussoir::is_finite(d_))
      throw NumericalFault(
          message({"two-level search: the elastic correction is not finite in search ", burst}));
  }
  [[nodiscard]] bool is_accepted() const {
    return report_.error_estimate < context_.acceptance.error_estimate &&
           report_.unbalance_over_weight < context_.acceptance.unbalance_over_weight;
  }

  /// @return  false: contacts are elsewhere, and one has to look again
  /// @pre  what has slipped is committed, and nothing has failed by that
  bool rests() {
    if (update_when_due(system_, context_, report_, true)) {
      prepare();
      return false;
    }
    report_.verdict = Verdict::stable;
    report_.reason =
        "error estimate, out-of-balance force ratio and displacements are within their limits";
    return true;
  }

  /// Adds the elastic correction, shortened while it would make the residual much larger. What of
  /// the residual a shortened correction has not taken is not left for the next: that may be slip.
  void add_correction() {
    const CorrectionTuning& tuning = effort_.correction;
    const double most = tuning.residual_growth * tuning.residual_growth * f_.squaredNorm();
    left_ = zeros(f_.size());
    for (double part = 1; part > tuning.shortest; part *= 0.5) {
      set_to_sum(trial_, system_.displacement, part, d_);
      system_.forces(trial_, f_);
      ++report_.steps;
      if (f_.squaredNorm() <= most) {
        system_.displacement = trial_;
        set_to_sum(left_, left_, part, elastic_.residual());
        return;
      }
    }
  }

  /// How far the estimate has come down, on a logarithmic scale; never quite there.
  [[nodiscard]] double progress_of(int burst) const {
    const double wanted = context_.acceptance.error_estimate;
    const double left =
        std::log(std::max(report_.error_estimate / wanted, 1.0)) / std::log(1.0 / wanted);
    const double spent = static_cast<double>(burst) / effort_.max_bursts;
    return std::clamp(std::max(1 - left, spent), 0.0, 0.99);
  }

  System& system_;
  const SearchEffort effort_;
  const SearchContext& context_;
  ElasticCorrections<System>& elastic_;
  EquilibriumReport& report_;
  LocalSearch<System> local_;
  Eigen::VectorXd f_, d_, trial_;
  Eigen::VectorXd start_, first_;  ///< where the search began, and its first step
  Eigen::VectorXd left_;           ///< of elastic solves: for the next to take
  double inexact_ = 0;             ///< error of the last correction [m]
  double estimate_ = 1;            ///< of the error of the displacements [-]
  int may_find_ = 0;               ///< contact updates that are left
  bool moves_far_ = false;
};

}  // namespace voussoir::detail
